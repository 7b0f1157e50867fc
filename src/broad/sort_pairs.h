#pragma once
// Sorts pairs by their ids, in time that grows with their number alone.

#include "base/large_array.h"
#include "broad/proxy.h"

namespace cairn {

// `room` is used and kept for the next time.
void sort_pairs(LargeArray<Pair>& pairs, LargeArray<Pair>& room);

}  // namespace cairn
