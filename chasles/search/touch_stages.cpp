#include "chasles/search/touch_stages.h"

#include <algorithm>

namespace chasles::search {

static_assert(LaterStages<TouchStages>);

TouchStages::TouchStages(PieceContext& context, const SearchOptions& options)
    : context_(context), options_(options), parts_(context.parts(0)),
      filter_(context.moving(), context.fixed(), parts_.scale()), filter_maps_(parts_),
      overlaps_(context, parts_.scale()), candidates_({options.finds_any, options.tolerance, false, options.until}) {}

void TouchStages::use(const culling::TimeRange& part) {
    part_ = part;
    if (filter_maps_.set(part))
        filter_.use(filter_maps_.maps(), filter_tolerance(options_.tolerance / part.width()));
}

void TouchStages::test_start(const TwoFaces& faces) {
    if (options_.check_start && part_.lower <= 0 && !is_over() && overlaps_.collect(filter_, faces))
        candidates_.end_at_start(); // nothing is earlier
}

void TouchStages::test(const FeaturePair& features) {
    if (const auto found = filter_.touch(features)) {
        const double upper = std::min(part_.upper, part_.at(found->upper));
        candidates_.add({features, {part_.at(found->lower), upper, found->certain}}, *this);
    }
}

std::optional<double> TouchStages::early_enough() {
    if (candidates_.simultaneous() < many_)
        return std::nullopt;
    many_ *= 2;
    return candidates_.early_enough(*this);
}

PieceResult TouchStages::take() {
    candidates_.settle(*this);
    // Last: where the bodies just touch at the start, their features have been found to.
    if (candidates_.state().proven_upper() > 0 && overlaps_.decide())
        candidates_.end_at_start();
    work_ += overlaps_.work();
    work_.elementary_tests += filter_.workspace().elementary_tests;
    work_.root_brackets += filter_.workspace().root_brackets;
    return {candidates_.take(), candidates_.searched_until(), overlaps_.found(), work_};
}

std::optional<FeasibleInterval> TouchStages::decide(const Candidate& candidate, const SearchState& state) {
    ++work_.refined;
    const auto refined = refinement(refinement_tolerance(options_.tolerance, candidate.tau)).touch(candidate);
    if (!refined || refined->lower > state.best())
        return std::nullopt;
    if (state.is_final(*refined))
        return refined;
    if (state.is_within_tolerance_of_proven(*refined))
        return FeasibleInterval{refined->lower, 1, refined->certain}; // as it may be no contact, it ends nothing
    const auto decided = decide_exactly(candidate, *refined);
    return decided && decided->lower <= state.best() ? decided : std::nullopt;
}

/// The exact answer unless it says less than the refined one.
std::optional<FeasibleInterval> TouchStages::decide_exactly(const FeaturePair& features,
                                                            const FeasibleInterval& refined) {
    if (!exact_stage())
        return refined;
    ++work_.exact;
    decided_exactly_.insert(features);
    const auto decided = exact_stage()->first_contact_of(features, options_.tolerance);
    return !decided || decided->certain || decided->lower > refined.lower ? decided : refined;
}

std::optional<FeasibleInterval> TouchStages::narrow(const Candidate& candidate, const SearchState& state) {
    if (candidate.tau.lower <= 0)
        return candidate.tau;
    const auto decided = decide(candidate, state);
    return decided && !decided->certain ? candidate.tau : decided;
}

FeatureTests<algebra::DoubleDouble>& TouchStages::refinement(const algebra::Tolerance& tolerance) {
    if (!refinement_)
        refinement_ =
            std::make_unique<FeatureTests<algebra::DoubleDouble>>(context_.moving(), context_.fixed(), parts_.scale());
    refinement_->use(context_.refined_maps(), tolerance);
    return *refinement_;
}

ExactStage* TouchStages::exact_stage() {
    if (!exact_stage_)
        if (const auto* maps = context_.exact_maps())
            exact_stage_ = std::make_unique<ExactStage>(context_.moving(), context_.fixed(), *maps);
    return exact_stage_.get();
}

} // namespace chasles::search
