// Pairs, axes and points from a world's bodies; see detect.h.

#include "world/detect.h"

#include <algorithm>
#include <functional>

#include "contact/build_manifold.h"
#include "contact/reuse.h"
#include "narrow/axis_box_box.h"
#include "narrow/find_axis.h"
#include "shape/bounds.h"
#include "world/shape_pose.h"
#include "world/sleep.h"

namespace cairn {

namespace {

// A contact is kept while its surfaces are this near, as a share of the smaller shape, so that one
// which trembles keeps its impulses.
constexpr float skin_share = 0.01f;
// Room in a fat box, as a share of the shape: more of it makes more pairs, less more updates.
constexpr float fat_share = 0.1f;

// Whether what touches does not turn with the shape: a radius about a core.
bool is_round(const Geometry& geometry) {
    return std::holds_alternative<Sphere>(geometry) || std::holds_alternative<Capsule>(geometry);
}
bool is_ball(const Geometry& geometry) { return std::holds_alternative<Sphere>(geometry); }
bool is_plane(const Geometry& geometry) { return std::holds_alternative<Plane>(geometry); }

// How far a shape's points may travel in dt seconds, beyond the smooth path of its center of mass.
float turning_reach(const WorldState& world, const ShapeRecord& shape, float dt) {
    const Vec3 spin = travel_of(world, shape.body).angular_velocity;
    if (spin == Vec3{}) return 0;
    // Turning by an angle moves no point by more than twice its arm.
    return min(dt * length(spin), 2.0f) * shape.reach;
}

float fall_in(const WorldState& world, float dt) {
    return length(world.settings.gravity) * dt * dt;
}

// An arm that ends at a point of the shape, along its own axes from its origin.
Arm make_arm(const ShapeSeat& seat, Vec3 point) {
    return {seat.offset + (seat.is_turned ? rotate(seat.local_pose.rotation, point) : point), {}};
}
// To a point of a round shape, along world axes from its origin: the core turns with the body, the
// touching point stays below it.
Arm make_round_arm(const ShapeSeat& seat, const Geometry& geometry, const Mat3& axes, Vec3 point) {
    const Capsule* capsule = std::get_if<Capsule>(&geometry);
    if (!capsule) return {seat.offset, point};
    const float half = 0.5f * capsule->height;
    const float place = clamp(dot(axes.y, point), -half, half);
    return {make_arm(seat, {0, place, 0}).core, point - place * axes.y};
}

BodyPlace place_of(const WorldState& world, std::uint32_t body) {
    return {world.positions[body], world.rotations[body]};
}

float pair_size(const ShapeRecord& a, const ShapeRecord& b) { return min(a.size, b.size); }

// How far two bodies' points may have come towards each other when this step is over, beyond what
// they had when it was least: the ways that both have gone, and what is before them.
double gone_together(const WorldState& world, const PairRecord& pair) {
    return way_of(world, world.shapes[pair.shape_a].body).gone +
           way_of(world, world.shapes[pair.shape_b].body).gone;
}
double horizon_together(const WorldState& world, const PairRecord& pair) {
    return way_of(world, world.shapes[pair.shape_a].body).horizon +
           way_of(world, world.shapes[pair.shape_b].body).horizon;
}

bool may_touch(const WorldState& world, const Pair& pair) {
    const std::uint32_t a = world.shapes[pair.a].body;
    const std::uint32_t b = world.shapes[pair.b].body;
    // Kinematic bodies have nothing to say to what cannot move either.
    const bool can_push =
        inertia_of(world, a).inverse_mass > 0 || inertia_of(world, b).inverse_mass > 0;
    return a != b && can_push && agree(world.bodies[a].filter, world.bodies[b].filter);
}

// How far apart two shapes may be and still touch within dt seconds: by the velocities of their
// bodies, along whichever normal, by their spins, and by gravity; never less than a small share of
// their size.
Reach find_reach(const WorldState& world, const ShapeRecord& a, const ShapeRecord& b,
                 Quat rotation_a, double dt) {
    const auto h = float(dt);
    const Vec3 v =
        travel_of(world, b.body).linear_velocity - travel_of(world, a.body).linear_velocity;
    return {skin_share * pair_size(a, b) + fall_in(world, h) + turning_reach(world, a, h) +
                turning_reach(world, b, h),
            rotate_inverse(rotation_a, h * v)};
}

// The axis, or as much of it as shows that two boxes are out of reach.
Axis find_axis_within(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase method,
                      const Reach& reach, AxisHint& hint) {
    const Box* box_a = std::get_if<Box>(&a);
    const Box* box_b = std::get_if<Box>(&b);
    if (!box_a || !box_b) return find_axis(a, b, b_in_a, method, hint);
    Axis axis;
    (void)find_axis_box_box(make_box_pair(*box_a, *box_b, b_in_a), method, reach, hint, axis);
    return axis;
}

// A box that holds the shape throughout the next dt seconds, if it moves.
Aabb find_box(const WorldState& world, const ShapeRecord& shape, bool moves, float h) {
    const Quat rotation = shape_rotation(world, shape);
    const Position center = shape_position(world, shape);
    Vec3 half = bounds_half_extents(shape.geometry, to_matrix(rotation));
    if (!is_plane(shape.geometry)) {
        float margin = skin_share * shape.size;
        if (moves) {
            const float speed = length(travel_of(world, shape.body).linear_velocity);
            margin += h * speed + turning_reach(world, shape, h) + fall_in(world, h);
        }
        half = half + Vec3{margin, margin, margin};
    }
    return box_around(center, half);
}

// Whether anything short of a change by the user can move the body.
bool can_move(const WorldState& world, std::uint32_t body) {
    return world.bodies[body].kind != BodyKind::Static && !world.bodies[body].frozen;
}

// Shapes, bodies and pairs are shared out in blocks of so many: some microseconds' work.
constexpr int shapes_a_block = 64;
constexpr int bodies_a_block = 128;
constexpr int searches_a_block = 16;
constexpr std::size_t pairs_a_block = 256;

// The box with room for some steps more.
Aabb fatten(const WorldState& world, const ShapeRecord& shape, const Aabb& box, bool moves,
            float h) {
    if (!moves) return box;
    const float speed = length(travel_of(world, shape.body).linear_velocity);
    const float room = fat_share * shape.size + h * speed;
    const Vec3 margin = {room, room, room};
    return {box.lower - margin, box.upper + margin};
}

// Brings the tree to a shape's new box.
void update_tree(WorldState& world, std::uint32_t slot, float h) {
    const ShapeRecord& shape = world.shapes[slot];
    const Aabb& box = world.boxes[slot];
    const bool moves = can_move(world, shape.body);
    if (!world.tree.is_there(slot)) {
        world.scratch.new_proxies.push_back({fatten(world, shape, box, moves, h), slot, moves});
        return;
    }
    world.tree.set_moves(slot, moves);
    world.tree.update(slot, box, fatten(world, shape, box, moves, h));
}

// Renews the boxes of all bodies that move, and of those that are stale, whose pairs are then
// looked up whatever their boxes are; likewise in the tree, where there is one.
void update_boxes(WorldState& world, Team& team, float h) {
    auto& stale = world.rest.stale;
    std::sort(stale.begin(), stale.end());
    stale.erase(std::unique(stale.begin(), stale.end()), stale.end());
    auto& updated = world.scratch.updated;
    updated.clear();
    const auto add = [&](std::uint32_t body) {
        visit_shapes(world, body, [&](std::uint32_t slot) { updated.push_back(slot); });
    };
    updated.reserve(world.rest.movers.size() + stale.size());
    for (const std::uint32_t body : world.rest.movers) add(body);
    for (const std::uint32_t body : stale) {
        if (!moves(world, body)) add(body);
    }
    world.boxes.reserve(world.shapes.capacity());
    world.boxes.resize(world.shapes.size());
    auto& escaped = world.scratch.escaped;
    escaped.resize(updated.size());
    team.for_range(int(updated.size()), shapes_a_block, [&](int begin, int end, int) {
        for (auto i = std::size_t(begin); i < std::size_t(end); ++i) {
            const std::uint32_t slot = updated[i];
            const ShapeRecord& shape = world.shapes[slot];
            world.boxes[slot] = find_box(world, shape, moves(world, shape.body), h);
            escaped[i] = !world.tree.holds(slot, world.boxes[slot], can_move(world, shape.body));
        }
    });
    if (world.settings.step.broad_phase == BroadPhase::Tree) {
        world.scratch.new_proxies.clear();
        world.scratch.new_proxies.reserve(
            updated.size() - std::size_t(std::count(escaped.begin(), escaped.end(), false)));
        for (std::size_t i = 0; i < updated.size(); ++i) {
            if (escaped[i] != 0) update_tree(world, updated[i], h);
        }
        world.tree.insert_many(world.scratch.new_proxies);
        // As long as the lists of boxes were, they are long again only where most move.
        if (world.scratch.new_proxies.size() > world.rest.movers.size()) {
            forget(updated);
            forget(escaped);
        }
        forget(world.scratch.new_proxies);
        for (const std::uint32_t body : stale)
            visit_shapes(world, body, [&](std::uint32_t slot) { world.tree.look_up(slot); });
    }
    forget(world.unplaced);
    forget(stale);
}

bool is_idle(const WorldState& world, const Pair& pair) {
    return !is_looked_at(world, world.shapes[pair.a].body) &&
           !is_looked_at(world, world.shapes[pair.b].body);
}

void find_new_pairs(WorldState& world, Team& team) {
    WorldState::Scratch& scratch = world.scratch;
    auto& parts = scratch.found_parts;
    parts.resize(std::size_t(team.worker_count()));
    for (LargeArray<Pair>& part : parts) part.clear();
    const std::size_t count = world.tree.prepare_search();
    team.for_range(int(count), searches_a_block, [&](int begin, int end, int worker) {
        world.tree.search(std::size_t(begin), std::size_t(end), parts[std::size_t(worker)]);
    });
    // Sorted at the end, so that it does not matter who found what.
    scratch.found_pairs.clear();
    for (const LargeArray<Pair>& part : parts)
        scratch.found_pairs.insert(scratch.found_pairs.end(), part.begin(), part.end());
    world.tree.finish_search(scratch.found_pairs);
}

// Leaves those of the pairs that keep(pair) is true for, in their order.
template <class Keep>
void keep_pairs(Team& team, LargeArray<Pair>& pairs, LargeArray<std::uint32_t>& kept_counts,
                const Keep& keep) {
    const std::size_t block_count = (pairs.size() + pairs_a_block - 1) / pairs_a_block;
    kept_counts.resize(block_count);
    team.for_range(int(block_count), 1, [&](int begin, int end, int) {
        for (auto block = std::size_t(begin); block < std::size_t(end); ++block) {
            const auto first = pairs.begin() + std::ptrdiff_t(block * pairs_a_block);
            const auto last =
                block + 1 < block_count ? first + std::ptrdiff_t(pairs_a_block) : pairs.end();
            kept_counts[block] =
                std::uint32_t(std::remove_if(first, last, std::not_fn(keep)) - first);
        }
    });
    // Moves the blocks' rests together.
    auto to = pairs.begin();
    for (std::size_t block = 0; block < block_count; ++block) {
        const auto from = pairs.begin() + std::ptrdiff_t(block * pairs_a_block);
        const auto count = std::ptrdiff_t(kept_counts[block]);
        to = to == from ? to + count : std::copy(from, from + count, to);
    }
    pairs.erase(to, pairs.end());
}

void find_tree_pairs(WorldState& world, Team& team, LargeArray<Pair>& pairs) {
    WorldState::Scratch& scratch = world.scratch;
    find_new_pairs(world, team);
    auto& found = scratch.found_pairs;
    std::erase_if(found, [&](const Pair& pair) { return is_idle(world, pair); });
    const bool any_idle = world.rest.any_idle;
    world.rest.any_idle = false;
    keep_pairs(team, world.fat_pairs, scratch.kept_counts, [&](const Pair& pair) {
        return world.tree.make_pair(pair.a, pair.b) && !(any_idle && is_idle(world, pair));
    });
    // A pair is told again when one of its two has left its box.
    if (!found.empty()) {
        scratch.merged_pairs.resize(world.fat_pairs.size() + found.size());
        const auto end = std::set_union(world.fat_pairs.begin(), world.fat_pairs.end(),
                                        found.begin(), found.end(), scratch.merged_pairs.begin());
        scratch.merged_pairs.erase(end, scratch.merged_pairs.end());
        world.fat_pairs.swap(scratch.merged_pairs);
    }
    pairs.assign(world.fat_pairs.begin(), world.fat_pairs.end());
    keep_pairs(team, pairs, scratch.kept_counts, [&](const Pair& pair) {
        return overlaps(world.boxes[pair.a], world.boxes[pair.b]) && may_touch(world, pair);
    });
}

}  // namespace

void find_step_pairs(WorldState& world, Team& team, double dt, LargeArray<Pair>& pairs) {
    update_boxes(world, team, float(dt));
    if (world.settings.step.broad_phase == BroadPhase::Tree)
        return find_tree_pairs(world, team, pairs);
    auto& proxies = world.scratch.proxies;
    proxies.clear();
    for (std::uint32_t slot = 0; slot < world.shapes.size(); ++slot) {
        const ShapeRecord& shape = world.shapes[slot];
        if (shape.is_alive())
            proxies.push_back({world.boxes[slot], slot, is_looked_at(world, shape.body)});
    }
    world.scratch.broad.find_pairs(proxies, pairs);
    std::erase_if(pairs, [&](const Pair& pair) { return !may_touch(world, pair); });
}

void find_present_pairs(const WorldState& world, double dt, LargeArray<Pair>& pairs) {
    std::vector<Proxy> proxies;
    for (std::uint32_t slot = 0; slot < world.shapes.size(); ++slot) {
        const ShapeRecord& shape = world.shapes[slot];
        if (!shape.is_alive()) continue;
        const bool moves = can_move(world, shape.body);
        proxies.push_back({find_box(world, shape, moves, float(dt)), slot, moves});
    }
    BruteForce broad;
    broad.find_pairs(proxies, pairs);
    std::erase_if(pairs, [&](const Pair& pair) { return !may_touch(world, pair); });
}

void keep_in_tree(WorldState& world, std::uint32_t body) {
    const bool moves = can_move(world, body);
    visit_shapes(world, body, [&](std::uint32_t slot) {
        if (!world.tree.is_there(slot)) return;
        const ShapeRecord& shape = world.shapes[slot];
        const Aabb box = find_box(world, shape, false, 0);
        const auto h = float(world.last_dt);
        world.tree.update(slot, box, fatten(world, shape, box, moves, h));
    });
}

void complete_tree(WorldState& world) {
    const auto h = float(world.last_dt);
    LargeArray<Proxy> proxies;
    for (const ShapeId id : world.unplaced) {
        const ShapeRecord& shape = world.shapes[id.index];
        if (shape.generation != id.generation || world.tree.is_there(id.index)) continue;
        const bool moves_now = moves(world, shape.body), may_move = can_move(world, shape.body);
        const Aabb box = find_box(world, shape, moves_now, h);
        proxies.push_back({fatten(world, shape, box, may_move, h), id.index, may_move});
    }
    world.tree.insert_many(proxies);
    world.unplaced.clear();
}

Aabb find_present_box(const WorldState& world, const ShapeRecord& shape) {
    return box_around(shape_position(world, shape),
                      bounds_half_extents(shape.geometry, to_matrix(shape_rotation(world, shape))));
}

bool add_to_way(WorldState& world, std::uint32_t body, const BodyMotion& before) {
    BodyWay& way = world.ways[world.bodies[body].mobile];
    const BodyMotion motion = motion_of(world, body);
    const float shift = length(motion.displacement);
    way.gone += double(shift);
    if (motion.rotation != before.rotation) {
        // A turn moves a point by the chord over its arm.
        const float turn = length(half_turn(motion.rotation, before.rotation));
        way.gone += 2.0 * double(turn) * double(way.reach);
    }
    // A shape near the center of mass has the shift before it and little of the turn.
    const auto h = float(world.last_dt);
    const float foreseen = h * length(before.linear_velocity) + fall_in(world, h);
    return way.gone <= way.horizon && shift <= foreseen;
}

void look_ahead(WorldState& world, Team& team, double dt) {
    const auto h = float(dt);
    const float fall = fall_in(world, h);
    const auto& moving = world.scratch.moving;
    team.for_range(int(moving.size()), bodies_a_block, [&](int begin, int end, int) {
        for (auto i = std::size_t(begin); i < std::size_t(end); ++i) {
            BodyWay& way = world.ways[world.bodies[moving[i]].mobile];
            const BodyTravel& travel = travel_of(world, moving[i]);
            way.horizon = way.gone + double(h * length(travel.linear_velocity) + fall);
            if (travel.angular_velocity != Vec3{})
                way.horizon += double(min(h * length(travel.angular_velocity), 2.0f) * way.reach);
        }
    });
}

bool is_apart(const WorldState& world, const PairRecord& pair) {
    return horizon_together(world, pair) < pair.apart_until;
}

void remember_apart(const WorldState& world, PairRecord& pair, float separation) {
    const float skin =
        skin_share * pair_size(world.shapes[pair.shape_a], world.shapes[pair.shape_b]);
    // The sum of the ways is rounded.
    constexpr double rounding = 1e-12;
    const double gone = gone_together(world, pair);
    pair.apart_until = gone + double(separation - skin) - rounding * gone;
}

void describe_contact(const WorldState& world, Contact& contact) {
    const ShapeRecord& a = world.shapes[contact.shape_a];
    const ShapeRecord& b = world.shapes[contact.shape_b];
    const Material& material_a = material_of(world, a);
    const Material& material_b = material_of(world, b);
    contact.body_a = a.body;
    contact.body_b = b.body;
    contact.friction = square_root(material_a.friction * material_b.friction);
    contact.restitution = max(material_a.restitution, material_b.restitution);
    contact.rolling_friction = max(material_a.rolling_friction, material_b.rolling_friction);
    contact.spinning_friction = max(material_a.spinning_friction, material_b.spinning_friction);
    contact.conveys =
        material_a.surface_velocity != Vec3{} || material_b.surface_velocity != Vec3{};
    contact.surface_velocity = {};
    turn_surface_velocity(world, contact);
    contact.size = pair_size(a, b);
    const bool round_a = is_round(a.geometry);
    const bool round_b = is_round(b.geometry);
    contact.stays_with_a = round_a != round_b ? round_a : a.size < b.size;
}

void turn_surface_velocity(const WorldState& world, Contact& contact) {
    if (!contact.conveys) return;
    const Vec3 on_a = material_of(world, world.shapes[contact.shape_a]).surface_velocity;
    const Vec3 on_b = material_of(world, world.shapes[contact.shape_b]).surface_velocity;
    contact.surface_velocity = rotate(world.rotations[contact.body_b], on_b) -
                               rotate(world.rotations[contact.body_a], on_a);
}

bool find_meeting(const WorldState& world, std::uint32_t shape_a, std::uint32_t shape_b, double dt,
                  bool exactly, AxisHint& hint, Meeting& meeting) {
    const ShapeRecord& a = world.shapes[shape_a];
    const ShapeRecord& b = world.shapes[shape_b];
    const Vec3 between = (world.positions[b.body] - world.positions[a.body]) +
                         (shape_offset(world, b) - shape_offset(world, a));
    // A ball's axes are the world's.
    const Quat rotation_b = is_ball(b.geometry) ? Quat{} : shape_rotation(world, b);
    meeting.rotation_a = is_ball(a.geometry) ? Quat{} : shape_rotation(world, a);
    meeting.b_in_a = {rotate_inverse(meeting.rotation_a, between),
                      conjugate(meeting.rotation_a) * rotation_b};
    if (!is_finite(meeting.b_in_a.position)) return false;
    const Reach reach = find_reach(world, a, b, meeting.rotation_a, dt);
    meeting.axis =
        find_axis_within(a.geometry, b.geometry, meeting.b_in_a, world.settings.step.narrow_phase,
                         exactly ? everywhere : reach, hint);
    meeting.hint = hint;
    if (!is_finite(meeting.axis.normal) || !is_finite(meeting.axis.separation)) return false;
    meeting.within = reach.along(meeting.axis.normal);
    return true;
}

void build_contact_points(const WorldState& world, const Meeting& meeting, float max_separation,
                          Contact& contact) {
    const ShapeRecord& a = world.shapes[contact.shape_a];
    const ShapeRecord& b = world.shapes[contact.shape_b];
    const bool round_a = is_round(a.geometry), round_b = is_round(b.geometry);
    const ShapeSeat seat_a = seat_of(world, a), seat_b = seat_of(world, b);
    const Manifold manifold =
        build_manifold(a.geometry, b.geometry, meeting.b_in_a, meeting.axis, max_separation);
    // B's arm goes by way of the world, so that both end at the same place there to the last digit:
    // what a turn between the two frames rounds away moves a house of cards.
    const Mat3 axes_a = to_matrix(meeting.rotation_a);
    const Mat3 axes_b = is_ball(b.geometry) ? Mat3{} : to_matrix(shape_rotation(world, b));
    contact.normal = normalize_or(axes_a * manifold.normal, {0, 1, 0});
    contact.point_count = 0;
    for (int i = 0; i < manifold.point_count; ++i) {
        const ManifoldPoint& from = manifold.points[std::size_t(i)];
        if (!is_finite(from.separation) || !is_finite(from.from_a) || !is_finite(from.from_b))
            continue;
        ContactPoint& point = contact.points[std::size_t(contact.point_count++)];
        point = {};
        const Vec3 from_b = axes_a * from.from_b;
        point.arm_a = round_a ? make_round_arm(seat_a, a.geometry, axes_a, axes_a * from.from_a)
                              : make_arm(seat_a, from.from_a);
        point.arm_b = round_b ? make_round_arm(seat_b, b.geometry, axes_b, from_b)
                              : make_arm(seat_b, multiply_transposed(axes_b, from_b));
        point.separation = from.separation;
        point.feature = from.feature;
    }
    // A ball's arms do not turn with it, a capsule's end does.
    const float short_arm = 1e-3f * contact.size;
    const auto turns = [&](Vec3 core) { return length_squared(core) > short_arm * short_arm; };
    const bool any = contact.point_count > 0;
    contact.turns_with_a = any && turns(contact.points[0].arm_a.core);
    contact.turns_with_b = any && turns(contact.points[0].arm_b.core);
}

bool follow_contact(WorldState& world, const PairRecord& pair) {
    if (!pair.shows_face) return false;
    const FaceSighting& seen = world.contacts.sighting(pair.contact);
    Contact& contact = world.contacts[pair.contact];
    // What touches for the first time is measured, and so is what points left out may come to.
    if (!contact.touching || contact.point_count == 0) return false;
    if (contact.point_count < 4) {
        const double ahead = horizon_together(world, pair) - gone_together(world, pair);
        if (ahead + double(skin_share * contact.size) > double(seen.within)) return false;
    }
    return follow_face(contact, seen, place_of(world, contact.body_a),
                       place_of(world, contact.body_b));
}

void remember_contact(WorldState& world, PairRecord& pair, const Meeting& meeting) {
    pair.shows_face = false;
    const Contact& contact = world.contacts[pair.contact];
    const Geometry& a = world.shapes[pair.shape_a].geometry;
    const Geometry& b = world.shapes[pair.shape_b].geometry;
    // A round shape's answer is had for less than it takes to follow it.
    if (is_round(a) || is_round(b)) return;
    const auto kind = BoxAxisKind(meeting.hint.kind);
    const bool of_a = is_plane(a) || (meeting.axis.on_hint && kind == BoxAxisKind::FaceA);
    const bool of_b = is_plane(b) || (meeting.axis.on_hint && kind == BoxAxisKind::FaceB);
    if (!of_a && !of_b) return;
    pair.shows_face = true;
    remember_face(contact, place_of(world, contact.body_a), place_of(world, contact.body_b),
                  of_a ? FaceSighting::Owner::A : FaceSighting::Owner::B, meeting.within,
                  world.contacts.sighting(pair.contact));
}

}  // namespace cairn
