// First times within a margin in closed form: time, point, features and speed. Also with a margin of 0.
#include "tests/query/bodies.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace chasles::test {
namespace {

using std::numbers::pi;
constexpr double exactness = 1e-9;
constexpr double margins[] = {0, 1e-6, 1e-3, 0.05};

/// The first contact by geometry.
struct Expected {
    double time;
    ContactKind kind;
    Eigen::Vector3d point; ///< on the fixed body
    Eigen::Vector3d normal;
    double approach_speed;
};

void expect_contact(const FirstContactQuery& query, const Expected& expected) {
    SCOPED_TRACE("margin " + std::to_string(query.options.margin));
    const FirstContact found = first_contact(query);
    ASSERT_EQ(found.verdict, Verdict::contact);
    EXPECT_TRUE(found.certain);
    EXPECT_NEAR(found.time.lower, expected.time, exactness);
    EXPECT_NEAR(found.time.upper, expected.time, exactness);
    EXPECT_LE(found.clear_until, found.time.upper);
    EXPECT_NEAR(found.clear_until, expected.time, exactness);
    ASSERT_FALSE(found.contacts.empty());
    const Contact& contact = found.contacts[0];
    if (query.options.margin > 0) { // touching features may be reported as their boundary features
        EXPECT_EQ(contact.kind, expected.kind);
    }
    EXPECT_LE((contact.point - expected.point).norm(), exactness)
        << contact.point.transpose() << " instead of " << expected.point.transpose();
    EXPECT_NEAR(contact.gap, query.options.margin, exactness);
    const double margin = query.options.margin; // ends of the normal are known to some units of rounding
    const double of_direction = margin > 0 ? std::max(exactness, 1e-14 / margin) : exactness;
    EXPECT_NEAR(contact.approach_speed, expected.approach_speed, of_direction * (1 + expected.approach_speed));
    EXPECT_LE((contact.normal - expected.normal).norm(), 1e-7) << contact.normal.transpose();
}

FirstContactQuery query_of(const Polyhedron& moving, const Polyhedron& fixed, const Motion& motion, double margin) {
    return {.moving = moving, .fixed = fixed, .motion = motion, .options = {.margin = margin}};
}

std::vector<Motion> both_motions(const Pose& start, const Pose& goal) {
    return {ScrewMotion::between(start, goal), SweepMotion::between(start, goal)};
}

// --- Translations
// ----------------------------------------------------------------------------------------------------

/// The tip of a pyramid, down or up. Its faces are steep: the tip is the nearest point to any body ahead.
Polyhedron spike(double up) {
    return Body{{{0, 0, 0}, {0.2, 0.2, -2 * up}, {-0.2, 0.2, -2 * up}, {0, -0.2, -2 * up}},
                {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}}
        .polyhedron();
}

/// A corner falls on the top of a table at z = 0.5: the fall of 4 takes the whole time.
TEST(ClosedFormMargin, CornerOfATiltedBoxOverATable) {
    const Polyhedron moving = box({0.5, 0.4, 0.3}).polyhedron();
    const Polyhedron table = box({5, 5, 0.5}).polyhedron();
    const Eigen::AngleAxisd tilt(0.5, Eigen::Vector3d(1, 0.3, 0.2).normalized());
    Eigen::Vector3d lowest(0, 0, 9);
    for (const Eigen::Vector3d& v : moving.vertices())
        lowest = (tilt * v).z() < lowest.z() ? Eigen::Vector3d(tilt * v) : lowest;
    const Pose start({0.1, 0.2, 4}, Eigen::Quaterniond(tilt));
    const Pose goal({0.1, 0.2, 0}, Eigen::Quaterniond(tilt));
    for (const double margin : margins)
        for (const Motion& motion : both_motions(start, goal))
            expect_contact(query_of(moving, table, motion, margin),
                           {(4 + lowest.z() - 0.5 - margin) / 4, ContactKind::vertex_face,
                            Eigen::Vector3d(0.1 + lowest.x(), 0.2 + lowest.y(), 0.5), Eigen::Vector3d::UnitZ(), 4});
}

TEST(ClosedFormMargin, ABoxComesFlatOverATable) {
    const Polyhedron moving = box({0.5, 0.5, 0.5}).polyhedron();
    const Polyhedron table = box({5, 5, 0.5}).polyhedron();
    for (const double margin : margins)
        for (const Motion& motion : both_motions(shifted(0.25, 0, 3), shifted(0.25, 0, -1))) {
            FirstContactQuery query = query_of(moving, table, motion, margin);
            query.options.find = Find::first_with_all_contacts;
            const FirstContact found = first_contact(query);
            ASSERT_EQ(found.verdict, Verdict::contact);
            EXPECT_TRUE(found.certain);
            EXPECT_NEAR(found.time.lower, (2 - margin) / 4, exactness);
            EXPECT_EQ(found.contacts.size(), 4u) << "one per corner";
            for (const Contact& contact : found.contacts) {
                EXPECT_NEAR(std::abs(contact.point.x() - 0.25), 0.5, exactness);
                EXPECT_NEAR(std::abs(contact.point.y()), 0.5, exactness);
                EXPECT_NEAR(contact.point.z(), 0.5, exactness);
                EXPECT_LE((contact.normal - Eigen::Vector3d::UnitZ()).norm(), exactness);
                EXPECT_NEAR(contact.gap, margin, exactness);
                EXPECT_NEAR(contact.approach_speed, 4, 1e-8);
            }
        }
}

/// A roof whose ridge is the x axis from -2 to 2.
Body roof(double up) {
    return {{{-2, 0, 0}, {2, 0, 0}, {-2, 1, -up}, {2, 1, -up}, {-2, -1, -up}, {2, -1, -up}},
            {{0, 1, 3, 2}, {1, 0, 4, 5}, {2, 3, 5, 4}, {0, 2, 4}, {1, 5, 3}}};
}

/// Ridge over ridge, turned by an angle about z. The common normal is along z at the crossing of both ridges.
TEST(ClosedFormMargin, EdgeOverEdgeAtAnAngle) {
    const Polyhedron above = roof(-1).polyhedron();
    const Polyhedron below = roof(1).polyhedron();
    for (const double angle : {0.01, 0.3, 1.0, pi / 2, 2.8})
        for (const double margin : margins) {
            SCOPED_TRACE("angle " + std::to_string(angle));
            const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
            const Eigen::Vector3d aside = 0.25 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
            const Pose start(aside + Eigen::Vector3d(0.5, 0, 2), turn);
            const Pose goal(aside + Eigen::Vector3d(0.5, 0, -1), turn);
            for (const Motion& motion : both_motions(start, goal))
                expect_contact(query_of(above, below, motion, margin),
                               {(2 - margin) / 3, ContactKind::edge_edge, Eigen::Vector3d(0.5, 0, 0),
                                Eigen::Vector3d::UnitZ(), 3});
        }
}

/// A tip falls past a tip at the distance `aside` in x: the distance is the margin at the height
/// sqrt(margin^2 - aside^2).
TEST(ClosedFormMargin, CornerBesideCorner) {
    const Polyhedron down = spike(-1);
    const Polyhedron up = spike(1);
    for (const double margin : {1e-6, 1e-3, 0.05})
        for (const double share : {0.0, 0.05}) {
            const double aside = share * margin;
            const double height = std::sqrt(margin * margin - aside * aside);
            const Eigen::Vector3d normal = Eigen::Vector3d(aside, 0, height) / margin;
            for (const Motion& motion : both_motions(shifted(aside, 0, 2), shifted(aside, 0, -2)))
                expect_contact(query_of(down, up, motion, margin),
                               {(2 - height) / 4, ContactKind::vertex_vertex, Eigen::Vector3d::Zero(), normal,
                                4 * height / margin});
        }
}

/// A tip falls past a ridge: the same in the plane perpendicular to the ridge.
TEST(ClosedFormMargin, CornerBesideEdge) {
    const Polyhedron down = spike(-1);
    const Polyhedron below = roof(1).polyhedron();
    for (const double margin : {1e-6, 1e-3, 0.05})
        for (const double share : {0.0, 0.05, -0.09}) {
            const double aside = share * margin;
            const double height = std::sqrt(margin * margin - aside * aside);
            for (const Motion& motion : both_motions(shifted(0.7, aside, 2), shifted(0.7, aside, -2)))
                expect_contact(query_of(down, below, motion, margin),
                               {(2 - height) / 4, ContactKind::vertex_edge, Eigen::Vector3d(0.7, 0, 0),
                                Eigen::Vector3d(0, aside, height) / margin, 4 * height / margin});
        }
}

// --- Turns about an axis
// ----------------------------------------------------------------------------------------------

/// For a turn by `whole`: the time at which the body has turned by `angle`, and the angular speed at this time.
struct Clock {
    double time;
    double speed;
};

/// The screw turns uniformly.
Clock screw_clock(double angle, double whole) {
    return {angle / whole, whole};
}

/// The sweep turns by 2 atan(N / D), N = t sin(w/2), D = 1 - t (1 - cos(w/2)); with T = tan(angle/2) this gives
/// t = T / (sin(w/2) + T (1 - cos(w/2))), and the speed is 2 (N' D - N D') / (N^2 + D^2).
Clock sweep_clock(double angle, double whole) {
    const double s = std::sin(whole / 2);
    const double c = 1 - std::cos(whole / 2);
    const double tangent = std::tan(angle / 2);
    const double t = tangent / (s + tangent * c);
    const double n = t * s;
    const double d = 1 - t * c;
    return {t, 2 * (s * d + n * c) / (n * n + d * d)};
}

Eigen::Vector3d direction(double angle) {
    return {std::cos(angle), std::sin(angle), 0};
}

/// A post with a vertical edge at `distance` and `angle` from the z axis that points against the turn.
Body post(const Eigen::Vector3d& pivot, double distance, double angle) {
    const Eigen::Vector3d edge = pivot + distance * direction(angle);
    const Eigen::Vector3d ahead = 0.05 * direction(angle + pi / 2);
    const Eigen::Vector3d aside = 0.02 * direction(angle);
    const Eigen::Vector3d up(0, 0, 1);
    return {{edge - up, edge + ahead - aside - up, edge + ahead + aside - up, edge + up, edge + ahead - aside + up,
             edge + ahead + aside + up},
            {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}, {0, 2, 1}, {3, 4, 5}}};
}

struct Bar {
    double whole; ///< turn
    double margin;
    double angle;    ///< at contact
    double distance; ///< distance of the post's edge
    double post_angle;
    Eigen::Vector3d pivot;
};

/// The post's edge is R sin(post_angle - angle) ahead of the bar's middle plane, and the bar's face is `half` ahead of
/// this plane: the gap is R sin(post_angle - angle) - half = margin. The rate of the gap is -R cos(post_angle - angle)
/// times the angular speed.
Expected expected_at(const Bar& bar, const Clock& clock, const FirstContact& found) {
    const Eigen::Vector3d edge = bar.pivot + bar.distance * direction(bar.post_angle);
    const double z = found.contacts.empty() ? 0 : std::copysign(0.2, found.contacts[0].point.z());
    return {clock.time, ContactKind::edge_edge, Eigen::Vector3d(edge.x(), edge.y(), z), -direction(bar.angle + pi / 2),
            bar.distance * std::cos(bar.post_angle - bar.angle) * clock.speed};
}

/// A bar of length 1 turns about the vertical axis through `pivot`, the origin of its frame or the point `centre` of
/// its frame.
TEST(ClosedFormMargin, ABarTurnsAgainstAPost) {
    constexpr double half = 0.03;
    for (const double degrees : {30.0, 45.0, 60.0, 90.0, 120.0, 150.0, 170.0})
        for (const double margin : margins)
            for (const Eigen::Vector3d& centre : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(-0.4, 0.7, 0.1)}) {
                SCOPED_TRACE("turn of " + std::to_string(degrees) + " degrees, margin " + std::to_string(margin));
                const double whole = degrees * pi / 180;
                const Eigen::Vector3d pivot(0.3, -0.2, 0);
                const double distance = 0.8;
                const double post_angle = 0.75 * whole;
                const double angle = post_angle - std::asin((half + margin) / distance);
                const Bar bar{whole, margin, angle, distance, post_angle, pivot};
                Body body = box({0.5, half, 0.2});
                for (Eigen::Vector3d& v : body.vertices)
                    v += Eigen::Vector3d(0.5, 0, 0) + centre;
                const auto pose_at = [&](double turn) {
                    return composed(turned(pivot, Eigen::Vector3d::UnitZ(), turn),
                                    shifted(-centre.x(), -centre.y(), -centre.z()));
                };
                const Polyhedron moving = body.polyhedron();
                const Polyhedron fixed = post(pivot, distance, post_angle).polyhedron();
                const auto ask = [&](const Motion& motion, const Clock& clock) {
                    const FirstContactQuery query = query_of(moving, fixed, motion, margin);
                    expect_contact(query, expected_at(bar, clock, first_contact(query)));
                };
                const ScrewMotion screw = ScrewMotion::between(pose_at(0), pose_at(whole));
                ask(screw.with_max_turn(pi), screw_clock(angle, whole));
                ask(screw.with_max_turn(pi / 18), screw_clock(angle, whole));
                ask(SweepMotion::between(pose_at(0), pose_at(whole), centre), sweep_clock(angle, whole));
            }
}

/// A prism with n sides of length 1 turns about its lower edge at height h over the table z = 0. The next edge is at
/// h + sin(2 pi / n - angle), and reaches the margin after the angle at which the side is level.
TEST(ClosedFormMargin, APrismRollsToItsNextEdge) {
    const Polyhedron table = box({9, 9, 0.5}).polyhedron();
    for (const int sides : {3, 4, 6, 12})
        for (const double margin : {1e-6, 1e-3, 0.05}) {
            SCOPED_TRACE(std::to_string(sides) + " sides, margin " + std::to_string(margin));
            const double step = 2 * pi / sides;
            const double height = 1.5 * margin;
            const double angle = step + std::asin((height - margin) / 1);
            const double whole = angle * 1.25;
            Body prism; // the lower edge is the y axis; the sides follow along x
            Eigen::Vector3d at(0, 0, 0);
            std::vector<std::uint32_t> front;
            std::vector<std::uint32_t> back;
            for (int i = 0; i < sides; ++i) {
                for (const double y : {-0.5, 0.5})
                    prism.vertices.emplace_back(at.x(), y, at.z());
                front.push_back(std::uint32_t(2 * i));
                back.insert(back.begin(), std::uint32_t(2 * i + 1));
                const auto next = std::uint32_t(2 * ((i + 1) % sides));
                prism.faces.push_back({std::uint32_t(2 * i), std::uint32_t(2 * i + 1), next + 1, next});
                at += Eigen::Vector3d(std::cos((i + 1) * step), 0, std::sin((i + 1) * step));
            }
            prism.faces.push_back(front);
            prism.faces.push_back(back);
            const Polyhedron moving = prism.polyhedron();
            const Pose start({0, 0, 0.5 + height}, Eigen::Quaterniond::Identity());
            const Pose goal = turned({0, 0, 0.5 + height}, Eigen::Vector3d::UnitY(), whole); // z x-wards
            const double reach = std::cos(step - angle);
            const auto ask = [&](const Motion& motion, const Clock& clock) {
                const FirstContactQuery query = query_of(moving, table, motion, margin);
                const FirstContact found = first_contact(query);
                const double y = found.contacts.empty() ? 0 : std::copysign(0.5, found.contacts[0].point.y());
                expect_contact(query, {clock.time, ContactKind::vertex_face, Eigen::Vector3d(reach, y, 0.5),
                                       Eigen::Vector3d::UnitZ(), reach * clock.speed});
            };
            ask(ScrewMotion::between(start, goal), screw_clock(angle, whole));
            ask(SweepMotion::between(start, goal), sweep_clock(angle, whole));
        }
}

// --- Starts -------------------------------------------------------------------------------------------------------

/// The nearest points of bodies that are aligned are at corners and on edges, where no test of features is decided.
TEST(ClosedFormMargin, AStartWithinTheMarginIsCertain) {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    for (const Eigen::Vector3d& at :
         {Eigen::Vector3d(0, 0, 1.1), {1, 0, 1.1}, {1, 1, 1.1}, {1.1, 1.1, 1.1}, {0, 1.01, 1}})
        for (const double margin : {0.2, 0.5, 2.0}) {
            const Pose start = shifted(at.x(), at.y(), at.z()), goal = shifted(0, 0, 5);
            const Pose turned_goal = turned({0, 0, 5}, {1, 2, 3}, 1);
            for (const Motion& motion :
                 {Motion(ScrewMotion::between(start, goal)), Motion(SweepMotion::between(start, goal)),
                  Motion::velocity(start, turned_goal), Motion(ScrewMotion::between(start, turned_goal))}) {
                SCOPED_TRACE(at.transpose());
                const FirstContact found = first_contact(query_of(cube, cube, motion, margin));
                EXPECT_EQ(found.verdict, Verdict::contact_at_start);
                EXPECT_TRUE(found.certain);
                EXPECT_EQ(found.clear_until, 0);
            }
        }
}

// --- Where nothing grazes, and each nearest point is at a rim

/// Corners come straight over edges inside the plate and over its vertices.
TEST(ClosedFormMargin, AVertexStraightOverEdgesIsCertain) {
    const Polyhedron cube = box({5, 5, 5}).polyhedron();
    for (const std::uint32_t n : {1U, 3U, 4U, 8U}) {
        const Polyhedron plate = bowed_plate(n, 0, 0);
        for (int x = -5; x <= 5; ++x)
            for (int y = -5; y <= 5; y += 2) {
                SCOPED_TRACE(std::to_string(n) + ": " + std::to_string(x) + " " + std::to_string(y));
                const Pose start = shifted(x, y, 20), goal = shifted(x, y, 0),
                           turned_goal = turned({double(x), double(y), 0}, {0, 0, 1}, 0.3);
                for (const Motion& motion : {Motion(ScrewMotion::between(start, goal)), Motion::velocity(start, goal),
                                             Motion::velocity(start, turned_goal), Motion::twist(start, turned_goal)}) {
                    const FirstContact found = first_contact(query_of(cube, plate, motion, 0.5));
                    ASSERT_EQ(found.verdict, Verdict::contact);
                    EXPECT_TRUE(found.certain);
                    EXPECT_LE(found.time.lower, 0.725 + 1e-15);
                    EXPECT_GE(found.time.upper, 0.725 - 1e-15);
                    EXPECT_LE(found.time.upper - found.time.lower, 5e-12);
                }
            }
    }
}

/// The reserve of `hold` is some roundings, and so is the proof: in one tolerance the plates come no nearer than these.
TEST(ClosedFormMargin, AHeldVertexStraightOverAVertexIsCertain) {
    for (const std::uint32_t n : {4U, 10U, 40U})
        for (const double hold : {0.0, 0.2, 0.3}) {
            const auto found = first_contact({.moving = bowed_plate(n, 2, 0.05),
                                              .fixed = bowed_plate(n, 0, 0),
                                              .motion = ScrewMotion::between(shifted(0, 0, 0), shifted(0, 0, -3)),
                                              .options = {.margin = 2.1, .hold = hold}});
            ASSERT_EQ(found.verdict, Verdict::contact);
            EXPECT_TRUE(found.certain) << n << ' ' << hold;
            EXPECT_NEAR(found.time.lower, (2 - hold) / 3, 1e-11);
        }
}

/// A distance that touches the margin and grows again is no contact that can be proven.
TEST(ClosedFormMargin, ADistanceThatGrazesTheMarginIsUncertain) {
    const Polyhedron cube = box({5, 5, 5}).polyhedron();
    const auto found = first_contact(
        query_of(cube, bowed_plate(4, 0, 0), Motion::polynomial({{0, 0, 6.5}, {0, 0, -4}, {0, 0, 4}}), 0.5));
    ASSERT_EQ(found.verdict, Verdict::contact);
    EXPECT_FALSE(found.certain);
    EXPECT_NEAR(found.time.lower, 0.5, 1e-6);
}

} // namespace
} // namespace chasles::test
