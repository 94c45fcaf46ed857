// Computes the faces around vertices, the normal cones and the directions from features on the first request, and
// counts memory. Several threads may request them at the same time.
#include "chasles/mesh/body.h"

#include "chasles/algebra/double_double.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace chasles {

namespace {

/// For each corner, the lists that contain it, each once and in ascending order.
FlatLists<std::uint32_t> lists_with(const FlatLists<std::uint32_t>& outlines, std::size_t corner_count) {
    const auto for_each = [&](auto visit) {
        std::vector<std::uint32_t> last(corner_count,
                                        0); // for each corner: number of the last list that contains it, plus one
        for (std::uint32_t list = 0; list < outlines.size(); ++list)
            for (const std::uint32_t corner : outlines[list])
                if (std::exchange(last[corner], list + 1) != list + 1)
                    visit(corner, list);
    };
    FlatLists<std::uint32_t> lists;
    lists.offsets.assign(corner_count + 1, 0);
    for_each([&](std::uint32_t corner, std::uint32_t) { ++lists.offsets[corner + 1]; });
    std::partial_sum(lists.offsets.begin(), lists.offsets.end(), lists.offsets.begin());
    lists.items.resize(lists.offsets.back());
    std::vector<std::uint32_t> next(lists.offsets.begin(), lists.offsets.end() - 1);
    for_each([&](std::uint32_t corner, std::uint32_t list) { lists.items[next[corner]++] = list; });
    return lists;
}

} // namespace

double distance_of_polyhedra(const Body& moving, const Body& fixed, double distance) {
    const auto sum = algebra::DoubleDouble(distance) + moving.radius() + fixed.radius();
    return sum.low() > 0 ? std::nextafter(sum.high(), std::numeric_limits<double>::infinity()) : sum.high();
}

Body::Body(BodyParts parts) : parts_(std::move(parts)) {
    constexpr double outward = 1 + 1e-14; // for the rounding of distances
    for (const Eigen::Vector3d& vertex : parts_.vertices)
        ball_radius_ = std::max(ball_radius_, (vertex - parts_.bvh.centre()).norm() * outward);
    ball_radius_ = std::min(ball_radius_, parts_.bvh.radius()) + radius();
}

std::span<const std::uint32_t> Body::faces_around(std::size_t vertex) const {
    std::call_once(faces_around_once_, [&] { faces_around_ = lists_with(parts_.outlines, parts_.vertices.size()); });
    return faces_around_[vertex];
}

std::span<const NormalCone> Body::normal_cones() const {
    std::call_once(normal_cones_once_, [&] { normal_cones_ = normal_cones_of(*this); });
    return normal_cones_;
}

std::span<const VertexBlock> Body::vertex_blocks() const {
    std::call_once(vertex_blocks_once_, [&] { vertex_blocks_ = vertex_blocks_of(*this); });
    return vertex_blocks_;
}

std::size_t Body::memory() const {
    const std::size_t ids = parts_.source.capacity() + parts_.closing.source.capacity();
    return sizeof(Body) + parts_.outlines.memory() + parts_.closing.outlines.memory() + ids * sizeof(std::uint32_t) +
           parts_.triangles.memory() + parts_.owned_vertices.memory() + parts_.owned_edges.memory() +
           parts_.bvh.memory() + parts_.volume.memory();
}

} // namespace chasles
