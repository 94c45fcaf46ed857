// A motion given by poses, in the form of the library and in the form of the exact reference.
#pragma once

#include "chasles/motion/motion.h"
#include "tests/support/exact_reference_motion.h"

#include <numbers>
#include <optional>
#include <vector>

namespace chasles::attack {

using reference::ExactPose;
using reference::Integer;
using reference::MotionPath;
using reference::Rational;
using reference::Triple;

enum class MotionKind : std::uint8_t { screw, sweep };

/// Poses in the world; `is_relative` if the fixed body moves too.
struct PosedMotion {
    MotionKind kind = MotionKind::screw;
    bool is_relative = false;
    Pose moving_start;
    Pose moving_goal;
    Pose fixed_start;
    Pose fixed_goal;
    double max_turn = std::numbers::pi;

    [[nodiscard]] Motion motion() const;
    /// Empty for a sweep.
    [[nodiscard]] std::optional<ScrewMotion> screw() const;

    /// The exact motion in the frame of the fixed body. A screw that the library cuts consists, by its documentation,
    /// of motions between poses in double precision; these poses are taken from the library.
    [[nodiscard]] std::vector<MotionPath<Rational>> paths() const;
};

/// A pose with its numbers rounded to doubles. Poses of exact constructions need no rounding.
Pose rounded_pose(const ExactPose& pose);

} // namespace chasles::attack
