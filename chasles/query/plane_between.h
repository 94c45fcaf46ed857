// One plane that keeps many faces apart until shortly before all of them touch: flat on flat.
// Source: docs/derivations/15-flat-on-flat.md.
#pragma once

#include "chasles/elementary/face_sides.h"
#include "chasles/query/feature_pairs.h"
#include "chasles/query/time_tree.h"

#include <vector>

namespace chasles::query {

/// The positive side of a plane, as points of one body see it for a while.
struct PlaneSide {
    using Wide = algebra::DoubleDouble;
    elementary::SeenPlane<Wide> plane;
    elementary::SeenPlane<double> rough; ///< good to within its own band

    /// Whether the point is proven to stay there.
    [[nodiscard]] bool has(const Vector3<double>& point) const;
    [[nodiscard]] bool has_roughly(const Vector3<double>& point) const { return rough.side_of(point) > 0; }
};

/// The part of a body that is proven to stay on one side of a plane. Each node and each vertex is looked at once.
class PartBeyond {
public:
    /// The body is kept by reference.
    PartBeyond(const Polyhedron& body, const PlaneSide& side)
        : body_(&body), side_(side), nodes_(body.hierarchy().nodes().size()), vertices_(body.vertices().size()) {}

    bool has_face(std::uint32_t face);
    /// Whether it has all faces below the node.
    bool has_node(std::uint32_t node);

private:
    enum class Known : signed char { nothing, inside, not_inside };

    template <class Look>
    static bool look_once(Known& known, Look look);
    bool has_vertex(std::uint32_t vertex);
    [[nodiscard]] bool has_box(const BoxNode& node) const;

    const Polyhedron* body_;
    PlaneSide side_;
    std::vector<Known> nodes_;
    std::vector<Known> vertices_;
};

/// Two bodies for a part of their motion.
struct BodiesInRange {
    const Polyhedron& moving;
    const Polyhedron& fixed;
    const motion::ControlMaps<algebra::DoubleDouble>& maps; ///< of the whole piece
    const elementary::ErrorScale& scale;
    TauRange range;
};

/// A plane parallel to a face, with the parts of both bodies that it keeps apart.
class PlaneBetween {
public:
    /// Half way between two faces at the end of the range, parallel to the fixed one or else to the moving one. None if
    /// neither plane keeps them apart all along.
    static std::optional<PlaneBetween> faces(const BodiesInRange& bodies, std::uint32_t moving_face,
                                             std::uint32_t fixed_face);

    /// Whether the faces below the nodes are proven to stay apart.
    bool keeps_apart(std::uint32_t moving_node, std::uint32_t fixed_node) {
        return moving_.has_node(moving_node) && fixed_.has_node(fixed_node);
    }

    [[nodiscard]] const TauRange& range() const { return range_; }

private:
    PlaneBetween(const BodiesInRange& bodies, const PlaneSide& of_moving, const PlaneSide& of_fixed)
        : moving_(bodies.moving, of_moving), fixed_(bodies.fixed, of_fixed), range_(bodies.range) {}

    PartBeyond moving_;
    PartBeyond fixed_;
    TauRange range_;
};

} // namespace chasles::query
