// What goes out, with a check that it arrived: a full disk or a closed pipe is an error, not a success.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

namespace chasles::cli {

/// Writes to standard output. Throws InvalidInput if it cannot be written.
void print(const std::string& text);

/// A file for output. Opening it shows whether it can be written; what it held before is lost only with the first
/// writing, so that a mistake found in between costs nothing. Throws InvalidInput "FILE: WHY" if it cannot be opened or
/// written.
class OutputFile {
public:
    explicit OutputFile(const std::string& name);

    /// Writes and hands over to the system at once, so that what was written survives an interruption.
    void write(const std::string& text);

    /// Closes the file: some errors show only now.
    void close();

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    void empty();
    [[noreturn]] void fail(int error) const;

    std::string name_;
    std::unique_ptr<std::FILE, Close> file_;
    bool is_emptied_ = false;
};

} // namespace chasles::cli
