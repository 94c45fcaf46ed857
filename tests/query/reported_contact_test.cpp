// Which of the features that touch an answer reports: a contact with a normal that separates the bodies and that the
// motion closes against; and an overlap where bodies pass through each other at the start.
#include "chasles/motion/timed_poses.h"
#include "chasles/query/first_contact.h"
#include "chasles/query/path.h"
#include "tests/query/bodies.h"
#include "tests/support/random.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

namespace chasles::test {
namespace {

/// A box of a common height that is turned about the vertical and cut into triangles or not.
Body upright_box(Random& random) {
    Body body = box({random.uniform(0.3, 1.5), random.uniform(0.3, 1.5), 1});
    const double angle = random.chance(0.5) ? random.integer(0, 3) * std::numbers::pi / 2 : random.uniform(0, 3);
    for (Eigen::Vector3d& vertex : body.vertices) // the heights stay exact
        vertex = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()) * vertex;
    if (random.chance(0.5)) {
        Faces triangles;
        for (const auto& face : body.faces) {
            triangles.push_back({face[0], face[1], face[2]});
            triangles.push_back({face[0], face[2], face[3]});
        }
        body.faces = triangles;
    }
    return body;
}

/// How far the convex bodies reach through the plane of a contact, at the lower end of the bracket.
double passes_plane(const Contact& contact, const FirstContact& found, const Body& moving, const Body& fixed) {
    double depth = 0;
    for (const Eigen::Vector3d& vertex : moving.vertices)
        depth = std::max(depth, contact.normal.dot(contact.point - found.pose.isometry() * vertex));
    for (const Eigen::Vector3d& vertex : fixed.vertices)
        depth = std::max(depth, contact.normal.dot(found.fixed_pose.isometry() * vertex - contact.point));
    return depth;
}

TEST(ReportedContact, BodiesOfOneHeightCloseAgainstItsNormal) {
    Random random(41);
    int meetings = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const Body moving = upright_box(random), fixed = upright_box(random);
        const double direction = random.chance(0.5) ? 0 : random.uniform(0, 2 * std::numbers::pi);
        const Eigen::Vector3d way = 8 * Eigen::Vector3d(std::cos(direction), std::sin(direction), 0);
        const Eigen::Vector3d beside = Eigen::Vector3d(-way.y(), way.x(), 0) * random.uniform(-0.1, 0.1);
        const Pose start{beside - way / 2, Eigen::Quaterniond::Identity()};
        const Pose goal{beside + way / 2, Eigen::Quaterniond::Identity()};
        for (const Find find : {Find::first, Find::first_with_all_contacts}) {
            const FirstContactQuery query{.moving = moving.polyhedron(),
                                          .fixed = fixed.polyhedron(),
                                          .motion = ScrewMotion::between(start, goal),
                                          .options = {.find = find}};
            const FirstContact found = first_contact(query);
            if (found.verdict == Verdict::clear)
                continue;
            ++meetings;
            ASSERT_FALSE(found.contacts.empty());
            const Contact& contact = found.contacts.front();
            EXPECT_GT(contact.approach_speed, 0) << "trial " << trial;
            EXPECT_LT(passes_plane(contact, found, moving, fixed), 1e-9) << "trial " << trial;
            EXPECT_NEAR(contact.approach_speed, -contact.normal.dot(way), 1e-9);
        }
    }
    EXPECT_GT(meetings, 700);
}

TEST(ReportedContact, TwoEqualCubesMeetHeadOn) {
    const Polyhedron cube = box({1, 1, 1}).polyhedron();
    const auto ask = [&](const Pose& start, const Pose& goal) {
        return first_contact({.moving = cube, .fixed = cube, .motion = ScrewMotion::between(start, goal)});
    };
    const FirstContact along_x = ask(shifted(-4, 0, 0), shifted(0, 0, 0));
    EXPECT_TRUE(along_x.contacts.at(0).normal.isApprox(-Eigen::Vector3d::UnitX(), 1e-12));
    EXPECT_NEAR(along_x.contacts[0].approach_speed, 4, 1e-12);
    const FirstContact down = ask(shifted(0, 0, 4), shifted(0, 0, 0));
    EXPECT_TRUE(down.contacts.at(0).normal.isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
    EXPECT_NEAR(down.contacts[0].approach_speed, 4, 1e-12);
}

TEST(ReportedContact, APairInTouchReportsWhatTheMotionClosesAgainst) {
    // The box stands on the floor and against a wall at the start. It is pushed into the wall, or lifted.
    Body room = box({5, 5, 1});
    add_box(room, {4, 0, 2}, {1, 5, 1});
    const Polyhedron box_in_corner = box({1, 1, 1}).polyhedron();
    const auto ask = [&](const Pose& goal) {
        return first_contact({.moving = box_in_corner,
                              .fixed = room.polyhedron(),
                              .motion = ScrewMotion::between(shifted(2, 0, 2), goal)});
    };
    const FirstContact pushed = ask(shifted(3, 0, 2));
    ASSERT_EQ(pushed.verdict, Verdict::contact_at_start);
    EXPECT_TRUE(pushed.contacts.at(0).normal.isApprox(-Eigen::Vector3d::UnitX(), 1e-12));
    const FirstContact pressed = ask(shifted(2, 0, 1));
    EXPECT_TRUE(pressed.contacts.at(0).normal.isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
}

/// An extruded polygon, convex or not, from z = 0 to its height; counter-clockwise.
Body extruded(const std::vector<Eigen::Vector2d>& outline, double height) {
    Body body;
    const auto count = std::uint32_t(outline.size());
    for (const double z : {0.0, height})
        for (const Eigen::Vector2d& corner : outline)
            body.vertices.emplace_back(corner.x(), corner.y(), z);
    std::vector<std::uint32_t> top, bottom;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t next = (i + 1) % count;
        body.faces.push_back({i, next, count + next, count + i});
        top.push_back(count + i);
        bottom.push_back(count - 1 - i);
    }
    body.faces.push_back(top);
    body.faces.push_back(bottom);
    return body;
}

std::vector<Eigen::Vector2d> rectangle(double x0, double y0, double x1, double y1) {
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

FirstContact at_start(const Body& a, const Body& b, Find find = Find::first) {
    return first_contact({.moving = a.polyhedron(),
                          .fixed = b.polyhedron(),
                          .motion = ScrewMotion::between(shifted(0, 0, 0), shifted(1, 0, 0)),
                          .options = {.find = find}});
}

TEST(ReportedContact, OverlapOfExtrudedPartsOfOneHeightIsNamed) {
    const std::vector<std::vector<Eigen::Vector2d>> outlines = {
        rectangle(-10, -2, 10, 2),   rectangle(-2, -10, 2, 10),
        rectangle(-10, -2, 0, 2),    {{-6, -6}, {6, -6}, {6, -4}, {-4, -4}, {-4, 6}, {-6, 6}}, // an angle
        {{-5, -4}, {5, -5}, {0, 7}},
    };
    for (std::size_t i = 0; i < outlines.size(); ++i)
        for (std::size_t j = 0; j < outlines.size(); ++j)
            for (const Find find : {Find::first, Find::first_with_all_contacts}) {
                const bool is_crossing = i != j && !(std::min(i, j) == 0 && std::max(i, j) == 2);
                const FirstContact found = at_start(extruded(outlines[i], 4), extruded(outlines[j], 4), find);
                EXPECT_EQ(found.verdict, Verdict::contact_at_start);
                EXPECT_TRUE(found.overlap || !is_crossing) << i << ' ' << j;
            }
}

TEST(ReportedContact, PartsThatOnlyTouchDoNotOverlap) {
    const Body bar = extruded(rectangle(-10, -2, 10, 2), 4);
    const Body angle = extruded({{-6, -6}, {6, -6}, {6, -4}, {-4, -4}, {-4, 6}, {-6, 6}}, 4);
    const auto moved = [](Body body, const Eigen::Vector3d& by) {
        for (Eigen::Vector3d& vertex : body.vertices)
            vertex += by;
        return body;
    };
    const Body in_angle = extruded(rectangle(-4, -4, 0, 0), 4); // touches both inner walls, the tops are in one plane
    const std::pair<Body, Body> touching[] = {
        {bar, moved(bar, {0, 4, 0})},        {bar, moved(bar, {0, 0, 4})},
        {bar, moved(bar, {20, 0, 0})},       {bar, moved(bar, {20, 4, 4})},
        {bar, moved(angle, {0, 8, 0})},      {angle, in_angle},
        {angle, moved(in_angle, {0, 0, 4})}, {bar, moved(extruded(rectangle(-2, -10, 2, 10), 4), {0, 0, 4})},
    };
    for (const auto& [a, b] : touching)
        for (const bool is_swapped : {false, true}) {
            const FirstContact found = is_swapped ? at_start(b, a) : at_start(a, b);
            EXPECT_EQ(found.verdict, Verdict::contact_at_start);
            EXPECT_FALSE(found.overlap);
        }
}

/// A cube, mostly with a pillar that leans at random.
Body cube_with_pillar(Random& random) {
    Body body = box({0.5, 0.5, 0.5});
    if (random.chance(0.3))
        return body;
    add_box(body, {0, 0, 0}, {0.1, 0.1, 1.5});
    const Eigen::AngleAxisd lean(random.uniform(-0.5, 0.5), Eigen::Vector3d(random.uniform(-1, 1), 1, 0).normalized());
    const Eigen::Vector3d foot(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 0);
    for (std::size_t i = 8; i < 16; ++i)
        body.vertices[i] = lean * body.vertices[i] + foot;
    return body;
}

/// Two bodies that pass through each other at the start, with flush sides: cubes that are shifted in a plane, or bars
/// of one height that cross.
struct PassingBodies {
    Body moving, fixed;
    Pose start;
};

PassingBodies passing_bodies(Random& random) {
    if (random.chance(0.5))
        return {cube_with_pillar(random), cube_with_pillar(random), shifted(0.3, 0, 0.2)};
    return {box({1.2, random.uniform(0.3, 0.5), 1}), box({random.uniform(0.3, 0.5), 1.2, 1}),
            turned({random.uniform(-0.1, 0.1), 0, 0}, {0, 0, 1}, random.uniform(-0.5, 0.5))};
}

TEST(ReportedContact, AProvenOverlapIsACertainContactOnEveryMotion) {
    Random random(474);
    for (int trial = 0; trial < 64; ++trial) {
        const auto [moving, fixed, start] = passing_bodies(random);
        const Polyhedron a = moving.polyhedron(), b = fixed.polyhedron();
        const Pose goal = turned({random.uniform(-2, 2), random.uniform(-2, 2), 1},
                                 {random.uniform(-1, 1), random.uniform(-1, 1), 1}, random.uniform(0.1, 2));
        const std::vector<Motion> motions{
            Motion::screw(start, goal),
            Motion::sweep(start, goal),
            Motion::velocity(start, goal),
            Motion::twist(start, goal),
            TimedPoses::through({0, 1, 3}, {start, goal, start}),
            relative(Motion::velocity(start, goal), Motion::hinge({0, 0, 0}, {0, 0, 1}, {0, 1}))};
        const std::vector<QueryOptions> all_options{{.find = Find::first},
                                                    {.find = Find::first_with_all_contacts},
                                                    {.find = Find::any},
                                                    {.margin = 0.1},
                                                    {.margin = 0.1, .hold = 0.05}};
        for (const Motion& motion : motions)
            for (const QueryOptions& options : all_options) {
                const FirstContact found =
                    first_contact({.moving = a, .fixed = b, .motion = motion, .options = options});
                SCOPED_TRACE(testing::Message() << "trial " << trial << ", kind " << &motion - motions.data()
                                                << ", options " << &options - all_options.data());
                EXPECT_TRUE(found.certain);
                if (options.find == Find::any) // may be a later contact
                    continue;
                EXPECT_EQ(found.verdict, Verdict::contact_at_start);
                EXPECT_EQ(found.time.upper, 0);
                EXPECT_EQ(found.tau.upper, 0);
            }
    }
}

} // namespace
} // namespace chasles::test
