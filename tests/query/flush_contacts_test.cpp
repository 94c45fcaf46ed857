// Boxes of one height that meet: their tops and bottoms stay in two common planes, so the contacts at both heights and
// those of the tops come at times that differ by rounding only. Each contact is listed once, on every motion.
#include "chasles/chasles.h"
#include "tests/support/random_poses.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>

namespace chasles::test {
namespace {

using Eigen::Vector3d;

/// A point or a way in the plane with whole coordinates.
struct Whole {
    std::int64_t x = 0, y = 0;

    friend Whole operator+(const Whole& a, const Whole& b) { return {a.x + b.x, a.y + b.y}; }
    friend Whole operator-(const Whole& a, const Whole& b) { return {a.x - b.x, a.y - b.y}; }
    friend Whole operator*(std::int64_t k, const Whole& a) { return {k * a.x, k * a.y}; }
    friend bool operator==(const Whole&, const Whole&) = default;
    [[nodiscard]] Vector3d placed() const { return {double(x), double(y), 0}; }
};

std::int64_t cross(const Whole& a, const Whole& b) {
    return a.x * b.y - a.y * b.x;
}
std::int64_t dot(const Whole& a, const Whole& b) {
    return a.x * b.x + a.y * b.y;
}

/// Whole corners, counter-clockwise.
using Rectangle = std::array<Whole, 4>;

Rectangle random_outline(Random& random, const Whole& middle) {
    constexpr std::array<Whole, 5> sides{{{1, 0}, {1, 0}, {1, 1}, {3, 4}, {12, 5}}};
    const Whole side = sides[std::size_t(random.integer(0, 4))];
    const Whole along = random.integer(1, 6) * side, across = random.integer(1, 6) * Whole{-side.y, side.x};
    const Whole corner = middle - Whole{(along.x + across.x) / 2, (along.y + across.y) / 2};
    return {corner, corner + along, corner + along + across, corner + across};
}

/// A fraction with a denominator above 0, compared exactly.
struct Fraction {
    std::int64_t above, below;

    Fraction(std::int64_t a, std::int64_t b) : above(b < 0 ? -a : a), below(b < 0 ? -b : b) {}
    friend bool operator==(const Fraction& a, const Fraction& b) { return a.above * b.below == b.above * a.below; }
    friend bool operator<(const Fraction& a, const Fraction& b) { return a.above * b.below < b.above * a.below; }
    [[nodiscard]] double rounded() const { return double(above) / double(below); }
};

/// A feature of an outline, by corners; the second is that of a vertex again.
using PlaneFeature = std::pair<std::uint32_t, std::uint32_t>;
/// What touches in the plane: a vertex of one outline with a vertex or a side of the other one.
using PlanePair = std::pair<PlaneFeature, PlaneFeature>;

PlaneFeature side_of(std::uint32_t corner) {
    return std::minmax(corner, (corner + 1) % 4);
}

/// The first pairs that touch while one outline moves straight on, and when.
struct FirstTouch {
    Fraction time{1, 1};
    std::vector<PlanePair> pairs;

    FirstTouch(const Rectangle& moving, const Rectangle& fixed, const Whole& way) {
        for (std::uint32_t vertex = 0; vertex < 4; ++vertex)
            for (std::uint32_t side = 0; side < 4; ++side) {
                meet(moving[vertex], fixed, side, way, [&](PlaneFeature other) {
                    return PlanePair{{vertex, vertex}, other};
                });
                meet(fixed[vertex], moving, side, -1 * way, [&](PlaneFeature other) {
                    return PlanePair{other, {vertex, vertex}};
                });
            }
        std::ranges::sort(pairs);
        pairs.erase(std::ranges::unique(pairs).begin(), pairs.end());
    }

private:
    template <class Named>
    void meet(const Whole& point, const Rectangle& outline, std::uint32_t side, const Whole& way, const Named& named) {
        const std::uint32_t next = (side + 1) % 4;
        const Whole from = outline[side], along = outline[next] - from;
        const std::int64_t speed = cross(along, way);
        if (speed == 0) // then the point meets a corner first, and so the side beyond it
            return;
        const Fraction when(-cross(along, point - from), speed);
        // The place on the side, times the denominator.
        const std::int64_t place = dot(along, when.below * (point - from) + when.above * way);
        if (when < Fraction(0, 1) || time < when || place < 0 || place > when.below * dot(along, along))
            return;
        if (when < time)
            pairs.clear();
        time = when;
        const bool at_from = place == 0, at_next = place == when.below * dot(along, along);
        pairs.push_back(named(at_from ? PlaneFeature{side, side} : at_next ? PlaneFeature{next, next} : side_of(side)));
    }
};

/// The outline from z = 0 to the height; the corners at the height come last.
Polyhedron prism(const Rectangle& outline, double height, const Eigen::Quaterniond& turn) {
    std::vector<Vector3d> vertices;
    for (const double z : {0.0, height})
        for (const Whole& corner : outline)
            vertices.push_back(turn * (corner.placed() + Vector3d(0, 0, z)));
    const std::vector<std::vector<std::uint32_t>> faces{{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                        {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    return Polyhedron::from_polygons(vertices, faces);
}

/// Contacts by their features alone.
using Names = std::vector<PlanePair>;

/// The contacts of what touches in the plane: at either height.
Names at_both_heights(const std::vector<PlanePair>& pairs) {
    Names names;
    for (const std::uint32_t lift : {0U, 4U})
        for (const auto& [moving, fixed] : pairs)
            names.push_back({{moving.first + lift, moving.second + lift}, {fixed.first + lift, fixed.second + lift}});
    std::ranges::sort(names);
    return names;
}

Names names_of(const std::vector<Contact>& contacts) {
    Names names;
    for (const Contact& contact : contacts) {
        EXPECT_NE(moving_feature_kind(contact.kind), FeatureKind::face);
        EXPECT_NE(fixed_feature_kind(contact.kind), FeatureKind::face);
        names.push_back({{contact.moving.first, contact.moving.second}, {contact.fixed.first, contact.fixed.second}});
    }
    std::ranges::sort(names);
    return names;
}

FirstContact ask(const Polyhedron& moving, const Polyhedron& fixed, const Motion& motion, Find find,
                 double time_tolerance) {
    return first_contact({.moving = moving,
                          .fixed = fixed,
                          .motion = motion,
                          .options = {.time_tolerance = time_tolerance, .find = find}});
}

/// The first reported contact closes, and the list names each contact once.
void expect_contacts(const Polyhedron& moving, const Polyhedron& fixed, const Motion& motion, const Names& expected,
                     double time_tolerance) {
    const FirstContact one = ask(moving, fixed, motion, Find::first, time_tolerance);
    ASSERT_EQ(one.contacts.size(), 1U);
    EXPECT_GT(one.contacts[0].approach_speed, 0);
    const FirstContact all = ask(moving, fixed, motion, Find::first_with_all_contacts, time_tolerance);
    ASSERT_FALSE(all.contacts.empty());
    EXPECT_GT(all.contacts[0].approach_speed, 0);
    EXPECT_EQ(names_of(all.contacts), expected);
    EXPECT_FALSE(all.contacts_cut);
}

/// The poses of a straight motion, which begins at the origin.
struct Straight {
    Vector3d way;

    [[nodiscard]] Pose at(double time) const { return {time * way, Eigen::Quaterniond::Identity()}; }
};

/// A track along a straight way, of two to five stamps that are exact in binary.
Motion track(Random& random, const Straight& straight) {
    std::vector<double> stamps{0, 1};
    while (int(stamps.size()) < random.integer(2, 5))
        stamps.push_back(random.integer(1, 63) / 64.0);
    std::ranges::sort(stamps);
    stamps.erase(std::ranges::unique(stamps).begin(), stamps.end());
    std::vector<Pose> poses;
    for (const double stamp : stamps)
        poses.push_back(straight.at(stamp));
    return TimedPoses::through(stamps, poses,
                               random.chance(0.5) ? TimedPoses::Between::velocity : TimedPoses::Between::twist);
}

constexpr int straight_kinds = 7;

Motion straight_motion(Random& random, const Straight& straight, int kind) {
    const Pose start = straight.at(0), goal = straight.at(1);
    switch (kind) {
    case 0:
        return Motion::screw(start, goal);
    case 1:
        return Motion::sweep(start, goal);
    case 2:
        return Motion::velocity(start, goal);
    case 3:
        return Motion::twist(start, goal);
    case 4:
        return track(random, straight);
    case 5: // the fixed body moves, too
        return relative(track(random, {1.5 * straight.way}), track(random, {0.5 * straight.way}));
    default:
        return Motion::spline({0, 0.25, 1}, {start, straight.at(0.25), goal});
    }
}

TEST(FlushContacts, StraightOnEachIsListedOnce) {
    Random random(4701);
    std::map<std::size_t, int> meetings; // by the number of contacts
    for (int trial = 0; trial < 1500; ++trial) {
        const Rectangle fixed = random_outline(random, {0, 0});
        const Whole way{random.integer(-9, 9) * 32, random.integer(-9, 9) * 32};
        const Rectangle moving = random_outline(random, Whole{random.integer(-80, 80), random.integer(-80, 80)} -
                                                            Whole{way.x / 2, way.y / 2});
        const FirstTouch touch(moving, fixed, way);
        if (touch.pairs.empty() || touch.time == Fraction(0, 1) || way == Whole{})
            continue;
        const Eigen::Quaterniond turn =
            random.chance(0.5) ? Eigen::Quaterniond::Identity() : random_pose(random, 1).rotation.normalized();
        const double height = random.integer(1, 20);
        const Polyhedron a = prism(moving, height, turn), b = prism(fixed, height, turn);
        const Straight straight{turn * way.placed()};
        const int kind = random.integer(0, straight_kinds - 1);
        SCOPED_TRACE(testing::Message() << "trial " << trial << ", kind " << kind);
        const Motion motion = straight_motion(random, straight, kind);
        const FirstContact found = ask(a, b, motion, Find::first, 1e-12);
        if (found.verdict != Verdict::contact) // the outlines are in each other at the start
            continue;
        ASSERT_NEAR(found.time.lower, touch.time.rounded(), 1e-11);
        const Names expected = at_both_heights(touch.pairs);
        ++meetings[expected.size()];
        expect_contacts(a, b, motion, expected, random.chance(0.5) ? 1e-12 : random.chance(0.5) ? 1e-15 : 1e-10);
    }
    EXPECT_EQ(meetings.size(), 2U) << "along an edge, and along a face";
    for (const auto& [contacts, count] : meetings) {
        std::cout << count << " times " << contacts << " contacts\n";
        EXPECT_GT(count, 60);
    }
}

/// A plane in the world: motions in it, about its normal.
class Plane {
public:
    explicit Plane(Random& random)
        : turn_(random.chance(0.5) ? Eigen::Quaterniond::Identity() : random_pose(random, 1).rotation.normalized()) {}

    [[nodiscard]] const Eigen::Quaterniond& turn() const { return turn_; }
    [[nodiscard]] Vector3d normal() const { return turn_ * Vector3d::UnitZ(); }
    [[nodiscard]] Vector3d world(const Vector3d& point) const { return turn_ * point; }
    /// The pose that turns by an angle about the normal and then shifts in the plane.
    [[nodiscard]] Pose pose(double angle, const Vector3d& shift) const {
        return {world(shift), Eigen::Quaterniond(Eigen::AngleAxisd(angle, normal()))};
    }
    [[nodiscard]] Eigen::Vector2d in_plane(const Vector3d& point) const {
        return (turn_.conjugate() * point).head<2>();
    }

private:
    Eigen::Quaterniond turn_;
};

constexpr int turning_kinds = 8;

/// A motion that turns by the angle and ends `way` from where the outline is.
Motion turning_motion(Random& random, const Plane& plane, int kind, double angle, const Vector3d& way) {
    const Pose start = plane.pose(0, Vector3d::Zero()), goal = plane.pose(angle, way);
    const auto hinge = [&](double turn) {
        return Motion::hinge(plane.world({random.uniform(-60, 60), random.uniform(-60, 60), 0}), plane.normal(),
                             {0, turn, random.uniform(-0.2, 0.2)});
    };
    switch (kind) {
    case 0:
        return Motion::screw(start, goal, random.chance(0.5) ? Motion::default_max_turn : 0.05);
    case 1:
        return Motion::sweep(start, goal);
    case 2:
        return Motion::velocity(start, goal, plane.world({random.uniform(-60, 60), random.uniform(-60, 60), 0}));
    case 3:
        return Motion::twist(start, goal);
    case 4: {
        std::vector<double> stamps{0};
        std::vector<Pose> poses{start};
        for (int more = random.integer(1, 4); more > 0; --more) {
            stamps.push_back(stamps.back() + random.uniform(0.1, 3));
            poses.push_back(plane.pose(angle * random.uniform(0, 1), random.uniform(0.5, 1) * way));
        }
        return TimedPoses::through(stamps, poses,
                                   random.chance(0.5) ? TimedPoses::Between::velocity : TimedPoses::Between::twist);
    }
    case 5:
        return Motion::slider(plane.world(way), {0, way.norm()}) * hinge(angle);
    case 6:
        return relative(hinge(angle), hinge(-2 * angle));
    default:
        return relative(Motion::velocity(start, goal), hinge(angle));
    }
}

/// What touches in the plane at the time of an answer; empty if that is not clear-cut, because something else is almost
/// in touch.
std::vector<PlanePair> touching(const Plane& plane, const FirstContact& found, const Rectangle& moving,
                                const Rectangle& fixed) {
    const Eigen::Isometry3d place = found.fixed_pose.isometry().inverse() * found.pose.isometry();
    std::array<std::array<Eigen::Vector2d, 4>, 2> corners;
    for (std::size_t i = 0; i < 4; ++i) {
        corners[0][i] = plane.in_plane(place * plane.world(moving[i].placed()));
        corners[1][i] = fixed[i].placed().head<2>();
    }
    constexpr double touch = 1e-8, clear = 1e-4;
    std::vector<PlanePair> pairs;
    bool is_clear_cut = true;
    const auto is_at = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
        const double distance = (a - b).norm();
        is_clear_cut = is_clear_cut && (distance < touch || distance > clear);
        return distance < touch;
    };
    for (const std::size_t body : {0U, 1U})
        for (std::uint32_t vertex = 0; vertex < 4; ++vertex)
            for (std::uint32_t side = 0; side < 4; ++side) {
                const auto& outline = corners[1 - body];
                const std::uint32_t next = (side + 1) % 4;
                const Eigen::Vector2d &point = corners[body][vertex], along = outline[next] - outline[side];
                const double share = std::clamp((point - outline[side]).dot(along) / along.squaredNorm(), 0.0, 1.0);
                const bool at_from = is_at(point, outline[side]), at_next = is_at(point, outline[next]);
                if (!is_at(point, outline[side] + share * along))
                    continue;
                const PlaneFeature corner{vertex, vertex};
                const PlaneFeature other = at_from   ? PlaneFeature{side, side}
                                           : at_next ? PlaneFeature{next, next}
                                                     : side_of(side);
                pairs.push_back(body == 0 ? PlanePair{corner, other} : PlanePair{other, corner});
            }
    std::ranges::sort(pairs);
    pairs.erase(std::ranges::unique(pairs).begin(), pairs.end());
    return is_clear_cut ? pairs : std::vector<PlanePair>{};
}

TEST(FlushContacts, OnATurnEachIsListedOnce) {
    Random random(4702);
    std::map<int, int> meetings; // by the kind of the motion
    for (int trial = 0; trial < 1000; ++trial) {
        const Plane plane(random);
        const Rectangle fixed = random_outline(random, {0, 0});
        const Whole place{random.integer(-90, 90), random.integer(-90, 90)};
        const Rectangle moving = random_outline(random, place);
        const double height = random.integer(1, 20);
        const Polyhedron a = prism(moving, height, plane.turn()), b = prism(fixed, height, plane.turn());
        const Vector3d way = random.uniform(-2, 0) * place.placed() + Vector3d(random.uniform(-40, 40), 0, 0);
        const int kind = random.integer(0, turning_kinds - 1);
        SCOPED_TRACE(testing::Message() << "trial " << trial << ", kind " << kind);
        const Motion motion = turning_motion(random, plane, kind, random.uniform(-2, 2), way);
        const FirstContact found = ask(a, b, motion, Find::first, 1e-12);
        if (found.verdict != Verdict::contact)
            continue;
        const std::vector<PlanePair> pairs = touching(plane, found, moving, fixed);
        if (pairs.empty())
            continue;
        ++meetings[kind];
        expect_contacts(a, b, motion, at_both_heights(pairs),
                        random.chance(0.5)   ? 1e-12
                        : random.chance(0.5) ? 1e-15
                                             : 1e-11);
    }
    EXPECT_EQ(meetings.size(), std::size_t(turning_kinds));
    for (const auto& [kind, count] : meetings) {
        std::cout << count << " meetings on motions of kind " << kind << '\n';
        EXPECT_GT(count, 8);
    }
}

/// Motions of a door about the origin, from one angle to the other one.
std::vector<Motion> turns_of_a_door(const Plane& plane, double open, double closed) {
    const auto at = [&](double angle) { return plane.pose(angle, Vector3d::Zero()); };
    const auto hinge = [&](double from, double turn) {
        return Motion::hinge(Vector3d::Zero(), plane.normal(), {from, turn});
    };
    const double turn = closed - open;
    return {Motion::screw(at(open), at(closed)),
            Motion::sweep(at(open), at(closed)),
            Motion::velocity(at(open), at(closed)),
            Motion::twist(at(open), at(closed)),
            hinge(open, turn),
            TimedPoses::through({0, 1, 4}, {at(open), at(open / 2), at(closed)}),
            relative(hinge(open, -turn), hinge(0, -2 * turn))};
}

/// The face of a door lies in a plane through its axis, and so meets that of the jamb at once.
TEST(FlushContacts, OfADoorThatClosesOnAJambAllFourAreListed) {
    Random random(4703);
    for (int trial = 0; trial < 30; ++trial) {
        const Plane plane(random);
        const std::int64_t left = random.integer(2, 20), right = left + random.integer(8, 30);
        const Rectangle door{{{left, 0}, {right, 0}, {right, 3}, {left, 3}}};
        const Rectangle jamb{{{left + 7, -5}, {right + 9, -5}, {right + 9, 0}, {left + 7, 0}}};
        const Polyhedron a = prism(door, 5, plane.turn()), b = prism(jamb, 5, plane.turn());
        const Names expected = at_both_heights({{{0, 1}, {3, 3}}, {{1, 1}, {2, 3}}});
        for (const Motion& motion : turns_of_a_door(plane, random.uniform(0.1, 1), random.uniform(-1, -0.1))) {
            SCOPED_TRACE(testing::Message() << "trial " << trial);
            expect_contacts(a, b, motion, expected, 1e-12);
        }
    }
}

} // namespace
} // namespace chasles::test
