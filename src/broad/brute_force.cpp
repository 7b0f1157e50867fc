// All pairs of overlapping boxes; see brute_force.h.

#include "broad/brute_force.h"

namespace cairn {

void find_pairs_by_brute_force(std::span<const Proxy> proxies, std::vector<Pair>& pairs) {
    pairs.clear();
    // Ascending ids in both loops: the pairs come out sorted.
    for (std::size_t i = 0; i < proxies.size(); ++i) {
        const Proxy& a = proxies[i];
        for (std::size_t j = i + 1; j < proxies.size(); ++j) {
            const Proxy& b = proxies[j];
            if (overlaps(a.box, b.box) && (a.moves || b.moves)) pairs.push_back({a.id, b.id});
        }
    }
}

}  // namespace cairn
