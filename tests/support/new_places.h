// Detects new regions in which two bodies are within a distance. The definition is in docs/derivations/17-hold.md; the
// algorithm is independent of the library.
#pragma once

#include "chasles/query/first_contact.h"
#include "tests/support/triangle_tree.h"

#include <functional>

namespace chasles::test {

/// The part of a triangle in the cube of half side `radius`: empty or a convex polygon.
inline std::vector<LongPoint> clipped(const LongTriangle& triangle, const LongPoint& middle, long double radius) {
    std::vector<LongPoint> polygon(triangle.begin(), triangle.end());
    for (int side = 0; side < 6 && !polygon.empty(); ++side) {
        const auto depth = [&](const LongPoint& p) -> long double {
            const long double along = p[side / 2] - middle[side / 2];
            return radius - (side % 2 == 0 ? along : -along);
        };
        std::vector<LongPoint> rest;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const LongPoint& p = polygon[i];
            const LongPoint& q = polygon[(i + 1) % polygon.size()];
            const long double in = depth(p);
            const long double next = depth(q);
            if (in >= 0)
                rest.push_back(p);
            if ((in > 0 && next < 0) || (in < 0 && next > 0))
                rest.push_back(p + (q - p) * (in / (in - next)));
        }
        polygon = std::move(rest);
    }
    return polygon;
}

/// The part of a body in a cube, as triangles.
inline std::vector<LongTriangle> neighbourhood(const TriangleTree& body, const LongPose& pose, const LongPoint& middle,
                                               long double radius) {
    std::vector<LongTriangle> result;
    const MiddleBox cube{middle.cast<double>(), Eigen::Vector3d::Constant(double(radius))};
    std::vector<std::uint32_t> open{0};
    while (!open.empty()) {
        const TriangleTree::Node& node = body.nodes()[open.back()];
        open.pop_back();
        if (node.box.moved(pose).distance(cube) > double(radius))
            continue;
        if (node.child != 0) {
            open.insert(open.end(), {node.child, node.child + 1});
            continue;
        }
        for (std::uint32_t i = node.first; i < node.last; ++i) {
            const std::vector<LongPoint> part = clipped(pose(body.triangle(i)), middle, radius);
            for (std::size_t j = 1; j + 1 < part.size(); ++j)
                result.push_back({part[0], part[j], part[j + 1]});
        }
    }
    return result;
}

/// The distance of the surfaces near a contact: within `radius` of its points.
inline double distance_beside(const TreePair& bodies, const Pose& at, const Contact& contact, double radius) {
    const Eigen::Vector3d on_moving = contact.point + contact.gap * contact.normal;
    const auto moving = neighbourhood(bodies.moving(), LongPose(at), on_moving.cast<long double>(), radius);
    const auto fixed = neighbourhood(bodies.fixed(), LongPose(), contact.point.cast<long double>(), radius);
    long double least = std::numeric_limits<long double>::infinity();
    for (const LongTriangle& a : moving)
        for (const LongTriangle& b : fixed)
            least = std::min(least, squared_distance_of_triangles<long double>(a, b));
    return double(std::sqrt(least));
}

/// Searches for new regions within a distance. A region is a set of triangle pairs within the distance, connected
/// through common vertices. A region is new if none of its pairs, and no neighbour of its pairs, was within the
/// distance before. The search halves the time until a seemingly new region turns out to have grown from an earlier
/// one, or the interval is tiny. Two regions on the same two triangles count as one, so the search can only refute.
class NewPlaces {
public:
    /// `slack`: earlier regions may be farther apart by this amount.
    NewPlaces(const TreePair& bodies, double distance, double slack)
        : bodies_(bodies), distance_(distance), slack_(slack) {}

    /// The time of the first new region that the search finds between two times of a motion.
    [[nodiscard]] std::optional<double> first(const std::function<Pose(double)>& pose_at, double from, double to,
                                              int parts) {
        Pairs before = sorted(bodies_.within(pose_at(from), distance_ + slack_));
        if (before.size() > most_pairs)
            return std::nullopt;
        looks_left_ = most_looks;
        for (int i = 1; i <= parts; ++i) {
            const double time = from + (to - from) * i / parts;
            Pairs now = sorted(bodies_.within(pose_at(time), distance_));
            if (const auto found = between(pose_at, {from + (to - from) * (i - 1) / parts, time}, before, now))
                return found;
            before = sorted(bodies_.within(pose_at(time), distance_ + slack_));
        }
        return std::nullopt;
    }

private:
    using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
    static constexpr double next_to_no_time = 1e-9;
    static constexpr std::size_t most_pairs = 300; ///< with more pairs the search would take too long and gives up
    static constexpr int most_looks = 40;          ///< with more halvings the search gives up

    static Pairs sorted(const std::vector<TrianglePair>& pairs) {
        Pairs result;
        for (const TrianglePair& pair : pairs)
            result.emplace_back(pair.moving, pair.fixed);
        std::ranges::sort(result);
        return result;
    }

    [[nodiscard]] std::optional<double> between(const std::function<Pose(double)>& pose_at, const Bracket& time,
                                                const Pairs& before, const Pairs& now) {
        if (!has_new(before, now) || --looks_left_ < 0)
            return std::nullopt;
        if (time.upper - time.lower < next_to_no_time)
            return time.lower;
        const double middle = 0.5 * (time.lower + time.upper);
        const Pose there = pose_at(middle);
        if (const auto found = between(pose_at, {time.lower, middle}, before, sorted(bodies_.within(there, distance_))))
            return found;
        return between(pose_at, {middle, time.upper}, sorted(bodies_.within(there, distance_ + slack_)), now);
    }

    [[nodiscard]] static bool share_vertex(const TriangleTree& body, std::uint32_t i, std::uint32_t j) {
        return i == j || std::ranges::any_of(body.corners(i), [&](std::uint32_t vertex) {
                   return std::ranges::find(body.corners(j), vertex) != body.corners(j).end();
               });
    }

    /// Spreads from the earlier pairs to all connected pairs. Returns whether any pair is not reached.
    [[nodiscard]] bool has_new(const Pairs& before, const Pairs& now) const {
        Pairs left;
        Pairs reached;
        for (const auto& pair : now)
            (std::ranges::binary_search(before, pair) ? reached : left).push_back(pair);
        const auto are_adjacent = [&](const auto& a, const auto& b) {
            return share_vertex(bodies_.moving(), a.first, b.first) &&
                   share_vertex(bodies_.fixed(), a.second, b.second);
        };
        const auto spread_from = [&](const auto& pair) {
            const auto rest =
                std::ranges::partition(left, [&](const auto& other) { return !are_adjacent(pair, other); });
            reached.insert(reached.end(), rest.begin(), rest.end());
            left.erase(rest.begin(), rest.end());
        };
        for (const auto& pair : before)
            if (!left.empty())
                spread_from(pair);
        for (std::size_t i = 0; i < reached.size() && !left.empty(); ++i)
            spread_from(Pairs::value_type(reached[i]));
        return !left.empty();
    }

    const TreePair& bodies_;
    double distance_;
    double slack_;
    int looks_left_ = 0;
};

} // namespace chasles::test
