#include "tests/attack/mesh_families.h"

#include "tests/attack/any_motion.h"
#include "tests/support/grid.h"

#include <Eigen/Geometry>

namespace chasles::attack {

namespace {

/// Two shapes on both sides of a plane that touch at some tau of any motion.
MeshCase touching(AttackRandom& random, const MotionWish& wish) {
    const Shape fixed = random_shape(random);
    Shape moving = random_shape(random);
    set_against(moving, fixed, some_direction(fixed, random), random);
    return placed(lattice_motion(random, wish), moving, fixed);
}

// --- The families
// -----------------------------------------------------------------------------------------------------

MeshCase random_pair(AttackRandom& random) {
    return {shaken(random_shape(random), random), shaken(random_shape(random), random), any_motion(random, 2)};
}

MeshCase grid_pair(AttackRandom& random) {
    MotionWish wish;
    wish.turns = random.chance(0.5) ? 1 : 0;
    wish.travel = 6 * random.grid_direction(4);
    Shape moving = random_shape(random);
    shift(moving, 6 * random.grid(3).cast<double>());
    return placed(lattice_motion(random, wish), moving, random_shape(random));
}

MeshCase touch(AttackRandom& random) {
    return touching(random, {});
}

MeshCase touch_at_start(AttackRandom& random) {
    MotionWish wish;
    wish.tau = 0;
    return touching(random, wish);
}

MeshCase touch_at_goal(AttackRandom& random) {
    MotionWish wish;
    wish.tau = 1;
    return touching(random, wish);
}

/// A moving vertex whose path is tangent to a large fixed triangle.
MeshCase tangent(AttackRandom& random) {
    MotionWish wish;
    wish.turns = 1;
    const LatticeMotion motion = lattice_motion(random, wish);
    const Eigen::Vector3d z = 6 * random.grid_direction(3).cast<double>();
    Shape moving{{z}, {{0, 1, 2}}};
    const int corners = random.integer(2, 3);
    for (int i = 0; i < corners; ++i)
        moving.vertices.push_back(z + random.grid_direction(4).cast<double>());
    if (corners == 3)
        moving.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    if (!have_area(moving))
        return tangent(random);
    MeshCase result = placed(motion, moving, Shape{{z}, {{1, 2, 3}}});
    const Eigen::Vector3d place = result.fixed.vertices[0];
    const Eigen::Vector3d along = motion.velocity(z);
    const Eigen::Vector3d across = random.grid_direction(9).cast<double>() * std::ceil(along.cwiseAbs().maxCoeff() / 8);
    const double far = random.integer(1, 4);
    result.fixed.vertices = {place, place - far * along - far * across, place + far * along - far * across,
                             place + far * across};
    return result;
}

/// Faces and edges in one plane that the motion preserves.
MeshCase sliding(AttackRandom& random) {
    Shape fixed = random_shape(random);
    Shape moving = random_shape(random);
    const int axis = random.integer(0, 2);
    set_against(moving, fixed, Eigen::Vector3d::Unit(axis), random);
    MotionWish wish;
    wish.turns = random.chance(0.5) ? 1 : 0;
    wish.slides = 0;
    wish.axis = Eigen::Vector3i::Unit(axis) * (random.chance(0.5) ? 1 : -1);
    for (int i = 0; i < 3; ++i)
        wish.travel[i] = i == axis ? 0 : 6 * random.integer(-6, 6);
    Eigen::Vector3d aside = 6 * random.grid(4).cast<double>();
    aside[axis] = 0;
    shift(moving, aside);
    return placed(lattice_motion(random, wish), moving, fixed);
}

/// Flat bodies in one plane that the motion preserves: no other part can touch earlier.
MeshCase flat(AttackRandom& random) {
    const int axis = random.integer(0, 2);
    const auto some_flat = [&] {
        for (;;) {
            Shape shape{{}, {{0, 1, 2}}};
            for (int i = random.integer(3, 5); i > 0; --i) {
                shape.vertices.push_back(6 * random.grid(2).cast<double>());
                shape.vertices.back()[axis] = 0;
            }
            for (std::uint32_t i = 3; i < shape.vertices.size(); ++i)
                shape.faces.push_back({i - 2, i - 1, i});
            if (have_area(shape))
                return shape;
        }
    };
    MotionWish wish;
    wish.turns = random.chance(0.5) ? 1 : 0;
    wish.slides = 0;
    wish.axis = Eigen::Vector3i::Unit(axis);
    wish.travel = 6 * random.grid_direction(5);
    wish.travel[axis] = 0;
    const Shape fixed = some_flat();
    Shape moving = some_flat();
    Eigen::Vector3d aside = 6 * random.grid(5).cast<double>();
    aside[axis] = 0;
    shift(moving, aside);
    return placed(lattice_motion(random, wish), moving, fixed);
}

/// Two copies of one mesh that coincide at some tau, or a mesh next to its mirror image.
MeshCase coincident(AttackRandom& random) {
    const Shape shape = random.chance(0.3) ? fan_shape(random) : random_shape(random);
    Shape other = shape;
    if (random.chance(0.5)) {
        const int axis = random.integer(0, 2);
        const double mirror = 12 * random.integer(-1, 1);
        for (Eigen::Vector3d& v : other.vertices)
            v[axis] = mirror - v[axis];
    } else if (random.chance(0.5)) {
        set_against(other, shape, some_direction(shape, random), random);
    }
    return placed(lattice_motion(random), other, shape);
}

/// Boxes on one grid, with shared planes and parallel edges.
MeshCase grid_boxes(AttackRandom& random) {
    const auto cell = [&]() -> Eigen::Vector3d { return 6 * random.grid(2).cast<double>(); };
    const auto size = [&]() -> Eigen::Vector3d {
        return 6 * Eigen::Vector3d(random.integer(1, 2), random.integer(1, 2), random.integer(1, 2));
    };
    const Eigen::Vector3d a = cell();
    const Eigen::Vector3d b = cell();
    MotionWish wish;
    wish.turns = random.chance(0.4) ? 1 : 0;
    wish.axis = Eigen::Vector3i::Unit(random.integer(0, 2));
    wish.travel = random.chance(0.5) ? Eigen::Vector3i(random.integer(-8, 8) * 6 * wish.axis)
                                     : Eigen::Vector3i(6 * random.grid_direction(4));
    return placed(lattice_motion(random, wish), box_shape(a, a + size()), box_shape(b, b + size()));
}

/// Fans around common edges and vertices, and duplicate faces.
MeshCase repeated(AttackRandom& random) {
    Shape fixed = fan_shape(random);
    Shape moving = fan_shape(random);
    if (random.chance(0.5))
        fixed.faces.push_back(fixed.faces[0]);
    set_against(moving, fixed, some_direction(fixed, random), random);
    return placed(lattice_motion(random), moving, fixed);
}

void nudge(Shape& shape, AttackRandom& random) {
    Eigen::Vector3d& v = shape.vertices[std::size_t(random.integer(0, int(shape.vertices.size()) - 1))];
    double& x = v[random.integer(0, 2)];
    for (int i = random.integer(1, 3); i > 0; --i)
        x = std::nextafter(x, random.chance(0.5) ? 1e300 : -1e300);
}

/// A degenerate touch that is perturbed by a few units in the last place.
MeshCase nudged(AttackRandom& random) {
    MeshCase result = random.chance(0.3) ? sliding(random) : random.chance(0.3) ? tangent(random) : touch(random);
    for (Shape* shape : {&result.moving, &result.fixed}) {
        cut_into_triangles(*shape);
        for (int i = random.integer(0, 2); i > 0; --i)
            nudge(*shape, random);
    }
    return result;
}

/// Tiny and huge units: powers of two and other factors.
MeshCase scaled(AttackRandom& random) {
    MeshCase result = random.chance(0.3)   ? random_pair(random)
                      : random.chance(0.3) ? grid_boxes(random)
                                           : touch(random);
    constexpr double factors[] = {0x1p-80, 0x1p-40, 0x1p60, 0x1p72, 1e-9, 1e-22, 1e12, 3.3e20};
    const double factor = random.pick(factors);
    for (Shape* shape : {&result.moving, &result.fixed}) {
        cut_into_triangles(*shape);
        for (Eigen::Vector3d& v : shape->vertices)
            v *= factor;
    }
    scale_lengths(result.posed, factor);
    return result;
}

/// Triangle meshes, whose faces stay planar in any pose.
MeshCase triangles_apart_or_touching(AttackRandom& random) {
    MeshCase result = random.chance(0.5) ? random_pair(random) : touch(random);
    for (Shape* shape : {&result.moving, &result.fixed})
        cut_into_triangles(*shape);
    return result;
}

/// Turns of 1e-16 to 1e-3 radians.
MeshCase tiny_turn(AttackRandom& random) {
    MeshCase result = triangles_apart_or_touching(random);
    make_tiny_turn(result.posed, random);
    return result;
}

/// Screws by nearly pi: some are one piece, the library cuts the others.
MeshCase half_turn(AttackRandom& random) {
    MeshCase result = triangles_apart_or_touching(random);
    turn_around(result.posed, random);
    if (random.chance(0.3))
        result.posed.max_turn = 0.5;
    return result;
}

/// Two sheets of many triangles in one plane at some tau, exact or off by far more or far less than the tolerance.
MeshCase landing(AttackRandom& random) {
    const int axis = random.integer(0, 2);
    const auto sheet = [&] {
        Shape shape;
        const std::uint32_t width = std::uint32_t(random.integer(1, 2));
        const std::uint32_t length = std::uint32_t(random.integer(2, 3));
        for (std::uint32_t i = 0; i <= length; ++i)
            for (std::uint32_t j = 0; j <= width; ++j) {
                shape.vertices.push_back(Eigen::Vector3d::Zero());
                shape.vertices.back()[(axis + 1) % 3] = 12.0 * i;
                shape.vertices.back()[(axis + 2) % 3] = 12.0 * j;
            }
        shape.faces = test::grid_triangles(length, width);
        return shape;
    };
    MotionWish wish;
    wish.turns = random.chance(0.5) ? 1 : 0;
    wish.axis = Eigen::Vector3i::Unit(axis);
    const Shape fixed = sheet();
    Shape moving = sheet();
    Eigen::Vector3d aside = random.grid(11).cast<double>();
    aside[axis] = 0;
    shift(moving, aside);
    MeshCase result = placed(lattice_motion(random, wish), moving, fixed);
    if (random.chance(0.7))
        for (Shape* shape : {&result.moving, &result.fixed})
            for (Eigen::Vector3d& v : shape->vertices)
                v += random.vector(std::ldexp(1.0, -random.integer(20, 55)));
    return result;
}

/// Faces without area among others, apart or in touch.
MeshCase segments(AttackRandom& random) {
    Shape fixed = random_shape(random);
    Shape moving = random_shape(random);
    const Eigen::Vector3d direction = some_direction(fixed, random);
    if (random.chance(0.8))
        add_segments(fixed, random);
    if (random.chance(0.8))
        add_segments(moving, random);
    MotionWish wish;
    if (random.chance(0.3))
        wish.turns = 0;
    if (random.chance(0.1))
        wish.tau = 0;
    set_against(moving, fixed, direction, random);
    return placed(lattice_motion(random, wish), moving, fixed);
}

constexpr MeshFamily families[] = {
    {"random", 0.08, random_pair},
    {"grid", 0.1, grid_pair},
    {"touch", 0.15, touch},
    {"touch at 0", 0.05, touch_at_start},
    {"touch at 1", 0.05, touch_at_goal},
    {"tangent", 0.1, tangent},
    {"sliding", 0.08, sliding},
    {"coincident", 0.05, coincident},
    {"grid boxes", 0.05, grid_boxes},
    {"repeated", 0.05, repeated},
    {"nudged", 0.07, nudged},
    {"scaled", 0.04, scaled},
    {"tiny turn", 0.03, tiny_turn},
    {"half turn", 0.03, half_turn},
    {"flat", 0.04, flat},
    {"landing", 0.03, landing},
    {"segments", 0.08, segments},
};

} // namespace

MeshCase placed(const LatticeMotion& motion, const Shape& moving, const Shape& fixed) {
    MeshCase result{moving, fixed, motion.posed};
    for (Eigen::Vector3d& v : result.moving.vertices)
        v = motion.moving_point(v);
    for (Eigen::Vector3d& v : result.fixed.vertices)
        v = motion.fixed_point(v);
    return result;
}

std::span<const MeshFamily> mesh_families() {
    return families;
}

} // namespace chasles::attack
