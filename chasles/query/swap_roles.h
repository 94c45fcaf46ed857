// An answer after the bodies have swapped their roles.
#pragma once

#include "chasles/contact/contact.h"

#include <utility>
#include <vector>

namespace chasles::query {

inline void swap_roles(std::vector<Contact>& contacts) {
    for (Contact& contact : contacts)
        contact = contact.swapped();
}

/// What all answers have: contacts, overlap, inside and poses.
template <class Answer>
void swap_roles(Answer& answer) {
    swap_roles(answer.contacts);
    if (answer.overlap)
        answer.overlap->edge_is_moving = !answer.overlap->edge_is_moving;
    if (answer.inside)
        answer.inside->moving_is_inside = !answer.inside->moving_is_inside;
    std::swap(answer.pose, answer.fixed_pose);
}

} // namespace chasles::query
