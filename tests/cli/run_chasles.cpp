// Runs the command through the shell, so tests contain command lines as a user types them.
#include "tests/cli/run_chasles.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sys/wait.h>

namespace chasles::tests {
namespace {

std::string content_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

int exit_status(int wait_status) {
    return WIFEXITED(wait_status) ? WEXITSTATUS(wait_status) : 128 + WTERMSIG(wait_status);
}

} // namespace

Finished run_chasles(const std::filesystem::path& folder, const std::string& arguments) {
    const std::string command = "cd '" + folder.string() + "' && { '" CHASLES_EXECUTABLE "' " + arguments +
                                "; } >stdout.txt 2>stderr.txt </dev/null";
    const int status = std::system(command.c_str());
    return {exit_status(status), content_of(folder / "stdout.txt"), content_of(folder / "stderr.txt")};
}

} // namespace chasles::tests
