#include "chasles/search/enclosed_stages.h"

#include "chasles/search/distance_crossing.h"
#include "chasles/search/touch_stages.h"

#include <algorithm>

namespace chasles::search {

static_assert(LaterStages<EnclosedStages<false>>);
static_assert(LaterStages<EnclosedStages<true>>);

namespace {

/// Parts of the piece are not divided below this width in tau, nor below half of the tolerance.
constexpr double shortest_part = 0x1p-44;
/// A part in which features may touch for long is refined by its first eighth.
constexpr double first_share = 0.125;
/// Ordinary refinements take six steps, grazing ones some sixty, and those of motions with a bound of speed only some
/// hundreds.
constexpr int most_refinements = 4000;

/// The first time in [0, 1] of the maps.
template <bool within_margin, class S>
std::optional<FeasibleInterval> first_time(FeatureTests<S>& tests, const FeaturePair& features,
                                           const algebra::Tolerance& tolerance) {
    if constexpr (within_margin) {
        FirstCrossing collect(tolerance); // NOLINT(misc-const-correctness): changed through the generic lambda
        tests.distance(features, [&](const auto& problem) { collect(problem); });
        return collect.first() ? std::optional(collect.first()->tau) : std::nullopt;
    } else {
        return tests.touch(features);
    }
}

template <class S>
WithinAtStart::Answer within_at_start(FeatureTests<S>& tests, const FeaturePair& features) {
    WithinAtStart collect;
    tests.distance(features, [&](const auto& problem) { collect(problem); });
    return collect.answer();
}

/// In terms of the whole piece. Ends of brackets are rounded outward. A contact is proven only where no point of the
/// moving body goes far (note 24, "Features").
std::optional<FeasibleInterval> in_piece(std::optional<FeasibleInterval> found, const culling::TimeRange& part,
                                         bool is_short) {
    constexpr double rounding = 0x1p-51;
    if (found)
        found =
            FeasibleInterval{std::max(part.lower, part.at(found->lower) * (1 - rounding)),
                             std::min(part.upper, part.at(found->upper) * (1 + rounding)), found->certain && is_short};
    return found;
}

/// How the refinement in double-double searches.
algebra::Tolerance refined_tolerance(double width) {
    constexpr double finest = 0x1p-90;
    constexpr int restrictions = 200;
    return {width, std::min(width, finest), restrictions};
}

} // namespace

template <bool within_margin>
void EnclosedStages<within_margin>::PartTests::use(const culling::TimeRange& part) {
    if (maps_.set(part))
        tests_.use(maps_.maps(), maps_.scale(), filter_tolerance(std::min(1.0, tolerance_ / part.width())));
}

template <bool within_margin>
std::optional<FeasibleInterval> EnclosedStages<within_margin>::PartTests::first(const FeaturePair& features) {
    const algebra::Tolerance tolerance = filter_tolerance(std::min(1.0, tolerance_ / part().width()));
    return in_piece(first_time<within_margin>(tests_, features, tolerance), part(), maps_.is_short());
}

template <bool within_margin>
void EnclosedStages<within_margin>::RefinedPartTests::use(const culling::TimeRange& part) {
    const auto enclosure = *piece_.refined_enclosure({part.lower, part.upper});
    part_ = part;
    bounds_ = enclosure.bounds;
    maps_ = motion::control_maps(enclosure.cubic);
    tests_.use(maps_, parts_.refined_scale_of(bounds_), refined_tolerance(std::min(1.0, tolerance_ / part.width())));
}

template <bool within_margin>
std::optional<FeasibleInterval> EnclosedStages<within_margin>::RefinedPartTests::first(const FeaturePair& features) {
    const algebra::Tolerance tolerance = refined_tolerance(std::min(1.0, tolerance_ / part_.width()));
    return in_piece(first_time<within_margin>(tests_, features, tolerance), part_, parts_.is_short(bounds_));
}

template <bool within_margin>
EnclosedStages<within_margin>::EnclosedStages(PieceContext& context, const SearchOptions& options)
    : context_(context), options_(options), parts_(context.parts(options.margin)), filter_(context, options, parts_),
      shorter_(context, options, parts_),
      start_tests_(context.moving(), context.fixed(), parts_.scale(), options.margin),
      overlaps_(context, parts_.scale()), candidates_({options.finds_any, options.tolerance, within_margin}) {
    start_tests_.use(context.maps(), {});
}

template <bool within_margin>
double EnclosedStages<within_margin>::culling_margin() const {
    return within_margin ? options_.margin + elementary::parallel_slack * parts_.scale().length : 0;
}

template <bool within_margin>
void EnclosedStages<within_margin>::use(const culling::TimeRange& part) {
    filter_.use(part);
    is_at_start_ = options_.check_start && part.lower <= 0;
}

template <bool within_margin>
void EnclosedStages<within_margin>::test_start(const TwoFaces& faces) {
    if (is_at_start_ && !is_over() && overlaps_.collect(start_tests_, faces))
        candidates_.end_at_start(); // nothing is earlier
}

template <bool within_margin>
void EnclosedStages<within_margin>::test(const FeaturePair& features) {
    if (within_margin && is_at_start_)
        test_at_start(features);
    if (auto found = filter_.first(features)) {
        // So far the contact may be anywhere in the part, and just after it: at its very end no sign changes.
        if (!found->certain)
            found->upper = std::min(1.0, filter_.part().at(1.25));
        candidates_.add({features, *found}, *this);
    }
}

/// Whether the features are within the margin at the start. The end poses have no deviation but their rounding. Over a
/// short part, bounds follow the numbers.
template <bool within_margin>
void EnclosedStages<within_margin>::test_at_start(const FeaturePair& features) {
    using enum WithinAtStart::Answer;
    if (is_over())
        return;
    constexpr culling::TimeRange short_part{0, 0x1p-45};
    auto answer = within_at_start(start_tests_, features);
    if (answer == uncertain) {
        if (can_refine()) {
            refinement_->use(short_part);
            answer = within_at_start(refinement_->tests(), features);
        } else {
            shorter_.use(short_part);
            answer = within_at_start(shorter_.tests(), features);
        }
        ++work_.refined;
    }
    if (answer != no)
        candidates_.keep({features, {0, 0, answer == yes}});
}

template <bool within_margin>
PieceResult EnclosedStages<within_margin>::take() {
    is_settling_ = true;
    candidates_.settle(*this);
    if (candidates_.best() > 0 && overlaps_.decide())
        candidates_.end_at_start();
    work_ += overlaps_.work();
    for (const PartTests* part : {&filter_, &shorter_}) {
        work_.elementary_tests += part->workspace().elementary_tests;
        work_.root_brackets += part->workspace().root_brackets;
    }
    return {candidates_.take(), candidates_.searched_until(), overlaps_.found(), work_};
}

/// Tests ever shorter parts of a bracket, the earliest first. The bracket of a proven contact is the next part; it is
/// far shorter, as a bracket is as wide as the deviation, which falls with the square of the width or faster.
template <bool within_margin>
template <class Tests>
std::optional<FeasibleInterval> EnclosedStages<within_margin>::follow(Tests& tests, const FeaturePair& features,
                                                                      const FeasibleInterval& where,
                                                                      const SearchState& state) {
    constexpr double never = 2;
    const double shortest = std::min(shortest_part, 0.5 * options_.tolerance);
    double proven_upper = where.certain ? where.upper : never;
    later_.clear();
    culling::TimeRange part{where.lower, where.upper};
    for (int step = 0; part.lower <= state.best(); ++step) {
        tests.use(part);
        const auto found = tests.first(features);
        if (!found) {
            if (later_.empty())
                return std::nullopt;
            part = later_.back();
            later_.pop_back();
            continue;
        }
        if (found->certain) {
            proven_upper = std::min(proven_upper, found->upper);
            later_.clear();
        }
        const bool is_proven = proven_upper < never;
        const bool is_narrow = is_proven && proven_upper - found->lower <= options_.tolerance;
        if (is_narrow || !tests.is_worth_shortening() || part.width() <= shortest || step > most_refinements)
            return FeasibleInterval{found->lower, is_proven ? proven_upper : found->upper, is_proven};
        const double upper = found->certain ? found->upper : part.upper;
        const double share = found->certain ? 0.5 : first_share;
        part = {found->lower, std::min(upper, found->lower + share * part.width())};
        if (part.upper < upper)
            later_.push_back({part.upper, upper});
    }
    return std::nullopt;
}

/// Whether the trajectory is known in double-double.
template <bool within_margin>
bool EnclosedStages<within_margin>::can_refine() {
    if (!refinement_ && context_.piece().refined_enclosure({0, 0}))
        refinement_ = std::make_unique<RefinedPartTests>(context_, options_, parts_);
    return refinement_ != nullptr;
}

/// In double-double, within what double leaves in doubt.
template <bool within_margin>
std::optional<FeasibleInterval> EnclosedStages<within_margin>::refine(const FeaturePair& features,
                                                                      const FeasibleInterval& where,
                                                                      const SearchState& state) {
    ++work_.refined;
    return follow(*refinement_, features, where, state);
}

template <bool within_margin>
std::optional<FeasibleInterval> EnclosedStages<within_margin>::decide(const Candidate& candidate,
                                                                      const SearchState& state) {
    const auto found = follow(shorter_, candidate, candidate.tau, state);
    const bool may_stay_wide = found && found->certain && !is_settling_; // is narrowed at the end if it still matters
    if (!found || may_stay_wide || state.is_final(*found) || !can_refine())
        return found;
    const double upper = found->certain ? found->upper : std::max(found->upper, candidate.tau.upper);
    const auto refined = refine(candidate, {found->lower, upper, found->certain}, state);
    return !refined && found->certain ? found : refined;
}

template <bool within_margin>
std::optional<FeasibleInterval> EnclosedStages<within_margin>::narrow(const Candidate& candidate,
                                                                      const SearchState& state) {
    auto narrow = follow(shorter_, candidate, candidate.tau, state);
    if (narrow && narrow->certain && !state.is_final(*narrow) && can_refine())
        narrow = refine(candidate, *narrow, state);
    return narrow && !narrow->certain ? candidate.tau : narrow;
}

template class EnclosedStages<false>;
template class EnclosedStages<true>;

} // namespace chasles::search
