// Output through C streams, because they report the reason of a failure (errno).
#include "cli/output.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/text_scan.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace chasles::cli {
namespace {

// Returns 0 on success, otherwise the system's error number.
int write_all(std::FILE* file, const std::string& text) {
    errno = 0;
    const bool is_written = std::fwrite(text.data(), 1, text.size(), file) == text.size() && std::fflush(file) == 0;
    return is_written ? 0 : (errno != 0 ? errno : EIO);
}

std::string why_not(int error) {
    return std::string(": cannot be written: ") + std::strerror(error);
}

// The output goes through a descriptor of its own to where standard output goes, at the same position.
std::FILE* open(const std::string& name) {
    return is_standard_output(name) ? fdopen(dup(STDOUT_FILENO), "w") : std::fopen(name.c_str(), "a");
}

} // namespace

bool is_standard_output(const std::string& name) {
    struct stat file = {}, output = {};
    return stat(name.c_str(), &file) == 0 && fstat(STDOUT_FILENO, &output) == 0 && file.st_dev == output.st_dev &&
           file.st_ino == output.st_ino;
}

void print(const std::string& text) {
    if (const int error = write_all(stdout, text); error != 0)
        throw InvalidInput("standard output" + why_not(error));
}

OutputFile::OutputFile(const std::string& name)
    : name_(name), file_(open(name)), is_emptied_(is_standard_output(name)) {
    if (!file_)
        fail(errno);
}

// The file is open for appending, so writing continues at the new end. A pipe or a device cannot be truncated.
void OutputFile::empty() {
    std::error_code error;
    if (std::filesystem::is_regular_file(name_))
        std::filesystem::resize_file(name_, 0, error);
    if (error)
        fail(error.value());
    is_emptied_ = true;
}

void OutputFile::write(const std::string& text) {
    if (!is_emptied_)
        empty();
    if (const int error = write_all(file_.get(), text); error != 0)
        fail(error);
}

void OutputFile::close() {
    if (std::fclose(file_.release()) != 0)
        fail(errno);
}

void OutputFile::fail(int error) const {
    throw InvalidInput(io::one_line(name_) + why_not(error));
}

} // namespace chasles::cli
