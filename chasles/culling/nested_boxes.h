// Which parts of one surface may lie inside of another body? Those with a point in its box, and by rays in double.
// Source: docs/derivations/37-inside.md, "When it is asked".
#pragma once

#include "chasles/culling/swept_boxes.h"
#include "chasles/mesh/body.h"

namespace chasles::culling {

/// One body in the frame of another one, both seen from the centres of their hierarchies; and how far any point may be
/// from its place, in the length unit.
struct PlacedPair {
    const Body& inner;
    const Body& outer;
    Placement placed;
    double slack;

    [[nodiscard]] PlacedPair swapped() const;
};

namespace detail {

/// A box that a body does not leave, around the centre of its hierarchy.
struct OuterBox {
    Eigen::Vector3d centre;
    Eigen::Vector3d half;

    explicit OuterBox(const PlacedPair& pair);
    [[nodiscard]] bool has(const Eigen::Vector3d& point) const {
        return ((point - centre).cwiseAbs().array() <= half.array()).all();
    }
    [[nodiscard]] bool meets(const Eigen::Vector3d& middle, const Eigen::Vector3d& reach) const {
        return ((middle - centre).cwiseAbs().array() <= (half + reach).array()).all();
    }
};

} // namespace detail

/// Calls `visit` with a vertex of each part of the inner body that has one in the box of the outer one, if that is
/// solid, until it returns true.
template <class Visit>
void for_each_nested_point(const PlacedPair& pair, Visit visit) {
    const auto& [inner, outer, placed, slack] = pair;
    if (!outer.volume().is_solid())
        return;
    const detail::OuterBox box(pair);
    const Volume& parts = inner.volume();
    const Eigen::Matrix3d sizes = placed.rotation.cwiseAbs();
    const auto place_of = [&](const Eigen::Vector3d& point) -> Eigen::Vector3d {
        return placed.rotation * (point - inner.bvh().centre()) + placed.offset;
    };
    for (const PartBlock& block : parts.blocks) {
        if (!box.meets(place_of(block.centre), sizes * block.half))
            continue;
        for (std::uint32_t i = block.begin; i < block.end; ++i)
            if (box.has(place_of(inner.vertices()[parts.part_points[i]])) && visit(parts.part_points[i]))
                return;
    }
}

/// False if no part of either body lies inside of the other one. True proves nothing.
bool may_be_nested(const PlacedPair& pair);

} // namespace chasles::culling
