// Paths of many poses, and many motions on all cores.
#pragma once

#include "chasles/query/first_contact.h"

#include <functional>
#include <span>

namespace chasles {

/// The answer for a path: the first contact of the whole path.
struct [[nodiscard]] PathContact {
    FirstContact contact;    ///< its time counts within `segment`; its work is that of the whole path
    std::size_t segment = 0; ///< from pose `segment` to pose `segment` + 1
};

/// A path of poses of the moving body in the frame of the fixed one; each segment is one screw (cut by max_turn).
struct PathQuery {
    const Polyhedron& moving;
    const Polyhedron& fixed;
    std::span<const Pose> poses; ///< at least two
    double margin = 0;
    double time_tolerance = 1e-12;
    double max_turn = std::numbers::pi / 18;
    Find find = Find::first;
    /// Called after each segment with the number of segments done; may be empty.
    std::function<void(std::size_t done)> progress = {};
};

/// Throws InvalidInput for fewer than two poses or an option out of its range.
PathContact first_contact_on_path(const PathQuery& query);

/// Many motions of one pair of bodies, answered on at most `threads` threads (0: all cores).
struct BatchQuery {
    const Polyhedron& moving;
    const Polyhedron& fixed;
    std::span<const Motion> motions;
    double margin = 0;
    std::optional<double> hold = {};
    double time_tolerance = 1e-12;
    double max_turn = std::numbers::pi / 18;
    Find find = Find::first;
    unsigned threads = 0;
    /// Called now and then, from any one thread at a time, with the number of motions done; may be empty.
    std::function<void(std::size_t done)> progress = {};
};

/// One answer a motion, in order; the same for any number of threads.
std::vector<FirstContact> first_contact_batch(const BatchQuery& query);

} // namespace chasles
