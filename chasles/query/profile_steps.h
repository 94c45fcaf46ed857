// The steps of a profile, made of lines between which the distance is known to stay.
// Source: docs/derivations/39-profile.md, "Steps".
#pragma once

#include "chasles/motion/any_trajectory.h"
#include "chasles/query/profile.h"
#include "chasles/search/chord_bounds.h"

#include <span>

namespace chasles::query {

/// For what share of a part it is not known whether the distance is more than some margin.
double share_in_doubt(const search::DistanceBounds& bounds, std::span<const double> margins);

/// The time of a tau, rounded.
double time_of(const motion::AnyPiece& piece, double tau);

/// Takes parts in order of time.
class ProfileSteps {
public:
    /// The options have an absolute tolerance, and their margins are sorted. Steps add this part of the tolerances to
    /// the widths of lines.
    ProfileSteps(const ProfileOptions& options, double share) : options_(options), share_(share) {}

    /// Parts are of this piece, which is kept by reference.
    void begin(const motion::AnyPiece& piece) { piece_ = &piece; }

    /// Between the margins that the lines cross. `is_free`: nothing touches in the part, though the lower line may not
    /// prove it.
    void add(const Bracket& part, const search::DistanceBounds& lines, bool is_free);
    void add_one(const Bracket& part, double lower, double upper);
    /// One step to the end of the motion.
    void add_rest(double lower, double upper);
    /// Ends at time 1. Nothing touches before `clear_until`.
    DistanceProfile result(double clear_until) &&;

private:
    void add_even(const Bracket& part, const search::DistanceBounds& lines);
    void add_until(double end, double lower, double upper);

    const ProfileOptions& options_;
    double share_;
    const motion::AnyPiece* piece_ = nullptr;
    DistanceProfile profile_;
};

} // namespace chasles::query
