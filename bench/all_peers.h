// Who is compared, and who is not there.
#pragma once

#include "bench/peer.h"

#include <vector>

namespace chasles::bench {

struct AllPeers {
    std::vector<Peer> present; ///< the first one is what the others are compared with
    std::vector<AbsentPeer> absent;
};

AllPeers all_peers();

} // namespace chasles::bench
