// The first contact along a path of several motions.
#pragma once

#include "chasles/query/first_contact.h"

#include <functional>

namespace chasles {

/// The answer for a path: the first contact of the whole path.
struct [[nodiscard]] PathContact {
    FirstContact contact; ///< its times count within `segment`; its work is that of the whole path
    /// From 0; the last segment if the path is clear. All segments before it are proven clear, whatever the verdict:
    /// what is proven in all is them and `contact.clear_until` of this one.
    std::size_t segment = 0;
};

/// A path of one pair of bodies: motions that follow each other, of any kind. `screws_along` makes them of poses.
struct PathQuery {
    Polyhedron moving;
    Polyhedron fixed;
    std::vector<Motion> motions; ///< at least one
    QueryOptions options = {};   ///< `hold` holds for each segment: contacts within the margin at its start are held
    /// Called after each segment with the number of segments done; may be empty.
    std::function<void(std::size_t done)> progress = {};
};

/// Throws InvalidInput for a path without motions, for an option out of its range, and for a motion that check_motion
/// refuses.
CHASLES_EXPORT PathContact first_contact_on_path(const PathQuery& query);

} // namespace chasles
