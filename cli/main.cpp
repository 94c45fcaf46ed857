// The command line of Chasles. Exit status: 0 clear, 1 contact, 2 wrong input or usage, with one line that gives the
// reason.
#include "chasles/base/invalid_input.h"
#include "chasles/io/read_file.h"
#include "chasles/io/text_scan.h"
#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/interruption.h"
#include "cli/of_python.h"
#include "cli/output.h"
#include "cli/progress_bar.h"

#include <algorithm>
#include <cstdio>
#include <new>
#include <sstream>

namespace chasles::cli {
namespace {

#ifndef CHASLES_VERSION
#define CHASLES_VERSION "unknown"
#endif

int report_usage_error(const std::string& command, const std::string& why) {
    std::fputs((command + ": " + io::one_line(why) + " (see " + command + " --help)\n").c_str(), stderr);
    return is_wrong;
}

// CLI11 names neither the subcommand that an error belongs to nor an unknown subcommand.
int report_usage_error(const CLI::App& app, const std::string& first_argument, const CLI::ParseError& error) {
    for (const CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; }))
        if (first_argument == command->get_name())
            return report_usage_error("chasles " + first_argument, error.what());
    const bool is_name = !first_argument.empty() && !first_argument.starts_with('-');
    return report_usage_error("chasles", is_name ? "no subcommand " + io::in_quotes(first_argument) : error.what());
}

int report_error(const std::string& why) {
    std::fputs(("chasles: " + io::one_line(why) + "\n").c_str(), stderr);
    return is_wrong;
}

void add_commands(CLI::App& app, Task& task) {
    app.set_version_flag("--version", "chasles " CHASLES_VERSION);
    app.footer(help_of_python() +
               "\nExit status: 0 clear, 1 contact, 2 wrong input or usage, 3 out of time, 130 interrupted.");
    app.require_subcommand(1);
    add_check(app, task);
    add_clearance(app, task);
    add_profile(app, task);
    add_view(app, task);
    add_path(app, task);
    add_batch(app, task);
    add_scene(app, task);
    add_robot(app, task);
    add_acm(app, task);
    add_range(app, task);
    add_drag(app, task);
    add_info(app, task);
    add_verify(app, task);
    add_demo(app, task);
}

// Prints the help or the version as CLI11 would, and checks that the output is written.
int show_help(const CLI::App& app, const CLI::ParseError& error) {
    std::ostringstream text;
    app.exit(error, text, text);
    print(text.str());
    return is_clear;
}

// CLI11 requires the arguments in reverse order.
void parse(CLI::App& app, const std::vector<std::string>& arguments) {
    require_values(app, arguments);
    std::vector<std::string> reversed = join_numbers(arguments);
    std::reverse(reversed.begin(), reversed.end());
    app.parse(reversed);
}

int parse_and_work(CLI::App& app, const Task& task, const std::vector<std::string>& arguments) {
    try {
        parse(app, arguments);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0)
            return show_help(app, error);
        return report_usage_error(app, arguments.empty() ? "" : arguments.front(), error);
    }
    const Heartbeat heartbeat;
    return task();
}

int run(const std::vector<std::string>& arguments) {
    CLI::App app("Exact continuous collision detection of rigid polyhedra.", "chasles");
    Task task;
    add_commands(app, task);
    const io::ReadLog files_read;
    try {
        if (!arguments.empty() && is_of_python(arguments.front()))
            return run_of_python(arguments.front(), {arguments.begin() + 1, arguments.end()});
        return parse_and_work(app, task, arguments);
    } catch (const InvalidInput& error) {
        return report_error(error.what());
    } catch (const std::bad_alloc&) {
        return report_error("not enough memory");
    }
}

} // namespace
} // namespace chasles::cli

int main(int argc, char** argv) {
    chasles::cli::prepare_output();
    chasles::cli::end_when_interrupted();
    try {
        return chasles::cli::run(std::vector<std::string>(argv + std::min(argc, 1), argv + argc));
    } catch (...) { // not even the message of an error could be made
        std::fputs("chasles: an error that could not be reported\n", stderr);
        return chasles::cli::is_wrong;
    }
}
