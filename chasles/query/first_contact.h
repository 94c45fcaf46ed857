// The main job: when do two moving polyhedra first touch, where, and how?
#pragma once

#include "chasles/mesh/polyhedron.h"
#include "chasles/motion/motion.h"

#include <compare>
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

/// Where a query may stop.
enum class Find : std::uint8_t {
    first,                   ///< the first contact and one feature pair at it
    any,                     ///< yes or no: stops at the first contact that it meets, which need not be the earliest
    first_with_all_contacts, ///< the first contact and every feature pair in contact within the bracket
};

/// First named feature: of the moving body. Second: of the fixed body. The last three are met at the rims of faces and
/// at the ends of edges: there the normal is one of many that the features allow.
enum class ContactKind : std::uint8_t { vertex_face, face_vertex, edge_edge, vertex_edge, edge_vertex, vertex_vertex };
enum class FeatureKind : std::uint8_t { vertex, edge, face };

/// Of the first named feature, and of the second.
FeatureKind moving_feature_kind(ContactKind kind);
FeatureKind fixed_feature_kind(ContactKind kind);

/// A closed interval that encloses a number.
struct Bracket {
    double lower = 0;
    double upper = 0;
};

/// A vertex, a face or an edge of a body. The ids are those of the input mesh, from 0; an edge is named by its two
/// vertices, any other feature by one id (the second is then equal to the first).
struct Feature {
    std::uint32_t first = 0;
    std::uint32_t second = 0;

    friend auto operator<=>(const Feature&, const Feature&) = default;
};

/// One feature pair in contact, in the world frame at FirstContact::time.lower.
struct Contact {
    ContactKind kind = ContactKind::vertex_face;
    Feature moving;
    Feature fixed;
    Eigen::Vector3d point;     ///< on the fixed feature, mesh unit; the moving one is at point + gap * normal
    Eigen::Vector3d normal;    ///< unit, from the fixed body to the moving one
    double gap = 0;            ///< distance of the two features, mesh unit; 0 up to rounding where they touch
    double approach_speed = 0; ///< -d(gap)/dtime at contact, mesh unit per motion; positive when closing, and
                               ///< negative only at the start, for bodies that touch there and part
};

/// An edge of one body that passes through a face of the other at time 0.
struct Overlap {
    bool edge_is_moving = true; ///< whose edge it is; the face is the other body's
    Feature edge;
    Feature face;
    Eigen::Vector3d point; ///< in the world frame
    bool certain = true;   ///< false if the edge may just miss the face's rim
};

/// How much was done.
struct Work {
    std::uint64_t node_pairs = 0;       ///< box pairs tested over some interval of time
    std::uint64_t face_pairs = 0;       ///< leaf pairs that reached the elementary detections
    std::uint64_t elementary_tests = 0; ///< vertex/face and edge/edge detections
    std::uint64_t root_brackets = 0;    ///< of those, the ones that had to look for roots
    std::uint64_t refined = 0;          ///< of those, the ones repeated in double-double precision
    std::uint64_t exact = 0;            ///< of those, and of edges through faces at the start, decided exactly
    Work& operator+=(const Work& other);
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
