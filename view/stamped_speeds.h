// Speeds of contacts that stand beside times in stamps.
#pragma once

#include "chasles/robot/robot.h"

#include <span>

namespace chasles::view {

/// Speeds become lengths per unit of the stamps, of which the time from 0 to 1 takes so many.
inline void count_in_stamps(std::span<Contact> contacts, double duration) {
    for (Contact& contact : contacts)
        contact.approach_speed /= duration;
}

/// Those of an answer.
inline void count_in_stamps(FirstContact& found, double duration) {
    count_in_stamps(found.contacts, duration);
    count_in_stamps(found.held, duration);
}

/// How many stamps a segment of a path takes.
inline double duration_of(const JointPath& path, std::size_t segment) {
    return path.segments()[segment].end - path.segments()[segment].begin;
}

} // namespace chasles::view
