// The trees against brute force, through the bookkeeping that a world does: what is kept of the
// pairs told must at any time be all pairs among the fat boxes.

#include "broad/tree_pairs.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <map>

#include "broad/brute_force.h"
#include "broad/sort_pairs.h"

using namespace cairn;

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

struct Random {
    std::uint64_t state = 7;
    std::uint32_t bits() {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return std::uint32_t(state >> 33);
    }
    std::uint32_t below(std::uint32_t count) { return bits() % count; }
    float unit() { return float(bits()) * (1.0f / 2147483648.0f); }
    float between(float low, float high) { return low + (high - low) * unit(); }
    Vec3 point(float reach) {
        const float x = between(-reach, reach), y = between(-reach, reach);
        return {x, y, between(-reach, reach)};
    }
};

Aabb cube(Vec3 center, float half) {
    const Vec3 h = {half, half, half};
    return {center - h, center + h};
}

Aabb grow(const Aabb& box, float margin) {
    const Vec3 m = {margin, margin, margin};
    return {box.lower - m, box.upper + m};
}

// What a world does with the pairs it is told, and what it ought to have.
struct Caller {
    TreePairs trees;
    std::map<std::uint32_t, Proxy> proxies;
    std::map<std::uint32_t, bool> touched;
    LargeArray<Pair> kept;

    void insert(std::uint32_t id, const Aabb& box, bool moves) {
        CHECK(trees.insert(id, box, moves));
        proxies[id] = {box, id, moves};
        touched[id] = true;
    }
    void insert_many(const std::vector<Proxy>& many) {
        CHECK(trees.insert_many(many));
        for (const Proxy& proxy : many) {
            proxies[proxy.id] = proxy;
            touched[proxy.id] = true;
        }
    }
    void remove(std::uint32_t id) {
        trees.remove(id);
        proxies.erase(id);
        touched.erase(id);
    }
    void update(std::uint32_t id, const Aabb& tight, const Aabb& fat) {
        const bool escapes = !contains(proxies[id].box, tight);
        CHECK(trees.update(id, tight, fat) == escapes);
        if (!escapes) return;
        proxies[id].box = fat;
        touched[id] = true;
    }
    void set_moves(std::uint32_t id, bool moves) {
        trees.set_moves(id, moves);
        if (proxies[id].moves != moves) touched[id] = true;
        proxies[id].moves = moves;
    }

    LargeArray<Pair> all_pairs() const {
        std::vector<Proxy> list;
        for (const auto& [id, proxy] : proxies) list.push_back(proxy);
        LargeArray<Pair> pairs;
        BruteForce().find_pairs(list, pairs);
        return pairs;
    }

    // Finds the new pairs; true when they are those with a touched id, and all kept are all there
    // are.
    bool step() {
        LargeArray<Pair> told;
        trees.find_new_pairs(told);
        kept.insert(kept.end(), told.begin(), told.end());
        std::sort(kept.begin(), kept.end());
        kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
        std::erase_if(kept, [&](const Pair& pair) { return !trees.make_pair(pair.a, pair.b); });

        const LargeArray<Pair> all = all_pairs();
        LargeArray<Pair> fresh = all;
        std::erase_if(fresh, [&](const Pair& pair) {
            return !touched.contains(pair.a) && !touched.contains(pair.b);
        });
        touched.clear();
        return told == fresh && kept == all && trees.is_sound();
    }

    // A random change among ids below `id_count`, in a world that reaches so far.
    void change(Random& random, std::uint32_t id_count, float reach) {
        const std::uint32_t id = random.below(id_count);
        const bool is_there = proxies.contains(id);
        const std::uint32_t what = random.below(20);
        if (!is_there) {
            const Aabb box = some_box(random, reach);
            insert(id, box, random.below(3) != 0);
        } else if (what == 0) {
            remove(id);
        } else if (what == 1) {
            set_moves(id, random.below(2) != 0);
        } else if (what == 2) {
            const Aabb far = some_box(random, reach);
            update(id, far, grow(far, 0.1f));
        } else {
            const Vec3 by = random.point(0.3f);
            const Aabb old = proxies[id].box;
            const Aabb tight = {old.lower + by, old.upper + by};
            update(id, tight, grow(tight, 0.1f));
        }
    }

    static Aabb some_box(Random& random, float reach) {
        const Vec3 center = random.point(reach);
        switch (random.below(40)) {
            case 0: return {{-infinite, -infinite, -infinite}, {infinite, infinite, infinite}};
            case 1: return {{-infinite, center.y - 1, -infinite}, {infinite, center.y, infinite}};
            case 2: return {{-3e38f, -3e38f, -3e38f}, {3e38f, center.y, 3e38f}};
            case 3: return cube(center, reach);
            case 4: return cube(center, 1e6f);
            case 5: return cube(center, 1e-6f);
            case 6: return {center, center};
            default: return cube(center, random.between(0.2f, 1.2f));
        }
    }
};

}  // namespace

TEST_CASE("over long random walks the pairs kept are at every step those of brute force") {
    Random random;
    Caller caller;
    for (int step = 0; step < 3000; ++step) {
        // Now a full world, now a nearly empty one, now an idle one.
        const std::uint32_t id_count = step % 1000 < 700 ? 300 : 20;
        const std::uint32_t changes = step % 7 == 0 ? 0 : random.below(60);
        for (std::uint32_t i = 0; i < changes; ++i) caller.change(random, id_count, 6);
        for (std::uint32_t id = id_count; step % 1000 == 700 && id < 300; ++id)
            if (caller.proxies.contains(id)) caller.remove(id);
        REQUIRE(caller.step());
    }
    // Down to nothing, and up again.
    while (!caller.proxies.empty()) caller.remove(caller.proxies.begin()->first);
    REQUIRE(caller.step());
    CHECK(caller.kept.empty());
    caller.change(random, 1, 1);
    REQUIRE(caller.step());
}

TEST_CASE("a thousand boxes that drift, mix and burst asunder keep the pairs of brute force") {
    Random random;
    Caller caller;
    std::vector<Proxy> many;
    for (std::uint32_t id = 0; id < 1000; ++id)
        many.push_back({cube(random.point(12), 0.5f), id, id % 5 != 0});
    caller.insert_many(many);
    REQUIRE(caller.step());
    for (int step = 0; step < 60; ++step) {
        for (std::uint32_t id = 0; id < 1000; ++id) {
            const Aabb old = caller.proxies[id].box;
            const Vec3 center = 0.5f * (old.lower + old.upper);
            Vec3 by = random.point(0.6f);
            if (step % 20 == 10) by = by + 0.5f * center;    // they burst
            if (step % 20 == 15) by = by + -0.34f * center;  // and come back
            if (step == 45) by = random.point(12) - center;  // all jump at once
            if (id % 5 == 0) continue;
            const Aabb tight = cube(center + by, 0.5f);
            caller.update(id, tight, grow(tight, 0.1f));
        }
        REQUIRE(caller.step());
    }
}

TEST_CASE("a copy takes the same future as its original, to the order of its nodes") {
    Random random;
    Caller original;
    for (int i = 0; i < 2000; ++i) original.change(random, 200, 6);
    Caller copy = original;
    Random same = random;
    for (int step = 0; step < 50; ++step) {
        for (int i = 0; i < 30; ++i) original.change(random, 200, 6);
        REQUIRE(original.step());
    }
    for (int step = 0; step < 50; ++step) {
        for (int i = 0; i < 30; ++i) copy.change(same, 200, 6);
        REQUIRE(copy.step());
    }
    CHECK(copy.kept == original.kept);
    for (const bool moves : {false, true}) {
        LargeArray<std::uint32_t> ids, ids_of_copy;
        original.trees.tree(moves).list_leaves(ids);
        copy.trees.tree(moves).list_leaves(ids_of_copy);
        CHECK(ids == ids_of_copy);
    }
}

TEST_CASE("a search cut into parts, done in any order, finds the same pairs") {
    Random random;
    TreePairs whole;
    for (std::uint32_t id = 0; id < 500; ++id) {
        const Aabb box = Caller::some_box(random, 10);
        whole.insert(id, box, random.below(2) != 0);
    }
    TreePairs cut = whole;
    LargeArray<Pair> expected, pairs;
    whole.find_new_pairs(expected);
    const std::size_t count = cut.prepare_search();
    REQUIRE(count > 7);
    for (std::size_t end = count; end > 0;) {
        const std::size_t begin = end > 7 ? end - 7 : 0;
        LargeArray<Pair> part;
        cut.search(begin, end, part);
        pairs.insert(pairs.end(), part.begin(), part.end());
        end = begin;
    }
    cut.finish_search(pairs);
    CHECK(pairs == expected);
    // All marks are forgotten.
    CHECK(cut.prepare_search() == 0);
    cut.finish_search(pairs);
    cut.find_new_pairs(pairs);
    CHECK(pairs.empty());
}

TEST_CASE("a plate over a thousand pillars meets all thousand, and nobody else does") {
    Caller caller;
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const Vec3 foot = {2.0f * float(i % 40), 0, 2.0f * float(i / 40)};
        caller.insert(i, {foot, foot + Vec3{1, 10, 1}}, true);
    }
    caller.insert(1000, {{0, 10, 0}, {80, 11, 50}}, true);
    REQUIRE(caller.step());
    CHECK(caller.kept.size() == 1000);
    // It alone is moved, and meets them all again.
    caller.update(1000, {{0, 9.5f, 0}, {80, 10.5f, 50}}, {{0, 9, 0}, {80, 11, 50}});
    REQUIRE(caller.step());
    CHECK(caller.kept.size() == 1000);
}

TEST_CASE("boxes at one place, along a line, or of sizes from 2^-20 to 2^20 stay a sound tree") {
    for (const int layout : {0, 1, 2, 3}) {
        for (const bool at_once : {false, true}) {
            Random random;
            Caller caller;
            std::vector<Proxy> many;
            for (std::uint32_t id = 0; id < 400; ++id) {
                Aabb box = {};
                if (layout == 1) box = cube({1, 2, 3}, 1);
                if (layout == 2) box = {{float(id), 0, 0}, {float(id), 0, 0}};
                if (layout == 3) {
                    const float half =
                        float(1u << random.below(21)) / float(1u << random.below(21));
                    box = cube(random.point(1000), half);
                }
                many.push_back({box, id, true});
            }
            if (at_once) caller.insert_many(many);
            for (const Proxy& proxy : many) {
                if (!at_once) caller.insert(proxy.id, proxy.box, proxy.moves);
            }
            REQUIRE(caller.step());
            for (std::uint32_t id = 0; id < 400; id += 3) caller.remove(id);
            REQUIRE(caller.step());
            // No deeper than three children a node would make it.
            CHECK(caller.trees.tree(true).level_count() <= 6);
            // Points along a line do not overlap at all: their nodes should not either.
            const std::size_t visits =
                caller.trees.tree(true).count_visits({{100, 0, 0}, {100, 0, 0}});
            if (layout == 2) CHECK(visits <= 6);
        }
    }
}

TEST_CASE("a box that is not a number or is inside out is refused, and disturbs nothing") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Caller caller;
    caller.insert(0, cube({0, 0, 0}, 1), true);
    caller.insert(1, cube({1, 0, 0}, 1), false);
    for (const Aabb& bad :
         {Aabb{{nan, 0, 0}, {1, 1, 1}}, Aabb{{0, 0, 0}, {1, nan, 1}}, Aabb{{0, 0, 1}, {1, 1, 0}}}) {
        CHECK_FALSE(caller.trees.insert(2, bad, true));
        CHECK_FALSE(caller.trees.is_there(2));
        CHECK_FALSE(caller.trees.update(0, bad, bad));
        CHECK_FALSE(caller.trees.insert_many(std::vector<Proxy>{{bad, 2, true}}));
    }
    CHECK_FALSE(caller.trees.insert(1, cube({5, 0, 0}, 1), true));
    CHECK(caller.trees.box(0).upper.x == 1);
    CHECK(caller.step());
    CHECK(caller.kept.size() == 1);
}

TEST_CASE("a query finds every box that it overlaps, planes included") {
    Random random;
    Caller caller;
    for (std::uint32_t id = 0; id < 300; ++id) {
        const Aabb box = Caller::some_box(random, 10);
        caller.insert(id, box, random.below(2) != 0);
    }
    for (int i = 0; i < 200; ++i) {
        const Aabb box = Caller::some_box(random, 10);
        std::vector<std::uint32_t> found, expected;
        caller.trees.query(box, [&](std::uint32_t id) { found.push_back(id); });
        std::sort(found.begin(), found.end());
        for (const auto& [id, proxy] : caller.proxies)
            if (overlaps(proxy.box, box)) expected.push_back(id);
        CHECK(found == expected);
    }
}

TEST_CASE("a million boxes at once take less than 100 bytes each") {
    std::vector<Proxy> many;
    for (std::uint32_t i = 0; i < 1000000; ++i) {
        const Vec3 center = {10.0f * float(i % 1000), 0, 10.0f * float(i / 1000)};
        many.push_back({cube(center, 2), i, false});
    }
    TreePairs trees;
    REQUIRE(trees.insert_many(many));
    REQUIRE(trees.insert(1000000, cube({5000, 0, 5000}, 6), true));
    LargeArray<Pair> pairs;
    trees.find_new_pairs(pairs);
    CHECK(pairs.size() == 1);
    const double bytes = 1e-6 * double(trees.byte_count());
    MESSAGE(bytes << " bytes a box");
    CHECK(bytes < 100);
    CHECK(trees.is_sound());
}

TEST_CASE("bodies that cross the world for half a minute leave a tree as good as a new one") {
    Random random;
    constexpr std::uint32_t count = 2000;
    TreePairs walked;
    std::vector<Vec3> centers(count), velocities(count);
    for (std::uint32_t id = 0; id < count; ++id) {
        centers[id] = random.point(20);
        velocities[id] = random.point(5);
        walked.insert(id, cube(centers[id], 0.6f), true);
    }
    LargeArray<Pair> pairs;
    double walked_visits = 0, fresh_visits = 0;
    for (int step = 0; step < 2000; ++step) {
        for (std::uint32_t id = 0; id < count; ++id) {
            centers[id] = centers[id] + (1.0f / 60) * velocities[id];
            for (int axis = 0; axis < 3; ++axis) {
                if (absolute(component(centers[id], axis)) > 20)
                    set_component(velocities[id], axis, -component(velocities[id], axis));
            }
            walked.update(id, cube(centers[id], 0.5f), cube(centers[id], 0.6f));
        }
        walked.find_new_pairs(pairs);
        if (step % 100 != 0) continue;
        std::vector<Proxy> proxies;
        for (std::uint32_t id = 0; id < count; ++id) proxies.push_back({walked.box(id), id, true});
        TreePairs fresh;
        fresh.insert_many(proxies);
        for (const Proxy& proxy : proxies) {
            walked_visits += double(walked.tree(true).count_visits(proxy.box));
            fresh_visits += double(fresh.tree(true).count_visits(proxy.box));
        }
    }
    const double queries = 20.0 * count;
    const double walked_mean = walked_visits / queries, fresh_mean = fresh_visits / queries;
    MESSAGE(walked_mean << " nodes a query, " << fresh_mean << " in a new tree");
    CHECK(walked_mean < 1.3 * fresh_mean);
}

TEST_CASE(
    "boxes put in one by one make a tree little worse than at once, and leave no room behind") {
    Random random;
    TreePairs single, bulk;
    std::vector<Proxy> many;
    for (std::uint32_t id = 0; id < 5000; ++id) {
        many.push_back({cube(random.point(15), 0.5f), id, true});
        single.insert(id, many.back().box, true);
    }
    bulk.insert_many(many);
    std::size_t single_visits = 0, bulk_visits = 0;
    for (const Proxy& proxy : many) {
        single_visits += single.tree(true).count_visits(proxy.box);
        bulk_visits += bulk.tree(true).count_visits(proxy.box);
    }
    const double ratio = double(single_visits) / double(bulk_visits);
    MESSAGE(ratio << " times the nodes a query");
    CHECK(ratio < 1.6);

    // Where the only box far away was, nothing is looked for.
    single.insert(5000, cube({1000, 1000, 1000}, 1), true);
    single.remove(5000);
    CHECK(single.tree(true).count_visits(cube({500, 500, 500}, 1)) == 1);
}

TEST_CASE("pairs are sorted by both ids, few or many, small ids or large") {
    Random random;
    LargeArray<Pair> room;
    for (const std::uint32_t count : {0u, 1u, 100u, 20000u}) {
        for (const std::uint32_t most : {1u, 1000u, 100000u, 0x7fffffffu}) {
            LargeArray<Pair> pairs;
            for (std::uint32_t i = 0; i < count; ++i)
                pairs.push_back({random.below(most), random.below(most)});
            LargeArray<Pair> expected = pairs;
            std::sort(expected.begin(), expected.end());
            sort_pairs(pairs, room);
            CHECK(pairs == expected);
        }
    }
}
