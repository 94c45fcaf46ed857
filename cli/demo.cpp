// chasles demo: a bolt and a nut that the project makes itself; see scenes/demo.h.
#include "scenes/demo.h"
#include "chasles/base/invalid_input.h"
#include "cli/commands.h"

#include <iostream>
#include <memory>

namespace chasles::cli {
namespace {

int run_demo(const std::string& save_to) {
    const int status = scenes::run_demo(std::cout, save_to);
    if (!std::cout.flush())
        throw InvalidInput("standard output: cannot be written");
    return status;
}

} // namespace

void add_demo(CLI::App& app, Task& task) {
    const auto save_to = std::make_shared<std::string>();
    CLI::App& command = *app.add_subcommand("demo", "Unscrews a nut from a bolt, proven clear, and tries it wrongly.");
    command.add_option("--save", *save_to, "folder for the meshes of both bodies (bolt.obj, nut.obj)")
        ->type_name("FOLDER");
    command.callback([save_to, &task] { task = [save_to] { return run_demo(*save_to); }; });
}

} // namespace chasles::cli
