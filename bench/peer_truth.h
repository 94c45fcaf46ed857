// The reference answers of the comparison, and their checks, which are independent of Chasles.
#pragma once

#include "bench/peer_cases.h"
#include "chasles/query/first_contact.h"

namespace chasles::bench {

struct Truth {
    bool touches = false;
    Bracket time;              ///< contains the first contact; an exact time if known by construction
    std::string contradiction; ///< empty, or the reason why this answer is wrong
};

/// The answer of Chasles, compared with the construction and with discrete tests at sampled times: the bodies are apart
/// before the contact, and overlap a millionth of the motion after the contact.
Truth truth_of(const PeerCase& pair, const PeerQuestion& question);

} // namespace chasles::bench
