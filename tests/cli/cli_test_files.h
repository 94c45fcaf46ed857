// The input files of the command-line tests.
#pragma once

#include "tests/cli/run_chasles.h"
#include "tests/io/message_of.h"

namespace chasles::tests {

/// A folder with cube.obj, the unit cube with a corner at the origin.
class CommandLine : public FileTest {
protected:
    CommandLine() {
        write("cube.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                          "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
    }

    [[nodiscard]] Finished run(const std::string& arguments) const { return run_chasles(path(""), arguments); }

    /// Expects exit status 2, nothing on standard output, and one line on standard error. Returns this line.
    [[nodiscard]] std::string error_line(const std::string& arguments) const {
        const Finished finished = run(arguments);
        EXPECT_EQ(finished.status, 2) << arguments;
        EXPECT_EQ(finished.out, "") << arguments;
        EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
        return finished.err.substr(0, finished.err.find('\n'));
    }
};

} // namespace chasles::tests
