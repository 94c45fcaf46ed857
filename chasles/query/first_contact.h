// The main job: when do two moving polyhedra first touch, where, and how?
#pragma once

#include "chasles/algebra/bracket.h"
#include "chasles/contact/contact.h"
#include "chasles/mesh/polyhedron.h"
#include "chasles/motion/motion.h"
#include "chasles/search/find.h"

#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

namespace chasles {

/// What is proven. There is no conversion to bool: "could not tell" must not be mistaken for "clear".
enum class Verdict : std::uint8_t {
    clear,            ///< no contact on [0, 1]
    contact,          ///< first contact inside FirstContact::time, none before its lower end
    contact_at_start, ///< already touching or overlapping at time 0
};

/// The answer to a query.
struct [[nodiscard]] FirstContact {
    Verdict verdict = Verdict::clear;
    Bracket time;        ///< of the first contact (with Find::any, of some contact), in [0, 1]; {0, 0} if clear
    Bracket tau;         ///< the same in the paper's parameter; see docs/derivations/02
    bool certain = true; ///< false where contact could not be told from a miss (docs/promises.md says where)
    std::vector<Contact> contacts;
    std::vector<Contact> held; ///< with `hold`: what is within the margin at time 0, in the world frame at time 0
    double clear_until = 1; ///< how far one may safely go: before this time the bodies are proven to be farther apart
                            ///< than the margin; with `hold`, than that. 1 if they are all along, 0 at the start
    std::optional<Overlap> overlap; ///< only with contact_at_start, when surfaces pass through each other
    Pose pose;                      ///< of the moving body in the world at time.lower; the goal if clear
    Work work;
};

/// A question: two bodies, a motion, and how to answer.
struct FirstContactQuery {
    const Polyhedron& moving;
    const Polyhedron& fixed;
    Motion motion;
    double margin = 0;                       ///< distance of the surfaces that counts as contact, mesh unit
    std::optional<double> hold = {};         ///< less than the margin: bodies that start within the margin go on, and
                                             ///< their contacts are reported only when they come within `hold`
    double time_tolerance = 1e-12;           ///< aimed width of the bracket, of the motion; in [1e-15, 1]
    double max_turn = std::numbers::pi / 18; ///< a screw that turns more is cut into equal turns; radians
    Find find = Find::first;
};

/// Answers the question. Throws InvalidInput for an option out of its range.
/// Source: paper sections 2, 3, 4 and 5.1; docs/derivations/07-swept-boxes.md proves that the search loses nothing.
FirstContact first_contact(const FirstContactQuery& query);

} // namespace chasles
