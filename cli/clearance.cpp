// chasles clearance: how near two bodies come during a motion.
#include "cli/commands.h"
#include "cli/one_motion.h"
#include "cli/output.h"
#include "cli/report.h"
#include "cli/warnings.h"
#include "view/answer_json.h"
#include "view/names.h"

#include <memory>

namespace chasles::cli {
namespace {

struct ClearanceOptions {
    OneMotionOptions question;
    std::string tolerance = "1e-6";
    bool json = false;
};

// Refuses an option or a flag of `check` with a reason. The help does not list it.
void refuse(CLI::App& command, const std::string& option, const std::string& why) {
    command
        .add_option_function<std::string>(
            option, [option, why](const std::string&) { throw CLI::ValidationError(option, why); })
        ->group("");
}
void refuse_flag(CLI::App& command, const std::string& flag, const std::string& why) {
    command.add_flag_callback(flag, [flag, why] { throw CLI::ValidationError(flag, why); })->group("");
}

std::string json_text(const LeastDistance& found, const OneMotion& question, ExitStatus status) {
    view::Json answer = view::answer_json(found, question.numbers);
    if (status == is_unknown)
        answer["verdict"] = view::name_of(Verdict::unknown);
    add_warnings(answer, question.bodies.warnings);
    return answer.dump() + "\n";
}

int run_clearance(const ClearanceOptions& options) {
    const double tolerance = number_of("--tolerance", options.tolerance);
    const OneMotion question = read_one_motion(options.question);
    const Limit limit(question.seconds);
    const LeastDistance found = least_distance({.moving = question.bodies.moving,
                                                .fixed = question.bodies.fixed,
                                                .motion = question.motion,
                                                .options = {.tolerance = tolerance,
                                                            .time_tolerance = question.options.time_tolerance,
                                                            .find = question.options.find}});
    const bool time_was_over = !found.certain && limit.is_over();
    const ExitStatus status = status_of(found.distance, time_was_over);
    print(options.json ? json_text(found, question, status) : report(found, question.numbers, time_was_over));
    return status;
}

} // namespace

void add_clearance(CLI::App& app, Task& task) {
    const auto options = std::make_shared<ClearanceOptions>();
    CLI::App& command =
        *app.add_subcommand("clearance", "How near do two bodies come during a motion between two poses?");
    add_motion_options(command, options->question);
    command
        .add_option("--tolerance", options->tolerance, "aimed width of the bracket of the distance, as a part of it")
        ->type_name("T")
        ->capture_default_str();
    add_search_options(command, options->question.query);
    command.add_flag("--all-contacts", options->question.query.all_contacts,
                     "list every feature pair at the least distance, instead of one");
    command.add_flag("--json", options->json, "print one JSON object");
    refuse(command, "--margin", "clearance measures the distance and takes no margin; check takes one");
    refuse(command, "--hold", "clearance measures the distance and has no margin, so it holds no contacts; check does");
    refuse_flag(
        command, "--any",
        "clearance searches the whole motion for the least distance, so it cannot stop at any contact; check can");
    command.callback([options, &task] { task = [options] { return run_clearance(*options); }; });
}

} // namespace chasles::cli
