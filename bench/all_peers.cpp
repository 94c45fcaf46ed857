#include "bench/all_peers.h"

#include "bench/bullet_peer.h"
#include "bench/chasles_peer.h"
#include "bench/fcl_peer.h"
#include "bench/registry_peers.h"

namespace chasles::bench {

namespace {

void add(AllPeers& all, const ProcessPeer& peer) {
    try {
        all.present.push_back(process_peer(peer));
    } catch (const PeerFailed& failure) {
        all.absent.push_back({peer.name, failure.what()});
    }
}

} // namespace

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
    const RegistryPeers registry = registry_peers();
    all.absent.insert(all.absent.end(), registry.absent.begin(), registry.absent.end());
    for (const ProcessPeer& peer : registry.to_start)
        add(all, peer);
    // docs/decisions/0040-peers.md gives the reason. translations_bench compares single feature pairs.
    all.absent.push_back({"IPC Toolkit", "no whole rigid bodies from Python"});
    return all;
}

} // namespace chasles::bench
