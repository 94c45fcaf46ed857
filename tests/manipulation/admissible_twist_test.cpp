// The nearest admissible twist: closed forms, the conditions of optimality, and all active sets.
#include "chasles/manipulation/admissible_twist.h"

#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <bit>
#include <random>

namespace chasles::test {
namespace {

using Eigen::Vector3d;
using manipulation::admissible_twist;
using manipulation::AdmissibleTwist;
using manipulation::Metric;
using manipulation::Twist;
using manipulation::TwistConstraints;

Twist twist(const Vector3d& linear, const Vector3d& angular = Vector3d::Zero()) {
    Twist result;
    result << linear, angular;
    return result;
}

/// Contacts with points relative to the reference point.
TwistConstraints touching(const std::vector<std::pair<Vector3d, Vector3d>>& normals_and_points) {
    const auto count = Eigen::Index(normals_and_points.size());
    TwistConstraints constraints{manipulation::Rows(count, 6), Eigen::VectorXd::Zero(count)};
    for (Eigen::Index i = 0; i < count; ++i) {
        const auto& [normal, point] = normals_and_points[std::size_t(i)];
        constraints.rows.row(i) = twist(normal, point.cross(normal)).transpose();
    }
    return constraints;
}

const Metric unit_metric = Metric::Identity();

TEST(AdmissibleTwist, AWishThatIsAdmissibleIsTheAnswerBitForBit) {
    const TwistConstraints floor = touching({{Vector3d::UnitZ(), Vector3d(1, 2, -1)}});
    const Twist wish = twist({0.1, 0.2, 0.3}, {0.4, 0.5, 0});
    const AdmissibleTwist found = admissible_twist(floor, unit_metric, wish);
    EXPECT_EQ(found.twist, wish);
    EXPECT_EQ(found.multipliers, Eigen::VectorXd::Zero(1));
    EXPECT_EQ(admissible_twist(touching({}), unit_metric, wish).twist, wish);
}

TEST(AdmissibleTwist, ABoxOnATableSlidesAndTheTablePushes) {
    std::vector<std::pair<Vector3d, Vector3d>> corners;
    for (const double x : {-1, 1})
        for (const double y : {-1, 1})
            corners.emplace_back(Vector3d::UnitZ(), Vector3d(x, y, -0.5));
    const AdmissibleTwist found = admissible_twist(touching(corners), unit_metric, twist({3, 1, -2}));
    EXPECT_NEAR((found.twist - twist({3, 1, 0})).norm(), 0, 1e-14);
    EXPECT_NEAR(found.multipliers.sum(), 2, 1e-14);
    EXPECT_NEAR((found.wrench - twist({0, 0, 2})).norm(), 0, 1e-14);
}

/// Four corners in one plane, of which any two opposite ones nearly do: the third one lacks a billionth.
TEST(AdmissibleTwist, ARowThatLacksABillionthHolds) {
    std::vector<std::pair<Vector3d, Vector3d>> corners;
    for (const double x : {-0.5, 0.5})
        for (const double y : {-0.5, 0.5})
            corners.emplace_back(Vector3d::UnitZ(), Vector3d(x, y, -0.5));
    Metric metric = unit_metric;
    metric.bottomRightCorner<3, 3>() /= 6;
    const Twist wish = twist({-0.4, 0, -0.3}, {0.21213203297663522, 0.21213203573529316, -1e-8});
    const AdmissibleTwist found = admissible_twist(touching(corners), metric, wish);
    EXPECT_NEAR((found.twist - twist({-0.4, 0, 0}, {0, 0, -1e-8})).norm(), 0, 1e-14);
}

TEST(AdmissibleTwist, AGapMayBeUsedUpAndNotMore) {
    TwistConstraints floor = touching({{Vector3d::UnitZ(), Vector3d::Zero()}});
    floor.gaps[0] = 0.5;
    const AdmissibleTwist found = admissible_twist(floor, unit_metric, twist({1, 0, -2}));
    EXPECT_NEAR((found.twist - twist({1, 0, -0.5})).norm(), 0, 1e-14);
    EXPECT_NEAR(found.multipliers[0], 1.5, 1e-14);
}

TEST(AdmissibleTwist, AWedgeLeavesItsEdge) {
    for (const double half_angle : {1.0, 0.1, 1e-3, 1e-6}) {
        const double sine = std::sin(half_angle), cosine = std::cos(half_angle);
        const TwistConstraints wedge =
            touching({{Vector3d(cosine, 0, sine), Vector3d::Zero()}, {Vector3d(-cosine, 0, sine), Vector3d::Zero()}});
        const AdmissibleTwist into = admissible_twist(wedge, unit_metric, twist({0, 1, -1}));
        EXPECT_NEAR((into.twist - twist({0, 1, 0})).norm(), 0, 1e-9) << half_angle;
        EXPECT_NEAR(into.multipliers[0] * sine, 0.5, 1e-6) << half_angle;
        const AdmissibleTwist out = admissible_twist(wedge, unit_metric, twist({0.1 * sine, 1, 1}));
        EXPECT_NEAR((out.twist - twist({0.1 * sine, 1, 1})).norm(), 0, 1e-14) << half_angle;
    }
}

TEST(AdmissibleTwist, OppositeWallsLeaveTheirPlane) {
    const TwistConstraints slot =
        touching({{Vector3d::UnitX(), Vector3d::Zero()}, {-Vector3d::UnitX(), Vector3d::Zero()}});
    const AdmissibleTwist found = admissible_twist(slot, unit_metric, twist({-2, 1, 1}));
    EXPECT_NEAR((found.twist - twist({0, 1, 1})).norm(), 0, 1e-14);
    EXPECT_NEAR(found.multipliers[0] - found.multipliers[1], 2, 1e-13);
}

TEST(AdmissibleTwist, ACornerHoldsWhatPressesIntoIt) {
    const TwistConstraints corner = touching({{Vector3d::UnitX(), Vector3d::Zero()},
                                              {Vector3d::UnitY(), Vector3d::Zero()},
                                              {Vector3d::UnitZ(), Vector3d::Zero()}});
    const AdmissibleTwist found = admissible_twist(corner, unit_metric, twist({-1, -2, -3}));
    EXPECT_NEAR(found.twist.norm(), 0, 1e-14);
    EXPECT_NEAR((found.multipliers - Vector3d(1, 2, 3)).norm(), 0, 1e-13);
}

TEST(AdmissibleTwist, HeavyDirectionsYieldLess) {
    Metric metric = unit_metric;
    metric.diagonal() << 1, 1, 1, 4, 4, 4;
    const TwistConstraints tip = touching({{Vector3d::UnitZ(), Vector3d::UnitX()}});
    // row (0, 0, 1, 0, -1, 0): the push p changes v_z by p and w_y by -p / 4, until v_z - w_y = 0
    const AdmissibleTwist found = admissible_twist(tip, metric, twist({0, 0, -1}));
    EXPECT_NEAR((found.twist - twist({0, 0, -0.2}, {0, -0.2, 0})).norm(), 0, 1e-14);
    EXPECT_NEAR(found.multipliers[0], 0.8, 1e-14);
}

struct Problem {
    TwistConstraints constraints;
    Metric metric;
    Twist wish;
};

/// Contacts at random, in few directions (duplicate and opposite ones), in wedges that are nearly closed, or with one
/// line of points.
Problem random_problem(std::mt19937& random, int most_rows) {
    const auto integer = [&](int from, int to) { return std::uniform_int_distribution(from, to)(random); };
    std::normal_distribution<double> normal;
    const auto vector = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
    const int kind = integer(0, 3);
    const Vector3d axis = vector().normalized();
    std::vector<std::pair<Vector3d, Vector3d>> contacts;
    for (int i = integer(1, most_rows); i > 0; --i) {
        Vector3d direction = vector().normalized();
        if (kind == 1)
            direction = Vector3d::Unit(integer(0, 2)) * (integer(0, 1) ? 1 : -1);
        else if (kind == 2)
            direction = (axis * (integer(0, 1) ? 1 : -1) + 1e-3 * direction).normalized();
        Vector3d point = vector();
        if (kind == 1)
            point = Vector3d(integer(-1, 1), integer(-1, 1), integer(-1, 1));
        else if (kind == 3)
            point = axis * normal(random);
        contacts.emplace_back(direction, point);
    }
    Problem problem{touching(contacts), Metric::Zero(), twist(vector(), vector())};
    for (double& gap : problem.constraints.gaps)
        gap = integer(0, 1) ? 0 : std::abs(normal(random));
    const Eigen::MatrixXd root = Eigen::MatrixXd::Random(6, 6);
    problem.metric = root * root.transpose() + 0.1 * unit_metric;
    return problem;
}

double norm(const Metric& metric, const Twist& v) {
    return std::sqrt(v.dot(metric * v));
}

/// How much multipliers magnify errors.
double scale_of(const AdmissibleTwist& found, const Twist& wish) {
    return wish.norm() + (found.multipliers.size() > 0 ? found.multipliers.maxCoeff() : 0);
}

TEST(AdmissibleTwist, HoldsTheConditionsOfOptimality) {
    std::mt19937 random(3);
    std::srand(3); // NOLINT: Eigen's Random
    int pushed = 0, at_rest = 0;
    for (int round = 0; round < 20000; ++round) {
        const auto [constraints, metric, wish] = random_problem(random, 30);
        const AdmissibleTwist found = admissible_twist(constraints, metric, wish);
        const double scale = scale_of(found, wish);
        EXPECT_LE(norm(metric, found.twist), norm(metric, wish) * (1 + 1e-12)) << round;
        const Twist balance = metric * (found.twist - wish) - constraints.rows.transpose() * found.multipliers;
        EXPECT_LE(balance.norm(), 1e-9 * scale * metric.norm()) << round;
        EXPECT_LE((constraints.rows.transpose() * found.multipliers - found.wrench).norm(), 1e-12 * scale);
        for (Eigen::Index i = 0; i < constraints.gaps.size(); ++i) {
            const double left = constraints.rows.row(i).dot(found.twist) + constraints.gaps[i];
            EXPECT_GE(left, -1e-10 * wish.norm() * constraints.rows.row(i).norm()) << round << ' ' << i;
            EXPECT_GE(found.multipliers[i], 0) << round;
            EXPECT_LE(std::min(left, found.multipliers[i]), 1e-8 * scale) << round << ' ' << i;
            pushed += found.multipliers[i] > 0;
        }
        at_rest += found.twist.norm() < 1e-9;
    }
    EXPECT_GT(pushed, 30000);
    EXPECT_GT(at_rest, 500);
}

/// The least distance of the wish from a twist that is admissible, over all sets of rows that may hold with equality.
double least_distance(const Problem& problem) {
    const auto& [constraints, metric, wish] = problem;
    double least = norm(metric, wish); // at rest
    for (unsigned set = 0; set < 1U << constraints.gaps.size(); ++set) {
        const int count = std::popcount(set);
        if (count > 6)
            continue;
        Eigen::MatrixXd system = Eigen::MatrixXd::Zero(6 + count, 6 + count);
        Eigen::VectorXd right(6 + count);
        system.topLeftCorner<6, 6>() = metric;
        right.head<6>() = metric * wish;
        for (int i = 0, k = 6; i < constraints.gaps.size(); ++i)
            if (set >> i & 1) {
                system.row(k).head<6>() = constraints.rows.row(i);
                system.col(k).head<6>() = constraints.rows.row(i).transpose();
                right[k++] = -constraints.gaps[i];
            }
        const Twist twist = system.fullPivLu().solve(right).head<6>();
        if ((constraints.rows * twist + constraints.gaps).minCoeff() >= -1e-9)
            least = std::min(least, norm(metric, twist - wish));
    }
    return least;
}

TEST(AdmissibleTwist, NoActiveSetIsNearerToTheWish) {
    std::mt19937 random(4);
    std::srand(4); // NOLINT: Eigen's Random
    for (int round = 0; round < 2000; ++round) {
        const Problem problem = random_problem(random, 8);
        const AdmissibleTwist found = admissible_twist(problem.constraints, problem.metric, problem.wish);
        const double distance = norm(problem.metric, found.twist - problem.wish);
        EXPECT_NEAR(distance, least_distance(problem), 1e-7 * scale_of(found, problem.wish)) << round;
    }
}

} // namespace
} // namespace chasles::test
