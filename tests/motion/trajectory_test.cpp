// The seam between motions and searches: what a trajectory states holds, for the motions of the library and for one
// that the library does not know.
#include "chasles/motion/control_maps.h"
#include "chasles/motion/screw_trajectory.h"
#include "tests/support/even_turn_motion.h"
#include "tests/support/random_poses.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

static_assert(motion::Trajectory<EvenTurnMotion>);
static_assert(motion::Trajectory<motion::ScrewTrajectory>);
static_assert(motion::Trajectory<motion::SweepTrajectory>);
static_assert(!motion::Trajectory<EvenTurn>);

using Wide = algebra::DoubleDouble;

/// Where a cubic motion has a body point, in the frame of the fixed body.
Eigen::Vector3d carried(const motion::RationalMotion<double>& cubic, const Eigen::Vector3d& point, double tau) {
    const auto maps = motion::control_maps(widened(cubic));
    const auto path = maps.rotation * motion::vector_in<Wide>(point) + maps.translation;
    const Wide weight = value_at(maps.weight, Wide(tau));
    return {double(value_at(path.x, Wide(tau)) / weight), double(value_at(path.y, Wide(tau)) / weight),
            double(value_at(path.z, Wide(tau)) / weight)};
}

/// From one to six pieces of any lengths.
std::vector<double> random_ends(Random& random) {
    std::vector<double> ends{1};
    for (int i = random.integer(0, 5); i > 0; --i)
        ends.push_back(random.uniform(0.01, 0.99));
    std::ranges::sort(ends);
    return ends;
}

constexpr double radius = 2;

EvenTurnMotion random_motion(Random& random) {
    const Pose start = random_pose(random, 3);
    return {{start, random_goal(random, start, random.uniform(0, 3), 3)}, random_ends(random)};
}

template <class Visit>
void for_each_piece(const Motion& motion, Visit visit) {
    const auto pieces = motion.trajectory().pieces();
    for (std::size_t i = 0; i < pieces->size(); ++i)
        visit(*pieces->at(i), i);
}

TEST(Trajectory, NoPointLeavesItsPlaceInAPartByMoreThanTheDeviation) {
    Random random(791);
    double greatest = 0; // of the distance over the deviation
    for (int trial = 0; trial < 200; ++trial) {
        for_each_piece(motion_of(random_motion(random)), [&](const motion::AnyPiece& piece, std::size_t /*index*/) {
            const Eigen::Vector3d point = radius * random_point(random, 1).normalized();
            double lower = random.uniform(0, 1), upper = random.uniform(0, 1);
            if (lower > upper)
                std::swap(lower, upper);
            const auto enclosure = *piece.enclosure({lower, upper});
            const double deviation = enclosure.bounds.deviation_of({point, 0});
            for (int k = 0; k <= 8; ++k) {
                const double share = k / 8.0;
                const Eigen::Vector3d truth = piece.pose_at(lower + share * (upper - lower)).isometry() * point;
                const double distance = (carried(enclosure.cubic, point, share) - truth).norm();
                ASSERT_LE(distance, deviation) << "trial " << trial << ", share " << share;
                greatest = std::max(greatest, distance / deviation);
            }
        });
    }
    std::cout << "at most " << greatest << " of the deviation\n";
}

TEST(Trajectory, PiecesJoinWithoutAGapInTimeAndPose) {
    Random random(792);
    for (int trial = 0; trial < 50; ++trial) {
        const Motion motion = motion_of(random_motion(random));
        const auto pieces = motion.trajectory().pieces();
        EXPECT_EQ(pieces->at(0)->time_of({0, 0}).lower, 0);
        EXPECT_EQ(pieces->at(pieces->size() - 1)->time_of({1, 1}).upper, 1);
        for (std::size_t i = 0; i + 1 < pieces->size(); ++i) {
            const auto before = pieces->at(i);
            const auto after = pieces->at(i + 1);
            EXPECT_TRUE(before->pose_at(1).isometry().matrix() == after->pose_at(0).isometry().matrix());
            const Bracket end = before->time_of({1, 1});
            const Bracket start = after->time_of({0, 0});
            EXPECT_EQ(end.lower, start.lower);
            EXPECT_EQ(end.upper, start.upper);
        }
    }
}

TEST(Trajectory, ThePieceTellsTheTimeOfTheWholeMotion) {
    Random random(793);
    for (int trial = 0; trial < 50; ++trial) {
        const EvenTurnMotion trajectory = random_motion(random);
        const Motion motion = motion_of(trajectory);
        for_each_piece(motion, [&](const motion::AnyPiece& piece, std::size_t index) {
            const double tau = random.uniform(0, 1);
            const Bracket time = piece.time_of({tau, tau});
            EXPECT_LE(time.lower, trajectory.piece(index).time_at(tau));
            EXPECT_GE(time.upper, trajectory.piece(index).time_at(tau));
            EXPECT_TRUE(motion.pose_at(time.lower).isometry().isApprox(piece.pose_at(tau).isometry(), 1e-13));
            const double step = 1e-6;
            const Bracket later = piece.time_of({tau + step, tau + step});
            EXPECT_NEAR(step / (later.lower - time.lower), piece.tau_rate(tau), 1e-6 * piece.tau_rate(tau));
            EXPECT_LE(piece.time_of({tau, tau + piece.tau_tolerance(1e-3)}).upper - time.lower, 1e-3 * (1 + 1e-9));
        });
    }
}

TEST(Trajectory, TheBallHoldsThePathOfItsPoint) {
    Random random(794);
    for (int trial = 0; trial < 100; ++trial) {
        const Motion motion = motion_of(random_motion(random));
        const Eigen::Vector3d point = random_point(random, radius);
        const motion::PathBall ball = motion.trajectory().ball_around_path(motion::vector_in<double>(point));
        const Eigen::Vector3d centre(ball.centre.x, ball.centre.y, ball.centre.z);
        for (int k = 0; k <= 32; ++k)
            EXPECT_LE((motion.pose_at(k / 32.0).isometry() * point - centre).norm(), ball.radius + 1e-13 * ball.size);
    }
}

TEST(Trajectory, WithoutExactMapsThereAreNone) {
    Random random(795);
    const Motion even = motion_of(random_motion(random));
    EXPECT_FALSE(even.trajectory().pieces()->at(0)->exact());
    EXPECT_TRUE(even.trajectory().pieces()->at(0)->enclosure({0, 1}));
    const Motion sweep = Motion::sweep(random_pose(random, 1), random_pose(random, 1));
    EXPECT_TRUE(sweep.trajectory().pieces()->at(0)->exact());
    EXPECT_FALSE(sweep.trajectory().pieces()->at(0)->enclosure({0, 1}));
}

} // namespace
} // namespace chasles::test
