#include "tests/attack/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace chasles::attack {

namespace {

constexpr double step = 6;

Eigen::Vector3d lattice_point(AttackRandom& random, int size) {
    return step * random.grid(size).cast<double>();
}

bool has_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    return !(b - a).cross(c - a).isZero(0);
}

void add_triangle(Shape& shape, AttackRandom& random) {
    for (;;) {
        const Eigen::Vector3d a = lattice_point(random, 2);
        const Eigen::Vector3d b = lattice_point(random, 2);
        const Eigen::Vector3d c = lattice_point(random, 2);
        if (!has_area(a, b, c))
            continue;
        const auto first = static_cast<std::uint32_t>(shape.vertices.size());
        shape.vertices.insert(shape.vertices.end(), {a, b, c});
        shape.faces.push_back({first, first + 1, first + 2});
        return;
    }
}

Shape tetrahedron(AttackRandom& random) {
    for (;;) {
        Shape shape{{}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
        for (int i = 0; i < 4; ++i)
            shape.vertices.push_back(lattice_point(random, 2));
        const auto& v = shape.vertices;
        if ((v[1] - v[0]).cross(v[2] - v[0]).dot(v[3] - v[0]) != 0)
            return shape;
    }
}

Shape random_box(AttackRandom& random) {
    const Eigen::Vector3d lower = lattice_point(random, 2);
    const Eigen::Vector3d size =
        step * Eigen::Vector3d(random.integer(1, 3), random.integer(1, 3), random.integer(1, 3));
    return box_shape(lower, lower + size);
}

/// A square under a tip.
Shape pyramid(AttackRandom& random) {
    const double side = step * random.integer(1, 2);
    const Eigen::Vector3d tip = lattice_point(random, 1) + Eigen::Vector3d(0, 0, 2 * step);
    return {{{-side, -side, 0}, {side, -side, 0}, {side, side, 0}, {-side, side, 0}, tip},
            {{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
}

/// A block with a step. Each of its two L-shaped sides is two rectangles.
Shape notched_block() {
    Shape shape;
    const double outline[][2] = {{0, 0}, {12, 0}, {12, 6}, {6, 6}, {6, 12}, {0, 12}, {6, 0}};
    for (const double z : {0.0, 6.0})
        for (const auto& p : outline)
            shape.vertices.emplace_back(p[0], p[1], z);
    for (const std::uint32_t i : {0u, 1u, 2u, 3u, 4u}) {
        if (i != 0)
            shape.faces.push_back({i, i + 1, i + 8, i + 7});
    }
    shape.faces.push_back({5, 0, 7, 12});
    shape.faces.push_back({0, 6, 13, 7});
    shape.faces.push_back({6, 1, 8, 13});
    shape.faces.push_back({7, 13, 10, 11, 12}); // 0 6 3 4 5 on top
    shape.faces.push_back({13, 8, 9, 10});
    shape.faces.push_back({5, 4, 3, 6, 0});
    shape.faces.push_back({3, 2, 1, 6});
    return shape;
}

/// A box whose top is a pit.
Shape dented_box() {
    Shape shape = box_shape(Eigen::Vector3d(-6, -6, -6), Eigen::Vector3d(6, 6, 6));
    shape.faces.pop_back(); // the top: 4 5 7 6
    shape.vertices.emplace_back(0, 0, 0);
    for (const auto& [a, b] : {std::pair(4u, 5u), {5u, 7u}, {7u, 6u}, {6u, 4u}})
        shape.faces.push_back({a, b, 8});
    return shape;
}

std::vector<Eigen::Vector3d> foremost(const Shape& shape, const Eigen::Vector3d& direction) {
    std::vector<Eigen::Vector3d> result;
    for (const Eigen::Vector3d& v : shape.vertices) {
        const double ahead = result.empty() ? 0 : v.dot(direction) - result[0].dot(direction);
        if (ahead > 0)
            result.clear();
        if (ahead >= 0)
            result.push_back(v);
    }
    return result;
}

/// A vertex, the midpoint of two vertices, or the centroid of three.
Eigen::Vector3d some_point(const std::vector<Eigen::Vector3d>& of, AttackRandom& random) {
    const Eigen::Vector3d a = random.pick(of);
    const Eigen::Vector3d b = random.pick(of);
    const Eigen::Vector3d c = random.pick(of);
    const int points = random.integer(1, 3);
    return points == 1 ? a : points == 2 ? Eigen::Vector3d((a + b) / 2) : Eigen::Vector3d((a + b + c) / 3);
}

} // namespace

Shape box_shape(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
    Shape shape;
    for (int i = 0; i < 8; ++i)
        shape.vertices.emplace_back((i & 1 ? upper : lower).x(), (i & 2 ? upper : lower).y(),
                                    (i & 4 ? upper : lower).z());
    shape.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    return shape;
}

Shape fan_shape(AttackRandom& random) {
    const int count = random.integer(3, 7);
    const bool around_edge = random.chance(0.5);
    Shape shape{{{0, 0, 0}, {0, 0, 2 * step}}, {}};
    for (int i = 0; i < count; ++i) {
        const Eigen::Vector3d v = lattice_point(random, 2);
        const auto last = static_cast<std::uint32_t>(shape.vertices.size());
        if (!has_area(shape.vertices[0], around_edge ? shape.vertices[1] : shape.vertices[last - 1], v))
            continue;
        shape.vertices.push_back(v);
        shape.faces.push_back({0, around_edge ? 1 : last - 1, last});
    }
    if (shape.faces.empty())
        return fan_shape(random);
    return shape;
}

Shape random_shape(AttackRandom& random) {
    switch (random.integer(0, 8)) {
    case 0:
    case 1: {
        Shape soup;
        for (int i = random.integer(1, 3); i > 0; --i)
            add_triangle(soup, random);
        return soup;
    }
    case 2:
    case 3:
        return tetrahedron(random);
    case 4:
    case 5:
        return random_box(random);
    case 6:
        return pyramid(random);
    case 7:
        return random.chance(0.5) ? notched_block() : dented_box();
    default:
        return fan_shape(random);
    }
}

void add_segments(Shape& shape, AttackRandom& random) {
    for (int i = random.integer(1, 3); i > 0; --i) {
        const auto count = static_cast<std::uint32_t>(shape.vertices.size());
        const auto from = std::uint32_t(random.integer(0, int(count) - 1));
        const auto to = random.chance(0.3) ? std::uint32_t(random.integer(0, int(count) - 1)) : count;
        if (to == count)
            shape.vertices.push_back(lattice_point(random, 3));
        if (shape.vertices[from] == shape.vertices[to])
            continue; // the reference has no single points
        switch (random.integer(0, 3)) {
        case 0:
            shape.faces.push_back({from, to, to});
            break;
        case 1: // three corners on one line, the last one anywhere on it
            shape.vertices.push_back(shape.vertices[from] + random.pick(std::array{-1.0, 0.5, 0.5, 2.0}) *
                                                                (shape.vertices[to] - shape.vertices[from]));
            shape.faces.push_back({from, to, std::uint32_t(shape.vertices.size() - 1)});
            break;
        case 2: // two vertices at one place
            shape.vertices.push_back(shape.vertices[to]);
            shape.faces.push_back({from, to, std::uint32_t(shape.vertices.size() - 1)});
            break;
        default:
            shape.faces.push_back({to, from, to, from});
            break;
        }
    }
    if (random.chance(0.3)) {
        auto face = random.pick(shape.faces);
        if (random.chance(0.5))
            std::reverse(face.begin(), face.end());
        shape.faces.push_back(face);
    }
}

bool have_area(const Shape& shape) {
    const auto& v = shape.vertices;
    return std::all_of(shape.faces.begin(), shape.faces.end(),
                       [&](const auto& face) { return has_area(v[face[0]], v[face[1]], v[face[2]]); });
}

void cut_into_triangles(Shape& shape) {
    Faces triangles;
    for (const auto& face : shape.faces)
        for (std::size_t i = 1; i + 1 < face.size(); ++i)
            triangles.push_back({face[0], face[i], face[i + 1]});
    shape.faces = triangles;
}

Shape shaken(Shape shape, AttackRandom& random) {
    cut_into_triangles(shape);
    for (Eigen::Vector3d& v : shape.vertices)
        v = v / 12 + random.vector(0.2);
    return shape;
}

void add_slivers(Shape& shape, AttackRandom& random) {
    cut_into_triangles(shape);
    Shape slivers;
    for (int count = random.integer(1, 3); count > 0; --count) {
        const auto at = std::size_t(random.integer(0, int(shape.faces.size()) - 1));
        const std::vector<std::uint32_t> face = shape.faces[at];
        const int first = random.integer(0, 2);
        const auto corner = [&](int i) { return face[std::size_t((first + i) % 3)]; };
        const Eigen::Vector3d a = shape.vertices[corner(0)], b = shape.vertices[corner(1)],
                              c = shape.vertices[corner(2)];
        const double width = std::pow(10, random.uniform(-12, -3));
        const bool is_near_corner = random.chance(0.5);
        const Eigen::Vector3d near = is_near_corner ? a : Eigen::Vector3d((a + b) / 2);
        const Eigen::Vector3d far = is_near_corner ? Eigen::Vector3d((b + c) / 2) : c;
        const Eigen::Vector3d cut = near + width * (far - near);
        const auto number = std::uint32_t(shape.vertices.size());
        shape.vertices.push_back(cut);
        shape.faces[at] = {corner(1), corner(2), number};
        shape.faces.push_back({corner(2), corner(0), number});
        shape.faces.push_back({corner(0), corner(1), number});
        const auto next = std::uint32_t(slivers.vertices.size());
        slivers.vertices.insert(slivers.vertices.end(), {a, b, cut});
        slivers.faces.push_back({next, next + 1, next + 2});
    }
    if (random.chance(0.4))
        shape = slivers;
}

void shift(Shape& shape, const Eigen::Vector3d& by) {
    for (Eigen::Vector3d& v : shape.vertices)
        v += by;
}

void set_against(Shape& moving, const Shape& fixed, const Eigen::Vector3d& direction, AttackRandom& random) {
    const Eigen::Vector3d there = some_point(foremost(fixed, direction), random);
    const Eigen::Vector3d here = some_point(foremost(moving, -direction), random);
    shift(moving, there - here);
}

Eigen::Vector3d some_direction(const Shape& shape, AttackRandom& random) {
    if (random.chance(0.4))
        return random.grid_direction(2).cast<double>();
    if (random.chance(0.3))
        return (random.chance(0.5) ? 1 : -1) * Eigen::Vector3d::Unit(random.integer(0, 2));
    const auto face = random.pick(shape.faces);
    const auto& v = shape.vertices;
    return (v[face[1]] - v[face[0]]).cross(v[face[2]] - v[face[0]]) * (random.chance(0.5) ? 1 : -1);
}

} // namespace chasles::attack
