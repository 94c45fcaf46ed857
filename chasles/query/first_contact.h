// The main job: when do two moving polyhedra first touch, where, and how?
#pragma once

#include "chasles/algebra/bracket.h"
#include "chasles/contact/contact.h"
#include "chasles/memory/pair_memory.h"
#include "chasles/mesh/polyhedron.h"
#include "chasles/motion/motion.h"
#include "chasles/search/find.h"

#include <optional>
#include <vector>

namespace chasles {

/// The greatest number of contacts that an answer lists.
inline constexpr std::size_t most_contacts = 1000;

/// What is proven. There is no conversion to bool: an uncertain answer must not be mistaken for "clear".
enum class Verdict : std::uint8_t {
    unknown,          ///< no answer: a Limit was reached, or a default-constructed answer, which claims nothing
    clear,            ///< no contact on [0, 1]
    contact,          ///< first contact inside FirstContact::time, none before its lower end
    contact_at_start, ///< at time 0 the surfaces touch or cross, or one body is inside of the other one
};

/// How to answer a question. The same for one motion, a path and a batch.
struct QueryOptions {
    double margin = 0; ///< distance of the surfaces that counts as contact, mesh unit; in [0, 1e30]
    /// Less than the margin: bodies that start within the margin, with a gap above 0, may move on. They are reported
    /// when they come within `hold`, or nearer than at the start if that is less. Source: docs/derivations/17-hold.md.
    std::optional<double> hold = {};
    double time_tolerance = 1e-12; ///< width of the bracket to aim for, as a part of the motion; in [1e-15, 1]
    Find find = Find::first;
};

/// The answer to a query.
struct [[nodiscard]] FirstContact {
    Verdict verdict = Verdict::unknown;
    Bracket time;         ///< of the first contact (with Find::any, of some contact), in [0, 1]; {0, 0} if clear
    Bracket tau;          ///< the same in the paper's parameter; see docs/derivations/02
    bool certain = false; ///< false where contact could not be told from a miss (docs/promises.md says where)
    std::vector<Contact> contacts;
    bool contacts_cut = false; ///< there are more contacts than the list has: more than `most_contacts`, or surfaces
                               ///< that pass through each other
    std::vector<Contact> held; ///< with `hold`: what is within the margin at time 0, in the world frame at time 0
    /// How far it is safe to go: before this time the bodies are proven to stay farther apart than the margin. With
    /// `hold`: farther than `hold`, or than at the start where that is less. 1 if they do all along, 0 at the start.
    double clear_until = 0;
    /// Only with contact_at_start, when surfaces pass through each other. One that is not certain is named only where
    /// no features touch.
    std::optional<Overlap> overlap;
    /// Only with contact_at_start, when a body, or a part of it, is inside of the other one and the surfaces do not
    /// meet. There are no contacts then. Source: docs/derivations/37-inside.md.
    std::optional<Inside> inside;
    Pose pose;       ///< of the moving body in the world at time.lower; at time 1 if clear
    Pose fixed_pose; ///< likewise of the fixed body
    Work work;

    /// The same answer after the bodies have swapped their roles.
    [[nodiscard]] CHASLES_EXPORT FirstContact swapped() const;
};

/// A question: two bodies, a motion, and how to answer. Bodies and motions are shared, so copies are cheap.
struct FirstContactQuery {
    Polyhedron moving;
    Polyhedron fixed;
    Motion motion;
    QueryOptions options = {};
    PairMemory* memory = nullptr; ///< of both bodies: saves time where questions follow each other at nearby places
};

/// Throws InvalidInput "motion: WHY" for a motion that no question about these bodies takes: one that is enclosed, and
/// goes farther than 1e10 times the radius of the larger body. Source: docs/decisions/0012-range-of-coordinates.md.
CHASLES_EXPORT void check_motion(const Polyhedron& moving, const Polyhedron& fixed, const Motion& motion);

/// Answers the question. Throws InvalidInput for an option out of its range, for a motion that check_motion refuses,
/// and for a memory of other bodies. Source: paper sections 2, 3, 4 and 5.1; docs/derivations/07-swept-boxes.md proves
/// that the search loses nothing.
CHASLES_EXPORT FirstContact first_contact(const FirstContactQuery& query);

} // namespace chasles
