#include "tests/attack/check_mesh.h"

#include "chasles/query/first_contact.h"
#include "tests/attack/check_inside.h"
#include "tests/attack/piecewise_tau.h"
#include "tests/attack/two_bodies.h"
#include "tests/support/exact_reference.h"

#include <chrono>
#include <cstdio>

namespace chasles::attack {

namespace {

using reference::ExactScene;
using reference::Surface;

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

PiecewiseTau truth_of(const MeshCase& posed) {
    const Surface moving = Surface::from_convex_faces(posed.moving.vertices, posed.moving.faces);
    const Surface fixed = Surface::from_convex_faces(posed.fixed.vertices, posed.fixed.faces);
    const auto paths = posed.posed.paths();
    for (std::size_t i = 0; i < paths.size(); ++i)
        if (auto found = ExactScene(moving, fixed, paths[i]).first_touch())
            return {std::move(found), i, paths.size()};
    return {std::nullopt, 0, paths.size()};
}

/// The number of detections that exact arithmetic decided, if the library counts them.
template <class AnyWork>
std::uint64_t exact_count(const AnyWork& work) {
    if constexpr (requires { work.exact; })
        return work.exact;
    else
        return 0;
}

std::string judged(const PiecewiseTau& truth, const FirstContact& found, Tally& tally) {
    const bool touches = found.verdict != Verdict::clear;
    tally.uncertain += found.certain ? 0 : 1;
    tally.touches += truth.tau ? 1 : 0;
    if (!truth.tau) {
        tally.false_alarms += touches ? 1 : 0;
        return !touches ? "" : found.certain ? "a false alarm that is certain" : "a false alarm";
    }
    if (!touches) {
        ++tally.missed;
        return "missed";
    }
    if (truth.compared_to(found.tau.lower) < 0) {
        ++tally.late;
        return "late";
    }
    const bool behind = truth.compared_to(found.tau.upper) > 0;
    if (!found.certain) {
        tally.loose += behind ? 1 : 0;
        return "";
    }
    if (found.verdict == Verdict::contact_at_start && truth.compared_to(0) > 0) {
        ++tally.misnamed;
        return "called a contact at the start";
    }
    tally.outside += behind ? 1 : 0;
    tally.widest = std::max(tally.widest, found.tau.upper - found.tau.lower);
    return behind ? "certain of a bracket that the touch is not in" : "";
}

void append(std::string& text, const char* format, double a, double b, double c) {
    char buffer[200];
    std::snprintf(buffer, sizeof buffer, format, a, b, c);
    text += buffer;
}

} // namespace

std::string check(const MeshCase& posed, Tally& tally) {
    const auto bodies = bodies_of(posed.moving, posed.fixed, tally);
    if (!bodies)
        return "";
    const FirstContactQuery query{.moving = bodies->moving, .fixed = bodies->fixed, .motion = posed.posed.motion()};
    double before = now();
    const FirstContact found = first_contact(query);
    tally.seconds += now() - before;
    ++tally.queries;
    tally.tests += found.work.elementary_tests;
    tally.refined += found.work.refined;
    tally.exact += exact_count(found.work);
    before = now();
    std::string wrong = judged(truth_of(posed), found, tally);
    if (wrong.empty())
        wrong = check_inside(query, found, tally);
    tally.reference_seconds += now() - before;
    if (!wrong.empty()) {
        wrong += found.certain ? ", certain" : ", not certain";
        append(wrong, ", tau in [%a, %a]", found.tau.lower, found.tau.upper, 0);
    }
    return wrong;
}

std::string described(const char* name, const Pose& pose) {
    std::string text = name;
    append(text, " %a %a %a", pose.translation.x(), pose.translation.y(), pose.translation.z());
    append(text, "  %a %a %a", pose.rotation.w(), pose.rotation.x(), pose.rotation.y());
    append(text, " %a\n", pose.rotation.z(), 0, 0);
    return text;
}

std::string described(const char* name, const Shape& shape) {
    std::string text = std::string(name) + "\n";
    for (const Eigen::Vector3d& v : shape.vertices)
        append(text, "  v %a %a %a\n", v.x(), v.y(), v.z());
    for (const auto& face : shape.faces) {
        text += "  f";
        for (const std::uint32_t vertex : face)
            text.append(" ").append(std::to_string(vertex));
        text += "\n";
    }
    return text;
}

std::string described(const MeshCase& posed) {
    std::string text;
    text += described("moving", posed.moving);
    text += described("fixed", posed.fixed);
    text += posed.posed.kind == MotionKind::screw ? "screw" : "sweep";
    text += posed.posed.is_relative ? ", both bodies move\n" : ", the fixed body stands still\n";
    append(text, "max_turn %a\n", posed.posed.max_turn, 0, 0);
    text += described("moving_start", posed.posed.moving_start);
    text += described("moving_goal", posed.posed.moving_goal);
    text += described("fixed_start", posed.posed.fixed_start);
    text += described("fixed_goal", posed.posed.fixed_goal);
    return text;
}

} // namespace chasles::attack
