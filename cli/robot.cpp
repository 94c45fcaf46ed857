// chasles robot: a robot along a path of configurations.
#include "chasles/robot/joint_path_file.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/report.h"
#include "cli/robot_options.h"
#include "cli/scene_file.h"
#include "view/answer_json.h"
#include "view/page.h"
#include "view/robot_record.h"

#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace chasles::cli {
namespace {

struct RobotCommand {
    RobotOptions robot;
    std::string path;
    std::string scene;
    std::string page;
    QuestionOptions query;
    bool json = false;
};

struct RobotQuestion {
    Robot robot;
    robot::ConfigurationRows rows;
    std::optional<SceneFile> scene;
    QueryOptions options;

    [[nodiscard]] bool has_stamps() const { return !rows.stamps.empty(); }
    [[nodiscard]] const Scene* world() const { return scene ? &scene->scene : nullptr; }
};

RobotQuestion read_question(const RobotCommand& options) {
    const QueryOptions query = options_of(options.query);
    Robot robot = load_robot(options.robot);
    robot::ConfigurationRows rows = robot::load_configurations(options.path, robot);
    std::optional<SceneFile> scene;
    if (!options.scene.empty())
        scene = load_scene(options.scene, {.triangulate = true});
    return {std::move(robot), std::move(rows), std::move(scene), query};
}

std::string list_of(const Robot& robot, const Configuration& values) {
    std::string text;
    for (std::size_t i = 0; i < robot.variables().size(); ++i)
        text += fmt::format("{}{} {:.9g}", i > 0 ? ", " : "", robot.variables()[i].name, values[Eigen::Index(i)]);
    return text;
}

std::string report(const RobotQuestion& question, const RobotAnswer& found) {
    const double margin = question.options.margin;
    FirstContact shown = found.contact;
    shown.verdict = found.verdict;
    if (question.has_stamps())
        shown.time = found.time;
    std::string text = headline(shown, margin);
    if (found.verdict != Verdict::clear) {
        const std::string& second = found.pair->second;
        text += labelled("pair", found.pair->first + " on " + second + (found.pair->is_with_scene ? " (scene)" : ""));
        text += labelled("segment", std::to_string(found.segment)) + report_contact(shown, margin);
    }
    text += labelled("joints", list_of(question.robot, found.configuration));
    const std::size_t segments = question.rows.configurations.size() - 1;
    return text +
           labelled("path",
                    fmt::format("{}, {} searched", counted(segments, "segment"), counted(found.pairs, "pair"))) +
           cli::report(found.work);
}

int run_robot(const RobotCommand& options) {
    std::optional<OutputFile> page;
    if (!options.page.empty()) {
        view::require_page_template();
        page.emplace(options.page);
    }
    const RobotQuestion question = read_question(options);
    const RobotChecker checker(question.robot, question.world(), {question.options});
    const JointPath path = question.has_stamps()
                               ? JointPath::straight(question.robot, question.rows.configurations, question.rows.stamps)
                               : JointPath::straight(question.robot, question.rows.configurations);
    RobotAnswer found = checker.first_contact(path);
    if (page) {
        view::SceneRecord record = view::robot_record(question.robot, question.world(), path, found);
        record.margin = question.options.margin;
        record.title = std::filesystem::path(options.robot.urdf).filename().string();
        page->write(view::scene_page(record));
        page->close();
    }
    if (question.has_stamps()) // speeds become lengths per unit of the stamps
        for (Contact& contact : found.contact.contacts)
            contact.approach_speed /= path.segments()[found.segment].end - path.segments()[found.segment].begin;
    print(options.json ? view::robot_answer_json(question.robot, found, question.has_stamps()).dump() + "\n"
                       : report(question, found) + (options.page.empty() ? "" : labelled("page", options.page)));
    return found.verdict == Verdict::clear ? is_clear : is_contact;
}

} // namespace

void add_robot(CLI::App& app, Task& task) {
    const auto options = std::make_shared<RobotCommand>();
    CLI::App& command = *app.add_subcommand("robot", "Does a robot touch its world or itself along a path?");
    add_robot_options(command, options->robot);
    command.add_option("--path", options->path, "CSV file of configurations, with the names of joints as its header")
        ->required()
        ->type_name("CSV");
    command.add_option("--scene", options->scene, "JSON file of the world, as for `chasles scene`")->type_name("FILE");
    command.add_option("--margin", options->query.margin, "distance of the surfaces that counts as contact")
        ->type_name("D")
        ->capture_default_str();
    command.add_option("--time-tolerance", options->query.time_tolerance, "aimed width of the bracket around the time")
        ->type_name("T")
        ->capture_default_str();
    auto* const any =
        command.add_flag("--any", options->query.any, "stop at any contact, which need not be the first one");
    command.add_flag("--all-contacts", options->query.all_contacts, "list every contact of the pair at its first one")
        ->excludes(any);
    command.add_flag("--json", options->json, "print one JSON object");
    command.add_option("--page", options->page, "write a page (HTML) that shows the robot on its way")
        ->type_name("FILE");
    command.callback([options, &task] { task = [options] { return run_robot(*options); }; });
}

} // namespace chasles::cli
