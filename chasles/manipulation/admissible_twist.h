// The twist nearest to a wish that violates no constraint, and what the constraints push with.
// Source: docs/derivations/30-dragged-body.md, "The nearest admissible twist".
#pragma once

#include "chasles/manipulation/least_squares_nonnegative.h"

#include <Eigen/Core>

#include <span>

namespace chasles::manipulation {

/// A velocity, or a small displacement: linear (of the reference point) and angular, three numbers each.
using Twist = Eigen::Matrix<double, 6, 1>;
/// A force and a torque about the reference point.
using Wrench = Eigen::Matrix<double, 6, 1>;
/// Symmetric and positive definite: |v|_M^2 = v . M v is twice the kinetic energy of the twist v.
using Metric = Eigen::Matrix<double, 6, 6>;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, 6>;
/// Twists in columns.
using Directions = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, most_equations>;

/// Which twists v are admissible: rows * v >= -gaps.
struct TwistConstraints {
    Rows rows;            ///< (n, p x n) for each contact, p relative to the reference point
    Eigen::VectorXd gaps; ///< what each contact may close by; negative ones count as 0, so rest is admissible
};

struct AdmissibleTwist {
    Twist twist = Twist::Zero();
    Eigen::VectorXd multipliers;    ///< one for each row, not negative; positive only where the gap is used up
    Wrench wrench = Wrench::Zero(); ///< of the constraints on the body: M (twist - wish) = rows^T multipliers
};

/// The admissible twist for which |v - wish|_M is least. There is always one, as rest is admissible, and it has no
/// more energy than the wish: |v|_M <= |wish|_M. Numbers must be finite.
///
/// A row is violated by less than 2^-40 of what it is multiplied from, by rounding.
AdmissibleTwist admissible_twist(const TwistConstraints& constraints, const Metric& metric, const Twist& wish);

/// Likewise with the unit matrix as the metric. `likely` are rows that may well push, each once: a good guess saves
/// time.
AdmissibleTwist admissible_twist(const TwistConstraints& constraints, const Twist& wish,
                                 std::span<const Eigen::Index> likely = {});

} // namespace chasles::manipulation
