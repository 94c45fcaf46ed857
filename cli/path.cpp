// chasles path: the motions through the poses of a file. With time stamps, times count in stamps.
#include "chasles/io/motion_files.h"
#include "chasles/io/text_scan.h"
#include "cli/certificate_file.h"
#include "cli/commands.h"
#include "cli/motion_rule.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "cli/report.h"
#include "cli/warnings.h"
#include "view/answer_json.h"
#include "view/names.h"
#include "view/proven_verdict.h"
#include "view/stamped_speeds.h"
#include "view/why_uncertain.h"

#include <fmt/format.h>
#include <memory>

namespace chasles::cli {
namespace {

struct PathOptions {
    BodyOptions bodies;
    QuestionOptions query;
    MotionOptions motion;
    std::string poses;
    CertificateOptions certificate;
    bool json = false;
};

struct PathQuestion {
    io::Path path;
    MotionRule rule;
    QueryOptions options;
    Bodies bodies;
    std::string file; ///< of the poses

    [[nodiscard]] bool has_stamps() const { return !path.stamps.empty(); }
    [[nodiscard]] bool is_one_motion() const { return has_stamps() && !view::has_tau(rule.kind); }
};

// Poses and numbers are read before meshes, which may be large.
PathQuestion read_path_question(const PathOptions& options) {
    io::Path path = io::load_path(options.poses);
    const MotionRule rule = rule_of(options.motion);
    const QueryOptions query = options_of(options.query);
    const Bodies bodies = load_bodies(options.bodies);
    path.warnings.insert(path.warnings.end(), bodies.warnings.begin(), bodies.warnings.end());
    return {path, rule, query, bodies, options.poses};
}

/// The poses `first` to `last` and their stamps as one motion.
TimedPoses track_of(const PathQuestion& question, std::size_t first, std::size_t last) {
    const auto& [poses, stamps, warnings] = question.path;
    const auto begin = static_cast<std::ptrdiff_t>(first), end = static_cast<std::ptrdiff_t>(last) + 1;
    return track_through(question.rule, {stamps.begin() + begin, stamps.begin() + end},
                         {poses.begin() + begin, poses.begin() + end});
}

/// The times of `found` may be stamps, and `why_uncertain` was asked before they were.
struct StampedContact {
    PathContact found;
    std::string why_uncertain;
};

// The ends keep their stamps exactly. Speeds become lengths per unit of the stamps.
void count_in_stamps(FirstContact& found, const TimedPoses& track) {
    const double first = track.stamps().front(), last = track.stamps().back();
    found.time = found.time.upper == 0 ? Bracket{first, first} : track.stamp_of(found.time);
    found.clear_until = found.clear_until == 1 ? last : track.stamp_of({found.clear_until, found.clear_until}).lower;
    view::count_in_stamps(found, last - first);
}

std::vector<Motion> motions_of(const PathQuestion& question) {
    const std::vector<Pose>& poses = question.path.poses;
    if (question.is_one_motion())
        return {track_of(question, 0, poses.size() - 1)};
    std::vector<Motion> motions;
    for (std::size_t i = 0; i + 1 < poses.size(); ++i)
        motions.push_back(motion_between(question.rule, poses[i], poses[i + 1]));
    return motions;
}

/// The whole path as one motion.
StampedContact answer_track(const PathQuestion& question) {
    const std::size_t segments = question.path.poses.size() - 1;
    const TimedPoses track = at_place(io::one_line(question.file), [&] { return track_of(question, 0, segments); });
    at_place(io::one_line(question.file), [&] { check_motion(question.bodies.moving, question.bodies.fixed, track); });
    PathContact found;
    found.contact = chasles::first_contact({.moving = question.bodies.moving,
                                            .fixed = question.bodies.fixed,
                                            .motion = track,
                                            .options = question.options});
    found.segment = found.contact.verdict == Verdict::clear
                        ? segments - 1
                        : track.segment_of(view::is_contact(found.contact.verdict) ? found.contact.time.lower
                                                                                   : found.contact.clear_until);
    std::string why = view::why_uncertain(found.contact);
    count_in_stamps(found.contact, track);
    return {std::move(found), std::move(why)};
}

/// The path segment by segment.
StampedContact answer_segments(const PathQuestion& question) {
    std::vector<Motion> motions = motions_of(question);
    for (std::size_t i = 0; i < motions.size(); ++i)
        at_place(fmt::format("{}: segment {} (from 0)", io::one_line(question.file), i),
                 [&] { check_motion(question.bodies.moving, question.bodies.fixed, motions[i]); });
    ProgressBar bar("segments", motions.size());
    PathContact found = first_contact_on_path({.moving = question.bodies.moving,
                                               .fixed = question.bodies.fixed,
                                               .motions = std::move(motions),
                                               .options = question.options,
                                               .progress = [&](std::size_t done) { bar.show(done); }});
    std::string why = view::why_uncertain(found.contact, found.segment + 2 == question.path.poses.size());
    if (question.has_stamps())
        count_in_stamps(found.contact, track_of(question, found.segment, found.segment + 1));
    return {std::move(found), std::move(why)};
}

view::MotionNumbers numbers_of_segment(const PathQuestion& question, std::size_t segment) {
    const auto& [poses, stamps, warnings] = question.path;
    view::MotionNumbers numbers = numbers_between(question.rule, poses[segment], poses[segment + 1]);
    if (question.has_stamps())
        numbers.span = {stamps[segment], stamps[segment + 1]};
    return numbers;
}

// The JSON of `check`, with the segment that the time and the motion belong to (for a clear path, the last segment).
view::Json path_json(const PathContact& found, const view::MotionNumbers& motion, const PathQuestion& question) {
    view::Json answer = view::answer_json(found.contact, motion);
    answer["segment"] = found.segment;
    add_warnings(answer, question.path.warnings);
    return answer;
}

std::string segment_text(const PathQuestion& question, std::size_t segment) {
    const auto& [poses, stamps, warnings] = question.path;
    const std::string place = fmt::format("{} of {} (from 0)", segment, poses.size() - 1);
    if (question.has_stamps())
        return fmt::format("{}, from pose {} at t = {} to pose {} at t = {}; the time counts as t", place, segment,
                           stamps[segment], segment + 1, stamps[segment + 1]);
    return fmt::format("{}; the time counts from pose {} to pose {}", place, segment, segment + 1);
}

std::string path_headline(const PathContact& found, const PathQuestion& question) {
    const auto& [margin, hold, tolerance, find] = question.options;
    const std::string_view motion = view::name_of(question.rule.kind);
    if (found.contact.verdict == Verdict::clear && hold)
        return naming_motion(
            "CLEAR: proven that the bodies keep the hold distance, or that of the start of a segment if it is "
            "less, during the whole motion",
            motion);
    if (found.contact.verdict != Verdict::unknown)
        return headline(found.contact, margin, motion);
    ProvenPath proven{found.segment, found.contact.clear_until, {}};
    if (question.has_stamps())
        proven.stamp = question.path.stamps[found.segment];
    return naming_motion(unknown_headline(proven, margin, hold), motion);
}

std::string path_report(const StampedContact& answer, const view::MotionNumbers& motion, const PathQuestion& question) {
    const PathContact& found = answer.found;
    const double margin = question.options.margin;
    const std::string first_line = path_headline(found, question);
    if (!view::is_contact(found.contact.verdict))
        return first_line + labelled("path", counted(question.path.poses.size() - 1, "segment")) +
               report(found.contact.work);
    return first_line + labelled("segment", segment_text(question, found.segment)) +
           details(found.contact, motion, margin, answer.why_uncertain) +
           way_out_line(found.contact, question.options, {question.bodies.moving, question.bodies.fixed});
}

int run_path(const PathOptions& options) {
    const PathQuestion question = read_path_question(options);
    print_warnings(question.path.warnings);
    CertificateFile certificate(options.certificate);
    const Limit limit(seconds_of(options.query.seconds));
    const StampedContact answer = question.is_one_motion() ? answer_track(question) : answer_segments(question);
    const PathContact& found = answer.found;
    const view::MotionNumbers motion = numbers_of_segment(question, found.segment);
    view::Json json = path_json(found, motion, question);
    const auto prove = [&] {
        return certify(chasles::PathQuery{.moving = question.bodies.moving,
                                          .fixed = question.bodies.fixed,
                                          .motions = motions_of(question),
                                          .options = question.options});
    };
    const bool is_in_time = certificate.write(prove, json);
    print(options.json ? json.dump() + "\n" : path_report(answer, motion, question));
    return is_in_time ? status_of(found.contact.verdict) : is_unknown;
}

} // namespace

void add_path(CLI::App& app, Task& task) {
    const auto options = std::make_shared<PathOptions>();
    CLI::App& command = *app.add_subcommand("path", "When do two bodies first touch on a path of many poses?");
    add_body_options(command, options->bodies);
    command
        .add_option(
            "--poses", options->poses,
            "table with the columns x,y,z,qw,qx,qy,qz in any order, one pose a row, and perhaps t, the time stamp; "
            "or a TUM trajectory")
        ->required()
        ->type_name("FILE");
    add_motion_rule_options(command, options->motion);
    add_query_options(command, options->query);
    add_certificate_options(command, options->certificate);
    command.add_flag("--json", options->json, "print one JSON object");
    command.callback([options, &task] { task = [options] { return run_path(*options); }; });
}

} // namespace chasles::cli
