#include "chasles/search/enclosed_stages.h"

#include "chasles/search/nearest_at_start.h"
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
/// hundreds. Features that touch for long, such as flush sides, end as not certain.
constexpr int most_refinements = 800;
constexpr int most_refinements_of_speeds = 4000; // of motions that are known in double only
/// Features that stay 1e-9 of their size apart need some thousand parts (note 34). So each part that is longer than
/// this and holds no contact allows for more refinements, while the search has some to spare.
constexpr double long_part = 0x1p-17;
constexpr int refinements_for_a_long_part = 4;
/// Of a limit, in pairs of nodes.
constexpr int work_of_a_part = 32;

/// How a search over a part looks for brackets of this width in the part.
template <class S>
algebra::Tolerance part_tolerance(double width) {
    if constexpr (std::is_same_v<S, double>)
        return filter_tolerance(width);
    constexpr double finest = 0x1p-90;
    constexpr int restrictions = 200;
    return {width, std::min(width, finest), restrictions};
}

template <class S>
motion::Enclosure<S> enclosure_of(const motion::AnyPiece& piece, const culling::TimeRange& part) {
    if constexpr (std::is_same_v<S, double>)
        return *piece.enclosure({part.lower, part.upper});
    else
        return *piece.refined_enclosure({part.lower, part.upper});
}

motion::ControlMaps<double> maps_of(const motion::RationalMotion<double>& cubic) {
    return motion::double_maps(cubic);
}
motion::ControlMaps<algebra::DoubleDouble> maps_of(const motion::RationalMotion<algebra::DoubleDouble>& cubic) {
    return motion::control_maps(cubic);
}

} // namespace

template <bool within_margin>
template <class S>
void EnclosedStages<within_margin>::PartTests<S>::use(const culling::TimeRange& part) {
    if (part == part_)
        return;
    part_ = part;
    tolerance_ = part_tolerance<S>(std::min(1.0, time_tolerance_ / part.width()));
    const motion::Enclosure<S> enclosure = enclosure_of<S>(piece_, part);
    bounds_ = enclosure.bounds;
    maps_ = maps_of(enclosure.cubic);
    tests_.use(maps_, parts_.scale_of(enclosure, maps_), tolerance_);
}

/// Ends of brackets are rounded outward. A contact is proven only where no point of the moving body goes far (note 24,
/// "Features"). A direction separates slivers that the test of the features does not separate (note 34).
template <bool within_margin>
template <class S>
std::optional<FeasibleInterval> EnclosedStages<within_margin>::PartTests<S>::first(const FeaturePair& features) {
    std::optional<FeasibleInterval> found;
    if constexpr (within_margin) {
        FirstCrossing collect(tolerance_); // NOLINT(misc-const-correctness): changed through the generic lambda
        tests_.distance(features, [&](const auto& problem) { collect(problem); });
        found = collect.first();
    } else {
        found = tests_.touch(features);
    }
    if (found && !found->certain && tests_.are_apart(features))
        return std::nullopt;
    constexpr double rounding = 0x1p-51;
    if (found)
        found = FeasibleInterval{std::max(part_.lower, part_.at(found->lower) * (1 - rounding)),
                                 std::min(part_.upper, part_.at(found->upper) * (1 + rounding)),
                                 found->certain && parts_.is_short(bounds_)};
    return found;
}

template <bool within_margin>
template <class S>
WithinAtStart::Answer EnclosedStages<within_margin>::PartTests<S>::within_at_start(const FeaturePair& features) {
    using enum WithinAtStart::Answer;
    WithinAtStart collect; // NOLINT(misc-const-correctness): changed through the generic lambda
    tests_.distance(features, [&](const auto& problem) { collect(problem); });
    return collect.answer() == uncertain && tests_.are_apart(features) ? no : collect.answer();
}

template <bool within_margin>
EnclosedStages<within_margin>::EnclosedStages(PieceContext& context, const SearchOptions& options)
    : context_(context), options_(options), parts_(context.parts(options.margin)), filter_(context, options, parts_),
      shorter_(context, options, parts_), start_tests_(context.moving(), context.fixed(), parts_.scale()),
      overlaps_(context, parts_.scale()),
      candidates_({options.finds_any, options.tolerance, within_margin, options.until}) {
    start_tests_.use(context.maps(), {});
}

template <bool within_margin>
double EnclosedStages<within_margin>::culling_margin() const {
    return within_margin ? options_.margin + elementary::parallel_slack * parts_.scale().length : 0;
}

template <bool within_margin>
void EnclosedStages<within_margin>::use(const culling::TimeRange& part) {
    part_ = part; // most pairs of faces have no features to test
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
    filter_.use(part_);
    if (auto found = filter_.first(features)) {
        // So far the contact may be anywhere in the part, and just after it: at its very end no sign changes.
        if (!found->certain)
            found->upper = std::min(1.0, part_.at(1.25));
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
    shorter_.use(short_part);
    auto answer = shorter_.within_at_start(features);
    if (answer == uncertain && are_within(context_, 0, features, options_.margin))
        answer = yes;
    if (answer == uncertain && can_refine()) {
        ++work_.refined;
        refinement_->use(short_part);
        answer = refinement_->within_at_start(features);
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
    for (const PartTests<double>* part : {&filter_, &shorter_}) {
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
    int most_steps = context_.piece().is_refined() ? most_refinements : most_refinements_of_speeds;
    double proven_upper = where.certain ? where.upper : never;
    later_.clear();
    culling::TimeRange part{where.lower, where.upper};
    for (int step = 0; part.lower <= state.best(); ++step) {
        if (watch_.is_over(work_of_a_part))
            throw Stopped{options_.from};
        tests.use(part);
        const auto found = tests.first(features);
        if (!found) {
            if (later_.empty())
                return std::nullopt;
            if (part.width() > long_part && spare_refinements_ > 0) {
                most_steps += refinements_for_a_long_part;
                spare_refinements_ -= refinements_for_a_long_part;
            }
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
        if (is_narrow || !tests.is_worth_shortening() || part.width() <= shortest || step > most_steps)
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
    if (!refinement_ && context_.piece().is_refined())
        refinement_ = std::make_unique<RefinedTests>(context_, options_, parts_);
    return refinement_ != nullptr;
}

/// In double-double, within what double leaves in doubt. Of features that graze for long a contact is proven, but not
/// when: that is not certain.
template <bool within_margin>
std::optional<FeasibleInterval> EnclosedStages<within_margin>::refine(const FeaturePair& features,
                                                                      const FeasibleInterval& where,
                                                                      const SearchState& state) {
    ++work_.refined;
    auto found = follow(*refinement_, features, where, state);
    if (found)
        found->certain = found->certain && found->upper - found->lower <= options_.tolerance;
    return found;
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
    if (!narrow || !narrow->certain)
        return narrow ? std::optional(candidate.tau) : std::nullopt;
    return state.is_final(*narrow) || !can_refine() ? narrow : refine(candidate, *narrow, state);
}

template class EnclosedStages<false>;
template class EnclosedStages<true>;

} // namespace chasles::search
