#include "tests/attack/margin_families.h"

#include "tests/attack/any_motion.h"
#include "tests/support/sampled_distance.h"

#include <numbers>

namespace chasles::attack {

namespace {

using reference::SampledDistance;
using reference::Surface;

/// The diagonal of a shape's box.
double diagonal_of(const Shape& shape) {
    Eigen::Vector3d lower = shape.vertices[0];
    Eigen::Vector3d upper = lower;
    for (const Eigen::Vector3d& v : shape.vertices) {
        lower = lower.cwiseMin(v);
        upper = upper.cwiseMax(v);
    }
    return (upper - lower).norm();
}

/// A margin from a billionth of the body's size to three times its size.
double some_margin(const Shape& body, AttackRandom& random) {
    constexpr double parts[] = {1e-9, 1e-6, 1e-3, 1e-3, 0.1, 0.1, 0.1, 3};
    const double part = random.pick(parts);
    return diagonal_of(body) * (random.chance(0.5) ? part : part * random.uniform(0.3, 1));
}

/// A slightly different number, a number off by a few units in the last place, or the number itself.
double about(double x, AttackRandom& random) {
    if (random.chance(0.2))
        return x;
    return x * (1 + (random.chance(0.5) ? 1 : -1) * std::pow(10.0, -random.uniform(2, 16)));
}

MarginCase plain(AttackRandom& random) {
    const Shape moving = shaken(random_shape(random), random);
    const double margin = some_margin(moving, random);
    return {{moving, shaken(random_shape(random), random), any_motion(random, 2 + margin)}, margin};
}

/// A case that is degenerate for touches, with a margin.
MarginCase degenerate(AttackRandom& random) {
    constexpr std::size_t fixed_count =
        16; // later families have margin families of their own, and cases keep their ids
    const auto families = mesh_families().first(fixed_count);
    const MeshCase posed = families[std::size_t(random.integer(1, int(families.size()) - 1))].make(random);
    return {posed, some_margin(posed.moving, random)};
}

// --- Distances that are the margin exactly, on a lattice
// --------------------------------------------------------------

MarginCase placed(const LatticeMotion& motion, const Shape& moving, const Shape& fixed, double margin) {
    return {placed(motion, moving, fixed), margin * static_cast<double>(motion.denominator)};
}

/// A lattice direction whose length is a whole number, and this length.
std::pair<Eigen::Vector3d, double> whole_direction(AttackRandom& random) {
    static const std::pair<Eigen::Vector3d, double> directions[] = {{{1, 0, 0}, 1}, {{0, 1, 0}, 1},  {{0, 0, 1}, 1},
                                                                    {{3, 4, 0}, 5}, {{0, -4, 3}, 5}, {{2, 2, 1}, 3},
                                                                    {{-2, 1, 2}, 3}};
    auto chosen = random.pick(directions);
    chosen.first *= random.chance(0.5) ? 1 : -1;
    return chosen;
}

/// Two shapes on both sides of a plane, moved apart by the margin: flat over flat, edges along edges, corners over
/// corners, at some tau of any motion.
MarginCase at_the_margin(AttackRandom& random) {
    const auto [direction, length] = whole_direction(random);
    const double steps = random.pick(std::array{1.0, 2.0, 0.5, 0x1p-10, 0x1p-20, 0x1p-30, 7.0});
    const Shape fixed = random_shape(random);
    Shape moving = random_shape(random);
    set_against(moving, fixed, direction, random);
    shift(moving, steps * direction);
    MarginCase result = placed(lattice_motion(random), moving, fixed, steps * length);
    if (random.chance(0.3))
        result.margin = about(result.margin, random);
    return result;
}

/// A slide along a plane at a height equal to the margin or close to it.
MarginCase slides_above(AttackRandom& random) {
    const Shape fixed = random_shape(random);
    Shape moving = random_shape(random);
    const int axis = random.integer(0, 2);
    set_against(moving, fixed, Eigen::Vector3d::Unit(axis), random);
    MotionWish wish;
    wish.turns = random.chance(0.5) ? 1 : 0;
    wish.slides = 0;
    wish.axis = Eigen::Vector3i::Unit(axis) * (random.chance(0.5) ? 1 : -1);
    for (int i = 0; i < 3; ++i)
        wish.travel[i] = i == axis ? 0 : 6 * random.integer(-6, 6);
    Eigen::Vector3d aside = 6 * random.grid(3).cast<double>();
    const double steps = random.pick(std::array{1.0, 3.0, 0x1p-10, 0x1p-30});
    aside[axis] = steps;
    shift(moving, aside);
    MarginCase result = placed(lattice_motion(random, wish), moving, fixed, steps);
    result.margin = about(result.margin, random);
    return result;
}

/// A box over a table turns about its lower edge, at a height close to the margin, until a face lies flat and beyond.
MarginCase rolling(AttackRandom& random) {
    const Eigen::Vector3d size(random.integer(1, 3), random.integer(1, 3), random.integer(1, 3));
    Shape moving = box_shape(Eigen::Vector3d::Zero(), size);
    const double margin = random.pick(std::array{0.5, 0x1p-10, 0x1p-20, 1e-3, 1e-6});
    Shape fixed = box_shape({-8, -8, -2}, {8, 8, 0});
    if (random.chance(0.5))
        cut_into_triangles(fixed);
    PosedMotion posed;
    posed.kind = random.chance(0.7) ? MotionKind::screw : MotionKind::sweep;
    const double height = random.chance(0.5) ? margin : about(margin, random);
    const double whole = random.integer(1, 4); // half-angle tangents with small digits
    posed.moving_start =
        Pose({0, 0, height}, Eigen::Quaterniond(whole, 0, random.pick(std::array{0.0, -1.0, -2.0}), 0));
    posed.moving_goal = Pose({0, 0, height}, Eigen::Quaterniond(whole, 0, random.integer(1, 3), 0));
    for (Pose* pose : {&posed.moving_start, &posed.moving_goal})
        if (posed.kind == MotionKind::sweep) { // squares have rational lengths
            const Eigen::Quaterniond q(pose->rotation);
            pose->rotation = q * q;
        }
    return {{moving, fixed, posed}, random.chance(0.5) ? margin : about(margin, random)};
}

/// Two long edges at an angle from 1e-17 to 1e-2. One edge lands on the other or passes it.
MarginCase near_parallel(AttackRandom& random) {
    const Eigen::Vector3d along = random.vector(1).normalized();
    const Eigen::Vector3d up = along.unitOrthogonal();
    const Eigen::Vector3d across = along.cross(up);
    const double angle = random.chance(0.2) ? 0 : std::pow(10.0, -random.uniform(2, 17));
    const Eigen::Vector3d turned = along + angle * (random.chance(0.5) ? up : across);
    const auto blade = [&](const Eigen::Vector3d& direction, const Eigen::Vector3d& back) {
        return Shape{{-direction * random.uniform(0.1, 1), direction * random.uniform(0.1, 1),
                      random.uniform(-0.3, 0.3) * direction + back},
                     {{0, 1, 2}}};
    };
    const Shape fixed = blade(along, -0.4 * up);
    const Shape moving = blade(turned, 0.4 * up);
    const double margin = some_margin(moving, random);
    PosedMotion posed;
    const double high = margin + random.uniform(0.01, 1);
    const Eigen::Vector3d aside = random.uniform(-1.2, 1.2) * along + random.uniform(-0.5, 0.5) * margin * across;
    posed.moving_start.translation = aside + high * up;
    posed.moving_goal.translation = aside - random.uniform(-0.5, 1) * high * up + random.uniform(-0.1, 0.1) * along;
    if (random.chance(0.5))
        posed.moving_goal.rotation = Eigen::Quaterniond(1, 0, 0, random.pick(std::array{0.0, 1e-3, 1e-9, 1e-15}));
    return {{moving, fixed, posed}, margin};
}

// --- Margins close to the least distance
// -------------------------------------------------------------

/// The margin is close to the least distance of the bodies, which graze it.
MarginCase grazing(AttackRandom& random) {
    MarginCase result = plain(random);
    const auto& [moving, fixed, posed] = result.mesh;
    const Surface a = Surface::from_convex_faces(moving.vertices, moving.faces);
    const Surface b = Surface::from_convex_faces(fixed.vertices, fixed.faces);
    const auto paths = posed.paths();
    const SampledDistance distance(a, b, paths[0]);
    const double least = static_cast<double>(distance.at(distance.closest_tau(24)));
    if (least < 1e-12)
        return grazing(random);
    result.margin = about(least, random);
    return result;
}

MarginCase near_at_start(AttackRandom& random) {
    MarginCase result = plain(random);
    const auto& [moving, fixed, posed] = result.mesh;
    const Surface a = Surface::from_convex_faces(moving.vertices, moving.faces);
    const Surface b = Surface::from_convex_faces(fixed.vertices, fixed.faces);
    const double there = static_cast<double>(SampledDistance(a, b, posed.paths()[0]).at(0));
    if (there < 1e-12)
        return near_at_start(random);
    result.margin = about(there, random);
    return result;
}

// --- Bodies with large rounding errors
// ---------------------------------------------------------------------------------

void squeeze(Shape& shape, AttackRandom& random) {
    const Eigen::Vector3d direction = random.chance(0.5) ? Eigen::Vector3d(Eigen::Vector3d::Unit(random.integer(0, 2)))
                                                         : Eigen::Vector3d(random.vector(1).normalized());
    const double left = std::pow(10.0, -random.uniform(3, 8));
    for (Eigen::Vector3d& v : shape.vertices)
        v -= (1 - left) * v.dot(direction) * direction;
}

MarginCase slivers(AttackRandom& random) {
    for (;;) {
        MarginCase result = plain(random);
        squeeze(result.mesh.moving, random);
        if (random.chance(0.5))
            squeeze(result.mesh.fixed, random);
        if (have_area(result.mesh.moving) && have_area(result.mesh.fixed))
            return result;
    }
}

/// The bodies are far from the origins of their frames, or both are far from the origin of the world.
MarginCase far_off(AttackRandom& random) {
    MarginCase result = plain(random);
    PosedMotion& posed = result.mesh.posed;
    const Eigen::Vector3d off = random.vector(std::pow(10.0, random.uniform(2, 8)));
    if (random.chance(0.5)) {
        for (Eigen::Vector3d& v : result.mesh.moving.vertices)
            v += off;
        for (Pose* pose : {&posed.moving_start, &posed.moving_goal})
            pose->translation -= Eigen::Quaterniond(pose->rotation).normalized() * off;
        return result;
    }
    if (!posed.is_relative)
        for (Eigen::Vector3d& v : result.mesh.fixed.vertices)
            v += off;
    for (Pose* pose : {&posed.moving_start, &posed.moving_goal})
        pose->translation += off;
    if (posed.is_relative)
        for (Pose* pose : {&posed.fixed_start, &posed.fixed_goal})
            pose->translation += off;
    return result;
}

/// A case in another unit of length.
MarginCase other_units(AttackRandom& random) {
    MarginCase result = random.chance(0.5) ? plain(random) : at_the_margin(random);
    const double factor = random.pick(std::array{1e-3, 1e3, 0x1p-40, 0x1p60, 1e-12, 3.3e9});
    for (Shape* shape : {&result.mesh.moving, &result.mesh.fixed}) {
        cut_into_triangles(*shape);
        for (Eigen::Vector3d& v : shape->vertices)
            v *= factor;
    }
    scale_lengths(result.mesh.posed, factor);
    result.margin *= factor;
    return result;
}

/// Faces without area.
MarginCase segments(AttackRandom& random) {
    const MeshCase posed = mesh_families().back().make(random);
    return {posed, some_margin(posed.moving, random)};
}

constexpr MarginFamily families[] = {
    {"plain", 0.2, plain},
    {"degenerate", 0.15, degenerate},
    {"at the margin", 0.15, at_the_margin},
    {"slides above", 0.07, slides_above},
    {"rolling", 0.07, rolling},
    {"near-parallel", 0.08, near_parallel},
    {"grazing", 0.08, grazing},
    {"near at start", 0.05, near_at_start},
    {"slivers", 0.05, slivers},
    {"far off", 0.05, far_off},
    {"other units", 0.05, other_units},
    {"segments", 0.05, segments},
};

} // namespace

std::span<const MarginFamily> margin_families() {
    return families;
}

} // namespace chasles::attack
