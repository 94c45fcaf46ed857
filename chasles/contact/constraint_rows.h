// What contacts leave free: rows of linear constraints on the further motion, as solvers take them.
// Source: paper section 5.1; docs/derivations/08-contact-frame.md.
#pragma once

#include "chasles/contact/contact.h"

#include <Eigen/Geometry>
#include <span>

namespace chasles {

/// One row of six a contact, (n, p x n) with the contact's normal n and point p, in the world frame. Times the twist of
/// the moving body relative to the fixed one, (v, w) with v the linear velocity (mesh unit per time) of its point that
/// is at the world's origin and w the angular velocity (radians per time), it is the rate of the contact's gap:
///
///     row . (v, w) > 0    the contact opens
///     row . (v, w) = 0    the bodies slide or roll on each other
///     row . (v, w) < 0    the contact closes: not allowed where the gap is used up
///
/// so that "row . twist >= 0 for all rows" is what the contacts leave free, to first order. For the twist of the motion
/// that was asked about, row . twist = -approach_speed.
///
/// Inline, since a matrix that Eigen allocates may not cross from a library that was compiled for another processor.
inline Eigen::Matrix<double, Eigen::Dynamic, 6> constraint_rows(std::span<const Contact> contacts) {
    Eigen::Matrix<double, Eigen::Dynamic, 6> rows(static_cast<Eigen::Index>(contacts.size()), 6);
    Eigen::Index row = 0;
    for (const Contact& contact : contacts)
        rows.row(row++) << contact.normal.transpose(), contact.point.cross(contact.normal).transpose();
    return rows;
}

} // namespace chasles
