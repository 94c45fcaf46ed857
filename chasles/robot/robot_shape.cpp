// A robot as one rigid body, for questions in which its joints do not move.
#include "chasles/mesh/exact_orientation.h"
#include "chasles/mesh/primitives.h"
#include "chasles/robot/added_radius.h"
#include "chasles/robot/model.h"

#include <algorithm>
#include <array>
#include <optional>

namespace chasles {

namespace {

using CornerIds = std::vector<std::uint32_t>;

/// The surfaces of several shapes, each placed by a pose.
class MergedSurface {
public:
    void add(const Polyhedron& shape, const Eigen::Isometry3d& pose) {
        const auto first = std::uint32_t(vertices_.size());
        for (const Eigen::Vector3d& vertex : shape.vertices())
            vertices_.emplace_back(pose * vertex);
        const auto outlines = shape.outlines();
        for (std::size_t face = 0; face < outlines.size(); ++face)
            add_face(shape, face, {outlines[face].begin(), outlines[face].end()}, first);
    }

    [[nodiscard]] bool is_empty() const { return faces_.empty(); }
    [[nodiscard]] Polyhedron body(PolyhedronOptions options) const {
        options.triangulate = true;
        return Polyhedron::from_polygons(vertices_, faces_, options);
    }

private:
    /// Whole if it is still planar or closes a gap only, else in triangles, which are planar always.
    void add_face(const Polyhedron& shape, std::size_t face, CornerIds corners, std::uint32_t first) {
        for (std::uint32_t& corner : corners)
            corner += first;
        if (face >= shape.face_count() || is_planar(corners)) {
            faces_.push_back(std::move(corners));
            return;
        }
        for (const auto& [a, b, c] : shape.triangles(face))
            faces_.push_back({a + first, b + first, c + first});
    }

    [[nodiscard]] bool is_planar(const CornerIds& corners) const {
        for (std::size_t i = 3; i < corners.size(); ++i)
            if (!are_coplanar(vertices_[corners[0]], vertices_[corners[1]], vertices_[corners[2]],
                              vertices_[corners[i]]))
                return false;
        return true;
    }

    std::vector<Eigen::Vector3d> vertices_;
    std::vector<CornerIds> faces_;
};

/// The shape, or a polyhedron that encloses it: a sphere, or a capsule along z, as URDF files have them.
Polyhedron surface_of(const Polyhedron& shape, const std::string& robot) {
    constexpr double deviation = 0.01; // as a part of the radius
    const double radius = shape.radius();
    if (radius == 0)
        return shape;
    const auto ends = shape.vertices();
    if (ends.size() == 1 && ends[0].isZero(0))
        return enclosing_sphere(radius, deviation * radius).shape;
    if (ends.size() == 2 && ends[0] == -ends[1] && ends[0].head<2>().isZero(0))
        return enclosing_capsule(radius, (ends[1] - ends[0]).norm(), deviation * radius).shape;
    robot::refuse(robot, "has meshes with a radius, which are no surface of faces; leave it at 0");
}

/// The radius that all shapes have, and that their union has then: one sphere, or several capsules of one radius. None
/// where it cannot be kept: a radius has an inside always, which `Solid::no` leaves out.
std::optional<double> common_radius(const std::vector<robot::Element>& elements, Solid solid) {
    if (elements.empty())
        return std::nullopt;
    const double radius = elements.front().shape.radius();
    const auto has_another = [&](const robot::Element& element) { return element.shape.radius() != radius; };
    if (std::ranges::any_of(elements, has_another) || (radius > 0 && solid == Solid::no))
        return std::nullopt;
    return radius;
}

} // namespace

Polyhedron Robot::shape(const Configuration& configuration, const PolyhedronOptions& options) const {
    const std::array ends{configuration, configuration};
    const JointPath path = JointPath::straight(*this, ends);
    const robot::SegmentMotion motion = model_->motion_of(path.segments().front());
    const std::optional<double> radius = common_radius(model_->elements, options.solid);
    MergedSurface surface;
    for (const robot::Element& element : model_->elements) {
        Eigen::Isometry3d pose = model_->pose_of(motion, element.owner, 0).isometry();
        if (element.owner < model_->description.links.size())
            pose = pose * model_->description.links[element.owner].collisions[element.shape_index].origin.isometry();
        surface.add(radius ? element.shape : surface_of(element.shape, model_->description.name), pose);
    }
    if (surface.is_empty())
        robot::refuse(model_->description.name, "has no collision shapes");
    PolyhedronOptions of_body = options;
    of_body.radius = added_radius(radius.value_or(0), options.radius);
    return surface.body(of_body);
}

} // namespace chasles
