// The cases of the comparison: bodies, motions, and the answers that are known by construction.
#pragma once

#include "bench/peer.h"

#include <string>
#include <vector>

namespace chasles::bench {

/// One query. An answer that is known by construction holds for every peer's motion; its time may be unknown.
struct PeerQuestion {
    Displacement motion;
    std::optional<PeerAnswer> known;
};

struct PeerCase {
    std::string name;
    Polyhedron moving;
    Polyhedron fixed;
    std::vector<PeerQuestion> questions;
    bool is_convex = false;
};

/// The cases, which are the same in every run. A case without its data is omitted, with a line on standard output.
std::vector<PeerCase> peer_cases();

} // namespace chasles::bench
