#include "chasles/search/candidates.h"

#include <algorithm>

namespace chasles::search {

void Candidates::keep(const Candidate& candidate) {
    kept_.push_back(candidate);
    state_.note(candidate.tau);
}

void Candidates::stop_search_at(double tau) {
    searched_until_ = std::min(searched_until_, tau);
    std::iter_swap(kept_.begin(), first_proven());
    const auto is_later = [&](const Candidate& c) { return c.tau.lower > searched_until_; };
    kept_.erase(std::remove_if(kept_.begin() + 1, kept_.end(), is_later), kept_.end());
    std::erase_if(postponed_, is_later);
}

double Candidates::first() const {
    double first = searched_until_;
    for (const auto* const candidates : {&kept_, &postponed_})
        for (const Candidate& candidate : *candidates)
            first = std::min(first, candidate.tau.lower);
    return first;
}

void Candidates::end_at_start() {
    state_.shorten(0);
    state_.stop();
}

std::vector<Candidate>::iterator Candidates::first_proven() {
    const auto end_of_proof = [](const Candidate& c) { return c.tau.certain ? c.tau.upper : 2; };
    return std::ranges::min_element(kept_, {}, end_of_proof);
}

/// Final brackets first, then wide proven brackets, then uncertain ones. In this order most of the later ones can be
/// dropped: they turn out to be after the first contact.
std::vector<Candidate> Candidates::in_order_of_proof() {
    std::vector<Candidate> found = std::exchange(kept_, {});
    state_.forget_proven();
    const auto rank = [&](const Candidate& c) {
        return std::pair(!c.tau.certain ? 2 : is_wide(c) ? 1 : 0, c.tau.upper);
    };
    std::ranges::stable_sort(found, {}, rank);
    return found;
}

/// An uncertain bracket ends where a proven contact follows within the tolerance.
FeasibleInterval Candidates::with_proven_end(const FeasibleInterval& tau) const {
    const bool is_open = !tau.certain && tau.upper > 0 && state_.is_within_tolerance_of_proven(tau);
    return is_open ? FeasibleInterval{tau.lower, 1, false} : tau;
}

std::vector<Candidate> Candidates::take() {
    double end = state_.best();
    for (const Candidate& candidate : kept_)
        end = std::min(end, candidate.tau.upper);
    std::erase_if(kept_, [&](const Candidate& c) { return c.tau.lower > end; });
    return std::move(kept_);
}

} // namespace chasles::search
