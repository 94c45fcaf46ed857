// The command line of Chasles. Exit status: 0 clear, 1 contact, 2 wrong input or usage, with one line that says why.
#include "chasles/base/invalid_input.h"
#include "chasles/io/text_scan.h"
#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/output.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <new>
#include <sstream>

namespace chasles::cli {
namespace {

#ifndef CHASLES_VERSION
#define CHASLES_VERSION "unknown"
#endif

int complain_of_usage(const std::string& command, const std::string& why) {
    std::fputs((command + ": " + io::one_line(why) + " (see " + command + " --help)\n").c_str(), stderr);
    return is_wrong;
}

// CLI11 itself does not say which subcommand the complaint is about, nor that there is none of that name.
int complain_of_usage(const CLI::App& app, const std::string& first_argument, const CLI::ParseError& error) {
    for (const CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; }))
        if (first_argument == command->get_name())
            return complain_of_usage("chasles " + first_argument, error.what());
    const bool is_name = !first_argument.empty() && !first_argument.starts_with('-');
    return complain_of_usage("chasles", is_name ? "no subcommand " + io::in_quotes(first_argument) : error.what());
}

int complain(const std::string& why) {
    std::fputs(("chasles: " + io::one_line(why) + "\n").c_str(), stderr);
    return is_wrong;
}

void add_commands(CLI::App& app, Task& task) {
    app.set_version_flag("--version", "chasles " CHASLES_VERSION);
    app.footer("Exit status: 0 clear, 1 contact, 2 wrong input or usage.");
    app.require_subcommand(1);
    add_check(app, task);
    add_view(app, task);
    add_path(app, task);
    add_batch(app, task);
    add_info(app, task);
    add_demo(app, task);
}

// Help and version: what CLI11 would print, but checked to arrive.
int show_help(const CLI::App& app, const CLI::ParseError& error) {
    std::ostringstream text;
    app.exit(error, text, text);
    print(text.str());
    return is_clear;
}

// Parses in the order that CLI11 wants: the last argument first.
void parse(CLI::App& app, const std::vector<std::string>& arguments) {
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
        return complain_of_usage(app, arguments.empty() ? "" : arguments.front(), error);
    }
    return task();
}

int run(const std::vector<std::string>& arguments) {
    CLI::App app("Exact continuous collision detection of rigid polyhedra.", "chasles");
    Task task;
    add_commands(app, task);
    try {
        return parse_and_work(app, task, arguments);
    } catch (const InvalidInput& error) {
        return complain(error.what());
    } catch (const std::bad_alloc&) {
        return complain("not enough memory");
    }
}

} // namespace
} // namespace chasles::cli

int main(int argc, char** argv) {
    std::signal(SIGPIPE, SIG_IGN); // a reader that went away is an error to report, not a reason to vanish
    return chasles::cli::run(std::vector<std::string>(argv + std::min(argc, 1), argv + argc));
}
