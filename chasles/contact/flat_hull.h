// Contacts in one plane with one normal: those at the corners of their hull stand for all.
// Source: docs/derivations/18-contact-set.md; C. Barber, D. Dobkin, H. Huhdanpaa, "The Quickhull algorithm for convex
// hulls", 1996.
#pragma once

#include "chasles/contact/contact.h"

#include <vector>

namespace chasles::contact {

/// Leaves out contacts whose points are in the hull of the others with the same plane and normal, up to `slack`. What
/// is left keeps its order; of several at one point the first one is left.
std::vector<Contact> at_corners_of_hulls(std::vector<Contact> contacts, double slack);

} // namespace chasles::contact
