// FCL 0.7 (Debian: libfcl-dev), on hierarchies of oriented boxes.
#pragma once

#include "bench/peer.h"

#include <vector>

namespace chasles::bench {

/// `collide` at the start pose, and `continuousCollide` by 10 and by 100 samples and by conservative advancement.
///
/// FCL's screw turns and slides at constant rates. Chasles slides by tan(angle tau / 2) within each of its pieces of at
/// most ten degrees. The two motions differ by at most a thousandth of a piece's slide. End poses, translations, and
/// rotations without slide are the same.
std::vector<Peer> fcl_peers();

} // namespace chasles::bench
