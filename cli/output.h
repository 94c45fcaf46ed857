// Output with a check of every write: a full disk or a closed pipe is an error, and no file that is read is
// overwritten.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace chasles::cli {

/// Makes output fail with an error where it would end the program (a closed pipe, a limit of file sizes), and keeps
/// files from getting the descriptor of a standard stream that is closed. To be called first.
void prepare_output();

/// Removes FILE.part of outputs that are not closed and whose rows are not kept. A signal handler may call it.
void remove_unfinished() noexcept;

/// Writes to standard output. Throws InvalidInput if the write fails.
void print(const std::string& text);

/// Whether the name is that of the file, pipe or device that standard output goes to.
bool is_standard_output(const std::string& name);

/// What becomes of FILE.part if a run that was cut has left it.
enum class Leftover {
    replaced,
    refused,  ///< it holds rows that may have taken long
    continued ///< the first write comes after `kept_rows`
};

/// A file for output. It grows as FILE.part beside FILE and gets its name in `close`: whatever happens before, a former
/// FILE stays whole. Pipes, devices and the file that standard output goes to are written directly.
///
/// Make it after all reading: the constructor refuses a file that the program has read, a file that cannot be written,
/// and the name of another output. Throws InvalidInput "FILE: REASON" for these, and for a write that fails.
class OutputFile {
public:
    explicit OutputFile(const std::string& name, Leftover leftover = Leftover::replaced);
    /// Removes FILE.part unless it was closed or its rows are kept.
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Writes and flushes, so that the text survives the end of the program.
    void write(const std::string& text);

    /// Gives the file its name. Some write errors are reported only here.
    void close();

    /// From now on FILE.part stays if the file is not closed.
    void keep_rows();
    /// The content of FILE.part that is continued; empty if there is none.
    [[nodiscard]] std::string kept_rows() const;
    /// Continues after so many bytes of `kept_rows`. Before the first write only.
    void continue_after(std::size_t bytes) { kept_bytes_ = bytes; }
    /// Where rows are until `close`: FILE.part, or FILE where output goes directly.
    [[nodiscard]] std::string rows_name() const { return part_.empty() ? name_ : part_.string(); }

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    void check_part() const;
    void open_part();
    [[noreturn]] void fail(int error) const;

    std::string name_;
    std::filesystem::path target_; ///< the file behind links
    std::filesystem::path part_;   ///< empty where output goes directly
    Leftover leftover_;
    std::size_t kept_bytes_ = 0;
    std::unique_ptr<std::FILE, Close> file_; ///< FILE.part is opened by the first write
    bool keeps_rows_ = false;
};

} // namespace chasles::cli
