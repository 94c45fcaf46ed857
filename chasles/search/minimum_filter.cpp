#include "chasles/search/minimum_filter.h"

#include "chasles/mesh/feature_ways.h"

#include <algorithm>

namespace chasles::search {

bool MinimumFilter::set(const TwoFaces& faces) {
    place(faces);
    find_rejected(moving_, faces.moving, moving_side_);
    find_rejected(fixed_, faces.fixed, fixed_side_);
    return moving_side_.vertices > 0 || fixed_side_.vertices > 0 || (moving_side_.edges > 0 && fixed_side_.edges > 0);
}

void MinimumFilter::place(const TwoFaces& faces) {
    const auto poses = std::span(poses_).first(is_at_rest_ ? 1 : 2);
    fixed_side_.others.clear();
    for_four_corners(moving_, faces.moving, [&](const FourPoints& corners) {
        for (const motion::MatrixPose& pose : poses)
            fixed_side_.others.push_back(corners.moved(pose));
    });
    moving_side_.others.clear();
    for_four_corners(fixed_, faces.fixed, [&](const FourPoints& corners) {
        for (const motion::MatrixPose& pose : poses)
            moving_side_.others.push_back(corners.moved_back(pose));
    });
}

void MinimumFilter::find_rejected(const Body& body, std::uint32_t face, Side& side) const {
    const FeatureWays& ways = body.feature_ways();
    side.rejected.clear();
    side.vertices = side.edges = 0;
    const auto take = [&](const Feature& feature, std::span<const Eigen::Vector3d> ways_of, std::size_t& kept) {
        if (are_beside(side, ways_of, body.vertices()[feature.first], body.vertices()[feature.second]))
            side.rejected.push_back(feature);
        else
            ++kept;
    };
    std::uint32_t number = ways.first_vertex[face];
    for (const std::uint32_t vertex : body.owned_vertices(face))
        take({vertex, vertex}, ways.of_vertex[number++], side.vertices);
    number = ways.first_edge[face];
    for (const Edge& edge : body.owned_edges(face))
        take({edge.from, edge.to}, ways.of_edge[number++], side.edges);
}

bool MinimumFilter::are_beside(const Side& side, std::span<const Eigen::Vector3d> ways, const Eigen::Vector3d& from,
                               const Eigen::Vector3d& to) const {
    return std::ranges::any_of(ways, [&](const Eigen::Vector3d& way) {
        const double least = std::max(way.dot(from), way.dot(to)) + tolerance_;
        return std::ranges::all_of(side.others,
                                   [&](const FourPoints& points) { return points.are_beyond(least, way); });
    });
}

} // namespace chasles::search
