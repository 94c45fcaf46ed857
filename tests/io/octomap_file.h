// Occupancy maps as OctoMap writes them, from cells.
#pragma once

#include "tests/io/file_bytes.h"

#include <array>
#include <cstdint>
#include <fmt/format.h>
#include <set>
#include <string>

namespace chasles::tests {

using OctomapCell = std::array<int, 3>; ///< the cell from this corner to the next one; the origin is a corner

/// Writes a tree of 16 levels; eight occupied children become one leaf where it is pruned.
class OctomapWriter {
public:
    OctomapWriter(std::set<OctomapCell> cells, bool is_pruned) : cells_(std::move(cells)), is_pruned_(is_pruned) {}

    /// Two bits for each child: unknown, free, occupied, inner.
    std::string bt(double cell) {
        bytes_.clear();
        nodes_ = 1;
        write_states(whole());
        return header("OcTree binary file", "OcTree", cell) + bytes_;
    }
    /// Log odds, `further` bytes, and a bit for each child that follows. Each unknown leaf below an inner node is free
    /// here.
    std::string ot(double cell, const std::string& id = "OcTree", std::size_t further = 0) {
        bytes_.clear();
        nodes_ = 0;
        write_log_odds(whole(), further);
        return header("OcTree file", id, cell) + bytes_;
    }

private:
    struct Node {
        OctomapCell lower;
        int side;
    };

    static Node whole() { return {{-32768, -32768, -32768}, 65536}; }
    static Node child(const Node& node, unsigned number) {
        Node half{node.lower, node.side / 2};
        half.lower[0] += number % 2 * half.side;
        half.lower[1] += number / 2 % 2 * half.side;
        half.lower[2] += number / 4 * half.side;
        return half;
    }
    [[nodiscard]] std::string header(const std::string& kind, const std::string& id, double cell) const {
        return fmt::format("# Octomap {}\n# (a comment)\n#\nid {}\nsize {}\nres {}\ndata\n", kind, id, nodes_, cell);
    }
    [[nodiscard]] std::int64_t cells_in(const Node& node) const {
        std::int64_t count = 0;
        for (const OctomapCell& cell : cells_) {
            bool is_inside = true;
            for (std::size_t axis = 0; axis < 3; ++axis)
                is_inside &= cell[axis] >= node.lower[axis] && cell[axis] < node.lower[axis] + node.side;
            count += is_inside;
        }
        return count;
    }
    [[nodiscard]] bool is_leaf(const Node& node) const {
        const std::int64_t side = node.side;
        return side == 1 || (is_pruned_ && side < 64 && cells_in(node) == side * side * side);
    }
    void write_states(const Node& node) {
        std::uint16_t states = 0;
        for (unsigned number = 0; number < 8; ++number) {
            const Node half = child(node, number);
            if (cells_in(half) == 0)
                continue;
            ++nodes_;
            states = std::uint16_t(states | (is_leaf(half) ? 2u : 3u) << 2 * number);
        }
        bytes_ += bytes_of(states);
        for (unsigned number = 0; number < 8; ++number)
            if (const Node half = child(node, number); cells_in(half) > 0 && !is_leaf(half))
                write_states(half);
    }
    void write_log_odds(const Node& node, std::size_t further) {
        ++nodes_;
        const bool is_occupied = cells_in(node) > 0;
        bytes_ += bytes_of(is_occupied ? 0.85f : -0.4f) + std::string(further, 'c');
        const bool has_children = is_occupied && !is_leaf(node);
        bytes_ += char(has_children ? 0xff : 0);
        for (unsigned number = 0; has_children && number < 8; ++number)
            write_log_odds(child(node, number), further);
    }

    std::set<OctomapCell> cells_;
    bool is_pruned_;
    std::int64_t nodes_ = 0;
    std::string bytes_;
};

} // namespace chasles::tests
