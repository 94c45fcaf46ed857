#include "chasles/search/found_contacts.h"

#include "chasles/search/overlaps.h"

#include <algorithm>
#include <utility>

namespace chasles::search {

namespace {

using Scalar = algebra::DoubleDouble;

/// The part of the tolerance before a contact in which nothing is asked where many touch at once.
constexpr double left_open = 0.75;

/// A proven contact, and not at the start. Its bracket may be wide as yet.
bool is_contact(const FeasibleInterval& tau) {
    return tau.certain && tau.lower > 0;
}

/// As it may be no contact, it ends nothing.
void leave_in_doubt(Candidate& candidate) {
    candidate.tau.upper = 1;
}

} // namespace

void FoundContacts::add(const Candidate& candidate) {
    if (stop_ || candidate.tau.lower > best())
        return;
    at_once_ += is_nearly_simultaneous_with_proven(candidate.tau) ? 1 : 0;
    Candidate decided = candidate;
    if (is_contact(candidate.tau))
        keep(candidate);
    else if (is_nearly_simultaneous_with_proven(candidate.tau))
        waiting_.push_back(candidate);
    else if (!is_after_proven(candidate.tau) && !asked_exactly_.contains(candidate) && decide(decided))
        keep(decided);
}

/// An overlap ends the search: nothing is earlier.
void FoundContacts::add(const Overlap& found) {
    if (stop_)
        return;
    const auto overlap = refined(found, refined_pairs({}), search_.frame);
    if (!overlap)
        return;
    if (!overlap->certain) {
        doubtful_overlaps_.push_back(*overlap);
        return;
    }
    result_.overlap = overlap;
    stop_ = true;
}

/// Of the candidates that are kept, the first one that is proven.
std::vector<Candidate>::iterator FoundContacts::first_proven() {
    const auto end_of_proof = [](const Candidate& c) { return c.tau.certain ? c.tau.upper : 2; };
    return std::min_element(result_.candidates.begin(), result_.candidates.end(),
                            [&](const Candidate& a, const Candidate& b) { return end_of_proof(a) < end_of_proof(b); });
}

std::optional<double> FoundContacts::early_enough() {
    const auto first = first_proven();
    if (first == result_.candidates.end() || !is_contact(first->tau))
        return std::nullopt;
    if (Candidate narrowed = *first; !is_decided(first->tau) && decide(narrowed) && is_decided(narrowed.tau)) {
        *first = narrowed;
        best_ = std::min(best_, narrowed.tau.upper);
        certain_.upper = std::min(certain_.upper, narrowed.tau.upper);
    }
    const double early = first->tau.upper - left_open * search_.tolerance;
    return is_decided(first->tau) && early > 0 ? std::optional(early) : std::nullopt;
}

void FoundContacts::leave_open_after(double tau) {
    result_.open_after = std::min(result_.open_after, tau);
    std::iter_swap(result_.candidates.begin(), first_proven());
    const auto is_left_open = [&](const Candidate& c) { return c.tau.lower > result_.open_after; };
    result_.candidates.erase(std::remove_if(result_.candidates.begin() + 1, result_.candidates.end(), is_left_open),
                             result_.candidates.end());
    std::erase_if(waiting_, is_left_open);
}

PieceResult FoundContacts::take() {
    narrow_brackets();
    decide_overlaps();
    const double last = result_.overlap ? 0 : best_;
    std::erase_if(result_.candidates, [&](const Candidate& c) { return c.tau.lower > last; });
    return std::move(result_);
}

void FoundContacts::keep(const Candidate& candidate) {
    result_.candidates.push_back(candidate);
    best_ = std::min(best_, candidate.tau.upper);
    if (candidate.tau.certain)
        certain_.upper = std::min(certain_.upper, candidate.tau.upper);
    if (is_decided(candidate.tau))
        certain_.lower = std::min(certain_.lower, candidate.tau.lower);
    stop_ = search_.find == Find::any || (search_.find == Find::first && may_be_at_start(candidate.tau));
}

/// Last: what was found is asked again, the surest first, so that most of it falls behind the first contact. A
/// bracket in doubt that ends where the answer's bracket may end is left as it is.
void FoundContacts::narrow_brackets() {
    std::vector<Candidate> found = std::exchange(result_.candidates, {});
    std::stable_sort(found.begin(), found.end(),
                     [](const Candidate& a, const Candidate& b) { return a.tau.upper < b.tau.upper; });
    certain_ = {2, 2}; // none of them stands beside itself
    const auto is_wide = [&](const Candidate& c) { return is_contact(c.tau) && !is_decided(c.tau); };
    for (const Candidate& candidate : found)
        if (candidate.tau.lower <= best_ && !is_wide(candidate))
            keep(candidate);
    for (const Candidate& candidate : found) {
        Candidate narrowed = candidate;
        if (candidate.tau.lower <= best_ && is_wide(candidate) && decide(narrowed))
            keep(narrowed.tau.certain ? narrowed : candidate);
    }
    for (Candidate& candidate : waiting_) {
        if (candidate.tau.lower > best_ || is_after_proven(candidate.tau))
            continue;
        if (is_within_tolerance_of_proven(candidate.tau))
            leave_in_doubt(candidate);
        else if (!decide(candidate))
            continue;
        keep(candidate);
    }
}

/// Exactly, and last: where the bodies just touch at the start, their features have been found to.
void FoundContacts::decide_overlaps() {
    for (Overlap& overlap : doubtful_overlaps_) {
        if (result_.overlap || certain_.upper <= 0)
            return;
        ++result_.work.exact;
        if (exact_stage().passes(overlap)) {
            overlap.certain = true;
            result_.overlap = overlap;
        }
    }
}

bool FoundContacts::is_nearly_simultaneous_with_proven(const FeasibleInterval& tau) const {
    return search_.find != Find::first_with_all_contacts && tau.lower > 0 &&
           certain_.upper - tau.lower <= nearly_simultaneous;
}

/// A lower end of 0 is not enough: whether bodies touch at 0 or right after it makes another verdict.
bool FoundContacts::is_decided(const FeasibleInterval& tau) const {
    return tau.certain && tau.upper - tau.lower <= search_.tolerance && tau.lower > 0;
}

/// What is not certain or not tight in double precision is asked again in double-double, and what still is not,
/// exactly; false if there is no contact before best_.
bool FoundContacts::decide(Candidate& candidate) {
    ++result_.work.refined;
    const auto refined =
        first_contact_of(refined_pairs(refinement_tolerance(search_.tolerance, candidate.tau)), candidate);
    if (!refined || refined->lower > best_)
        return false;
    candidate.tau = *refined;
    if (is_decided(candidate.tau))
        return true;
    if (is_within_tolerance_of_proven(candidate.tau)) {
        leave_in_doubt(candidate);
        return true;
    }
    ++result_.work.exact;
    asked_exactly_.insert(candidate);
    const auto decided = exact_stage().first_contact_of(candidate, search_.tolerance);
    if (!decided)
        return false;
    if (decided->certain || decided->lower > candidate.tau.lower)
        candidate.tau = *decided;
    return candidate.tau.lower <= best_;
}

/// Whatever it is, it changes nothing but the list of all contacts.
bool FoundContacts::is_after_proven(const FeasibleInterval& tau) const {
    return search_.find != Find::first_with_all_contacts && certain_.lower <= tau.lower &&
           (tau.lower > 0 || certain_.upper <= 0);
}

/// Whatever it is, the bracket of the answer holds a proven contact and is no wider than asked for.
bool FoundContacts::is_within_tolerance_of_proven(const FeasibleInterval& tau) const {
    return certain_.upper - tau.lower <= search_.tolerance && (tau.lower > 0 || certain_.upper <= 0);
}

FeaturePairs<Scalar>& FoundContacts::refined_pairs(const algebra::Tolerance& tolerance) {
    Refinement& stage = refinement();
    stage.pairs.use(stage.maps, tolerance);
    return stage.pairs;
}

Refinement& FoundContacts::refinement() {
    if (!refinement_)
        refinement_.emplace(search_, scale_);
    return *refinement_;
}

ExactStage& FoundContacts::exact_stage() {
    if (!exact_stage_)
        exact_stage_ = std::make_unique<ExactStage>(search_.moving, search_.fixed, search_.frame);
    return *exact_stage_;
}

} // namespace chasles::search
