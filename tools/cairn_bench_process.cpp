// Starts a program with posix_spawn, reads both of its streams until they close, and judges its
// end.

#include "cairn_bench_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>

extern char** environ;

namespace cairn::tool {

namespace {

using Clock = std::chrono::steady_clock;

class Pipe {
public:
    Pipe() { is_open_ = pipe2(ends_.data(), O_CLOEXEC) == 0; }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe() {
        close_write();
        if (is_open_) close(ends_[0]);
    }

    bool is_open() const { return is_open_; }
    int read_end() const { return ends_[0]; }
    int write_end() const { return ends_[1]; }
    void close_write() {
        if (is_open_ && ends_[1] >= 0) close(ends_[1]);
        ends_[1] = -1;
    }

private:
    std::array<int, 2> ends_ = {-1, -1};
    bool is_open_ = false;
};

// 0, or why it could not be started.
int spawn(const std::string& program, const std::vector<std::string>& arguments, const Pipe& out,
          const Pipe& err, pid_t& process) {
    std::vector<char*> argv = {const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments) {
        argv.push_back(const_cast<char*>(argument.c_str()));
    }
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, out.write_end(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err.write_end(), STDERR_FILENO);
    const int failure =
        posix_spawn(&process, program.c_str(), &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    return failure;
}

// False once the time is up before both streams are closed.
bool read_streams(const Pipe& out, const Pipe& err, Clock::time_point deadline,
                  ProcessOutcome& outcome) {
    std::array<pollfd, 2> streams = {{{out.read_end(), POLLIN, 0}, {err.read_end(), POLLIN, 0}}};
    const std::array<std::string*, 2> texts = {&outcome.out, &outcome.err};
    while (streams[0].fd >= 0 || streams[1].fd >= 0) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
        if (left.count() <= 0) return false;
        const int ready = poll(streams.data(), streams.size(), static_cast<int>(left.count()) + 1);
        if (ready < 0 && errno != EINTR) return false;
        if (ready <= 0) continue;
        for (std::size_t i = 0; i < streams.size(); ++i) {
            if (streams[i].fd < 0 || streams[i].revents == 0) continue;
            std::array<char, 4096> buffer;
            const ssize_t count = read(streams[i].fd, buffer.data(), buffer.size());
            if (count > 0) {
                texts[i]->append(buffer.data(), static_cast<std::size_t>(count));
            } else if (count == 0 || errno != EINTR) {
                streams[i].fd = -1;
            }
            if (outcome.err.size() > 4096) outcome.err.erase(0, outcome.err.size() - 4096);
        }
    }
    return true;
}

std::string find_last_line(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    const std::size_t start = text.find_last_of('\n');
    return start == text.npos ? text : text.substr(start + 1);
}

std::string explain_end(int status, const std::string& err) {
    const std::string said = find_last_line(err);
    if (WIFSIGNALED(status)) {
        const int signal = WTERMSIG(status);
        return fmt::format("ended by signal {} ({}){}", signal, strsignal(signal),
                           said.empty() ? "" : ": " + said);
    }
    if (WEXITSTATUS(status) == 0) return {};
    return said.empty() ? fmt::format("ended with status {}", WEXITSTATUS(status)) : said;
}

}  // namespace

ProcessOutcome run_process(const std::string& program, const std::vector<std::string>& arguments,
                           int seconds) {
    ProcessOutcome outcome;
    Pipe out, err;
    pid_t process = 0;
    const int failure =
        out.is_open() && err.is_open() ? spawn(program, arguments, out, err, process) : errno;
    if (failure != 0) {
        outcome.problem = fmt::format("{} cannot be started: {}", program, std::strerror(failure));
        return outcome;
    }
    out.close_write();
    err.close_write();
    const bool in_time =
        read_streams(out, err, Clock::now() + std::chrono::seconds(seconds), outcome);
    if (!in_time) kill(process, SIGKILL);
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    outcome.problem =
        in_time ? explain_end(status, outcome.err) : fmt::format("not done after {} s", seconds);
    return outcome;
}

}  // namespace cairn::tool
