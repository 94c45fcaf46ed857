// chasles view: returns the answer of check, and writes a page.
#include "tests/cli/cli_test_files.h"

#include <fstream>
#include <iterator>

namespace chasles {
namespace {

class View : public tests::CommandLine {
protected:
    void SetUp() override {
        const std::string why = run("view cube.obj cube.obj" + poses + " --out page.html").err;
        if (why.find("this build has no viewer") != std::string::npos)
            GTEST_SKIP() << why;
    }
    [[nodiscard]] std::string content(const std::string& file) const {
        std::ifstream stream(path(file), std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    const std::string poses = " --start '0.25 0.5 3' --goal '0.25 0.5 -1'";
};

TEST_F(View, AnswersAsCheckDoes) {
    const auto checked = run("check cube.obj cube.obj" + poses);
    const auto viewed = run("view cube.obj cube.obj" + poses + " --out page.html");
    EXPECT_EQ(viewed.status, checked.status);
    EXPECT_EQ(viewed.out, checked.out.substr(0, checked.out.find('\n') + 1) + "  page      page.html\n");
    EXPECT_EQ(run("view cube.obj cube.obj --start '3 0 0' --goal '3 5 0' --out clear.html").status, 0);
}

TEST_F(View, TakesTheOptionsOfCheck) {
    for (const std::string motion : {" --motion sweep --centre '1 0 0'", " --max-turn-deg 20"}) {
        const std::string options =
            motion + " --time-tolerance 1e-9 --any --fixed-start '0 0 0' --fixed-goal '0 0 1' --triangulate";
        EXPECT_EQ(run("view cube.obj cube.obj" + poses + options + " --out page.html").status, 1) << options;
    }
}

/// Quotes of JSON stand in the page as they are.
TEST_F(View, TakesTheEvenMotions) {
    const std::string both = poses + " --fixed-start '0 0 0' --fixed-goal '0 0 1 .9 0 0 .1'";
    for (const std::string& options : {poses + " --motion velocity --centre '1 0 0'", poses + " --motion twist",
                                       both + " --motion twist", both + " --motion velocity --fixed-centre -1 0 0"}) {
        const auto checked = run("check cube.obj cube.obj" + options);
        const auto viewed = run("view cube.obj cube.obj" + options + " --out page.html");
        EXPECT_EQ(viewed.status, 1) << options;
        EXPECT_EQ(viewed.out.substr(0, viewed.out.find('\n')), checked.out.substr(0, checked.out.find('\n')));
        const std::string page = content("page.html");
        const std::string kind = options.find("twist") != std::string::npos ? "twist" : "velocity";
        EXPECT_NE(page.find(R"("motion":")" + kind + "\""), std::string::npos) << options;
        const std::string in_world = options.starts_with(both) ? "true" : "false";
        EXPECT_NE(page.find(R"("is_in_world":)" + in_world), std::string::npos) << options;
        EXPECT_EQ(page.find(R"("tau":)"), std::string::npos) << options;
    }
}

TEST_F(View, NamesThePage) {
    EXPECT_NE(content("page.html").find(R"("title":"cube.obj and cube.obj")"), std::string::npos);
    static_cast<void>(run("view cube.obj cube.obj" + poses + " --out page.html --title 'Peg & <hole>'"));
    EXPECT_NE(content("page.html").find(R"("title":"Peg & \u003chole>")"), std::string::npos);
}

TEST_F(View, SaysWhatIsWrong) {
    EXPECT_TRUE(
        error_line("view cube.obj cube.obj" + poses + " --out no/page.html").starts_with("chasles: no/page.html"));
    EXPECT_EQ(error_line("view cube.obj cube.obj" + poses),
              "chasles view: --out is required (see chasles view --help)");
}

} // namespace
} // namespace chasles
