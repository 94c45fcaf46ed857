// chasles robot: a robot along a path of configurations.
#include "chasles/io/text_scan.h"
#include "cli/commands.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "cli/report.h"
#include "cli/robot_pairs.h"
#include "cli/robot_question.h"
#include "cli/untested_text.h"
#include "cli/warnings.h"
#include "view/answer_json.h"
#include "view/names.h"
#include "view/page.h"
#include "view/proven_verdict.h"
#include "view/robot_record.h"
#include "view/stamped_speeds.h"
#include "view/why_uncertain.h"

#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace chasles::cli {
namespace {

constexpr const char* motion_name = "straight in joint space";

/// Empty for a robot without variables.
std::string joints_line(const Robot& robot, const Configuration& values) {
    std::string text;
    for (std::size_t i = 0; i < robot.variables().size(); ++i)
        text += fmt::format("{}{} {:.9g}", i > 0 ? ", " : "", robot.variables()[i].name, values[Eigen::Index(i)]);
    return text.empty() ? text : labelled("joints", text);
}

/// The lines after the contact. `Found` is RobotAnswer or RobotClearance.
template <typename Found>
std::string report_path(const RobotQuestion& question, const Found& found) {
    const std::size_t segments = question.path.segments().size();
    return labelled("path",
                    fmt::format("{}, {} searched", counted(segments, "segment"), counted(found.pairs, "pair"))) +
           report(found.work);
}

ProvenPath proven_path(const RobotQuestion& question, const RobotAnswer& found, const FirstContact& shown) {
    ProvenPath proven{found.segment, shown.clear_until, {}};
    if (question.has_stamps)
        proven.stamp = question.path.segments()[found.segment].begin;
    return proven;
}

std::string headline_of(const RobotQuestion& question, const RobotAnswer& found, const FirstContact& shown) {
    const double margin = question.options.margin;
    if (found.pair)
        return headline(shown, margin, motion_name);
    return naming_motion(found.verdict == Verdict::unknown
                             ? unknown_headline(proven_path(question, found, shown), margin, question.options.hold)
                             : clear_headline(*found.untested, question.options),
                         motion_name);
}

std::string robot_report(const RobotQuestion& question, const RobotAnswer& found,
                         const std::vector<RobotPair>& others) {
    const double margin = question.options.margin;
    FirstContact shown = found.contact;
    shown.verdict = found.verdict;
    const std::string why = view::why_uncertain(shown, found.segment + 1 == question.path.segments().size());
    if (question.has_stamps) {
        shown.time = found.time;
        shown.clear_until = found.clear_until;
    }
    std::string text = headline_of(question, found, shown);
    text += report(*found.untested);
    if (found.pair)
        text += report_pair(*found.pair, found.segment) + report_others(others) + report_contact(shown, margin, why);
    return text + joints_line(question.robot, found.configuration) + report_path(question, found);
}

std::string robot_report(const RobotQuestion& question, const RobotClearance& found, bool time_was_over) {
    if (!found.pair)
        return naming_motion(found.certain ? "CLEARANCE WITHOUT A LIMIT: no two bodies are tested"
                                           : "NO CLEARANCE PROVEN: the time was over before two bodies were searched",
                             motion_name) +
               report(*found.untested) + report_path(question, found);
    LeastDistance shown = found.nearest;
    if (question.has_stamps)
        shown.time = found.time;
    return headline(shown, motion_name, time_was_over) + report(*found.untested) +
           report_pair(*found.pair, found.segment) + report_least(shown, time_was_over) +
           joints_line(question.robot, found.configuration) + report_path(question, found);
}

/// CLEAR would say nothing.
void warn_if_untested(const UntestedPairs& untested, std::vector<std::string>& warnings) {
    if (untested.tested == 0)
        warnings.emplace_back("no pair is tested: see `untested` for the reasons");
}

/// The text of an answer in JSON, with the motion and the warnings.
std::string with_motion(view::Json answer, const RobotQuestion& question) {
    answer["motion"] = {{"kind", motion_name}};
    answer["warnings"] = question.warnings;
    return answer.dump() + "\n";
}

view::Json answer_json(const RobotQuestion& question, const RobotAnswer& found, const std::vector<RobotPair>& others) {
    view::Json answer = view::robot_answer_json(question.robot, found, question.has_stamps);
    for (const RobotPair& pair : others)
        answer["also"].push_back({pair.first, pair.second});
    return answer;
}

std::string clearance_json(const RobotQuestion& question, const RobotClearance& found, ExitStatus status) {
    view::Json answer = view::robot_clearance_json(question.robot, found, question.has_stamps);
    if (status == is_unknown)
        answer["verdict"] = view::name_of(Verdict::unknown);
    return with_motion(std::move(answer), question);
}

/// What a question refuses of motions gets the names of the files that say how bodies move.
template <typename Ask>
auto of_files(const RobotCommand& options, const Ask& ask) {
    try {
        return ask();
    } catch (const InvalidInput& error) {
        const std::string why = error.what();
        if (!why.starts_with("robot: "))
            throw;
        const std::string path = options.paths.size() != 1 ? "" : io::one_line(options.paths.front()) + ": ";
        throw InvalidInput((options.scene.empty() ? "" : io::one_line(options.scene) + ": ") + path + why);
    }
}

int run_clearance(const RobotCommand& options) {
    RobotQuestion question = read_question(options);
    const JointPath& path = question.path;
    const Limit limit(seconds_of(options.query.seconds));
    LeastDistanceOptions asked{.time_tolerance = question.options.time_tolerance, .find = question.options.find};
    if (!options.tolerance.empty())
        asked.tolerance = number_of("--tolerance", options.tolerance);
    RobotClearance found = of_files(options, [&] {
        return RobotChecker(question.robot, question.world()).least_distance(path, asked, question.handovers);
    });
    warn_if_untested(*found.untested, question.warnings);
    if (question.has_stamps)
        view::count_in_stamps(found.nearest.contacts, view::duration_of(path, found.segment));
    const bool time_was_over = !found.certain && limit.is_over();
    const ExitStatus status = status_of(found.distance, time_was_over);
    print(options.json ? clearance_json(question, found, status) : robot_report(question, found, time_was_over));
    print_warnings(question.warnings);
    return status;
}

int run_profile(const RobotCommand& options) {
    ProfileRequest request(options.profile, options.tolerance);
    RobotQuestion question = read_question(options);
    request.open_files();
    const Limit limit(seconds_of(options.query.seconds));
    RobotProfile answer = of_files(options, [&] {
        return RobotChecker(question.robot, question.world())
            .profile(question.path, request.options(), question.handovers);
    });
    warn_if_untested(*answer.untested, question.warnings);
    NamedProfile found{std::move(answer.distance), {}, true};
    for (const RobotPair& pair : answer.pairs)
        found.pairs.emplace_back(pair.first, pair.second);
    request.write(found);
    const ExitStatus status = status_of(found.distance, !found.distance.certain && limit.is_over());
    if (options.json) {
        view::Json json = request.json(found, status);
        json["untested"] = view::untested_json(*answer.untested);
        print(with_motion(std::move(json), question));
    } else {
        print(profile_headline(found.distance, motion_name) + report(*answer.untested) + request.text(found));
    }
    print_warnings(question.warnings);
    return status;
}

/// An error about a hold distance of the scene's file names the file.
RobotChecker checker_of(const RobotCommand& options, const RobotQuestion& question) {
    try {
        return RobotChecker(question.robot, question.world(), {question.options});
    } catch (const InvalidInput& error) {
        if (!question.scene || !question.scene->hold || !options.query.hold.empty())
            throw;
        throw InvalidInput(io::one_line(options.scene) + ": " + error.what());
    }
}

Certificate proof_of(const RobotChecker& checker, const RobotQuestion& question) {
    if (!question.handovers.empty())
        throw InvalidInput("certificate: answers with --handover are not certified");
    return certify(checker, question.path);
}

/// After the verdict: the page of a long path takes longer than the answer.
void write_page(OutputFile& page, const RobotCommand& options, const RobotQuestion& question, const JointPath& path,
                const RobotAnswer& found, std::optional<view::Curve> curve) {
    std::optional<ProgressBar> bar(std::in_place, "segments of the page", found.segment + 1);
    view::SceneRecord record = view::robot_record(question.robot, question.world(), {path, found, question.handovers},
                                                  [&](std::size_t segments) { bar->show(segments); });
    bar.reset();
    record.margin = question.options.margin;
    record.curve = std::move(curve);
    for (const std::string& robot : options.robot.robots)
        record.title += (record.title.empty() ? "" : ", ") + std::filesystem::path(robot).filename().string();
    page.write(view::scene_page(record));
    page.close();
    if (!options.json)
        print(page_lines(options.page, shapes_of(record.bodies)));
}

int run_robot(const RobotCommand& options) {
    RobotQuestion question = read_question(options);
    std::optional<OutputFile> page;
    if (!options.page.empty()) {
        view::require_page_template();
        page.emplace(options.page);
    }
    CertificateFile certificate(options.certificate);
    const RobotChecker checker = checker_of(options, question);
    const JointPath& path = question.path;
    const Limit limit(seconds_of(options.query.seconds));
    RobotAnswer found = of_files(options, [&] { return checker.first_contact(path, question.handovers); });
    const std::vector<RobotPair> others = others_at_start(checker, path, found);
    warn_if_untested(*found.untested, question.warnings);
    if (question.has_stamps)
        view::count_in_stamps(found.contact, view::duration_of(path, found.segment));
    view::Json json = answer_json(question, found, others);
    const bool is_in_time = certificate.write([&] { return proof_of(checker, question); }, json);
    print(options.json ? with_motion(std::move(json), question) : robot_report(question, found, others));
    print_warnings(question.warnings);
    if (page && found.verdict != Verdict::unknown)
        write_page(*page, options, question, path, found,
                   options.wants_curve
                       ? std::optional(view::curve_of(checker, path, question.options.margin, question.handovers))
                       : std::nullopt);
    return is_in_time ? status_of(found.verdict) : is_unknown;
}

} // namespace

void add_robot(CLI::App& app, Task& task) {
    const auto options = std::make_shared<RobotCommand>();
    CLI::App& command = *app.add_subcommand("robot", "Does a robot touch its world or itself along a path?");
    add_cell_options(command, options->robot);
    add_radii_option(command, options->robot.radii, "the shapes of the robot and of the bodies of the scene");
    add_robot_change_options(command, options->changes);
    command
        .add_option(
            "--path", options->paths,
            "table of configurations with the names of joints as its header, or a JointTrajectory of ROS as "
            "YAML or JSON; a robot without moving joints needs none, and one of several rests if it has one row")
        ->type_name("[NAME=]FILE")
        ->allow_extra_args(false);
    command
        .add_option("--handover", options->handovers,
                    "from this time on, at which a row of a path is, an attached part moves with this link; more links "
                    "that may touch the part may follow; one for each --handover")
        ->type_name("TIME,PART,LINK")
        ->allow_extra_args(false);
    command.add_option("--scene", options->scene, "JSON file of the world, as for `chasles scene`")->type_name("FILE");
    auto* const clearance = command.add_flag("--clearance", options->finds_clearance,
                                             "find how near the robot comes to its world and to itself");
    auto* const profile = command.add_flag("--profile", options->finds_profile,
                                           "find the distance of the nearest pair over the path, and which it is");
    profile->excludes(clearance);
    command
        .add_option("--tolerance", options->tolerance,
                    "aimed width of the bracket of the clearance, as a part of it (1e-6), or of the profile (0.01)")
        ->type_name("T");
    add_profile_options(command, options->profile, profile);
    options->query.margin.clear(); // that of the scene's file
    command
        .add_option("--margin", options->query.margin,
                    "distance of the surfaces that counts as contact; instead of the scene's")
        ->excludes(clearance)
        ->excludes(profile)
        ->type_name("D");
    command
        .add_option("--hold", options->query.hold,
                    "what is within the margin where a segment begins may move on, but never comes within this "
                    "distance; instead of the scene's")
        ->excludes(clearance)
        ->excludes(profile)
        ->type_name("H");
    add_seconds_option(command, options->query.seconds);
    command.add_option("--time-tolerance", options->query.time_tolerance, "aimed width of the bracket around the time")
        ->type_name("T")
        ->capture_default_str();
    auto* const any =
        command.add_flag("--any", options->query.any, "stop at any contact, which need not be the first one");
    any->excludes(clearance)->excludes(profile);
    command.add_flag("--all-contacts", options->query.all_contacts, "list every contact of the pair at its first one")
        ->excludes(any);
    command.add_flag("--json", options->json, "print one JSON object");
    auto* const page =
        command.add_option("--page", options->page, "write a page (HTML) that shows the robot on its way")
            ->excludes(clearance)
            ->excludes(profile)
            ->type_name("FILE");
    add_curve_option(command, options->wants_curve)->needs(page);
    add_certificate_options(command, options->certificate)->excludes(any)->excludes(clearance)->excludes(profile);
    command.callback([options, &task] {
        task = [options] {
            require_question_of(options->tolerance, options->finds_clearance || options->finds_profile);
            return options->finds_clearance ? run_clearance(*options)
                   : options->finds_profile ? run_profile(*options)
                                            : run_robot(*options);
        };
    });
}

} // namespace chasles::cli
