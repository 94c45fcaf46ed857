// Reads a whole file into memory and makes messages that start with its name.
// Every failure is an InvalidInput.
#pragma once

#include <filesystem>
#include <string>

namespace chasles::io {

/// The bytes of a file. Throws InvalidInput if it does not exist, is a directory, is empty, or cannot be read.
std::string read_file(const std::filesystem::path& file);

/// The name of a file for messages: as given, in one line.
std::string shown_name(const std::filesystem::path& file);

/// Throws InvalidInput "FILE: WHY".
[[noreturn]] void fail_in_file(const std::filesystem::path& file, const std::string& why);

} // namespace chasles::io
