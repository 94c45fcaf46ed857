// Bytes as a query: two small bodies, mostly in degenerate positions, and a motion.
#pragma once

#include "chasles/mesh/body.h"
#include "chasles/query/first_contact.h"
#include "tests/fuzz/bytes.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <variant>
#include <vector>

namespace chasles::fuzz {

/// The kind of coordinates. All kinds except `raw` make parallel edges, shared planes and exact touches frequent.
enum class Coordinates : std::uint8_t { grid, tenths, nearly_grid, raw };

using Faces = std::vector<std::vector<std::uint32_t>>;

/// Unchecked vertices and faces.
struct Soup {
    std::vector<Eigen::Vector3d> vertices;
    Faces faces;
};

/// Reads bodies and poses in one kind of coordinates, up to 3 in size.
class Scene {
public:
    Scene(Bytes& bytes, Coordinates kind) : bytes_(bytes), kind_(kind) {}

    Soup soup() {
        switch (bytes_.below(7)) {
        case 0:
            return {points(3), {{0, 1, 2}}};
        case 1: // a hinge
            return {points(4), {{0, 1, 2}, {0, 2, 3}}};
        case 2: // a tetrahedron
            return {points(4), {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
        case 3: // a pyramid on a bent base
            return {points(5), {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {0, 2, 1}, {0, 3, 2}}};
        case 4:
            return with_quads(parallelepiped(2), {{0, 1, 3, 2}});
        case 5:
            return with_quads(parallelepiped(3),
                              {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}});
        default:
            return any_surface();
        }
    }

    Eigen::Vector3d point() {
        Eigen::Vector3d point;
        for (double& coordinate : point)
            coordinate = number();
        return point;
    }

    /// A quaternion of small whole numbers, unless coordinates are raw. Zero means no turn.
    Eigen::Quaterniond rotation() {
        Eigen::Quaterniond rotation;
        for (double& number : rotation.coeffs())
            number = kind_ == Coordinates::raw ? bytes_.fraction() : double(bytes_.below(7)) - 3;
        return rotation.coeffs().isZero() ? Eigen::Quaterniond::Identity() : rotation;
    }

    /// A quaternion whose length is a whole number, which makes the turn of a sweep rational.
    Eigen::Quaterniond rotation_of_whole_length() {
        static constexpr std::array<std::array<double, 4>, 8> lengths{{{1, 0, 0, 0},
                                                                       {1, 1, 1, 1},
                                                                       {3, 4, 0, 0},
                                                                       {1, 2, 2, 0},
                                                                       {1, 2, 2, 4},
                                                                       {2, 3, 6, 0},
                                                                       {1, 1, 3, 5},
                                                                       {12, 5, 0, 0}}};
        std::array<double, 4> numbers = lengths[bytes_.below(8)];
        const unsigned signs = bytes_.byte();
        std::rotate(numbers.begin(), numbers.begin() + (signs >> 4 & 3), numbers.end());
        for (unsigned i = 0; i < 4; ++i)
            numbers[i] *= signs >> i & 1 ? -1 : 1;
        return {numbers[0], numbers[1], numbers[2], numbers[3]};
    }

private:
    double number() {
        if (kind_ == Coordinates::raw)
            return 3 * bytes_.fraction();
        const double half_steps = double(bytes_.below(13)) - 6;
        if (kind_ == Coordinates::tenths)
            return 0.3 * half_steps;
        const double off = kind_ == Coordinates::nearly_grid ? double(std::int8_t(bytes_.byte())) * 0x1p-50 : 0;
        return 0.5 * half_steps + off;
    }

    std::vector<Eigen::Vector3d> points(int count) {
        std::vector<Eigen::Vector3d> points;
        for (int i = 0; i < count; ++i)
            points.push_back(point());
        return points;
    }

    /// All corners of the parallelepiped that the edges at one point span.
    std::vector<Eigen::Vector3d> parallelepiped(int edges) {
        std::vector<Eigen::Vector3d> corners{point()};
        for (int i = 0; i < edges; ++i) {
            const Eigen::Vector3d edge = point();
            for (std::size_t known = corners.size(), j = 0; j < known; ++j)
                corners.emplace_back(corners[j] + edge);
        }
        return corners;
    }

    /// Quadrangles off the grid are planar only up to rounding. They are cut into triangles, because this test is not
    /// about warped faces.
    [[nodiscard]] Soup with_quads(std::vector<Eigen::Vector3d> corners, Faces quads) const {
        if (kind_ == Coordinates::grid)
            return {std::move(corners), std::move(quads)};
        Faces triangles;
        for (const auto& quad : quads)
            triangles.insert(triangles.end(), {{quad[0], quad[1], quad[2]}, {quad[0], quad[2], quad[3]}});
        return {std::move(corners), std::move(triangles)};
    }

    /// Faces with arbitrary indices over a few vertices: surfaces that fold, branch and intersect themselves.
    Soup any_surface() {
        Soup soup{points(5), {}};
        for (unsigned count = 1 + bytes_.below(6); count > 0; --count)
            soup.faces.push_back({bytes_.below(5), bytes_.below(5), bytes_.below(5)});
        return soup;
    }

    Bytes& bytes_;
    Coordinates kind_;
};

using ScrewOrSweep = std::variant<ScrewMotion, SweepMotion>;

/// One query. The constructor throws InvalidInput for invalid bodies.
struct Question {
    Coordinates coordinates;
    Find find;
    Polyhedron moving;
    Polyhedron fixed;
    ScrewOrSweep motion;
    Eigen::Vector3d centre; ///< centre of a sweep

    [[nodiscard]] FirstContact ask() const {
        const Motion any = std::visit([](const auto& typed) { return Motion(typed); }, motion);
        return first_contact({.moving = moving, .fixed = fixed, .motion = any, .options = {.find = find}});
    }
};

/// Seams that differ by rounding count as closed, which is not for exact numbers: there, the body is its surface.
inline Polyhedron body_from(Scene& scene) {
    const Soup soup = scene.soup();
    Polyhedron body = Polyhedron::from_polygons(soup.vertices, soup.faces);
    if (body.body().volume().joined.empty())
        return body;
    return Polyhedron::from_polygons(soup.vertices, soup.faces, {.solid = Solid::no});
}

/// Kind 0 is a motion without turn, kind 1 a sweep, and all other kinds are screws.
inline ScrewOrSweep motion_from(unsigned kind, double max_turn, const Eigen::Vector3d& centre, Scene& scene) {
    const auto rotation = [&] {
        return kind == 0   ? Eigen::Quaterniond::Identity()
               : kind == 1 ? scene.rotation_of_whole_length()
                           : scene.rotation();
    };
    const auto pose = [&] {
        const Eigen::Vector3d position = scene.point();
        return Pose(position, rotation());
    };
    const Pose start = pose();
    const Pose goal = pose();
    if (kind == 1)
        return SweepMotion::between(start, goal, centre);
    return ScrewMotion::between(start, goal, max_turn);
}

inline Question question_from(Bytes& bytes) {
    const auto coordinates = Coordinates(bytes.below(4));
    const unsigned options = bytes.byte();
    const auto find = Find((options >> 2 & 7) % 3);
    const double max_turn = (options & 64) != 0 ? 0.9 : std::numbers::pi;
    Scene scene(bytes, coordinates);
    const Eigen::Vector3d centre = scene.point();
    const ScrewOrSweep motion = motion_from(options & 3, max_turn, centre, scene);
    const Polyhedron moving = body_from(scene);
    return {coordinates, find, moving, body_from(scene), motion, centre};
}

} // namespace chasles::fuzz
