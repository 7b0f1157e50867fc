#pragma once
// What a world remembers of who moves and who sleeps; sleep.h says what is done with it.

#include <cstdint>

#include "base/large_array.h"
#include "island/islands.h"
#include "island/stillness.h"

namespace cairn {

// A body that may fall asleep.
struct Sleeper {
    Stillness stillness;
    BodyExtent extent;
    bool still = false;  // after the last step
};

struct RestState {
    // By body slot. A body that was changed since the last step is looked at in the next, moving or
    // not.
    static constexpr std::uint8_t is_moving = 1, is_changed = 2;
    LargeArray<std::uint8_t> states;

    Islands islands;                  // of dynamic bodies that are not frozen
    LargeArray<Sleeper> sleepers;     // by place in the islands
    LargeArray<std::uint32_t> links;  // in the islands, by contact slot

    LargeArray<std::uint32_t> movers;    // ascending, as of the last list_moving()
    LargeArray<std::uint32_t> starting;  // move since
    bool any_stopped = false;            // some of the movers no longer move
    LargeArray<std::uint32_t> changed;   // bodies
    // Bodies whose boxes must be renewed, and their pairs looked up, whether they move or not.
    LargeArray<std::uint32_t> stale;
    bool any_idle = false;  // there may be fat pairs of which neither is looked at any more

    // Room that steps use again, of no meaning between them.
    struct Verdict {
        std::uint64_t step = 0;  // that it is of
        bool all = false;        // every body of the island is still
        bool any = false;
    };
    LargeArray<Verdict> verdicts;  // by island
    std::vector<std::uint32_t> candidates, parts, merged;
};

}  // namespace cairn
