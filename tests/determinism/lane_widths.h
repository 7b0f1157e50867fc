#pragma once
// How many contact rows side by side this build can do on this processor.

namespace cairn::test {

// Whether step.lanes = width is met to the full here; so is 0, which names no width.
bool has_lane_width(int width);

}  // namespace cairn::test
