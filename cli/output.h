// Output with a check of every write: a full disk or a closed pipe is an error.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

namespace chasles::cli {

/// Writes to standard output. Throws InvalidInput if the write fails.
void print(const std::string& text);

/// Whether the name is that of the file, pipe or device that standard output goes to.
bool is_standard_output(const std::string& name);

/// A file for output. If it is where standard output goes, writing continues there and replaces nothing. The
/// constructor checks that the file can be written. The first write replaces the former content:
/// an error that is found before the first write leaves the file unchanged. Throws InvalidInput "FILE: REASON" if the
/// file cannot be opened or written.
class OutputFile {
public:
    explicit OutputFile(const std::string& name);

    /// Writes and flushes, so that the text survives an interruption of the program.
    void write(const std::string& text);

    /// Closes the file. Some write errors are reported only here.
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
