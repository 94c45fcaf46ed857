// "Could not tell" must not pass for "clear", nor the other way round: a verdict is not a truth value.
#include "chasles/chasles.h"

int answer(const chasles::FirstContact& found) {
#ifdef MISUSE
    if (found.verdict) {
#else
    if (found.verdict == chasles::Verdict::clear) {
#endif
        return 0;
    }
    return 1;
}
