#include "chasles/culling/nested_boxes.h"

#include "chasles/culling/winding.h"

namespace chasles::culling {

namespace {

/// The rounding of places in double over the sum of all lengths is far below.
constexpr double rounding = 0x1p-40;

bool may_be_inside(const PlacedPair& pair) {
    const auto& [inner, outer, placed, slack] = pair;
    bool may_be = false;
    for_each_nested_point(pair, [&](std::uint32_t vertex) {
        const Eigen::Vector3d place =
            outer.bvh().centre() + placed.offset + placed.rotation * (inner.vertices()[vertex] - inner.bvh().centre());
        const WeightedPoint<double> point{{place.x(), place.y(), place.z()}, 1, slack};
        std::optional<int> winding;
        for (int ray = 0; ray < ray_count && !winding; ++ray)
            winding = winding_around(outer, point, place, slack, ray);
        return may_be = winding.value_or(1) > 0;
    });
    return may_be;
}

} // namespace

PlacedPair PlacedPair::swapped() const {
    const Eigen::Matrix3d back = placed.rotation.transpose();
    return {outer, inner, {back, -(back * placed.offset)}, slack};
}

detail::OuterBox::OuterBox(const PlacedPair& pair) {
    const BvhNode& root = pair.outer.bvh().nodes()[0];
    const double size = pair.inner.bvh().radius() + pair.outer.bvh().radius() + pair.placed.offset.lpNorm<1>();
    for (std::size_t i = 0; i < 3; ++i) {
        const double lower = root.lower[i], upper = root.upper[i];
        centre[Eigen::Index(i)] = 0.5 * (lower + upper);
        half[Eigen::Index(i)] = 0.5 * (upper - lower) + pair.slack + rounding * size;
    }
}

bool may_be_nested(const PlacedPair& pair) {
    return may_be_inside(pair) || may_be_inside(pair.swapped());
}

} // namespace chasles::culling
