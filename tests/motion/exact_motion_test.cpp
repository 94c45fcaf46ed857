// The exact control maps against the definition of the motions in rationals, for any poses.
#include "chasles/motion/exact_motion.h"

#include "chasles/motion/motion.h"
#include "tests/support/exact_numbers.h"
#include "tests/support/posed_motions.h"
#include "tests/support/random_poses.h"
#include "tests/support/trajectories.h"

namespace chasles::test {
namespace {

using motion::Quaternion;

/// The value of a number of the maps if its root is the rational `root`.
Rational value(const ExactNumber& x, const Rational& root) {
    return exact(x.rational()) + exact(x.irrational()) * root;
}

void expect_equal(const Bernstein<3, ExactNumber>& p, const Bernstein<3, Rational>& truth, const Rational& unit,
                  const Rational& root) {
    for (int i = 0; i < 4; ++i)
        EXPECT_EQ(value(p[i], root), truth[i] * unit);
}

/// Expects that all maps are the rational maps times one positive factor.
void expect_multiple(const motion::ExactMotion& found, const motion::ControlMaps<Rational>& truth,
                     const Rational& root = 0) {
    const Rational unit = value(found.maps.weight[0], root) / truth.weight[0];
    EXPECT_GT(unit, 0);
    expect_equal(found.maps.weight, truth.weight, unit, root);
    for (int i = 0; i < 3; ++i) {
        expect_equal(found.maps.translation[i], truth.translation[i], unit, root);
        expect_equal(found.maps.inverse_translation[i], truth.inverse_translation[i], unit, root);
        for (int j = 0; j < 3; ++j) {
            expect_equal(found.maps.rotation.row[i][j], truth.rotation.row[i][j], unit, root);
            expect_equal(found.maps.moment.row[i][j], truth.moment.row[i][j], unit, root);
        }
    }
}

TEST(ExactMotion, ScrewsBetweenAnyPoses) {
    Random random(741);
    for (int trial = 0; trial < 20; ++trial) {
        const Pose start = random_pose(random, 3);
        const Pose goal = trial % 4 == 0 ? Pose(random_point(random, 3), start.rotation) : random_pose(random, 3);
        const auto truth = motion::control_maps(motion::screw_between(exact(start), exact(goal)));
        expect_multiple(motion::exact_screw(ScrewMotion::between(start, goal).trajectory().ends()), truth);
    }
}

TEST(ExactMotion, ScrewsOfTwoMovingBodies) {
    Random random(742);
    for (int trial = 0; trial < 10; ++trial) {
        const Pose poses[] = {random_pose(random, 2), random_pose(random, 2), random_pose(random, 2),
                              random_pose(random, 2)};
        const auto start = seen_from(exact(poses[2]), exact(poses[0]));
        const auto goal = seen_from(exact(poses[3]), exact(poses[1]));
        const auto truth = motion::control_maps(motion::screw_between(start, goal));
        const auto screw = ScrewMotion::relative(poses[0], poses[1], poses[2], poses[3]);
        expect_multiple(motion::exact_screw(screw.trajectory().ends()), truth);
    }
}

TEST(ExactMotion, PiecesOfAScrewRunBetweenTheirPoses) {
    Random random(743);
    const Pose start = random_pose(random, 2);
    const Pose goal = random_goal(random, start, 0.5, 1);
    const auto pieces = ScrewMotion::between(start, goal, 0.2).pieces();
    ASSERT_EQ(pieces.size(), 3u);
    for (const ScrewMotion& piece : pieces) {
        const auto truth = motion::control_maps(
            motion::screw_between(exact(piece.trajectory().ends().start), exact(piece.trajectory().ends().goal)));
        expect_multiple(motion::exact_screw(piece.trajectory().ends()), truth);
    }
    EXPECT_EQ(pieces[0].trajectory().ends().goal.translation, pieces[1].trajectory().ends().start.translation);
}

motion::ExactMotion exact_motion_of(const SweepMotion& sweep) {
    return motion::exact_sweep(sweep.trajectory().ends(), sweep.trajectory().centre());
}

/// Quaternions of whole numbers; the turn of the second kind has the norm |start|^2 n, a square.
TEST(ExactMotion, SweepsWhoseQuaternionsHaveRationalLengths) {
    Random random(744);
    const auto whole = [&] { return double(random.integer(-4, 4)); };
    for (int trial = 0; trial < 20; ++trial) {
        const Eigen::Quaterniond start_turn(whole() + 0.5, whole(), whole(), whole());
        const Eigen::Quaterniond step(whole() + 0.5, whole(), whole(), whole()); // its square has the length |step|^2
        const Pose start(random_point(random, 2), start_turn);
        const Pose goal(random_point(random, 2), step * step * start_turn);
        const Eigen::Vector3d centre = random_point(random, 1);
        const auto rational_turn = motion::turn_between(exact(start), exact(goal));
        const Rational norm = Rational(start_turn.squaredNorm()) * Rational(step.squaredNorm());
        ASSERT_EQ(rational_turn.squared_norm(), norm * norm);
        const Quaternion<Rational> unit{rational_turn.w / norm, scale(rational_turn.v, Rational(1 / norm))};
        const auto truth = motion::control_maps(motion::sweep_between(
            exact(start), exact(goal), unit, exact(algebra::Vector3<double>{centre.x(), centre.y(), centre.z()})));
        const auto found = exact_motion_of(SweepMotion::between(start, goal, centre));
        EXPECT_EQ(exact(*found.radicand), norm * norm);
        expect_multiple(found, truth, norm);
    }
}

/// The root is any number whose square is the radicand. The end poses do not depend on the choice of its sign.
TEST(ExactMotion, SweepsEndAtTheirGoalsWhateverTheRoot) {
    Random random(745);
    for (int trial = 0; trial < 10; ++trial) {
        const Pose start = random_pose(random, 2);
        const Pose goal = random_pose(random, 2);
        const auto found = exact_motion_of(SweepMotion::between(start, goal, random_point(random, 1)));
        const auto truth = motion::rotation_matrix(exact(goal).rotation);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) { // turn * denominator = weight * numerator, in the ring
                const Rational entry = truth.row[i][j];
                const ExactNumber left = found.maps.rotation.row[i][j][3] * exact_number(Rational(denominator(entry)));
                const ExactNumber right = found.maps.weight[3] * exact_number(Rational(numerator(entry)));
                EXPECT_EQ(left, right);
            }
    }
}

} // namespace
} // namespace chasles::test
