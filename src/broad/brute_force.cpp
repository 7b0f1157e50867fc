// All pairs of overlapping boxes; see brute_force.h.

#include "broad/brute_force.h"

#include <algorithm>

namespace cairn {

namespace {

// Boxes tested without a branch between them; most blocks hold no partner.
constexpr std::size_t block = 64;

}  // namespace

void BruteForce::find_pairs(std::span<const Proxy> proxies, LargeArray<Pair>& pairs) {
    pairs.clear();
    const std::size_t count = proxies.size();
    const auto spread = [&](std::vector<float>& face, auto&& value) {
        face.resize(count);
        for (std::size_t i = 0; i < count; ++i) face[i] = value(proxies[i].box);
    };
    spread(lower_x_, [](const Aabb& box) { return box.lower.x; });
    spread(lower_y_, [](const Aabb& box) { return box.lower.y; });
    spread(lower_z_, [](const Aabb& box) { return box.lower.z; });
    spread(upper_x_, [](const Aabb& box) { return box.upper.x; });
    spread(upper_y_, [](const Aabb& box) { return box.upper.y; });
    spread(upper_z_, [](const Aabb& box) { return box.upper.z; });

    // Ascending ids in both loops: the pairs come out sorted.
    for (std::size_t i = 0; i < count; ++i) {
        const Aabb box = proxies[i].box;
        for (std::size_t begin = i + 1; begin < count; begin += block) {
            const std::size_t end = std::min(begin + block, count);
            std::uint32_t hits[block];
            std::uint32_t any = 0;
            for (std::size_t j = begin; j < end; ++j) {
                const std::uint32_t hit = std::uint32_t(box.lower.x <= upper_x_[j]) &
                                          std::uint32_t(lower_x_[j] <= box.upper.x) &
                                          std::uint32_t(box.lower.y <= upper_y_[j]) &
                                          std::uint32_t(lower_y_[j] <= box.upper.y) &
                                          std::uint32_t(box.lower.z <= upper_z_[j]) &
                                          std::uint32_t(lower_z_[j] <= box.upper.z);
                hits[j - begin] = hit;
                any |= hit;
            }
            if (any == 0) continue;
            for (std::size_t j = begin; j < end; ++j) {
                if (hits[j - begin] && (proxies[i].moves || proxies[j].moves)) {
                    pairs.push_back({proxies[i].id, proxies[j].id});
                }
            }
        }
    }
}

}  // namespace cairn
