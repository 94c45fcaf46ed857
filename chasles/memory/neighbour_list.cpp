#include "chasles/memory/neighbour_list.h"

#include "chasles/base/sort.h"
#include "chasles/search/piece_context.h"

#include <algorithm>
#include <limits>

namespace chasles::memory {

namespace {

using algebra::Vector3;
using culling::FaceSeparation;

// Measured with drag_bench.
constexpr std::size_t most_pairs = 1 << 20;
constexpr double way_of_edges = 0.8; ///< the longest way that a list serves: of the mean edge of the body with the
                                     ///< longer edges
/// A list that has become this many times as long begins anew: much of it was near once, and is not any more.
constexpr std::size_t most_growth = 2;
constexpr std::size_t free_growth = 1000; ///< pairs

/// Too much is near.
constexpr int questions_to_pause = 64;

double mean_edge(const Body& body) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t face = 0; face < body.face_count(); ++face)
        for (const Edge& edge : body.owned_edges(face)) {
            sum += (body.vertices()[edge.from] - body.vertices()[edge.to]).norm();
            ++count;
        }
    return count > 0 ? sum / double(count) : 0;
}

Vector3<double> in_double(const Vector3<float>& vector) {
    return {double(vector.x), double(vector.y), double(vector.z)};
}

/// A unit vector in single precision, shortened so that rounding makes it no longer than 1.
Vector3<float> shortened(const Vector3<double>& unit) {
    constexpr double length_of_normals = 1 - 0x1p-22;
    const Vector3<double> normal = scale(unit, length_of_normals);
    return {float(normal.x), float(normal.y), float(normal.z)};
}

} // namespace

NeighbourList::NeighbourList(const Body& moving, const Body& fixed)
    : moving_(moving), fixed_(fixed), separation_(moving, fixed), travel_(moving), front_(moving, fixed),
      apart_(moving), longest_way_(way_of_edges * std::max(mean_edge(moving), mean_edge(fixed))) {}

std::optional<std::span<const culling::NodePair>>
NeighbourList::pairs_worth_testing(const search::PieceContext& context, double margin,
                                   const culling::TimeRange& /*range*/, Work& work) {
    if (margin <= 0 || context.is_enclosed())
        return std::nullopt;
    const culling::TimeInterval whole = context.interval(margin, {});
    const Way way = way_of(context, whole, margin);
    const Arrival arrival = travel_.go_to(way);
    front_.arrive(arrival);
    apart_.arrive(arrival);
    if (way.travel > longest_way_ || pause_-- > 0)
        return std::nullopt;
    pause_ = 0;
    if (is_outdated())
        restart();
    last_use_ = travel_.sum();
    widest_margin_ = std::max(widest_margin_, margin);
    const double bound = widest_margin_ + way.travel + with_rounding(travel_.sum());
    leaves_.clear();
    front_.split({whole.boxes, way, bound, most_pairs - std::min(most_pairs, pairs_.size())}, leaves_, work);
    add_new();
    if (size() > most_pairs) {
        restart();
        pause_ = questions_to_pause;
        return std::nullopt;
    }
    if (size_at_start_ == 0)
        size_at_start_ = size();
    find_near(way, bound);
    return near_;
}

bool NeighbourList::is_outdated() const {
    return size() == 0 || travel_.sum() - last_use_ > longest_way_ ||
           size() > most_growth * size_at_start_ + free_growth;
}

void NeighbourList::restart() {
    travel_.restart();
    front_.restart();
    pairs_.clear();
    apart_.clear();
    size_at_start_ = 0;
    widest_margin_ = 0;
}

void NeighbourList::add_new() {
    for (const NodeFront::PairOfNodes& leaves : leaves_) {
        const BvhNode& moving = moving_.bvh().nodes()[leaves.moving];
        if (pairs_.size() % Separations::block_size == 0)
            apart_.append_block();
        apart_.put(pairs_.size(), moving);
        pairs_.push_back({leaves, {moving.first, fixed_.bvh().nodes()[leaves.fixed].first}});
    }
}

/// Tests the pairs that are due.
void NeighbourList::find_near(const Way& way, double bound) {
    near_.clear();
    separation_.use(way.ends);
    placed_starts_.clear();
    for (const std::size_t index : apart_.due(way, bound))
        if (!stays_apart(index, way))
            near_.push_back({pairs_[index].leaves.moving, pairs_[index].leaves.fixed, {}});
    chasles::sort(near_, {}, [](const culling::NodePair& near) { return std::pair(near.moving, near.fixed); });
}

/// Consecutive pairs often share the moving face.
void NeighbourList::place_corners(std::uint32_t face, const Way& way) {
    if (!placed_starts_.empty() && placed_face_ == face)
        return;
    placed_face_ = face;
    placed_starts_.clear();
    placed_ends_.clear();
    for (const std::uint32_t corner : moving_.face(face)) {
        const Vector3<double> point = culling::point_of<double>(moving_, corner);
        placed_starts_.push_back(way.ends.start(point));
        if (!way.rests())
            placed_ends_.push_back(way.ends.end(point));
    }
}

/// By the half space that is known or, if it does not tell, by a new one. Sets the limit. If the gap is still about the
/// one that was the widest, nothing new is tried.
bool NeighbourList::stays_apart(std::size_t index, const Way& way) {
    Neighbours& pair = pairs_[index];
    place_corners(pair.faces.moving, way);
    Gaps gaps = gaps_of(pair);
    bool has_gap = pair.is_known() &&
                   (gaps.least() > way.least_gap() || std::abs(gaps.least() - pair.widest) < 0.25 * pair.widest);
    if (!has_gap) {
        has_gap = finds_direction(pair, way.least_gap());
        gaps = gaps_of(pair);
    }
    apart_.put_apart(index, pair.normal, gaps.start);
    return has_gap && gaps.least() > way.least_gap();
}

/// A half space for a pair whose moving face is placed. Most pairs that are new are far enough apart for a short
/// search. A pair that was farther apart than the distance along features of both faces often still is.
bool NeighbourList::finds_direction(Neighbours& pair, double distance) {
    const auto& [moving, fixed] = pair.faces;
    if (!pair.is_known()) {
        const auto direction = separation_.beyond(moving, fixed, 0.5, distance);
        if (direction && set_direction(pair, {*direction, FaceSeparation::no_axis}) > distance) {
            pair.widest = 0;
            return true;
        }
    }
    if (pair.axis != FaceSeparation::no_axis)
        if (const auto direction = separation_.along(pair.axis, moving, fixed, 0.5))
            if (set_direction(pair, {*direction, pair.axis}) > distance)
                return true;
    const auto direction = separation_.widest(moving, fixed, 0.5);
    if (direction)
        set_direction(pair, *direction);
    return direction.has_value();
}

/// Returns the gap on the way.
double NeighbourList::set_direction(Neighbours& pair, const FaceSeparation::Direction& direction) const {
    pair.normal = shortened(direction.along);
    pair.axis = direction.axis;
    const Vector3<double> normal = in_double(pair.normal);
    pair.offset = -std::numeric_limits<double>::infinity();
    for (const std::uint32_t corner : fixed_.face(pair.faces.fixed))
        pair.offset = std::max(pair.offset, dot(normal, culling::point_of<double>(fixed_, corner)));
    pair.widest = gaps_of(pair).least();
    return pair.widest;
}

/// Of a pair whose moving face is placed.
NeighbourList::Gaps NeighbourList::gaps_of(const Neighbours& pair) const {
    const auto least = [&, normal = in_double(pair.normal)](const std::vector<Vector3<double>>& corners) {
        double height = std::numeric_limits<double>::infinity();
        for (const Vector3<double>& corner : corners)
            height = std::min(height, dot(normal, corner));
        return height - pair.offset;
    };
    const double start = least(placed_starts_);
    return {start, placed_ends_.empty() ? start : least(placed_ends_)};
}

} // namespace chasles::memory
