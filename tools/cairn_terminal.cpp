// What the command line says on a terminal, see cairn_terminal.h.

#include "cairn_terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace cairn::tool {

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
    const auto filled = static_cast<std::size_t>(30 * part);
    fmt::print(stderr, "\r[{}{}] {:3.0f}%  step {} of {}, {:.0f} s left ", std::string(filled, '#'),
               std::string(30 - filled, '.'), 100 * part, now, total_, taken * (1 - part) / part);
    std::fflush(stderr);
}

void ProgressBar::clear() {
    if (is_shown_) fmt::print(stderr, "\r{}\r", std::string(78, ' '));
    is_shown_ = false;
}

}  // namespace cairn::tool
