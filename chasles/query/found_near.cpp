#include "chasles/query/found_near.h"

#include "chasles/query/overlaps.h"

#include <algorithm>
#include <utility>

namespace chasles::query {

namespace {

/// What is in doubt and begins no earlier than a proven contact by more waits until that one's bracket is narrow.
constexpr double hardly_later = 0x1p-30;
/// Far above the rounding of a bracket to the whole piece.
constexpr double rim = 0x1p-45;
/// Crossings of one pair that do not count: it has three at most on a convex part of a face, and six on other features.
constexpr int most_crossings = 16;

} // namespace

void FoundNear::add(const FeaturePair& features, const Crossing& crossing) {
    if (stop_ || crossing.tau.lower > best_ || (search_.held && search_.held->has(features)))
        return;
    if (crossing.tau.certain && !search_.held)
        return keep(features, crossing.tau);
    if (is_near_a_proven_contact(crossing.tau))
        waiting_.push_back({features, crossing.tau});
    else if (const auto tau = first_that_counts(features, crossing))
        keep(features, *tau);
}

void FoundNear::add_at_start(const FeaturePair& features, WithinAtStart::Answer answer) {
    using enum WithinAtStart::Answer;
    if (stop_ || answer == no)
        return;
    if (answer == may_be) {
        NearStage<algebra::DoubleDouble>& stage = refinement().near;
        stage.use({});
        WithinAtStart ask;
        stage.pairs().pair(features, [&](const auto& problem) { ask(problem); });
        ++result_.work.refined;
        answer = ask.answer();
    }
    if (answer != no)
        keep(features, {0, 0, answer == yes});
}

void FoundNear::add(const Overlap& found) {
    if (stop_)
        return;
    auto& pairs = refinement().touching;
    pairs.use(refinement().maps, {});
    ++result_.work.refined;
    const auto overlap = query::refined(found, pairs, search_.frame);
    if (!overlap || !overlap->certain) // an edge that hardly passes is within the margin of what it hardly passes
        return;
    result_.overlap = overlap;
    best_ = 0;
    stop_ = search_.find != Find::first_with_all_contacts;
}

PieceResult FoundNear::take() {
    narrow_brackets();
    std::erase_if(result_.candidates, [&](const Candidate& c) { return c.tau.lower > best_; });
    return std::move(result_);
}

void FoundNear::keep(const FeaturePair& features, const FeasibleInterval& tau) {
    result_.candidates.push_back({features, tau});
    best_ = std::min(best_, tau.upper);
    if (tau.certain)
        certain_ = std::min(certain_, tau.upper);
    stop_ = search_.find == Find::any || (search_.find == Find::first && tau.upper <= 0);
}

/// Last: what was found is asked again, the surest first, so that most of it falls behind the first contact.
void FoundNear::narrow_brackets() {
    std::vector<Candidate> found = std::exchange(result_.candidates, {});
    std::ranges::stable_sort(found, {}, [](const Candidate& c) { return c.tau.upper; });
    for (const Candidate& candidate : found) {
        if (candidate.tau.lower > best_)
            continue;
        const bool is_wide = candidate.tau.certain && candidate.tau.upper > 0 && !is_decided(candidate.tau);
        const auto narrow = is_wide ? refined(candidate, candidate.tau) : std::nullopt;
        keep(candidate, narrow && narrow->tau.certain ? narrow->tau : candidate.tau);
    }
    for (const Candidate& candidate : waiting_) {
        const bool is_listed = search_.find == Find::first_with_all_contacts;
        if (candidate.tau.lower > best_ || (!is_listed && certain_ - search_.tolerance <= candidate.tau.lower))
            continue;
        if (const auto tau = first_that_counts(candidate, {candidate.tau, false}))
            keep(candidate, *tau);
    }
}

bool FoundNear::is_near_a_proven_contact(const FeasibleInterval& tau) const {
    return tau.lower > 0 && certain_ - tau.lower <= hardly_later;
}

bool FoundNear::is_decided(const FeasibleInterval& tau) const {
    return tau.certain && tau.upper - tau.lower <= search_.tolerance;
}

/// Without contacts that are held, every crossing is one of features that were farther apart. Otherwise one that is no
/// local minimum is that of a contact which spreads or slides, and one that leaves the margin is none.
bool FoundNear::counts(const FeaturePair& features, const Crossing& crossing) const {
    if (!search_.held)
        return true;
    if (crossing.leaves)
        return false;
    const Instant instant(search_.moving, search_.fixed, numbers_.maps, crossing.tau.lower);
    const NearestPoints nearest = instant.nearest(features);
    const double travel = instant.velocity_at(nearest.on_moving).norm() * (crossing.tau.upper - crossing.tau.lower);
    const double error = elementary::error_unit<double> * numbers_.scale.length + travel;
    return instant.is_local_minimum(features, nearest, 4 * error / search_.margin);
}

/// From what the filter found on. Where double-double finds nothing there, the filter is asked what comes next.
std::optional<FeasibleInterval> FoundNear::first_that_counts(const FeaturePair& features, const Crossing& found) {
    FeasibleInterval looked_at = found.tau;
    for (int i = 0; i < most_crossings; ++i) {
        const auto crossing = is_decided(looked_at) && i == 0 ? std::optional(found) : refined(features, looked_at);
        if (crossing && crossing->tau.lower > best_)
            return std::nullopt;
        if (crossing && counts(features, *crossing))
            return crossing->tau;
        const double after = std::max(crossing ? crossing->tau.upper : looked_at.upper, looked_at.lower + rim);
        if (after >= best_)
            return std::nullopt;
        filter_.use({after, 1});
        const double width = search_.tolerance / filter_.part().width();
        const auto next = filter_.first_crossing(features, filter_tolerance(std::min(1.0, width)));
        if (!next || next->tau.lower > best_)
            return std::nullopt;
        looked_at = next->tau;
    }
    looked_at.certain = false;
    return looked_at;
}

/// The first crossing as double-double sees it, where the filter found one.
std::optional<Crossing> FoundNear::refined(const FeaturePair& features, const FeasibleInterval& found) {
    constexpr double finest = 0x1p-90;
    constexpr int restrictions = 60;
    ++result_.work.refined;
    NearStage<algebra::DoubleDouble>& stage = refinement().near;
    stage.use({std::max(0.0, found.lower - rim), std::min(1.0, found.upper + rim)});
    const double width = stage.part().width();
    return stage.first_crossing(
        features, {std::min(1.0, 0.5 * search_.tolerance / width), std::min(1.0, finest / width), restrictions});
}

FoundNear::Refinement& FoundNear::refinement() {
    if (!refinement_)
        refinement_ = std::make_unique<Refinement>(search_, numbers_.scale);
    return *refinement_;
}

} // namespace chasles::query
