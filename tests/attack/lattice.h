// Degenerate touches that doubles represent exactly, including turns. A touch is posed on a lattice of small whole
// numbers in the frame of the bodies at some tau. Quaternions of whole numbers make the turn back to the body's frame
// rational, and multiples of its denominator make the coordinates whole.
#pragma once

#include "tests/attack/attack_random.h"
#include "tests/attack/posed_motion.h"

namespace chasles::attack {

/// The properties of a motion. The zero vector and negative numbers mean a random choice.
struct MotionWish {
    Eigen::Vector3i axis = Eigen::Vector3i::Zero();   ///< to turn about
    Eigen::Vector3i travel = Eigen::Vector3i::Zero(); ///< only of motions without turn
    int turns = -1;                                   ///< 0: a translation
    int slides = -1;                                  ///< 0: no slide along the axis
    double tau = -1;                                  ///< tau at which the bodies are on the lattice
};

/// A motion and the tau of its lattice.
struct LatticeMotion {
    PosedMotion posed;
    MotionPath<Rational> path;
    double tau = 0;

    /// The body coordinates of the moving point and of the fixed point that are at the lattice point z at `tau`.
    [[nodiscard]] Eigen::Vector3d moving_point(const Eigen::Vector3d& z) const;
    [[nodiscard]] Eigen::Vector3d fixed_point(const Eigen::Vector3d& z) const;

    /// The direction on the lattice in which the moving point at z moves at `tau`, in whole numbers if they are small
    /// enough; zero if the point rests.
    [[nodiscard]] Eigen::Vector3d velocity(const Eigen::Vector3d& z) const;

    std::array<Triple, 3> turn; ///< at `tau`, rows
    Triple offset;
    Rational denominator; ///< denominator of the turn
};

LatticeMotion lattice_motion(AttackRandom& random, const MotionWish& wish = {});

/// Changes the unit of length. Powers of two are exact; other factors round.
void scale_lengths(PosedMotion& posed, double factor);

} // namespace chasles::attack
