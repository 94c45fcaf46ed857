// The contacts of two bodies at one pair of poses, and the pairs that are almost contacts.
// Source: docs/derivations/18-contact-set.md.
#pragma once

#include "chasles/contact/contact.h"
#include "chasles/mesh/body.h"
#include "chasles/motion/pose.h"
#include "chasles/search/memory.h"

#include <optional>
#include <vector>

namespace chasles::manipulation {

/// A body at a pose in the world.
struct PlacedBody {
    const Body& body;
    const Pose& pose;
};

struct NearContacts {
    std::vector<Contact>
        contacts;          ///< pairs of features within the reach, nearly at local minima of the distance; in the world
    double distance = 0;   ///< of the surfaces in double precision; the reach if they are farther apart
    bool overlaps = false; ///< surfaces cross, or one body is inside of the other one
    bool is_cut = false;   ///< there are more contacts than these
    Work work;
};

/// All that is within `reach`, positive. `memory` is that of both bodies.
NearContacts near_contacts(const PlacedBody& moving, const PlacedBody& fixed, double reach,
                           search::Memory& memory = search::no_memory());

} // namespace chasles::manipulation
