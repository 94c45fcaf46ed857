// Reads a whole file into memory and makes messages that start with its name.
// Every failure is an InvalidInput.
#pragma once

#include <filesystem>
#include <string>

namespace chasles::io {

/// The bytes of a file, or of a pipe that ends within 256 MiB. Throws InvalidInput if the file does not exist, is a
/// directory or a device, is empty, is a Git LFS pointer, is larger than half of the memory, grows while it is read, or
/// cannot be read; and for a pipe that stays silent for 30 seconds after it is opened. Links are followed.
std::string read_file(const std::filesystem::path& file);

/// While one exists, it lists the files that `read_file` reads, on all threads: a program must not write what it reads.
/// At most one may exist at a time.
class ReadLog {
public:
    ReadLog();
    ~ReadLog();
    ReadLog(const ReadLog&) = delete;
    ReadLog& operator=(const ReadLog&) = delete;

    /// Whether the file was read, under this name or another one. False if no log exists.
    [[nodiscard]] static bool has(const std::filesystem::path& file);
};

/// Whether half of the memory holds the bytes; a mesh needs the other half.
bool fits_into_memory(std::size_t bytes);

/// The name of a file for messages: as given, in one line.
std::string shown_name(const std::filesystem::path& file);

/// Throws InvalidInput "FILE: WHY".
[[noreturn]] void fail_in_file(const std::filesystem::path& file, const std::string& why);

} // namespace chasles::io
