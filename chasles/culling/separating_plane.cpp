// Finds a plane half way between two faces in double-double, then tests nodes and vertices against it.
// Source: docs/derivations/15-flat-on-flat.md.
#include "chasles/culling/separating_plane.h"

#include <algorithm>

namespace chasles::culling {

namespace {

using Wide = algebra::DoubleDouble;
using WidePolynomial = algebra::Bernstein<3, Wide>;
using WideRestriction = algebra::Restriction<3, Wide>;
using WidePlane = elementary::RelativePlane<Wide>;

/// The plane during a part of the motion.
WidePlane restricted(const WidePlane& plane, const WideRestriction& part) {
    const Vector3<WidePolynomial>& n = plane.normal;
    return {{part(n.x), part(n.y), part(n.z)}, part(plane.offset), part(plane.band)};
}

/// The same plane with the opposite normal. The band stays.
WidePlane flipped(const WidePlane& plane) {
    return {Vector3<WidePolynomial>() - plane.normal, WidePolynomial() - plane.offset, plane.band};
}

/// The parallel plane at a height of `height` / |normal| over this plane.
WidePlane raised(WidePlane plane, const WidePolynomial& weight, const Wide& height) {
    plane.offset = plane.offset - weight * height;
    return plane;
}

/// The plane of a face relative to both bodies, and the scale of its heights.
struct FacePlane {
    WidePlane by_own;   ///< relative to the body of the face
    WidePlane by_other; ///< relative to the other body, over the range
    Wide size;          ///< `FaceShape::size`
};

/// Both sides of a plane: of the body of the face, and of the other body.
struct Sides {
    PlaneSide of_own;
    PlaneSide of_other;
};

/// Finds planes for one range.
class PlaneFinder {
public:
    explicit PlaneFinder(const BodiesInRange& bodies)
        : bodies_(bodies), part_(Wide(bodies.range.lower), Wide(bodies.range.upper)),
          weight_(part_(bodies.maps.weight)) {}

    /// The sides of a plane parallel to a fixed face.
    std::optional<Sides> parallel_to_fixed(std::uint32_t fixed_face, std::uint32_t moving_face) {
        const auto& face = shape_.shape_of(bodies_.fixed, fixed_face);
        return half_way({plane_of_own_face(face, bodies_.scale),
                         restricted(plane_of_fixed_face(bodies_.maps, face, bodies_.scale), part_), face.size},
                        bodies_.moving, moving_face);
    }
    /// The sides of a plane parallel to a moving face.
    std::optional<Sides> parallel_to_moving(std::uint32_t moving_face, std::uint32_t fixed_face) {
        const auto& face = shape_.shape_of(bodies_.moving, moving_face);
        return half_way({plane_of_own_face(face, bodies_.scale),
                         restricted(plane_of_moving_face(bodies_.maps, face, bodies_.scale), part_), face.size},
                        bodies_.fixed, fixed_face);
    }

private:
    /// The plane half way to the other face. Empty if the first corner of the other face is on no proven side.
    std::optional<Sides> half_way(const FacePlane& plane, const Body& other, std::uint32_t face) const {
        const auto corners = other.face(face);
        const auto point = [&](std::uint32_t corner) { return point_of<Wide>(other, corner); };
        const int side = plane.by_other.side_of(point(corners[0]));
        if (side == 0)
            return std::nullopt;
        const WidePlane by_other = side > 0 ? plane.by_other : flipped(plane.by_other);
        const WidePlane by_own = side > 0 ? plane.by_own : flipped(plane.by_own);
        Wide least = end_height(by_other, point(corners[0]));
        for (const std::uint32_t corner : corners)
            least = std::min(least, end_height(by_other, point(corner)));
        const Wide half = least * Wide(0.5);
        const WidePolynomial one = WidePolynomial::constant(Wide(1));
        return Sides{side_of(flipped(raised(by_own, one, half)), one, plane.size),
                     side_of(raised(by_other, weight_, half), weight_, plane.size)};
    }

    /// The height of a point over the plane at the end of the range, times |normal|.
    [[nodiscard]] Wide end_height(const WidePlane& plane, const Vector3<Wide>& point) const {
        return (dot(plane.normal, point) + plane.offset)[3] / weight_[3];
    }

    /// Adds the plane in double. Coefficients are rounded once more and heights five times, a small part of
    /// `error_unit`.
    [[nodiscard]] PlaneSide side_of(const WidePlane& plane, const WidePolynomial& weight, const Wide& size) const {
        const auto rough = [](const WidePolynomial& p) { return algebra::converted<double>(p); };
        const double error = elementary::with_underflow(elementary::relative_error<double>(bodies_.scale) *
                                                        bodies_.scale.length * double(size));
        const Vector3<WidePolynomial>& n = plane.normal;
        return {plane,
                {{rough(n.x), rough(n.y), rough(n.z)}, rough(plane.offset), rough(plane.band) + rough(weight) * error}};
    }

    const BodiesInRange& bodies_;
    WideRestriction part_;
    WidePolynomial weight_;
    CachedFace<Wide> shape_;
};

} // namespace

bool PlaneSide::contains(const Vector3<double>& point) const {
    return contains_roughly(point) || plane.side_of({Wide(point.x), Wide(point.y), Wide(point.z)}) > 0;
}

/// Computes a result on the first request.
template <class Test>
bool HalfSpaceCache::memoize(Result& result, Test test) {
    if (result == Result::unknown)
        result = test() ? Result::inside : Result::not_inside;
    return result == Result::inside;
}

bool HalfSpaceCache::contains_vertex(std::uint32_t vertex) {
    return memoize(vertices_[vertex], [&] { return side_.contains(point_of<double>(*body_, vertex)); });
}

bool HalfSpaceCache::contains_face(std::uint32_t face) {
    const auto corners = body_->face(face);
    return std::all_of(corners.begin(), corners.end(), [&](std::uint32_t corner) { return contains_vertex(corner); });
}

bool HalfSpaceCache::contains_node(std::uint32_t index) {
    return memoize(nodes_[index], [&] {
        const BvhNode& node = body_->bvh().nodes()[index];
        if (node.is_leaf())
            return contains_face(node.first);
        return contains_box(node) || (contains_node(node.first) && contains_node(node.first + 1));
    });
}

/// Whether the half-space contains all corners of the box. Uses only the test in double.
bool HalfSpaceCache::contains_box(const BvhNode& node) const {
    const Eigen::Vector3d& centre = body_->bvh().centre();
    for (unsigned corner = 0; corner < 8; ++corner) {
        Vector3<double> point;
        for (int i = 0; i < 3; ++i) {
            const auto& end = (corner >> i & 1) != 0 ? node.upper : node.lower;
            point[i] = centre[i] + double(end[std::size_t(i)]);
        }
        if (!side_.contains_roughly(point))
            return false;
    }
    return true;
}

std::optional<SeparatingPlane> SeparatingPlane::faces(const BodiesInRange& bodies, std::uint32_t moving_face,
                                                      std::uint32_t fixed_face) {
    const auto if_apart = [&](const PlaneSide& of_moving, const PlaneSide& of_fixed) {
        std::optional<SeparatingPlane> plane(SeparatingPlane(bodies, of_moving, of_fixed));
        if (!plane->moving_.contains_face(moving_face) || !plane->fixed_.contains_face(fixed_face))
            plane.reset();
        return plane;
    };
    // The plane parallel to the fixed face is tried first, then the plane parallel to the moving face.
    PlaneFinder finder(bodies);
    std::optional<SeparatingPlane> plane;
    if (const auto sides = finder.parallel_to_fixed(fixed_face, moving_face))
        plane = if_apart(sides->of_other, sides->of_own);
    if (plane)
        return plane;
    if (const auto sides = finder.parallel_to_moving(moving_face, fixed_face))
        plane = if_apart(sides->of_own, sides->of_other);
    return plane;
}

} // namespace chasles::culling
