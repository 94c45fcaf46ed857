// Reads a whole file into memory. Readers can then give the position of every error. A regular file has the size that
// it had when it was opened; a pipe has at most `most_from_pipe` bytes. Devices are refused, because they need not end.
#include "chasles/io/read_file.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/text_scan.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <set>

#if __has_include(<poll.h>)
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>
#endif

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

using FileType = std::filesystem::file_type;
constexpr std::size_t most_from_pipe = std::size_t{256} << 20U;

// The type of the file behind all links. Missing files, directories and devices get their own messages.
FileType type_of(const std::filesystem::path& file) {
    std::error_code error;
    const FileType type = std::filesystem::status(file, error).type();
    if (type == FileType::not_found)
        fail_in_file(file, "no such file");
    if (type == FileType::none)
        fail_in_file(file, reason(error.value()));
    if (type == FileType::directory)
        fail_in_file(file, "is a directory, not a file");
    if (type == FileType::character || type == FileType::block)
        fail_in_file(file, "is a device, which need not end; give a file or a pipe");
    return type;
}

OpenFile checked(const std::filesystem::path& file, std::FILE* opened) {
    if (opened == nullptr)
        fail_in_file(file, reason(errno));
    return OpenFile(opened);
}

#if __has_include(<poll.h>)
// Opens a named pipe and waits for the first bytes. Without a writer, opening it the ordinary way would wait forever.
OpenFile open_pipe(const std::filesystem::path& file) {
    constexpr int longest_wait = 30'000; // milliseconds
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    OpenFile opened = checked(file, descriptor < 0 ? nullptr : ::fdopen(descriptor, "rb"));
    pollfd wait{descriptor, POLLIN, 0};
    if (::poll(&wait, 1, longest_wait) == 0)
        fail_in_file(file, "is a pipe into which nothing was written for 30 seconds");
    ::fcntl(descriptor, F_SETFL, ::fcntl(descriptor, F_GETFL) & ~O_NONBLOCK);
    return opened;
}
#else
OpenFile open_pipe(const std::filesystem::path& file) {
    return checked(file, std::fopen(file.string().c_str(), "rb"));
}
#endif

OpenFile open_file(const std::filesystem::path& file, FileType type) {
    return type == FileType::regular ? checked(file, std::fopen(file.string().c_str(), "rb")) : open_pipe(file);
}

// At most `most` bytes. The buffer grows with what is read.
std::string read_up_to(std::FILE& opened, std::size_t most, std::size_t first_capacity) {
    std::string bytes(first_capacity, '\0');
    std::size_t size = 0;
    while (const std::size_t got = std::fread(bytes.data() + size, 1, bytes.size() - size, &opened)) {
        size += got;
        if (size == bytes.size() && size < most)
            bytes.resize(std::min(2 * size, most));
    }
    bytes.resize(size);
    return bytes;
}

// The whole file. Reading one byte more than allowed shows whether the file ends there.
std::string read_to_end(const std::filesystem::path& file, FileType type) {
    const OpenFile opened = open_file(file, type);
    constexpr std::size_t step = 1 << 16;
    const bool is_pipe = type != FileType::regular;
    std::error_code error;
    const std::size_t most = is_pipe ? most_from_pipe : std::filesystem::file_size(file, error);
    if (error)
        fail_in_file(file, reason(error.value()));
    if (!fits_into_memory(most))
        fail_in_file(file, "does not fit into memory");
    std::string bytes = read_up_to(*opened, most + 1, is_pipe ? step : most + 1);
    if (std::ferror(opened.get()) != 0)
        fail_in_file(file, reason(errno));
    if (bytes.size() > most)
        fail_in_file(file, is_pipe ? "is a pipe that does not end within 256 MiB; write it to a file first"
                                   : "grows while it is read; wait until it is complete");
    return bytes;
}

/// The files that were read while a log exists.
struct Log {
    std::mutex mutex;
    std::optional<std::set<std::filesystem::path>> files;
};

Log& log() {
    static Log log;
    return log;
}

void note_as_read(const std::filesystem::path& file) {
    const std::lock_guard lock(log().mutex);
    std::error_code error;
    if (log().files)
        log().files->insert(std::filesystem::canonical(file, error));
}

} // namespace

ReadLog::ReadLog() {
    const std::lock_guard lock(log().mutex);
    log().files.emplace();
}

ReadLog::~ReadLog() {
    const std::lock_guard lock(log().mutex);
    log().files.reset();
}

bool ReadLog::has(const std::filesystem::path& file) {
    const std::lock_guard lock(log().mutex);
    return log().files && std::ranges::any_of(*log().files, [&](const std::filesystem::path& read) {
               std::error_code ignored;
               return std::filesystem::equivalent(read, file, ignored);
           });
}

// The system would not refuse the memory.
bool fits_into_memory(std::size_t bytes) {
#if defined(_SC_PHYS_PAGES) && defined(_SC_PAGESIZE)
    return bytes / 1024 <= std::size_t(::sysconf(_SC_PHYS_PAGES)) * (std::size_t(::sysconf(_SC_PAGESIZE)) / 1024) / 2;
#else
    return bytes < std::string().max_size();
#endif
}

std::string shown_name(const std::filesystem::path& file) {
    return one_line(file.string());
}

void fail_in_file(const std::filesystem::path& file, const std::string& why) {
    throw InvalidInput(shown_name(file) + ": " + why);
}

std::string read_file(const std::filesystem::path& file) {
    std::string bytes = read_to_end(file, type_of(file));
    note_as_read(file);
    if (bytes.empty())
        fail_in_file(file, "is empty");
    if (is_lfs_pointer(bytes))
        fail_in_file(file, lfs_way_out);
    return bytes;
}

} // namespace chasles::io
