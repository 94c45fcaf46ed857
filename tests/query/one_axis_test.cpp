// Planar mechanisms, whose parts slide in common planes: contacts on turns about one axis are proven as those of
// screws. The first contact of two extruded polygons is known in closed form: a corner meets a side.
#include "chasles/chasles.h"
#include "tests/support/random_poses.h"

#include <gtest/gtest.h>
#include <numbers>

namespace chasles::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

using Outline = std::vector<Vector2d>;

/// A star-shaped outline about the origin.
Outline outline(Random& random, int corners) {
    Outline result;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * pi * i / corners, radius = (i % 2 == 0 ? 1 : 0.6) * random.uniform(0.9, 1.1);
        result.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    return result;
}

/// From the plane z = 0 to z = height.
Polyhedron extruded(const Outline& outline, double height) {
    std::vector<Vector3d> vertices;
    const auto n = std::uint32_t(outline.size());
    std::vector<std::vector<std::uint32_t>> faces(2);
    for (const double z : {0.0, height})
        for (const Vector2d& corner : outline)
            vertices.emplace_back(corner.x(), corner.y(), z);
    for (std::uint32_t i = 0; i < n; ++i) {
        faces[0].push_back(n - 1 - i);
        faces[1].push_back(n + i);
        faces.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
    }
    return Polyhedron::from_polygons(vertices, faces);
}

/// The least angle in (0, most] by which corners turn about the origin into sides that rest, in either direction.
long double first_angle(const Outline& turning, const Outline& resting, double sign, double most) {
    long double first = INFINITY;
    for (const Vector2d& corner : turning)
        for (std::size_t i = 0; i < resting.size(); ++i) {
            const Vector2d a = resting[i], b = resting[(i + 1) % resting.size()];
            const long double dx = (long double)(b.x()) - a.x(), dy = (long double)(b.y()) - a.y();
            const long double length = std::sqrt(dx * dx + dy * dy), nx = -dy / length, ny = dx / length;
            const long double distance = nx * a.x() + ny * a.y(); // of the line from the origin
            const long double radius =
                std::sqrt((long double)(corner.x()) * corner.x() + (long double)(corner.y()) * corner.y());
            if (std::abs(distance) > radius)
                continue;
            const long double start = std::atan2((long double)(corner.y()), (long double)(corner.x()));
            const long double middle = std::atan2(ny, nx), aside = std::acos(distance / radius);
            for (const long double place : {middle - aside, middle + aside}) {
                const long double along =
                    ((radius * std::cos(place) - a.x()) * dx + (radius * std::sin(place) - a.y()) * dy) / length;
                if (along < 0 || along > length)
                    continue;
                long double angle = std::remainder(sign * (place - start), 2 * (long double)(pi));
                angle += angle < 0 ? 2 * (long double)(pi) : 0;
                if (angle <= most)
                    first = std::min(first, angle);
            }
        }
    return first;
}

/// Of the moving outline into the fixed one.
long double first_meeting(const Outline& moving, const Outline& fixed, double turn) {
    const double sign = turn < 0 ? -1 : 1, most = std::abs(turn);
    return std::min(first_angle(moving, fixed, sign, most), first_angle(fixed, moving, -sign, most));
}

Outline moved(const Outline& outline, const Vector2d& by) {
    Outline result;
    for (const Vector2d& corner : outline)
        result.push_back(corner + by);
    return result;
}

bool overlap(const Outline& a, const Outline& b) {
    const auto is_inside = [](const Outline& outline, const Vector2d& p) {
        bool inside = false;
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const Vector2d &from = outline[i], &to = outline[(i + 1) % outline.size()];
            if ((from.y() > p.y()) != (to.y() > p.y()) &&
                p.x() < from.x() + (p.y() - from.y()) / (to.y() - from.y()) * (to.x() - from.x()))
                inside = !inside;
        }
        return inside;
    };
    const auto one_in = [&](const Outline& x, const Outline& y) {
        return std::ranges::any_of(x, [&](const Vector2d& p) { return is_inside(y, p); });
    };
    return one_in(a, b) || one_in(b, a);
}

/// A question, and the first contact by the closed form.
struct Question {
    Polyhedron moving;
    Polyhedron fixed;
    double turn;
    double time; ///< infinite if there is no contact
};

/// The hinge is at the origin.
Question random_question(Random& random) {
    const double height = random.uniform(0.1, 0.5);
    while (true) {
        const double turn = random.uniform(0.3, 2.8) * (random.chance(0.5) ? 1 : -1);
        const Outline a =
            moved(outline(random, 2 * random.integer(3, 16)), {random.uniform(1, 3), random.uniform(-1, 1)});
        const Outline b =
            moved(outline(random, 2 * random.integer(3, 16)), {random.uniform(-1, 1), random.uniform(1, 3)});
        if (overlap(a, b))
            continue;
        return {extruded(a, height), extruded(b, height), turn, double(first_meeting(a, b, turn) / std::abs(turn))};
    }
}

int expect_first(const FirstContact& found, double time) {
    EXPECT_EQ(found.verdict, std::isinf(time) ? Verdict::clear : Verdict::contact);
    if (found.verdict != Verdict::contact)
        return 0;
    EXPECT_TRUE(found.certain);
    EXPECT_LE(found.time.lower, time + 1e-14);
    EXPECT_GE(found.time.upper, time - 1e-14);
    EXPECT_LE(found.time.upper - found.time.lower, 1.1e-12);
    return 1;
}

TEST(OneAxis, ExtrudedPairsOnHingesMeetWhenTheirOutlinesDo) {
    Random random(3510);
    int contacts = 0;
    for (int trial = 0; trial < 300; ++trial) {
        SCOPED_TRACE(trial);
        const auto& [moving, fixed, turn, time] = random_question(random);
        contacts +=
            expect_first(first_contact({moving, fixed, Motion::hinge({0, 0, 0}, {0, 0, 1}, {0, turn}), {}}), time);
    }
    std::cout << contacts << " contacts of 300\n";
    EXPECT_GT(contacts, 100);
}

/// One world frame, both links on one pin with laws of their own, and a motion given by its ends.
TEST(OneAxis, AnyFrameLawAndPairOfLinks) {
    Random random(3511);
    for (int trial = 0; trial < 100; ++trial) {
        SCOPED_TRACE(trial);
        const auto& [moving, fixed, turn, time] = random_question(random);
        const Motion frame = Motion::at_rest(random_pose(random, 3));
        const Motion back = Motion::at_rest(random_pose(random, 3));
        const Vector3d axis(0, 0, 2);
        // in all turn t^2
        const Motion first = frame * Motion::hinge({0, 0, 0}, axis, {0.3, 0.5, turn + 0.25});
        const Motion second = frame * Motion::hinge({0, 0, 1}, -axis, {-0.3, -0.5, -0.25});
        EXPECT_EQ(first_contact({moving, fixed, relative(first, second), {}}).verdict,
                  std::isinf(time) ? Verdict::clear : Verdict::contact);
        expect_first(first_contact({moving, fixed, relative(first, second), {}}), std::sqrt(time));
        expect_first(
            first_contact(
                {moving, fixed, relative(back * frame * Motion::hinge({0, 0, 0}, axis, {0, turn}), back * frame), {}}),
            time);
        const Pose start, goal({0, 0, 0}, {std::cos(turn / 2), 0, 0, std::sin(turn / 2)});
        for (const Motion& motion : {Motion::twist(start, goal), Motion::velocity(start, goal)})
            expect_first(first_contact({moving, fixed, motion, {}}), time);
    }
}

/// By a hinge, by a motion that is given by its ends, and by the screw.
TEST(OneAxis, MarginsAndLeastDistancesAreThoseOfTheScrew) {
    Random random(3514);
    int contacts = 0;
    for (int trial = 0; trial < 40; ++trial) {
        SCOPED_TRACE(trial);
        const auto& [moving, fixed, turn, time] = random_question(random);
        const Pose start, goal({0, 0, 0}, {std::cos(turn / 2), 0, 0, std::sin(turn / 2)});
        const Motion screw = Motion::screw(start, goal);
        const QueryOptions options{.margin = random.uniform(0.01, 0.3)};
        const FirstContact expected = first_contact({moving, fixed, screw, options});
        const LeastDistance least = least_distance({moving, fixed, screw, {}});
        contacts += expected.verdict == Verdict::contact;
        for (const Motion& motion : {Motion::hinge({0, 0, 0}, {0, 0, 1}, {0, turn}), Motion::twist(start, goal)}) {
            const FirstContact found = first_contact({moving, fixed, motion, options});
            EXPECT_EQ(found.verdict, expected.verdict);
            EXPECT_NEAR(found.clear_until, expected.clear_until, 1e-11);
            const LeastDistance distance = least_distance({moving, fixed, motion, {}});
            EXPECT_TRUE(distance.certain);
            EXPECT_LE(distance.distance.lower, least.distance.upper + 1e-13);
            EXPECT_GE(distance.distance.upper, least.distance.lower - 1e-13);
        }
    }
    EXPECT_GT(contacts, 10);
}

/// Swings out and back on the same way: contacts are on the way out.
TEST(OneAxis, ASwingMeetsOnItsWayOut) {
    Random random(3512);
    int contacts = 0;
    for (int trial = 0; trial < 100; ++trial) {
        SCOPED_TRACE(trial);
        const auto& [moving, fixed, turn, time] = random_question(random);
        const double out = turn / 16; // at 1/2; at 1 it is back
        const Motion swing = Motion::hinge({0, 0, 0}, {0, 0, 1}, {0, -4 * out, 4 * out});
        const FirstContact found = first_contact({moving, fixed, swing, {}});
        const FirstContact there = first_contact({moving, fixed, Motion::hinge({0, 0, 0}, {0, 0, 1}, {0, -out}), {}});
        EXPECT_EQ(found.verdict, there.verdict);
        if (found.verdict == Verdict::contact) {
            EXPECT_TRUE(found.certain);
            EXPECT_LT(found.time.upper, 0.5 + 1e-7);
            ++contacts;
        }
    }
    EXPECT_GT(contacts, 3);
}

/// A leaf closes flush on another one: at the goal a face lies on a face, and just before it does not.
TEST(OneAxis, ATwistThatEndsFlushTouchesAtItsEnd) {
    const Polyhedron leaf = extruded({{0.1, 0}, {1, 0}, {1, 0.1}, {0.1, 0.1}}, 0.5);
    const Polyhedron frame = extruded({{-0.2, 0.1}, {-0.1, 0.1}, {-0.1, 1}, {-0.2, 1}}, 0.5);
    const double half = std::sqrt(0.5);
    const Pose goal({0, 0, 0}, {half, 0, 0, half}); // exactly a quarter turn
    const FirstContact flush = first_contact({leaf, frame, Motion::twist({}, goal), {}});
    EXPECT_EQ(flush.verdict, Verdict::contact);
    EXPECT_TRUE(flush.certain);
    EXPECT_GE(flush.time.lower, 1 - 1e-12);
    const Motion short_of_it = Motion::hinge({0, 0, 0}, {0, 0, 1}, {0, pi / 2}); // by 6e-17
    EXPECT_EQ(first_contact({leaf, frame, short_of_it, {}}).verdict, Verdict::clear);
    const Motion beyond_it = Motion::hinge({0, 0, 0}, {0, 0, 1}, {0, std::nextafter(pi / 2, 2)});
    EXPECT_EQ(first_contact({leaf, frame, beyond_it, {}}).verdict, Verdict::contact);
}

/// The coupler's segments are turns about their poles.
TEST(OneAxis, TracksOfTwistsInAPlaneAreCertain) {
    Random random(3513);
    int contacts = 0;
    for (int trial = 0; trial < 60; ++trial) {
        SCOPED_TRACE(trial);
        const Polyhedron moving = extruded(outline(random, 12), 0.3), fixed = extruded(outline(random, 10), 0.3);
        std::vector<Pose> poses;
        for (int i = 0; i < 5; ++i) {
            const double angle = 0.2 * i + random.uniform(0, 0.1);
            poses.emplace_back(Vector3d(3.5 - 0.5 * i, random.uniform(-0.5, 0.5), 0),
                               Eigen::Quaterniond(std::cos(angle), 0, 0, std::sin(angle)));
        }
        const Motion track = TimedPoses::through({0, 1, 2, 3, 4}, poses, TimedPoses::Between::twist);
        const FirstContact found = first_contact({moving, fixed, track, {}});
        if (found.verdict == Verdict::clear)
            continue;
        ASSERT_EQ(found.verdict, Verdict::contact);
        EXPECT_TRUE(found.certain);
        ++contacts;
        FirstContact screw;
        for (std::size_t i = 0; i < 4 && (i == 0 || screw.verdict == Verdict::clear); ++i) {
            screw = first_contact({moving, fixed, Motion::screw(poses[i], poses[i + 1]), {}});
            if (screw.verdict == Verdict::contact) {
                EXPECT_NEAR(found.time.lower, (double(i) + screw.time.lower) / 4, 1e-12);
            }
        }
        EXPECT_EQ(screw.verdict, Verdict::contact);
    }
    EXPECT_GT(contacts, 40);
}

} // namespace
} // namespace chasles::test
