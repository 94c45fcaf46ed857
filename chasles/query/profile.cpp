#include "chasles/query/profile.h"

#include "chasles/base/limit_of_thread.h"
#include "chasles/query/pair_query.h"
#include "chasles/query/requirements.h"
#include "chasles/search/chord_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace chasles {

namespace {

using search::ChordBounds;
using search::DistanceBounds;
using search::LinearBound;
using search::NearKnot;
using search::PieceContext;

/// Parts of a piece are not halved below this width in tau.
constexpr double shortest_part = 0x1p-30;
/// Nor where the bodies touch at both ends: what happens in between is not looked for.
constexpr double shortest_touching_part = 0x1p-7;
constexpr int most_parts = 1 << 17; ///< of a question

/// The bounds take this part of the tolerance and leave the rest to steps, which cost nothing.
constexpr double share_of_bounds = 0.7;

/// Where a margin is crossed, bounds become so narrow, as a part of what they are elsewhere, or parts so short.
constexpr double narrowest = 1e-4;
constexpr double few_time_tolerances = 16;

class ProfileSearch {
public:
    explicit ProfileSearch(const ProfileQuery& question);
    DistanceProfile run();

private:
    enum class Touch : std::uint8_t { apart, meets, nested };
    struct Knot {
        NearKnot near;
        Touch touch = Touch::apart;
    };

    void run(const PieceContext& piece);
    using Features = std::vector<contact::FeaturePair>;
    Knot knot_at(double tau, const Features& guesses);
    NearKnot nearest_at(double tau, const Features& guesses) {
        return chords_->nearest_at(tau, guesses, [&](double distance) { return 0.125 * width_at(distance); });
    }
    /// The bounds of a part, less both radii; empty if it is to be halved.
    std::optional<DistanceBounds> bounds_of(const Knot& start, const Knot& end, bool is_last);
    DistanceBounds touching_bounds(const Knot& start, const Knot& end);
    [[nodiscard]] DistanceBounds of_bodies(const DistanceBounds& of_surfaces) const;
    [[nodiscard]] double width_at(double distance) const;
    [[nodiscard]] double share_in_doubt(const DistanceBounds& bounds) const;
    void add_steps(const Knot& start, const Knot& end, const DistanceBounds& bounds);
    void add_even_steps(double from, double to, const DistanceBounds& bounds);
    void add_step(double from, double to, double lower, double upper);
    [[nodiscard]] double time_of(double tau) const;

    const Body& moving_;
    const Body& fixed_;
    const motion::AnyTrajectory& trajectory_;
    ProfileOptions options_;
    double radii_;
    double clear_until_ = 1; ///< time: nothing touches before it
    const PieceContext* piece_ = nullptr;
    std::optional<ChordBounds> chords_; ///< of the piece
    int parts_ = 0;
    DistanceProfile profile_;
};

ProfileSearch::ProfileSearch(const ProfileQuery& question)
    : moving_(question.moving.body()), fixed_(question.fixed.body()), trajectory_(question.motion.trajectory()),
      options_(question.options), radii_(distance_of_polyhedra(moving_, fixed_, 0)) {
    if (options_.absolute_tolerance == 0)
        options_.absolute_tolerance = 1e-6 * (moving_.ball_radius() + fixed_.ball_radius());
    std::ranges::sort(options_.margins);
}

DistanceProfile ProfileSearch::run() {
    const FirstContact touch = query::answer_or_unknown({moving_, fixed_, trajectory_, QueryOptions{}});
    profile_.work += touch.work;
    profile_.certain = true;
    clear_until_ = touch.clear_until;
    const auto pieces = trajectory_.pieces();
    for (std::size_t i = 0; i < pieces->size(); ++i)
        run(PieceContext(moving_, fixed_, pieces->at(i)));
    profile_.times.front() = 0; // clocks are rounded
    profile_.times.back() = 1;
    profile_.lower.push_back(profile_.lower.back());
    profile_.upper.push_back(profile_.upper.back());
    return std::move(profile_);
}

/// From part to part in order of time. A part whose bounds are too far from each other is halved.
void ProfileSearch::run(const PieceContext& piece) {
    piece_ = &piece;
    chords_.emplace(piece);
    Knot start = knot_at(0, {});
    std::vector<Knot> ends{knot_at(1, {start.near.features})};
    while (!ends.empty()) {
        ++parts_;
        const Knot& end = ends.back();
        const double width = end.near.tau - start.near.tau;
        const bool is_last = width <= shortest_part || parts_ > most_parts || is_cancelled();
        if (const auto bounds = bounds_of(start, end, is_last)) {
            if (start.touch == Touch::apart || end.touch == Touch::apart)
                add_steps(start, end, *bounds);
            else
                add_step(start.near.tau, end.near.tau, 0, std::max(0.0, bounds->upper.greatest()));
            start = end;
            ends.pop_back();
        } else {
            ends.push_back(knot_at(start.near.tau + 0.5 * width, {start.near.features, end.near.features}));
        }
    }
    profile_.work += chords_->work();
}

/// Before the first contact nothing touches. Later, the bodies are tested at rest.
ProfileSearch::Knot ProfileSearch::knot_at(double tau, const Features& guesses) {
    if (clear_until_ < 1 && time_of(tau) >= clear_until_) {
        const Pose moving = piece_->piece().pose_at(tau), fixed = piece_->piece().fixed_pose_at(tau);
        const Motion at_rest = Motion::at_rest(Pose(fixed.isometry().inverse() * moving.isometry()));
        const FirstContact found = query::answer_or_unknown({moving_, fixed_, at_rest.trajectory(), QueryOptions{}});
        profile_.work += found.work;
        if (found.overlap)
            return {chords_->crossing_at(tau, found.overlap->point), Touch::meets};
        const Touch touch = found.inside                                 ? Touch::nested
                            : found.verdict == Verdict::contact_at_start ? Touch::meets
                                                                         : Touch::apart;
        return {nearest_at(tau, guesses), touch};
    }
    return {nearest_at(tau, guesses), Touch::apart};
}

std::optional<DistanceBounds> ProfileSearch::bounds_of(const Knot& start, const Knot& end, bool is_last) {
    if (start.touch != Touch::apart && end.touch != Touch::apart) {
        const DistanceBounds bounds = touching_bounds(start, end);
        const bool is_narrow = bounds.upper.greatest() <= options_.absolute_tolerance;
        const bool is_short = is_last || end.near.tau - start.near.tau <= shortest_touching_part;
        return is_narrow || is_short ? std::optional(bounds) : std::nullopt;
    }
    const auto width_of = [&](const Knot& knot) {
        return share_of_bounds * width_at(knot.touch == Touch::apart ? knot.near.distance : 0);
    };
    const bool is_nested = start.touch == Touch::nested || end.touch == Touch::nested;
    // How deep in touch, where the widths are those of touch.
    const double depth = radii_ - std::min(start.near.distance, end.near.distance);
    if (!is_last && (is_nested || depth > options_.absolute_tolerance))
        return std::nullopt;
    if (is_nested || is_cancelled()) {
        profile_.certain = profile_.certain && is_nested;
        return of_bodies({{}, chords_->upper_between(start.near, end.near)});
    }
    if (is_last) {
        profile_.certain = false;
        return of_bodies(*chords_->between(start.near, end.near, std::nullopt));
    }
    const LinearBound widths{width_of(start), width_of(end)};
    const auto bounds_within = [&](const LinearBound& narrow) {
        const auto found = chords_->between(start.near, end.near, narrow);
        return found ? std::optional(of_bodies(*found)) : std::nullopt;
    };
    const auto bounds = bounds_within(widths);
    const double time = time_of(end.near.tau) - time_of(start.near.tau);
    if (!bounds || time <= few_time_tolerances * options_.time_tolerance ||
        share_in_doubt(*bounds) * time <= options_.time_tolerance)
        return bounds;
    const double change = std::abs(end.near.distance - start.near.distance);
    const auto narrow = [&](double width) {
        return std::max(0.5 * change * options_.time_tolerance / time, narrowest * width);
    };
    const auto narrower = bounds_within({narrow(widths.start), narrow(widths.end)});
    return narrower && share_in_doubt(*narrower) * time <= options_.time_tolerance ? narrower : std::nullopt;
}

/// While the surfaces do not meet, what is inside stays inside.
DistanceBounds ProfileSearch::touching_bounds(const Knot& start, const Knot& end) {
    if (start.touch == Touch::nested && end.touch == Touch::nested) {
        const auto of_surfaces = chords_->between(start.near, end.near, std::nullopt);
        if (of_surfaces->lower.least() > 0)
            return {};
    }
    return of_bodies({{}, chords_->upper_between(start.near, end.near)});
}

DistanceBounds ProfileSearch::of_bodies(const DistanceBounds& of_surfaces) const {
    const auto less_radii = [&](const LinearBound& bound, double rounding) {
        return LinearBound{bound.start - radii_ + rounding, bound.end - radii_ + rounding};
    };
    const double rounding = 0x1p-50 * radii_;
    return {less_radii(of_surfaces.lower, -rounding), less_radii(of_surfaces.upper, rounding)};
}

double ProfileSearch::width_at(double distance) const {
    return std::max(options_.tolerance * (distance - radii_), options_.absolute_tolerance);
}

double ProfileSearch::time_of(double tau) const {
    const Bracket time = piece_->piece().time_of({tau, tau});
    return std::clamp(0.5 * (time.lower + time.upper), 0.0, 1.0);
}

/// The shares of a part at which a linear bound is equal to a value, in [0, 1].
std::optional<double> crossing_of(const LinearBound& bound, double value) {
    const double share = (value - bound.start) / (bound.end - bound.start);
    return share > 0 && share < 1 ? std::optional(share) : std::nullopt;
}

/// For what share of a part it is not known whether the distance is more than some margin.
double ProfileSearch::share_in_doubt(const DistanceBounds& bounds) const {
    double longest = 0;
    for (const double margin : options_.margins) {
        if (bounds.lower.least() > margin || bounds.upper.greatest() <= margin)
            continue;
        std::array<double, 4> shares{0, crossing_of(bounds.lower, margin).value_or(0),
                                     crossing_of(bounds.upper, margin).value_or(0), 1};
        std::ranges::sort(shares);
        double doubt = 0;
        for (std::size_t i = 0; i + 1 < shares.size(); ++i) {
            const double middle = 0.5 * (shares[i] + shares[i + 1]);
            if (bounds.lower.at(middle) <= margin && bounds.upper.at(middle) > margin)
                doubt += shares[i + 1] - shares[i];
        }
        longest = std::max(longest, doubt);
    }
    return longest;
}

/// Between the margins that the bounds cross.
void ProfileSearch::add_steps(const Knot& start, const Knot& end, const DistanceBounds& bounds) {
    std::vector<double> shares{0, 1};
    const auto cut = [&](const LinearBound& bound, double value) {
        if (const auto share = crossing_of(bound, value))
            shares.push_back(*share);
    };
    for (const double margin : options_.margins) { // steps that end there are on one side of it
        const double rounding = 0x1p-40 * std::max(margin, options_.absolute_tolerance);
        cut(bounds.lower, margin + rounding);
        cut(bounds.upper, margin - rounding);
    }
    cut(bounds.lower, 0);
    cut(bounds.upper, 0);
    std::ranges::sort(shares);
    const double from = start.near.tau, width = end.near.tau - start.near.tau;
    for (std::size_t i = 0; i + 1 < shares.size(); ++i) {
        const auto part = [&](const LinearBound& bound) {
            return LinearBound{std::max(0.0, bound.at(shares[i])), std::max(0.0, bound.at(shares[i + 1]))};
        };
        add_even_steps(from + shares[i] * width, from + shares[i + 1] * width,
                       {part(bounds.lower), part(bounds.upper)});
    }
}

/// Halves, until the bounds change little in each.
void ProfileSearch::add_even_steps(double from, double to, const DistanceBounds& bounds) {
    const auto change = [](const LinearBound& bound) { return std::abs(bound.end - bound.start); };
    const double width = std::max({options_.tolerance * bounds.lower.least(), options_.absolute_tolerance,
                                   bounds.upper.least() - bounds.lower.greatest()});
    const double middle = 0.5 * (from + to);
    if (std::max(change(bounds.lower), change(bounds.upper)) <= (1 - share_of_bounds) * width ||
        !(from < middle && middle < to)) {
        add_step(from, to, bounds.lower.least(), bounds.upper.greatest());
        return;
    }
    const auto earlier = [](const LinearBound& bound) { return LinearBound{bound.start, bound.at(0.5)}; };
    const auto later = [](const LinearBound& bound) { return LinearBound{bound.at(0.5), bound.end}; };
    add_even_steps(from, middle, {earlier(bounds.lower), earlier(bounds.upper)});
    add_even_steps(middle, to, {later(bounds.lower), later(bounds.upper)});
}

/// Steps between equal times are one.
void ProfileSearch::add_step(double from, double to, double lower, double upper) {
    DistanceProfile& p = profile_;
    if (p.times.empty())
        p.times.push_back(time_of(from));
    if (const double end = time_of(to); end > p.times.back()) {
        p.times.push_back(end);
        p.lower.push_back(lower);
        p.upper.push_back(upper);
    } else if (!p.lower.empty()) {
        p.lower.back() = std::min(p.lower.back(), lower);
        p.upper.back() = std::max(p.upper.back(), upper);
    }
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
    return ProfileSearch(question).run();
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
