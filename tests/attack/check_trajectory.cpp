#include "tests/attack/check_trajectory.h"

#include "chasles/base/invalid_input.h"
#include "tests/attack/check_inside.h"
#include "tests/attack/check_mesh.h"
#include "tests/attack/contact_geometry.h"
#include "tests/attack/touch_search.h"
#include "tests/attack/two_bodies.h"

#include <chrono>

namespace chasles::attack {

namespace {

using Clock = std::chrono::steady_clock;

/// A contact that is not certain is no false alarm if the surfaces come as near as this, relative to the scene.
constexpr double nearly_touching = 1e-10;
/// A certain bracket is as wide as the time tolerance, or wider by a few roundings.
constexpr double widest_bracket = 1e-12 + 0x1p-48;

/// A body that moves by less, relative to the scene, may be bracketed less closely.
constexpr double least_way = 0x1p-70;

/// The reference has found a touch that does not graze.
constexpr double decided_width = 0x1p-47;

/// Where a proof of the reference contradicts the answer.
enum class Fault : std::uint8_t { none, missed, false_alarm, late, outside, misnamed };

Fault fault_of(const TrueTouch& truth, const FirstContact& found) {
    if (found.verdict == Verdict::clear)
        return truth.upper ? Fault::missed : Fault::none;
    if (truth.is_clear && found.certain)
        return Fault::false_alarm;
    if (truth.upper && std::min(found.time.lower, found.clear_until) > *truth.upper)
        return Fault::late;
    if (truth.upper && found.clear_until > *truth.upper)
        return Fault::late;
    if (!found.certain || truth.is_clear)
        return Fault::none;
    if (found.verdict == Verdict::contact_at_start && truth.lower > 0)
        return Fault::misnamed;
    return found.time.upper < truth.lower ? Fault::outside : Fault::none;
}

/// For Find::first. The bracket of Find::any is of some contact, which may be a late one.
Fault fault_of_first(const TrueTouch& truth, const FirstContact& found) {
    return truth.upper && found.verdict != Verdict::clear && found.time.lower > *truth.upper ? Fault::late
                                                                                             : Fault::none;
}

Fault fault_of(const TrueTouch& truth, const FirstContact& found, Find find) {
    const Fault fault = fault_of(truth, found);
    return fault == Fault::none && find != Find::any ? fault_of_first(truth, found) : fault;
}

std::string counted(Fault fault, Tally& tally) {
    switch (fault) {
    case Fault::none:
        return "";
    case Fault::missed:
        ++tally.missed;
        return "missed";
    case Fault::false_alarm:
        ++tally.false_alarms;
        return "a false alarm that is certain";
    case Fault::late:
        ++tally.late;
        return "late";
    case Fault::outside:
        ++tally.outside;
        return "certain of a bracket that the touch is not in";
    default:
        ++tally.misnamed;
        return "called a contact at the start";
    }
}

/// Contacts without certainty must be nearly touches.
bool is_far_from_touching(const TrajectoryCase& posed, double size) {
    const TouchOptions options{.margin = nearly_touching * size, .wide_only = true};
    return first_touch(posed.moving, posed.fixed, posed.motion.truth, options).is_clear;
}

/// How far the vertices move from a time to a later one.
double way_between(const TrajectoryCase& posed, double from, double to) {
    const TruePose start = posed.motion.truth.at(std::max(0.0, from));
    const TruePose end = posed.motion.truth.at(std::min(1.0, to));
    double most = 0;
    for (const Eigen::Vector3d& v : posed.moving.vertices) {
        const WideVector way = (end.turn - start.turn) * widened(v) + end.place - start.place;
        most = std::max(most, double(way.norm()));
    }
    return most;
}

std::string text_of(const TrueTouch& truth) {
    char buffer[100];
    std::snprintf(buffer, sizeof buffer, ", truth in [%.17g, %.17g]", truth.lower, truth.upper.value_or(2));
    return buffer;
}

std::string judged(const TrajectoryCase& posed, const FirstContact& found, Tally& tally) {
    TrueTouch truth = first_touch(posed.moving, posed.fixed, posed.motion.truth);
    tally.touches += truth.upper ? 1 : 0;
    tally.at_start += truth.upper == 0.0 ? 1 : 0;
    tally.near += !truth.upper && !truth.is_clear ? 1 : 0;
    const bool touches = found.verdict != Verdict::clear;
    if (fault_of(truth, found, posed.find) != Fault::none) { // only multiprecision refutes
        truth = first_touch(posed.moving, posed.fixed, posed.motion.truth, {.wide_only = true});
        if (const Fault fault = fault_of(truth, found, posed.find); fault != Fault::none)
            return counted(fault, tally) + text_of(truth);
    }
    const double size = scene_size(posed.moving, posed.fixed, posed.motion.truth);
    if (touches && truth.is_clear && is_far_from_touching(posed, size)) {
        ++tally.false_alarms;
        return "a false alarm";
    }
    if (!found.certain) {
        tally.loose += truth.upper && found.time.upper < truth.lower ? 1 : 0;
        tally.doubted += truth.upper && *truth.upper - truth.lower < decided_width ? 1 : 0;
        return "";
    }
    const double width = found.time.upper - found.time.lower;
    if (posed.find != Find::any) // a verdict, whose bracket may be wide
        tally.widest = std::max(tally.widest, width);
    const bool is_wide = posed.find != Find::any && width > widest_bracket;
    if (is_wide && way_between(posed, found.time.lower, found.time.upper) > least_way * size) {
        ++tally.wide;
        return "certain of a wide bracket";
    }
    return "";
}

/// How much longer than high the thinnest face of a shape is. Its normal, from corners in double, has an error that is
/// larger by this factor, and what lies along the normal, too.
double thinness(const Shape& shape) {
    double most = 1;
    for (const std::vector<std::uint32_t>& face : shape.faces)
        for (std::size_t i = 0; i + 2 < face.size(); ++i) {
            const Eigen::Vector3d a = shape.vertices[face[0]], b = shape.vertices[face[i + 1]] - a,
                                  c = shape.vertices[face[i + 2]] - a;
            const double longest = std::max({b.squaredNorm(), c.squaredNorm(), (b - c).squaredNorm()});
            most = std::max(most, longest / b.cross(c).norm());
        }
    return most;
}

/// Compares poses and contacts in double. Both are rounded by the library, which proves none of their digits. Where the
/// body is very fast, the rounding of times counts, too.
std::string misplaced_in(const TrajectoryCase& posed, const FirstContactQuery& query, const FirstContact& found) {
    const TrueMotion& motion = posed.motion.truth;
    const double size = scene_size(posed.moving, posed.fixed, motion) + motion.size;
    const auto error = [&](const Pose& moving, const Pose& fixed, double time) {
        const Eigen::Isometry3d truth = narrowed(motion.at(time));
        const Eigen::Isometry3d seen = fixed.isometry().inverse() * moving.isometry();
        double most = 0;
        for (const Eigen::Vector3d& v : posed.moving.vertices)
            most = std::max(most, (truth * v - seen * v).norm());
        return most;
    };
    const Motion& claimed = query.motion;
    if (!(error(claimed.pose_at(posed.time), claimed.fixed_pose_at(posed.time), posed.time) <= 1e-13 * size))
        return "a pose is not that of the motion";
    const double time = found.verdict == Verdict::clear ? 1 : found.time.lower;
    constexpr double of_time = 0x1p-50;
    const double way = way_between(posed, time - of_time, time + of_time);
    if (!(error(found.pose, found.fixed_pose, time) <= 1e-13 * size + way))
        return "the pose of the answer is not that of the motion";
    // Contacts are placed on a sweep that is made in double: with some ten times the rounding of a pose. A set has
    // contacts that are in doubt, too.
    const bool is_placed = found.certain && found.verdict == Verdict::contact && way <= 1e-14 * size;
    constexpr double of_usual_shapes = 0x1p10;
    const double thin = std::max(1.0, std::max(thinness(posed.moving), thinness(posed.fixed)) / of_usual_shapes);
    return is_placed ? misplaced(query, found, 16 * size * motion.elements * thin) : "";
}

std::string text_of(const FirstContact& found) {
    char buffer[200];
    std::snprintf(buffer, sizeof buffer, ": verdict %d, time in [%.17g, %.17g], clear until %.17g%s",
                  int(found.verdict), found.time.lower, found.time.upper, found.clear_until,
                  found.certain ? ", certain" : "");
    return buffer;
}

} // namespace

std::string check(const TrajectoryCase& posed, Tally& tally) {
    const auto bodies = bodies_of(posed.moving, posed.fixed, tally);
    if (!bodies)
        return "";
    const auto& [moving, fixed] = *bodies;
    const FirstContactQuery query{
        .moving = moving, .fixed = fixed, .motion = posed.motion.motion, .options = {.find = posed.find}};
    const auto start = Clock::now();
    const FirstContact found = first_contact(query);
    const auto end = Clock::now();
    ++tally.queries;
    tally.uncertain += found.certain ? 0 : 1;
    tally.tests += found.work.elementary_tests;
    tally.refined += found.work.refined;
    tally.exact += found.work.exact;
    tally.seconds += std::chrono::duration<double>(end - start).count();
    std::string wrong = judged(posed, found, tally);
    if (wrong.empty())
        wrong = check_inside(query, found, tally);
    if (wrong.empty()) {
        wrong = misplaced_in(posed, query, found);
        tally.misplaced += wrong.empty() ? 0 : 1;
    }
    tally.reference_seconds += std::chrono::duration<double>(Clock::now() - end).count();
    return wrong.empty() ? "" : wrong + text_of(found);
}

std::string described(const TrajectoryCase& posed) {
    return posed.motion.text + described("moving", posed.moving) + described("fixed", posed.fixed) + "find " +
           std::to_string(int(posed.find)) + "\n";
}

} // namespace chasles::attack
