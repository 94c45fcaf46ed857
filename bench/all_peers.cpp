#include "bench/all_peers.h"

#include "bench/bullet_peer.h"
#include "bench/chasles_peer.h"
#include "bench/fcl_peer.h"

namespace chasles::bench {

AllPeers all_peers() {
    AllPeers all;
    all.present = {chasles_first(), chasles_any()};
#ifdef CHASLES_BENCH_FCL
    for (Peer& peer : fcl_peers())
        all.present.push_back(std::move(peer));
#else
    all.absent.push_back({"FCL", "no libfcl-dev"});
#endif
#ifdef CHASLES_BENCH_BULLET
    all.present.push_back(bullet_peer());
#else
    all.absent.push_back({"Bullet", "no libbullet-dev in double"});
#endif
    // See docs/decisions/0040-peers.md.
    for (const char* name : {"Coal", "IPC Toolkit", "Parry", "python-fcl"})
        all.absent.push_back({name, "not in Debian 12"});
    return all;
}

} // namespace chasles::bench
