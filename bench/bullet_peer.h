// Bullet 3.24 (Debian: libbullet-dev, its libraries in double precision).
#pragma once

#include "bench/peer.h"

namespace chasles::bench {

/// `btContinuousConvexCollision` on convex hulls without a margin.
///
/// Bullet carries the body's origin along a straight line and turns the body at a constant rate, by no more than 45
/// degrees: beyond that its motion does not reach the goal. This is the screw where the axis runs through the origin
/// and the turn is less. Bodies nearer than 0.001, whatever their size, count as touching.
Peer bullet_peer();

} // namespace chasles::bench
