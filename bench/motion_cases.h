// Motions whose answer is known or can be checked without the library's own detections.
#pragma once

#include "bench/bodies.h"
#include "chasles/query/first_contact.h"

#include <string>
#include <vector>

namespace chasles::bench {

/// Two bodies, kept by reference, a motion, and the verdict that it must have.
struct MotionCase {
    std::string name;
    const Polyhedron& moving;
    const Polyhedron& fixed;
    ScrewMotion motion;
    Verdict expected;
};

/// Two copies of a body: the moving one comes from six directions over half a body length and turns by 20 degrees.
/// On the straight line from there the bodies would touch after three fifths of the way.
std::vector<MotionCase> into_contact(const NamedBody& body);

/// Five degrees up the thread, from 0.97 pitch above the assembled pose: free, with 49 micrometres of clearance.
MotionCase nut_step(const NutAndBolt& pair);

FirstContact answer(const MotionCase& test, Find find);

/// Empty, or why the answers to `first` and `any` cannot both be right: verdicts, brackets, and a discrete test of
/// its own at sampled times before the contact and right after it.
std::string contradiction(const MotionCase& test);

} // namespace chasles::bench
