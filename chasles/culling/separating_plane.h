// One plane that separates many faces of both bodies during a part of the motion, for flat faces on flat faces.
// Source: docs/derivations/15-flat-on-flat.md.
#pragma once

#include "chasles/culling/cached_face.h"
#include "chasles/culling/time_tree.h"
#include "chasles/elementary/face_sides.h"

#include <vector>

namespace chasles::culling {

/// The positive side of a plane relative to one body, during a part of the motion.
struct PlaneSide {
    using Wide = algebra::DoubleDouble;
    elementary::RelativePlane<Wide> plane;
    elementary::RelativePlane<double> rough; ///< the same plane in double, with a larger band

    /// Whether the point is proven to stay on the positive side.
    [[nodiscard]] bool contains(const Vector3<double>& point) const;
    /// The same test in double only: faster, with fewer proofs.
    [[nodiscard]] bool contains_roughly(const Vector3<double>& point) const { return rough.side_of(point) > 0; }
};

/// The part of a body that is proven to stay on one side of a plane. The result for each node and vertex is computed
/// once.
class HalfSpaceCache {
public:
    /// Keeps the body by reference.
    HalfSpaceCache(const Body& body, const PlaneSide& side)
        : body_(&body), side_(side), nodes_(body.bvh().nodes().size()), vertices_(body.vertices().size()) {}

    /// Whether the half-space contains a face.
    bool contains_face(std::uint32_t face);
    /// Whether the half-space contains all faces below a node.
    bool contains_node(std::uint32_t node);

private:
    enum class Result : signed char { unknown, inside, not_inside };

    template <class Test>
    static bool memoize(Result& result, Test test);
    bool contains_vertex(std::uint32_t vertex);
    [[nodiscard]] bool contains_box(const BvhNode& node) const;

    const Body* body_;
    PlaneSide side_;
    std::vector<Result> nodes_;
    std::vector<Result> vertices_;
};

/// Two bodies during a part of their motion. All members but the range are kept by reference.
struct BodiesInRange {
    const Body& moving;
    const Body& fixed;
    const motion::ControlMaps<algebra::DoubleDouble>& maps; ///< of the whole piece
    const elementary::ErrorScale& scale;
    TimeRange range;
};

/// A plane parallel to a face, and the parts of both bodies that are proven to stay on its two sides.
class SeparatingPlane {
public:
    /// The plane half way between two faces at the end of the range, parallel to the fixed face or else to the moving
    /// face. Empty if neither plane separates the faces during the whole range.
    static std::optional<SeparatingPlane> faces(const BodiesInRange& bodies, std::uint32_t moving_face,
                                                std::uint32_t fixed_face);

    /// Whether the faces below both nodes are proven to stay apart during the range.
    bool keeps_apart(std::uint32_t moving_node, std::uint32_t fixed_node) {
        return moving_.contains_node(moving_node) && fixed_.contains_node(fixed_node);
    }

    [[nodiscard]] const TimeRange& range() const { return range_; }

private:
    SeparatingPlane(const BodiesInRange& bodies, const PlaneSide& of_moving, const PlaneSide& of_fixed)
        : moving_(bodies.moving, of_moving), fixed_(bodies.fixed, of_fixed), range_(bodies.range) {}

    HalfSpaceCache moving_;
    HalfSpaceCache fixed_;
    TimeRange range_;
};

} // namespace chasles::culling
