// Bullet 3.24 (Debian: libbullet-dev, its libraries in double precision).
#pragma once

#include "bench/peer.h"

namespace chasles::bench {

/// `btContinuousConvexCollision` on convex hulls without a margin.
///
/// Bullet moves the body's origin along a straight line and turns the body at a constant rate by at most 45 degrees.
/// With a larger turn its motion does not end at the goal. Its motion is the screw if the axis passes through the
/// origin and the turn is at most 45 degrees. Bodies closer than 0.001 count as touching, independent of their size.
Peer bullet_peer();

} // namespace chasles::bench
