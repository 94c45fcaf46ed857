#include "chasles/mesh/vertex_blocks.h"

#include "chasles/mesh/body.h"

#include <algorithm>
#include <cstring>
#include <limits>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace chasles {

namespace {

/// One register, which holds half a block.
typedef float FourFloats __attribute__((vector_size(16))); // NOLINT(modernize-use-using)

FourFloats greater(FourFloats a, FourFloats b) {
#if defined(__SSE2__)
    return FourFloats(_mm_max_ps(__m128(a), __m128(b)));
#else
    return a < b ? b : a;
#endif
}

bool has(FourFloats a, float number) {
#if defined(__SSE2__)
    return _mm_movemask_ps(_mm_cmpeq_ps(__m128(a), __m128(number - FourFloats{}))) != 0;
#else
    return a[0] == number || a[1] == number || a[2] == number || a[3] == number;
#endif
}

FourFloats four_of(const std::array<float, VertexBlock::size>& numbers, std::size_t half) {
    FourFloats four;
    std::memcpy(&four, &numbers[4 * half], sizeof four);
    return four;
}

/// A direction, whose numbers fill registers.
struct WideDirection {
    explicit WideDirection(const Eigen::Vector3f& v)
        : x(v.x() - FourFloats{}), y(v.y() - FourFloats{}), z(v.z() - FourFloats{}) {}

    [[nodiscard]] FourFloats along(const VertexBlock& block, std::size_t half) const {
        return x * four_of(block.x, half) + y * four_of(block.y, half) + z * four_of(block.z, half);
    }

    FourFloats x, y, z;
};

} // namespace

std::vector<VertexBlock> vertex_blocks_of(const Body& body) {
    const std::span<const Eigen::Vector3d> vertices = body.vertices();
    constexpr std::size_t size = VertexBlock::size;
    std::vector<VertexBlock> blocks((vertices.size() + size - 1) / size);
    for (std::size_t i = 0; i < size * blocks.size(); ++i) {
        const Eigen::Vector3d vertex = vertices[std::min(i, vertices.size() - 1)] - body.bvh().centre();
        VertexBlock& block = blocks[i / size];
        block.x[i % size] = float(vertex.x());
        block.y[i % size] = float(vertex.y());
        block.z[i % size] = float(vertex.z());
    }
    return blocks;
}

float reach_of(std::span<const VertexBlock> blocks, const Eigen::Vector3f& direction) {
    const WideDirection wide(direction);
    FourFloats first = -std::numeric_limits<float>::infinity() - FourFloats{}, second = first;
    for (const VertexBlock& block : blocks) {
        first = greater(wide.along(block, 0), first);
        second = greater(wide.along(block, 1), second);
    }
    const FourFloats four = greater(first, second);
    return std::max({four[0], four[1], four[2], four[3]});
}

Eigen::Vector3f vertex_at_reach(std::span<const VertexBlock> blocks, const Eigen::Vector3f& direction, float reach) {
    const WideDirection wide(direction);
    for (const VertexBlock& block : blocks) {
        const std::array<FourFloats, 2> along{wide.along(block, 0), wide.along(block, 1)};
        if (!has(greater(along[0], along[1]), reach))
            continue;
        for (std::size_t i = 0; i < VertexBlock::size; ++i)
            if (along[i / 4][i % 4] == reach)
                return {block.x[i], block.y[i], block.z[i]};
    }
    return Eigen::Vector3f::Zero();
}

} // namespace chasles
