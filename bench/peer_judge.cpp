#include "bench/peer_judge.h"

#include "bench/discrete_overlap.h"
#include "bench/piecewise_poses.h"
#include "scenes/stopwatch.h"

#include <cmath>

namespace chasles::bench {

namespace {

/// One answer of one peer.
struct Trial {
    const PeerCase& pair;
    const PeerPair& peer;
    const Displacement& motion;
    const Truth& truth;
    PeerAnswer answer;
};

bool is_overlapping_on_own_motion(const Trial& test, double time) {
    return is_overlapping(test.pair.moving, test.pair.fixed, test.peer.pose_at(test.motion, time));
}

bool is_miss(const Trial& test) {
    for (const double later : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1})
        if (const double time = test.truth.time.upper + later; time <= 1 && is_overlapping_on_own_motion(test, time))
            return true;
    return false;
}

bool is_false_alarm(const Trial& test) {
    return !test.answer.time || !is_overlapping_on_own_motion(test, *test.answer.time);
}

/// Whether a peer's contact before the reference's first contact is real, which refutes the reference.
bool refutes_truth(const Trial& test) {
    const auto& [pair, peer, motion, truth, answer] = test;
    if (!answer.touches || !answer.time || (truth.touches && *answer.time >= truth.time.lower - 1e-9))
        return false;
    const PiecewisePoses poses(ScrewMotion::between(motion.start, motion.goal));
    return is_overlapping(pair.moving, pair.fixed, poses.at(*answer.time));
}

/// The error up to the far end of the bracket, because the first contact may be anywhere inside.
double time_error(const Trial& test) {
    const double time = *test.answer.time;
    return std::max(std::abs(time - test.truth.time.lower), std::abs(time - test.truth.time.upper));
}

void add(Judgement& judgement, const Trial& test) {
    const auto& [pair, peer, motion, truth, answer] = test;
    judgement.contacts += truth.touches ? 1 : 0;
    if (refutes_truth(test))
        judgement.contradiction = "query " + std::to_string(judgement.queries) + ": the bodies overlap at time " +
                                  std::to_string(*answer.time) + ", before the contact";
    if (truth.touches && !answer.touches && is_miss(test))
        ++judgement.missed;
    if (!truth.touches && answer.touches && is_false_alarm(test))
        ++judgement.false_alarms;
    if (truth.touches && answer.touches && answer.time)
        judgement.worst_time_error = std::max(judgement.worst_time_error.value_or(0), time_error(test));
    ++judgement.queries;
}

} // namespace

TimedAnswer timed_answer(const PeerPair& peer, const Displacement& motion) {
    const scenes::Stopwatch watch;
    const PeerAnswer answer = peer.ask(motion);
    const double seconds = watch.seconds();
    return {answer, answer.seconds.value_or(seconds)};
}

Judgement judge(const PeerCase& pair, const PeerPair& peer, const std::vector<Truth>& truths, double seconds) {
    Judgement judgement;
    for (std::size_t i = 0; i < truths.size() && judgement.seconds < seconds; ++i) {
        const Displacement& motion = pair.questions[i].motion;
        const TimedAnswer timed = timed_answer(peer, motion);
        judgement.seconds += timed.seconds;
        add(judgement, {pair, peer, motion, truths[i], timed.answer});
    }
    return judgement;
}

} // namespace chasles::bench
