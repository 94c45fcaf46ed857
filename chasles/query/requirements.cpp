#include "chasles/query/requirements.h"

#include "chasles/algebra/rounding_mode.h"
#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"

#include <algorithm>
#include <cmath>

namespace chasles::query {

namespace {

/// The largest coordinate of a scene (docs/decisions/0012-range-of-coordinates.md).
constexpr double largest_margin = 1e30;

} // namespace

void require(bool holds, const char* option, const char* why) {
    if (!holds)
        throw InvalidInput(std::string("query: ") + option + ": " + why);
}

void require_hold(double hold) {
    require(hold >= 0 && hold <= largest_margin, "hold", "must be in [0, 1e30]");
}

void check_options(const QueryOptions& options) {
    check_options(options, options.margin);
}

void check_options(const QueryOptions& options, double of_some_pair) {
    require(algebra::rounds_to_nearest(), "floating point", "must round to nearest; it is set to round otherwise");
    require(options.margin >= 0 && options.margin <= largest_margin, "margin", "must be in [0, 1e30]");
    if (options.hold) {
        require_hold(*options.hold);
        if (!(*options.hold < of_some_pair))
            throw InvalidInput(
                "query: hold: " + number_text(*options.hold) + " is not less than the margin" +
                (of_some_pair > 0 ? ' ' + number_text(of_some_pair) : ", which is 0 unless one is given"));
    }
    require(options.time_tolerance >= 1e-15 && options.time_tolerance <= 1, "time_tolerance", "must be in [1e-15, 1]");
}

void check_options(const LeastDistanceOptions& options) {
    require(options.tolerance >= 1e-12 && options.tolerance <= 1, "tolerance", "must be in [1e-12, 1]");
    require(options.find != Find::any, "find", "a least distance has no use for `any`");
    check_options(QueryOptions{.time_tolerance = options.time_tolerance});
}

void check_options(const ProfileOptions& options) {
    check_options(QueryOptions{});
    require(options.tolerance >= 1e-4 && options.tolerance <= 1, "tolerance", "must be in [1e-4, 1]");
    require(options.absolute_tolerance >= 0 && std::isfinite(options.absolute_tolerance), "absolute_tolerance",
            "must be at least 0, and finite");
    require(options.time_tolerance >= 1e-9 && options.time_tolerance <= 1, "time_tolerance", "must be in [1e-9, 1]");
    for (const double margin : options.margins)
        check_options(QueryOptions{.margin = margin});
}

std::string refusal_of(const Body& moving, const Body& fixed, const motion::AnyTrajectory& trajectory) {
    constexpr double farthest = 1e10;
    const double size = trajectory.size(),
                 radius = std::max(moving.bvh().radius() + moving.radius(), fixed.bvh().radius() + fixed.radius());
    if (size <= farthest * radius || !trajectory.pieces()->at(0)->enclosure({0, 1}))
        return {};
    return "goes up to " + number_text(size, 3) + " far, more than 1e10 times the radius of the larger body, " +
           number_text(radius, 3) + ", where rounding would decide; a screw or a sweep may, for they are exact";
}

void require_near(const Body& moving, const Body& fixed, std::span<const Motion> motions) {
    for (std::size_t i = 0; i < motions.size(); ++i)
        if (const std::string why = refusal_of(moving, fixed, motions[i].trajectory()); !why.empty())
            throw InvalidInput("motions[" + std::to_string(i) + "]: " + why);
}

void require_near(const Body& moving, const Body& fixed, const motion::AnyTrajectory& trajectory) {
    if (const std::string why = refusal_of(moving, fixed, trajectory); !why.empty())
        throw InvalidInput("motion: " + why);
}

} // namespace chasles::query
