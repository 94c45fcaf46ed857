// Degenerate touches that doubles describe exactly, turns included. A touch is posed on a lattice of small whole
// numbers in the place where the bodies are at some tau; whole-number quaternions make the turn back to the body's
// frame rational, and multiples of its denominator make it whole.
#pragma once

#include "tests/attack/attack_random.h"
#include "tests/attack/posed_motion.h"

namespace chasles::attack {

/// Wishes for a motion; the zero vector and negative numbers leave the choice open.
struct MotionWish {
    Eigen::Vector3i axis = Eigen::Vector3i::Zero();   ///< to turn about
    Eigen::Vector3i travel = Eigen::Vector3i::Zero(); ///< only of motions without turn
    int turns = -1;                                   ///< 0: translation
    int slides = -1;                                  ///< 0: no slide along the axis
    double tau = -1;                                  ///< where the lattice is
};

/// A motion, and where on it the lattice is.
struct LatticeMotion {
    PosedMotion posed;
    MotionPath<Rational> path;
    double tau = 0;

    /// Body coordinates of the moving point that is over lattice point z at `tau`, and of the fixed point there.
    [[nodiscard]] Eigen::Vector3d moving_point(const Eigen::Vector3d& z) const;
    [[nodiscard]] Eigen::Vector3d fixed_point(const Eigen::Vector3d& z) const;

    /// Direction on the lattice in which the moving point over z runs at `tau`, in whole numbers if they are small
    /// enough; zero if it rests.
    [[nodiscard]] Eigen::Vector3d velocity(const Eigen::Vector3d& z) const;

    std::array<Triple, 3> turn; ///< at `tau`, rows
    Triple offset;
    Rational denominator; ///< of the turn
};

LatticeMotion lattice_motion(AttackRandom& random, const MotionWish& wish = {});

/// The same question in another unit. Powers of two change no digit; other factors round.
void scale_lengths(PosedMotion& posed, double factor);

} // namespace chasles::attack
