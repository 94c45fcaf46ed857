// The subcommands of `chasles`; each is one file that declares its options and does its work.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace chasles::cli {

/// What `chasles` answers to the shell.
enum ExitStatus : int {
    is_clear = 0,
    is_contact = 1, ///< also at the start
    is_wrong = 2,   ///< input or usage; one line on standard error says what, where and why
};

/// The work of a subcommand, to be done once all arguments are read; answers the exit status.
using Task = std::function<int()>;

// Each adds one subcommand to `app`; if it is chosen, `task` becomes its work.
void add_check(CLI::App& app, Task& task);
void add_view(CLI::App& app, Task& task);
void add_path(CLI::App& app, Task& task);
void add_batch(CLI::App& app, Task& task);
void add_info(CLI::App& app, Task& task);
void add_demo(CLI::App& app, Task& task);

} // namespace chasles::cli
