// The libraries of the comparison, and the libraries that are not installed.
#pragma once

#include "bench/peer.h"

#include <vector>

namespace chasles::bench {

struct AllPeers {
    std::vector<Peer> present; ///< the first peer is the reference of all ratios
    std::vector<AbsentPeer> absent;
};

AllPeers all_peers();

} // namespace chasles::bench
