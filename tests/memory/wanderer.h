// A body that wanders along another one, and the pairs of faces that come near on its way.
#pragma once

#include "chasles/search/piece_context.h"
#include "tests/mesh/shapes.h"
#include "tests/query/bodies.h"
#include "tests/support/surface_distance.h"

#include <random>
#include <set>
#include <utility>

namespace chasles::memory {

/// Two links of a chain: one of them wanders along the surface of the other one.
class Wanderer {
public:
    static Pose home() { return test::turned({1.393, 0, 0}, Eigen::Vector3d::UnitX(), 1.5); }

    /// A piece of the way: mostly short, sometimes long.
    Motion next() {
        const double step = test::uniform(random_, 0, 1) < 0.1 ? 0.2 : 0.003;
        const Pose goal = test::composed(pose_, test::turned(test::random_vector(random_, step),
                                                             test::random_vector(random_, 1).normalized(),
                                                             test::uniform(random_, 0, step)));
        const Motion way = ScrewMotion::between(pose_, goal);
        pose_ = goal;
        if ((pose_.translation - home().translation).norm() > 0.03)
            pose_ = home();
        return way;
    }

    [[nodiscard]] const Polyhedron& moving() const { return moving_; }
    [[nodiscard]] const Polyhedron& fixed() const { return fixed_; }
    [[nodiscard]] search::PieceContext context(const Motion& way) const {
        return {moving_.body(), fixed_.body(), way.trajectory().pieces()->at(0)};
    }

private:
    static Polyhedron link(std::uint32_t around, std::uint32_t across) {
        const test::Soup soup = test::torus(around, across);
        return Polyhedron::from_polygons(soup.vertices, soup.faces);
    }

    Polyhedron moving_ = link(24, 10);
    Polyhedron fixed_ = link(26, 11);
    Pose pose_ = home();
    std::mt19937 random_{7};
};

inline test::Triangle3<double> triangle_at(const Polyhedron& shape, std::uint32_t face, const Pose& pose) {
    const auto corners = shape.body().face(face);
    const auto point = [&](std::size_t i) {
        const Eigen::Vector3d place = pose.isometry() * shape.body().vertices()[corners[i]];
        return test::Point3<double>{place.x(), place.y(), place.z()};
    };
    return {point(0), point(1), point(2)};
}

/// Whether balls around two triangles are within a distance.
inline bool may_be_near(const test::Triangle3<double>& a, const test::Triangle3<double>& b, double distance) {
    const auto radius = [](const test::Triangle3<double>& t) {
        return std::max((t[1] - t[0]).norm(), (t[2] - t[0]).norm());
    };
    return (a[0] - b[0]).norm() <= distance + radius(a) + radius(b);
}

/// Pairs of faces that come within a distance at some time, of some that are tried.
inline std::set<std::pair<std::uint32_t, std::uint32_t>> sampled_near(const Wanderer& bodies, const Motion& way,
                                                                      double margin) {
    const auto triangles_at = [](const Polyhedron& shape, const Pose& pose) {
        std::vector<test::Triangle3<double>> triangles;
        for (std::uint32_t face = 0; face < shape.face_count(); ++face)
            triangles.push_back(triangle_at(shape, face, pose));
        return triangles;
    };
    std::set<std::pair<std::uint32_t, std::uint32_t>> near;
    const auto fixed = triangles_at(bodies.fixed(), Pose());
    for (const double time : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        const auto moving = triangles_at(bodies.moving(), way.pose_at(time));
        for (std::size_t f = 0; f < moving.size(); ++f)
            for (std::size_t g = 0; g < fixed.size(); ++g)
                if (may_be_near(moving[f], fixed[g], margin) &&
                    test::squared_distance_of_triangles<double>(moving[f], fixed[g]) < margin * margin)
                    near.insert({std::uint32_t(f), std::uint32_t(g)});
    }
    return near;
}

} // namespace chasles::memory
