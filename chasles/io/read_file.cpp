// Reads a whole file into memory. Readers can then give the position of every error.
// Reads to the end of the file instead of using its size, therefore pipes work too.
#include "chasles/io/read_file.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/text_scan.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace chasles::io {
namespace {

// Closes the file at the end of its scope.
struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, CloseFile>;

// The message for an error of the operating system.
std::string reason(int error) {
    return std::string("cannot be read: ") + std::strerror(error);
}

// Opens a file for reading. Missing files and directories get their own messages.
OpenFile open_file(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) {
        const bool is_missing = !error || error == std::errc::no_such_file_or_directory;
        fail_in_file(file, is_missing ? "no such file" : reason(error.value()));
    }
    if (std::filesystem::is_directory(file, error))
        fail_in_file(file, "is a directory, not a file");
    OpenFile opened(std::fopen(file.string().c_str(), "rb"));
    if (!opened)
        fail_in_file(file, reason(errno));
    return opened;
}

// The size of the file as a first capacity. It avoids copies while a large file is read.
std::size_t expected_size(const std::filesystem::path& file) {
    std::error_code error;
    const auto size = std::filesystem::file_size(file, error);
    return error ? 0 : static_cast<std::size_t>(size);
}

} // namespace

std::string shown_name(const std::filesystem::path& file) {
    return one_line(file.string());
}

void fail_in_file(const std::filesystem::path& file, const std::string& why) {
    throw InvalidInput(shown_name(file) + ": " + why);
}

std::string read_file(const std::filesystem::path& file) {
    const OpenFile opened = open_file(file);
    // The free capacity is always at least one step, therefore a full buffer never looks like the end of the file.
    constexpr std::size_t step = 1 << 16;
    std::string bytes(expected_size(file) + step, '\0');
    std::size_t size = 0;
    while (const std::size_t got = std::fread(bytes.data() + size, 1, bytes.size() - size, opened.get())) {
        size += got;
        if (bytes.size() - size < step)
            bytes.resize(2 * bytes.size());
    }
    if (std::ferror(opened.get()))
        fail_in_file(file, reason(errno));
    bytes.resize(size);
    if (bytes.empty())
        fail_in_file(file, "is empty");
    return bytes;
}

} // namespace chasles::io
