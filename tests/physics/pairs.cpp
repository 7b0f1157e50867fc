// Case C01: no pair is missed, against a naive loop in binary64 over every two bodies.
//
// Spheres and boxes of random size and attitude walk about at random. The naive loop measures each
// two exactly (centres; nearest point of a box; fifteen axes) and its overlaps must be the world's;
// the world's count of overlapping bounds must hold every two whose tight bounds overlap.

#include <algorithm>
#include <array>
#include <set>

#include "scene.h"

namespace cairn::physics {

namespace {

struct Solid {
    bool is_ball = false;
    double radius = 0;
    Vec half;
    Vec at;
    Turn turn;
    std::array<Vec, 3> axes() const {
        return {rotate(turn, {1, 0, 0}), rotate(turn, {0, 1, 0}), rotate(turn, {0, 0, 1})};
    }
    // Half the width along a direction of any length.
    double reach(const Vec& d) const {
        if (is_ball) return radius * length(d);
        const auto [u, v, w] = axes();
        return half.x * std::abs(dot(u, d)) + half.y * std::abs(dot(v, d)) +
               half.z * std::abs(dot(w, d));
    }
};

double ball_to_box(const Solid& ball, const Solid& box) {
    const Vec c = rotate(inverse(box.turn), ball.at - box.at);
    const Vec& h = box.half;
    const Vec nearest = {std::clamp(c.x, -h.x, h.x), std::clamp(c.y, -h.y, h.y),
                         std::clamp(c.z, -h.z, h.z)};
    const double distance = length(c - nearest);
    if (distance > 0) return distance - ball.radius;
    return -ball.radius - std::min({h.x - std::abs(c.x), h.y - std::abs(c.y), h.z - std::abs(c.z)});
}

// Negative where they overlap; its sign alone is meant for boxes apart.
double separation(const Solid& a, const Solid& b) {
    if (a.is_ball && b.is_ball) return length(b.at - a.at) - a.radius - b.radius;
    if (a.is_ball) return ball_to_box(a, b);
    if (b.is_ball) return ball_to_box(b, a);
    double most = -1e9;
    const auto try_axis = [&](const Vec& d) {
        const double size = length(d);
        if (size < 1e-6) return;
        most = std::max(most, (std::abs(dot(b.at - a.at, d)) - a.reach(d) - b.reach(d)) / size);
    };
    for (const Vec& u : a.axes()) try_axis(u);
    for (const Vec& u : b.axes()) try_axis(u);
    for (const Vec& u : a.axes()) {
        for (const Vec& v : b.axes()) try_axis(cross(u, v));
    }
    return most;
}

bool bounds_overlap(const Solid& a, const Solid& b, double margin) {
    const Vec d = b.at - a.at;
    const auto apart = [&](double along, const Vec& axis) {
        return std::abs(along) > a.reach(axis) + b.reach(axis) + margin;
    };
    return !apart(d.x, {1, 0, 0}) && !apart(d.y, {0, 1, 0}) && !apart(d.z, {0, 0, 1});
}

Solid random_solid(Random& random) {
    Solid solid;
    solid.is_ball = random.uniform(0, 1) < 0.5;
    solid.radius = random.uniform(0.1, 0.3);
    solid.half = {random.uniform(0.1, 0.3), random.uniform(0.1, 0.3), random.uniform(0.1, 0.3)};
    solid.at = random.in_cube(2.5);
    solid.turn = random.turn();
    return solid;
}

BodyId add_solid(World& world, const Solid& solid) {
    BodyDef def;
    def.shapes = {solid.is_ball ? ball(solid.radius, rough(0)) : block(2 * solid.half, rough(0))};
    def.position = to_position(solid.at);
    def.rotation = to_quat(solid.turn);
    return add(world, def);
}

struct PairCounts {
    int missed = 0, invented = 0, bounds_missed = 0, bounds_excess = 0, overlapping = 0;
};

using PairSet = std::set<std::pair<std::uint32_t, std::uint32_t>>;

PairSet overlapping_pairs(const World& world, double deeper_than) {
    PairSet pairs;
    for (const ContactReport& contact : world.contacts()) {
        for (int i = 0; i < contact.point_count; ++i) {
            const auto s =
                static_cast<double>(contact.points[static_cast<std::size_t>(i)].separation);
            if (s > -deeper_than) continue;
            pairs.insert(std::minmax(contact.body_a.index, contact.body_b.index));
        }
    }
    return pairs;
}

void count_pairs(const World& world, const std::vector<Solid>& solids,
                 const std::vector<BodyId>& ids, bool with_bounds, PairCounts& counts) {
    // Where two only just overlap binary32 may see it either way.
    const double unsure = 1e-5;
    const PairSet all = overlapping_pairs(world, 0), deep = overlapping_pairs(world, unsure);
    // Bounds may be a little larger than the shapes, to see what comes near: here by up to 1 cm.
    std::size_t bounds = 0, fat_bounds = 0;
    for (std::size_t i = 0; i < solids.size(); ++i) {
        for (std::size_t j = i + 1; j < solids.size(); ++j) {
            if (with_bounds && bounds_overlap(solids[i], solids[j], 0.01)) ++fat_bounds;
            if (!bounds_overlap(solids[i], solids[j], 0)) continue;
            ++bounds;
            const double s = separation(solids[i], solids[j]);
            const PairSet::value_type key = std::minmax(ids[i].index, ids[j].index);
            if (s < 0) ++counts.overlapping;
            if (s < -unsure && !all.contains(key)) ++counts.missed;
            if (s > 0 && deep.contains(key)) ++counts.invented;
        }
    }
    if (!with_bounds) return;
    World stepped = world;
    advance(stepped, 1e-6);
    const std::size_t found = stepped.last_step().pair_count;
    if (found < bounds) counts.bounds_missed += static_cast<int>(bounds - found);
    if (found > fat_bounds) counts.bounds_excess += static_cast<int>(found - fat_bounds);
}

// A speck at each corner of a turned box's bounds: the bounds must reach it.
int count_short_bounds(const Setup& setup) {
    Random random(101);
    World world = make_world(setup, {.gravity = 0});
    Solid box;
    box.half = {0.3, 0.5, 0.9};
    const BodyId body = add_solid(world, box);
    Solid speck;
    speck.is_ball = true;
    speck.radius = 1e-4;
    const BodyId mark = add_solid(world, speck);
    int missed = 0;
    for (int i = 0; i < 1000; ++i) {
        box.turn = random.turn();
        const Vec reach = {box.reach({1, 0, 0}), box.reach({0, 1, 0}), box.reach({0, 0, 1})};
        const Vec corner = {(i & 1) != 0 ? reach.x : -reach.x, (i & 2) != 0 ? reach.y : -reach.y,
                            (i & 4) != 0 ? reach.z : -reach.z};
        World posed = world;
        set_pose(posed, body, {}, box.turn);
        set_pose(posed, mark, corner, {});
        advance(posed, 1e-6);
        if (posed.last_step().pair_count != 1) ++missed;
    }
    return missed;
}

}  // namespace

void find_all_pairs(const Setup& setup, Sheet& sheet) {
    PairCounts counts;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        Random random(seed);
        World world = make_world(setup, {.gravity = 0});
        std::vector<Solid> solids;
        std::vector<BodyId> ids;
        for (int i = 0; i < 500; ++i) {
            solids.push_back(random_solid(random));
            ids.push_back(add_solid(world, solids.back()));
        }
        for (int walk = 0; walk < 100; ++walk) {
            for (std::size_t i = 0; i < solids.size(); ++i) {
                solids[i].at = solids[i].at + random.in_cube(0.1);
                solids[i].turn = turn_about(random.in_cube(1), 0.2) * solids[i].turn;
                set_pose(world, ids[i], solids[i].at, solids[i].turn);
            }
            count_pairs(world, solids, ids, walk % 10 == 0, counts);
        }
    }
    sheet.bound("overlaps met, short of 30000", 30000 - counts.overlapping, 0);
    sheet.bound("overlaps missed", counts.missed, 0);
    sheet.bound("overlaps invented", counts.invented, 0);
    sheet.bound("overlapping bounds missed", counts.bounds_missed, 0);
    sheet.bound("overlapping bounds beyond those 1 cm larger", counts.bounds_excess, 0);
    sheet.bound("bounds of 1000 turned boxes too small", count_short_bounds(setup), 0);
}

}  // namespace cairn::physics
