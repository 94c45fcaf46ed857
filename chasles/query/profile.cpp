#include "chasles/query/profile.h"

#include "chasles/base/limit_of_thread.h"
#include "chasles/query/pair_query.h"
#include "chasles/query/profile_knots.h"
#include "chasles/query/profile_steps.h"
#include "chasles/query/requirements.h"
#include "chasles/search/chord_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace chasles {

namespace {

using query::time_of;
using search::DistanceBounds;
using search::LinearBound;
using search::PieceContext;

/// Parts of a piece are not halved below this width in tau.
constexpr double shortest_part = 0x1p-30;
/// Nor where the bodies touch at both ends: what happens in between is not looked for.
constexpr double shortest_touching_part = 0x1p-7;
constexpr int most_parts = 1 << 17; ///< of a question

/// The bounds take this part of the tolerance and leave the rest to steps, which cost nothing.
constexpr double share_of_bounds = 0.7;

/// At a margin nearest features are exact up to this part of the widths elsewhere, and so narrow bounds are its
/// crossing.
constexpr double narrowest = 1e-4;

/// For roundings of balls, as a share of all lengths.
constexpr double rounding_of_balls = 1e-12;

class ProfileSearch {
public:
    explicit ProfileSearch(const query::PairProfileQuery& question);
    DistanceProfile run();

private:
    using Knot = query::ProfileKnot;
    using Touch = Knot::Touch;

    [[nodiscard]] double default_tolerance() const;
    bool search();
    bool search(PieceContext piece);
    /// `others` is the greatest upper bound of other distances in the part.
    bool add_far_part(const Bracket& part, double others);
    bool add_part(const Knot& start, const Knot& end, double others);
    [[nodiscard]] double greatest_of_others(const Bracket& tau) const;
    [[nodiscard]] std::optional<DistanceBounds> beyond(double others, const Knot& start, const Knot& end);
    /// The bounds of a part, less both radii; empty if it is to be halved.
    std::optional<DistanceBounds> bounds_of(const Knot& start, const Knot& end, bool is_last);
    bool is_free(const Knot& start, const Knot& end, const DistanceBounds& bounds);
    DistanceBounds touching_bounds(const Knot& start, const Knot& end);
    [[nodiscard]] DistanceBounds of_bodies(const DistanceBounds& of_surfaces) const;
    [[nodiscard]] double width_at(double distance) const;
    [[nodiscard]] double error_at(double distance) const;
    [[nodiscard]] LinearBound widths_of(const Knot& start, const Knot& end) const;
    [[nodiscard]] Bracket of_balls() const;

    const query::PairProfileQuery& question_;
    const Body& moving_;
    const Body& fixed_;
    const motion::AnyTrajectory& trajectory_;
    ProfileOptions options_;
    double radii_;
    query::ProfileKnots knots_;
    int parts_ = 0;
    const motion::AnyPiece* piece_ = nullptr;
    Bracket balls_; ///< of the distance, over the whole motion
    query::ProfileSteps steps_;
    bool certain_ = true;
};

ProfileSearch::ProfileSearch(const query::PairProfileQuery& question)
    : question_(question), moving_(question.moving), fixed_(question.fixed), trajectory_(question.trajectory),
      options_(question.options), radii_(distance_of_polyhedra(moving_, fixed_, 0)),
      knots_(question, [this](double distance) { return error_at(distance); }), steps_(options_, 1 - share_of_bounds) {
    if (options_.absolute_tolerance == 0)
        options_.absolute_tolerance = default_tolerance();
    std::ranges::sort(options_.margins);
}

/// A part of the bodies, and of overlaps that are allowed: parts in touch are as far apart as their faces have moved
/// inwards.
double ProfileSearch::default_tolerance() const {
    constexpr double share_of_overlap = 0.125;
    double tolerance = 1e-6 * (moving_.ball_radius() + fixed_.ball_radius());
    for (const Body* body : {&moving_, &fixed_})
        if (const double overlap = body->report().moved_inwards; overlap > 0)
            tolerance = std::min(tolerance, share_of_overlap * overlap);
    return tolerance;
}

DistanceProfile ProfileSearch::run() {
    balls_ = of_balls();
    const bool is_far = balls_.lower >= question_.others.greatest_upper(question_.part);
    if (is_far || !search()) {
        steps_.add_rest(is_far ? balls_.lower : 0, balls_.upper);
        certain_ = is_far;
    }
    DistanceProfile profile = std::move(steps_).result(is_far ? 0 : knots_.clear_until());
    profile.certain = certain_;
    profile.work = knots_.work();
    return profile;
}

/// False at a limit.
bool ProfileSearch::search() {
    knots_.find_contact();
    const auto pieces = trajectory_.pieces();
    bool is_whole = true;
    for (std::size_t i = 0; i < pieces->size() && is_whole; ++i)
        is_whole = search(PieceContext(moving_, fixed_, pieces->at(i)));
    return is_whole;
}

/// All along, the bodies are as far apart as balls around them and around their paths, and no farther than one vertex
/// of each.
Bracket ProfileSearch::of_balls() const {
    const auto distances = [&](const Eigen::Vector3d& moving, const Eigen::Vector3d& fixed, double radius) {
        const motion::PathBall path = trajectory_.ball_around_path({moving.x(), moving.y(), moving.z()});
        const double middle = (Eigen::Vector3d(path.centre.x, path.centre.y, path.centre.z) - fixed).norm();
        const double most = path.radius + radius + rounding_of_balls * (path.size + fixed.norm() + radius);
        return Bracket{std::max(0.0, middle - most), middle + most};
    };
    const double both = moving_.ball_radius() + fixed_.ball_radius();
    const Bracket to_vertex = distances(moving_.vertices().front(), fixed_.vertices().front(), 0);
    return {distances(moving_.bvh().centre(), fixed_.bvh().centre(), both).lower,
            std::max(0.0, to_vertex.upper - radii_)};
}

/// The bounds of a part that needs no closer ones, because another distance is less all along.
std::optional<DistanceBounds> ProfileSearch::beyond(double others, const Knot& start, const Knot& end) {
    const bool may_be = start.touch == Touch::apart && end.touch == Touch::apart &&
                        std::min(start.near.distance, end.near.distance) - radii_ >= others;
    if (!may_be)
        return std::nullopt;
    const DistanceBounds bounds = of_bodies(*knots_.bounds().between(start.near, end.near, std::nullopt));
    return bounds.lower.least() >= others ? std::optional(bounds) : std::nullopt;
}

double ProfileSearch::greatest_of_others(const Bracket& tau) const {
    if (question_.others.is_empty())
        return std::numeric_limits<double>::infinity();
    const Bracket& part = question_.part;
    const auto in_part = [&](double end) { return part.lower + time_of(*piece_, end) * (part.upper - part.lower); };
    return question_.others.greatest_upper({in_part(tau.lower), in_part(tau.upper)});
}

/// From part to part in order of time. A part whose bounds are too far from each other is halved. False at a limit.
bool ProfileSearch::search(PieceContext piece) {
    piece_ = &piece.piece();
    steps_.begin(piece.piece());
    knots_.begin(piece);
    struct End {
        double tau;
        std::optional<Knot> knot = {}; ///< once it is needed
    };
    End start{0};
    std::vector<End> ends{{1}};
    while (!ends.empty() && !is_cancelled()) {
        End& end = ends.back();
        const double others = greatest_of_others({start.tau, end.tau});
        bool is_done = add_far_part({start.tau, end.tau}, others);
        if (!is_done) {
            if (!start.knot)
                start.knot = knots_.beside(start.tau, {});
            const End* const later = ends.size() > 1 ? &end - 1 : nullptr;
            if (!end.knot)
                end.knot = knots_.beside(end.tau, {&start.knot, later ? &later->knot : nullptr});
            is_done = add_part(*start.knot, *end.knot, others);
        }
        if (is_done) {
            start = std::move(end);
            ends.pop_back();
        } else {
            ends.push_back({0.5 * (start.tau + end.tau)});
        }
    }
    knots_.end(start.knot);
    return ends.empty();
}

/// Without knots, where balls around the bodies are so far apart that another distance is less all along.
bool ProfileSearch::add_far_part(const Bracket& part, double others) {
    if (std::isinf(others) ||
        (others > 0 && !knots_.bounds().are_balls_beyond(part.lower, part.upper, others + radii_)))
        return false;
    steps_.add_one(part, others, balls_.upper);
    return true;
}

/// False if the part is to be halved.
bool ProfileSearch::add_part(const Knot& start, const Knot& end, double others) {
    const Bracket part{start.near.tau, end.near.tau};
    const bool is_last = part.upper - part.lower <= shortest_part || ++parts_ > most_parts;
    if (knots_.overlap_all_along(start, end)) {
        steps_.add_one(part, 0, 0);
        return true;
    }
    if (const auto far = beyond(others, start, end)) {
        steps_.add_one(part, far->lower.least(), far->upper.greatest());
        return true;
    }
    const auto bounds = bounds_of(start, end, is_last);
    if (bounds && start.touch != Touch::apart && end.touch != Touch::apart)
        steps_.add_one(part, 0, std::max(0.0, bounds->upper.greatest()));
    else if (bounds)
        steps_.add(part, *bounds, is_free(start, end, *bounds));
    return bounds.has_value();
}

/// Distances below the tolerance are not told from 0, but touch is.
bool ProfileSearch::is_free(const Knot& start, const Knot& end, const DistanceBounds& bounds) {
    return bounds.lower.least() > 0 ||
           (start.touch == Touch::apart && end.touch == Touch::apart && knots_.stay_apart(start, end));
}

std::optional<DistanceBounds> ProfileSearch::bounds_of(const Knot& start, const Knot& end, bool is_last) {
    const double time = time_of(*piece_, end.near.tau) - time_of(*piece_, start.near.tau);
    const auto is_in_doubt = [&](const DistanceBounds& b) {
        return query::share_in_doubt(b, options_.margins) * time > options_.time_tolerance;
    };
    const int touches = int(start.touch != Touch::apart) + int(end.touch != Touch::apart);
    if (touches > 0 || std::max(start.near.distance, end.near.distance) - radii_ <= options_.absolute_tolerance) {
        const DistanceBounds bounds = touching_bounds(start, end);
        const bool is_narrow = bounds.upper.greatest() <= options_.absolute_tolerance;
        const bool is_short = is_last || end.near.tau - start.near.tau <= shortest_touching_part;
        if (touches == 2)
            return is_narrow || is_short ? std::optional(bounds) : std::nullopt;
        if (touches == 1 && !is_short) // the rest of the part may be free
            return std::nullopt;
        if (is_narrow && !is_in_doubt(bounds))
            return bounds;
    }
    const bool is_nested = start.touch == Touch::nested || end.touch == Touch::nested;
    // How deep in touch, where the widths are those of touch.
    const double depth = radii_ - std::min(start.near.distance, end.near.distance);
    if (!is_last && (is_nested || depth > options_.absolute_tolerance))
        return std::nullopt;
    if (is_nested)
        return of_bodies({{}, knots_.bounds().upper_between(start.near, end.near)});
    if (is_last) {
        certain_ = false;
        return of_bodies(*knots_.bounds().between(start.near, end.near, std::nullopt));
    }
    const LinearBound widths = widths_of(start, end);
    const auto found = knots_.bounds().between(start.near, end.near, widths);
    if (!found)
        return std::nullopt;
    const DistanceBounds bounds = of_bodies(*found);
    if (!is_in_doubt(bounds))
        return bounds;
    const DistanceBounds best = of_bodies(*knots_.bounds().between(start.near, end.near, std::nullopt));
    const bool is_margin = query::share_in_doubt(best, options_.margins) == 1 &&
                           best.upper.greatest() - best.lower.least() <= narrowest * widths.least();
    if (is_in_doubt(best) && !is_margin && time > options_.time_tolerance)
        return std::nullopt;
    return std::min(best.lower.start - bounds.lower.start, best.lower.end - bounds.lower.end) < 0 ? bounds : best;
}

/// Linear between both ends, and nowhere more than `width_at`, which is convex.
LinearBound ProfileSearch::widths_of(const Knot& start, const Knot& end) const {
    const auto width_of = [&](const Knot& knot) {
        return share_of_bounds * width_at(knot.touch == Touch::apart ? knot.near.distance : 0);
    };
    const LinearBound widths{width_of(start), width_of(end)};
    const double least = share_of_bounds * options_.absolute_tolerance;
    return widths.least() > least ? widths : LinearBound{least, least};
}

/// While the surfaces do not meet, what is inside stays inside.
DistanceBounds ProfileSearch::touching_bounds(const Knot& start, const Knot& end) {
    if (start.touch == Touch::nested && end.touch == Touch::nested) {
        const auto of_surfaces = knots_.bounds().between(start.near, end.near, std::nullopt);
        if (of_surfaces->lower.least() > 0)
            return {};
    }
    return of_bodies({{}, knots_.bounds().upper_between(start.near, end.near)});
}

DistanceBounds ProfileSearch::of_bodies(const DistanceBounds& of_surfaces) const {
    const auto less_radii = [&](const LinearBound& bound, double rounding) {
        return LinearBound{bound.start - radii_ + rounding, bound.end - radii_ + rounding};
    };
    const double rounding = 0x1p-50 * radii_;
    return {less_radii(of_surfaces.lower, -rounding), less_radii(of_surfaces.upper, rounding)};
}

/// Of nearest features: an eighth of the width of bounds; where a margin is near, an eighth of the narrowest ones.
double ProfileSearch::error_at(double distance) const {
    const double width = width_at(distance);
    const bool is_at_margin = std::ranges::any_of(
        options_.margins, [&](double margin) { return std::abs(distance - radii_ - margin) <= width; });
    return 0.125 * width * (is_at_margin ? narrowest : 1);
}

double ProfileSearch::width_at(double distance) const {
    return std::max(options_.tolerance * (distance - radii_), options_.absolute_tolerance);
}

/// Adds a part of time, which may continue the last one.
void extend(std::vector<Bracket>& intervals, const Bracket& part) {
    if (!intervals.empty() && intervals.back().upper == part.lower)
        intervals.back().upper = part.upper;
    else
        intervals.push_back(part);
}

} // namespace

DistanceProfile profile(const ProfileQuery& question) {
    query::check_options(question.options);
    check_motion(question.moving, question.fixed, question.motion);
    return query::answer(query::PairProfileQuery{question.moving.body(), question.fixed.body(),
                                                 question.motion.trajectory(), question.options});
}

Zones DistanceProfile::zones(double margin) const {
    query::check_options(QueryOptions{.margin = margin});
    Zones zones;
    for (std::size_t i = 0; i + 1 < times.size(); ++i)
        if (lower[i] <= margin)
            extend(upper[i] <= margin ? zones.inside : zones.doubt, {times[i], times[i + 1]});
    return zones;
}

std::vector<Bracket> DistanceProfile::free() const {
    std::vector<Bracket> intervals;
    for (std::size_t i = 0; i + 1 < times.size(); ++i)
        if (lower[i] > 0)
            extend(intervals, {times[i], times[i + 1]});
    return intervals;
}

} // namespace chasles

namespace chasles::query {

DistanceProfile answer(const PairProfileQuery& question) {
    return ProfileSearch(question).run();
}

} // namespace chasles::query
