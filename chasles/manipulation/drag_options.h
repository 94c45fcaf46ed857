// How a body is dragged, by what is in a hand. Source: docs/derivations/30-dragged-body.md.
#pragma once

#include "chasles/manipulation/drag_lock.h"
#include "chasles/manipulation/mass_properties.h"

#include <optional>

namespace chasles {

/// How a body is dragged.
struct DragOptions {
    /// The gap that the body keeps where it touches, mesh unit. 0: a ten-thousandth of the diagonal of its box. Two
    /// walls closer than twice the margin to the body are kept at equal distances.
    double margin = 0;
    double reach = 0;     ///< contacts within it are foreseen, at least 1.25 times the margin; 0: just that
    double stiffness = 1; ///< of the spring between the body and the hand: force per mesh unit
    int rounds = 8;       ///< of one update at most; each goes one certified step
    std::optional<MassProperties> mass = {}; ///< empty: those of the solid box around the body
    /// Of Coulomb: the greatest friction force of a contact, as a share of its normal force; not negative, at most 100.
    /// The body rests where friction can hold it, and so a body that is clamped between contacts stays.
    double friction = 0;
    DragLock lock = {}; ///< the body moves only as the lock lets it, from where it is at first
};

} // namespace chasles
