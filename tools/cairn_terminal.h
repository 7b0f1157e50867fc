#pragma once
// What the command line says on a terminal: one-line errors, the progress bar.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

namespace cairn::tool {

/// Exit statuses.
inline constexpr int done = 0;
inline constexpr int went_wrong = 1;
inline constexpr int bad_usage = 2;

/// Prints "cairn: message" on standard error; returns `status`.
int fail(int status, const std::string& message);

/// A line on standard error that shows how far a run is: only where that is a terminal, and only
/// once the run has taken a second. As wide as the terminal has room for, and without colour.
class ProgressBar {
public:
    ProgressBar(std::uint64_t total, bool is_wanted);
    void update(std::uint64_t now);
    /// Takes the line off the terminal.
    void clear();

private:
    void show(const std::string& line);

    using Clock = std::chrono::steady_clock;
    std::uint64_t total_;
    bool is_wanted_;
    bool is_shown_ = false;
    std::size_t shown_length_ = 0;
    Clock::time_point start_;
    Clock::time_point last_;
};

}  // namespace cairn::tool
