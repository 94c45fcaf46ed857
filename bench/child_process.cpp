#include "bench/child_process.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

extern char** environ;

namespace chasles::bench {

namespace {

using Clock = std::chrono::steady_clock;

Clock::time_point deadline_of(ChildProcess::Limit limit) {
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(limit);
}

/// Starts a command with `socket` as its standard input and output. Returns the error number, or 0.
int spawn(const std::vector<std::string>& command, int socket, pid_t& id) {
    std::vector<char*> arguments;
    for (const std::string& text : command)
        arguments.push_back(const_cast<char*>(text.c_str())); // NOLINT: the interface of posix_spawn
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, socket, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, socket, STDOUT_FILENO);
    const int error = posix_spawnp(&id, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

} // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command) {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw ChildFailed(std::string("no socket for it: ") + std::strerror(errno));
    const int error = spawn(command, ends[1], id_);
    close(ends[1]);
    socket_ = ends[0];
    if (error != 0) {
        id_ = -1;
        close(socket_);
        throw ChildFailed("it does not start: " + std::string(std::strerror(error)));
    }
}

ChildProcess::~ChildProcess() {
    kill();
    close(socket_);
}

void ChildProcess::write_line(const std::string& line, Limit limit) {
    const auto deadline = deadline_of(limit);
    const std::string text = line + '\n';
    for (std::size_t sent = 0; sent < text.size();) {
        wait_for(POLLOUT, deadline, limit);
        const ssize_t count =
            send(socket_, text.data() + sent, text.size() - sent, MSG_DONTWAIT | MSG_NOSIGNAL); // gone: EPIPE
        if (count >= 0)
            sent += std::size_t(count);
        else if (errno != EAGAIN && errno != EINTR)
            fail(ending());
    }
}

std::string ChildProcess::read_line(Limit limit) {
    const auto deadline = deadline_of(limit);
    for (;;) {
        if (const std::size_t end = received_.find('\n'); end != std::string::npos) {
            const std::string line = received_.substr(0, end);
            received_.erase(0, end + 1);
            return line;
        }
        wait_for(POLLIN, deadline, limit);
        std::array<char, 4096> block{};
        const ssize_t count = recv(socket_, block.data(), block.size(), MSG_DONTWAIT);
        if (count > 0)
            received_.append(block.data(), std::size_t(count));
        else if (count == 0 || (errno != EAGAIN && errno != EINTR))
            fail(ending());
    }
}

std::string ChildProcess::ask(const std::string& line, Limit limit) {
    write_line(line, limit);
    return read_line(limit);
}

void ChildProcess::wait_for(short event, Clock::time_point deadline, Limit limit) {
    for (;;) {
        if (id_ < 0)
            throw ChildFailed("it has ended");
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
        pollfd ready{socket_, event, 0};
        if (left.count() > 0 && poll(&ready, 1, int(left.count())) > 0)
            return;
        if (left.count() <= 0) {
            std::array<char, 64> reason{};
            std::snprintf(reason.data(), reason.size(), "no answer within %g s", limit.count());
            fail(reason.data());
        }
    }
}

void ChildProcess::fail(const std::string& reason) {
    kill();
    throw ChildFailed(reason);
}

std::string ChildProcess::ending() {
    for (int wait = 0; wait < 100; ++wait) { // the process may end shortly after its output
        int status = 0;
        if (waitpid(id_, &status, WNOHANG) == id_) {
            id_ = -1;
            return WIFEXITED(status) ? "it ended with exit status " + std::to_string(WEXITSTATUS(status))
                                     : "it ended by signal " + std::to_string(WTERMSIG(status));
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return "it closed its output";
}

void ChildProcess::kill() {
    if (id_ < 0)
        return;
    ::kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
    id_ = -1;
}

} // namespace chasles::bench
