// A query whose answer nobody looks at is a mistake.
#include "chasles/chasles.h"

void ask(const chasles::FirstContactQuery& query, chasles::FirstContact& found) {
#ifndef MISUSE
    found =
#endif
        chasles::first_contact(query);
    static_cast<void>(found);
}
