// chasles profile: how far apart two bodies are over a motion, with bounds, and when they are within margins.
#include "cli/commands.h"
#include "cli/one_motion.h"
#include "cli/output.h"
#include "cli/profile_report.h"
#include "cli/warnings.h"
#include "view/names.h"

#include <memory>

namespace chasles::cli {
namespace {

struct ProfileCommand {
    OneMotionOptions question;
    ProfileFlags flags;
    std::string tolerance = "0.01";
    bool json = false;
};

int run_profile(const ProfileCommand& options) {
    ProfileRequest request(options.flags, options.tolerance);
    const OneMotion question = read_one_motion(options.question);
    request.open_files();
    const Limit limit(question.seconds);
    const NamedProfile found{profile({.moving = question.bodies.moving,
                                      .fixed = question.bodies.fixed,
                                      .motion = question.motion,
                                      .options = request.options()}),
                             {}};
    request.write(found);
    const ExitStatus status = status_of(found.distance, !found.distance.certain && limit.is_over());
    if (options.json) {
        view::Json json = request.json(found, status);
        add_warnings(json, question.bodies.warnings);
        print(json.dump() + "\n");
    } else {
        print(profile_headline(found.distance, view::name_of(question.numbers.kind)) + request.text(found));
    }
    return status;
}

} // namespace

void add_profile(CLI::App& app, Task& task) {
    const auto options = std::make_shared<ProfileCommand>();
    CLI::App& command =
        *app.add_subcommand("profile", "How far apart are two bodies over a motion, and when are they within margins?");
    add_motion_options(command, options->question);
    command
        .add_option("--tolerance", options->tolerance, "greatest difference of the bounds, as a part of the distance")
        ->type_name("T")
        ->capture_default_str();
    add_profile_options(command, options->flags);
    add_seconds_option(command, options->question.query.seconds);
    command.add_flag("--json", options->json, "print one JSON object");
    command.callback([options, &task] { task = [options] { return run_profile(*options); }; });
}

} // namespace chasles::cli
