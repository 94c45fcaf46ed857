// The rows of the contacts near a body: how a twist about its centre changes their gaps, and how it slides along them.
// Source: docs/derivations/08-contact-frame.md.
#pragma once

#include "chasles/manipulation/admissible_twist.h"
#include "chasles/manipulation/contact_model.h"

#include <span>

namespace chasles::manipulation {

/// A contact whose gap is at most so many margins touches: it pushes, and with friction it holds.
inline constexpr double touch_share = 1.125;

/// Two unit vectors that are orthogonal to each other and to a normal, as columns.
using Plane = Eigen::Matrix<double, 3, 2>;
Plane plane_across(const Eigen::Vector3d& normal);

/// One row (n, p x n) for each contact, p relative to the centre, with its whole gap.
TwistConstraints normal_rows(std::span<const ModelledContact> contacts, const Eigen::Vector3d& centre);

/// Two rows (t, p x t) for each contact, t the columns of plane_across(normal).
Rows tangent_rows(std::span<const ModelledContact> contacts, const Eigen::Vector3d& centre);

} // namespace chasles::manipulation
