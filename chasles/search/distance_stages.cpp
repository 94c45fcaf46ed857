#include "chasles/search/distance_stages.h"

#include "chasles/search/nearest_at_start.h"
#include "chasles/search/touch_stages.h"

#include <algorithm>

namespace chasles::search {

static_assert(LaterStages<DistanceStages>);

namespace {

/// Far above the rounding of a bracket to the whole piece.
constexpr double rim = 0x1p-45;
/// A pair has six crossings at most; the remaining steps test uncertain crossings in ever longer parts.
constexpr int most_steps = 60;

/// A part of the piece with a rim on either side.
culling::TimeRange part_from(double lower, double width) {
    return {std::max(0.0, lower - rim), std::min(1.0, lower + width + rim)};
}

culling::TimeRange common(const culling::TimeRange& a, const culling::TimeRange& b) {
    return {std::max(a.lower, b.lower), std::min(a.upper, b.upper)};
}

double width_of(const FeasibleInterval& tau) {
    return tau.upper - tau.lower;
}

} // namespace

DistanceStages::DistanceStages(PieceContext& context, const SearchOptions& options)
    : context_(context), options_(options), parts_(context.parts(options.margin)),
      filter_({context.moving(), context.fixed(), parts_.scale(), options.margin}, context.maps()),
      next_filter_(filter_), start_tests_(context.moving(), context.fixed(), parts_.scale()),
      overlaps_(context, parts_.scale()), candidates_({options.finds_any, options.tolerance, true, options.until}) {}

void DistanceStages::use(const culling::TimeRange& part) {
    if (part != filter_.part())
        filter_.use(part);
    is_at_start_ = options_.check_start && part.lower <= 0;
}

void DistanceStages::test_start(const TwoFaces& faces) {
    if (!is_at_start_ || is_over())
        return;
    start_tests_.use(context_.maps(), {});
    if (overlaps_.collect(start_tests_, faces))
        candidates_.end_at_start();
}

void DistanceStages::test(const FeaturePair& features) {
    FirstCrossing crossing(filter_tolerance(options_.tolerance / filter_.part().width()));
    WithinAtStart at_start;
    filter_.tests().distance(features, [&](const auto& problem) {
        if (is_at_start_)
            at_start(problem);
        crossing(problem);
    });
    test_at_start(features, at_start.answer());
    const auto found = filter_.in_piece(crossing.first());
    if (found)
        candidates_.add({features, *found}, *this);
}

void DistanceStages::test_at_start(const FeaturePair& features, WithinAtStart::Answer answer) {
    using enum WithinAtStart::Answer;
    if (is_over() || answer == no)
        return;
    if (answer == uncertain && are_within(context_, 0, features, options_.margin))
        answer = yes;
    if (answer == uncertain) {
        PartTests<algebra::DoubleDouble>& stage = refinement();
        stage.use({0, rim}); // over a short part, bounds follow the numbers
        WithinAtStart collect;
        stage.tests().distance(features, [&](const auto& problem) { collect(problem); });
        ++work_.refined;
        answer = collect.answer();
    }
    if (answer != no)
        candidates_.keep({features, {0, 0, answer == yes}});
}

PieceResult DistanceStages::take() {
    candidates_.settle(*this);
    // An uncertain overlap needs no decision if features are within the margin at the start. There may be none near it:
    // the edges inside flat parts are not tested.
    if (candidates_.best() > 0 && overlaps_.decide())
        candidates_.end_at_start();
    work_ += overlaps_.work();
    work_.elementary_tests += filter_.tests().workspace().elementary_tests;
    work_.root_brackets += filter_.tests().workspace().root_brackets;
    return {candidates_.take(), candidates_.searched_until(), overlaps_.found(), work_};
}

std::optional<FeasibleInterval> DistanceStages::narrow(const Candidate& candidate, const SearchState&) {
    const auto narrow = refined(candidate, part_from(candidate.tau.lower, width_of(candidate.tau)));
    return narrow && narrow->certain ? narrow : candidate.tau;
}

/// The filter's crossing may be none. Where double-double finds none in a part, the filter finds the next one, and the
/// part grows. Where double-double is uncertain, which may last for the length of the part, it starts over with the
/// shortest part.
std::optional<FeasibleInterval> DistanceStages::decide(const Candidate& candidate, const SearchState& state) {
    constexpr double shortest = 4 * rim;
    constexpr double growth = 64;
    FeasibleInterval next = candidate.tau;
    double width = std::max(4 * options_.tolerance, width_of(next));
    double after = 0; // there is no crossing before
    bool was_uncertain = false;
    for (int i = 0; i < most_steps; ++i) {
        culling::TimeRange where = part_from(next.lower, width);
        where.lower = std::max(where.lower, after);
        const auto crossing = state.is_final(next) ? next : refined(candidate, where);
        if (crossing && crossing->lower > state.best())
            return std::nullopt;
        if (crossing && (crossing->certain || width <= shortest))
            return crossing;
        if (crossing) {
            width = shortest;
            was_uncertain = true;
            next = *crossing;
            continue;
        }
        after = std::max(where.upper, next.lower + rim);
        const auto later = after < state.best() ? next_crossing(candidate, after) : std::nullopt;
        if (!later || later->lower > state.best())
            return std::nullopt;
        next = *later;
        // Where double-double was uncertain, the filter is uncertain for longer.
        width = std::max(width * growth, was_uncertain ? 0.0 : width_of(next));
    }
    return FeasibleInterval{next.lower, next.upper, false};
}

/// The filter's first crossing after a time.
std::optional<FeasibleInterval> DistanceStages::next_crossing(const FeaturePair& features, double after) {
    next_filter_.use({after, 1});
    return next_filter_.first_crossing(features, filter_tolerance(std::min(1.0, options_.tolerance / (1 - after))));
}

/// The first crossing in a part. Bounds follow the sizes of the numbers, so in ever shorter parts double often decides.
std::optional<FeasibleInterval> DistanceStages::refined(const FeaturePair& features, const culling::TimeRange& where) {
    constexpr double much_shorter = 0.25;
    for (culling::TimeRange part = where;;) {
        const auto crossing = in_double(features, part);
        if (crossing && candidates_.state().is_final(*crossing))
            return crossing;
        if (!crossing && part == where)
            return std::nullopt;
        const double width = part.width();
        if (crossing)
            part = common(part, part_from(crossing->lower, width_of(*crossing)));
        if (!crossing || part.width() > much_shorter * width)
            return in_double_double(features, where);
    }
}

/// Much narrower than the tolerance where that costs nothing: over a small margin, the direction of a contact turns
/// fast.
std::optional<FeasibleInterval> DistanceStages::in_double(const FeaturePair& features, const culling::TimeRange& part) {
    constexpr double narrow = 0x1p-6;
    next_filter_.use(part);
    return next_filter_.first_crossing(features,
                                       filter_tolerance(std::min(1.0, narrow * options_.tolerance / part.width())));
}

std::optional<FeasibleInterval> DistanceStages::in_double_double(const FeaturePair& features,
                                                                 const culling::TimeRange& where) {
    constexpr double finest = 0x1p-90;
    constexpr int restrictions = 600; // ordinary crossings take ten
    ++work_.refined;
    PartTests<algebra::DoubleDouble>& stage = refinement();
    stage.use(where);
    const double width = where.width();
    return stage.first_crossing(
        features, {std::min(1.0, 0.5 * options_.tolerance / width), std::min(1.0, finest / width), restrictions});
}

PartTests<algebra::DoubleDouble>& DistanceStages::refinement() {
    if (!refinement_)
        refinement_ = std::make_unique<PartTests<algebra::DoubleDouble>>(
            FeatureTests<algebra::DoubleDouble>(context_.moving(), context_.fixed(), parts_.scale(), options_.margin),
            context_.refined_maps());
    return *refinement_;
}

} // namespace chasles::search
