#include "chasles/search/found_near.h"

#include "chasles/search/overlaps.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace chasles::search {

namespace {

/// Far above the rounding of a bracket to the whole piece.
constexpr double rim = 0x1p-45;
/// A pair has six crossings at most; the rest is for doubt that is looked at in ever longer parts.
constexpr int most_looks = 60;

/// With a rim on either side.
culling::TimeRange part_from(double lower, double width) {
    return {std::max(0.0, lower - rim), std::min(1.0, lower + width + rim)};
}

} // namespace

void FoundNear::add(const contact::FeaturePair& features, const Crossing& crossing) {
    if (stop_ || crossing.tau.lower > best_ || (search_.held && search_.held->has(features)))
        return;
    if (crossing.tau.certain && !search_.held)
        return keep(features, crossing.tau);
    if (is_nearly_simultaneous_with_proven(crossing.tau))
        waiting_.push_back({features, crossing.tau});
    else if (const auto tau = first_that_counts(features, crossing))
        keep(features, *tau);
}

void FoundNear::add_at_start(const contact::FeaturePair& features, WithinAtStart::Answer answer) {
    using enum WithinAtStart::Answer;
    if (stop_ || answer == no)
        return;
    if (answer == may_be) {
        NearStage<algebra::DoubleDouble>& stage = refinement().near;
        stage.use({0, rim}); // bounds follow the numbers there
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
    const auto overlap = search::refined(found, pairs, search_.frame);
    if (!overlap || !overlap->certain) // an edge that hardly passes is within the margin of what it hardly passes
        return;
    result_.overlap = overlap;
    best_ = 0;
    stop_ = search_.find != Find::first_with_all_contacts;
}

PieceResult FoundNear::take() {
    narrow_brackets();
    double end = best_;
    for (const Candidate& candidate : result_.candidates)
        end = std::min(end, candidate.tau.upper);
    std::erase_if(result_.candidates, [&](const Candidate& c) { return c.tau.lower > end; });
    return std::move(result_);
}

void FoundNear::keep(const contact::FeaturePair& features, const FeasibleInterval& tau) {
    result_.candidates.push_back({features, tau});
    const bool may_be_proven_soon = !tau.certain && tau.upper > 0; // by another pair, which ends the bracket then
    best_ = std::min(best_, may_be_proven_soon ? std::max(tau.upper, tau.lower + search_.tolerance) : tau.upper);
    if (tau.certain)
        certain_ = std::min(certain_, tau.upper);
    stop_ = search_.find == Find::any || (search_.find == Find::first && tau.upper <= 0);
}

/// Last: what was found is asked again, the surest first, so that most of it falls behind the first contact.
void FoundNear::narrow_brackets() {
    std::vector<Candidate> found = std::exchange(result_.candidates, {});
    std::ranges::stable_sort(found, {}, [](const Candidate& c) { return std::pair(!c.tau.certain, c.tau.upper); });
    for (const Candidate& candidate : found) {
        if (candidate.tau.lower > best_)
            continue;
        const bool is_wide = candidate.tau.certain && candidate.tau.upper > 0 && !is_decided(candidate.tau);
        const auto narrow =
            is_wide ? refined(candidate, part_from(candidate.tau.lower, candidate.tau.upper - candidate.tau.lower))
                    : std::nullopt;
        keep(candidate, narrow && narrow->tau.certain ? narrow->tau : without_doubtful_end(candidate.tau));
    }
    const bool lists_all = search_.find == Find::first_with_all_contacts;
    for (const Candidate& candidate : waiting_) {
        if (candidate.tau.lower > best_)
            continue;
        const auto tau = !lists_all && is_within_tolerance_of_proven(candidate.tau)
                             ? std::optional(candidate.tau)
                             : first_that_counts(candidate, {candidate.tau, false});
        if (tau)
            keep(candidate, without_doubtful_end(*tau));
    }
}

/// The bracket may as well begin there.
bool FoundNear::is_within_tolerance_of_proven(const FeasibleInterval& tau) const {
    return certain_ - search_.tolerance <= tau.lower;
}

/// Where a proven contact follows at once it ends the bracket.
FeasibleInterval FoundNear::without_doubtful_end(const FeasibleInterval& tau) const {
    const bool is_doubtful = !tau.certain && tau.upper > 0 && is_within_tolerance_of_proven(tau);
    return is_doubtful ? FeasibleInterval{tau.lower, 1, false} : tau;
}

bool FoundNear::is_nearly_simultaneous_with_proven(const FeasibleInterval& tau) const {
    return tau.lower > 0 && certain_ - tau.lower <= nearly_simultaneous;
}

bool FoundNear::is_decided(const FeasibleInterval& tau) const {
    return tau.certain && tau.upper - tau.lower <= search_.tolerance;
}

/// None if the crossing counts. Without contacts that are held, every one is of features that were farther apart.
/// Otherwise one that leaves the margin is none, and one that is no local minimum is that of a contact which spreads or
/// slides; it stays so for as long as directions take to change.
std::optional<double> FoundNear::passed_until(const contact::FeaturePair& features, const Crossing& crossing) const {
    if (!search_.held)
        return std::nullopt;
    const FeasibleInterval& tau = crossing.tau;
    if (crossing.leaves)
        return tau.upper;
    const contact::RelativeConfiguration instant(search_.moving, search_.fixed, numbers_.maps, tau.lower);
    const contact::NearestPoints nearest = instant.nearest(features);
    const double speed = instant.velocity_at(nearest.on_moving).norm();
    const double error = elementary::error_unit<double> * numbers_.scale.length + speed * (tau.upper - tau.lower);
    const double excess = instant.descent(features, nearest) - 4 * error / search_.margin;
    if (excess <= 0)
        return std::nullopt;
    // Rates are at most twice as large as here for a steady while.
    const double steady = 0x1p-4 / std::sqrt(std::max(1.0, numbers_.maps.weight[3]));
    const double turning = 4 * (2 * speed / search_.margin + instant.turn_rate());
    return std::max(tau.upper, tau.lower + std::min(steady, excess / turning));
}

/// From what the filter found on. Where double-double finds nothing there, the filter is asked what comes next, and
/// double-double looks much further each time. Where it is in doubt, which may be for the length of the part, it starts
/// over with the shortest one.
std::optional<FeasibleInterval> FoundNear::first_that_counts(const contact::FeaturePair& features,
                                                             const Crossing& found) {
    constexpr double shortest = 4 * rim;
    constexpr double further = 64;
    const auto width_of = [](const Crossing& crossing) { return crossing.tau.upper - crossing.tau.lower; };
    Crossing next = found;
    double width = std::max(4 * search_.tolerance, width_of(next));
    double after = 0; // nothing before it counts
    bool was_in_doubt = false;
    for (int i = 0; i < most_looks; ++i) {
        culling::TimeRange where = part_from(next.tau.lower, width);
        where.lower = std::max(where.lower, after);
        const auto crossing = is_decided(next.tau) ? std::optional(next) : refined(features, where);
        if (crossing && crossing->tau.lower > best_)
            return std::nullopt;
        if (crossing && !crossing->tau.certain && width > shortest) {
            width = shortest;
            was_in_doubt = true;
            next = *crossing;
            continue;
        }
        const auto passed = crossing ? passed_until(features, *crossing) : std::optional(where.upper);
        if (!passed)
            return crossing->tau;
        after = std::max(*passed, next.tau.lower + rim);
        if (after >= best_)
            return std::nullopt;
        filter_.use({after, 1});
        const auto left =
            filter_.first_crossing(features, filter_tolerance(std::min(1.0, search_.tolerance / (1 - after))));
        if (!left || left->tau.lower > best_)
            return std::nullopt;
        next = *left;
        width = std::max(further * width, was_in_doubt ? 0.0 : width_of(next)); // the filter is in doubt for longer
    }
    return FeasibleInterval{next.tau.lower, next.tau.upper, false};
}

/// The first crossing in a part as double-double sees it.
std::optional<Crossing> FoundNear::refined(const contact::FeaturePair& features, const culling::TimeRange& where) {
    constexpr double finest = 0x1p-90;
    constexpr int restrictions = 600; // ordinary crossings take ten
    ++result_.work.refined;
    NearStage<algebra::DoubleDouble>& stage = refinement().near;
    stage.use(where);
    const double width = where.width();
    return stage.first_crossing(
        features, {std::min(1.0, 0.5 * search_.tolerance / width), std::min(1.0, finest / width), restrictions});
}

FoundNear::Refinement& FoundNear::refinement() {
    if (!refinement_)
        refinement_ = std::make_unique<Refinement>(search_, numbers_.scale);
    return *refinement_;
}

} // namespace chasles::search
