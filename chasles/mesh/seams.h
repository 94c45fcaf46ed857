// The seams of a surface: places of its rim that differ by rounding, as at the angles 0 and 2 pi of a sphere. They
// count as closed where only the inside of the body is asked for. Source: docs/derivations/37-inside.md, "Seams".
#pragma once

#include "chasles/mesh/edge.h"

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace chasles {

/// The vertex that a vertex counts as, by pairs as of Seams::joined().
[[nodiscard]] std::uint32_t place_in(std::span<const Edge> joined, std::uint32_t vertex);

class Seams {
public:
    /// Vertices are kept by reference.
    Seams(std::span<const Eigen::Vector3d> vertices, std::span<const UnpairedEdge> unpaired);

    /// The edges that no seam closes.
    [[nodiscard]] const std::vector<UnpairedEdge>& unpaired() const { return unpaired_; }
    /// Pairs of vertices that count as one: from a vertex to the one that it counts as, ascending.
    [[nodiscard]] const std::vector<Edge>& joined() const { return joined_; }
    /// The greatest difference of the coordinates of vertices that count as one, mesh unit.
    [[nodiscard]] double width() const { return joined_.empty() ? 0 : 2 * reach_; }

private:
    void join(std::vector<std::uint32_t> rim);
    void add(const UnpairedEdge& edge);
    void pair_up();

    std::span<const Eigen::Vector3d> vertices_;
    double reach_ = 0;
    std::vector<Edge> joined_;
    std::vector<UnpairedEdge> unpaired_;
};

} // namespace chasles
