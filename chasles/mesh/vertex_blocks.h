// The vertices of a body in single precision and in blocks, for a scan of all of them.
// Source: docs/derivations/23-coarse-motion.md, "One plane".
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

namespace chasles {

class Body;

/// Eight vertices, relative to the centre of the body's hierarchy.
struct alignas(32) VertexBlock {
    static constexpr std::size_t size = 8;
    std::array<float, size> x, y, z;
};

/// All vertices; the last one fills its block.
std::vector<VertexBlock> vertex_blocks_of(const Body& body);

/// How far the vertices reach in a direction.
float reach_of(std::span<const VertexBlock> blocks, const Eigen::Vector3f& direction);

/// A vertex that reaches so far, by `reach_of` with the same direction.
Eigen::Vector3f vertex_at_reach(std::span<const VertexBlock> blocks, const Eigen::Vector3f& direction, float reach);

} // namespace chasles
