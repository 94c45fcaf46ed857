#include "chasles/query/profile_knots.h"

#include "chasles/query/profile_steps.h"
#include "chasles/query/report.h"
#include "chasles/search/piece_search.h"

#include <algorithm>

namespace chasles::query {

using search::NearKnot;
using Touch = ProfileKnot::Touch;

void ProfileKnots::find_contact() {
    const FirstContact touch =
        answer_or_unknown({question_.moving, question_.fixed, question_.trajectory, QueryOptions{}});
    work_ += touch.work;
    clear_until_ = touch.clear_until;
}

void ProfileKnots::begin(search::PieceContext& piece) {
    if (bounds_)
        work_ += bounds_->work();
    piece_ = &piece;
    clear_taus_ = {2, 2};
    bounds_.emplace(piece);
}

Work ProfileKnots::work() const {
    Work all = work_;
    if (bounds_)
        all += bounds_->work();
    return all;
}

void ProfileKnots::end(const std::optional<ProfileKnot>& last) {
    last_ = last;
    if (last_)
        last_->near.tau = 0;
}

/// An overlap that lasts from a known knot need not be looked for.
ProfileKnot ProfileKnots::beside(double tau, std::initializer_list<MayBeKnown> may_be_known) {
    std::vector<const ProfileKnot*> known;
    for (const MayBeKnown knot : may_be_known)
        if (knot && *knot)
            known.push_back(&**knot);
    if (tau == 0 && last_)
        known.push_back(&*last_);
    for (const ProfileKnot* knot : known)
        if (auto found = overlapping(tau, *knot))
            return *std::move(found);
    return at(tau, known);
}

bool ProfileKnots::is_before_contact(double tau) const {
    return clear_until_ == 1 || time_of(piece_->piece(), tau) < clear_until_;
}

/// Before the first contact nothing touches, nor while the surfaces stay apart from a knot on where nothing does.
ProfileKnot ProfileKnots::at(double tau, std::span<const ProfileKnot* const> known) {
    std::vector<contact::FeaturePair> guesses;
    for (const ProfileKnot* knot : known)
        if (knot->near.features)
            guesses.push_back(*knot->near.features);
    const bool is_clear = is_before_contact(tau);
    const auto is_apart = [](const ProfileKnot* knot) { return knot->touch == Touch::apart; };
    const auto nearest = [&] { return bounds_->nearest_at(tau, guesses, error_); };
    if (!is_clear && std::ranges::none_of(known, is_apart))
        return in_contact(tau, nearest);
    const NearKnot near = nearest();
    const auto stays_apart = [&](const ProfileKnot* knot) {
        return is_apart(knot) && (knot->near.tau < tau ? bounds_->are_beyond(knot->near, near, radii_)
                                                       : bounds_->are_beyond(near, knot->near, radii_));
    };
    if (is_clear || std::ranges::any_of(known, stays_apart))
        return {near, Touch::apart};
    return in_contact(tau, [&] { return near; });
}

ProfileKnot ProfileKnots::in_contact(double tau, const std::function<NearKnot()>& nearest) {
    const Pose moving = piece_->piece().pose_at(tau), fixed = piece_->piece().fixed_pose_at(tau);
    const Motion at_rest = Motion::at_rest(Pose(fixed.isometry().inverse() * moving.isometry()));
    const FirstContact found =
        answer_or_unknown({question_.moving, question_.fixed, at_rest.trajectory(), QueryOptions{}});
    work_ += found.work;
    if (found.overlap) {
        const NearKnot near = bounds_->crossing_at(tau, found.overlap->point);
        return {near, Touch::meets, lasting(*found.overlap, near)};
    }
    const Touch touch = found.inside                                 ? Touch::nested
                        : found.verdict == Verdict::contact_at_start ? Touch::meets
                                                                     : Touch::apart;
    return {nearest(), touch};
}

/// The overlap with the face of the library's body, of those with its id in the input.
std::optional<Overlap> ProfileKnots::lasting(Overlap overlap, const NearKnot& near) const {
    const Body& of_face = overlap.edge_is_moving ? question_.fixed : question_.moving;
    const std::uint32_t id = overlap.face.first;
    for (std::uint32_t face = 0; face < of_face.face_count(); ++face) {
        overlap.face = {face, face};
        if (of_face.source_face(face) == id && bounds_->crosses_between(near, near, overlap))
            return overlap;
    }
    return std::nullopt;
}

std::optional<ProfileKnot> ProfileKnots::overlapping(double tau, const ProfileKnot& near) const {
    if (!near.overlap)
        return std::nullopt;
    ProfileKnot knot{bounds_->crossing_at(tau, *near.overlap), Touch::meets, near.overlap};
    const bool is_later = near.near.tau < tau;
    const NearKnot &start = is_later ? near.near : knot.near, &end = is_later ? knot.near : near.near;
    return bounds_->crosses_between(start, end, *near.overlap) ? std::optional(std::move(knot)) : std::nullopt;
}

bool ProfileKnots::overlap_all_along(const ProfileKnot& start, const ProfileKnot& end) const {
    const auto lasts = [&](const ProfileKnot& knot) {
        return knot.overlap && bounds_->crosses_between(start.near, end.near, *knot.overlap);
    };
    return lasts(start) || lasts(end);
}

/// Touch is exact. No tolerance of distances decides. One search serves all parts before the contact that it finds.
bool ProfileKnots::stay_apart(const ProfileKnot& start, const ProfileKnot& end) {
    if (is_before_contact(end.near.tau))
        return true;
    if (start.near.tau < clear_taus_.lower || start.near.tau > clear_taus_.upper)
        clear_taus_ = {start.near.tau, contact_after(start.near.tau)};
    return end.near.tau < clear_taus_.upper;
}

/// The tau of the first contact after one where nothing touches; 2 if there is none.
double ProfileKnots::contact_after(double tau) {
    try {
        const search::PieceResult found = search_piece(*piece_, {.margin = radii_, .check_start = false, .from = tau});
        work_ += found.work;
        return has_contact(found) ? enclosing(found).lower : 2;
    } catch (const search::Stopped& stopped) {
        return stopped.clear_until;
    }
}

} // namespace chasles::query
