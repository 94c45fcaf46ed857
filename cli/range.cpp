// chasles range: which configurations of some joints of a robot are clear, proven.
#include "chasles/robot/range.h"
#include "chasles/io/text_scan.h"
#include "cli/commands.h"
#include "cli/interruption.h"
#include "cli/joint_trajectory.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "cli/range_picture.h"
#include "cli/report.h"
#include "cli/robot_question.h"
#include "cli/untested_text.h"
#include "cli/warnings.h"
#include "view/names.h"
#include "view/range_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <tuple>

namespace chasles::cli {
namespace {

struct RangeCommand {
    RobotCommand robot; ///< without a path
    std::vector<std::string> joints;
    std::vector<std::string> from; ///< a file, and perhaps the number of a row
    std::string tolerance = "0.01";
    std::string seconds = "60";
    std::string plot;
    unsigned threads = 0;
    bool finds_clear_box = false;
};

/// The configuration in which all other joints stay.
Configuration configuration_of(const RangeCommand& options, const Robot& robot, std::vector<std::string>& warnings) {
    if (options.from.empty())
        return robot.neutral();
    robot::ConfigurationRows rows = load_joint_path(options.from[0], robot, 1);
    warnings.insert(warnings.end(), rows.warnings.begin(), rows.warnings.end());
    const double row = options.from.size() < 2 ? 0 : number_of("--from", options.from[1]);
    if (!(row >= 0 && row < double(rows.configurations.size()) && row == double(std::size_t(row))))
        throw InvalidInput("--from: row " + options.from[1] + ": " + options.from[0] + " has the rows 0 to " +
                           std::to_string(rows.configurations.size() - 1));
    return rows.configurations[std::size_t(row)];
}

/// A joint of --joints: NAME, or NAME=LOWER:UPPER with ends of its own.
struct JointRange {
    std::string name;
    std::optional<std::pair<double, double>> ends;
};

JointRange joint_range_of(const Robot& robot, const std::string& given) {
    const std::size_t sign = given.rfind('=');
    const auto variables = robot.variables();
    if (sign == std::string::npos || std::ranges::find(variables, given, &RobotVariable::name) != variables.end())
        return {given, std::nullopt};
    const std::size_t colon = given.find(':', sign);
    if (colon == std::string::npos)
        throw InvalidInput("--joints: " + io::in_quotes(given) + " is not of the form NAME or NAME=LOWER:UPPER");
    const std::string place = "--joints: " + io::one_line(given.substr(0, sign));
    const double lower = number_of(place, given.substr(sign + 1, colon - sign - 1)),
                 upper = number_of(place, given.substr(colon + 1));
    if (!(lower < upper))
        throw InvalidInput(place + ": its lower end is not below its upper end");
    return {given.substr(0, sign), std::pair(lower, upper)};
}

/// Limits that no query takes. Bases that drive have them.
void refuse_far_limits(const Robot& robot, std::size_t variable) {
    constexpr double largest = 1000;
    const auto& [name, lower, upper, is_continuous] = robot.variables()[variable];
    if (std::isfinite(upper - lower) && std::max(-lower, upper) > largest)
        throw InvalidInput(fmt::format("--joints: {0}: the limits of the file, {1:.9g} to {2:.9g}, are beyond 1000 in "
                                       "magnitude, the largest value: give it a smaller range, {0}=LOWER:UPPER",
                                       io::one_line(name), lower, upper));
}

/// The box of the joints that keep their limits.
ConfigurationBox box_within_limits(const Robot& robot, const std::vector<std::string>& joints,
                                   const Configuration& configuration) {
    for (const std::string& joint : joints)
        refuse_far_limits(robot, robot.variable(joint));
    try {
        return box_of_joints(robot, joints, configuration);
    } catch (const InvalidInput& error) {
        const std::string why = error.what();
        throw InvalidInput(why + (why.ends_with("give the ends of its range") ? ", NAME=LOWER:UPPER" : ""));
    }
}

/// Ends of the command line may be beyond the limits, with a warning.
ConfigurationBox box_of(const RangeCommand& options, const Robot& robot, const Configuration& configuration,
                        std::vector<std::string>& warnings) {
    std::vector<JointRange> joints;
    std::vector<std::string> within_limits;
    std::set<std::size_t> taken;
    for (const std::string& given : options.joints) {
        const JointRange& joint = joints.emplace_back(joint_range_of(robot, given));
        if (!taken.insert(robot.variable(joint.name)).second)
            throw InvalidInput("range: " + joint.name + ": comes twice");
        if (!joint.ends)
            within_limits.push_back(joint.name);
    }
    ConfigurationBox box = box_within_limits(robot, within_limits, configuration);
    for (const auto& [name, ends] : joints) {
        if (!ends)
            continue;
        const std::size_t i = robot.variable(name);
        const RobotVariable& variable = robot.variables()[i];
        std::tie(box.lower[Eigen::Index(i)], box.upper[Eigen::Index(i)]) = *ends;
        if (ends->first < variable.lower || ends->second > variable.upper)
            warnings.push_back(fmt::format("--joints: {}: {:.9g} to {:.9g} is beyond the limits [{:.9g}, {:.9g}]",
                                           io::one_line(name), ends->first, ends->second, variable.lower,
                                           variable.upper));
    }
    return box;
}

/// Before the search, which takes its time.
void require_inside(const Robot& robot, const ConfigurationBox& box, const Configuration& configuration) {
    for (Eigen::Index i = 0; i < configuration.size(); ++i)
        if (configuration[i] < box.lower[i] || configuration[i] > box.upper[i])
            throw InvalidInput(fmt::format(
                "--clear-box: {} is {:.9g} in the configuration, outside of its range {:.9g} to "
                "{:.9g}; --from gives another configuration",
                io::one_line(robot.variables()[std::size_t(i)].name), configuration[i], box.lower[i], box.upper[i]));
}

/// A question, with all that is read.
struct RangeQuestion {
    Robot robot;
    std::optional<SceneFile> scene;
    QueryOptions query;
    RangeOptions options;
    Configuration configuration;
    ConfigurationBox box;
    std::vector<std::string> warnings;
};

RangeQuestion read_range_question(const RangeCommand& options) {
    (void)query_of(options.robot, std::nullopt); // what is wrong with an option comes first
    const RangeOptions asked{.tolerance = number_of("--tolerance", options.tolerance),
                             .seconds = number_of("--seconds", options.seconds),
                             .threads = options.threads,
                             .most_cells = 100'000'000};
    if (!options.plot.empty() && options.joints.size() != 2)
        throw InvalidInput("--plot: draws ranges of two joints, and --joints names " +
                           std::to_string(options.joints.size()));
    if (std::filesystem::path(options.plot).extension() == ".png")
        throw InvalidInput("--plot: " + options.plot +
                           ": pictures are SVG: name a file .svg; Python's range.plot() draws others");
    std::optional<SceneFile> scene = read_scene(options.robot);
    QueryOptions query = query_of(options.robot, scene);
    std::vector<std::string> warnings;
    Robot robot = read_robot(options.robot, scene, warnings);
    if (scene) {
        warnings.insert(warnings.end(), scene->warnings.begin(), scene->warnings.end());
        if (query.hold)
            warnings.push_back(io::one_line(options.robot.scene) + ": hold has no effect on a range");
        query.hold.reset();
    }
    Configuration configuration = configuration_of(options, robot, warnings);
    ConfigurationBox box = at_place("--joints", [&] { return box_of(options, robot, configuration, warnings); });
    if (options.finds_clear_box)
        require_inside(robot, box, configuration);
    for (const std::string& warning : robot.warnings_about(std::array{configuration}))
        warnings.push_back("configuration: " + warning);
    return {std::move(robot), std::move(scene),   query, asked, std::move(configuration),
            std::move(box),   std::move(warnings)};
}

std::string box_text(const Robot& robot, const ConfigurationBox& box, const std::vector<std::size_t>& joints) {
    std::string text;
    for (const std::size_t joint : joints)
        text += fmt::format("{}{} {:.6g} to {:.6g}", text.empty() ? "" : ", ", robot.variables()[joint].name,
                            box.lower[Eigen::Index(joint)], box.upper[Eigen::Index(joint)]);
    return text;
}

std::string witness_text(const Robot& robot, const RobotRange& found) {
    std::string text = labelled("pair", found.pair->first + " on " + found.pair->second +
                                            (found.pair->is_with_scene ? " (scene)" : ""));
    std::string joints;
    for (const std::size_t joint : found.joints)
        joints += fmt::format("{}{} {:.9g}", joints.empty() ? "" : ", ", robot.variables()[joint].name,
                              (*found.witness)[Eigen::Index(joint)]);
    return text + labelled("witness", joints);
}

std::string verdict_text(const RobotRange& found) {
    switch (found.verdict) {
    case RangeVerdict::clear:
        return "CLEAR in all configurations";
    case RangeVerdict::contact:
        return "CONTACT in some configurations";
    case RangeVerdict::open:
        break;
    }
    return "OPEN: no contact is found, and the rest is not proven";
}

std::string range_text(const RangeQuestion& question, const RobotRange& found,
                       const std::optional<ClearBox>& clear_box) {
    std::string text = verdict_text(found) + "\n" + report(*found.untested);
    text += labelled("joints", box_text(question.robot, question.box, found.joints));
    text += labelled("share", fmt::format("{:.3f} % clear, {:.3f} % in contact, {:.3f} % open", 100 * found.clear_share,
                                          100 * found.contact_share, 100 * found.open_share));
    if (found.witness)
        text += witness_text(question.robot, found);
    if (!found.clear.empty())
        text += labelled("proven", fmt::format("{}; the largest: {}",
                                               std::to_string(found.clear.size()) +
                                                   (found.clear.size() == 1 ? " clear box" : " clear boxes"),
                                               box_text(question.robot, found.clear.front(), found.joints)));
    if (clear_box)
        text +=
            labelled("clear box",
                     clear_box->verdict == RangeVerdict::clear
                         ? box_text(question.robot, clear_box->box, found.joints)
                         : "none: the configuration is " +
                               std::string(clear_box->verdict == RangeVerdict::contact ? "in contact" : "not decided"));
    return text + labelled("cells", std::to_string(found.cells));
}

ExitStatus exit_status_of(RangeVerdict verdict) {
    return verdict == RangeVerdict::clear ? is_clear : verdict == RangeVerdict::contact ? is_contact : is_unknown;
}

int run_range(const RangeCommand& options) {
    RangeQuestion question = read_range_question(options);
    const RobotChecker checker(question.robot, question.scene ? &question.scene->scene : nullptr, {question.query});
    std::optional<OutputFile> plot;
    if (!options.plot.empty())
        plot.emplace(options.plot);
    const Interruption interruption;
    const Limit until_interrupted(std::numeric_limits<double>::infinity(),
                                  [] { return !Interruption::is_requested(); });
    const RobotRange found = checker.range(question.box, question.options);
    std::optional<ClearBox> clear_box;
    if (options.finds_clear_box && !Interruption::is_requested())
        clear_box = checker.clear_box(question.box, question.configuration, question.options);
    const bool is_whole = !Interruption::is_requested();
    if (plot && is_whole) {
        plot->write(range_picture(question.robot, found, question.box, clear_box));
        plot->close();
    }
    if (found.untested->tested == 0)
        question.warnings.emplace_back("no pair is tested: see `untested` for the reasons");
    if (options.robot.json) {
        view::Json json = view::range_json(question.robot, found);
        if (clear_box)
            json["clear_box"] = view::clear_box_json(*clear_box, found.joints);
        json["warnings"] = question.warnings;
        print(json.dump() + "\n");
    } else {
        print(range_text(question, found, clear_box));
    }
    print_warnings(question.warnings);
    return is_whole ? exit_status_of(found.verdict) : report_interruption("what is not proven is open");
}

} // namespace

void add_range(CLI::App& app, Task& task) {
    const auto options = std::make_shared<RangeCommand>();
    CLI::App& command =
        *app.add_subcommand("range", "Which configurations of some joints of a robot are clear? Proven, not sampled.");
    RobotCommand& robot = options->robot;
    add_cell_options(command, robot.robot);
    add_radii_option(command, robot.robot.radii, "the shapes of the robot and of the bodies of the scene");
    add_robot_change_options(command, robot.changes);
    command
        .add_option("--joints", options->joints,
                    "the joints that move, within their limits or between the ends given here; all others stay")
        ->required()
        ->type_name("A[=LOWER:UPPER],B,..")
        ->delimiter(',');
    command
        .add_option("--from", options->from,
                    "table of configurations, as for `chasles robot --path`, and the row, from 0, in which the other "
                    "joints stay; otherwise at 0 or their nearest limit")
        ->type_name("FILE [ROW]")
        ->expected(1, 2);
    command
        .add_option("--scene", robot.scene, "JSON file of the world, as for `chasles scene`; its bodies stand still")
        ->type_name("FILE");
    robot.query.margin.clear(); // that of the scene's file
    command
        .add_option("--margin", robot.query.margin,
                    "distance of the surfaces that counts as contact; instead of the scene's")
        ->type_name("D");
    command
        .add_option("--tolerance", options->tolerance,
                    "the search ends when no more than this share of the range is open")
        ->type_name("T")
        ->capture_default_str();
    command.add_flag("--clear-box", options->finds_clear_box,
                     "find a large proven box around the configuration of --from, too");
    command.add_option("--plot", options->plot, "draw the range of two joints, as SVG")->type_name("FILE");
    command.add_option("--seconds", options->seconds, "what is not decided after this time stays open")
        ->type_name("T")
        ->capture_default_str();
    command.add_option("--threads", options->threads, "number of threads; 0 for all cores")->capture_default_str();
    command.add_flag("--json", robot.json, "print one JSON object");
    command.callback([options, &task] { task = [options] { return run_range(*options); }; });
}

} // namespace chasles::cli
