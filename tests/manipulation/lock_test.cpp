// Locked bodies: they stay on their lock, go to its nearest pose, and feel what stands in the way of the lock's motion.
#include "chasles/manipulation/lock.h"

#include "tests/manipulation/drag_scenes.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

#include <iostream>

namespace chasles::test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using manipulation::HandSpring;
using manipulation::Lock;

constexpr double margin = 1e-4;
constexpr DragLockKind kinds[] = {DragLockKind::hinge, DragLockKind::slider, DragLockKind::cylinder,
                                  DragLockKind::plane};

/// How far a pose is off the lock of a body that was at `start`: of points of the body and of its turn.
double off_lock(const DragLock& lock, const Pose& start, const Pose& pose) {
    const Vector3d axis = lock.direction.normalized();
    const Eigen::Isometry3d moved = pose.isometry() * start.isometry().inverse();
    const double turned = (moved.linear() * axis - axis).norm();
    const Vector3d way = moved * lock.point - lock.point; // of the body's point that was there
    switch (lock.kind) {
    case DragLockKind::hinge:
        return turned + way.norm();
    case DragLockKind::cylinder:
        return turned + way.cross(axis).norm();
    case DragLockKind::slider:
        return (moved.linear() - Eigen::Matrix3d::Identity()).norm() + way.cross(axis).norm();
    case DragLockKind::plane:
        return turned + std::abs(way.dot(axis));
    case DragLockKind::free:
        break;
    }
    return 0;
}

/// Of the spring, with equal moments of inertia about the body's origin.
double energy(const Pose& pose, const Pose& goal, double moment) {
    const double angle = Quaterniond(pose.rotation).angularDistance(Quaterniond(goal.rotation));
    return ((goal.translation - pose.translation).squaredNorm() + moment * angle * angle) / 2;
}

DragLock random_lock(Random& random, DragLockKind kind) {
    return {kind, random_point(random, 1), random_point(random, 1)};
}

TEST(Lock, TheNearestPoseHasTheLeastEnergyOfAllPosesOfTheLock) {
    Random random(1);
    int on_lock = 0;
    for (int round = 0; round < 400; ++round) {
        const DragLock description = random_lock(random, kinds[round % 4]);
        const Pose start = random_pose(random, 1);
        const Lock lock(description, start);
        const HandSpring spring({Vector3d::Zero(), 0.3 * Eigen::Matrix3d::Identity()});
        const bool is_on_lock = random.chance(0.3);
        const Pose goal = is_on_lock ? lock.onto(random_pose(random, 1)) : random_pose(random, 1);
        const Pose nearest = lock.nearest(spring, goal);
        const double least = energy(nearest, goal, 0.3);
        EXPECT_LE(off_lock(description, start, nearest), 1e-14);
        EXPECT_TRUE(!is_on_lock || least <= 1e-28) << least;
        on_lock += is_on_lock;
        for (int i = 0; i < 50; ++i) {
            const double reach = random.chance(0.5) ? 0.01 : 2;
            const Pose other = lock.onto(random_goal(random, nearest, random.uniform(-reach, reach), reach));
            EXPECT_LE(off_lock(description, start, other), 1e-14);
            EXPECT_LE(least, energy(other, goal, 0.3) + 1e-15) << round;
        }
    }
    EXPECT_GT(on_lock, 80);
}

/// The twists of a lock lead along it, and no twist that is nearer to another one does.
TEST(Lock, ProjectsOnTheTwistsThatLeadAlongIt) {
    Random random(2);
    for (int round = 0; round < 200; ++round) {
        const DragLock description = random_lock(random, kinds[round % 4]);
        const Pose start = random_pose(random, 1);
        const Lock lock(description, start);
        manipulation::Metric metric = manipulation::Metric::Identity();
        metric.bottomRightCorner<3, 3>() *= 0.3;
        const Vector3d centre = start.translation;
        const manipulation::Metric projection = lock.projection(metric, centre);
        EXPECT_LE((projection * projection - projection).norm(), 1e-11);
        EXPECT_LE((metric * projection - projection.transpose() * metric).norm(), 1e-11);
        manipulation::Twist any;
        any << random_point(random, 1), random_point(random, 1);
        const Pose end = manipulation::displaced(start, Vector3d::Zero(), 1e-5 * (projection * any));
        EXPECT_LE(off_lock(description, start, end), 1e-8) << round; // to second order
        EXPECT_NEAR(projection.trace(),
                    description.kind == DragLockKind::plane      ? 3
                    : description.kind == DragLockKind::cylinder ? 2
                                                                 : 1,
                    1e-10);
    }
}

/// A hand of jumps and spins, with a post in the way.
void drag_along(const DragLock& lock, int updates, std::uint64_t seed) {
    Scene scene;
    scene.add({"post", box({0.3, 0.3, 0.3}).polyhedron(), Motion::at_rest(turned({1.2, 0.3, 0.2}, {1, 1, 1}, 0.4))});
    const Pose start = turned({0, 0, 0}, {1, 2, 3}, 0.3);
    scene.add({"box", box({0.5, 0.4, 0.3}).polyhedron(), Motion::at_rest(start)});
    DragOptions options;
    options.margin = margin;
    options.lock = lock;
    DraggedBody body(scene, "box", options);
    Random random(seed);
    int in_contact = 0, reached = 0;
    double most = 0;
    Pose goal;
    for (int i = 0; i < updates; ++i) {
        if (i % 3 == 0)
            goal = random_goal(random, shifted(0.5, 0.1, 0.1), random.uniform(-3, 3), random.chance(0.1) ? 10 : 1);
        const DragStep step = body.update(goal);
        for (const DragPiece& piece : step.pieces)
            for (const double time : {0.3, 0.7, 1.0})
                most = std::max(most, off_lock(lock, start, piece.motion.pose_at(time * piece.until)));
        most = std::max(most, off_lock(lock, start, step.pose));
        EXPECT_NE(step.state, DragState::touching);
        in_contact += !step.contacts.empty();
        reached += step.state == DragState::reached;
    }
    EXPECT_LE(most, 1e-13);
    EXPECT_GT(in_contact, 0.02 * updates);
    EXPECT_GT(reached, 0.2 * updates);
    std::cout << updates << " updates, " << in_contact << " in contact, " << reached << " reached, " << most
              << " off the lock at most" << std::endl;
}

TEST(DraggedBodyLock, StaysOnAHingeForTenThousandUpdates) {
    drag_along({DragLockKind::hinge, {0.2, 0.1, 2}, {0.3, -0.4, 0}}, 10000, 1);
}
TEST(DraggedBodyLock, StaysOnASlider) {
    drag_along({DragLockKind::slider, {3, 0.5, 0.1}, {}}, 1000, 2);
}
TEST(DraggedBodyLock, StaysOnACylinder) {
    drag_along({DragLockKind::cylinder, {1, 0.2, 0.1}, {0, 0.1, 0.1}}, 1000, 3);
}
TEST(DraggedBodyLock, StaysInAPlane) {
    drag_along({DragLockKind::plane, {0.1, 0.2, 1}, {}}, 1000, 4);
}

DraggedBody locked(Scene& scene, const DragLock& lock, double friction = 0) {
    DragOptions options;
    options.margin = margin;
    options.lock = lock;
    options.friction = friction;
    return {scene, "box", options};
}

/// A box that slides along (1, 0, 1) above a table: the table takes what the slider does not, by its slope of 45
/// degrees.
TEST(DraggedBodyLock, ASliderPressesByTheAngleOfItsLine) {
    for (const double friction : {0.0, 0.5}) {
        Scene scene;
        scene.add({"table", box({5, 5, 0.5}).polyhedron(), Motion::at_rest(shifted(0, 0, -0.5))});
        scene.add({"box", box({0.5, 0.5, 0.5}).polyhedron(), Motion::at_rest(shifted(0, 0, 1))});
        DraggedBody body = locked(scene, {DragLockKind::slider, {1, 0, 1}, {}}, friction);
        DragStep step;
        for (int i = 0; i < 3; ++i)
            step = body.update(shifted(-2, 3, 0));
        const double fallen = 0.5 - margin; // to where the box stands on the table
        EXPECT_EQ(step.state, DragState::resting);
        EXPECT_LE((step.pose.translation - Vector3d(-fallen, 0, 1 - fallen)).norm(), 1e-6);
        // along the line: the spring's (-2 + fallen) - (1 - fallen), and the table's force N + friction * N
        const double along = 2 - fallen + 1 - fallen;
        EXPECT_NEAR(step.force.z() + step.force.x(), along, 1e-6);
        EXPECT_GE(step.force.x(), -1e-9);
        EXPECT_LE(step.force.x(), friction * step.force.z() + 1e-9);
        const DragStep lifted = body.update(shifted(0.5, 4, 1.5));
        EXPECT_EQ(lifted.state, DragState::reached);
        EXPECT_LE((lifted.pose.translation - Vector3d(0.5, 0, 1.5)).norm(), 1e-12);
        EXPECT_GT(lifted.distance, 3.9); // the hand is beside the line
    }
}

/// A door of length 2 about z at its end, against a post: the force at its lever balances the torque of the hand.
TEST(DraggedBodyLock, ADoorPressesByItsLever) {
    Scene scene;
    // the door lies along x, its side is at y = -0.05; the edge of the post that it meets is at (1.7, -0.3)
    scene.add({"post", box({0.1, 0.1, 3}).polyhedron(), Motion::at_rest(shifted(1.6, -0.4, 0))});
    scene.add({"box", box({1, 0.05, 1}).polyhedron(), Motion::at_rest(shifted(1, 0, 0))});
    DragOptions options;
    options.margin = margin;
    options.lock = {DragLockKind::hinge, {0, 0, 5}, {0, 0, 7}};
    options.mass = MassProperties{Vector3d::Zero(), 0.4 * Eigen::Matrix3d::Identity()};
    DraggedBody body(scene, "box", options);
    const Pose goal = turned({0.7, -0.9, 3}, Vector3d::UnitZ(), -0.6);
    DragStep step;
    for (int i = 0; i < 4; ++i)
        step = body.update(goal);
    EXPECT_EQ(step.state, DragState::resting);
    const Quaterniond turn(step.pose.rotation);
    const double angle = 2 * std::atan2(turn.z(), turn.w());
    // the corner (1.7, -0.3) is at the margin from the door's side
    EXPECT_NEAR(-std::sin(angle) * 1.7 - 0.3 * std::cos(angle), -0.05 - margin, margin / 100);
    const Vector3d centre(std::cos(angle), std::sin(angle), 0);
    const double torque = centre.cross(goal.translation - step.pose.translation).z() + 0.4 * (-0.6 - angle);
    const double lever = std::cos(angle) * 1.7 - 0.3 * std::sin(angle); // of the corner along the door
    EXPECT_NEAR(step.force.norm(), -torque / lever, 1e-5);
    EXPECT_NEAR(step.force.dot(centre), 0, 1e-9);
}

TEST(Lock, RefusesWhatItCannotUse) {
    const auto refusal_of = [](const DragLock& lock) { return refusal([&] { Lock(lock, Pose()); }); };
    const double nan = std::nan("");
    const std::string direction = "drag: lock: the direction must be finite and not zero";
    EXPECT_EQ(refusal_of({DragLockKind::hinge, Vector3d::Zero(), {}}), direction);
    EXPECT_EQ(refusal_of({DragLockKind::plane, {1, nan, 0}, {}}), direction);
    EXPECT_EQ(refusal_of({DragLockKind::slider, {1, 0, std::numeric_limits<double>::infinity()}, {}}), direction);
    for (const Vector3d& point : {Vector3d(nan, 0, 0), Vector3d(0, nan, 0), Vector3d(0, 2e30, 0)})
        EXPECT_EQ(refusal_of({DragLockKind::cylinder, {1, 0, 0}, point}),
                  "drag: lock: the point must be finite, and no component beyond 1e30");
    EXPECT_EQ(refusal_of({DragLockKind(9), {1, 0, 0}, {}}), "drag: lock: the kind is unknown");
    const Lock tiny({DragLockKind::slider, {1e-300, 0, 0}, {}}, Pose());
    EXPECT_EQ(tiny.onto(shifted(2, 3, 4)).translation, Vector3d(2, 0, 0));
}

} // namespace
} // namespace chasles::test
