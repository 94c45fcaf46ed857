// Cases from adversarial testing. The library once gave a wrong answer to each.
#include "tests/query/bodies.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace chasles::test {
namespace {

using std::numbers::pi;

/// A thin closed spike with its tip at `tip`, standing along `up`.
Polyhedron needle(const Eigen::Vector3d& tip, const Eigen::Vector3d& up) {
    const Eigen::Vector3d side = up.unitOrthogonal();
    const Eigen::Vector3d other = up.cross(side).normalized();
    const Eigen::Vector3d top = tip + up;
    const double width = 1e-12;
    const Vertices corners{tip, top + width * side, top - width * side + width * other, top - width * other};
    const Faces faces{{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
    return Polyhedron::from_polygons(corners, faces);
}

/// A pentagon with one corner 4e-6 off its plane, turned by 44 degrees. Its projections along the coordinate axes are
/// convex, but its projection along its own normal is not.
TEST(HardCases, NeedleHitsAPentagonThatIsConvexOnlyInACoordinateView) {
    const double c = std::cos(44 * pi / 180);
    const double s = std::sin(44 * pi / 180);
    const auto placed = [&](double u, double t, double h) { return Eigen::Vector3d(u, t * c - h * s, t * s + h * c); };
    const Vertices corners{placed(0, 0, 0), placed(0.5, 1e-6, 4e-6), placed(1, 0, 0), placed(1, 1, 0), placed(0, 1, 0)};
    const Polyhedron pentagon = Polyhedron::from_polygons(corners, Faces{{0, 1, 2, 3, 4}});
    const Eigen::Vector3d normal = placed(0, 0, 1);
    const Polyhedron needle_body = needle(placed(0.95, 6e-7, 0), normal);
    const Eigen::Vector3d above = 0.5 * normal;
    const Eigen::Vector3d below = -normal;
    const FirstContact found =
        first_contact({.moving = needle_body,
                       .fixed = pentagon,
                       .motion = ScrewMotion::between(shifted(above.x(), above.y(), above.z()),
                                                      shifted(below.x(), below.y(), below.z()))});
    EXPECT_EQ(found.verdict, Verdict::contact);
}

TEST(HardCases, PolygonWithAStraightCornerIsCovered) {
    const Vertices corners{{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const Polyhedron pentagon = Polyhedron::from_polygons(corners, Faces{{0, 1, 2, 3, 4}});
    for (const double x : {0.01, 0.3, 0.5, 0.8, 0.99})
        for (const double y : {1e-9, 0.2, 0.6, 1 - 1e-9}) {
            const FirstContact found =
                first_contact({.moving = needle({x, y, 0}, {0, 0, 1}),
                               .fixed = pentagon,
                               .motion = ScrewMotion::between(shifted(0, 0, 1), shifted(0, 0, -1))});
            ASSERT_EQ(found.verdict, Verdict::contact) << x << ", " << y;
            EXPECT_NEAR(found.time.lower, 0.5, 1e-12);
        }
}

/// The screw must be defined also just above the largest turn of one piece.
TEST(HardCases, TurnsAroundTheLongestPieceFindTheSameContact) {
    const Polyhedron bar = box({1, 0.05, 0.05}).polyhedron();
    const Polyhedron post = box({0.02, 0.02, 1}).polyhedron();
    const double longest = pi - 2e-3;
    for (const double part : {1 - 1e-9, 1.0, 1 + 0.5e-9, 1 + 0.99e-9, 1 + 1.01e-9, 1 + 1e-8}) {
        const double angle = longest * part;
        const Pose post_pose = turned(0.8 * Eigen::Vector3d(std::cos(1.5), std::sin(1.5), 0), {0, 0, 1}, 1.5);
        const FirstContact found = first_contact(
            {.moving = bar,
             .fixed = post,
             .motion = ScrewMotion::relative(Pose(), turned({0, 0, 0}, {0, 0, 1}, angle), post_pose, post_pose, pi)});
        ASSERT_EQ(found.verdict, Verdict::contact) << part;
        const double contact_angle = 1.5 - std::asin(0.05 / 0.78) - 0.02 / 0.78;
        EXPECT_NEAR(found.time.lower * angle, contact_angle, 2e-3) << part;
    }
}

TEST(HardCases, BoxLiftedOffATableHasItsNormalFromTheTable) {
    const Polyhedron body = box({0.5, 0.5, 0.5}).polyhedron();
    const Polyhedron table = box({5, 5, 0.5}).polyhedron();
    for (const double way : {1.0, -1.0}) {
        const FirstContact found =
            first_contact({.moving = body,
                           .fixed = table,
                           .motion = ScrewMotion::between(shifted(0, 0, 1), shifted(0, 0, 1 + way)),
                           .options = {.find = Find::first_with_all_contacts}});
        ASSERT_EQ(found.verdict, Verdict::contact_at_start);
        ASSERT_FALSE(found.contacts.empty());
        for (const Contact& contact : found.contacts) {
            EXPECT_TRUE(contact.normal.isApprox(Eigen::Vector3d::UnitZ())) << contact.normal.transpose();
            EXPECT_NEAR(contact.approach_speed, -way, 1e-12);
        }
    }
}

/// An end of the needle is within the error bound of the sliver's plane, but outside the sliver.
TEST(HardCases, NeedleThroughASliverOverlapsAtTheStart) {
    const Polyhedron sliver = triangle({0, 0, 0}, {1, 0, 0}, {0.5, 1e-9, 0}).polyhedron();
    const Polyhedron spike =
        triangle({0.5, 1.03e-8, 1e-7}, {0.5, -9.7e-9, -1e-7}, {0.5 + 1e-11, -9.7e-9, -1e-7}).polyhedron();
    for (const double sideways : {0.0, 3.0}) {
        const FirstContact found = first_contact(
            {.moving = spike, .fixed = sliver, .motion = ScrewMotion::between(Pose(), shifted(0, sideways, 0))});
        EXPECT_EQ(found.verdict, Verdict::contact_at_start);
    }
}

/// A corner moves straight into a face at half time. Depending on the case, two pieces of the screw join at this time.
TEST(HardCases, ContactBetweenTwoPiecesOfAScrewIsCertain) {
    const Polyhedron block = box({1, 1, 1}).polyhedron();
    for (const double degrees : {3.0, 9.0, 11.0, 19.0, 21.0, 31.0, 41.0}) {
        const double half = degrees * pi / 360;
        const auto tip_at = [&](double angle, double x) { return turned({x, 0.1, 0.2}, {1, 0, 0}, angle); };
        const FirstContact found = first_contact({.moving = needle({0, 0, 0}, {1, 0, 0}),
                                                  .fixed = block,
                                                  .motion = ScrewMotion::between(tip_at(-half, 3), tip_at(half, -1))});
        ASSERT_EQ(found.verdict, Verdict::contact) << degrees;
        EXPECT_TRUE(found.certain) << degrees << " degrees";
        EXPECT_NEAR(found.time.lower, 0.5, 1e-3) << "the slide of a piece is not quite uniform";
        EXPECT_LE(found.time.upper - found.time.lower, 1e-12) << degrees;
    }
}

TEST(HardCases, CornerThatHitsExactlyAnEdgeIsCertain) {
    const Polyhedron block = box({1, 1, 1}).polyhedron();
    const auto answer = [&](double x) {
        return first_contact({.moving = needle({x, 0, 0}, {0.5, 0, 1}),
                              .fixed = block,
                              .motion = ScrewMotion::between(shifted(0, 0, 3), shifted(0, 0, 0))});
    };
    const FirstContact through = answer(1);
    EXPECT_EQ(through.verdict, Verdict::contact);
    EXPECT_TRUE(through.certain) << "also where it slides down the side";
    const FirstContact into = first_contact({.moving = needle({1, 0, 0}, {0.5, 0, 1}),
                                             .fixed = block,
                                             .motion = ScrewMotion::between(shifted(1, 0, 2), shifted(-1, 0, 0))});
    EXPECT_EQ(into.verdict, Verdict::contact);
    EXPECT_TRUE(into.certain) << "it goes in through the edge";
    EXPECT_NEAR(into.time.lower, 0.5, 1e-12);
}

TEST(HardCases, LargeTurnsInOnePieceKeepTimeInsideItsBracket) {
    // A point on a long arm at a known angle. For all turns up to the largest, the bracket of time must contain
    // angle / turn.
    const Polyhedron arm = needle({1, 0, 0}, {-0.5, 0, 0});
    for (const double turn : {2.0, 2.8, 3.0, 3.1, 3.13}) {
        const double at = 0.9 * turn;
        const Eigen::Vector3d there(std::cos(at), std::sin(at), 0);
        const Polyhedron wall = Polyhedron::from_polygons(
            Vertices{0.5 * there - Eigen::Vector3d(0, 0, 1), 2 * there - Eigen::Vector3d(0, 0, 1),
                     2 * there + Eigen::Vector3d(0, 0, 1), 0.5 * there + Eigen::Vector3d(0, 0, 1)},
            Faces{{0, 1, 2, 3}});
        const FirstContact found =
            first_contact({.moving = arm,
                           .fixed = wall,
                           .motion = ScrewMotion::between(Pose(), turned({0, 0, 0}, {0, 0, 1}, turn), pi)});
        ASSERT_EQ(found.verdict, Verdict::contact);
        EXPECT_NEAR(found.time.lower, 0.9, 1e-10) << "the needle is 1e-12 wide";
        EXPECT_LE(found.time.lower, 0.9 + 1e-15);
    }
}

/// A plate rolls over the tip of a spike: it is 1e-13 above the tip at the start, and touches it at time 5e-6.
TEST(HardCases, PlateRollsIntoATipJustAfterTheStart) {
    const double off = 0x1.a57ae9583cbeap-21;
    const Vertices corners{{-3, 3, 1}, {3, 3, 1}, {3, -3, 1}, {-3, -3, 1}, {0, 0, 0.7}};
    const Polyhedron plate =
        Polyhedron::from_polygons(corners, Faces{{0, 1, 2, 3}, {4, 1, 0}, {4, 2, 1}, {4, 3, 2}, {4, 0, 3}});
    const Vertices tip{{0, -off, 1}, {0.05, 0.01, 1.5}, {-0.03, -0.03, 1.5}, {-0.03, 0.05, 1.5}};
    const Polyhedron spike = Polyhedron::from_polygons(tip, Faces{{2, 1, 0}, {3, 2, 0}, {1, 3, 0}, {1, 2, 3}});
    const auto turned_by = [](double angle) {
        return Pose(Eigen::Vector3d::Zero(), Eigen::Quaterniond(std::cos(angle / 2), std::sin(angle / 2), 0, 0));
    };
    const FirstContact found = first_contact(
        {.moving = plate,
         .fixed = spike,
         .motion = ScrewMotion::between(turned_by(0x1.62872d48754fbp-21), turned_by(-0x1.10bc89b1cf9f6p-3))});
    EXPECT_EQ(found.verdict, Verdict::contact);
    EXPECT_TRUE(found.certain);
    EXPECT_NEAR(found.time.lower, 4.9586708e-06, 1e-9);
}

/// A prism over a polygon, between two heights. Its caps are one polygon each, or triangles of a fan at the origin.
Polyhedron prism(const std::vector<Eigen::Vector2d>& outline, double height, bool cuts_caps) {
    Body body;
    const auto count = std::uint32_t(outline.size());
    for (const double z : {0.0, height})
        for (const Eigen::Vector2d& corner : outline)
            body.vertices.emplace_back(corner.x(), corner.y(), z);
    body.faces.resize(cuts_caps ? 0 : 2);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t next = (i + 1) % count;
        body.faces.push_back({i, next, count + next, count + i});
        if (cuts_caps) {
            body.faces.push_back({2 * count, next, i});
            body.faces.push_back({2 * count + 1, count + i, count + next});
        } else {
            body.faces[0].insert(body.faces[0].begin(), i);
            body.faces[1].push_back(count + i);
        }
    }
    if (cuts_caps) {
        body.vertices.emplace_back(0, 0, 0);
        body.vertices.emplace_back(0, 0, height);
    }
    return body.polyhedron();
}

/// A gear or a star: corners around the origin at random distances.
std::vector<Eigen::Vector2d> random_star(std::mt19937& random, int count) {
    std::vector<Eigen::Vector2d> outline;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * pi * i / count;
        outline.emplace_back(uniform(random, 0.3, 1) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    return outline;
}

/// Parts of one height whose caps are polygons with notches, as extruded parts are. They were in contact at the start
/// wherever an edge of one lay in the notch of the other one.
TEST(HardCases, FlushPartsBesideTheNotchesOfPolygonsAreApart) {
    std::mt19937 random(57);
    int clear = 0, contacts = 0, at_start = 0;
    for (int i = 0; i < 400; ++i) {
        SCOPED_TRACE("seed 57, case " + std::to_string(i));
        const auto moving = random_star(random, 9), fixed = random_star(random, 11);
        const Pose start = shifted(uniform(random, -1.4, 1.4), uniform(random, -1.4, 1.4), 0);
        const Pose goal = composed(start, turned({uniform(random, -0.6, 0.6), uniform(random, -0.6, 0.6), 0}, {0, 0, 1},
                                                 uniform(random, -0.3, 0.3)));
        const Motion motion = Motion::velocity(start, goal);
        const auto found = [&](bool cuts_caps) {
            return first_contact(
                {.moving = prism(moving, 1, cuts_caps), .fixed = prism(fixed, 1, cuts_caps), .motion = motion});
        };
        const FirstContact whole = found(false), cut = found(true);
        ASSERT_EQ(whole.verdict, cut.verdict);
        EXPECT_NEAR(whole.time.lower, cut.time.lower, 1e-9);
        clear += whole.verdict == Verdict::clear ? 1 : 0;
        contacts += whole.verdict == Verdict::contact ? 1 : 0;
        at_start += whole.verdict == Verdict::contact_at_start ? 1 : 0;
    }
    EXPECT_GT(clear, 60);
    EXPECT_GT(contacts, 20);
    EXPECT_GT(at_start, 60);
}

} // namespace
} // namespace chasles::test
