// The bound on the deviation of paths from their chords holds in exact rationals and is nearly reached.
#include "chasles/motion/chord_deviation.h"

#include "tests/support/error_ratios.h"
#include "tests/support/posed_motions.h"
#include "tests/support/trajectories.h"

namespace chasles::motion {
namespace {

using namespace test;

using Position = Eigen::Vector3d;

/// The position of a point at tau in the frame of the other body, in double precision.
Position position(const ControlMaps<DoubleDouble>& maps, const Eigen::Vector3d& point, double tau, bool body_moves) {
    const Vector3<DoubleDouble> p{DoubleDouble(point.x()), DoubleDouble(point.y()), DoubleDouble(point.z())};
    const auto path =
        body_moves ? maps.rotation * p + maps.translation : maps.rotation.transposed() * p - maps.inverse_translation;
    const DoubleDouble weight = value_at(maps.weight, DoubleDouble(tau));
    Position result;
    for (int i = 0; i < 3; ++i)
        result[i] = double(value_at(path[i], DoubleDouble(tau)) / weight);
    return result;
}

Eigen::Vector3d random_point(Random& random, const Ball& ball) {
    return ball.centre + ball.radius * eigen(random.vector(1)).normalized();
}

/// A moving point and a fixed point that coincide at some tau, each in the bounding sphere of its body.
TEST(ChordDeviation, BoundsHowFarPathsThatMeetLeaveTheirChords) {
    Random random(741);
    ErrorRatios ratios;
    for (int trial = 0; trial < 2000; ++trial) {
        const double size = std::abs(random.scaled(-3, 3));
        const PosedMotion posed = random_posed_motion(random, size);
        const ControlMaps<DoubleDouble> maps = control_maps(posed.made);
        const Ball moving{eigen(random.vector(size)), size * random.uniform(0, 1)};
        const double width = std::ldexp(1.0, -random.integer(0, 8));
        const double from = width * random.integer(0, int(1 / width) - 1);
        const Eigen::Vector3d moving_point = random_point(random, moving);
        const Eigen::Vector3d fixed_point = position(maps, moving_point, from + width * random.uniform(0, 1), true);
        const double away = random.chance(0.3) ? 100 * size : size * random.uniform(0, 1);
        const Eigen::Vector3d centre = fixed_point + away * eigen(random.vector(1)).normalized();
        const ChordDeviation bend(posed.made, moving, {centre, (centre - fixed_point).norm() * (1 + 1e-12)});
        for (const bool body_moves : {true, false}) {
            const double bound = body_moves ? bend.of_moving(from, from + width) : bend.of_fixed(from, from + width);
            const Eigen::Vector3d& point = body_moves ? moving_point : fixed_point;
            const Position start = position(maps, point, from, body_moves);
            const Position end = position(maps, point, from + width, body_moves);
            const double rounding = 1e-15 * (start.norm() + end.norm() + point.norm() + size);
            for (int i = 1; i < 8; ++i) {
                const Position there = position(maps, point, from + width * i / 8, body_moves);
                const double off = (there - start - double(i) / 8 * (end - start)).norm();
                ASSERT_LE(off, bound + rounding) << "seed 741, trial " << trial << ", moving " << body_moves;
                if (bound > 1e3 * rounding)
                    ratios.note(body_moves ? "moving points" : "fixed points", (off - rounding) / bound);
            }
        }
    }
    ratios.expect_sound(0.7);
}

/// The deviation in a large room depends only on the body that moves in it.
TEST(ChordDeviation, IsThatOfTheSmallerBall) {
    const Pose turned({0, 0, 0}, Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ())));
    const auto motion = cubic_of(ScrewMotion::between(Pose(), turned));
    const Ball small{{1, 0, 0}, 0.5};
    const Ball large{{0, 0, 0}, 1000};
    EXPECT_EQ(ChordDeviation(motion, small, large).of_fixed(0, 1),
              ChordDeviation(motion, small, small).of_moving(0, 1));
    EXPECT_EQ(ChordDeviation(motion, large, small).of_moving(0, 1),
              ChordDeviation(motion, small, small).of_fixed(0, 1));
}

TEST(ChordDeviation, IsNothingForTranslations) {
    const ScrewMotion straight = ScrewMotion::between(Pose(), Pose({1, 2, 3}, Eigen::Quaterniond::Identity()));
    const ChordDeviation bend(cubic_of(straight), {{1, 1, 1}, 5}, {{0, 0, 0}, 7});
    EXPECT_EQ(bend.of_moving(0, 1), 0);
    EXPECT_EQ(bend.of_fixed(0, 1), 0);
}

/// A quarter of the interval gives a sixteenth of the deviation.
TEST(ChordDeviation, FallsWithTheSquareOfTheInterval) {
    const Pose turned({0, 0, 0}, Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ())));
    const ChordDeviation bend(cubic_of(ScrewMotion::between(Pose(), turned)), {{1, 0, 0}, 0.5}, {{1, 0, 0}, 0.5});
    EXPECT_NEAR(bend.of_moving(0, 0.25) * 16 / bend.of_moving(0, 1), 1, 1e-12);
    EXPECT_NEAR(bend.of_moving(0, 1), 1.5 * 0.2 * 0.2 / 8, 1e-3); // radius times angle squared, over 8
}

} // namespace
} // namespace chasles::motion
