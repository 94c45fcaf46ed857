// What the peers are asked: bodies, motions, and what is known about the answers without asking anybody.
#pragma once

#include "bench/peer.h"

#include <string>
#include <vector>

namespace chasles::bench {

/// One question. What is known by construction holds for every peer's motion; the time may not be known.
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

/// The same questions on every run. A case whose data is absent is left out, and said to be on standard output.
std::vector<PeerCase> peer_cases();

} // namespace chasles::bench
