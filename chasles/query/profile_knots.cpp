#include "chasles/query/profile_knots.h"

#include "chasles/query/profile_steps.h"

namespace chasles::query {

using search::NearKnot;
using Touch = ProfileKnot::Touch;

double ProfileKnots::clear_until(const motion::AnyTrajectory& trajectory) {
    const FirstContact touch = answer_or_unknown({question_.moving, question_.fixed, trajectory, QueryOptions{}});
    work_ += touch.work;
    return touch.clear_until;
}

void ProfileKnots::find_contacts() {
    touching_.lower = clear_until(question_.trajectory);
    if (touching_.lower < 1)
        touching_.upper = 1 - clear_until(*question_.trajectory.reversed());
}

void ProfileKnots::begin(const search::PieceContext& piece) {
    if (bounds_)
        work_ += bounds_->work();
    piece_ = &piece;
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
ProfileKnot ProfileKnots::beside(double tau, std::initializer_list<MayBeKnown> known) {
    Features guesses;
    std::optional<ProfileKnot> found;
    const auto use = [&](const ProfileKnot& knot) {
        if (!found)
            found = overlapping(tau, knot);
        if (knot.near.distance > 0)
            guesses.push_back(knot.near.features);
    };
    for (const MayBeKnown knot : known)
        if (knot && *knot)
            use(**knot);
    if (tau == 0 && last_)
        use(*last_);
    return found ? *std::move(found) : at(tau, guesses);
}

/// Before the first contact and after the last one nothing touches.
ProfileKnot ProfileKnots::at(double tau, const Features& guesses) {
    const double time = touching_.lower < 1 ? time_of(piece_->piece(), tau) : 0;
    if (touching_.lower <= time && time <= touching_.upper)
        return in_contact(tau, guesses);
    return {bounds_->nearest_at(tau, guesses, error_), Touch::apart};
}

ProfileKnot ProfileKnots::in_contact(double tau, const Features& guesses) {
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
    return {bounds_->nearest_at(tau, guesses, error_), touch};
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

} // namespace chasles::query
