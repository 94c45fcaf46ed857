// Bounds of the places of a body during a motion: a box that it does not leave, and a ball that moves with it.
// Source: docs/derivations/27-scenes.md, "Boxes" and "Pairs".
#pragma once

#include "chasles/mesh/body.h"
#include "chasles/motion/moving_frame.h"

#include <Eigen/Geometry>

namespace chasles::scene {

using Box = Eigen::AlignedBox3d;

/// A body that moves in the world.
struct WorldBody {
    const Body& body;
    const motion::MovingFrame& frame;
    bool rests = false; ///< the frame never moves
};

/// A ball around a body, whose centre moves near a straight, even way.
struct MovingBall {
    Eigen::Vector3d start = Eigen::Vector3d::Zero(); ///< of the centre
    Eigen::Vector3d way = Eigen::Vector3d::Zero();   ///< of the centre until the end of the interval
    double radius = 0;                               ///< of the ball, with how far the centre leaves its way
    double size = 0;                                 ///< of all lengths that enter
};

struct SweptBody {
    Box box; ///< that the body does not leave
    MovingBall ball;
};

/// Whether the frame never moves.
bool is_at_rest(const motion::MovingFrame& frame);

/// What a body sweeps from the start until a time.
SweptBody swept(const WorldBody& body, double until);

/// A share of the interval of two balls before which they are farther apart than the margin; 2 if they are so all
/// along.
double earliest_meeting(const MovingBall& a, const MovingBall& b, double margin);

/// The ball during the rest of its interval, from a share of it on.
MovingBall rest_of(const MovingBall& ball, double share);

/// The box with this much more on all sides.
Box widened(const Box& box, double length);

} // namespace chasles::scene
