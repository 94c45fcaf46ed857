// Queries for two bodies.
#include "chasles/query/path.h"
#include "javascript/src/border.h"
#include "javascript/src/numbers_in.h"
#include "javascript/src/numbers_out.h"
#include "javascript/src/objects.h"

namespace chasles::javascript {
namespace {

struct TwoBodies {
    Polyhedron moving;
    Polyhedron fixed;
};

TwoBodies bodies_in(NumbersIn& in) {
    const Polyhedron& moving = bodies().get(in.number());
    return {moving, bodies().get(in.number())};
}

void answer_first_contact(Numbers& out, NumbersIn& in) {
    const auto [moving, fixed] = bodies_in(in);
    const QueryOptions options = options_in(in);
    const NamedMotion motion = motion_in(in);
    write(out, motion.numbers);
    write(out, first_contact({moving, fixed, motion.motion, options}));
}

/// With the segment, from 0, at the end.
void answer_path(Numbers& out, NumbersIn& in) {
    const auto [moving, fixed] = bodies_in(in);
    PathQuery query{.moving = moving, .fixed = fixed, .motions = {}, .options = options_in(in)};
    const MotionRule rule = rule_in(in);
    const std::vector<Pose> poses = in.poses("poses");
    if (poses.size() < 2)
        throw InvalidInput("poses: a path needs at least two, and there are " + std::to_string(poses.size()));
    for (std::size_t i = 0; i + 1 < poses.size(); ++i)
        query.motions.push_back(motion_between(rule, poses[i], poses[i + 1]).motion);
    const PathContact found = first_contact_on_path(query);
    write(out, motion_between(rule, poses[found.segment], poses[found.segment + 1]).numbers);
    write(out, found.contact);
    out.push_back(double(found.segment));
}

void answer_least_distance(Numbers& out, NumbersIn& in) {
    const auto [moving, fixed] = bodies_in(in);
    const LeastDistanceOptions options = least_options_in(in);
    const NamedMotion motion = motion_in(in);
    write(out, motion.numbers);
    write(out, least_distance({moving, fixed, motion.motion, options}));
}

void answer_profile(Numbers& out, NumbersIn& in) {
    const auto [moving, fixed] = bodies_in(in);
    const ProfileOptions options = profile_options_in(in);
    const NamedMotion motion = motion_in(in);
    write(out, motion.numbers);
    write(out, profile({moving, fixed, motion.motion, options}), options.margins);
}

/// Where the moving body is at a time of its motion.
void answer_pose(Numbers& out, NumbersIn& in) {
    const double time = in.time();
    write(out, motion_in(in).motion.pose_at(time));
}

} // namespace
} // namespace chasles::javascript

namespace js = chasles::javascript;

/// Both bodies, the options and the motion are in the numbers. Each function returns the number of numbers in the answer.
CHASLES_JAVASCRIPT(first_contact)() {
    return js::answered([](js::Numbers& out) {
        js::NumbersIn in(js::given_numbers());
        js::answer_first_contact(out, in);
    });
}

CHASLES_JAVASCRIPT(first_contact_on_path)() {
    return js::answered([](js::Numbers& out) {
        js::NumbersIn in(js::given_numbers());
        js::answer_path(out, in);
    });
}

/// The numbers are a time and a motion.
CHASLES_JAVASCRIPT(pose_at)() {
    return js::answered([](js::Numbers& out) {
        js::NumbersIn in(js::given_numbers());
        js::answer_pose(out, in);
    });
}

CHASLES_JAVASCRIPT(profile)() {
    return js::answered([](js::Numbers& out) {
        js::NumbersIn in(js::given_numbers());
        js::answer_profile(out, in);
    });
}

CHASLES_JAVASCRIPT(least_distance)() {
    return js::answered([](js::Numbers& out) {
        js::NumbersIn in(js::given_numbers());
        js::answer_least_distance(out, in);
    });
}
