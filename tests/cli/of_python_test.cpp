// Commands that come with the Python package are programs of their own.
#include "tests/cli/cli_test_files.h"

#include <cstdlib>

namespace chasles {
namespace {

class OfPython : public tests::CommandLine {
protected:
    OfPython() { setenv("PATH", (path("").string() + ":/usr/bin:/bin").c_str(), 1); }
    ~OfPython() override { setenv("PATH", before.c_str(), 1); }

    void install(const std::string& program, const std::string& script) const {
        write(program, script);
        std::filesystem::permissions(path(program), std::filesystem::perms::owner_all);
    }

private:
    std::string before = std::getenv("PATH");
};

TEST_F(OfPython, GetsItsWordsAndGivesItsStatus) {
    install("chasles-cad", "#!/bin/sh\nfor word; do echo \"<$word>\"; done\nexit 3\n");
    const tests::Finished finished = run("cad 'a b.step' --json ''");
    EXPECT_EQ(finished.status, 3);
    EXPECT_EQ(finished.out, "<a b.step>\n<--json>\n<>\n");
    EXPECT_EQ(finished.err, "");
}

TEST_F(OfPython, WhatIsMissingIsNamedWithTheWayToGetIt) {
    EXPECT_EQ(error_line("animation a.glb"),
              "chasles: animation comes with the Python package: its program chasles-animation is "
              "not on the PATH (pip install chasles)");
    EXPECT_NE(run("--help").out.find("With the Python package: cad, animation."), std::string::npos);
}

} // namespace
} // namespace chasles
