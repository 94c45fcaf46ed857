#include "chasles/mesh/seams.h"

#include <algorithm>
#include <utility>

namespace chasles {

namespace {

/// Of places, over the greatest coordinate of the rim.
constexpr double reach_of_seams = 0x1p-40;

std::vector<std::uint32_t> rim_of(std::span<const UnpairedEdge> unpaired) {
    std::vector<std::uint32_t> rim;
    for (const auto& [edge, surplus] : unpaired)
        rim.insert(rim.end(), {edge.from, edge.to});
    std::ranges::sort(rim);
    rim.erase(std::ranges::unique(rim).begin(), rim.end());
    return rim;
}

} // namespace

std::uint32_t place_in(std::span<const Edge> joined, std::uint32_t vertex) {
    const auto found = std::ranges::lower_bound(joined, vertex, {}, &Edge::from);
    return found != joined.end() && found->from == vertex ? found->to : vertex;
}

Seams::Seams(std::span<const Eigen::Vector3d> vertices, std::span<const UnpairedEdge> unpaired) : vertices_(vertices) {
    std::vector<std::uint32_t> rim = rim_of(unpaired);
    for (const std::uint32_t vertex : rim)
        reach_ = std::max(reach_, reach_of_seams * vertices_[vertex].lpNorm<Eigen::Infinity>());
    join(std::move(rim));
    for (const UnpairedEdge& edge : unpaired)
        add(edge);
    pair_up();
}

/// Each vertex joins the first one that is near. They are sorted along a direction in which few are near each other by
/// chance; those within the reach differ by less than twice as much along it.
void Seams::join(std::vector<std::uint32_t> rim) {
    const Eigen::Vector3d direction(0.5317, 0.7711, 0.3502);
    const auto height = [&](std::uint32_t vertex) { return direction.dot(vertices_[vertex]); };
    std::ranges::sort(rim, {}, height);
    std::vector<char> is_joined(rim.size(), 0);
    for (std::size_t i = 0; i < rim.size(); ++i)
        for (std::size_t j = i + 1; !is_joined[i] && j < rim.size() && height(rim[j]) - height(rim[i]) <= 2 * reach_;
             ++j)
            if (!is_joined[j] && (vertices_[rim[j]] - vertices_[rim[i]]).lpNorm<Eigen::Infinity>() <= reach_) {
                is_joined[j] = 1;
                joined_.push_back({rim[j], rim[i]});
            }
    std::ranges::sort(joined_, {}, &Edge::from);
}

void Seams::add(const UnpairedEdge& edge) {
    const std::uint32_t from = place_in(joined_, edge.edge.from), to = place_in(joined_, edge.edge.to);
    if (from < to)
        unpaired_.push_back({{from, to}, edge.surplus});
    else if (to < from)
        unpaired_.push_back({{to, from}, -edge.surplus});
}

/// Equal edges become one, and those without a surplus go.
void Seams::pair_up() {
    const auto ends = [](const UnpairedEdge& edge) { return std::pair(edge.edge.from, edge.edge.to); };
    std::ranges::sort(unpaired_, {}, ends);
    std::vector<UnpairedEdge> left;
    for (const UnpairedEdge& edge : unpaired_) {
        if (left.empty() || ends(left.back()) != ends(edge))
            left.push_back({edge.edge, 0});
        left.back().surplus += edge.surplus;
    }
    std::erase_if(left, [](const UnpairedEdge& edge) { return edge.surplus == 0; });
    unpaired_ = std::move(left);
}

} // namespace chasles
