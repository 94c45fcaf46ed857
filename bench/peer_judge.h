// Counts the right and wrong answers of a peer.
#pragma once

#include "bench/peer_truth.h"

namespace chasles::bench {

struct Judgement {
    std::size_t queries = 0; ///< fewer than the queries of the case if time ran out
    std::size_t contacts = 0;
    std::size_t missed = 0;
    std::size_t false_alarms = 0;
    std::optional<double> worst_time_error; ///< to the far end of the bracket, over queries where both report a contact
    double seconds = 0;                     ///< total time of all queries
    std::string contradiction;              ///< empty, or the query in which a peer refutes the reference answer
};

/// An answer and its duration, by the peer's own clock if it has one, otherwise by our clock.
struct TimedAnswer {
    PeerAnswer answer;
    double seconds = 0;
};
TimedAnswer timed_answer(const PeerPair& peer, const Displacement& motion);

/// Runs the queries in order for about `seconds`.
///
/// A peer is judged by its own motion. A miss counts if the bodies overlap in this motion just after the contact. A
/// false alarm counts if the bodies do not overlap at the time that the peer reports. The discrete test decides both.
Judgement judge(const PeerCase& pair, const PeerPair& peer, const std::vector<Truth>& truths, double seconds);

} // namespace chasles::bench
