// Least squares with unknowns that must not be negative, for few equations.
// Source: C. L. Lawson, R. J. Hanson, "Solving Least Squares Problems", 1974, chapter 23;
// docs/derivations/30-dragged-body.md, "The solver".
#pragma once

#include <Eigen/Core>

#include <span>

namespace chasles::manipulation {

/// The greatest number of equations.
inline constexpr int most_equations = 7;

/// One column for each unknown. Matrices and vectors of this size need no memory of the heap for their rows.
using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most_equations, Eigen::Dynamic>;
using Equations = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_equations, 1>;

struct NonnegativeSolution {
    Eigen::VectorXd unknowns; ///< not negative; at most as many as there are equations are positive
    Equations residual;       ///< columns * unknowns - wanted
};

/// Unknowns x >= 0 for which |columns * x - wanted| is least. Numbers must be finite.
///
/// Ends for every input: each change of the set of positive unknowns makes the residual shorter, a set that does not is
/// left out, and the number of changes has a bound. Where several unknowns are as good, the first one is used, so the
/// answer is the same in every run. `likely` are unknowns that may well be positive, each once: a good guess saves
/// time.
NonnegativeSolution least_squares_nonnegative(const Columns& columns, const Equations& wanted,
                                              std::span<const Eigen::Index> likely = {});

} // namespace chasles::manipulation
