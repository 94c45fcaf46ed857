// The error message of a call, and temporary files of a test.
#pragma once

#include "chasles/base/invalid_input.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <string_view>

namespace chasles::tests {

/// The message of the InvalidInput that `call` throws. The test fails if `call` throws none.
template <typename Call>
std::string message_of(const Call& call) {
    try {
        call();
    } catch (const InvalidInput& error) {
        EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << "more than one line";
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return "";
}

/// Gives each test its own folder.
class FileTest : public testing::Test {
protected:
    FileTest() {
        const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::path(testing::TempDir()) /
                  (std::string("chasles-") + test->test_suite_name() + "-" + test->name());
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    ~FileTest() override { std::filesystem::remove_all(folder_); }

    [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder_ / name; }

    std::filesystem::path write(const std::string& name, const std::string& content) const {
        std::ofstream(path(name), std::ios::binary) << content;
        return path(name);
    }

    /// `message` without the folder's name, which depends on the machine.
    [[nodiscard]] std::string without_folder(std::string message) const {
        const std::string prefix = folder_.string() + "/";
        for (std::size_t at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
            message.erase(at, prefix.size());
        return message;
    }

private:
    std::filesystem::path folder_;
};

} // namespace chasles::tests
