// Boxes around what bodies sweep in the world. Source: docs/derivations/27-scenes.md, "Boxes".
#pragma once

#include "chasles/mesh/body.h"
#include "chasles/motion/moving_frame.h"

#include <Eigen/Geometry>

namespace chasles::scene {

using Box = Eigen::AlignedBox3d;

/// A body that moves in the world.
struct WorldBody {
    const Body* body = nullptr;
    motion::SharedFrame frame;
    bool rests = false;
};

/// Whether the frame never moves.
bool is_at_rest(const motion::MovingFrame& frame);

/// A box that the body does not leave during the interval, in the world.
Box swept_box(const WorldBody& body, const Bracket& times);

} // namespace chasles::scene
