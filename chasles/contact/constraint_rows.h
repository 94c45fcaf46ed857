// Contacts as linear constraints on the further motion, in the rows that solvers take.
// Source: paper section 5.1; docs/derivations/08-contact-frame.md.
#pragma once

#include "chasles/contact/contact.h"

#include <Eigen/Geometry>
#include <span>

namespace chasles {

/// One row of six numbers for each contact: (n, p x n) with the contact's normal n and point p, in the world frame.
///
/// Let (v, w) be the twist of the moving body relative to the fixed body: v is the linear velocity (mesh unit per time)
/// of the body point at the world's origin, and w is the angular velocity (radians per time). The product of a row and
/// the twist is the rate of the contact's gap:
///
///     row . (v, w) > 0    the contact opens
///     row . (v, w) = 0    the bodies slide or roll on each other
///     row . (v, w) < 0    the contact closes: not allowed where the gap is used up
///
/// To first order, the contacts admit the twists with row . twist >= 0 for all rows. The twist of the query's own
/// motion has row . twist = -approach_speed.
///
/// Inline: a matrix that Eigen allocates must not pass from a library that was compiled for another processor.
inline Eigen::Matrix<double, Eigen::Dynamic, 6> constraint_rows(std::span<const Contact> contacts) {
    Eigen::Matrix<double, Eigen::Dynamic, 6> rows(static_cast<Eigen::Index>(contacts.size()), 6);
    Eigen::Index row = 0;
    for (const Contact& contact : contacts)
        rows.row(row++) << contact.normal.transpose(), contact.point.cross(contact.normal).transpose();
    return rows;
}

} // namespace chasles
