// Non-negative least squares against the conditions of Karush, Kuhn and Tucker, and against all active sets.
#include "chasles/manipulation/least_squares_nonnegative.h"

#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <bit>
#include <random>

namespace chasles::test {
namespace {

using manipulation::Columns;
using manipulation::Equations;
using manipulation::least_squares_nonnegative;
using manipulation::NonnegativeSolution;

struct Problem {
    Columns columns;
    Equations wanted;
};

/// Many kinds of columns: at random, of few small integers (ties, equal and opposite columns), of all sizes, zero.
Problem random_problem(std::mt19937& random, int most_columns) {
    const auto integer = [&](int from, int to) { return std::uniform_int_distribution(from, to)(random); };
    std::normal_distribution<double> normal;
    const int rows = integer(1, 7), count = integer(0, most_columns), kind = integer(0, 3);
    Problem problem{Columns(rows, count), Equations(rows)};
    const auto number = [&] { return kind == 1 ? double(integer(-1, 1)) : normal(random); };
    for (int i = 0; i < rows; ++i)
        problem.wanted[i] = number();
    for (int j = 0; j < count; ++j) {
        for (int i = 0; i < rows; ++i)
            problem.columns(i, j) = number();
        if (kind == 2)
            problem.columns.col(j) *= std::pow(10, integer(-6, 6));
        if (kind == 3 && j > 0)
            problem.columns.col(j) = problem.columns.col(integer(0, j - 1)) * (integer(0, 1) ? 1.0 : -2.0);
    }
    return problem;
}

/// The shortest residual over all sets of columns that may be positive, each by a decomposition of full pivots.
double shortest_residual(const Problem& problem) {
    double shortest = problem.wanted.norm();
    for (unsigned set = 1; set < 1U << problem.columns.cols(); ++set) {
        Eigen::MatrixXd part(problem.columns.rows(), std::popcount(set));
        for (int j = 0, k = 0; j < problem.columns.cols(); ++j)
            if (set >> j & 1)
                part.col(k++) = problem.columns.col(j);
        const Eigen::VectorXd values = part.fullPivLu().rank() < part.cols()
                                           ? Eigen::VectorXd::Constant(part.cols(), -1)
                                           : Eigen::VectorXd(part.fullPivHouseholderQr().solve(problem.wanted));
        if (values.minCoeff() >= 0)
            shortest = std::min(shortest, (part * values - problem.wanted).norm());
    }
    return shortest;
}

TEST(LeastSquaresNonnegative, AGuessChangesNoResidual) {
    std::mt19937 random(4);
    for (int round = 0; round < 5000; ++round) {
        const Problem problem = random_problem(random, 40);
        const NonnegativeSolution expected = least_squares_nonnegative(problem.columns, problem.wanted);
        std::vector<Eigen::Index> active; // the solution itself, and some more
        for (Eigen::Index j = 0; j < problem.columns.cols(); ++j)
            if (expected.unknowns[j] > 0 || random() % 40 == 0)
                active.push_back(j);
        const NonnegativeSolution found = least_squares_nonnegative(problem.columns, problem.wanted, active);
        EXPECT_LE((found.residual - expected.residual).norm(), 1e-9 * problem.wanted.norm()) << round;
    }
}

/// Two columns that are nearly opposite, and a third one. What is wanted is a positive sum of them, and a part across.
TEST(LeastSquaresNonnegative, KeepsBothSidesOfANarrowWedge) {
    constexpr double width = 1e-5;
    constexpr int rounds = 2000;
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    int all_positive = 0;
    for (int round = 0; round < rounds; ++round) {
        const auto vector = [&] { return Eigen::Vector<double, 7>::NullaryExpr([&] { return normal(random); }); };
        const Eigen::Vector<double, 7> middle = vector();
        Eigen::Matrix<double, 7, 3> sides;
        sides << middle + width * vector(), -middle + width * vector(), middle + width * vector();
        const Eigen::Vector<double, 7> across = vector();
        const Equations wanted = across - sides * sides.fullPivHouseholderQr().solve(across) +
                                 sides * Eigen::Vector3d(0.5 / width, 0.5 / width, 0.5);
        const NonnegativeSolution found = least_squares_nonnegative(sides, wanted);
        all_positive += found.unknowns.minCoeff() > 0;
    }
    EXPECT_GT(all_positive, 0.99 * rounds); // a tenth of a percent of the unknowns is rounding
}

TEST(LeastSquaresNonnegative, HoldsTheConditionsOfOptimality) {
    std::mt19937 random(1);
    int active = 0, exact = 0;
    for (int round = 0; round < 20000; ++round) {
        const Problem problem = random_problem(random, 40);
        std::vector<Eigen::Index> likely; // good and bad guesses must lead to the same conditions
        for (Eigen::Index j = 0; j < problem.columns.cols(); ++j)
            if (round % 3 != 0 && random() % (round % 3 == 1 ? 4 : 16) == 0)
                likely.push_back(j);
        const NonnegativeSolution found = least_squares_nonnegative(problem.columns, problem.wanted, likely);
        ASSERT_EQ(found.unknowns.size(), problem.columns.cols());
        const Equations residual = problem.columns * found.unknowns - problem.wanted;
        const double scale = problem.wanted.norm();
        EXPECT_LE((residual - found.residual).norm(), 1e-11 * scale) << round;
        for (int j = 0; j < problem.columns.cols(); ++j) {
            const double slope = problem.columns.col(j).dot(residual),
                         most = 1e-11 * scale * problem.columns.col(j).norm();
            EXPECT_GE(found.unknowns[j], 0) << round;
            EXPECT_GE(slope, -most) << round << ' ' << j;
            EXPECT_TRUE(found.unknowns[j] == 0 || slope <= most) << round << ' ' << j;
            active += found.unknowns[j] > 0;
        }
        exact += residual.norm() < 1e-12 * scale;
    }
    EXPECT_GT(active, 20000);
    EXPECT_GT(exact, 4000);
}

TEST(LeastSquaresNonnegative, NoActiveSetGivesAShorterResidual) {
    std::mt19937 random(2);
    for (int round = 0; round < 3000; ++round) {
        const Problem problem = random_problem(random, 9);
        const NonnegativeSolution found = least_squares_nonnegative(problem.columns, problem.wanted);
        EXPECT_NEAR(found.residual.norm(), shortest_residual(problem), 1e-11 * problem.wanted.norm()) << round;
    }
}

TEST(LeastSquaresNonnegative, TheFirstOfEqualColumnsIsUsed) {
    const Columns columns =
        Eigen::MatrixXd::Identity(3, 3).rowwise().replicate(1)(Eigen::all, Eigen::VectorXi{{1, 0, 0, 1}});
    const NonnegativeSolution found = least_squares_nonnegative(columns, Eigen::Vector3d(2, 3, 5));
    EXPECT_EQ(found.unknowns, (Eigen::Vector4d(3, 2, 0, 0)));
    EXPECT_EQ(found.residual, (Eigen::Vector3d(0, 0, -5)));
}

TEST(LeastSquaresNonnegative, WithoutColumnsOrWantNothingIsFound) {
    EXPECT_EQ(least_squares_nonnegative(Columns(4, 0), Eigen::Vector4d::Ones()).unknowns.size(), 0);
    EXPECT_EQ(least_squares_nonnegative(Columns::Ones(4, 3), Eigen::Vector4d::Zero()).unknowns,
              Eigen::Vector3d::Zero());
    EXPECT_EQ(least_squares_nonnegative(Columns::Zero(4, 3), Eigen::Vector4d::Ones()).unknowns,
              Eigen::Vector3d::Zero());
}

} // namespace
} // namespace chasles::test
