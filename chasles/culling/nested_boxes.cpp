#include "chasles/culling/nested_boxes.h"

#include "chasles/base/limit_of_thread.h"
#include "chasles/culling/winding.h"

#include <algorithm>
#include <array>
#include <span>

namespace chasles::culling {

namespace {

using Eigen::Vector3d;

/// The rounding of places in double over the sum of all lengths is far below.
constexpr double rounding = 0x1p-40;

/// Around the centre of the outer hierarchy.
struct Box {
    Vector3d lower;
    Vector3d upper;

    [[nodiscard]] bool meets(const Box& other) const {
        return (lower.array() <= other.upper.array()).all() && (other.lower.array() <= upper.array()).all();
    }
    [[nodiscard]] Box merged(const Box& other) const {
        return {lower.cwiseMin(other.lower), upper.cwiseMax(other.upper)};
    }
};

Box node_box(const BvhNode& node) {
    return {{node.lower[0], node.lower[1], node.lower[2]}, {node.upper[0], node.upper[1], node.upper[2]}};
}

/// The points of the inner body, as the outer one sees them.
class Points {
public:
    explicit Points(const PlacedPair& pair)
        : pair_(pair), parts_(pair.inner.volume()), sizes_(pair.placed.rotation.cwiseAbs()) {
        const double size = pair.inner.bvh().radius() + pair.outer.bvh().radius() + pair.placed.offset.lpNorm<1>();
        slack_ = pair.slack + rounding * size;
        outer_ = node_box(pair.outer.bvh().nodes()[0]);
    }

    std::vector<std::uint32_t> to_ask() {
        std::vector<std::size_t> near;
        for (std::size_t block = 0; block < parts_.blocks.size(); ++block)
            if (box_of(block).meets(outer_))
                near.push_back(block);
        visit(near);
        return std::move(asked_);
    }

private:
    [[nodiscard]] Box around(const Vector3d& point, const Vector3d& half) const {
        const Vector3d middle = pair_.placed.rotation * (point - pair_.inner.bvh().centre()) + pair_.placed.offset;
        const Vector3d reach = (sizes_ * half).array() + slack_;
        return {middle - reach, middle + reach};
    }
    [[nodiscard]] Box box_of(std::size_t block) const {
        return around(parts_.blocks[block].centre, parts_.blocks[block].half);
    }
    [[nodiscard]] std::uint32_t vertex(std::uint32_t part) const { return parts_.part_points[part]; }
    [[nodiscard]] bool is_near(std::uint32_t part) const {
        return around(pair_.inner.vertices()[vertex(part)], Vector3d::Zero()).meets(outer_);
    }

    /// Whether no face of the outer body comes near a box.
    [[nodiscard]] bool is_free(const Box& box) const {
        const std::span<const BvhNode> nodes = pair_.outer.bvh().nodes();
        std::array<std::uint32_t, Bvh::max_depth + 1> waiting; // NOLINT(cppcoreguidelines-pro-type-member-init)
        std::size_t count = 0;
        waiting[count++] = 0;
        while (count > 0) {
            const BvhNode& node = nodes[waiting[--count]];
            if (!node_box(node).meets(box))
                continue;
            if (node.is_leaf())
                return false;
            waiting[count++] = node.first;
            waiting[count++] = node.first + 1;
        }
        return true;
    }

    void visit(std::span<const std::size_t> blocks) {
        if (blocks.empty())
            return;
        throw_if_cancelled();
        const PartBlock &first = parts_.blocks[blocks.front()], &last = parts_.blocks[blocks.back()];
        if (last.end - first.begin > 1 && is_free(merged(blocks)))
            return ask_one(blocks);
        if (blocks.size() == 1) {
            for (std::uint32_t part = first.begin; part < first.end; ++part)
                if (is_near(part))
                    asked_.push_back(vertex(part));
            return;
        }
        visit(blocks.first(blocks.size() / 2));
        visit(blocks.subspan(blocks.size() / 2));
    }

    [[nodiscard]] Box merged(std::span<const std::size_t> blocks) const {
        Box box = box_of(blocks.front());
        for (const std::size_t block : blocks.subspan(1))
            box = box.merged(box_of(block));
        return box;
    }

    /// All points of these blocks are in one place, as seen by the outer surface.
    void ask_one(std::span<const std::size_t> blocks) {
        for (const std::size_t block : blocks)
            for (std::uint32_t part = parts_.blocks[block].begin; part < parts_.blocks[block].end; ++part)
                if (is_near(part)) {
                    asked_.push_back(vertex(part));
                    return;
                }
    }

    const PlacedPair& pair_;
    const Volume& parts_;
    Eigen::Matrix3d sizes_;
    Box outer_;
    double slack_ = 0;
    std::vector<std::uint32_t> asked_;
};

bool may_be_inside(const PlacedPair& pair) {
    const auto& [inner, outer, placed, slack] = pair;
    return std::ranges::any_of(points_to_ask(pair), [&](std::uint32_t vertex) {
        const Vector3d place =
            outer.bvh().centre() + placed.offset + placed.rotation * (inner.vertices()[vertex] - inner.bvh().centre());
        const WeightedPoint<double> point{{place.x(), place.y(), place.z()}, 1, slack};
        return is_inside(outer, point, place, slack).value_or(true);
    });
}

} // namespace

PlacedPair PlacedPair::swapped() const {
    const Eigen::Matrix3d back = placed.rotation.transpose();
    return {outer, inner, {back, -(back * placed.offset)}, slack};
}

std::vector<std::uint32_t> points_to_ask(const PlacedPair& pair) {
    return pair.outer.volume().is_solid() ? Points(pair).to_ask() : std::vector<std::uint32_t>();
}

bool may_be_nested(const PlacedPair& pair) {
    return may_be_inside(pair) || may_be_inside(pair.swapped());
}

} // namespace chasles::culling
