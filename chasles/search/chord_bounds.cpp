#include "chasles/search/chord_bounds.h"

#include "chasles/base/limit_of_thread.h"
#include "chasles/culling/node_heights.h"
#include "chasles/culling/split_nodes.h"
#include "chasles/search/lasting_overlap.h"

#include <cmath>
#include <limits>
#include <tuple>

namespace chasles::search {

namespace {

using contact::FeaturePair;
using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The search for a lower bound may fall below the distance at the knots by this part of the widths; without that, all
/// pairs of faces that are nearly as near as the nearest ones have to be looked at.
constexpr double share_of_search = 0.35;

Vector3d eigen(const algebra::Vector3<double>& v) {
    return {v.x, v.y, v.z};
}

Vector3d moved(const motion::MatrixPose& pose, const Vector3d& point) {
    return eigen(pose(motion::vector_in<double>(point)));
}

Vector3d moved_back(const motion::MatrixPose& pose, const Vector3d& point) {
    return eigen(pose.rotation.transposed() * (motion::vector_in<double>(point) - pose.translation));
}

/// A set that contains a point of a feature, is a part of the surface, and is convex: the distance of a point that runs
/// straight is then convex in time.
Vector3d nearest_in_edge(const Body& body, const Feature& edge, const Vector3d& point) {
    return contact::foot_on_segment(body.vertices()[edge.first], body.vertices()[edge.second], point);
}

bool is_convex(const Body& body, std::uint32_t face) {
    return body.face_triangles(face).empty();
}

} // namespace

NearKnot ChordBounds::nearest_at(double tau, std::span<const FeaturePair> guesses, const Error& error) {
    const contact::RelativeConfiguration bodies = context_.configuration_at(tau);
    NearKnot knot{.tau = tau, .distance = infinity, .features = {}, .points = {}, .pose = bodies.pose()};
    const auto use = [&](const FeaturePair& features) {
        const NearPoints points = nearest_.points(bodies, features);
        if (points.distance < knot.distance)
            std::tie(knot.distance, knot.features, knot.points) = std::tuple(points.distance, features, points);
    };
    for (const FeaturePair& features : guesses)
        use(features);
    const double enough = guesses.empty() ? infinity : knot.distance - error(knot.distance);
    if (guesses.empty() || !are_beyond_at(knot, enough))
        if (const auto nearer = nearest_features(bodies, {enough}, work_))
            use(nearer->features);
    return knot;
}

bool ChordBounds::are_beyond(const NearKnot& start, const NearKnot& end, double distance) {
    const auto [interval, slack] = part_between(start, end);
    ends_.start = start.pose;
    ends_.end = end.pose;
    use_directions(start, end);
    const double least = std::nextafter(distance + 2 * slack, infinity);
    const bool may_be = std::min(start.distance, end.distance) > least;
    return may_be && lower(interval.boxes, {start.distance, end.distance}, LinearBound{least, least}).has_value();
}

/// Whether the surfaces are proven to be so far apart at a knot.
bool ChordBounds::are_beyond_at(const NearKnot& knot, double distance) {
    ends_ = culling::IntervalEnds(knot.pose);
    use_directions(knot, knot);
    const LinearBound wanted{distance, distance};
    return lower(part_between(knot, knot).interval.boxes, wanted, wanted).has_value();
}

NearKnot ChordBounds::crossing_at(double tau, const Vector3d& point) const {
    return {.tau = tau, .distance = 0, .features = {}, .points = {point, point}, .pose = context_.pose_at(tau)};
}

NearKnot ChordBounds::crossing_at(double tau, const Overlap& overlap) const {
    const motion::MatrixPose pose = context_.pose_at(tau);
    return crossing_at(tau, OverlapOnChords(context_.moving(), context_.fixed(), overlap, {pose, pose}).point());
}

/// As long as they do, points of both bodies are no farther apart than both balls are wide.
bool ChordBounds::crosses_between(const NearKnot& start, const NearKnot& end, const Overlap& overlap) const {
    const Body &moving = context_.moving(), &fixed = context_.fixed();
    const double slack = part_between(start.tau, end.tau, 2 * (moving.ball_radius() + fixed.ball_radius())).slack;
    return OverlapOnChords(moving, fixed, overlap, {start.pose, end.pose}).lasts(slack);
}

/// Points of both bodies that are no farther apart than the distance at either end stay near their chords.
ChordBounds::Part ChordBounds::part_between(const NearKnot& start, const NearKnot& end) const {
    return part_between(start.tau, end.tau, std::max(start.distance, end.distance));
}

ChordBounds::Part ChordBounds::part_between(double from, double to, double farthest) const {
    const culling::PieceParts parts = context_.parts(farthest);
    const culling::TimeInterval interval = context_.time_tree(farthest, parts).interval({from, to});
    return {interval, interval.deviation + 4 * elementary::position_error<double>(parts.scale())};
}

/// A point of the moving body that comes as near stays near its chord, and so within the ball around the chord of the
/// middle.
bool ChordBounds::are_balls_beyond(double from, double to, double distance) const {
    const Body &moving = context_.moving(), &fixed = context_.fixed();
    const auto middle = [&](double tau) { return moved(context_.pose_at(tau), moving.bvh().centre()); };
    const Vector3d nearest = contact::foot_on_segment(middle(from), middle(to), fixed.bvh().centre());
    const double slack = part_between(from, to, distance).slack;
    return (nearest - fixed.bvh().centre()).norm() > distance + moving.ball_radius() + fixed.ball_radius() + slack;
}

std::optional<DistanceBounds> ChordBounds::between(const NearKnot& start, const NearKnot& end,
                                                   const std::optional<LinearBound>& widths) {
    const auto [interval, slack] = part_between(start, end);
    if (widths && 2 * slack > widths->least())
        return std::nullopt;
    const LinearBound most = upper(start, end);
    std::optional<LinearBound> wanted;
    if (widths)
        wanted = {most.start + 2 * slack - widths->start, most.end + 2 * slack - widths->end};
    if (wanted && (wanted->start > start.distance - share_of_search * widths->start ||
                   wanted->end > end.distance - share_of_search * widths->end))
        return std::nullopt;
    ends_.start = start.pose;
    ends_.end = end.pose;
    use_directions(start, end);
    const auto least = lower(interval.boxes, {start.distance, end.distance}, wanted);
    if (!least)
        return std::nullopt;
    return DistanceBounds{{least->start - slack, least->end - slack}, {most.start + slack, most.end + slack}};
}

LinearBound ChordBounds::upper_between(const NearKnot& start, const NearKnot& end) {
    const double slack = part_between(start, end).slack;
    const LinearBound most = upper(start, end);
    return {most.start + slack, most.end + slack};
}

/// The points that are nearest at either end: the best of all bounds.
LinearBound ChordBounds::upper(const NearKnot& start, const NearKnot& end) {
    const LinearBound later{start.distance, way_of_points(start, end)},
        earlier{way_of_points(end, start), end.distance};
    const LinearBound best = later.end - end.distance < earlier.start - start.distance ? later : earlier;
    const double more = std::max(best.start - start.distance, best.end - end.distance);
    const double of_sliding = more > 0 ? more_of_sliding(start, end) : infinity;
    return of_sliding < more ? LinearBound{start.distance + of_sliding, end.distance + of_sliding} : best;
}

/// Where the same edges are nearest at both knots, let two points slide on them, evenly from the nearest ones at one
/// knot to those at the other. The vector between them is quadratic, and longer than the line by no more.
double ChordBounds::more_of_sliding(const NearKnot& start, const NearKnot& end) const {
    if (!start.features || start.features != end.features || start.features->kind != ContactKind::edge_edge)
        return infinity;
    const Vector3d later = moved(end.pose, moved_back(start.pose, start.points.on_moving));
    const Vector3d earlier = moved(start.pose, moved_back(end.pose, end.points.on_moving));
    const double control = 0.5 * (later + earlier - start.points.on_fixed - end.points.on_fixed).norm();
    return 0.5 * std::max(0.0, control - 0.5 * (start.distance + end.distance));
}

/// Two points are nearest at one knot. How far is one of them from a convex part of the other surface, at the other
/// knot?
double ChordBounds::way_of_points(const NearKnot& from, const NearKnot& to) {
    const auto& [on_moving, on_fixed] = from.points;
    const Body &moving = context_.moving(), &fixed = context_.fixed();
    const Vector3d point = moved(to.pose, moved_back(from.pose, on_moving)); // of the moving body
    const Vector3d other = moved_back(to.pose, on_fixed); // of the fixed body, seen by the moving one
    double way = (point - on_fixed).norm();
    if (!from.features)
        return way;
    const FeaturePair& features = *from.features;
    const auto shorten = [&](double error, const Vector3d& a, const Vector3d& b) {
        way = std::min(way, (a - b).norm() + error);
    };
    if (features.kind == ContactKind::vertex_face && is_convex(fixed, features.fixed.first)) {
        const contact::FaceAtRest& face = fixed_face_.of(fixed, features.fixed.first);
        shorten(face.nearest_error(), point, face.nearest(point));
    } else if (features.kind == ContactKind::face_vertex && is_convex(moving, features.moving.first)) {
        const contact::FaceAtRest& face = moving_face_.of(moving, features.moving.first);
        shorten(face.nearest_error(), other, face.nearest(other));
    } else if (features.kind == ContactKind::edge_edge) {
        shorten(0, point, nearest_in_edge(fixed, features.fixed, point));
        shorten(0, other, nearest_in_edge(moving, features.moving, other));
    }
    return way;
}

void ChordBounds::use_directions(const NearKnot& start, const NearKnot& end) {
    separation_.use(ends_);
    sights_.clear();
    std::array<Vector3d, 2> found;
    std::size_t count = 0;
    for (const NearKnot* knot : {&start, &end})
        if (knot->distance > 0)
            found[count++] = knot->points.apart().stableNormalized();
    if (count == 2 && (found[0] + found[1]).norm() > 0)
        sights_.push_back(sight_along(motion::vector_in<double>((found[0] + found[1]).normalized())));
    for (std::size_t i = 0; i < count; ++i)
        sights_.push_back(sight_along(motion::vector_in<double>(found[i])));
    if (!sights_.empty()) // a part between two others is often as far from one as from the other
        sights_.push_back(sight_along(scale(sights_.front().along, -1.0)));
}

ChordBounds::Sight ChordBounds::sight_along(const Direction& along) const {
    const auto moving = motion::vector_in<double>(context_.moving().bvh().centre());
    const auto fixed = motion::vector_in<double>(context_.fixed().bvh().centre());
    Sight sight{along, {}, {}};
    for (const auto& [pose, i] : {std::pair(&ends_.start, 0U), std::pair(&ends_.end, 1U)}) {
        sight.of_moving[i] = pose->rotation.transposed() * along;
        sight.between[i] = dot(along, (*pose)(moving)-fixed);
    }
    return sight;
}

/// Whether the boxes of two nodes are at least so far apart along one direction, at both ends.
bool ChordBounds::are_beyond(const LinearBound& distance, const BvhNode& moving, const BvhNode& fixed) const {
    const auto separates = [&](const Sight& sight) {
        const double of_fixed = culling::lowest(fixed, scale(sight.along, -1.0));
        return sight.between[0] + culling::lowest(moving, sight.of_moving[0]) + of_fixed >= distance.start &&
               sight.between[1] + culling::lowest(moving, sight.of_moving[1]) + of_fixed >= distance.end;
    };
    return std::ranges::any_of(sights_, separates) || separates(sight_along(between_middles(moving, fixed)));
}

bool ChordBounds::are_faces_beyond(const LinearBound& distance, std::uint32_t moving, std::uint32_t fixed) {
    if (sights_.empty())
        return false;
    const Direction way =
        between_middles(context_.moving().bvh().nodes()[moving], context_.fixed().bvh().nodes()[fixed]);
    const Sight& sight = dot(sights_.front().along, way) < 0 ? sights_.back() : sights_.front();
    const double of_fixed = culling::least_height(context_.fixed(), fixed, scale(sight.along, -1.0), nodes_);
    const auto gap = [&](std::size_t end) {
        const double of_moving = culling::least_height(context_.moving(), moving, sight.of_moving[end], nodes_);
        return sight.between[end] + of_moving + of_fixed;
    };
    return gap(0) >= distance.start && gap(1) >= distance.end;
}

/// A unit direction between the middles of two nodes in the middle of the part.
ChordBounds::Direction ChordBounds::between_middles(const BvhNode& moving, const BvhNode& fixed) const {
    const auto middle = [](const Body& body, const BvhNode& node) {
        return motion::vector_in<double>(body.bvh().centre() + middle_of(node).centre.cast<double>());
    };
    const Direction of_moving = middle(context_.moving(), moving);
    const Direction way = scale(ends_.start(of_moving) + ends_.end(of_moving), 0.5) - middle(context_.fixed(), fixed);
    const double size = length(way);
    return size > 0 ? scale(way, 1 / size) : Direction{1, 0, 0};
}

/// A bound of all pairs of faces that may come as near as it: `wanted`, or else the best that is found.
std::optional<LinearBound> ChordBounds::lower(const culling::SweptBoxes& boxes, const LinearBound& most,
                                              const std::optional<LinearBound>& wanted) {
    const std::span<const BvhNode> moving = context_.moving().bvh().nodes(), fixed = context_.fixed().bvh().nodes();
    LinearBound least = wanted.value_or(most);
    stack_.assign(1, {0, 0});
    Watch watch;
    while (!stack_.empty()) {
        if (watch.is_over(1))
            return wanted ? std::nullopt : std::optional(LinearBound{-infinity, -infinity});
        const auto [i, j] = stack_.back();
        stack_.pop_back();
        if (moving[i].is_leaf() && fixed[j].is_leaf()) {
            const LinearBound gap = widest_gaps(moving[i].first, fixed[j].first, least);
            if (gap.start >= least.start && gap.end >= least.end)
                continue;
            if (wanted)
                return std::nullopt;
            least = {std::min(least.start, gap.start), std::min(least.end, gap.end)};
            continue;
        }
        if (are_faces_beyond(least, i, j))
            continue;
        const auto [a, b] = culling::split_nodes(moving, i, fixed, j);
        std::array<bool, 4> is_near{};
        for (std::uint32_t k = 0; k < a.count; ++k)
            for (std::uint32_t l = 0; l < b.count; ++l) {
                const BvhNode &of_moving = moving[a.first + k], &of_fixed = fixed[b.first + l];
                is_near[2 * k + l] =
                    !(of_moving.is_bare() && of_fixed.is_bare()) && !are_beyond(least, of_moving, of_fixed);
            }
        work_.node_pairs += std::uint64_t(a.count) * b.count;
        if (std::ranges::none_of(is_near, std::identity()))
            continue;
        const auto windows = boxes.overlap_windows(a.of(moving), b.of(fixed), {});
        for (std::uint32_t k = 0; k < 4; ++k)
            if (is_near[k] && !windows[k].is_empty())
                stack_.emplace_back(a.first + k / 2, b.first + k % 2);
    }
    return least;
}

/// The gaps of two faces along one direction that are as great as `wanted`, or the best that are found.
LinearBound ChordBounds::widest_gaps(std::uint32_t moving_face, std::uint32_t fixed_face, const LinearBound& wanted) {
    ++work_.face_pairs;
    LinearBound best{-infinity, -infinity};
    const auto lack = [&](const LinearBound& gap) { return std::max(wanted.start - gap.start, wanted.end - gap.end); };
    const auto is_enough = [&](const Direction& along) {
        const LinearBound gap = gaps(along, moving_face, fixed_face);
        if (lack(gap) < lack(best))
            best = gap;
        return lack(best) <= 0;
    };
    for (const Sight& sight : sights_)
        if (is_enough(sight.along))
            return best;
    for (const double time : {0.5, 0.0, 1.0})
        if (const auto along = separation_.nearest(moving_face, fixed_face, time); along && is_enough(*along))
            break;
    return best;
}

/// On chords each corner runs evenly along the direction, so the least height is above the line between its values at
/// both ends.
LinearBound ChordBounds::gaps(const Direction& along, std::uint32_t moving_face, std::uint32_t fixed_face) const {
    double highest = -infinity;
    for (const std::uint32_t corner : context_.fixed().face(fixed_face))
        highest = std::max(highest, dot(along, culling::point_of<double>(context_.fixed(), corner)));
    LinearBound least{infinity, infinity};
    for (const std::uint32_t corner : context_.moving().face(moving_face)) {
        const auto point = culling::point_of<double>(context_.moving(), corner);
        least.start = std::min(least.start, dot(along, ends_.start(point)));
        least.end = std::min(least.end, dot(along, ends_.end(point)));
    }
    return {least.start - highest, least.end - highest};
}

} // namespace chasles::search
