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
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

namespace chasles::io {
namespace {

using CellCorner = std::array<std::uint32_t, 3>;

constexpr std::uint32_t cells_of_map = 1u << 16; ///< along an axis; the middle of the map is the origin
constexpr std::size_t most_sides = 1u << 24;     ///< of all cubes (docs/files.md, "Limits")

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
    bool is_binary = false; ///< .bt
    std::string id;         ///< the kind of tree
    std::uint64_t nodes = 0;
    double cell = 0;     ///< its side, in metres
    std::size_t end = 0; ///< bytes
};

/// The three values that a header needs, each once.
class MapValues {
public:
    void add(std::string_view key, std::string_view value, std::size_t line) {
        if (key != "id" && key != "size" && key != "res")
            return;
        if (!values_.emplace(key, Value{std::string(value), line}).second)
            fail_at_line(line, "is a second line " + in_quotes(key));
    }
    void write_to(MapHeader& header) const {
        header.id = value("id").text;
        const auto& [size, size_line] = value("size");
        const auto nodes = parse_integer(size);
        if (!nodes || *nodes < 0)
            fail_at_line(size_line, "size needs a number of nodes: " + in_quotes(size));
        header.nodes = std::uint64_t(*nodes);
        const auto& [res, res_line] = value("res");
        header.cell = parse_finite(res).value_or(0);
        if (header.cell <= 0)
            fail_at_line(res_line, "res needs a positive length: " + in_quotes(res));
    }

private:
    struct Value {
        std::string text;
        std::size_t line;
    };
    [[nodiscard]] const Value& value(std::string_view key) const {
        const auto found = values_.find(key);
        if (found == values_.end())
            throw InvalidInput("has no line " + in_quotes(key) + " before the line 'data'");
        return found->second;
    }
    std::map<std::string, Value, std::less<>> values_;
};

MapHeader read_header(std::string_view bytes) {
    MapHeader header;
    Lines lines(bytes);
    lines.next();
    header.is_binary = lines.line().starts_with("# Octomap OcTree binary file");
    if (!header.is_binary && !lines.line().starts_with("# Octomap OcTree file"))
        throw InvalidInput("does not begin with \"# Octomap OcTree\"; write it again with OctoMap 1.4 or later");
    MapValues values;
    while (lines.next()) {
        Words words(lines.line());
        const std::string_view key = words.next(), value = words.next();
        values.add(key, value, lines.number());
        if (key == "data") {
            values.write_to(header);
            header.end = std::min(lines.position(), bytes.size());
            return header;
        }
    }
    throw InvalidInput("ends before the line 'data'");
}

/// Bytes behind the log odds of a node.
std::size_t further_bytes(const std::string& id) {
    if (id == "OcTree" || id == "OcTreeStamped")
        return 0;
    if (id == "ColorOcTree")
        return 3;
    throw InvalidInput("trees of the kind " + in_quotes(id) +
                       " are not read; OcTree, OcTreeStamped and ColorOcTree are");
}

/// Reads the nodes depth first, and collects the occupied leaves.
class OccupiedLeaves {
public:
    OccupiedLeaves(std::string_view data, const MapHeader& header)
        : data_(data), header_(header), further_bytes_(further_bytes(header.id)) {
        if (header.nodes > 0)
            header.is_binary ? read_states(Cube{}) : read_log_odds(Cube{});
        if (!data_.empty())
            throw InvalidInput("goes on behind its tree (bytes: " + std::to_string(data_.size()) + ")");
        if (nodes_ != header.nodes)
            throw InvalidInput("has a tree of another size (" + std::to_string(nodes_) + ") than its header says (" +
                               std::to_string(header.nodes) + ")");
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
        if (std::isnan(log_odds))
            throw InvalidInput("has log odds that are no number (node " + std::to_string(nodes_) + ")");
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
            throw InvalidInput("ends in the middle of its tree (node " + std::to_string(nodes_) + " of " +
                               std::to_string(header_.nodes) + ")");
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
                        add_side({&cube, axis, is_upper});
        soup_.faces.reserve(sides_.size());
        for (const Side& side : sides_)
            add_face(side);
    }
    [[nodiscard]] PolygonSoup take() { return std::move(soup_); }

private:
    struct Side {
        const Cube* cube;
        unsigned axis;
        bool is_upper;
    };

    /// Whether another cube of this size has the same face.
    [[nodiscard]] bool has_neighbour(const Cube& cube, unsigned axis, bool is_upper) const {
        CellCorner lower = cube.lower;
        lower[axis] = is_upper ? lower[axis] + cube.side : lower[axis] - cube.side;
        return lower[axis] < cells_of_map && std::ranges::binary_search(cubes_, key_of(lower, cube.side));
    }
    void add_side(const Side& side) {
        if (sides_.size() == most_sides)
            throw InvalidInput("has cubes with more than " + std::to_string(most_sides) +
                               " free sides; make a map of larger cells, or of a part");
        sides_.push_back(side);
    }
    /// Counterclockwise as seen from outside.
    void add_face(const Side& side) {
        const auto& [of, axis, is_upper] = side;
        const Cube& cube = *of;
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
                vertex[axis] = (double(corner[axis]) - 0.5 * cells_of_map) * cell_;
        }
        return place->second;
    }

    double cell_;
    std::vector<std::uint64_t> cubes_; ///< sorted
    std::vector<Side> sides_;          ///< that no other cube covers
    std::unordered_map<std::uint64_t, std::uint32_t> ids_;
    PolygonSoup soup_;
};

} // namespace

PolygonSoup read_octomap(std::string_view bytes) {
    const MapHeader header = read_header(bytes);
    const std::vector<Cube> cubes = OccupiedLeaves(bytes.substr(header.end), header).take();
    if (cubes.empty())
        throw InvalidInput("has no occupied cell");
    return CubeSurface(cubes, header.cell).take();
}

} // namespace chasles::io
