#include "chasles/query/profile_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace chasles::query {

namespace {

using search::DistanceBounds;
using search::LinearBound;

/// The share of a part at which a line is equal to a value, in (0, 1).
std::optional<double> crossing_of(const LinearBound& line, double value) {
    const double share = (value - line.start) / (line.end - line.start);
    return share > 0 && share < 1 ? std::optional(share) : std::nullopt;
}

LinearBound part_of(const LinearBound& line, double from, double to) {
    return {line.at(from), to == 1 ? line.end : line.at(to)}; // not rounded to 0
}

LinearBound at_least(double least, const LinearBound& line) {
    return {std::max(least, line.start), std::max(least, line.end)};
}

/// The lower bound where no more is known than that nothing touches: the least normal number.
constexpr double apart = std::numeric_limits<double>::min();

/// Contacts are known up to a bracket, and times of steps are rounded.
constexpr double before_contact = 1e-12;

/// Raises bounds of 0 before a time. The step across the time is cut.
void set_apart_until(DistanceProfile& profile, double time) {
    auto& [times, lower, upper, certain, nearest, work] = profile;
    for (std::size_t i = 0; i + 1 < times.size() && times[i] < time; ++i) {
        if (lower[i] > 0)
            continue;
        if (times[i + 1] > time) {
            const auto next = std::ptrdiff_t(i) + 1;
            times.insert(times.begin() + next, time);
            lower.insert(lower.begin() + next, lower[i]);
            upper.insert(upper.begin() + next, upper[i]);
        }
        lower[i] = apart;
        upper[i] = std::max(upper[i], apart);
    }
}

} // namespace

double share_in_doubt(const DistanceBounds& bounds, std::span<const double> margins) {
    double longest = 0;
    for (const double margin : margins) {
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

double time_of(const motion::AnyPiece& piece, double tau) {
    const Bracket time = piece.time_of({tau, tau});
    return std::clamp(0.5 * (time.lower + time.upper), 0.0, 1.0);
}

void ProfileSteps::add(const Bracket& part, const DistanceBounds& lines, bool is_free) {
    const double least = is_free ? apart : 0;
    std::vector<double> shares{0, 1};
    const auto cut = [&](const LinearBound& line, double value) {
        if (const auto share = crossing_of(line, value))
            shares.push_back(*share);
    };
    for (const double margin : options_.margins) { // steps that end there are on one side of it
        const double rounding = 0x1p-40 * std::max(margin, options_.absolute_tolerance);
        cut(lines.lower, margin + rounding);
        cut(lines.upper, margin - rounding);
    }
    cut(lines.lower, 0);
    cut(lines.upper, 0);
    std::ranges::sort(shares);
    const auto tau_at = [&](double share) { return part.lower + share * (part.upper - part.lower); };
    for (std::size_t i = 0; i + 1 < shares.size(); ++i) {
        const double from = shares[i], to = shares[i + 1];
        add_even({tau_at(from), tau_at(to)},
                 {at_least(least, part_of(lines.lower, from, to)), at_least(least, part_of(lines.upper, from, to))});
    }
}

/// Halves, until the lines change little in each.
void ProfileSteps::add_even(const Bracket& part, const DistanceBounds& lines) {
    const auto& [lower, upper] = lines;
    const double change = std::max(std::abs(lower.end - lower.start), std::abs(upper.end - upper.start));
    const double width = std::max({options_.tolerance * lower.least(), options_.absolute_tolerance,
                                   upper.least() - lower.greatest()}); // no finer than the lines are wide
    const double middle = 0.5 * (part.lower + part.upper);
    if (change <= share_ * width || !(part.lower < middle && middle < part.upper)) {
        add_one(part, lower.least(), upper.greatest());
        return;
    }
    add_even({part.lower, middle}, {part_of(lower, 0, 0.5), part_of(upper, 0, 0.5)});
    add_even({middle, part.upper}, {part_of(lower, 0.5, 1), part_of(upper, 0.5, 1)});
}

void ProfileSteps::add_one(const Bracket& part, double lower, double upper) {
    if (profile_.times.empty())
        profile_.times.push_back(time_of(*piece_, part.lower));
    add_until(time_of(*piece_, part.upper), lower, upper);
}

/// Steps between equal times are one.
void ProfileSteps::add_until(double end, double lower, double upper) {
    DistanceProfile& p = profile_;
    if (end > p.times.back()) {
        p.times.push_back(end);
        p.lower.push_back(lower);
        p.upper.push_back(upper);
    } else if (!p.lower.empty()) {
        p.lower.back() = std::min(p.lower.back(), lower);
        p.upper.back() = std::max(p.upper.back(), upper);
    }
}

void ProfileSteps::add_rest(double lower, double upper) {
    if (profile_.times.empty())
        profile_.times.push_back(0);
    add_until(1, lower, upper);
}

DistanceProfile ProfileSteps::result(double clear_until) && {
    profile_.times.front() = 0; // clocks are rounded
    profile_.times.back() = 1;
    set_apart_until(profile_, clear_until == 1 ? 1 : clear_until - before_contact);
    profile_.lower.push_back(profile_.lower.back());
    profile_.upper.push_back(profile_.upper.back());
    return std::move(profile_);
}

} // namespace chasles::query
