// Round bodies against closed forms, against margins of their polyhedra, and bodies that may overlap a little.
#include "chasles/mesh/primitives.h"
#include "chasles/query/least_distance.h"
#include "tests/query/bodies.h"
#include "tests/support/random_poses.h"
#include "tests/support/segment_distance.h"

#include <array>
#include <cstdlib>
#include <gtest/gtest.h>
#include <numbers>
#include <optional>

namespace chasles::test {
namespace {

using Eigen::Vector3d;

int rounds() {
    return std::getenv("CHASLES_LONG") ? 10'000 : 1'000; // NOLINT(concurrency-mt-unsafe)
}

Pose at(const Vector3d& place) {
    return {place, Eigen::Quaterniond::Identity()};
}

/// The first time in [0, 1] at which a point that moves along a line is at a distance from the origin; empty if it
/// stays farther away, and NaN where rounding decides.
std::optional<double> meeting(const Vector3d& start, const Vector3d& way, double reach) {
    using Long = Eigen::Matrix<long double, 3, 1>;
    const Long from = start.cast<long double>(), along = way.cast<long double>();
    const long double square = along.squaredNorm(), half = from.dot(along),
                      rest = from.squaredNorm() - static_cast<long double>(reach) * reach;
    if (rest < 0)
        return 0;
    const long double root = half * half - square * rest;
    if (std::abs(root) < 1e-6L * half * half)
        return std::nan("");
    if (root < 0 || half > 0)
        return std::nullopt;
    const long double time = rest / (-half + std::sqrt(root));
    return time <= 1 ? std::optional(double(time)) : std::nullopt;
}

TEST(Spheres, MeetWhenTheClosedFormSays) {
    Random random(4405);
    int contacts = 0, clear = 0;
    for (int round = 0; round < rounds(); ++round) {
        const double first = std::pow(10.0, random.uniform(-3, 1)), second = std::pow(10.0, random.uniform(-3, 1));
        const Vector3d start = random_point(random, 10),
                       goal = random.chance(0.5) ? random_point(random, 3) : Vector3d(-start + random_point(random, 1));
        const std::optional<double> time = meeting(start, goal - start, first + second);
        if (time && std::isnan(*time))
            continue;
        const FirstContact found =
            first_contact({make_sphere(first), make_sphere(second), ScrewMotion::between(at(start), at(goal))});
        ASSERT_EQ(found.verdict, !time       ? Verdict::clear
                                 : *time > 0 ? Verdict::contact
                                             : Verdict::contact_at_start)
            << round;
        EXPECT_TRUE(found.certain);
        ++(time ? contacts : clear);
        if (!time || *time == 0)
            continue;
        EXPECT_LE(found.time.lower, *time + 1e-14);
        EXPECT_NEAR(found.time.lower, *time, 2e-12);
        ASSERT_EQ(found.contacts.size(), 1U);
        const Contact& contact = found.contacts.front();
        const Vector3d centre = start + *time * (goal - start);
        EXPECT_TRUE(contact.normal.isApprox(centre.normalized(), 1e-9));
        EXPECT_TRUE(contact.point.isApprox(second * centre.normalized(), 1e-9));
        EXPECT_NEAR(contact.gap, 0, 1e-9);
        EXPECT_NEAR(contact.approach_speed, -contact.normal.dot(goal - start), 1e-7);
    }
    EXPECT_GT(contacts, rounds() / 10);
    EXPECT_GT(clear, rounds() / 10);
}

/// On an arm that turns: the sphere meets the fixed one at an angle that the law of cosines gives.
TEST(Spheres, OnAnArmMeetAtTheAngleOfTheClosedForm) {
    Random random(4406);
    int contacts = 0;
    for (int round = 0; round < rounds(); ++round) {
        const double arm = random.uniform(0.5, 2), angle = random.uniform(0.2, 3), middle = random.uniform(0.3, 3.5),
                     away = random.uniform(0.5, 2), reach = random.uniform(0.05, 0.3);
        const double cosine = (arm * arm + away * away - reach * reach) / (2 * arm * away);
        const bool meets = std::abs(cosine) < 1, is_in_time = meets && middle - std::acos(cosine) < angle;
        if (std::abs(std::abs(cosine) - 1) < 1e-3 || middle - std::acos(std::min(cosine, 1.0)) < 1e-3 ||
            std::abs(middle - std::acos(std::min(cosine, 1.0)) - angle) < 1e-3)
            continue;
        const Eigen::AngleAxisd turn(angle, Vector3d::UnitZ());
        const Pose start = at({arm, 0, 0}), goal(turn * Vector3d(arm, 0, 0), Eigen::Quaterniond(turn));
        const Pose there = at({away * std::cos(middle), away * std::sin(middle), 0});
        const FirstContact found = first_contact(
            {make_sphere(reach / 4), make_sphere(0.75 * reach), ScrewMotion::relative(start, goal, there, there)});
        ASSERT_EQ(found.verdict, is_in_time ? Verdict::contact : Verdict::clear) << round;
        if (!is_in_time)
            continue;
        EXPECT_NEAR(found.time.lower, (middle - std::acos(cosine)) / angle, 3e-12 / angle + 1e-12);
        ++contacts;
    }
    EXPECT_GT(contacts, rounds() / 20);
}

Segment3 placed(const Pose& pose, double length) {
    return {pose.isometry() * Vector3d(0, 0, -length / 2), pose.isometry() * Vector3d(0, 0, length / 2)};
}

TEST(Capsules, AreAtTheSumOfTheirRadiiWhenTheyMeet) {
    Random random(4407);
    int contacts = 0, clear = 0;
    for (int round = 0; round < rounds(); ++round) {
        const double length = random.uniform(0.2, 3), other = random.uniform(0.2, 3);
        const double reach = std::pow(10.0, random.uniform(-3, -0.3));
        const Pose start = random_pose(random, 3);
        Pose goal = random_goal(random, start, 2, 1);
        goal.translation -= 2 * start.translation;
        const Motion motion =
            random.chance(0.5) ? Motion(ScrewMotion::between(start, goal)) : Motion::velocity(start, goal);
        const FirstContact found =
            first_contact({make_capsule(reach / 4, length), make_capsule(0.75 * reach, other), motion});
        const auto distance_at = [&](double time) {
            return distance_of_segments(placed(motion.pose_at(time), length), placed(Pose(), other));
        };
        EXPECT_TRUE(found.certain) << round;
        const double until = found.verdict == Verdict::clear ? 1 : found.time.lower;
        const int samples = found.verdict == Verdict::contact_at_start ? 0 : 64;
        for (int i = 0; i < samples; ++i)
            EXPECT_GE(distance_at(until * i / 63), reach * (1 - 1e-11) - 1e-14) << round;
        if (found.verdict != Verdict::clear) {
            EXPECT_LE(distance_at(found.time.upper), reach + 2e-11) << round;
        }
        ++(found.verdict == Verdict::clear ? clear : contacts);
        if (found.verdict != Verdict::contact)
            continue;
        const Contact& contact = found.contacts.front();
        EXPECT_NEAR(distance_to_segment(contact.point, placed(Pose(), other)), 0.75 * reach, 1e-9) << round;
        const Vector3d on_moving = contact.point + contact.gap * contact.normal;
        EXPECT_NEAR(distance_to_segment(on_moving, placed(found.pose, length)), reach / 4, 1e-9) << round;
    }
    EXPECT_GT(contacts, rounds() / 10);
    EXPECT_GT(clear, rounds() / 10);
}

Polyhedron random_box(Random& random) {
    return box({random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1)}).polyhedron();
}

/// Radii that are sums of few powers of two, so that sums of them are exact.
double dyadic(Random& random) {
    return random.integer(0, 8) * 0x1p-6;
}

/// Whether polyhedra start within a distance: a hold is for bodies with a gap.
bool overlap_at_start(const Polyhedron& moving, const Polyhedron& fixed, const Motion& motion, double distance) {
    return first_contact({moving, fixed, motion, {.margin = distance}}).verdict == Verdict::contact_at_start;
}

void expect_moved_out(const Contact& round, const Contact& plain, double of_moving, double of_fixed) {
    EXPECT_EQ(round.kind, plain.kind);
    EXPECT_EQ(round.moving, plain.moving);
    EXPECT_EQ(round.fixed, plain.fixed);
    EXPECT_EQ(round.normal, plain.normal);
    EXPECT_EQ(round.approach_speed, plain.approach_speed);
    EXPECT_NEAR(round.gap, plain.gap - of_moving - of_fixed, 1e-15);
    EXPECT_TRUE(round.point.isApprox(plain.point + of_fixed * plain.normal, 1e-14));
}

TEST(RoundBodies, AnswerAsTheirPolyhedraWithALargerMargin) {
    Random random(4408);
    for (int round = 0; round < rounds() / 2; ++round) {
        const Polyhedron moving = random_box(random), fixed = random_box(random);
        const double a = dyadic(random), b = dyadic(random), margin = dyadic(random);
        const Pose start = random_pose(random, 3);
        const Motion motion = random.chance(0.5) ? Motion(ScrewMotion::between(start, random_goal(random, start, 1, 4)))
                                                 : Motion::twist(start, random_goal(random, start, 1, 4));
        QueryOptions options{.margin = margin, .find = Find::first_with_all_contacts};
        const bool holds = margin > 0 && random.chance(0.5) && !overlap_at_start(moving, fixed, motion, a + b);
        if (holds)
            options.hold = margin / 2;
        const FirstContact found = first_contact({moving.with_radius(a), fixed.with_radius(b), motion, options});
        options.margin += a + b;
        if (holds)
            *options.hold += a + b;
        if (options.margin == 0)
            continue;
        const FirstContact plain = first_contact({moving, fixed, motion, options});
        ASSERT_EQ(found.verdict, plain.verdict) << round;
        EXPECT_EQ(found.time.lower, plain.time.lower);
        EXPECT_EQ(found.time.upper, plain.time.upper);
        EXPECT_EQ(found.clear_until, plain.clear_until);
        EXPECT_EQ(found.certain, plain.certain);
        ASSERT_EQ(found.contacts.size(), plain.contacts.size());
        for (std::size_t i = 0; i < found.contacts.size(); ++i)
            expect_moved_out(found.contacts[i], plain.contacts[i], a, b);
        ASSERT_EQ(found.held.size(), plain.held.size());
    }
}

TEST(RoundBodies, LeastDistancesAreLessByTheRadii) {
    Random random(4409);
    int apart = 0;
    for (int round = 0; round < rounds() / 4; ++round) {
        const Polyhedron moving = random_box(random), fixed = random_box(random);
        const double a = random.uniform(0, 0.3), b = random.uniform(0, 0.3);
        const Pose start = random_pose(random, 4);
        const Motion motion = ScrewMotion::between(start, random_goal(random, start, 1, 1));
        const LeastDistance plain = least_distance({moving, fixed, motion}),
                            found = least_distance({moving.with_radius(a), fixed.with_radius(b), motion});
        EXPECT_TRUE(found.certain) << round;
        EXPECT_GE(found.distance.upper, std::max(0.0, plain.distance.lower - a - b) * (1 - 1e-12)) << round;
        EXPECT_LE(found.distance.lower, std::max(0.0, plain.distance.upper - a - b) * (1 + 1e-12)) << round;
        EXPECT_LE(found.distance.upper - found.distance.lower, 1e-6 * found.distance.upper + 1e-12) << round;
        if (found.distance.lower > 0) {
            EXPECT_NEAR(found.contacts.front().gap, found.distance.upper, 1e-9) << round;
            ++apart;
        }
    }
    EXPECT_GT(apart, 10);
}

TEST(RoundBodies, MayBeInsideOfSolids) {
    const Polyhedron room = box({1, 1, 1}).polyhedron(), ball = make_sphere(0.25);
    const auto at = [&](double x) { return ScrewMotion::between(shifted(x, 0, 0), shifted(x, 0, 0)); };
    const FirstContact inside = first_contact({ball, room, at(0)});
    EXPECT_EQ(inside.verdict, Verdict::contact_at_start);
    EXPECT_TRUE(inside.inside && inside.inside->moving_is_inside);
    EXPECT_FALSE(first_contact({ball, room, at(0.875)}).inside) << "the surfaces meet";
    EXPECT_EQ(first_contact({ball, room, at(1.125)}).verdict, Verdict::contact_at_start);
    EXPECT_LT(first_contact({ball, room, at(1.125)}).contacts.front().gap, 0);
    EXPECT_EQ(first_contact({ball, room, at(1.5)}).verdict, Verdict::clear);
    const Polyhedron surface =
        Polyhedron::from_polygons(box({1, 1, 1}).vertices, box({1, 1, 1}).faces, {.solid = Solid::no});
    EXPECT_EQ(first_contact({ball, surface, at(0)}).verdict, Verdict::clear);
}

Pose placed_in(const Pose& frame, const Pose& pose) {
    const Eigen::Quaterniond turn = frame.rotation.normalized();
    return {turn * pose.translation + frame.translation, turn * pose.rotation.normalized()};
}

/// Cores that coincide have no direction from one to the other.
TEST(RoundBodies, MayHaveTheSameMiddle) {
    const std::array bodies{make_sphere(0.5), make_sphere(0.25), make_capsule(0.5, 1), make_capsule(0.25, 2),
                            make_points(std::array{Vector3d(0, 0, 0), Vector3d(0, 0, 1)}, 0.5)};
    for (const Polyhedron& moving : bodies)
        for (const Polyhedron& fixed : bodies)
            for (const Find find : {Find::first, Find::any, Find::first_with_all_contacts})
                for (const double margin : {0.0, 0.25}) {
                    QueryOptions options{.margin = margin, .find = find};
                    if (margin > 0)
                        options.hold = 0.1;
                    const FirstContact found =
                        first_contact({moving, fixed, ScrewMotion::between(Pose(), shifted(1, 0, 0)), options});
                    ASSERT_EQ(found.verdict, Verdict::contact_at_start);
                    ASSERT_FALSE(found.contacts.empty());
                    double least = 0;
                    for (const Contact& contact : found.contacts) {
                        EXPECT_NEAR(contact.normal.norm(), 1, 1e-12);
                        least = std::min(least, contact.gap);
                    }
                    if (find == Find::first_with_all_contacts) {
                        EXPECT_NEAR(least, -moving.radius() - fixed.radius(), 1e-15);
                    }
                }
}

/// A box that stands on a table, at a gap of 0 and of a rounding after a rigid transform of both.
TEST(AllowedOverlaps, BodiesThatTouchMayLiftSlideAndTurn) {
    Random random(4410);
    const double allowed = 1e-6;
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron().with_radius(-allowed),
                     table = box({5, 5, 1}).polyhedron();
    const int count = std::getenv("CHASLES_LONG") ? 1'000 : 200; // NOLINT(concurrency-mt-unsafe)
    for (int round = 0; round < count; ++round) {
        const Pose frame = round == 0 ? Pose() : random_pose(random, 10);
        const Pose of_table = placed_in(frame, shifted(0, 0, -1)), start = placed_in(frame, shifted(0, 0, 0.5));
        const auto ask = [&](const Pose& goal) {
            return first_contact(
                {cube, table, ScrewMotion::relative(start, placed_in(frame, goal), of_table, of_table)});
        };
        EXPECT_EQ(ask(shifted(0, 0, 1.5)).verdict, Verdict::clear) << "lifted";
        EXPECT_EQ(ask(shifted(2, 1, 0.5)).verdict, Verdict::clear) << "slides";
        const Eigen::Quaterniond turn(Eigen::AngleAxisd(1, Vector3d::UnitZ()));
        EXPECT_EQ(ask(Pose({0, 0, 0.5}, turn)).verdict, Verdict::clear) << "turns";
        const FirstContact pressed = ask(shifted(0, 0, 0.25));
        EXPECT_EQ(pressed.verdict, Verdict::contact);
        EXPECT_NEAR(pressed.time.lower, allowed / 0.25, 1e-12) << "pressed";
        EXPECT_EQ(ask(Pose({0, 0, 0.5}, Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Vector3d::UnitX())))).verdict,
                  Verdict::contact)
            << "tilted";
    }
}

/// A round peg of as many sides as the hole that it fills.
TEST(AllowedOverlaps, APegFillsItsHole) {
    const int sides = 48;
    Body peg, plate;
    for (const double height : {0.0, 1.0})
        for (int i = 0; i < sides; ++i) {
            const double angle = 2 * std::numbers::pi * i / sides;
            peg.vertices.emplace_back(std::cos(angle), std::sin(angle), height);
        }
    plate.vertices = peg.vertices;
    for (const double height : {0.0, 1.0})
        for (int i = 0; i < sides; ++i) {
            const double angle = 2 * std::numbers::pi * i / sides;
            plate.vertices.emplace_back(2 * std::cos(angle), 2 * std::sin(angle), height);
        }
    const auto n = std::uint32_t(sides);
    std::vector<std::uint32_t> bottom, top;
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        bottom.insert(bottom.begin(), i);
        top.push_back(n + i);
        peg.faces.push_back({i, j, n + j, n + i});
        plate.faces.push_back({i, n + i, n + j, j});                         // the hole
        plate.faces.push_back({2 * n + i, 2 * n + j, 3 * n + j, 3 * n + i}); // outside
        plate.faces.push_back({i, j, 2 * n + j, 2 * n + i});                 // below
        plate.faces.push_back({n + i, 3 * n + i, 3 * n + j, n + j});         // above
    }
    peg.faces.push_back(bottom);
    peg.faces.push_back(top);
    const auto made = [](const Body& body, double radius) {
        return Polyhedron::from_polygons(body.vertices, body.faces, {.triangulate = true, .radius = radius});
    };
    const Polyhedron hole = made(plate, 0);
    ASSERT_EQ(hole.report().solid_parts, 1U);
    const double sagitta = 1 - std::cos(std::numbers::pi / sides);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(1, Vector3d::UnitZ()));
    const auto ask = [&](double radius, const Pose& goal) {
        return first_contact({made(peg, radius), hole, ScrewMotion::between(Pose(), goal)}).verdict;
    };
    EXPECT_EQ(ask(0, shifted(0, 0, 3)), Verdict::contact_at_start);
    EXPECT_EQ(ask(-1e-9, shifted(0, 0, 3)), Verdict::clear);
    EXPECT_EQ(ask(-1.1 * sagitta, Pose({0, 0, 1}, turn)), Verdict::clear);
    EXPECT_EQ(ask(-1e-9, shifted(0.1, 0, 0)), Verdict::contact);
}

/// Ten boxes on each other, of which each may be lifted after those above it, all with the overlap that is allowed.
TEST(AllowedOverlaps, AStackIsTakenApart) {
    const Polyhedron cube = box({0.5, 0.5, 0.05}).polyhedron().with_radius(-1e-6);
    for (int lifted = 9; lifted > 0; --lifted)
        for (int below = 0; below < lifted; ++below) {
            const Pose start = shifted(0, 0, 0.1 * lifted), other = shifted(0, 0, 0.1 * below);
            EXPECT_EQ(
                first_contact({cube, cube, ScrewMotion::relative(start, shifted(0.2, 0, 2), other, other)}).verdict,
                Verdict::clear)
                << lifted << " over " << below;
        }
}

} // namespace
} // namespace chasles::test
