#include "chasles/mesh/volume.h"

#include "chasles/base/invalid_input.h"
#include "chasles/mesh/connected_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <string>

namespace chasles {

namespace {

constexpr std::uint32_t none = 0xffffffff;
/// Points of so many parts have one box.
constexpr std::size_t block_size = 32;

bool has_area(std::span<const std::uint32_t> outline) {
    return outline[1] != outline[2];
}

void require_closed(std::span<const UnpairedEdge> unpaired) {
    if (unpaired.empty())
        return;
    constexpr std::size_t most_named = 3;
    std::string named;
    for (const auto& [edge, surplus] : unpaired.first(std::min(most_named, unpaired.size())))
        named += (named.empty() ? "" : ", ") + std::to_string(edge.from) + "-" + std::to_string(edge.to);
    throw InvalidInput("mesh: solid: the surface is not closed, or its faces are not turned the same way: along " +
                       std::to_string(unpaired.size()) +
                       " edges, faces do not run equally often in both directions (vertices " + named +
                       (unpaired.size() > most_named ? ", ..." : "") + "); mend the mesh, or leave solid at automatic");
}

/// The boxes of points that follow each other.
std::vector<PartBlock> blocks_of(std::span<const std::uint32_t> points, std::span<const Eigen::Vector3d> vertices) {
    constexpr double outward = 1 + 0x1p-50;
    std::vector<PartBlock> blocks;
    for (std::size_t begin = 0; begin < points.size(); begin += block_size) {
        const std::size_t end = std::min(begin + block_size, points.size());
        Eigen::Vector3d lower = vertices[points[begin]], upper = lower;
        for (std::size_t i = begin; i < end; ++i) {
            lower = lower.cwiseMin(vertices[points[i]]);
            upper = upper.cwiseMax(vertices[points[i]]);
        }
        const Eigen::Vector3d centre = 0.5 * lower + 0.5 * upper;
        blocks.push_back(
            {std::uint32_t(begin), std::uint32_t(end), centre, (upper - centre).cwiseMax(centre - lower) * outward});
    }
    return blocks;
}

/// The vertices that stand for parts, each with what is known of its part.
class PartTable {
public:
    PartTable(const Surface& surface, const Seams& seams)
        : surface_(surface), parts_(parts_of_surface(
                                 surface.vertices.size(), surface.outlines.size(),
                                 [&](std::size_t face) { return surface.outlines[face]; }, seams.joined())),
          farthest_(surface.vertices.size(), none), is_solid_(surface.vertices.size(), 0) {
        for (std::size_t face = 0; face < surface.outlines.size(); ++face)
            add(surface.outlines[face]);
        for (const auto& [edge, surplus] : seams.unpaired())
            is_solid_[parts_.of(edge.from)] = 0;
    }

    [[nodiscard]] bool is_solid(std::span<const std::uint32_t> outline) {
        return is_solid_[parts_.of(outline[0])] != 0;
    }

    [[nodiscard]] Volume volume() const {
        Volume volume;
        for (std::size_t vertex = 0; vertex < farthest_.size(); ++vertex)
            if (farthest_[vertex] != none) {
                volume.part_points.push_back(farthest_[vertex]);
                volume.solid_parts += is_solid_[vertex] ? 1 : 0;
            }
        volume.blocks = blocks_of(volume.part_points, surface_.vertices);
        return volume;
    }

private:
    [[nodiscard]] double distance_of(std::uint32_t vertex) const {
        return (surface_.vertices[vertex] - surface_.middle).squaredNorm();
    }

    void add(std::span<const std::uint32_t> outline) {
        const std::uint32_t part = parts_.of(outline[0]);
        is_solid_[part] |= char(has_area(outline));
        for (const std::uint32_t vertex : outline)
            if (farthest_[part] == none || distance_of(vertex) > distance_of(farthest_[part]))
                farthest_[part] = vertex;
    }

    const Surface& surface_;
    ConnectedParts parts_;
    std::vector<std::uint32_t> farthest_; ///< for the vertex of a part; none for other vertices
    std::vector<char> is_solid_;          ///< likewise
};

} // namespace

std::size_t Volume::memory() const {
    return part_points.capacity() * sizeof(std::uint32_t) + blocks.capacity() * sizeof(PartBlock) +
           in_solid_part.capacity() + joined.capacity() * sizeof(Edge);
}

Volume find_volume(const Surface& surface, Solid solid) {
    const Seams seams(surface.vertices, surface.unpaired);
    if (solid == Solid::yes)
        require_closed(seams.unpaired());
    PartTable parts(surface, seams);
    Volume volume = parts.volume();
    volume.unpaired_edges = seams.unpaired().size();
    volume.joined = seams.joined();
    volume.seam = seams.width();
    if (solid == Solid::no)
        volume.solid_parts = 0;
    if (volume.is_solid() && volume.solid_parts < volume.part_points.size())
        for (std::size_t face = 0; face < surface.outlines.size(); ++face)
            volume.in_solid_part.push_back(char(parts.is_solid(surface.outlines[face])));
    volume.part_points.shrink_to_fit();
    volume.blocks.shrink_to_fit();
    return volume;
}

double signed_volume(const Surface& surface, const Volume& volume) {
    double sum = 0;
    for (std::size_t face = 0; volume.is_solid() && face < surface.outlines.size(); ++face) {
        const auto outline = surface.outlines[face];
        if (!volume.is_bounded_by(face))
            continue;
        const auto corner = [&](std::size_t i) -> Eigen::Vector3d {
            return surface.vertices[outline[i]] - surface.middle;
        };
        const Eigen::Vector3d first = corner(0);
        for (std::size_t i = 2; i < outline.size(); ++i)
            sum += first.dot(corner(i - 1).cross(corner(i)));
    }
    return sum / 6;
}

} // namespace chasles
