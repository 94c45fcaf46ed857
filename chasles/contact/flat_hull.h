// Reduces contacts in one plane with one normal to the corners of their convex hull.
// Source: docs/derivations/18-contact-set.md; C. Barber, D. Dobkin, H. Huhdanpaa, "The Quickhull algorithm for convex
// hulls", 1996.
#pragma once

#include "chasles/contact/contact.h"

#include <vector>

namespace chasles::contact {

/// Removes each contact whose point is, up to `slack`, in the convex hull of the other contacts with the same plane and
/// normal. The remaining contacts keep their order. Of several contacts at one point the first one remains.
std::vector<Contact> at_corners_of_hulls(std::vector<Contact> contacts, double slack);

} // namespace chasles::contact
