// What the command line says on a terminal, see cairn_terminal.h.

#include "cairn_terminal.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace cairn::tool {

namespace {

constexpr std::size_t usual_bar = 30;
// A shorter bar says less than the percentage beside it.
constexpr std::size_t least_bar = 5;

// Characters that fit on a line: one less than it has, since a full line wraps on some terminals.
std::size_t find_room() {
    winsize size = {};
    const bool is_known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
    return is_known ? std::size_t{size.ws_col} - 1 : 79;
}

}  // namespace

int fail(int status, const std::string& message) {
    fmt::print(stderr, "cairn: {}\n", message);
    return status;
}

ProgressBar::ProgressBar(std::uint64_t total, bool is_wanted)
    : total_(total),
      is_wanted_(is_wanted && total > 0 && isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      last_(start_) {}

void ProgressBar::update(std::uint64_t now) {
    if (!is_wanted_) return;
    const Clock::time_point time = Clock::now();
    const double taken = std::chrono::duration<double>(time - start_).count();
    const double since = std::chrono::duration<double>(time - last_).count();
    if (taken < 1 || (is_shown_ && since < 0.1)) return;
    last_ = time;
    is_shown_ = true;
    const double part = static_cast<double>(now) / static_cast<double>(total_);
    std::string line = fmt::format("{:3.0f}%  step {} of {}, {:.0f} s left", 100 * part, now,
                                   total_, taken * (1 - part) / part);
    const std::size_t room = find_room();
    const std::size_t beside = line.size() + 3;
    if (room >= beside + least_bar) {
        const std::size_t length = std::min(usual_bar, room - beside);
        const auto filled = static_cast<std::size_t>(static_cast<double>(length) * part);
        line = fmt::format("[{}{}] {}", std::string(filled, '#'), std::string(length - filled, '.'),
                           line);
    }
    if (line.size() > room) line = fmt::format("{:.0f}%", 100 * part);
    show(line);
}

void ProgressBar::clear() {
    if (!is_shown_) return;
    show("");
    fmt::print(stderr, "\r");
    is_shown_ = false;
}

// Over the last line, with spaces for what that was longer.
void ProgressBar::show(const std::string& line) {
    fmt::print(stderr, "\r{:<{}}", line, std::min(shown_length_, find_room()));
    std::fflush(stderr);
    shown_length_ = line.size();
}

}  // namespace cairn::tool
