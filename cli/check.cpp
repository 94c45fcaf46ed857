// chasles check: one motion between two poses.
#include "cli/commands.h"
#include "cli/one_motion.h"
#include "cli/output.h"
#include "cli/report.h"
#include "cli/warnings.h"
#include "view/answer_json.h"

#include <memory>

namespace chasles::cli {
namespace {

struct CheckOptions {
    OneMotionOptions question;
    bool json = false;
};

int run_check(const CheckOptions& options) {
    const OneMotion question = read_one_motion(options.question);
    const FirstContact found = first_contact(question);
    if (options.json) {
        view::Json answer = view::answer_json(found, question.numbers);
        add_warnings(answer, question.bodies.warnings);
        print(answer.dump() + "\n");
    } else {
        print(report(found, question.numbers, question.options, {question.bodies.moving, question.bodies.fixed}));
    }
    return status_of(found.verdict);
}

} // namespace

void add_check(CLI::App& app, Task& task) {
    const auto options = std::make_shared<CheckOptions>();
    CLI::App& command =
        *app.add_subcommand("check", "When do two bodies first touch during a motion between two poses?");
    add_one_motion_options(command, options->question);
    command.add_flag("--json", options->json, "print one JSON object");
    command.callback([options, &task] { task = [options] { return run_check(*options); }; });
}

} // namespace chasles::cli
