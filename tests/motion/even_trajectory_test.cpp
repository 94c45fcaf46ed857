// Constant velocity and constant twist follow their definitions, which the tests evaluate in a hundred digits.
#include "chasles/motion/even_trajectory.h"

#include "chasles/base/invalid_input.h"
#include "chasles/motion/motion.h"
#include "tests/support/long_poses.h"
#include "tests/support/random_poses.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

using motion::EvenTrajectory;
using motion::MotionEnds;
using Wide = algebra::DoubleDouble;

struct EvenCase {
    Pose start;
    Pose goal;
    Eigen::Vector3d centre;

    [[nodiscard]] EvenTrajectory trajectory(EvenTrajectory::Kind kind) const {
        return {kind, MotionEnds::between(start, goal), centre};
    }
    [[nodiscard]] LongVector place(EvenTrajectory::Kind kind, const Eigen::Vector3d& point, const Digits& time) const {
        return kind == EvenTrajectory::Kind::velocity ? at_constant_velocity(start, goal, centre, point, time)
                                                      : at_constant_twist(start, goal, point, time);
    }
};

/// Turns of all sizes, from none to nearly a half turn. Quaternions have different lengths.
EvenCase random_case(Random& random) {
    const Pose start = random_pose(random, 2);
    const double turn = random.chance(0.05) ? 0 : std::min(3.14, std::pow(10, random.uniform(-9, 0.6)));
    EvenCase made{start, random_goal(random, start, turn, 3), random_point(random, 2)};
    if (random.chance(0.5))
        made.goal.rotation.coeffs() *= std::ldexp(1.0, int(random.uniform(-40, 40)));
    return made;
}

template <class S>
LongVector placed(const motion::GeneralPose<S>& pose, const Eigen::Vector3d& point) {
    const auto digits = [](const S& number) {
        if constexpr (std::is_same_v<S, double>)
            return Digits(number);
        else
            return Digits(number.high()) + Digits(number.low());
    };
    const auto vector = [&](const motion::Vector3<S>& v) { return LongVector(digits(v.x), digits(v.y), digits(v.z)); };
    const Digits w = digits(pose.rotation.w);
    const LongVector v = vector(pose.rotation.v), x(point);
    const Digits norm = w * w + dot(v, v);
    return x + (2 / norm) * (w * cross(v, x) + cross(v, cross(v, x))) + vector(pose.translation);
}

class EvenMotions : public testing::TestWithParam<EvenTrajectory::Kind> {};

TEST_P(EvenMotions, FollowTheirDefinitionToWithinAQuarterOfTheRounding) {
    Random random(1811);
    double in_double = 0, in_wide = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const EvenCase test = random_case(random);
        const motion::SharedFrame made = test.trajectory(GetParam()).frame();
        const motion::MovingFrame& frame = *made;
        const Eigen::Vector3d point = random_point(random, 1);
        const double time = std::clamp(random.uniform(-0.2, 1.2), 0.0, 1.0); // often an end
        const LongVector truth = test.place(GetParam(), point, Digits(time));
        const double size = frame.size() + 2 * point.lpNorm<1>();
        in_double = std::max(in_double, double((placed(frame.at(time), point) - truth).norm()) / size);
        in_wide = std::max(in_wide, double((placed(frame.refined_at(Wide(time)), point) - truth).norm()) / size);
    }
    std::cout << "errors: 2^" << std::log2(in_double) << " in double, 2^" << std::log2(in_wide)
              << " in double-double\n";
    EXPECT_LE(in_double, motion::pose_rounding<double> / 4);
    EXPECT_LE(in_wide, motion::pose_rounding<Wide> / 4);
}

TEST_P(EvenMotions, KeepBothEndPoses) {
    Random random(1812);
    for (int trial = 0; trial < 50; ++trial) {
        const EvenCase test = random_case(random);
        const EvenTrajectory trajectory = test.trajectory(GetParam());
        EXPECT_TRUE(trajectory.pose_at(0).isometry().isApprox(test.start.isometry(), 1e-15));
        EXPECT_TRUE(trajectory.pose_at(1).isometry().isApprox(test.goal.isometry(), 1e-15));
        EXPECT_TRUE(trajectory.pose_at(1e-14).isometry().isApprox(test.start.isometry(), 1e-12));
        EXPECT_TRUE(trajectory.pose_at(1 - 1e-14).isometry().isApprox(test.goal.isometry(), 1e-12));
    }
}

/// No point of the body leaves its place in any part by more than the bound, in double and in double-double. The truth
/// is in a hundred digits.
TEST_P(EvenMotions, EveryPartEnclosesTheTrueMotion) {
    Random random(1813);
    double in_double = 0, in_wide = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const EvenCase test = random_case(random);
        const auto pieces = test.trajectory(GetParam()).pieces();
        const auto index = static_cast<std::size_t>(random.integer(0, int(pieces.size()) - 1));
        const motion::SmoothPiece piece = pieces[index];
        const double lower = random.uniform(0, 1);
        const double upper = std::min(1.0, lower + std::pow(10, random.uniform(-9, 0)));
        const Eigen::Vector3d point = random_point(random, 1);
        const double share = random.uniform(0, 1);
        const auto& [from, to] = piece.times();
        const Digits at =
            Digits(from) + (Digits(lower) + Digits(share) * (Digits(upper) - lower)) * (Digits(to) - Digits(from));
        const LongVector truth = test.place(GetParam(), point, at);
        const auto ratio = [&](const auto& enclosure) {
            const motion::RationalMotion<Wide> cubic = [&] {
                if constexpr (std::is_same_v<decltype(enclosure.cubic.end_cosine), double>)
                    return widened(enclosure.cubic);
                else
                    return enclosure.cubic;
            }();
            const auto maps = motion::control_maps(cubic);
            const auto path = maps.rotation * motion::vector_in<Wide>(point) + maps.translation;
            const Wide weight = value_at(maps.weight, Wide(share));
            const auto digits = [&](const auto& p) {
                const Wide value = value_at(p, Wide(share)) / weight;
                return Digits(value.high()) + Digits(value.low());
            };
            const LongVector there(digits(path.x), digits(path.y), digits(path.z));
            return double((there - truth).norm()) / enclosure.bounds.deviation_of({point, 0});
        };
        in_double = std::max(in_double, ratio(*piece.enclosure({lower, upper})));
        in_wide = std::max(in_wide, ratio(*piece.refined_enclosure({lower, upper})));
    }
    std::cout << "at most " << in_double << " of the bound in double, " << in_wide << " in double-double\n";
    EXPECT_LE(in_double, 1);
    EXPECT_LE(in_wide, 1);
    EXPECT_GT(in_wide, 0.3) << "the bound is far too wide";
}

TEST_P(EvenMotions, TheBallHoldsThePathOfItsPointAndTheCoarseMotionIsNear) {
    Random random(1814);
    int coarse_motions = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const EvenCase test = random_case(random);
        const EvenTrajectory trajectory = test.trajectory(GetParam());
        const Eigen::Vector3d point = random_point(random, 2);
        const motion::PathBall ball = trajectory.ball_around_path(motion::vector_in<double>(point));
        const auto coarse = trajectory.coarse();
        coarse_motions += coarse ? 1 : 0;
        for (int k = 0; k <= 16; ++k) {
            const Eigen::Vector3d truth = trajectory.pose_at(k / 16.0).isometry() * point;
            const Eigen::Vector3d centre(ball.centre.x, ball.centre.y, ball.centre.z);
            EXPECT_LE((truth - centre).norm(), ball.radius + 1e-13 * ball.size);
            if (!coarse)
                continue;
            const auto there = position_at(coarse->path, k / 16.0)(motion::vector_in<double>(point));
            const double arm = length(motion::vector_in<double>(point) - coarse->reference);
            EXPECT_LE((truth - Eigen::Vector3d(there.x, there.y, there.z)).norm(),
                      coarse->deviation + coarse->turn_deviation * arm +
                          motion::coarse_rounding * (coarse->size + point.lpNorm<1>()));
        }
    }
    EXPECT_GT(coarse_motions, 100);
}

INSTANTIATE_TEST_SUITE_P(Kinds, EvenMotions,
                         testing::Values(EvenTrajectory::Kind::velocity, EvenTrajectory::Kind::twist),
                         [](const auto& kind) {
                             return kind.param == EvenTrajectory::Kind::velocity ? "velocity" : "twist";
                         });

TEST(ConstantVelocity, TellsItsNumbers) {
    const Pose start({1, 2, 3}, Eigen::Quaterniond::Identity());
    const Pose goal({4, 2, 3}, Eigen::Quaterniond(Eigen::AngleAxisd(1.5, Eigen::Vector3d::UnitZ())));
    const auto motion = ConstantVelocity::between(start, goal, {1, 0, 0});
    EXPECT_NEAR(motion.angle(), 1.5, 1e-15);
    const Eigen::Vector3d centre = Eigen::AngleAxisd(1.5, Eigen::Vector3d::UnitZ()) * Eigen::Vector3d::UnitX();
    EXPECT_TRUE(motion.displacement().isApprox(Eigen::Vector3d(2, 0, 0) + centre, 1e-14));
    EXPECT_EQ(motion.centre(), Eigen::Vector3d(1, 0, 0));
    const Eigen::Vector3d middle = motion.pose_at(0.5).isometry() * Eigen::Vector3d(1, 0, 0);
    EXPECT_TRUE(middle.isApprox(Eigen::Vector3d(2, 2, 3) + 0.5 * motion.displacement(), 1e-14));
}

TEST(ConstantVelocity, ThatDoesNotTurnIsASweep) {
    const Pose start({1, 2, 3}, Eigen::Quaterniond(2, 1, 0, 0)), goal({4, 2, 3}, Eigen::Quaterniond(4, 2, 0, 0));
    for (const Motion& motion : {Motion::velocity(start, goal, {7, 8, 9}), Motion::twist(start, goal)}) {
        const auto pieces = motion.trajectory().pieces();
        ASSERT_EQ(pieces->size(), 1u);
        EXPECT_FALSE(pieces->at(0)->enclosure({0, 1})) << "it is exact";
        EXPECT_TRUE(pieces->at(0)->exact());
    }
    const Pose barely({4, 2, 3}, Eigen::Quaterniond(4, 2, 1e-13, 0));
    EXPECT_TRUE(Motion::velocity(start, barely).trajectory().pieces()->at(0)->enclosure({0, 1}));
}

TEST(ConstantTwist, HasTheAxisOfTheScrew) {
    Random random(1815);
    for (int trial = 0; trial < 50; ++trial) {
        const EvenCase test = random_case(random);
        const auto twist = ConstantTwist::between(test.start, test.goal);
        const ScrewMotion screw = twist.screw_of_same_poses();
        if (screw.angle() < 0.1)
            continue;
        const Eigen::Vector3d on_axis = test.start.isometry().inverse() * screw.axis_point();
        for (const double time : {0.25, 0.5, 0.9}) {
            const Eigen::Vector3d there = twist.pose_at(time).isometry() * on_axis;
            EXPECT_TRUE(there.isApprox(screw.axis_point() + time * screw.slide() * screw.axis_direction(), 1e-12));
        }
    }
}

/// Quaternions that differ only by the rounding of their lengths turn in double-double, but not always in double. The
/// axis is then some 1e16 away.
TEST(ConstantTwist, HasOneReferenceInBothPrecisions) {
    Random random(1816);
    int still = 0;
    for (int trial = 0; trial < 100; ++trial) {
        const Pose start = random_pose(random, 2);
        Pose goal = random_pose(random, 2);
        goal.rotation.coeffs() = start.rotation.coeffs() * random.uniform(0.5, 2);
        for (const motion::SharedFrame& frame :
             {motion::twist_frame(start, goal),
              EvenCase{start, goal, {0, 0, 0}}.trajectory(EvenTrajectory::Kind::twist).frame()}) {
            still += frame->rates({0, 1}).turn_rate == 0 ? 1 : 0;
            EXPECT_EQ(norm1(motion::in_double(frame->refined_reference())), norm1(frame->reference()));
        }
    }
    EXPECT_GT(still, 0);
}

TEST(EvenMotion, RefusesACentreThatCannotBeUsed) {
    EXPECT_THROW((void)ConstantVelocity::between(Pose(), Pose(), {NAN, 0, 0}), InvalidInput);
    EXPECT_THROW((void)ConstantVelocity::between(Pose(), Pose(), {0, 1e31, 0}), InvalidInput);
}

} // namespace
} // namespace chasles::test
