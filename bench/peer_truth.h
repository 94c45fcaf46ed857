// The answer that all peers are held against, and why it is not only Chasles' word.
#pragma once

#include "bench/peer_cases.h"
#include "chasles/query/first_contact.h"

namespace chasles::bench {

struct Truth {
    bool touches = false;
    Bracket time;              ///< holds the first contact; an exact time where that is known by construction
    std::string contradiction; ///< empty, or why it cannot be the truth
};

/// Chasles' proof, held against what is known by construction and against a discrete test of its own at sampled times:
/// the bodies are apart before the contact and pass through each other a millionth of the motion after it.
Truth truth_of(const PeerCase& pair, const PeerQuestion& question);

} // namespace chasles::bench
