// The subcommands of `chasles`. Each is one file, which declares the options and runs the subcommand.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace chasles::cli {

/// The exit status of `chasles`.
enum ExitStatus : int {
    is_clear = 0,
    is_contact = 1, ///< also at the start
    is_wrong = 2,   ///< wrong input or usage; one line on standard error names the input, the place and the reason
    is_unknown = 3, ///< the time of --seconds was over
    is_interrupted = 130, ///< by SIGINT or SIGTERM; what was answered before is written
};

/// Runs a subcommand after all arguments are parsed. Returns the exit status.
using Task = std::function<int()>;

// Each function adds one subcommand to `app`. Parsing that subcommand sets `task`.
void add_check(CLI::App& app, Task& task);
void add_clearance(CLI::App& app, Task& task);
void add_profile(CLI::App& app, Task& task);
void add_view(CLI::App& app, Task& task);
void add_path(CLI::App& app, Task& task);
void add_scene(CLI::App& app, Task& task);
void add_robot(CLI::App& app, Task& task);
void add_acm(CLI::App& app, Task& task);
void add_range(CLI::App& app, Task& task);
void add_drag(CLI::App& app, Task& task);
void add_batch(CLI::App& app, Task& task);
void add_info(CLI::App& app, Task& task);
void add_verify(CLI::App& app, Task& task);
void add_demo(CLI::App& app, Task& task);

} // namespace chasles::cli
