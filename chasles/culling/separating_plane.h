// One plane that keeps many faces apart until shortly before all of them touch: flat on flat.
// Source: docs/derivations/15-flat-on-flat.md.
#pragma once

#include "chasles/culling/cached_face.h"
#include "chasles/culling/time_tree.h"
#include "chasles/elementary/face_sides.h"

#include <vector>

namespace chasles::culling {

/// The positive side of a plane, as points of one body see it for a while.
struct PlaneSide {
    using Wide = algebra::DoubleDouble;
    elementary::RelativePlane<Wide> plane;
    elementary::RelativePlane<double> rough; ///< good to within its own band

    /// Whether the point is proven to stay there.
    [[nodiscard]] bool has(const Vector3<double>& point) const;
    [[nodiscard]] bool has_roughly(const Vector3<double>& point) const { return rough.side_of(point) > 0; }
};

/// The part of a body that is proven to stay on one side of a plane. Each node and each vertex is looked at once.
class HalfSpaceCache {
public:
    /// The body is kept by reference.
    HalfSpaceCache(const Body& body, const PlaneSide& side)
        : body_(&body), side_(side), nodes_(body.bvh().nodes().size()), vertices_(body.vertices().size()) {}

    bool has_face(std::uint32_t face);
    /// Whether it has all faces below the node.
    bool has_node(std::uint32_t node);

private:
    enum class Known : signed char { nothing, inside, not_inside };

    template <class Look>
    static bool memoize(Known& known, Look look);
    bool has_vertex(std::uint32_t vertex);
    [[nodiscard]] bool has_box(const BvhNode& node) const;

    const Body* body_;
    PlaneSide side_;
    std::vector<Known> nodes_;
    std::vector<Known> vertices_;
};

/// Two bodies for a part of their motion.
struct BodiesInRange {
    const Body& moving;
    const Body& fixed;
    const motion::ControlMaps<algebra::DoubleDouble>& maps; ///< of the whole piece
    const elementary::ErrorScale& scale;
    TimeRange range;
};

/// A plane parallel to a face, with the parts of both bodies that it keeps apart.
class SeparatingPlane {
public:
    /// Half way between two faces at the end of the range, parallel to the fixed one or else to the moving one. None if
    /// neither plane keeps them apart all along.
    static std::optional<SeparatingPlane> faces(const BodiesInRange& bodies, std::uint32_t moving_face,
                                                std::uint32_t fixed_face);

    /// Whether the faces below the nodes are proven to stay apart.
    bool keeps_apart(std::uint32_t moving_node, std::uint32_t fixed_node) {
        return moving_.has_node(moving_node) && fixed_.has_node(fixed_node);
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
