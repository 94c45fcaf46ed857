// chasles view: one motion between two poses, as a page of HTML.
#include "cli/commands.h"
#include "cli/one_motion.h"
#include "cli/output.h"
#include "cli/report.h"
#include "view/names.h"
#include "view/page.h"

#include <filesystem>
#include <memory>

namespace chasles::cli {
namespace {

struct ViewOptions {
    OneMotionOptions question;
    std::string out;
    std::string title;
    bool wants_curve = false;
};

std::string file_name(const std::string& path) {
    return std::filesystem::path(path).filename().string();
}

int run_view(const ViewOptions& options) {
    view::require_page_template(); // fails before the query runs
    const OneMotion question = read_one_motion(options.question);
    OutputFile file(options.out);
    const FirstContact found = first_contact(question);
    if (found.verdict == Verdict::unknown) {
        print(headline(found, question.options.margin, view::name_of(question.numbers.kind), question.options.hold));
        return is_unknown;
    }
    std::optional<view::Curve> curve;
    if (options.wants_curve) {
        const Limit limit(question.seconds);
        curve = view::curve_of(profile({question.bodies.moving, question.bodies.fixed, question.motion}),
                               question.options.margin);
    }
    const std::string moving_name = file_name(options.question.bodies.moving);
    const std::string fixed_name = file_name(options.question.bodies.fixed);
    file.write(view::page({.moving = question.bodies.moving,
                           .fixed = question.bodies.fixed,
                           .motion = question.motion,
                           .numbers = question.numbers,
                           .found = found,
                           .margin = question.options.margin,
                           .title = options.title.empty() ? moving_name + " and " + fixed_name : options.title,
                           .moving_name = moving_name,
                           .fixed_name = fixed_name,
                           .curve = std::move(curve)}));
    file.close();
    print(headline(found, question.options.margin, view::name_of(question.numbers.kind)) +
          way_out_line(found, question.options, {question.bodies.moving, question.bodies.fixed}) +
          page_lines(options.out, {{moving_name, question.bodies.moving}, {fixed_name, question.bodies.fixed}}));
    return status_of(found.verdict);
}

} // namespace

void add_view(CLI::App& app, Task& task) {
    const auto options = std::make_shared<ViewOptions>();
    CLI::App& command =
        *app.add_subcommand("view", "Runs the query of check and writes a page of HTML that shows the answer.");
    add_one_motion_options(command, options->question);
    command.add_option("--out", options->out, "page to write (HTML)")->required()->type_name("FILE");
    command.add_option("--title", options->title, "title of the page; default: the names of both files")
        ->type_name("TEXT");
    add_curve_option(command, options->wants_curve);
    command.callback([options, &task] { task = [options] { return run_view(*options); }; });
}

} // namespace chasles::cli
