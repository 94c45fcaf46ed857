#include "chasles/search/neighbour_list.h"

#include "chasles/base/sort.h"

#include <algorithm>
#include <limits>

namespace chasles::search {

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

/// The limit of a pair of which nothing is known.
constexpr double unknown = -std::numeric_limits<double>::infinity();

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

/// Points of single precision, which suffices to foretell how a face moves.
std::array<float, 3> rounded(const Vector3<double>& point) {
    return {float(point.x), float(point.y), float(point.z)};
}
Vector3<double> in_double(const std::array<float, 3>& point) {
    return {double(point[0]), double(point[1]), double(point[2])};
}

} // namespace

/// How points move from the start of a way to its end: y -> turn y + shift.
struct NeighbourList::Displacements {
    algebra::Matrix3<double> turned_back; ///< the turn, transposed
    Vector3<double> shift;

    explicit Displacements(const culling::IntervalEnds& ends) : shift(ends.end.translation - ends.start.translation) {
        algebra::Matrix3<double> turn;
        for (int i = 0; i < 3; ++i)
            turn.row[i] = ends.end.rotation.row[i] - ends.start.rotation.row[i];
        turned_back = turn.transposed();
    }

    /// How far each point of a ball moves along a unit vector, or farther.
    [[nodiscard]] double least_along(const Vector3<double>& unit, const Vector3<double>& middle, double radius) const {
        const Vector3<double> rate = turned_back * unit;
        return dot(rate, middle) + dot(unit, shift) - length(rate) * radius;
    }
};

NeighbourList::NeighbourList(const Body& moving, const Body& fixed)
    : moving_(moving), fixed_(fixed), separation_(moving, fixed), travel_(moving), front_(moving, fixed),
      longest_way_(way_of_edges * std::max(mean_edge(moving), mean_edge(fixed))) {}

std::optional<std::span<const NeighbourList::Near>> NeighbourList::within(const PieceContext& context, double margin,
                                                                          Work& work) {
    if (context.is_enclosed())
        return std::nullopt;
    const culling::TimeInterval whole = context.interval(margin, {});
    const Way way = way_of(context, whole, margin);
    arrive(travel_.go_to(way));
    if (way.travel > longest_way_ || pause_-- > 0)
        return std::nullopt;
    pause_ = 0;
    if (is_outdated())
        restart();
    last_use_ = travel_.sum();
    widest_margin_ = std::max(widest_margin_, margin);
    const double bound = widest_margin_ + way.travel + with_rounding(travel_.sum());
    faces_.clear();
    front_.split({whole.boxes, margin, bound, travel_.sum(), most_pairs - std::min(most_pairs, pairs_.size())}, faces_,
                 work);
    add(faces_);
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

/// The limits of what was tested for the last way are better known by where the body came to on it.
void NeighbourList::arrive(const Arrival& arrival) {
    front_.arrive(arrival);
    for (const auto& [index, gaps] : tested_)
        limits_.raise(index, gaps.start + arrival.share * (gaps.end - gaps.start) - arrival.beside + arrival.travelled);
    tested_.clear();
}

bool NeighbourList::is_outdated() const {
    return size() == 0 || travel_.sum() - last_use_ > longest_way_ ||
           size() > most_growth * size_at_start_ + free_growth;
}

void NeighbourList::restart() {
    travel_.restart();
    front_.restart();
    pairs_.clear();
    limits_.clear();
    tested_.clear();
    size_at_start_ = 0;
    widest_margin_ = 0;
}

void NeighbourList::add(const std::vector<TwoFaces>& faces) {
    for (const TwoFaces& two : faces) {
        Neighbours pair{two};
        const auto corners = moving_.face(two.moving);
        pair.middle = rounded(culling::point_of<double>(moving_, corners[0]));
        for (const std::uint32_t corner : corners)
            pair.radius =
                std::max(pair.radius, length(culling::point_of<double>(moving_, corner) - in_double(pair.middle)));
        pairs_.push_back(pair);
        limits_.push_back(unknown);
    }
}

/// Tests the pairs with limits up to the bound.
void NeighbourList::find_near(const Way& way, double bound) {
    near_.clear();
    separation_.use(way.ends);
    placed_starts_.clear();
    const Displacements displacements(way.ends);
    const double uncertain = way.deviation + 2 * way.rounding;
    for (const auto& [index, limit] : limits_.take_up_to(bound)) {
        const Neighbours& pair = pairs_[index];
        if (limit > unknown) {
            const double start = limit - with_rounding(travel_.sum());
            const Gaps gaps{start, start + displacements.least_along(pair.normal, in_double(pair.middle), pair.radius)};
            if (gaps.least() > way.margin + uncertain) {
                limits_.set(index, limit);
                tested_.push_back({index, gaps});
                continue;
            }
        }
        if (const double least = least_on_way(index, way); !(least > way.margin))
            near_.push_back({pair.faces, least});
    }
    chasles::sort(near_, {}, [](const Near& near) { return std::pair(near.faces.moving, near.faces.fixed); });
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
        placed_ends_.push_back(way.ends.end(point));
    }
}

/// By the half space that is known or, if it does not tell, by a new one. Sets the limit.
double NeighbourList::least_on_way(std::size_t index, const Way& way) {
    Neighbours& pair = pairs_[index];
    const double uncertain = way.deviation + 2 * way.rounding;
    place_corners(pair.faces.moving, way);
    const bool has_gap = gaps_of(pair).least() > way.margin + uncertain || has_widest_gap(pair) ||
                         finds_direction(pair, way.margin + uncertain);
    const Gaps gaps = gaps_of(pair);
    limits_.set(index, gaps.start + travel_.sum());
    tested_.push_back({index, gaps});
    return has_gap ? gaps.least() - uncertain : 0;
}

/// Whether the gap is still about the one that was the widest. Then nothing new is tried.
bool NeighbourList::has_widest_gap(const Neighbours& pair) const {
    return std::abs(gaps_of(pair).least() - pair.widest) < 0.25 * pair.widest;
}

/// A half space for a pair whose moving face is placed. Most pairs that are new are far enough apart for a short
/// search. A pair that was farther apart than the distance along features of both faces often still is.
bool NeighbourList::finds_direction(Neighbours& pair, double distance) {
    const auto& [moving, fixed] = pair.faces;
    if (!pair.is_known()) {
        const auto direction = separation_.beyond(moving, fixed, 0.5, {distance, distance});
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
    pair.normal = direction.along;
    pair.axis = direction.axis;
    pair.offset = unknown;
    for (const std::uint32_t corner : fixed_.face(pair.faces.fixed))
        pair.offset = std::max(pair.offset, dot(pair.normal, culling::point_of<double>(fixed_, corner)));
    pair.widest = gaps_of(pair).least();
    return pair.widest;
}

/// Of a pair whose moving face is placed.
NeighbourList::Gaps NeighbourList::gaps_of(const Neighbours& pair) const {
    const auto least = [&](const std::vector<Vector3<double>>& corners) {
        double height = std::numeric_limits<double>::infinity();
        for (const Vector3<double>& corner : corners)
            height = std::min(height, dot(pair.normal, corner));
        return height - pair.offset;
    };
    return {least(placed_starts_), least(placed_ends_)};
}

} // namespace chasles::search
