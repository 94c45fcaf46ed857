#include "chasles/manipulation/admissible_twist.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <optional>
#include <vector>

namespace chasles::manipulation {

namespace {

/// Rounding, as a share of the numbers that enter a row.
constexpr double rounding = 0x1p-40;

/// The problem with rows of length 1 and the wish as the origin: the shortest z with rows z >= lacking.
struct LeastDistance {
    Rows rows;
    Eigen::VectorXd lengths; ///< that the rows had
    Eigen::VectorXd lacking;
    Twist wish;
};

LeastDistance least_distance_problem(const TwistConstraints& constraints, const Twist& wish) {
    LeastDistance problem{constraints.rows, constraints.rows.rowwise().norm(), Eigen::VectorXd(constraints.rows.rows()),
                          wish};
    for (Eigen::Index i = 0; i < problem.rows.rows(); ++i) {
        if (problem.lengths[i] > 0)
            problem.rows.row(i) /= problem.lengths[i];
        const double allowed = problem.lengths[i] > 0 ? std::max(0.0, constraints.gaps[i]) / problem.lengths[i] : 0;
        problem.lacking[i] = -allowed - problem.rows.row(i).dot(problem.wish);
    }
    return problem;
}

/// Lawson and Hanson's problem LDP: z = -p / p_7 with the residual p of the non-negative least squares below. Without
/// a solution in floating point, rest is the answer, and what balances the wish.
Eigen::VectorXd multipliers_of(const LeastDistance& problem, double scale, std::span<const Eigen::Index> likely) {
    Columns columns(most_equations, problem.rows.rows());
    columns.topRows<6>() = problem.rows.transpose();
    columns.row(6) = problem.lacking.transpose() / scale;
    const NonnegativeSolution solution = least_squares_nonnegative(columns, Equations::Unit(most_equations, 6), likely);
    const double last = -solution.residual[6]; // the squared length of the residual
    if (last > rounding * rounding)
        return solution.unknowns * (scale / last);
    const Columns directions = problem.rows.transpose();
    return least_squares_nonnegative(directions, -problem.wish).unknowns;
}

/// How far the rows are violated at most.
double violation(const LeastDistance& problem, const Twist& change) {
    return (problem.lacking - problem.rows * change).maxCoeff();
}

struct Solution {
    Twist change; ///< of the wish
    Eigen::VectorXd multipliers;
};

/// The shortest z with rows z = lacking, for some of the rows, and the multipliers that lead there. Empty if the rows
/// depend on each other.
std::optional<Solution> solution_on(const LeastDistance& problem, const std::vector<Eigen::Index>& active) {
    using Values = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_equations, 1>;
    const auto count = Eigen::Index(active.size());
    Directions directions(6, count);
    Values lacking(count);
    for (Eigen::Index k = 0; k < count; ++k) {
        directions.col(k) = problem.rows.row(active[std::size_t(k)]).transpose();
        lacking[k] = problem.lacking[active[std::size_t(k)]];
    }
    const Eigen::ColPivHouseholderQR<Directions> factors(directions); // directions P = Q R
    if (factors.rank() < count)
        return std::nullopt;
    const auto triangle = factors.matrixR().topRows(count).template triangularView<Eigen::Upper>();
    Twist change = Twist::Zero();
    change.head(count) = triangle.transpose().solve(Values(factors.colsPermutation().transpose() * lacking));
    const Values pushes = factors.colsPermutation() * Values(triangle.solve(change.head(count)));
    change = factors.householderQ() * change;
    Solution solution{change, Eigen::VectorXd::Zero(problem.rows.rows())};
    solution.multipliers(active) = pushes;
    return solution;
}

/// In a narrow wedge the squared length of the residual has few digits. The rows that push have to hold with equality,
/// which gives the solution to all digits.
Solution refined(const LeastDistance& problem, Solution solution) {
    std::vector<Eigen::Index> active;
    for (Eigen::Index i = 0; i < solution.multipliers.size(); ++i)
        if (solution.multipliers[i] > 0)
            active.push_back(i);
    if (active.empty())
        return solution;
    const std::optional<Solution> better = solution_on(problem, active);
    const double tolerated = std::max(violation(problem, solution.change), rounding * problem.wish.norm());
    if (!better || better->multipliers.minCoeff() < 0 || violation(problem, better->change) > tolerated)
        return solution;
    return *better;
}

/// Rest is admissible, so a point between a twist and rest is as near to admissible as one likes.
double admissible_share(const LeastDistance& problem, const Twist& moved) {
    double share = 1;
    for (Eigen::Index i = 0; i < problem.rows.rows(); ++i) {
        const double rate = problem.rows.row(i).dot(moved);
        const double least = problem.lacking[i] + problem.rows.row(i).dot(problem.wish); // at most 0
        if (rate < least - rounding * problem.wish.norm())
            share = std::min(share, least / rate);
    }
    return share;
}

/// The twist as far as the rows admit it, and no longer than the wish: both differ by rounding only.
Twist within_bounds(const LeastDistance& problem, Twist moved) {
    moved *= admissible_share(problem, moved);
    if (moved.squaredNorm() > problem.wish.squaredNorm())
        moved *= problem.wish.norm() / moved.norm();
    return moved;
}

} // namespace

AdmissibleTwist admissible_twist(const TwistConstraints& constraints, const Twist& wish,
                                 std::span<const Eigen::Index> likely) {
    const LeastDistance problem = least_distance_problem(constraints, wish);
    AdmissibleTwist answer{wish, Eigen::VectorXd::Zero(problem.rows.rows())};
    const double scale = problem.rows.rows() > 0 ? problem.lacking.maxCoeff() : 0;
    if (!(scale > 0))
        return answer;
    const Eigen::VectorXd raw = multipliers_of(problem, scale, likely);
    const auto& [change, multipliers] = refined(problem, {problem.rows.transpose() * raw, raw});
    answer.twist = within_bounds(problem, problem.wish + change);
    for (Eigen::Index i = 0; i < problem.rows.rows(); ++i)
        answer.multipliers[i] = problem.lengths[i] > 0 ? multipliers[i] / problem.lengths[i] : 0;
    answer.wrench = constraints.rows.transpose() * answer.multipliers;
    return answer;
}

/// In coordinates L^T v, M = L L^T, the metric is that of unit mass. There the rows are J L^-T.
AdmissibleTwist admissible_twist(const TwistConstraints& constraints, const Metric& metric, const Twist& wish) {
    const Eigen::LLT<Metric> root(metric);
    const Rows rows = root.matrixL().solve(constraints.rows.transpose()).transpose();
    AdmissibleTwist answer = admissible_twist({rows, constraints.gaps}, root.matrixU() * wish);
    answer.twist = root.matrixU().solve(answer.twist);
    answer.wrench = root.matrixL() * answer.wrench;
    return answer;
}

} // namespace chasles::manipulation
