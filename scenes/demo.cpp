#include "scenes/demo.h"

#include "chasles/query/batch.h"
#include "chasles/query/path.h"
#include "scenes/nut_motions.h"
#include "scenes/stopwatch.h"
#include "scenes/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace chasles::scenes {

namespace {

constexpr double max_turn = std::numbers::pi / 18; // 10 degrees, the default of the queries

// The nut is on the bolt with the threads in phase. Its top is less than one pitch below the bolt's tip.
struct Stage {
    ThreadedFastener size;
    Polyhedron bolt;
    Polyhedron nut;
    double nut_height;
};

bool is_clear(const FirstContact& answer) {
    return answer.verdict == Verdict::clear;
}

Stage built(const ThreadedFastener& size) {
    const double pitches = std::floor((size.bolt_length - size.nut_height) / size.pitch);
    return {size, bolt(size), nut(size), std::max(0.0, pitches) * size.pitch};
}

// --- Queries ---------------------------------------------------------------------------------------------------------

// Answers all steps of a turn at the same time on all cores. The result is clear if every step is clear, otherwise the
// first contact.
FirstContact answer_for_turn(const Stage& stage, const NutTurn& motion) {
    const std::vector<Pose> poses = nut_path(motion);
    const std::vector<Motion> steps = screws_along(poses, max_turn);
    const std::vector<FirstContact> answers =
        first_contact_batch({.moving = stage.nut, .fixed = stage.bolt, .motions = steps});
    const auto touching = std::ranges::find_if_not(answers, &is_clear);
    FirstContact found = touching == answers.end() ? answers.back() : *touching;
    found.work = {};
    for (const FirstContact& answer : answers)
        found.work += answer.work;
    return found;
}

PathContact answer_for_path(const Stage& stage, const NutTurn& motion) {
    const std::vector<Pose> poses = nut_path(motion);
    return first_contact_on_path({.moving = stage.nut, .fixed = stage.bolt, .motions = screws_along(poses, max_turn)});
}

FirstContact answer_for_pull(const Stage& stage) {
    const Pose start = nut_pose({.height = stage.nut_height}, 0);
    const Pose goal = nut_pose({.height = stage.size.bolt_length}, 0);
    return first_contact({.moving = stage.nut, .fixed = stage.bolt, .motion = ScrewMotion::between(start, goal)});
}

// An upper bound on how much the facets and the uneven slide of the pieces reduce the play between the flanks.
double play_lost(const Stage& stage, double slide_per_turn) {
    return axial_facet_error(stage.size) + slide_deviation(slide_per_turn, max_turn);
}

// --- Output ----------------------------------------------------------------------------------------------------------

void print_line(std::ostream& out, std::string_view name, const std::string& text) {
    out << fmt::format("   {:<11}{}\n", name, text);
}

std::string grouped(std::uint64_t number) {
    std::string text = std::to_string(number);
    for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > 0; at -= 3)
        text.insert(at, 1, ',');
    return text;
}

std::string named(const Verdict verdict) {
    if (verdict == Verdict::clear)
        return "proven clear";
    return verdict == Verdict::contact ? "contact" : "contact at the start";
}

std::string named(const FirstContact& found) {
    return named(found.verdict) + (found.certain ? "" : ", within the error bound of a miss");
}

std::string named(FeatureKind kind, const Feature& feature) {
    if (kind == FeatureKind::edge)
        return fmt::format("edge {}-{}", feature.first, feature.second);
    return fmt::format("{} {}", kind == FeatureKind::vertex ? "vertex" : "face", feature.first);
}

std::string named(const Contact& contact) {
    return named(moving_feature_kind(contact.kind), contact.moving) + " of the nut on " +
           named(fixed_feature_kind(contact.kind), contact.fixed) + " of the bolt";
}

std::string printed(const Eigen::Vector3d& vector) {
    return fmt::format("({:.6f}, {:.6f}, {:.6f})", vector.x(), vector.y(), vector.z());
}

void print_contacts(std::ostream& out, const FirstContact& found) {
    for (const Contact& contact : found.contacts) {
        print_line(out, "features", named(contact));
        print_line(
            out, "at",
            fmt::format("{} mm, {:.4f} mm from the axis", printed(contact.point), contact.point.head<2>().norm()));
        print_line(out, "normal", printed(contact.normal));
    }
}

void print_cost(std::ostream& out, const Work& work, const Stopwatch& watch) {
    print_line(out, "cost",
               fmt::format("{} elementary tests, {} node pairs, {:.3f} s", grouped(work.elementary_tests),
                           grouped(work.node_pairs), watch.seconds()));
}

bool report_outcome(std::ostream& out, bool is_as_expected) {
    print_line(out, is_as_expected ? "right" : "WRONG", is_as_expected ? "as expected" : "not as expected");
    out << '\n';
    return is_as_expected;
}

// --- The three motions -----------------------------------------------------------------------------------------------

void print_stage(std::ostream& out, const Stage& stage) {
    const ThreadedFastener& size = stage.size;
    out << fmt::format("A nut on its bolt: M{:g} x {:g}, {} facets a turn; lengths in millimetres\n\n",
                       size.nominal_diameter, size.pitch, size.segments);
    print_line(out, "bolt",
               fmt::format("{} triangles, {:g} mm of thread", grouped(stage.bolt.face_count()), size.bolt_length));
    print_line(out, "nut",
               fmt::format("{} triangles, {:g} mm high, standing {:g} mm above the bolt's head",
                           grouped(stage.nut.face_count()), size.nut_height, stage.nut_height));
    print_line(out, "play",
               fmt::format("{:.6f} mm along the axis either way; facets take at most {:.6f} mm of it",
                           axial_clearance(size), play_lost(stage, size.pitch)));
    out << '\n';
}

bool unscrew(std::ostream& out, const Stage& stage) {
    const double pitch = stage.size.pitch;
    const int turns = static_cast<int>(std::floor((stage.size.bolt_length - stage.nut_height) / pitch)) + 1;
    out << fmt::format("1. Unscrew it: {:g} mm a turn, in motions of 10 degrees\n\n", pitch);
    out << "   turn   verdict        elementary tests   node pairs   seconds\n";
    bool is_free = true;
    for (int turn = 0; turn < turns && is_free; ++turn) {
        const Stopwatch watch;
        const FirstContact found =
            answer_for_turn(stage, {.height = stage.nut_height + turn * pitch, .turns = 1, .slide_per_turn = pitch});
        out << fmt::format("   {:>4}   {:<13}  {:>16}   {:>10}   {:>7.3f}\n", turn + 1, named(found.verdict),
                           grouped(found.work.elementary_tests), grouped(found.work.node_pairs), watch.seconds())
            << std::flush;
        is_free = is_clear(found);
        print_contacts(out, found);
    }
    out << '\n';
    if (is_free)
        print_line(out, "result", fmt::format("the nut is off the bolt after {} turns and touched nothing", turns));
    return report_outcome(out, is_free);
}

// In phase the nut can move by exactly the axial clearance, independent of the facets (derivation 09).
bool pull(std::ostream& out, const Stage& stage) {
    const Stopwatch watch;
    const FirstContact found = answer_for_pull(stage);
    const double way = stage.size.bolt_length - stage.nut_height;
    const double travel = found.time.lower * way;
    const double expected = axial_clearance(stage.size);
    out << fmt::format("2. Pull it straight off, {:g} mm along the axis\n\n", way);
    print_line(out, "verdict", named(found));
    print_line(out, "travel",
               fmt::format("{:.12f} mm, time {:.15g} .. {:.15g}", travel, found.time.lower, found.time.upper));
    print_line(out, "expected", fmt::format("{:.12f} mm, the play between the flanks", expected));
    print_contacts(out, found);
    print_cost(out, found.work, watch);
    return report_outcome(out, found.verdict == Verdict::contact && std::abs(travel - expected) < 1e-9);
}

// Per turn the nut strays from the thread by the difference of the pitches. It cannot touch before it has strayed by
// the play that the facets leave. Once it has strayed by the whole play, it must touch before its facets are in phase
// with the bolt's facets again.
bool screw_wrongly(std::ostream& out, const Stage& stage) {
    const double pitch = stage.size.pitch;
    const double wrong = 0.875 * pitch;
    const double first = axial_clearance(stage.size) - play_lost(stage, wrong);
    const double last = axial_clearance(stage.size) + (pitch - wrong) / stage.size.segments;
    const Stopwatch watch;
    const NutTurn motion{.height = stage.nut_height, .turns = 1, .slide_per_turn = wrong};
    const auto [found, segment] = answer_for_path(stage, motion);
    const double turns = (static_cast<double>(segment) + found.time.lower) / steps_per_turn;
    const double slide = found.pose.translation.z() - stage.nut_height;
    const double strayed = turns * pitch - slide;
    out << fmt::format("3. Unscrew it by the wrong pitch: {:g} mm a turn instead of {:g}\n\n", wrong, pitch);
    print_line(out, "verdict", named(found));
    print_line(out, "turn", fmt::format("{:.6f} degrees, with a slide of {:.6f} mm", 360 * turns, slide));
    print_line(out, "strayed", fmt::format("{:.6f} mm from the thread", strayed));
    print_line(out, "expected", fmt::format("{:.6f} to {:.6f} mm", first, last));
    print_contacts(out, found);
    print_cost(out, found.work, watch);
    return report_outcome(out, found.verdict == Verdict::contact && strayed >= first && strayed <= last);
}

} // namespace

int run_demo(std::ostream& out, const SaveFile& save) {
    return run_demo(out, ThreadedFastener{}, save);
}

int run_demo(std::ostream& out, const ThreadedFastener& fastener, const SaveFile& save) {
    const Stopwatch watch;
    const Stage stage = built(fastener);
    if (save) {
        save("bolt.obj", obj_text(stage.bolt));
        save("nut.obj", obj_text(stage.nut));
    }
    print_stage(out, stage);
    const bool is_unscrewed = unscrew(out, stage);
    const bool is_held = pull(out, stage);
    const bool is_jammed = screw_wrongly(out, stage);
    const bool is_right = is_unscrewed && is_held && is_jammed;
    out << fmt::format("{} in {:.2f} s\n", is_right ? "All as expected" : "NOT as expected", watch.seconds());
    return is_right ? 0 : 1;
}

} // namespace chasles::scenes
