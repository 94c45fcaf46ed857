// A motion given by poses, as the library is asked about it and as the exact reference sees it.
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

    /// The motion in the frame of the fixed body, exactly. A screw that the library cuts is, by its documentation, the
    /// motions between poses rounded to double precision; these poses are taken from the library.
    [[nodiscard]] std::vector<MotionPath<Rational>> paths() const;
};

/// A pose whose numbers are rounded to doubles; those of the exact constructions need no rounding.
Pose rounded_pose(const ExactPose& pose);

} // namespace chasles::attack
