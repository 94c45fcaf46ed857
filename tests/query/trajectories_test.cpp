// First contacts on motions that are no rational ones: closed forms, dense sampling, and motions that agree.
#include "chasles/chasles.h"
#include "tests/query/bodies.h"
#include "tests/query/posed_distance.h"

#include <gtest/gtest.h>
#include <numbers>

namespace chasles::test {
namespace {

using Eigen::Vector3d;

using std::numbers::pi;

FirstContact ask(const Polyhedron& moving, const Polyhedron& fixed, const Motion& motion,
                 const QueryOptions& options = {}) {
    return first_contact({.moving = moving, .fixed = fixed, .motion = motion, .options = options});
}

/// The time of the first contact is known.
void expect_contact_at(double time, const FirstContact& found) {
    ASSERT_EQ(found.verdict, Verdict::contact);
    EXPECT_TRUE(found.certain);
    EXPECT_LE(found.time.lower, time + 1e-15);
    EXPECT_GE(found.time.upper, time - 1e-15);
    EXPECT_LE(found.time.upper - found.time.lower, 1.1e-12);
}

/// A wall in the plane x = `place`, wide enough for all bodies here.
Polyhedron wall(double place) {
    Body body = box({0.5, 40, 40});
    for (Vector3d& vertex : body.vertices)
        vertex.x() += place + 0.5;
    return body.polyhedron();
}

/// A bar along x that turns about its middle.
Polyhedron bar() {
    return box({2, 0.1, 0.1}).polyhedron();
}

/// A corner of the bar is at the angle atan(0.1 / 2) beside its axis, sqrt(4.01) from the middle.
TEST(Trajectories, ABarTurnsIntoAWall) {
    const double reach = std::sqrt(4.01), beside = std::atan(0.05);
    for (const double place : {0.5, 1.0, 1.9}) {
        // It starts along y and turns towards x by the turn of 1.5.
        const Motion motion =
            Motion::velocity(turned({0, 0, 0}, {0, 0, 1}, pi / 2), turned({0, 0, 0}, {0, 0, 1}, pi / 2 - 1.5));
        const double first = pi / 2 - beside - std::acos(place / reach);
        expect_contact_at(first / 1.5, ask(bar(), wall(place), motion));
        const Motion hinge = Motion::hinge({0, 0, 0}, {0, 0, 1}, {pi / 2, 0, -1.5});
        expect_contact_at(std::sqrt(first / 1.5), ask(bar(), wall(place), hinge));
    }
}

/// Two thin bars about parallel axes at different speeds: a corner of the one runs into the face of the other.
/// A bar turns and slides over its like, at a constant height.
TEST(Trajectories, SidesThatSlideForLongAreToldApartAtTheGapThatIsPromised) {
    const Polyhedron long_bar = box({5, 0.25, 0.25}).polyhedron();
    const auto over = [](double gap) {
        return Motion::velocity(shifted(0, 0, 0.5 + gap), turned({1, 2, 0.5 + gap}, {0, 0, 1}, 0.9));
    };
    EXPECT_EQ(ask(long_bar, long_bar, over(1e-13)).verdict, Verdict::clear);
    EXPECT_EQ(ask(long_bar, long_bar, relative(Motion::at_rest(Pose()), over(1e-9))).verdict, Verdict::clear);
}

TEST(Trajectories, TwoBarsTurnAtDifferentSpeeds) {
    const double apart = 2.5, slow = 2, fast = -2.2;
    const auto bar_at = [&](double x, double angle) -> Motion {
        return Motion::at_rest(shifted(x, 0, 0)) * Motion::hinge({0, 0, 0}, {0, 0, 1}, {pi / 2, angle});
    };
    const Motion motion = relative(bar_at(0, slow), bar_at(apart, fast));
    // In the plane both are rectangles: the root of a scalar function, by bisection in long double.
    const auto gap = [&](long double time) {
        const auto corner = [&](long double x, long double y, long double angle, long double at) {
            const long double c = std::cos(angle), s = std::sin(angle);
            return std::pair(at + c * x - s * y, s * x + c * y);
        };
        long double least = 1e9L;
        for (const bool first : {true, false}) { // corners of the one seen from the other
            const long double a = pi / 2 + time * (first ? slow : fast), b = pi / 2 + time * (first ? fast : slow);
            for (const long double x : {-2.0L, 2.0L})
                for (const long double y : {-0.1L, 0.1L}) {
                    const auto [px, py] = corner(x, y, a, first ? 0 : apart);
                    const long double dx = px - (first ? apart : 0), dy = py;
                    const long double u = std::cos(b) * dx + std::sin(b) * dy, v = -std::sin(b) * dx + std::cos(b) * dy;
                    least = std::min(least, std::max(std::abs(u) - 2, std::abs(v) - 0.1L));
                }
        }
        return least;
    };
    long double lower = 0, upper = 0;
    while (gap(upper) > 0)
        upper += 1e-4L;
    lower = upper - 1e-4L;
    while (upper - lower > 1e-18L) {
        const long double middle = (lower + upper) / 2;
        (gap(middle) > 0 ? lower : upper) = middle;
    }
    ASSERT_LT(upper, 1);
    const FirstContact found = ask(bar(), box({2, 0.1, 0.3}).polyhedron(), motion);
    expect_contact_at(double(upper), found);
    // Bars of equal thickness meet along edges that end at the same heights: no rounding tells whether they miss.
    const FirstContact flush = ask(bar(), bar(), motion);
    ASSERT_EQ(flush.verdict, Verdict::contact);
    EXPECT_LE(flush.time.lower, double(upper) + 1e-15);
    EXPECT_NEAR(flush.time.lower, double(upper), 1e-12);
    EXPECT_TRUE(found.pose.isometry().isApprox(bar_at(0, slow).pose_at(found.time.lower).isometry(), 1e-12));
    EXPECT_TRUE(found.fixed_pose.isometry().isApprox(bar_at(apart, fast).pose_at(found.time.lower).isometry(), 1e-12));
}

/// A wheel of 24 corners rolls along x without slip, its middle at the height of its corners over the ground: each
/// corner follows a cycloid. A post stands in its way, lower than the wheel's middle.
TEST(Trajectories, AWheelRollsIntoAPost) {
    constexpr int corners = 24;
    Body wheel;
    for (const double z : {-0.2, 0.2})
        for (int i = 0; i < corners; ++i)
            wheel.vertices.emplace_back(std::cos(2 * pi * i / corners), std::sin(2 * pi * i / corners), z);
    std::vector<std::uint32_t> lower, upper;
    for (std::uint32_t i = 0; i < corners; ++i) {
        const std::uint32_t next = (i + 1) % corners;
        wheel.faces.push_back({i, next, next + corners, i + corners});
        upper.push_back(i + corners);
        lower.push_back(corners - 1 - i);
    }
    wheel.faces.push_back(lower);
    wheel.faces.push_back(upper);
    Body post = box({0.5, 0.5, 1}); // its face x = 6 is met by corners of the wheel
    for (Vector3d& vertex : post.vertices)
        vertex += Vector3d(6.5, -0.2, 0);
    const double way = 20;
    const Motion rolls = Motion::slider({1, 0, 0}, {0, way}) * Motion::hinge({0, 0, 0}, {0, 0, 1}, {0, -way});
    const FirstContact found = ask(wheel.polyhedron(), post.polyhedron(), rolls);
    // The first time at which a corner is at x = 6 and below the top of the post, y = 0.3.
    double first = 1;
    for (int i = 0; i < corners; ++i) {
        const auto angle = [&](double s) { return 2 * pi * i / corners - s; };
        const auto x = [&](double s) { return s + std::cos(angle(s)); };
        for (double s = 4; s < 8; s += 1e-3) { // s: the way of the middle; x never falls
            if (!(x(s) < 6 && x(s + 1e-3) >= 6))
                continue;
            double a = s, b = s + 1e-3;
            for (int k = 0; k < 80; ++k)
                (x((a + b) / 2) < 6 ? a : b) = (a + b) / 2;
            if (const double y = std::sin(angle(b)); y < 0.3 && y > -0.7)
                first = std::min(first, b / way);
        }
    }
    ASSERT_LT(first, 1);
    expect_contact_at(first, found);
}

/// The paper's screw cut at ever smaller turns slides more and more evenly.
TEST(Trajectories, ScrewsCutAtEverSmallerTurnsBecomeATwist) {
    std::mt19937 random(1841);
    int contacts = 0;
    for (int trial = 0; trial < 40; ++trial) {
        const Polyhedron moving = random_octahedron(random).polyhedron(),
                         fixed = random_octahedron(random).polyhedron();
        const Pose start = random_pose(random, 3, 3), goal = random_pose(random, 0.7, 3);
        const FirstContact twist = ask(moving, fixed, Motion::twist(start, goal));
        if (twist.verdict != Verdict::contact)
            continue;
        ++contacts;
        for (const double max_turn : {0.4, 0.1, 0.025, 0.00625}) {
            const FirstContact screw = ask(moving, fixed, Motion::screw(start, goal, max_turn));
            ASSERT_EQ(screw.verdict, Verdict::contact);
            const double error = std::abs(screw.time.lower - twist.time.lower);
            EXPECT_LT(error, 0.1 * max_turn * max_turn) << trial << ", " << max_turn;
        }
    }
    EXPECT_GT(contacts, 10);
}

Motion random_motion(std::mt19937& random, int kind) {
    const auto pose = [&](double distance) { return random_pose(random, distance, 3); };
    switch (kind % 6) {
    case 0:
        return Motion::velocity(pose(2), pose(2), random_vector(random, 0.5));
    case 1:
        return Motion::twist(pose(2), pose(2));
    case 2:
        return Motion::hinge(random_vector(random, 1), random_vector(random, 1), {0, 3, -2, 5}) *
               Motion::at_rest(pose(2));
    case 3:
        return Motion::polynomial({random_vector(random, 2), random_vector(random, 3), random_vector(random, 3)}) *
               Motion::hinge({0, 0, 0}, random_vector(random, 1), {0, 2, 3});
    case 4:
        return Motion::spline({0, 0.4, 1}, {pose(2), pose(2), pose(2)});
    default:
        return Motion::b_spline({pose(3), pose(2), pose(1), pose(2)});
    }
}

double distance_of(const Polyhedron& moving, const Polyhedron& fixed, const Motion& motion, double time) {
    return distance_at(
        moving, fixed,
        Pose(Eigen::Isometry3d(motion.fixed_pose_at(time).isometry().inverse() * motion.pose_at(time).isometry())));
}

/// Dense sampling refutes a time that is late; the distance at the answer one that is early.
void expect_true(const FirstContact& found, const Polyhedron& moving, const Polyhedron& fixed, const Motion& motion,
                 double margin) {
    if (found.verdict == Verdict::contact_at_start)
        return;
    for (int i = 0; i <= 100; ++i)
        if (const double time = i / 100.0; time < found.clear_until) {
            ASSERT_GT(distance_of(moving, fixed, motion, time), margin) << time;
        }
    if (found.verdict == Verdict::contact) {
        EXPECT_TRUE(found.certain);
        EXPECT_LE(found.time.upper - found.time.lower, 1.1e-12);
        EXPECT_NEAR(distance_of(moving, fixed, motion, found.time.lower), margin, 1e-9);
    }
}

TEST(Trajectories, OfAllKindsAreNeitherLateNorEarly) {
    std::mt19937 random(1842);
    int contacts = 0, clear = 0;
    for (int trial = 0; trial < 120; ++trial) {
        SCOPED_TRACE(trial);
        const Polyhedron moving = random_octahedron(random).polyhedron(),
                         fixed = random_octahedron(random).polyhedron();
        const double margin = trial % 3 == 0 ? 0.1 : 0;
        const Motion motion = trial % 2 == 0 ? random_motion(random, trial / 2)
                                             : relative(random_motion(random, trial / 2), random_motion(random, trial));
        const FirstContact found = ask(moving, fixed, motion, {.margin = margin});
        (found.verdict == Verdict::clear ? clear : contacts) += 1;
        expect_true(found, moving, fixed, motion, margin);
        const FirstContact any = ask(moving, fixed, motion, {.margin = margin, .find = Find::any});
        EXPECT_EQ(any.verdict == Verdict::clear, found.verdict == Verdict::clear);
    }
    std::cout << contacts << " contacts, " << clear << " clear\n";
    EXPECT_GT(contacts, 30);
    EXPECT_GT(clear, 30);
}

TEST(Trajectories, EitherBodyMayBeTheMovingOne) {
    std::mt19937 random(1843);
    int contacts = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const Polyhedron first = random_octahedron(random).polyhedron(),
                         second = random_octahedron(random).polyhedron();
        const Motion a = random_motion(random, trial), b = random_motion(random, trial / 6);
        const FirstContact one = ask(first, second, relative(a, b)), other = ask(second, first, relative(b, a));
        ASSERT_EQ(one.verdict, other.verdict) << trial;
        if (one.verdict != Verdict::contact)
            continue;
        ++contacts;
        EXPECT_LE(std::max(one.time.lower, other.time.lower), std::min(one.time.upper, other.time.upper) + 1e-15);
    }
    EXPECT_GT(contacts, 10);
}

/// Poses in double only, with and without bounds of accelerations.
TEST(Trajectories, TheUsersOwnAgreesWithTheLibrarys) {
    std::mt19937 random(1844);
    int contacts = 0;
    for (int trial = 0; trial < 40; ++trial) {
        const Polyhedron moving = random_octahedron(random).polyhedron(),
                         fixed = random_octahedron(random).polyhedron();
        const Pose start = random_pose(random, 2, 3), goal = random_pose(random, 2, 3);
        const auto motion = ConstantVelocity::between(start, goal);
        const bool knows_accelerations = trial % 4 != 0;
        OwnTrajectory own;
        own.pose_at = [motion](double time) { return motion.pose_at(time); };
        own.bounds = [motion, knows_accelerations](double, double) {
            MotionBounds bounds{.turn_rate = motion.angle() * (1 + 1e-12),
                                .speed = motion.displacement().norm() * (1 + 1e-12)};
            if (knows_accelerations)
                bounds.turn_acceleration = bounds.acceleration = 0;
            return bounds;
        };
        const FirstContact known = ask(moving, fixed, motion), found = ask(moving, fixed, Motion::along(own));
        if (known.verdict == Verdict::contact_at_start)
            continue;
        ASSERT_EQ(found.verdict, known.verdict) << trial;
        if (known.verdict != Verdict::contact)
            continue;
        ++contacts;
        EXPECT_LE(found.time.lower, known.time.upper);
        EXPECT_EQ(found.certain, knows_accelerations);
        if (knows_accelerations) {
            EXPECT_GE(found.time.upper, known.time.lower);
            EXPECT_LE(found.time.upper - found.time.lower, 1e-9);
        }
        EXPECT_GE(found.time.lower, known.time.lower - 1e-9);
    }
    EXPECT_GT(contacts, 5);
}

TEST(Trajectories, ATrackIsOneQuestion) {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    const TimedPoses track =
        TimedPoses::through({0, 2, 3, 7}, {shifted(-5, 3, 0), shifted(-3, 3, 0), turned({-3, 0, 0}, {0, 0, 1}, 2),
                                           turned({9, 0, 0}, {0, 0, 1}, 2)});
    const FirstContact found = ask(cube, cube, track);
    ASSERT_EQ(found.verdict, Verdict::contact);
    EXPECT_EQ(track.segment_of(found.time.lower), 2u);
    // In the last segment nothing turns: a corner of the turned cube meets the face x = -0.5.
    const double reach = 0.5 * (std::abs(std::cos(2.0)) + std::abs(std::sin(2.0)));
    const double stamp = 3 + 4 * (-0.5 - reach + 3) / 12;
    EXPECT_LE(track.stamp_of(found.time).lower, stamp);
    EXPECT_GE(track.stamp_of(found.time).upper, stamp);
}

/// Times at which pieces and intervals might end.
TEST(Trajectories, ContactsAtRoundTimesAreCertain) {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    for (int k = 1; k < 16; ++k) {
        const double time = k / 16.0;
        const Pose start({0.25, 0.5, 1 + time}, Eigen::Quaterniond::Identity());
        for (const double turn : {0.3, 0.1}) {                                     // in several pieces, and in one
            const Pose goal({0.25, 0.5, time}, Eigen::Quaterniond(1, 0, 0, turn)); // down by one
            expect_contact_at(time, ask(cube, cube, Motion::velocity(start, goal)));
            expect_contact_at(time, ask(cube, cube, Motion::twist(start, goal)));
        }
    }
}

/// Two dominoes of equal width lean towards each other, 9e-6 apart. Their sides are flush but for 1e-11, so edges of
/// the one are in the planes of faces of the other.
TEST(Trajectories, FlushSidesTiltedByRoundingDoNotOverlapAtTheStart) {
    const Polyhedron domino = box({0.004, 0.012, 0.024}).polyhedron();
    const Pose start(Vector3d(0.17309537300459271, 2.176e-13, 0.022905813914517566),
                     Eigen::Quaterniond(0.96590474, -1.29e-12, 0.25889777, 5.95e-12));
    const Pose fixed(Vector3d(0.18729934404652723, 1.156e-13, 0.024228912183290874),
                     Eigen::Quaterniond(0.98852476, -1.01e-12, 0.15105925, 1.66e-12));
    const auto turned_on = [](const Pose& from, const Vector3d& way, double angle) {
        return Motion::velocity(
            from, Pose(from.translation + way, Eigen::AngleAxisd(angle, Vector3d::UnitY()) * from.rotation));
    };
    const Motion motion = relative(turned_on(start, {0.00105633, 1e-14, -0.00041715}, 0.0462397),
                                   turned_on(fixed, {0.00128426, 5e-15, -0.00020767}, 0.0531473));
    EXPECT_GT(distance_at(domino, domino, relative(Motion::at_rest(start), Motion::at_rest(fixed)).pose_at(0)), 0);
    for (const double margin : {0.0, 1e-9, 1e-7}) {
        const FirstContact found = ask(domino, domino, motion, {.margin = margin});
        EXPECT_NE(found.verdict, Verdict::contact_at_start) << margin;
        EXPECT_TRUE(found.certain) << margin;
    }
}

} // namespace
} // namespace chasles::test
