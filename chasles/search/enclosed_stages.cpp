#include "chasles/search/enclosed_stages.h"

#include "chasles/search/distance_crossing.h"
#include "chasles/search/touch_stages.h"

#include <algorithm>

namespace chasles::search {

static_assert(LaterStages<EnclosedStages<false>>);
static_assert(LaterStages<EnclosedStages<true>>);

namespace {

/// Parts of the piece are not divided below this width in tau.
constexpr double shortest_part = 0x1p-50;
/// A part in which features may touch for long is refined by its first eighth.
constexpr double first_share = 0.125;
/// Ordinary refinements take six steps, grazing ones some sixty.
constexpr int most_steps = 400;

} // namespace

template <bool within_margin>
void EnclosedStages<within_margin>::PartTests::use(const culling::TimeRange& part, double tolerance) {
    if (maps.set(part))
        tests.use(maps.maps(), maps.scale(), filter_tolerance(std::min(1.0, tolerance / part.width())));
}

template <bool within_margin>
std::optional<FeasibleInterval> EnclosedStages<within_margin>::PartTests::first(const FeaturePair& features,
                                                                                double tolerance) {
    const culling::TimeRange& part = maps.part();
    std::optional<FeasibleInterval> found;
    if constexpr (within_margin) {
        FirstCrossing collect(filter_tolerance(std::min(1.0, tolerance / part.width())));
        tests.distance(features, [&](const auto& problem) { collect(problem); });
        if (collect.first())
            found = collect.first()->tau;
    } else {
        found = tests.touch(features);
    }
    if (found) {
        constexpr double rounding = 0x1p-51;
        found->lower = std::max(part.lower, part.at(found->lower) * (1 - rounding));
        found->upper = std::min(part.upper, part.at(found->upper) * (1 + rounding));
        // A contact is proven only where no part of the moving body goes far (note 24, "Features").
        found->certain = found->certain && maps.is_short();
    }
    return found;
}

template <bool within_margin>
EnclosedStages<within_margin>::EnclosedStages(PieceContext& context, const SearchOptions& options)
    : context_(context), options_(options), parts_(context.parts(options.margin)),
      filter_{{context.moving(), context.fixed(), parts_.scale(), options.margin}, culling::PartMaps(parts_)},
      shorter_(filter_), start_tests_(context.moving(), context.fixed(), parts_.scale(), options.margin),
      overlaps_(context, parts_.scale()), candidates_({options.finds_any, options.tolerance, within_margin}) {
    start_tests_.use(context.maps(), {});
}

template <bool within_margin>
double EnclosedStages<within_margin>::culling_margin() const {
    return within_margin ? options_.margin + elementary::parallel_slack * parts_.scale().length : 0;
}

template <bool within_margin>
void EnclosedStages<within_margin>::use(const culling::TimeRange& part) {
    filter_.use(part, options_.tolerance);
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
    if (auto found = filter_.first(features, options_.tolerance)) {
        if (!found->certain)
            found->upper = filter_.maps.part().upper; // so far the contact may be anywhere in the part
        candidates_.add({features, *found}, *this);
    }
}

/// Whether the features are within the margin at the start. The end poses have no deviation but their rounding.
template <bool within_margin>
void EnclosedStages<within_margin>::test_at_start(const FeaturePair& features) {
    if (is_over())
        return;
    WithinAtStart collect;
    start_tests_.distance(features, [&](const auto& problem) { collect(problem); });
    if (collect.answer() != WithinAtStart::Answer::no)
        candidates_.keep({features, {0, 0, collect.answer() == WithinAtStart::Answer::yes}});
}

template <bool within_margin>
PieceResult EnclosedStages<within_margin>::take() {
    candidates_.settle(*this);
    if (candidates_.best() > 0 && overlaps_.decide())
        candidates_.end_at_start();
    work_ += overlaps_.work();
    for (const PartTests* part : {&filter_, &shorter_}) {
        work_.elementary_tests += part->tests.workspace().elementary_tests;
        work_.root_brackets += part->tests.workspace().root_brackets;
    }
    return {candidates_.take(), candidates_.searched_until(), overlaps_.found(), work_};
}

/// Tests ever shorter parts, the earliest first. The bracket of a proven contact is the next part; it is far shorter,
/// as brackets are as wide as the deviation, which falls with the square of the width.
template <bool within_margin>
std::optional<FeasibleInterval> EnclosedStages<within_margin>::decide(const Candidate& candidate,
                                                                      const SearchState& state) {
    constexpr double never = 2;
    double proven_upper = candidate.tau.certain ? candidate.tau.upper : never;
    later_.clear();
    culling::TimeRange part{candidate.tau.lower, candidate.tau.upper};
    ++work_.refined;
    for (int step = 0; part.lower <= state.best(); ++step) {
        shorter_.use(part, options_.tolerance);
        const auto found = shorter_.first(candidate, options_.tolerance);
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
        if (is_narrow || !shorter_.maps.is_worth_shortening() || part.width() <= shortest_part || step > most_steps)
            return FeasibleInterval{found->lower, is_proven ? proven_upper : found->upper, is_proven};
        const double upper = found->certain ? found->upper : part.upper;
        const double share = found->certain ? 0.5 : first_share;
        part = {found->lower, std::min(upper, found->lower + share * part.width())};
        if (part.upper < upper)
            later_.push_back({part.upper, upper});
    }
    return std::nullopt;
}

template <bool within_margin>
std::optional<FeasibleInterval> EnclosedStages<within_margin>::narrow(const Candidate& candidate,
                                                                      const SearchState& state) {
    const auto narrow = decide(candidate, state);
    return narrow && !narrow->certain ? candidate.tau : narrow;
}

template class EnclosedStages<false>;
template class EnclosedStages<true>;

} // namespace chasles::search
