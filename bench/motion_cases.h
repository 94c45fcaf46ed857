// Motions whose answer is known, or can be checked without the library's detections.
#pragma once

#include "bench/bodies.h"
#include "chasles/query/first_contact.h"

#include <string>
#include <vector>

namespace chasles::bench {

/// Two bodies (by reference), a motion, and the expected verdict.
struct MotionCase {
    std::string name;
    const Polyhedron& moving;
    const Polyhedron& fixed;
    ScrewMotion motion;
    Verdict expected;
};

/// Two copies of a body. The moving copy comes from six directions over half a body length and turns by 20 degrees.
/// Without the turn the bodies would touch after three fifths of the motion.
std::vector<MotionCase> into_contact(const NamedBody& body);

/// Five degrees up the thread, from 0.97 pitch above the assembled pose. The motion is clear, with 49 micrometres of
/// clearance.
MotionCase nut_step(const NutAndBolt& pair);

FirstContact answer(const MotionCase& test, Find find);

/// Empty, or the reason why the answers with `first` and `any` cannot both be right. This function compares verdicts
/// and brackets, and runs a discrete test at sampled times before the contact and just after it.
std::string contradiction(const MotionCase& test);

} // namespace chasles::bench
