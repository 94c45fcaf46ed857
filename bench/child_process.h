// A program that runs beside this one and is asked line by line. However it fails, the asker goes on with one line of
// reason: it waits no longer than it says, and a child that is gone is no signal.
#pragma once

#include <chrono>
#include <stdexcept>
#include <string>
#include <sys/types.h>
#include <vector>

namespace chasles::bench {

/// Why there is no answer, in one line.
struct ChildFailed : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Lines go to its standard input and come from its standard output; its standard error is ours. It is killed when it
/// fails, and in the end. Any method throws ChildFailed, after which there is nothing to be asked any more.
class ChildProcess {
public:
    using Limit = std::chrono::duration<double>;

    /// The program, looked up in PATH, and its arguments.
    explicit ChildProcess(const std::vector<std::string>& command);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    void write_line(const std::string& line, Limit limit);
    /// Without its end.
    std::string read_line(Limit limit);
    /// Both within the limit each.
    std::string ask(const std::string& line, Limit limit);

private:
    /// Until the socket is ready for `event`; throws at the deadline.
    void wait_for(short event, std::chrono::steady_clock::time_point deadline, Limit limit);
    [[noreturn]] void fail(const std::string& reason);
    /// How the child ended, if it has.
    std::string ending();
    void kill();

    pid_t id_ = -1;
    int socket_ = -1;
    std::string received_; ///< beyond the last line that was read
};

} // namespace chasles::bench
