// The numbers of a motion that an answer shows: the screw between the end poses, and the turn until the contact.
#pragma once

#include "chasles/chasles.h"

namespace chasles::view {

enum class MotionKind : std::uint8_t {
    screw,    ///< ScrewMotion
    sweep,    ///< SweepMotion
    velocity, ///< ConstantVelocity
    twist     ///< ConstantTwist
};

/// For a sweep and for a constant velocity, slide and axis are those of the screw with equal end poses. The motion
/// itself follows another path.
struct MotionNumbers {
    MotionKind kind = MotionKind::screw;
    /// Whether these are the numbers of the moving body in the world, while the fixed body moves too. Otherwise they
    /// are those of the moving body as seen from the fixed body.
    bool is_in_world = false;
    double angle = 0; ///< radians
    double slide = 0; ///< mesh unit
    Eigen::Vector3d axis_point = Eigen::Vector3d::Zero();
    Eigen::Vector3d axis_direction = Eigen::Vector3d::UnitZ();
    Eigen::Vector3d displacement = Eigen::Vector3d::Zero(); ///< of the point that moves straight, mesh unit
    Bracket span = {0, 1};                                  ///< the times of start and goal
};

MotionNumbers numbers_of(const ScrewMotion& screw);
MotionNumbers numbers_of(const SweepMotion& sweep);
MotionNumbers numbers_of(const ConstantVelocity& velocity);
MotionNumbers numbers_of(const ConstantTwist& twist);

/// A motion of one of these kinds, with its numbers.
struct NumberedMotion {
    Motion motion;
    MotionNumbers numbers;
};

template <typename Typed>
NumberedMotion numbered(const Typed& motion) {
    return {motion, numbers_of(motion)};
}

/// Whether a point of the body moves straight: in a sweep and at constant velocity.
bool moves_straight(MotionKind kind);

/// Whether the motion has the paper's parameter: a screw and a sweep.
bool has_tau(MotionKind kind);

/// The part of a motion that is done at a time. `tau` is the same time in the paper's parameter, if the motion has it.
struct Progress {
    double turned = 0; ///< radians
    double length = 0; ///< mesh unit: the slide, or the way of the point that moves straight
};
Progress progress_at(const MotionNumbers& motion, double time, double tau);

} // namespace chasles::view
