#pragma once
// How many contact rows side by side this build can do on this processor.

namespace cairn::test {

// Every width that the library was written for.
inline constexpr int all_lane_widths[] = {1, 4, 8, 16};

// Whether step.lanes = width is met to the full here.
bool has_lane_width(int width);

}  // namespace cairn::test
