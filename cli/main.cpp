// The command line of Chasles. Exit status: 0 clear, 1 contact, 2 wrong input or usage, with one line that says why.
#include "chasles/invalid_input.h"
#include "chasles/io/text_scan.h"
#include "cli/arguments.h"
#include "cli/commands.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <new>

namespace chasles::cli {
namespace {

#ifndef CHASLES_VERSION
#define CHASLES_VERSION "unknown"
#endif

int complain(const std::string& why) {
    std::fputs(("chasles: " + io::one_line(why) + "\n").c_str(), stderr);
    return is_wrong;
}

void add_commands(CLI::App& app, Task& task) {
    app.set_version_flag("--version", "chasles " CHASLES_VERSION);
    app.footer("Exit status: 0 clear, 1 contact, 2 wrong input or usage.");
    app.require_subcommand(1);
    add_check(app, task);
    add_path(app, task);
    add_batch(app, task);
    add_info(app, task);
    add_demo(app, task);
}

int run(std::vector<std::string> arguments) {
    CLI::App app("Exact continuous collision detection of rigid polyhedra.", "chasles");
    Task task;
    add_commands(app, task);
    try {
        arguments = join_numbers(arguments);
        std::reverse(arguments.begin(), arguments.end()); // as CLI11 wants them
        app.parse(arguments);
        return task();
    } catch (const CLI::ParseError& error) {
        return error.get_exit_code() == 0 ? app.exit(error) : complain(error.what());
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
