// Reads occupancy maps of OctoMap: .bt (each cell occupied, free or unknown) and .ot (log odds of occupancy). The mesh
// is the cubes of the occupied leaves, each a closed surface. Where two cubes of one size share a face, both copies are
// left out. Unknown cells are free. Source: OctoMap 1.10, AbstractOcTree::write and
// OccupancyOcTreeBase::writeBinaryNode.
#include "chasles/base/invalid_input.h"
#include "chasles/base/sort.h"
#include "chasles/io/bytes.h"
#include "chasles/io/mesh_files.h"
#include "chasles/io/text_scan.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

namespace chasles::io {
namespace {

using CellCorner = std::array<std::uint32_t, 3>;

constexpr std::uint32_t cells_of_map = 1u << 16; ///< along an axis; the middle of the map is the origin

/// A node of the tree.
struct Cube {
    CellCorner lower{}; ///< in cells, from the lower corner of the map
    std::uint32_t side = cells_of_map;

    /// The children are numbered by x, then y, then z.
    [[nodiscard]] Cube child(unsigned number) const {
        Cube half{lower, side / 2};
        for (unsigned axis = 0; axis < 3; ++axis)
            half.lower[axis] += number >> axis & 1u ? half.side : 0;
        return half;
    }
};

/// A number for each place, and one for each cube if `side` is given.
std::uint64_t key_of(const CellCorner& corner, std::uint32_t side = 1) {
    constexpr unsigned bits = 17;
    const auto level = std::uint64_t(std::countr_zero(side));
    return corner[0] | std::uint64_t(corner[1]) << bits | std::uint64_t(corner[2]) << 2 * bits | level << 3 * bits;
}

struct MapHeader {
    bool is_binary = false;     ///< .bt
    std::string id;             ///< the kind of tree
    std::uint64_t nodes = 0;    ///< of the tree
    std::optional<double> cell; ///< the side of a cell, in metres
    std::size_t end = 0;        ///< bytes
};

MapHeader read_header(std::string_view bytes) {
    MapHeader header;
    Lines lines(bytes);
    lines.next();
    header.is_binary = lines.line().starts_with("# Octomap OcTree binary file");
    if (!header.is_binary && !lines.line().starts_with("# Octomap OcTree file"))
        throw InvalidInput("does not begin with \"# Octomap OcTree\"; write it again with OctoMap 1.4 or later");
    while (lines.next()) {
        Words words(lines.line());
        const std::string_view key = words.next(), value = words.next();
        if (key == "data") {
            header.end = std::min(lines.position(), bytes.size());
            return header;
        }
        if (key == "id")
            header.id = value;
        if (key == "size") {
            const auto number = parse_integer(value);
            if (!number || *number < 0)
                fail_at_line(lines.number(), "size needs a number of nodes: " + in_quotes(value));
            header.nodes = std::uint64_t(*number);
        }
        if (key == "res") {
            header.cell = parse_finite(value);
            if (!header.cell || *header.cell <= 0)
                fail_at_line(lines.number(), "res needs a positive length: " + in_quotes(value));
        }
    }
    throw InvalidInput("ends before the line \"data\"");
}

/// Bytes behind the log odds of a node.
std::size_t further_bytes(const std::string& id) {
    if (id == "OcTree" || id == "OcTreeStamped")
        return 0;
    if (id == "ColorOcTree")
        return 3;
    throw InvalidInput("trees of the kind " + in_quotes(id) + " are not read; OcTree and ColorOcTree are");
}

/// Reads the nodes depth first, and collects the occupied leaves.
class OccupiedLeaves {
public:
    OccupiedLeaves(std::string_view data, const MapHeader& header)
        : data_(data), header_(header), further_bytes_(further_bytes(header.id)) {
        if (header.nodes > 0)
            header.is_binary ? read_states(Cube{}) : read_log_odds(Cube{});
        if (nodes_ != header.nodes || !data_.empty())
            throw InvalidInput("has " + std::to_string(nodes_) + " nodes and " + std::to_string(data_.size()) +
                               " bytes behind them; its header says " + std::to_string(header.nodes) + " nodes");
    }
    [[nodiscard]] std::vector<Cube> take() { return std::move(leaves_); }

private:
    enum State : std::uint8_t { unknown, free, occupied, inner };

    /// An inner node of .bt: two bits for each child.
    void read_states(const Cube& cube) {
        ++nodes_;
        const auto states = next<std::uint16_t>();
        for (unsigned number = 0; number < 8; ++number) {
            const auto state = State(states >> 2 * number & 3u);
            if (state == inner)
                read_states(child(cube, number));
            else if (state == occupied)
                leaves_.push_back(child(cube, number));
            nodes_ += state == free || state == occupied;
        }
    }
    /// A node of .ot: its log odds, and a bit for each child that follows.
    void read_log_odds(const Cube& cube) {
        ++nodes_;
        const auto log_odds = next<float>();
        skip(further_bytes_);
        const auto children = next<std::uint8_t>();
        for (unsigned number = 0; number < 8; ++number)
            if (children >> number & 1u)
                read_log_odds(child(cube, number));
        if (children == 0 && log_odds >= 0)
            leaves_.push_back(cube);
    }
    [[nodiscard]] static Cube child(const Cube& cube, unsigned number) {
        if (cube.side == 1)
            throw InvalidInput("is deeper than 16 levels");
        return cube.child(number);
    }
    void skip(std::size_t bytes) {
        if (data_.size() < bytes)
            throw InvalidInput("ends after " + std::to_string(nodes_) + " of " + std::to_string(header_.nodes) +
                               " nodes");
        data_.remove_prefix(bytes);
    }
    template <typename Number>
    Number next() {
        const std::string_view here = data_;
        skip(sizeof(Number));
        return load<Number>(here, std::endian::little);
    }

    std::string_view data_;
    const MapHeader& header_;
    std::size_t further_bytes_;
    std::uint64_t nodes_ = 0;
    std::vector<Cube> leaves_;
};

/// Makes the surface of cubes.
class CubeSurface {
public:
    CubeSurface(const std::vector<Cube>& cubes, double cell) : cell_(cell) {
        for (const Cube& cube : cubes)
            cubes_.push_back(key_of(cube.lower, cube.side));
        chasles::sort(cubes_);
        for (const Cube& cube : cubes)
            for (unsigned axis = 0; axis < 3; ++axis)
                for (const bool is_upper : {false, true})
                    if (!has_neighbour(cube, axis, is_upper))
                        add_face(cube, axis, is_upper);
    }
    [[nodiscard]] PolygonSoup take() { return std::move(soup_); }

private:
    /// Whether another cube of this size has the same face.
    [[nodiscard]] bool has_neighbour(const Cube& cube, unsigned axis, bool is_upper) const {
        CellCorner lower = cube.lower;
        lower[axis] = is_upper ? lower[axis] + cube.side : lower[axis] - cube.side;
        return lower[axis] < cells_of_map && std::ranges::binary_search(cubes_, key_of(lower, cube.side));
    }
    /// Counterclockwise as seen from outside.
    void add_face(const Cube& cube, unsigned axis, bool is_upper) {
        std::vector<std::uint32_t> face;
        for (const auto& [u, v] : {std::pair(0u, 0u), std::pair(1u, 0u), std::pair(1u, 1u), std::pair(0u, 1u)}) {
            CellCorner corner = cube.lower;
            corner[axis] += is_upper ? cube.side : 0;
            corner[(axis + 1) % 3] += u * cube.side;
            corner[(axis + 2) % 3] += v * cube.side;
            face.push_back(vertex_at(corner));
        }
        if (!is_upper)
            std::ranges::reverse(face);
        soup_.faces.push_back(std::move(face));
    }
    std::uint32_t vertex_at(const CellCorner& corner) {
        const auto [place, is_new] = ids_.try_emplace(key_of(corner), std::uint32_t(soup_.vertices.size()));
        if (is_new) {
            Eigen::Vector3d& vertex = soup_.vertices.emplace_back();
            for (unsigned axis = 0; axis < 3; ++axis)
                vertex[axis] = (double(corner[axis]) - double(cells_of_map / 2)) * cell_;
        }
        return place->second;
    }

    double cell_;
    std::vector<std::uint64_t> cubes_; ///< sorted
    std::unordered_map<std::uint64_t, std::uint32_t> ids_;
    PolygonSoup soup_;
};

} // namespace

PolygonSoup read_octomap(std::string_view bytes) {
    const MapHeader header = read_header(bytes);
    if (!header.cell)
        throw InvalidInput("has no line \"res\" with the side of a cell");
    const std::vector<Cube> cubes = OccupiedLeaves(bytes.substr(header.end), header).take();
    if (cubes.empty())
        throw InvalidInput("has no occupied cell");
    return CubeSurface(cubes, *header.cell).take();
}

} // namespace chasles::io
