// How near do two moving polyhedra come, when, and where?
#pragma once

#include "chasles/query/batch.h"

namespace chasles {

/// How to answer.
struct LeastDistanceOptions {
    double tolerance = 1e-6;       ///< width of the bracket to aim for, as a part of the distance; in [1e-12, 1]
    double time_tolerance = 1e-12; ///< of the first contact, if the bodies touch: as in QueryOptions
    Find find = Find::first;       ///< one feature pair, or with `first_with_all_contacts` every one; not `any`
};

/// The least distance of the bodies over a motion; 0 where one is inside of the other one.
struct [[nodiscard]] LeastDistance {
    Bracket distance; ///< encloses the least distance, mesh unit; {0, 0} if the bodies touch
    Bracket time; ///< within it the surfaces come as near as distance.upper, in [0, 1]; of the first contact if they
                  ///< touch
    Bracket tau;  ///< the same in the paper's parameter
    /// Whether the bracket is as narrow as asked; for bodies that touch, whether contact is proven.
    bool certain = false;
    std::vector<Contact> contacts;  ///< the nearest features at time.lower, in the world; their gaps are the distance
    bool contacts_cut = false;      ///< there are more such features than the list has
    std::optional<Overlap> overlap; ///< where surfaces pass through each other at time 0
    std::optional<Inside> inside;   ///< where one body is inside of the other one at time 0
    Pose pose;                      ///< of the moving body in the world at time.lower
    Pose fixed_pose;                ///< likewise of the fixed body
    Work work;

    /// The same answer after the bodies have swapped their roles.
    [[nodiscard]] CHASLES_EXPORT LeastDistance swapped() const;
};

/// A question: two bodies, a motion, and how to answer.
struct LeastDistanceQuery {
    Polyhedron moving;
    Polyhedron fixed;
    Motion motion;
    LeastDistanceOptions options = {};
};

/// Answers the question. Throws InvalidInput for an option out of its range.
///
/// The lower end of the bracket is proven: the surfaces are never nearer. The upper end is the distance of two points
/// of the surfaces at one time. Source: docs/derivations/21-least-distance.md.
CHASLES_EXPORT LeastDistance least_distance(const LeastDistanceQuery& query);

/// Many motions of one pair of bodies.
struct LeastDistanceBatchQuery {
    Polyhedron moving;
    Polyhedron fixed;
    std::span<const Motion> motions; ///< kept by reference
    LeastDistanceOptions options = {};
    BatchOptions batch = {};
};

/// One answer a motion, in order; the same for any number of threads. Throws InvalidInput for an option out of its
/// range.
CHASLES_EXPORT std::vector<LeastDistance> least_distance_batch(const LeastDistanceBatchQuery& query);

} // namespace chasles
