// The coarse test never separates bodies that touch, and it separates bodies that are clearly apart.
#include "chasles/culling/clearly_apart.h"

#include "chasles/culling/near_nodes.h"
#include "tests/query/bodies.h"
#include "tests/query/posed_distance.h"
#include "tests/support/even_turn_motion.h"
#include "tests/support/posed_motions.h"
#include "tests/support/random_poses.h"

#include <gtest/gtest.h>

namespace chasles::culling {
namespace {

using namespace test;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Where the search has a body point at a time of the trajectory, in the frame of the fixed body.
Vector3d place_at(const Motion& motion, const Vector3d& point, double time) {
    const auto pieces = motion.trajectory().pieces();
    const double place = time * double(pieces->size());
    const auto index = std::min(std::size_t(place), pieces->size() - 1);
    const auto maps = motion::control_maps(pieces->at(index)->cubic());
    const auto path = maps.rotation * motion::vector_in<DoubleDouble>(point) + maps.translation;
    const DoubleDouble tau(place - double(index));
    const DoubleDouble weight = value_at(maps.weight, tau);
    return {double(value_at(path.x, tau) / weight), double(value_at(path.y, tau) / weight),
            double(value_at(path.z, tau) / weight)};
}

struct Setting {
    double angle = 0;  ///< turn, radians
    double travel = 4; ///< distance of the end poses
    double margin = 0;
    double world = 0;    ///< distance of both bodies from the origin of the world; 0: the fixed body stands still
    double frame = 0;    ///< distance of the moving body from the origin of its frame
    bool slides = false; ///< the way lies in the plane between the bodies, so that only roundings separate them
};

/// The motion passes the origin on a random way. `normal` is that of the plane between the bodies.
Motion random_motion(Random& random, const Setting& setting, const Vector3d& normal, const Vector3d& centre) {
    const Vector3d any = random_point(random, 1).normalized();
    const Vector3d way = setting.travel * (setting.slides ? Vector3d(normal.cross(any)) : any).normalized();
    const Pose start(-0.5 * way + random_point(random, 0.3), Quaterniond(random_pose(random, 1).rotation));
    const Vector3d axis = random_point(random, 1).normalized();
    const Pose goal(start.translation + way,
                    Quaterniond(Eigen::AngleAxisd(setting.angle, axis)) * Quaterniond(start.rotation));
    if (setting.frame > 0) {
        const auto moved = [&](const Pose& pose) {
            const Quaterniond turn(pose.rotation.normalized());
            return Pose(pose.translation - turn * centre, turn);
        };
        return Motion::screw(moved(start), moved(goal));
    }
    if (setting.world <= 0)
        return random.chance(0.3) ? Motion::sweep(start, goal, random_point(random, 1)) : Motion::screw(start, goal);
    const Pose frame(random_point(random, setting.world), Quaterniond(random_pose(random, 1).rotation));
    const auto moved = [&](const Pose& pose) { return test::composed(frame, pose); };
    return ScrewMotion::relative(moved(start), moved(goal), frame, frame);
}

/// Two boxes that come within the margin at one time of the motion and are on opposite sides of a plane then.
struct Touch {
    Motion motion;
    Polyhedron moving;
    test::Body fixed;
    Vector3d normal; ///< from the moving box to the fixed box

    static Touch random_touch(Random& random, const Setting& setting) {
        test::Body moving = box({random.uniform(0.2, 0.5), random.uniform(0.2, 0.5), random.uniform(0.2, 0.5)});
        test::Body fixed = box({random.uniform(0.2, 0.5), random.uniform(0.2, 0.5), random.uniform(0.2, 0.5)});
        const Vector3d centre = random_point(random, setting.frame);
        for (Vector3d& vertex : moving.vertices)
            vertex += centre;
        // Along an axis of the fixed box, the test of boxes separates all that does not touch.
        const Vector3d normal =
            random.chance(0.5) ? Vector3d(Vector3d::Unit(random.integer(0, 2))) : random_point(random, 1).normalized();
        const Motion motion = random_motion(random, setting, normal, centre);
        const double time = random.uniform(0.3, 0.7);
        Vertices there;
        for (const Vector3d& vertex : moving.vertices)
            there.push_back(place_at(motion, vertex, time));
        const auto along = [&](const Vector3d& a, const Vector3d& b) { return normal.dot(a) < normal.dot(b); };
        const Vector3d highest = *std::max_element(there.begin(), there.end(), along);
        const Vector3d lowest = *std::min_element(fixed.vertices.begin(), fixed.vertices.end(), along);
        for (Vector3d& vertex : fixed.vertices)
            vertex += highest - lowest + setting.margin * (1 - 1e-6) * normal;
        return {motion, moving.polyhedron(), fixed, normal};
    }
    [[nodiscard]] bool are_apart(double margin, double moved_away = 0) const {
        test::Body body = fixed;
        for (Vector3d& vertex : body.vertices)
            vertex += moved_away * normal;
        return are_clearly_apart(moving.body(), body.polyhedron().body(), motion.trajectory(), margin);
    }
};

/// `least_separated`: of the bodies moved away by twice their size and the margin.
void expect_never_where_bodies_touch(Random& random, const Setting& most, int trials, int least_separated) {
    int separated = 0;
    for (int trial = 0; trial < trials; ++trial) {
        Setting setting = most;
        setting.angle = most.angle * random.uniform(0, 1);
        const Touch touch = Touch::random_touch(random, setting);
        ASSERT_FALSE(touch.are_apart(setting.margin)) << "trial " << trial;
        separated += touch.are_apart(setting.margin, 2 + setting.margin) ? 1 : 0;
    }
    std::cout << separated << " of " << trials << " separated when moved away\n";
    EXPECT_GE(separated, least_separated);
}

TEST(ClearlyApart, NeverWhereBodiesTouchOnACurvedWay) {
    Random random(2101);
    expect_never_where_bodies_touch(random, {.angle = 1.5}, 4000, 1500);
}

/// The slide of a screw in pieces is not the slide of the screw in one piece.
TEST(ClearlyApart, NeverWhereAScrewInPiecesSlidesUnlikeTheCoarseMotion) {
    Random random(2102);
    int differs = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const double angle = random.uniform(0.9, 1.5);
        const Touch touch = Touch::random_touch(random, {.angle = angle, .travel = 12});
        const auto coarse = touch.motion.trajectory().coarse();
        differs += coarse && coarse->deviation > 0.3 ? 1 : 0;
        ASSERT_FALSE(touch.are_apart(0)) << "trial " << trial;
    }
    EXPECT_GT(differs, 300);
}

TEST(ClearlyApart, NeverWhereBodiesComeWithinTheMargin) {
    Random random(2103);
    expect_never_where_bodies_touch(random, {.angle = 1, .margin = 0.3}, 2000, 500);
}

/// Only roundings to single precision could separate them.
TEST(ClearlyApart, NeverWhereBodiesTouchOnAStraightWay) {
    Random random(2104);
    expect_never_where_bodies_touch(random, {.travel = 4, .slides = true}, 4000, 200);
    expect_never_where_bodies_touch(random, {.travel = 3000, .slides = true}, 1000, 200);
}

TEST(ClearlyApart, NeverWhereBodiesTouchFarFromTheWorldsOrigin) {
    Random random(2105);
    expect_never_where_bodies_touch(random, {.world = 1e7}, 1000, 400);
    expect_never_where_bodies_touch(random, {.world = 1e12}, 1000, 0);
}

/// Only roundings of the poses could separate them.
TEST(ClearlyApart, NeverWhereBodiesTouchFarFromTheOriginOfTheirFrame) {
    Random random(2106);
    expect_never_where_bodies_touch(random, {.frame = 1e7, .slides = true}, 1000, 400);
    expect_never_where_bodies_touch(random, {.frame = 1e13, .slides = true}, 2000, 0);
}

TEST(ClearlyApart, SeparatesBodiesWhoseBallsMeet) {
    const Polyhedron body = box({0.5, 0.5, 0.5}).polyhedron();
    const Motion motion = Motion::screw(shifted(1.4, 0, 0), turned({1.4, 0.4, 0}, {1, 1, 0}, 0.5));
    EXPECT_TRUE(are_clearly_apart(body.body(), body.body(), motion.trajectory()));
    EXPECT_FALSE(are_clearly_apart(body.body(), body.body(), motion.trajectory(), 0.6));
    const FirstContact found = first_contact({.moving = body, .fixed = body, .motion = motion});
    EXPECT_EQ(found.verdict, Verdict::clear);
    EXPECT_TRUE(found.certain);
    EXPECT_EQ(found.clear_until, 1);
    EXPECT_EQ(found.work.node_pairs, 0U);
    EXPECT_EQ(found.pose.translation, motion.pose_at(1).translation);
    EXPECT_EQ(found.pose.rotation.coeffs(), motion.pose_at(1).rotation.coeffs());
}

/// A motion without a coarse motion is searched piece by piece.
TEST(ClearlyApart, ProvesNothingWithoutACoarseMotion) {
    const Polyhedron body = box({0.5, 0.5, 0.5}).polyhedron();
    const Pose start = shifted(2, 0, 0);
    const Motion motion = motion_of(EvenTurnMotion({start, shifted(2, 0.1, 0)}, {1}));
    EXPECT_FALSE(are_clearly_apart(body.body(), body.body(), motion.trajectory()));
    EXPECT_EQ(first_contact({.moving = body, .fixed = body, .motion = motion}).verdict, Verdict::clear);
}

/// The least sampled distance is at least the true one. Within a margin just above it, nothing may be proven, though
/// the coarse motion stays farther away.
TEST(ClearlyApart, CountsHowFarTheCoarseMotionTurnsOtherwise) {
    std::mt19937 random(868);
    const Polyhedron bar = box({4, 0.1, 0.1}).polyhedron(), cube = box({0.1, 0.1, 0.1}).polyhedron();
    int proven = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const Pose start = random_pose(random, 3, 3);
        const Motion motion =
            Motion::velocity(start, composed(Pose(random_vector(random, 3), Quaterniond::Identity()),
                                             composed(start, turned({0, 0, 0}, random_vector(random, 1), 1.5))));
        double least = 1e300;
        for (int k = 0; k <= 100; ++k)
            least = std::min(least, distance_at(bar, cube, motion.pose_at(k / 100.0)));
        EXPECT_FALSE(are_clearly_apart(bar.body(), cube.body(), motion.trajectory(), least * (1 + 1e-9) + 1e-9))
            << trial;
        proven += are_clearly_apart(bar.body(), cube.body(), motion.trajectory(), 0.5 * least) ? 1 : 0;
    }
    EXPECT_GT(proven, 100);
}

} // namespace
} // namespace chasles::culling
