// A child process that answers lines of text. Every failure becomes an exception with a reason of one line: each wait
// has a limit, and writing to a child that has ended raises no signal.
#pragma once

#include <chrono>
#include <stdexcept>
#include <string>
#include <sys/types.h>
#include <vector>

namespace chasles::bench {

/// The reason of a failure, in one line.
struct ChildFailed : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Lines are written to the child's standard input and read from its standard output. The child shares our standard
/// error. The destructor kills the child, and so does every failure. Each method may throw ChildFailed; after this
/// exception the object is unusable.
class ChildProcess {
public:
    using Limit = std::chrono::duration<double>;

    /// Starts the program, which is searched in PATH, with its arguments.
    explicit ChildProcess(const std::vector<std::string>& command);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    void write_line(const std::string& line, Limit limit);
    /// The next line, without the line end.
    std::string read_line(Limit limit);
    /// Writes a line and reads the reply. Each step has the limit.
    std::string ask(const std::string& line, Limit limit);

private:
    /// Waits until the socket is ready for `event`. Throws ChildFailed at the deadline.
    void wait_for(short event, std::chrono::steady_clock::time_point deadline, Limit limit);
    [[noreturn]] void fail(const std::string& reason);
    /// Describes how the child ended, if it has ended.
    std::string ending();
    void kill();

    pid_t id_ = -1;
    int socket_ = -1;
    std::string received_; ///< bytes after the last line that was read
};

} // namespace chasles::bench
