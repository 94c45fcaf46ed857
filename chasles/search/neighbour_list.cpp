#include "chasles/search/neighbour_list.h"

#include <boost/sort/spreadsort/integer_sort.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace chasles::search {

namespace {

using algebra::Vector3;
using culling::MatrixPose;

// Measured with drag_bench.
constexpr std::size_t most_pairs = 1 << 20;
constexpr double travels_ahead = 32;  ///< pieces of the usual length that a list serves
constexpr double skin_of_edges = 0.2; ///< the longest skin: of the mean edge of the body with the longer edges

/// Too much is near even without a skin.
constexpr int questions_to_pause = 64;

/// For sums of positions, of which each is off by a bound of coefficients: a matrix has nine (note 31).
constexpr double roundings = 16;

/// By which pairs are ordered: first the moving face, then the fixed one.
std::uint64_t key_of(const TwoFaces& faces) {
    return std::uint64_t(faces.moving) << 32 | faces.fixed;
}

TwoFaces faces_of(std::uint64_t key) {
    return {std::uint32_t(key >> 32), std::uint32_t(key)};
}

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

/// Collects the leaves of a traversal.
class Collector {
public:
    // The functions that a traversal requires of its leaves.
    [[nodiscard]] static double best() { return 1; }
    [[nodiscard]] bool is_over() const { return found_.size() > most_pairs; }
    [[nodiscard]] static bool is_kept_apart(const culling::NodePair&, double) { return false; }
    void test(const culling::FacePair& pair) { found_.push_back(key_of({pair.moving, pair.fixed})); }

    [[nodiscard]] std::vector<std::uint64_t>& found() { return found_; }

private:
    std::vector<std::uint64_t> found_;
};

} // namespace

NeighbourList::NeighbourList(const Body& moving, const Body& fixed)
    : moving_(moving), fixed_(fixed), separation_(moving, fixed),
      longest_skin_(skin_of_edges * std::max(mean_edge(moving), mean_edge(fixed))) {}

std::optional<std::span<const NeighbourList::Near>> NeighbourList::within(const PieceContext& context, double margin,
                                                                          Work& work) {
    if (context.is_enclosed())
        return std::nullopt;
    const Way way = way_of(context, margin);
    if (!reaches(context, way, work))
        return std::nullopt;
    if (tests_ > 2 * pairs_.size())
        measure_gaps(way.ends.start);
    separation_.use(way.ends);
    placed_.clear();
    near_.clear();
    const double travelled = travel(gap_place_, way);
    for (std::size_t i = 0; i < pairs_.size(); ++i)
        if (!(gaps_[i] > margin + travelled))
            if (const double least = least_on_way(i, way); !(least > margin))
                near_.push_back({pairs_[i].faces, std::max(least, gaps_[i] - travelled)});
    return near_;
}

NeighbourList::Way NeighbourList::way_of(const PieceContext& context, double margin) const {
    const culling::PieceParts parts = context.parts(margin);
    const culling::TimeInterval interval = context.time_tree(margin, parts).interval({});
    return {culling::IntervalEnds(context.maps()), margin, interval.deviation,
            elementary::with_underflow<double>(roundings * elementary::position_error<double>(parts.scale()))};
}

/// How far points of the moving body that come within the margin on their way are then from their places in `from`.
double NeighbourList::travel(const MatrixPose& from, const Way& way) const {
    return std::max(distance(from, way.ends.start), distance(from, way.ends.end)) + way.deviation + 2 * way.rounding;
}

/// A bound for the distance of the two places of any point of the moving body. The spectral norm of the difference of
/// two rotations is its Frobenius norm over the square root of two.
double NeighbourList::distance(const MatrixPose& from, const MatrixPose& to) const {
    return motion::distance(from, to, motion::vector_in<double>(moving_.bvh().centre()), moving_.bvh().radius());
}

/// Whether all that may come within the margin on this way is listed. Makes a new list if that pays.
bool NeighbourList::reaches(const PieceContext& context, const Way& way, Work& work) {
    const double own = travel(way.ends.start, way);
    const bool moves = own > 4 * way.rounding;
    if (moves)
        usual_travel_ += (std::min(own, 2 * usual_travel_ + way.margin) - usual_travel_) / 4;
    if (way.margin + travel(place_, way) <= reach_)
        return true;
    if (std::max(2 * own, usual_travel_) > longest_skin_ || pause_-- > 0)
        return false;
    pause_ = 0;
    place_ = way.ends.start;
    if (make(context, way.margin + std::clamp(travels_ahead * usual_travel_, 2 * own, longest_skin_), work))
        return true;
    longest_skin_ /= 2;
    if (make(context, way.margin + 2 * own, work))
        return true;
    pause_ = questions_to_pause;
    return false;
}

/// Lists the pairs within `reach` at the start of the piece. False if there are too many; then there is no list.
bool NeighbourList::make(const PieceContext& context, double reach, Work& work) {
    const culling::TimeTree times = context.time_tree(reach, context.parts(reach));
    Collector leaves;
    culling::BvhTraversal traversal(moving_.bvh(), fixed_.bvh(), times, reach, false, leaves);
    work.node_pairs += traversal.run({0, 0});
    reach_ = leaves.is_over() ? 0 : reach;
    if (leaves.is_over())
        leaves.found().clear();
    boost::sort::spreadsort::integer_sort(leaves.found().begin(), leaves.found().end());
    take(leaves.found());
    return reach_ > 0;
}

/// Pairs that were listed before keep their normals.
void NeighbourList::take(const std::vector<std::uint64_t>& found) {
    std::vector<Neighbours> pairs;
    pairs.reserve(found.size());
    auto before = pairs_.begin();
    for (const std::uint64_t key : found) {
        while (before != pairs_.end() && key_of(before->faces) < key)
            ++before;
        const bool is_known = before != pairs_.end() && key_of(before->faces) == key;
        pairs.push_back(is_known ? *before : Neighbours{faces_of(key)});
    }
    pairs_ = std::move(pairs);
    measure_gaps(place_);
}

void NeighbourList::measure_gaps(const MatrixPose& place) {
    gap_place_ = place;
    tests_ = 0;
    gaps_.clear();
    for (const Neighbours& pair : pairs_)
        gaps_.push_back(gap(pair, place));
}

double NeighbourList::gap(const Neighbours& pair, const MatrixPose& pose) const {
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t corner : moving_.face(pair.faces.moving))
        least = std::min(least, dot(pair.normal, pose(culling::point_of<double>(moving_, corner))));
    return least - pair.offset;
}

/// Pairs are ascending, so consecutive ones often share the moving face.
void NeighbourList::place_corners(std::uint32_t face, const Way& way) {
    if (!placed_.empty() && placed_face_ == face)
        return;
    placed_face_ = face;
    placed_.clear();
    for (const std::uint32_t corner : moving_.face(face)) {
        const Vector3<double> point = culling::point_of<double>(moving_, corner);
        placed_.push_back(way.ends.start(point));
        placed_.push_back(way.ends.end(point));
    }
}

/// By the half space that is known or, if it does not tell, by a new one. Without a new one if the gap is still about
/// the widest.
double NeighbourList::least_on_way(std::size_t index, const Way& way) {
    ++tests_;
    Neighbours& pair = pairs_[index];
    const double uncertain = way.deviation + 2 * way.rounding;
    place_corners(pair.faces.moving, way);
    const double known = gap_on_way(pair);
    if (known > way.margin + uncertain || std::abs(known - pair.widest) < 0.25 * pair.widest)
        return known - uncertain;
    const bool is_first = pair.offset == 0 && pair.widest == 0;
    if (is_first && is_beyond(index, way.margin + uncertain))
        return gap_on_way(pair) - uncertain;
    const auto direction = separation_.widest(pair.faces.moving, pair.faces.fixed, 0.5);
    if (direction)
        take_direction(index, *direction);
    return direction ? pair.widest - uncertain : 0;
}

/// By a short search for a half space. Most pairs of a new list are far enough apart for it. A longer search follows
/// where the half space does not tell any more.
bool NeighbourList::is_beyond(std::size_t index, double distance) {
    Neighbours& pair = pairs_[index];
    const auto direction = separation_.beyond(pair.faces.moving, pair.faces.fixed, 0.5, {distance, distance});
    if (!direction)
        return false;
    take_direction(index, *direction);
    return std::exchange(pair.widest, 0) > distance;
}

/// A half space for a pair whose moving face is placed.
void NeighbourList::take_direction(std::size_t index, const Vector3<double>& direction) {
    Neighbours& pair = pairs_[index];
    pair.normal = direction;
    pair.offset = -std::numeric_limits<double>::infinity();
    for (const std::uint32_t corner : fixed_.face(pair.faces.fixed))
        pair.offset = std::max(pair.offset, dot(pair.normal, culling::point_of<double>(fixed_, corner)));
    gaps_[index] = gap(pair, gap_place_);
    pair.widest = gap_on_way(pair);
}

/// The least gap along the normal of a pair whose moving face is placed. Heights on chords are between those at the
/// ends.
double NeighbourList::gap_on_way(const Neighbours& pair) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Vector3<double>& corner : placed_)
        least = std::min(least, dot(pair.normal, corner));
    return least - pair.offset;
}

} // namespace chasles::search
