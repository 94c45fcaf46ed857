// Tests of the reference: its roots against Sturm's theorem, its motions against the end poses, its answers against
// touches that can be computed by hand.
#include "tests/support/exact_reference.h"

#include "chasles/motion/motion.h"
#include "tests/attack/piecewise_tau.h"
#include "tests/support/algebraic_roots.h"

#include <gtest/gtest.h>
#include <random>

namespace chasles::reference {
namespace {

Coefficients random_polynomial(std::mt19937& random, int degree) {
    Coefficients p{Integer(1)};
    const auto number = [&] { return Integer(int(random() % 7) - 5); };
    for (int i = 0; i < degree; ++i) { // roots on a coarse grid, some of them many times, or none
        const Coefficients factor = random() % 4 == 0 ? Coefficients{number(), number(), Integer(1 + int(random() % 6))}
                                                      : Coefficients{number(), Integer(1 + int(random() % 6))};
        Coefficients product(p.size() + factor.size() - 1, Integer(0));
        for (std::size_t j = 0; j < p.size(); ++j)
            for (std::size_t k = 0; k < factor.size(); ++k)
                product[j + k] += p[j] * factor[k];
        p = product;
    }
    return p;
}

test::PowerPolynomial in_rationals(const Coefficients& p) {
    test::PowerPolynomial result;
    for (const Integer& c : p)
        result.emplace_back(c);
    return result;
}

TEST(ExactReference, RootsAndSignsAgreeWithSturm) {
    std::mt19937 random(901);
    int roots = 0;
    int zeros = 0;
    for (int trial = 0; trial < 400; ++trial) {
        SCOPED_TRACE("seed 901, trial " + std::to_string(trial));
        const Coefficients p = random_polynomial(random, 1 + int(random() % 4));
        const Coefficients q = random_polynomial(random, 1 + int(random() % 3));
        std::vector<Root> found = roots_of(p);
        const std::vector<test::AlgebraicRoot> truth = test::roots_in_unit_interval(in_rationals(p));
        ASSERT_EQ(found.size(), truth.size());
        for (std::size_t i = 0; i < truth.size(); ++i) {
            ++roots;
            const int sign = test::sign_at(in_rationals(q), truth[i]);
            EXPECT_EQ(found[i].sign(q), sign);
            zeros += sign == 0 ? 1 : 0;
            test::AlgebraicRoot narrow = truth[i];
            narrow.narrow_to(Rational(0x1p-58));
            EXPECT_LE(abs(Rational(found[i].narrowed() - narrow.upper)), Rational(0x1p-57));
            for (std::size_t j = 0; j < truth.size(); ++j)
                EXPECT_EQ(compare(found[i], found[j]), i < j ? -1 : i > j ? 1 : 0);
        }
    }
    EXPECT_GT(roots, 300);
    EXPECT_GT(zeros, 10);
}

TEST(ExactReference, TimesOfFirstInstantsAreGoodTo1e18) {
    const Integer denominator(Integer(3) << 57); // tau is 2.3e-18
    const attack::PiecewiseTau first{roots_of({Integer(-1), denominator}).at(0)};
    const MotionPath<Rational> turn = screw_path({}, {{}, {Rational(1), {Rational(0), Rational(0), Rational(40)}}});
    const long double tau = 1 / denominator.convert_to<long double>();
    EXPECT_NEAR(double(first.time(attack::MotionKind::sweep, turn)), double(tau), 1e-24);
    EXPECT_NEAR(double(first.time(attack::MotionKind::screw, turn)), double(40 * tau / std::atan(40.0L)), 1e-24);
}

TEST(ExactReference, RootsOfDifferentPolynomialsAreOrderedExactly) {
    std::mt19937 random(902);
    int equal = 0;
    for (int trial = 0; trial < 400; ++trial) {
        SCOPED_TRACE("seed 902, trial " + std::to_string(trial));
        const Coefficients p = random_polynomial(random, 1 + int(random() % 3));
        const Coefficients q = random_polynomial(random, 1 + int(random() % 3));
        const auto in_p = test::roots_in_unit_interval(in_rationals(p));
        const auto in_q = test::roots_in_unit_interval(in_rationals(q));
        std::vector<Root> a = roots_of(p);
        std::vector<Root> b = roots_of(q);
        for (std::size_t i = 0; i < a.size(); ++i)
            for (std::size_t j = 0; j < b.size(); ++j) {
                test::AlgebraicRoot x = in_p[i];
                test::AlgebraicRoot y = in_q[j];
                x.narrow_to(Rational(0x1p-90));
                y.narrow_to(Rational(0x1p-90));
                const bool apart =
                    x.upper < y.lower || y.upper < x.lower; // small numbers: roots are equal or far apart
                equal += apart ? 0 : 1;
                EXPECT_EQ(compare(a[i], b[j]), !apart ? 0 : x.upper < y.upper ? -1 : 1);
            }
    }
    EXPECT_GT(equal, 10);
}

TEST(ExactReference, DoublesAreComparedExactly) {
    Root third = roots_of({Integer(-1), Integer(3)}).at(0);
    const auto order = [&](double x) {
        Root point = Root::point(x);
        return compare(third, point);
    };
    EXPECT_EQ(order(1.0 / 3), 1) << "the nearest double is below";
    EXPECT_EQ(order(std::nextafter(1.0 / 3, 1)), -1);
    EXPECT_EQ(order(0), 1);
    EXPECT_EQ(order(1), -1);
    EXPECT_EQ(order(1e-300), 1);
    Root half = roots_of({Integer(-1), Integer(2)}).at(0);
    Root point = Root::point(0.5);
    EXPECT_EQ(compare(half, point), 0);
}

Pose random_pose(std::mt19937& random) {
    const auto number = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
    Eigen::Quaterniond q(number(), number(), number(), number());
    return Pose(Eigen::Vector3d(number(), number(), number()), q);
}

Triple position(const MotionPath<Rational>& path, const Triple& b, const Rational& tau) {
    const auto value = [&](const auto& p) {
        Rational result(0);
        for (std::size_t i = p.size(); i-- > 0;)
            result = result * tau + p[i];
        return result;
    };
    Triple result;
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = (value(path.turn[i][0]) * b[0] + value(path.turn[i][1]) * b[1] + value(path.turn[i][2]) * b[2] +
                     value(path.shift[i])) /
                    value(path.weight);
    return result;
}

TEST(ExactReference, MotionsKeepBothEndPosesExactly) {
    std::mt19937 random(903);
    for (int trial = 0; trial < 30; ++trial) {
        ExactPose start = exact_pose(random_pose(random));
        ExactPose goal = exact_pose(random_pose(random));
        const Triple b = exact(random_pose(random).translation);
        const auto expect_ends = [&](const MotionPath<Rational>& path) {
            EXPECT_EQ(position(path, b, 0), start.translation + turned(b, start.rotation));
            EXPECT_EQ(position(path, b, 1), goal.translation + turned(b, goal.rotation));
        };
        expect_ends(screw_path(start, goal));
        start.rotation = start.rotation * start.rotation; // a square has a rational length
        goal.rotation = goal.rotation * goal.rotation;
        expect_ends(sweep_path(start, goal));
        expect_ends(sweep_path(start, goal, exact(random_pose(random).translation)));
    }
}

/// At equal tau the screws of the reference and of the library have the same poses.
TEST(ExactReference, ScrewVisitsThePosesOfTheLibrary) {
    std::mt19937 random(904);
    for (int trial = 0; trial < 30; ++trial) {
        const Pose start = random_pose(random);
        const Pose goal = random_pose(random);
        const ScrewMotion screw = ScrewMotion::between(start, goal);
        const Eigen::Vector3d b = random_pose(random).translation;
        const auto path = screw_path(exact_pose(start), exact_pose(goal));
        for (const double tau : {0.125, 0.5, 0.875}) {
            const Eigen::Vector3d there = screw.pose_at(screw.time_at(tau)).isometry() * b;
            const Triple here = position(path, exact(b), Rational(tau));
            for (std::size_t i = 0; i < 3; ++i)
                EXPECT_NEAR(there[static_cast<Eigen::Index>(i)], static_cast<double>(here[i]), 1e-12);
        }
    }
}

Surface triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const std::vector<Eigen::Vector3d> vertices{a, b, c};
    const std::vector<std::vector<std::uint32_t>> faces{{0, 1, 2}};
    return Surface::from_convex_faces(vertices, faces);
}

MotionPath<Rational> translation(double x, double y, double z) {
    return screw_path({}, {exact(Eigen::Vector3d(x, y, z)), {}});
}

void expect_touch(const Surface& moving, const Surface& fixed, const MotionPath<Rational>& path, double tau) {
    const auto found = ExactScene(moving, fixed, path).first_touch();
    ASSERT_TRUE(found.has_value());
    Root root = *found;
    Root truth = Root::point(tau);
    EXPECT_EQ(compare(root, truth), 0) << root.lower() << " instead of " << tau;
}

TEST(ExactReference, TouchesToldByHand) {
    const Surface floor = triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
    const Surface above = triangle({1, 1, 1}, {1, 2, 3}, {2, 1, 3});
    expect_touch(above, floor, translation(0, 0, -4), 0.25);
    expect_touch(floor, above, translation(0, 0, 4), 0.25);
    expect_touch(above, floor, translation(0, 0, -1), 1);
    EXPECT_FALSE(ExactScene(above, floor, translation(0, 0, -0.999)).first_touch());
    const Surface in_plane = triangle({5, 0, 0}, {6, 1, 0}, {6, -1, 0});
    expect_touch(in_plane, floor, translation(-4, 0, 0), 0.25); // slides in the plane, corner to corner
    expect_touch(floor, in_plane, translation(4, 0, 0), 0.25);
    EXPECT_FALSE(ExactScene(in_plane, floor, translation(0, 1, 0)).first_touch());
    const Surface beside = triangle({1, -2, 0}, {3, -2, 0}, {2, -3, 0}); // edge to edge, parallel, in one plane
    expect_touch(beside, floor, translation(0, 4, 0), 0.5);
    const Surface upright = triangle({1, -2, 1}, {3, -2, 1}, {2, -2, 2}); // an edge comes to lie on an edge
    expect_touch(upright, floor, translation(0, 4, -2), 0.5);
    EXPECT_FALSE(ExactScene(upright, floor, translation(0, 4, 0)).first_touch());
    expect_touch(floor, floor, translation(1, 0, 0), 0);
    expect_touch(triangle({1, 1, -1}, {1, 1, 1}, {5, 5, 1}), floor, translation(0, 0, 9), 0); // an edge goes through
}

TEST(ExactReference, ATurnTouchesAtItsHalfAngleTangent) {
    // A corner at (5, 0, 0) turns about z by a right angle; the wall x = y is met at 45 degrees, tan(22.5 degrees).
    const Surface arm = triangle({5, 0, 0}, {4, -1, 1}, {4, -1, -1});
    const Surface wall = triangle({0, 0, -20}, {0, 0, 20}, {20, 20, 0});
    ExactPose goal;
    goal.rotation = {Rational(1), {Rational(0), Rational(0), Rational(1)}};
    const auto found = ExactScene(arm, wall, screw_path({}, goal)).first_touch();
    ASSERT_TRUE(found.has_value());
    Root root = *found;
    Root truth = roots_of({Integer(-1), Integer(2), Integer(1)}).at(0); // tau^2 + 2 tau - 1
    EXPECT_EQ(compare(root, truth), 0);
    // A corner's circle touches the plane x = 5 from inside: a double root.
    const Surface corner = triangle({3, -4, 0}, {2, -3, 1}, {2, -3, -1});
    const Surface tangent = triangle({5, -20, -20}, {5, 20, -20}, {5, 0, 40});
    expect_touch(corner, tangent, screw_path({}, goal), 0.5);
}

} // namespace
} // namespace chasles::reference
