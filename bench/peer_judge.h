// How often a peer is right.
#pragma once

#include "bench/peer_truth.h"

namespace chasles::bench {

struct Judgement {
    std::size_t queries = 0; ///< fewer than the case has, if time ran out
    std::size_t contacts = 0;
    std::size_t missed = 0;
    std::size_t false_alarms = 0;
    std::optional<double> worst_time_error; ///< of the motion, to the far end of the bracket, where both have a contact
    double seconds = 0;                     ///< for all queries
    std::string contradiction;              ///< empty, or where a peer has found the truth to be none
};

/// An answer and what it took: by the peer's own clock where it has one, otherwise by ours.
struct TimedAnswer {
    PeerAnswer answer;
    double seconds = 0;
};
TimedAnswer timed_answer(const PeerPair& peer, const Displacement& motion);

/// Asks the questions in order for about `seconds`.
///
/// A peer is blamed only on its own motion: a miss counts if the bodies overlap on it right after the contact, a false
/// alarm if they do not at the time that the peer reports. All of these are told by the discrete test.
Judgement judge(const PeerCase& pair, const PeerPair& peer, const std::vector<Truth>& truths, double seconds);

} // namespace chasles::bench
