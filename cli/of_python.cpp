#include "cli/of_python.h"

#include "chasles/base/invalid_input.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <unistd.h>

namespace chasles::cli {
namespace {

struct OfPython {
    std::string_view name;
    std::string_view install;
};

constexpr std::array commands = {OfPython{"cad", "pip install \"chasles[cad]\""},
                                 OfPython{"animation", "pip install chasles"}};

const OfPython* find(const std::string& command) {
    const auto* const found = std::ranges::find(commands, command, &OfPython::name);
    return found == commands.end() ? nullptr : found;
}

} // namespace

bool is_of_python(const std::string& command) {
    return find(command) != nullptr;
}

int run_of_python(const std::string& command, const std::vector<std::string>& arguments) {
    std::string program = "chasles-" + command;
    std::vector<std::string> words = arguments;
    std::vector<char*> pointers = {program.data()};
    for (std::string& word : words)
        pointers.push_back(word.data());
    pointers.push_back(nullptr);
    execvp(program.c_str(), pointers.data()); // returns only where it fails
    if (errno != ENOENT)
        throw InvalidInput(command + ": the program " + program + " cannot be run: " + std::strerror(errno));
    throw InvalidInput(command + " comes with the Python package: its program " + program + " is not on the PATH (" +
                       std::string(find(command)->install) + ")");
}

std::string help_of_python() {
    std::string names;
    for (const OfPython& command : commands)
        names += (names.empty() ? "" : ", ") + std::string(command.name);
    return "With the Python package: " + names + ".";
}

} // namespace chasles::cli
