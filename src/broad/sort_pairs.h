#pragma once
// Sorts pairs by their ids, in time that grows with their number alone.

#include <vector>

#include "broad/proxy.h"

namespace cairn {

// `room` is used and kept for the next time.
void sort_pairs(std::vector<Pair>& pairs, std::vector<Pair>& room);

}  // namespace cairn
