// The faces of a body in an order whose ranges lie near each other: the nodes of a certificate.
// Source: docs/certificate.md, "Order".
#pragma once

#include "chasles/certificate/plane_form.h"
#include "chasles/mesh/polyhedron.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace chasles::certificate {

class FaceTree {
public:
    /// The body is kept by reference.
    explicit FaceTree(const Polyhedron& body);

    /// A range of the order.
    struct Node {
        explicit Node(std::uint32_t first, std::uint32_t last) : begin(first), end(last) {}
        std::uint32_t begin, end;
        std::uint32_t parts = 0;                          ///< the first of two nodes; 0 if there is one face only
        std::uint32_t first_corner = 0, corner_count = 0; ///< of nodes with few faces
        Corner centre, half;                              ///< of a box around the corners, and of its sides
        double extent = 0;                                ///< the diagonal of the box

        [[nodiscard]] bool is_leaf() const { return parts == 0; }
    };
    [[nodiscard]] const Node& node(std::uint32_t index) const { return nodes_[index]; } ///< 0: all faces
    /// The greatest value of the corners of a node. `bound(node)` is at least the values of its corners, in double.
    template <class Bound, class Value>
    [[nodiscard]] auto greatest(const Node& node, const Bound& bound, const Value& value) const {
        auto best = value(some_corner(node));
        std::array<const Node*, 64> waiting; // NOLINT(cppcoreguidelines-pro-type-member-init): halves of halves
        std::size_t count = 0;
        for (waiting[count++] = &node; count > 0;) {
            const Node& next = *waiting[--count];
            if (bound(next) <= static_cast<double>(best))
                continue;
            if (next.corner_count == 0) {
                waiting[count++] = &nodes_[next.parts];
                waiting[count++] = &nodes_[next.parts + 1];
                continue;
            }
            for (const Corner& corner : std::span(corners_).subspan(next.first_corner, next.corner_count))
                if (const auto other = value(corner); best < other)
                    best = other;
        }
        return best;
    }
    [[nodiscard]] Corner some_corner(const Node& node) const { return corner(first_face(node), 0); }
    [[nodiscard]] std::uint32_t first_face(const Node& node) const { return order_[node.begin]; }
    [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }
    [[nodiscard]] const Polyhedron& body() const { return *body_; }
    [[nodiscard]] Corner corner(std::size_t face, std::size_t number) const;

private:
    void divide(std::uint32_t index, std::span<const Corner> middles);
    std::span<const Corner> add_corners(Node& node);
    /// Nodes with so many faces have a list of their corners.
    static constexpr std::uint32_t few_faces = 8;

    const Polyhedron* body_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
    std::vector<Corner> corners_; ///< of each node with few faces, each vertex once
};

} // namespace chasles::certificate
