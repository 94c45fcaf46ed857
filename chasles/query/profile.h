// How far apart are two moving polyhedra over time? Source: docs/derivations/39-profile.md.
#pragma once

#include "chasles/query/first_contact.h"

#include <cstdint>
#include <vector>

namespace chasles {

/// How to answer.
struct ProfileOptions {
    double tolerance = 1e-2; ///< the greatest difference of the bounds, as a part of the distance; in [1e-4, 1]
    /// Differences of less do not matter, mesh unit; 0: a millionth of the sum of both radii around the bodies,
    /// and at most an eighth of an overlap that is allowed (a radius below 0).
    double absolute_tolerance = 0;
    std::vector<double> margins = {}; ///< distances, mesh unit: the times at which each is crossed are bounded closely
    double time_tolerance = 1e-6;     ///< so closely, as a part of the motion; in [1e-9, 1]
};

/// Intervals of time in [0, 1], in order.
struct Zones {
    std::vector<Bracket> inside; ///< the distance is at most the margin
    std::vector<Bracket> doubt;  ///< it may be at most the margin
};

/// The distance of the bodies over a motion; 0 while they touch, overlap, or one is inside of the other one.
struct [[nodiscard]] DistanceProfile {
    std::vector<double> times; ///< ascending, from 0 to 1
    /// From times[i] to times[i + 1] the distance is never below lower[i] and never above upper[i], mesh unit; the last
    /// entries are those at time 1. Times are rounded, by 1e-14 or as FirstContact::time. Where no more is known than
    /// that nothing touches, `lower` is the least normal number, 2.2e-308.
    std::vector<double> lower;
    std::vector<double> upper;
    /// Whether the bounds are as near to each other as asked, but where the bodies touch: there `lower` is 0, and
    /// `upper` may be more.
    bool certain = false;
    /// For the question about many pairs, by step: the index of a pair whose `upper` is the least; else empty.
    std::vector<std::uint32_t> nearest;
    Work work;

    /// Where the bodies are within a distance of each other: a margin of the question, or any other one. Throws
    /// InvalidInput for a margin that is not in [0, 1e30].
    [[nodiscard]] CHASLES_EXPORT Zones zones(double margin) const;
    /// When the bodies are proven not to touch: the longest intervals, in order.
    [[nodiscard]] CHASLES_EXPORT std::vector<Bracket> free() const;
};

/// A question: two bodies, a motion, and how to answer.
struct ProfileQuery {
    Polyhedron moving;
    Polyhedron fixed;
    Motion motion;
    ProfileOptions options = {};
};

/// Answers the question; at the limit of the thread with what is proven so far. Throws InvalidInput for an option out
/// of its range, and as check_motion.
CHASLES_EXPORT DistanceProfile profile(const ProfileQuery& query);

} // namespace chasles
