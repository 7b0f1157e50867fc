// What a world answers between steps: rays, what is in a place, the nearest surface.
//
// Reads the world and writes nothing of it, so that any number of threads may ask. A question goes
// to the shapes whose boxes in the tree it reaches, and to those that are not in the tree yet;
// where the broad phase is brute force, to all. The tree's boxes hold every shape as it stands
// (keep_in_tree), and equally near shapes are told apart by their ids, so that the answer does not
// depend on who was asked first.

#include <algorithm>

#include "base/float_environment.h"
#include "narrow/find_axis.h"
#include "shape/bounds.h"
#include "shape/ray.h"
#include "world/calls.h"
#include "world/detect.h"
#include "world/shape_pose.h"
#include "world/validate.h"
#include "world/world_state.h"

namespace cairn {

namespace {

// Below every distance: ends a search.
constexpr float no_more = -1;

// The ray with a unit direction in binary64.
struct WorldRay {
    Position origin;
    Vec3d direction;
    double length = 0;
};

Refusal check_reach(const Path& name, double reach) {
    if (reach >= largest_quantity) return {};
    return check_at_least(name, reach, 0);
}

Refusal check_ray(const Ray& ray) {
    if (Refusal r = check_position("ray.origin", ray.origin)) return r;
    if (Refusal r = check_finite("ray.direction", ray.direction)) return r;
    if (ray.direction == Vec3{}) {
        return Error{ErrorCode::OutOfRange,
                     "ray.direction: a vector of length 0; allowed: any other"};
    }
    return check_reach("ray.length", ray.length);
}

WorldRay make_world_ray(const Ray& ray) {
    const Vec3d direction = widen(ray.direction);
    return {ray.origin, (1 / length(direction)) * direction, ray.length};
}

bool is_seen(const WorldState& world, const ShapeRecord& shape, const QueryFilter& filter) {
    const BodyRecord& body = world.bodies[shape.body];
    if (filter.collision && !agree(*filter.collision, body.filter)) return false;
    return filter.except != BodyId{shape.body, body.generation};
}

bool is_accepted(const WorldState& world, std::uint32_t slot, const QueryFilter& filter) {
    return !filter.accepts ||
           filter.accepts(body_id(world, world.shapes[slot].body), shape_id(world, slot));
}

// visit(slot) for every shape that the tree does not have.
template <class Visit>
void visit_unplaced(const WorldState& world, Visit&& visit) {
    if (world.settings.step.broad_phase != BroadPhase::Tree) {
        for (std::uint32_t slot = 0; slot < world.shapes.size(); ++slot) {
            if (world.shapes[slot].is_alive()) visit(slot);
        }
        return;
    }
    for (const ShapeId id : world.unplaced) {
        if (names(world, id) && !world.tree.is_there(id.index)) visit(id.index);
    }
}

// visit(slot) for every shape that the probe may reach.
template <class Probe, class Visit>
void visit_reached(const WorldState& world, Probe& probe, Visit&& visit) {
    visit_unplaced(world, visit);
    world.tree.visit_reached(probe, visit);
}

// The same for every shape whose box may overlap.
template <class Visit>
void visit_near(const WorldState& world, const Aabb& box, Visit&& visit) {
    visit_unplaced(world, visit);
    world.tree.query(box, visit);
}

bool cast_at_shape(const WorldState& world, const WorldRay& ray, std::uint32_t slot, RayHit& hit) {
    const ShapeRecord& shape = world.shapes[slot];
    const Vec3d from = difference(ray.origin, shape_position(world, shape));
    ShapeHit found;
    if (std::holds_alternative<Sphere>(shape.geometry)) {
        if (!cast_ray(shape.geometry, {from, ray.direction, ray.length}, found)) return false;
        hit.normal = narrow(found.normal);
    } else {
        const Mat3d axes = to_exact_matrix(shape_rotation(world, shape));
        const ShapeRay local = {multiply_transposed(axes, from),
                                multiply_transposed(axes, ray.direction), ray.length};
        if (!cast_ray(shape.geometry, local, found)) return false;
        hit.normal = narrow(axes * found.normal);
    }
    hit.body = body_id(world, shape.body);
    hit.shape = shape_id(world, slot);
    hit.distance = found.distance;
    hit.inside = found.inside;
    hit.point = ray.origin + found.distance * ray.direction;
    return true;
}

bool comes_before(const RayHit& a, const RayHit& b) {
    return a.distance < b.distance || (a.distance == b.distance && a.shape < b.shape);
}

// take(hit, ray, probe) for what the ray meets; it may shorten both.
template <class Take>
void visit_met(const WorldState& world, const Ray& given, const QueryFilter& filter, Take&& take) {
    WorldRay ray = make_world_ray(given);
    RayProbe probe(ray.origin, narrow(ray.direction), ray.length);
    visit_reached(world, probe, [&](std::uint32_t slot) {
        RayHit hit;
        if (probe.limit < 0 || !is_seen(world, world.shapes[slot], filter)) return;
        if (!cast_at_shape(world, ray, slot, hit)) return;
        if (hit.inside && filter.skip_inside) return;
        if (is_accepted(world, slot, filter)) take(hit, ray, probe);
    });
}

void shorten(WorldRay& ray, RayProbe& probe, double length) {
    ray.length = std::min(ray.length, length);
    probe.limit = length < 0 ? no_more : round_up(ray.length);
}

NearestHit find_nearest_of_shape(const WorldState& world, const Position& point,
                                 std::uint32_t slot) {
    const ShapeRecord& shape = world.shapes[slot];
    const Mat3d axes = to_exact_matrix(shape_rotation(world, shape));
    const Vec3d from = difference(point, shape_position(world, shape));
    const NearestPoint nearest =
        find_nearest_point(shape.geometry, multiply_transposed(axes, from));
    const Vec3d normal = axes * nearest.normal;
    return {.body = body_id(world, shape.body),
            .shape = shape_id(world, slot),
            .point = point + -nearest.distance * normal,
            .normal = narrow(normal),
            .distance = nearest.distance};
}

// Whether two shapes touch or overlap. What is larger comes first: find_axis keeps more digits so.
bool do_touch(const WorldState& world, const Geometry& geometry, const Position& position,
              Quat rotation, std::uint32_t slot) {
    const ShapeRecord& shape = world.shapes[slot];
    const Quat shape_turn = shape_rotation(world, shape);
    const Vec3 between = shape_position(world, shape) - position;
    const bool shape_first = shape.size > smallest_half_extent(geometry);
    const Quat first = shape_first ? shape_turn : rotation;
    const Quat second = shape_first ? rotation : shape_turn;
    const Pose second_in_first = {rotate_inverse(first, shape_first ? -between : between),
                                  conjugate(first) * second};
    AxisHint hint;
    const Axis axis =
        find_axis(shape_first ? shape.geometry : geometry, shape_first ? geometry : shape.geometry,
                  second_in_first, world.settings.step.narrow_phase, hint);
    return axis.separation <= 0;
}

}  // namespace

RayHit World::cast_ray(const Ray& ray, const QueryFilter& filter) const {
    const FloatEnvironment ieee;
    RayHit nearest;
    if (const Refusal r = check_ray(ray)) {
        tell(*state_, "cast_ray", *r);
        return nearest;
    }
    visit_met(*state_, ray, filter, [&](const RayHit& hit, WorldRay& left, RayProbe& probe) {
        if (nearest && !comes_before(hit, nearest)) return;
        nearest = hit;
        shorten(left, probe, hit.distance);
    });
    return nearest;
}

bool World::any_hit(const Ray& ray, const QueryFilter& filter) const {
    const FloatEnvironment ieee;
    bool any = false;
    if (const Refusal r = check_ray(ray)) {
        tell(*state_, "any_hit", *r);
        return any;
    }
    visit_met(*state_, ray, filter, [&](const RayHit&, WorldRay& left, RayProbe& probe) {
        any = true;
        shorten(left, probe, -1);
    });
    return any;
}

std::vector<RayHit> World::all_hits(const Ray& ray, const QueryFilter& filter) const {
    const FloatEnvironment ieee;
    std::vector<RayHit> hits;
    if (const Refusal r = check_ray(ray)) {
        tell(*state_, "all_hits", *r);
        return hits;
    }
    visit_met(*state_, ray, filter,
              [&](const RayHit& hit, WorldRay&, RayProbe&) { hits.push_back(hit); });
    std::sort(hits.begin(), hits.end(), comes_before);
    return hits;
}

void World::visit_hits(const Ray& ray, const std::function<double(const RayHit&)>& visit,
                       const QueryFilter& filter) const {
    const FloatEnvironment ieee;
    if (const Refusal r = check_ray(ray)) {
        tell(*state_, "visit_hits", *r);
        return;
    }
    visit_met(*state_, ray, filter, [&](const RayHit& hit, WorldRay& left, RayProbe& probe) {
        const double length = visit(hit);
        // NaN is no length: it ends the search like one below 0.
        shorten(left, probe, length >= 0 ? length : -1);
    });
}

std::vector<BodyId> World::bodies_in(const Bounds& box, const QueryFilter& filter) const {
    const FloatEnvironment ieee;
    const WorldState& world = *state_;
    std::vector<BodyId> bodies;
    Refusal refusal = check_position("box.lower", box.lower);
    if (!refusal) refusal = check_position("box.upper", box.upper);
    const bool is_ordered =
        box.lower.x <= box.upper.x && box.lower.y <= box.upper.y && box.lower.z <= box.upper.z;
    if (!refusal && !is_ordered) {
        refusal = Error{ErrorCode::OutOfRange,
                        "box.upper: a coordinate below that of lower; allowed: none"};
    }
    if (refusal) {
        tell(world, "bodies_in", *refusal);
        return bodies;
    }
    const Aabb sought = {box_around(box.lower, {}).lower, box_around(box.upper, {}).upper};
    visit_near(world, sought, [&](std::uint32_t slot) {
        const ShapeRecord& shape = world.shapes[slot];
        if (!is_seen(world, shape, filter)) return;
        if (!overlaps(find_present_box(world, shape), sought)) return;
        if (is_accepted(world, slot, filter)) bodies.push_back(body_id(world, shape.body));
    });
    std::sort(bodies.begin(), bodies.end());
    bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
    return bodies;
}

std::vector<ShapeId> World::overlapping(const Geometry& geometry, const Position& position,
                                        const Quat& given_rotation,
                                        const QueryFilter& filter) const {
    const FloatEnvironment ieee;
    const WorldState& world = *state_;
    std::vector<ShapeId> shapes;
    // As a shape of a body that moves: no half-space.
    Refusal refusal = check_shape("shape", {.geometry = geometry}, BodyKind::Dynamic);
    if (!refusal) refusal = check_position("position", position);
    if (!refusal) refusal = check_rotation("rotation", given_rotation);
    if (refusal) {
        tell(world, "overlapping", *refusal);
        return shapes;
    }
    const Quat rotation = normalize(given_rotation);
    const Aabb box = box_around(position, bounds_half_extents(geometry, to_matrix(rotation)));
    visit_near(world, box, [&](std::uint32_t slot) {
        if (!is_seen(world, world.shapes[slot], filter)) return;
        if (!do_touch(world, geometry, position, rotation, slot)) return;
        if (is_accepted(world, slot, filter)) shapes.push_back(shape_id(world, slot));
    });
    std::sort(shapes.begin(), shapes.end());
    return shapes;
}

NearestHit World::closest_point(const Position& point, double reach,
                                const QueryFilter& filter) const {
    const FloatEnvironment ieee;
    const WorldState& world = *state_;
    NearestHit nearest;
    Refusal refusal = check_position("point", point);
    if (!refusal) refusal = check_reach("reach", reach);
    if (refusal) {
        tell(world, "closest_point", *refusal);
        return nearest;
    }
    PointProbe probe(point, reach);
    visit_reached(world, probe, [&](std::uint32_t slot) {
        if (!is_seen(world, world.shapes[slot], filter)) return;
        const NearestHit hit = find_nearest_of_shape(world, point, slot);
        if (!(hit.distance <= reach)) return;
        const bool is_nearer = !nearest || hit.distance < nearest.distance ||
                               (hit.distance == nearest.distance && hit.shape < nearest.shape);
        if (!is_nearer || !is_accepted(world, slot, filter)) return;
        nearest = hit;
        // Inside one shape, another may hold the point deeper still.
        probe.limit = round_up(std::max(hit.distance, 0.0));
    });
    return nearest;
}

void World::prepare_questions() {
    const FloatEnvironment ieee;
    if (state_->settings.step.broad_phase == BroadPhase::Tree) complete_tree(*state_);
}

}  // namespace cairn
