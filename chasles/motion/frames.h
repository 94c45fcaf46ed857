// The frames that motions are made of: at rest, a hinge, a path of polynomials, products, one frame seen from another,
// one frame after another, a part of a frame, and the user's own. Source: docs/derivations/26-frames.md.
#pragma once

#include "chasles/motion/moving_frame.h"
#include "chasles/motion/pose.h"
#include "chasles/motion/time_polynomial.h"

#include <array>

namespace chasles::motion {

/// A pose that stays.
SharedFrame frame_at_rest(const Pose& pose);

/// The turn about a line by a polynomial angle in radians. The direction has any non-zero length.
SharedFrame hinge_frame(const Eigen::Vector3d& point, const Eigen::Vector3d& direction, TimePolynomial angle);
/// Likewise about a line through the origin, whose direction has unit length.
SharedFrame hinge_frame(const Vector3<algebra::DoubleDouble>& direction, TimePolynomial angle);

/// A translation by a polynomial times a direction.
SharedFrame slide_frame(const Eigen::Vector3d& direction, const TimePolynomial& way);

/// A translation by three polynomials, mesh unit.
SharedFrame path_frame(std::array<TimePolynomial, 3> place);

/// The frame `inner`, carried by the frame `outer`.
SharedFrame product_frame(SharedFrame outer, SharedFrame inner);

/// The frame `moving` as seen from the frame `fixed`.
SharedFrame relative_frame(SharedFrame moving, SharedFrame fixed);

/// Frames one after another: frame i lasts from ends[i] to ends[i + 1], during which its own time runs from 0 to 1. All
/// must have the same reference and no cut. `ends` ascends from 0 to 1.
SharedFrame joined_frames(std::vector<double> ends, std::vector<SharedFrame> frames);

/// A part of a frame's way, between two different times in [0, 1]: its own time runs from 0 to 1 while that of the
/// frame runs from `from` to `to`, which may be the earlier one.
SharedFrame part_frame(SharedFrame frame, double from, double to);
/// The frame from its end to its start; twice is once forwards.
SharedFrame reversed_frame(const SharedFrame& frame);

} // namespace chasles::motion
