#include "chasles/certificate/face_tree.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

namespace chasles::certificate {

namespace {

Corner corner_of(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

/// A box around points.
struct Box {
    Corner lower, upper;

    template <class Points>
    explicit Box(const Points& points) : lower(*points.begin()), upper(lower) {
        for (const Corner& point : points)
            for (int i = 0; i < 3; ++i) {
                lower[i] = std::min(lower[i], point[i]);
                upper[i] = std::max(upper[i], point[i]);
            }
    }
    /// Around two boxes.
    Box(const Box& first, const Box& second) : Box(std::array{first.lower, first.upper, second.lower, second.upper}) {}
    [[nodiscard]] int longest_side() const {
        const Corner sides = upper - lower;
        return sides.x >= sides.y && sides.x >= sides.z ? 0 : sides.y >= sides.z ? 1 : 2;
    }
};

} // namespace

FaceTree::FaceTree(const Polyhedron& body) : body_(&body), order_(body.face_count()) {
    std::iota(order_.begin(), order_.end(), 0U);
    std::vector<Corner> middles;
    for (std::size_t face = 0; face < body.face_count(); ++face) {
        Corner sum;
        for (const std::uint32_t vertex : body.face(face))
            sum = sum + corner_of(body.vertices()[vertex]);
        middles.push_back(scale(sum, 1.0 / double(body.face(face).size())));
    }
    nodes_.push_back(Node{0, std::uint32_t(order_.size())});
    for (std::uint32_t index = 0; index < nodes_.size(); ++index)
        divide(index, middles);
    std::vector<std::optional<Box>> boxes(nodes_.size());
    for (std::size_t index = nodes_.size(); index-- > 0;) { // parts come after the whole
        Node& node = nodes_[index];
        boxes[index] = node.end - node.begin <= few_faces ? Box(add_corners(node))
                                                          : Box(*boxes[node.parts], *boxes[node.parts + 1]);
        const auto& [lower, upper] = *boxes[index];
        node.centre = scale(lower + upper, 0.5);
        node.half = scale(upper - lower, 0.5);
        node.extent = length(upper - lower);
    }
}

/// At the middle face along the longest side of the box of the middles.
void FaceTree::divide(std::uint32_t index, std::span<const Corner> middles) {
    const std::uint32_t begin = nodes_[index].begin, end = nodes_[index].end;
    if (end - begin < 2)
        return;
    std::vector<Corner> own;
    for (std::uint32_t i = begin; i < end; ++i)
        own.push_back(middles[order_[i]]);
    const int axis = Box(own).longest_side();
    const std::uint32_t half = (begin + end) / 2;
    const auto at = [&](std::uint32_t i) { return order_.begin() + std::ptrdiff_t(i); };
    std::nth_element(at(begin), at(half), at(end), [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(middles[a][axis], a) < std::pair(middles[b][axis], b);
    });
    nodes_[index].parts = std::uint32_t(nodes_.size());
    nodes_.push_back(Node{begin, half});
    nodes_.push_back(Node{half, end});
}

std::span<const Corner> FaceTree::add_corners(Node& node) {
    std::vector<std::uint32_t> ids;
    for (std::uint32_t i = node.begin; i < node.end; ++i)
        for (const std::uint32_t vertex : body_->face(order_[i]))
            ids.push_back(vertex);
    std::ranges::sort(ids);
    ids.erase(std::ranges::unique(ids).begin(), ids.end());
    node.first_corner = std::uint32_t(corners_.size());
    node.corner_count = std::uint32_t(ids.size());
    for (const std::uint32_t id : ids)
        corners_.push_back(corner_of(body_->vertices()[id]));
    return std::span(corners_).subspan(node.first_corner);
}

Corner FaceTree::corner(std::size_t face, std::size_t number) const {
    const auto outline = body_->face(face);
    return corner_of(body_->vertices()[outline[number % outline.size()]]);
}

} // namespace chasles::certificate
