// The cost of motions that are no screws: constant velocity, constant twist, both bodies moving, one hinge and a chain
// of seven, and the least distance of two rings on one pin. Each is measured beside the screw between the same relative
// poses, in one run. Times include making the motion, except for chains. Each time is the least of several calls.
#include "bench/bodies.h"
#include "bench/draw.h"
#include "bench/generated_bodies.h"
#include "bench/timings.h"
#include "chasles/chasles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

namespace chasles::bench {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double degree = std::numbers::pi / 180;
constexpr std::size_t motions_of_case = 200;
constexpr int calls = 7;

struct Ends {
    Pose start;
    Pose goal;
    Vector3d centre; ///< of the body, which moves straight
};

enum class Kind : std::uint8_t { screw, velocity, twist, both };
constexpr std::array kinds{Kind::screw, Kind::velocity, Kind::twist, Kind::both};

Pose product(const Pose& outer, const Pose& inner) {
    return {outer.isometry() * inner.translation,
            Quaterniond(outer.rotation.normalized()) * Quaterniond(inner.rotation)};
}

/// Both bodies at constant velocity in the world: the fixed one moves by half of the way of the other and turns by a
/// third of a radian. Seen from it, the ends are the same.
Motion both_moving(const Ends& ends) {
    const Vector3d way = 0.5 * (ends.goal.translation - ends.start.translation);
    const Pose goal(way, Quaterniond(Eigen::AngleAxisd(0.3, Vector3d(1, 2, 3).normalized())));
    return relative(ConstantVelocity::between(ends.start, product(goal, ends.goal), ends.centre),
                    ConstantVelocity::between(Pose(), goal));
}

Motion motion_between(const Ends& ends, Kind kind) {
    switch (kind) {
    case Kind::velocity:
        return ConstantVelocity::between(ends.start, ends.goal, ends.centre);
    case Kind::twist:
        return ConstantTwist::between(ends.start, ends.goal);
    case Kind::both:
        return both_moving(ends);
    default:
        return ScrewMotion::between(ends.start, ends.goal);
    }
}

FirstContact answer(const Polyhedron& body, const Ends& ends, Kind kind) {
    return first_contact({.moving = body, .fixed = body, .motion = motion_between(ends, kind)});
}

/// Motions of a body past or towards its copy, by some half of its length, with one turn about its middle.
std::vector<Ends> motions_of(const Polyhedron& body, double turn) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& vertex : body.vertices())
        box.extend(vertex);
    const Vector3d centre = box.center();
    const double length = box.sizes().maxCoeff();
    Draw draw(57);
    const auto pose = [&](const Vector3d& place, const Quaterniond& orientation) {
        return Pose(Vector3d(centre + place - orientation * centre), orientation);
    };
    std::vector<Ends> motions;
    while (motions.size() < motions_of_case) {
        const Quaterniond orientation = draw.turn(0, std::numbers::pi);
        const Vector3d from = draw.between(0.9, 1.5) * length * draw.direction();
        const Vector3d to = draw.between(0.2, 1.2) * length * draw.direction();
        const Ends ends{
            pose(from, orientation),
            pose(from + 0.5 * (to - from), Quaterniond(Eigen::AngleAxisd(turn, draw.direction())) * orientation),
            centre};
        if (answer(body, ends, Kind::screw).verdict != Verdict::contact_at_start)
            motions.push_back(ends);
    }
    return motions;
}

/// The least microseconds of several calls in turn, of each kind.
std::array<double, kinds.size()> times_of(const Polyhedron& body, const Ends& ends) {
    std::array<double, kinds.size()> least;
    least.fill(1e9);
    for (int call = 0; call < calls; ++call)
        for (const Kind kind : kinds) {
            FirstContact found;
            double& time = least[std::size_t(kind)];
            time = std::min(time, least_microseconds(1, [&] { found = answer(body, ends, kind); }));
            if (found.verdict == Verdict::unknown)
                std::abort();
        }
    return least;
}

/// Ratios to the screw, of the motions with one verdict.
struct Ratios {
    std::vector<double> screw, velocity, twist, both;
};

void print_case(const NamedBody& body, double turn) {
    std::array<Ratios, 2> of_verdict; // clear, contact
    for (const Ends& ends : motions_of(body.body, turn)) {
        const auto touches = [&](Kind kind) { return answer(body.body, ends, kind).verdict != Verdict::clear; };
        if (!std::ranges::all_of(kinds, [&](Kind kind) { return touches(kind) == touches(Kind::screw); }))
            continue;
        const auto [screw, velocity, twist, both] = times_of(body.body, ends);
        Ratios& ratios = of_verdict[touches(Kind::screw) ? 1 : 0];
        ratios.screw.push_back(screw);
        ratios.velocity.push_back(velocity / screw);
        ratios.twist.push_back(twist / screw);
        ratios.both.push_back(both / screw);
    }
    for (const bool touches : {false, true}) {
        const Ratios& ratios = of_verdict[touches ? 1 : 0];
        std::printf("%-15s %3.0f degrees  %-8s %4zu motions  screw %7.2f us  velocity %5.2f  twist %5.2f  both %5.2f\n",
                    body.name.c_str(), turn / degree, touches ? "contact" : "clear", ratios.screw.size(),
                    median(ratios.screw), median(ratios.velocity), median(ratios.twist), median(ratios.both));
    }
}

/// A body at the end of hinges, as far apart as the body is long; each turns by the same part of `turn`.
Motion chain(Draw& draw, int hinges, double length, double turn, const Pose& mounted) {
    Motion arm = Motion::at_rest(Pose());
    for (int i = 0; i < hinges; ++i)
        arm = arm * Motion::hinge(Vector3d::Zero(), draw.direction(), {0, turn / hinges}) *
              Motion::at_rest(Pose(length * draw.direction(), Quaterniond::Identity()));
    return arm * Motion::at_rest(mounted);
}

/// The fixed body is placed beside the goal of the body on the chain, or beyond it.
void print_chain(const NamedBody& body, int hinges, double turn) {
    Draw draw(58);
    const double length = (body.body.vertices()[0] - body.body.vertices()[body.body.vertices().size() / 2]).norm();
    std::array<std::vector<double>, 2> screws, ratios;
    for (int i = 0; i < 200; ++i) {
        const Pose mounted(Vector3d::Zero(), draw.turn(0, std::numbers::pi));
        const Motion free = chain(draw, hinges, length, turn, mounted);
        const Vector3d away = draw.between(0.2, 1.2) * length * draw.direction();
        const Pose place(free.pose_at(1).translation + away, Quaterniond::Identity());
        const Motion motion = relative(free, Motion::at_rest(place));
        const auto seen = [&](double time) { return Pose(place.isometry().inverse() * free.pose_at(time).isometry()); };
        const auto time_of = [&](const auto& make) {
            return least_microseconds(calls, [&] {
                if (first_contact({.moving = body.body, .fixed = body.body, .motion = make()}).verdict ==
                    Verdict::unknown)
                    std::abort();
            });
        };
        const Pose start = seen(0), goal = seen(1);
        const auto verdict = [&](const Motion& m) {
            return first_contact({.moving = body.body, .fixed = body.body, .motion = m}).verdict;
        };
        const Verdict of_chain = verdict(motion);
        if (of_chain == Verdict::contact_at_start || of_chain != verdict(Motion::screw(start, goal)))
            continue;
        const double screw = time_of([&] { return Motion::screw(start, goal); });
        const std::size_t touches = of_chain == Verdict::clear ? 0 : 1;
        screws[touches].push_back(screw);
        ratios[touches].push_back(time_of([&] { return motion; }) / screw);
    }
    for (const std::size_t touches : {0, 1})
        std::printf("%-15s %3.0f degrees  %-8s %4zu chains   screw %7.2f us  %d hinges %5.2f\n", body.name.c_str(),
                    turn / degree, touches ? "contact" : "clear", screws[touches].size(), median(screws[touches]),
                    hinges, median(ratios[touches]));
}

/// A flat ring about z.
Polyhedron washer(std::uint32_t corners, double height) {
    std::vector<Vector3d> vertices;
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::uint32_t i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * i / corners;
        for (const double radius : {0.5, 1.0})
            for (const double z : {height, height + 0.25})
                vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
        const std::uint32_t here = 4 * i, next = 4 * ((i + 1) % corners);
        for (const auto& [a, b] : {std::pair{2, 3}, {1, 0}, {3, 1}, {0, 2}}) {
            const auto first = std::uint32_t(a), second = std::uint32_t(b);
            faces.push_back({here + first, next + first, next + second});
            faces.push_back({here + first, next + second, here + second});
        }
    }
    return Polyhedron::from_polygons(vertices, faces);
}

/// Two rings with a gap of 0.2 make half a turn: by a hinge beside the screw.
void print_rings() {
    for (const std::uint32_t corners : {24U, 48U, 96U}) {
        const Polyhedron lower = washer(corners, 0), upper = washer(corners, 0.45);
        const auto milliseconds = [&](const Motion& motion) {
            return least_microseconds(
                       3,
                       [&] {
                           if (!least_distance({.moving = lower, .fixed = upper, .motion = motion}).certain)
                               std::abort();
                       }) /
                   1e3;
        };
        const double screw = milliseconds(Motion::screw({}, Pose({0, 0, 0}, Quaterniond(0, 0, 0, 1))));
        const double hinge = milliseconds(Motion::hinge({0, 0, 0}, {0, 0, 1}, {0, std::numbers::pi}));
        std::printf("rings of %u triangles, least distance: screw %.1f ms  hinge %.2f\n", 8 * corners, screw,
                    hinge / screw);
    }
}

int run() {
    std::vector<NamedBody> bodies;
    bodies.push_back({"ellipsoid 0.3k", ellipsoid({0.5, 0.8, 0.6}, 2)});
    bodies.push_back({"torus 3.7k", bumpy_torus(43, 43)});
    if (const auto file = data_file("meshes/spot.obj"))
        bodies.push_back({"spot 5.9k", Polyhedron::load(*file, {.triangulate = true})});
    bodies.push_back(large_body());
    for (const NamedBody& body : bodies)
        for (const double turn : {10 * degree, 90 * degree})
            print_case(body, turn);
    for (const int hinges : {1, 7})
        for (const NamedBody& body : bodies)
            for (const double turn : {10 * degree, 90 * degree})
                print_chain(body, hinges, turn);
    print_rings();
    return 0;
}

} // namespace
} // namespace chasles::bench

int main() {
    return chasles::bench::run();
}
