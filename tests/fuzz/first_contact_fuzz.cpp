// Small moving bodies against an answer in exact rationals: no miss, no false alarm, no late or uncertain answer.
#include "chasles/base/invalid_input.h"
#include "tests/fuzz/exact_answer.h"
#include "tests/fuzz/sound_answer.h"

namespace chasles::fuzz {
namespace {

void demand_right(const FirstContact& found, const ExactAnswer& exact, const Question& question) {
    const bool nested = exact.moving_is_inside || exact.fixed_is_inside;
    demand(bool(found.inside) == nested, "a body is inside where it is");
    if (nested) {
        demand(found.certain, "a body is certainly inside");
        demand(found.inside->moving_is_inside ? exact.moving_is_inside : exact.fixed_is_inside, "this body is inside");
        return;
    }
    const bool is_clear = found.verdict == Verdict::clear;
    demand(!exact.touches || !is_clear, "no contact is missed");
    demand(exact.touches || is_clear, "no false alarm");
    if (is_clear)
        return;
    demand(found.certain, "nothing is left in doubt");
    if (question.find != Find::any) {
        demand(found.tau.lower <= exact.tau_upper, "tau is not after the first contact");
        demand(found.time.lower <= exact.time_upper, "time is not after the first contact");
        demand(exact.at_start == (found.verdict == Verdict::contact_at_start), "a contact at the start is called one");
    }
    demand(found.tau.upper >= exact.tau_lower, "tau of a certain contact is not before the first");
    demand(found.time.upper >= exact.time_lower, "time of a certain contact is not before the first");
}

void ask(Bytes& bytes) {
    const Question question = question_from(bytes);
    const FirstContact found = question.ask();
    demand_sound(found, question.find);
    demand_right(found, exact_answer(question), question);
}

} // namespace
} // namespace chasles::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    chasles::fuzz::Bytes bytes(data, size);
    try {
        chasles::fuzz::ask(bytes);
    } catch (const chasles::InvalidInput&) { // a body without area, or a pose without a rotation
    }
    return 0;
}
