// One pass with a hash table with open addressing: expected linear time and no allocation per vertex.
// Vertices are compared exactly.
#include "chasles/mesh/merge_vertices.h"

#include <bit>

namespace chasles {
namespace {

/// Marks an empty slot of the table.
constexpr std::uint32_t no_vertex = 0xffffffff;

/// Equal coordinates have equal bits.
std::uint64_t bits_of(double coordinate) {
    return std::bit_cast<std::uint64_t>(coordinate + 0.0); // turns -0 into 0
}

/// The finalizer of splitmix64. It distributes coordinates on a grid evenly over the table.
std::uint64_t mixed(std::uint64_t value) {
    value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9;
    value = (value ^ (value >> 27)) * 0x94d049bb133111eb;
    return value ^ (value >> 31);
}

/// A hash of the three coordinates; the order of the coordinates matters.
std::uint64_t hash(const Eigen::Vector3d& point) {
    return mixed(mixed(mixed(bits_of(point.x())) + bits_of(point.y())) + bits_of(point.z()));
}

} // namespace

std::vector<std::uint32_t> first_equal_vertices(std::span<const Eigen::Vector3d> vertices) {
    std::vector<std::uint32_t> table(std::bit_ceil(2 * vertices.size() + 1), no_vertex);
    const std::size_t mask = table.size() - 1;
    std::vector<std::uint32_t> first(vertices.size());
    for (std::uint32_t vertex = 0; vertex < vertices.size(); ++vertex) {
        std::size_t slot = hash(vertices[vertex]) & mask;
        while (table[slot] != no_vertex && vertices[table[slot]] != vertices[vertex])
            slot = (slot + 1) & mask;
        if (table[slot] == no_vertex)
            table[slot] = vertex;
        first[vertex] = table[slot];
    }
    return first;
}

} // namespace chasles
