// What is known of two bodies at single times of a motion. Source: docs/derivations/39-profile.md, "Touch".
#pragma once

#include "chasles/query/pair_query.h"
#include "chasles/search/chord_bounds.h"

#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

namespace chasles::query {

/// Two bodies at one tau of a piece.
struct ProfileKnot {
    enum class Touch : std::uint8_t { apart, meets, nested };

    search::NearKnot near;
    Touch touch = Touch::apart;
    std::optional<Overlap> overlap = {}; ///< that is known there; faces have the ids of the library's bodies
};

/// Finds knots of one piece after another, in order of time.
class ProfileKnots {
public:
    /// The question is kept by reference. Nearest features may be other ones than the nearest, by the error.
    ProfileKnots(const PairProfileQuery& question, search::ChordBounds::Error error)
        : question_(question), radii_(distance_of_polyhedra(question.moving, question.fixed, 0)),
          error_(std::move(error)) {}

    /// Searches the first contact.
    void find_contact();
    /// Knots are of this piece, which is kept by reference.
    void begin(search::PieceContext& piece);
    [[nodiscard]] search::ChordBounds& bounds() { return *bounds_; }

    /// Beside knots that may be known; at 0, where the piece before ends.
    using MayBeKnown = const std::optional<ProfileKnot>*;
    ProfileKnot beside(double tau, std::initializer_list<MayBeKnown> known);
    /// The end of the piece, if it is known.
    void end(const std::optional<ProfileKnot>& last);

    /// Whether the surfaces are proven to meet from one knot to the next.
    [[nodiscard]] bool overlap_all_along(const ProfileKnot& start, const ProfileKnot& end) const;
    /// Whether nothing is proven to touch from one knot where nothing does to the next one.
    bool stay_apart(const ProfileKnot& start, const ProfileKnot& end);
    /// The time before which nothing touches.
    [[nodiscard]] double clear_until() const { return clear_until_; }

    /// Of all pieces.
    [[nodiscard]] Work work() const;

private:
    [[nodiscard]] bool is_before_contact(double tau) const;
    double contact_after(double tau);
    ProfileKnot at(double tau, std::span<const ProfileKnot* const> known);
    /// The bodies are tested at rest there.
    ProfileKnot in_contact(double tau, const std::function<search::NearKnot()>& nearest);
    [[nodiscard]] std::optional<Overlap> lasting(Overlap overlap, const search::NearKnot& near) const;
    [[nodiscard]] std::optional<ProfileKnot> overlapping(double tau, const ProfileKnot& near) const;

    const PairProfileQuery& question_;
    double radii_; ///< surfaces that are no farther apart touch
    search::ChordBounds::Error error_;
    double clear_until_ = 1; ///< time: nothing touches before it
    Bracket clear_taus_;     ///< of the piece: nothing touches from the one until before the other
    search::PieceContext* piece_ = nullptr;
    std::optional<search::ChordBounds> bounds_; ///< of the piece
    std::optional<ProfileKnot> last_;           ///< of the piece before
    Work work_;
};

} // namespace chasles::query
