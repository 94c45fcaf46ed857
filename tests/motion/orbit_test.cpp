// Orbits against the positions of points by Eigen.
#include "chasles/motion/orbit.h"

#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/motion.h"
#include "tests/query/bodies.h"

#include <gtest/gtest.h>
#include <numbers>

namespace chasles::motion {
namespace {

using Eigen::Vector3d;
using test::uniform;

/// Where a point is at a tau, by the definition of the family (note 02).
struct Place {
    double turn;
    Vector3d point;
};

Vector3d eigen(const Vector3<double>& v) {
    return {v.x, v.y, v.z};
}

Place place_of(const RationalMotion<algebra::DoubleDouble>& cubic, const Vector3d& point, double tau) {
    const RationalMotion<double> m = rounded(cubic);
    const double cosine = 1 + tau * (m.end_cosine - 1);
    const Vector3d a = eigen(m.axis);
    const double half = std::atan2(tau * a.norm(), cosine);
    Eigen::Matrix3d orientation;
    for (int i = 0; i < 3; ++i)
        orientation.row(i) = eigen(m.orientation.row[i]).transpose();
    const Vector3d foot = a.cross(eigen(m.moment)) / a.squaredNorm(); // of the axis, from the origin
    const Eigen::AngleAxisd turn(2 * half, a.normalized());
    return {2 * half, eigen(m.origin) + foot + turn * (orientation * point - foot) + tau * eigen(m.displacement)};
}

/// Where the helix has the point.
Vector3d on_helix(const Orbit& orbit, const Vector3d& point, double turn) {
    const Vector3d from = point - eigen(orbit.moving.origin);
    const double x = from.dot(eigen(orbit.moving.across));
    const double y = from.dot(eigen(orbit.moving.beside));
    const double z = from.dot(eigen(orbit.moving.along)) + orbit.pitch * turn;
    return eigen(orbit.fixed.origin) + (std::cos(turn) * x - std::sin(turn) * y) * eigen(orbit.fixed.across) +
           (std::sin(turn) * x + std::cos(turn) * y) * eigen(orbit.fixed.beside) + z * eigen(orbit.fixed.along);
}

/// Returns the greatest distance from the helix as a share of the deviation that is stated.
double check(const Motion& motion, std::mt19937& random) {
    const auto pieces = motion.trajectory().pieces();
    double most = 0;
    for (std::size_t i = 0; i < pieces->size(); ++i) {
        const auto piece = pieces->at(i);
        const auto orbit = orbit_of(piece->cubic(), 1e9);
        if (!orbit) {
            ADD_FAILURE() << "no orbit";
            continue;
        }
        const double end = place_of(piece->cubic(), Vector3d::Zero(), 1).turn;
        EXPECT_NEAR(orbit->turn, end, 1e-13);
        for (int k = 0; k <= 20; ++k) {
            const double tau = k / 20.0;
            const Vector3d point = test::random_vector(random, 2);
            const Place place = place_of(piece->cubic(), point, tau);
            const double off = (place.point - on_helix(*orbit, point, place.turn)).norm();
            EXPECT_LE(off, orbit->deviation + 1e-11) << "tau " << tau;
            EXPECT_LE(std::abs(tau - place.turn / orbit->turn), orbit->unevenness + 1e-14);
            if (orbit->deviation > 1e-9)
                most = std::max(most, off / orbit->deviation);
        }
    }
    return most;
}

TEST(Orbit, BoundsTheWayFromTheHelix) {
    std::mt19937 random(5);
    double screws = 0;
    for (int i = 0; i < 200; ++i) {
        const Pose start = test::random_pose(random, 3, 3);
        const Pose goal = test::random_pose(random, 3, 3);
        screws = std::max(screws, check(ScrewMotion::between(start, goal, 0.1 + 0.01 * i), random));
        check(SweepMotion::between(start, goal, test::random_vector(random, 1)), random);
    }
    EXPECT_GT(screws, 0.3); // not much wider than needed
}

TEST(Orbit, AScrewOfTenDegreesIsNearlyEven) {
    const Motion tenth =
        ScrewMotion::between(Pose(), test::turned({0, 0, 1}, Vector3d::UnitZ(), std::numbers::pi / 18));
    const auto orbit = orbit_of(tenth.trajectory().pieces()->at(0)->cubic(), 1);
    ASSERT_TRUE(orbit);
    EXPECT_LT(orbit->deviation, 0.003); // 0.00098 at most in truth (note 01)
    EXPECT_NEAR(orbit->pitch, 18 / std::numbers::pi, 1e-13);
}

TEST(Orbit, NeedsATurnAboutOneAxis) {
    const auto of = [](const Motion& motion, double most) {
        return orbit_of(motion.trajectory().pieces()->at(0)->cubic(), most).has_value();
    };
    const Pose turned = test::turned({1, 0, 0.5}, Vector3d::UnitZ(), 0.1);
    EXPECT_FALSE(of(ScrewMotion::between(Pose(), test::shifted(1, 0, 0)), 1e9));
    EXPECT_TRUE(of(ScrewMotion::between(Pose(), turned), 1e-3));
    EXPECT_FALSE(of(SweepMotion::between(Pose(), turned, Vector3d::Zero()), 0.99)); // it slides across by 1
    EXPECT_TRUE(of(SweepMotion::between(Pose(), turned, Vector3d::Zero()), 1.01));
}

} // namespace
} // namespace chasles::motion
