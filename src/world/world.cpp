// The public face of the world: checks what it is given, then changes or reads the state.

#include "cairn/world.h"

#include "base/float_environment.h"
#include "shape/bounds.h"
#include "shape/mass.h"
#include "world/calls.h"
#include "world/detect.h"
#include "world/sleep.h"
#include "world/step.h"
#include "world/validate.h"
#include "world/world_state.h"

namespace cairn {

namespace {

bool can_move(const WorldState& world, std::uint32_t slot) {
    return world.bodies[slot].kind == BodyKind::Dynamic && !world.bodies[slot].frozen;
}

// Mass properties from what the user gave and the shapes weigh; an error where a dynamic body gets
// none.
Result<MassProperties> resolve_mass(const MobileRecord& body, BodyKind kind,
                                    std::span<const ShapeDef> shapes) {
    if (body.has_given_properties) return body.mass_properties;
    MassProperties properties = combined_mass_properties(shapes);
    if (body.given_mass > 0 && properties.mass > 0) {
        const double scale = double(body.given_mass) / double(properties.mass);
        SymmetricMat3& i = properties.inertia;
        for (float* entry : {&i.xx, &i.yy, &i.zz, &i.xy, &i.xz, &i.yz})
            *entry = float(scale * double(*entry));
        properties.mass = body.given_mass;
    }
    if (kind != BodyKind::Dynamic) return properties;
    if (shapes.empty()) {
        return Error{ErrorCode::OutOfRange,
                     "shapes: none, and no mass_properties; allowed: at least one of the two on a "
                     "dynamic body"};
    }
    if (const Refusal r = check_mass_properties("the shapes' mass properties", properties))
        return *r;
    return properties;
}

const MobileRecord& mobile_record(const WorldState& world, std::uint32_t body) {
    return world.mobiles[world.bodies[body].mobile];
}

std::vector<ShapeDef> shape_defs(const WorldState& world, std::uint32_t body) {
    std::vector<ShapeDef> defs;
    visit_shapes(world, body, [&](std::uint32_t slot) { defs.push_back(shape_def(world, slot)); });
    return defs;
}

std::uint32_t take_slot(LargeArray<std::uint32_t>& free, std::size_t size) {
    if (free.empty()) return std::uint32_t(size);
    const std::uint32_t slot = free.back();
    free.pop_back();
    return slot;
}

void leave_seat(WorldState& world, ShapeRecord& shape) {
    if (shape.seat == nothing) return;
    world.free_seats.push_back(shape.seat);
    shape.seat = nothing;
}

// Where the shape is on its body.
void seat_shape(WorldState& world, ShapeRecord& shape, const Pose& local_pose,
                Vec3 center_of_mass) {
    if (local_pose == Pose{} && center_of_mass == Vec3{}) return leave_seat(world, shape);
    if (shape.seat == nothing) {
        shape.seat = take_slot(world.free_seats, world.seats.size());
        if (shape.seat == world.seats.size()) world.seats.emplace_back();
    }
    world.seats[shape.seat] = {.local_pose = local_pose,
                               .offset = local_pose.position - center_of_mass,
                               .is_turned = local_pose.rotation != Quat{}};
}

// Gives the body its mass properties; its origin stays where it is, its points keep their
// velocities.
void assign_mass(WorldState& world, std::uint32_t slot, const MassProperties& properties) {
    if (properties.center_of_mass != Vec3{}) make_mobile(world, slot);
    const std::uint32_t mobile = world.bodies[slot].mobile;
    if (mobile != scenery) {
        BodyTravel& travel = world.travels[mobile];
        const Vec3 shift =
            rotate(world.rotations[slot], properties.center_of_mass - center_of_mass(world, slot));
        world.positions[slot] = world.positions[slot] + shift;
        travel.linear_velocity += cross(travel.angular_velocity, shift);
        world.mobiles[mobile].mass_properties = properties;
        world.inertias[mobile] = can_move(world, slot) ? make_inertia(properties) : BodyInertia{};
    }
    float reach = 0;
    visit_shapes(world, slot, [&](std::uint32_t s) {
        ShapeRecord& shape = world.shapes[s];
        seat_shape(world, shape, seat_of(world, shape).local_pose, properties.center_of_mass);
        shape.reach = length(seat_of(world, shape).offset) + bounding_radius(shape.geometry);
        reach = max(reach, shape.reach);
    });
    if (mobile != scenery) world.ways[mobile].reach = reach;
    measure_extent(world, slot);
    keep_in_tree(world, slot);
}

std::uint32_t add_shape(WorldState& world, std::uint32_t body, const ShapeDef& def) {
    const std::uint32_t slot = take_slot(world.free_shapes, world.shapes.size());
    if (slot == world.shapes.size()) world.shapes.emplace_back();
    ShapeRecord& shape = world.shapes[slot];
    shape.body = body;
    shape.geometry = def.geometry;
    if (auto* plane = std::get_if<Plane>(&shape.geometry))
        plane->normal = normalize_or(plane->normal, {0, 1, 0});
    shape.substance = world.substances.take({def.material, def.density});
    seat_shape(world, shape, {def.local_pose.position, normalize(def.local_pose.rotation)},
               center_of_mass(world, body));
    shape.size = smallest_half_extent(shape.geometry);
    BodyRecord& owner = world.bodies[body];
    shape.previous = owner.last_shape;
    shape.next = nothing;
    (owner.last_shape == nothing ? owner.first_shape : world.shapes[owner.last_shape].next) = slot;
    owner.last_shape = slot;
    world.unplaced.push_back(shape_id(world, slot));
    return slot;
}

void remove_shape(WorldState& world, std::uint32_t slot) {
    ShapeRecord& shape = world.shapes[slot];
    BodyRecord& owner = world.bodies[shape.body];
    (shape.previous == nothing ? owner.first_shape : world.shapes[shape.previous].next) =
        shape.next;
    (shape.next == nothing ? owner.last_shape : world.shapes[shape.next].previous) = shape.previous;
    world.tree.remove(slot);
    world.substances.give_back(shape.substance);
    leave_seat(world, shape);
    const std::uint32_t generation = shape.generation + 1;
    shape = {};
    shape.generation = generation;
    world.free_shapes.push_back(slot);
}

// Contacts of what has just been removed, or is somewhere else now, end at once, so that a slot
// used again inherits no impulses.
void forget_contacts(WorldState& world, std::uint32_t body) {
    const auto is_of_body = [&](const PairRecord& pair) {
        return world.shapes[pair.shape_a].body == body || world.shapes[pair.shape_b].body == body;
    };
    world.contacts.remove_if(is_of_body, [&](std::uint32_t slot) { unlink_contact(world, slot); });
}

// Every contact is found anew in the next step.
void forget_sightings(WorldState& world) {
    for (PairRecord& pair : world.contacts.pairs()) {
        pair.apart_until = -1;
        pair.shows_face = false;
    }
}

// The broad phase begins anew.
void forget_pairs(WorldState& world) {
    world.tree = {};
    world.fat_pairs.clear();
    world.unplaced.clear();
    for (std::uint32_t slot = 0; slot < world.bodies.size(); ++slot) {
        world.rest.stale.push_back(slot);
        visit_shapes(world, slot,
                     [&](std::uint32_t s) { world.unplaced.push_back(shape_id(world, s)); });
    }
}

}  // namespace

World::World() : state_(std::make_unique<WorldState>()) {}
World::World(const World& other) : state_(std::make_unique<WorldState>(*other.state_)) {}
World::World(World&& other) noexcept = default;
World& World::operator=(const World& other) {
    if (this != &other) *state_ = *other.state_;
    return *this;
}
World& World::operator=(World&& other) noexcept = default;
World::~World() = default;

Result<World> World::create(const WorldSettings& settings) {
    if (const Refusal r = check_settings(settings)) return *r;
    World world;
    world.state_->settings = settings;
    return world;
}

void World::set_error_handler(std::function<void(const Error&)> handler) {
    state_->on_error = std::move(handler);
}

const WorldSettings& World::settings() const { return state_->settings; }

Status World::set_settings(const WorldSettings& settings) {
    if (const Refusal r = check_settings(settings)) return tell(*state_, "set_settings", *r);
    if (settings.step.narrow_phase != state_->settings.step.narrow_phase) forget_sightings(*state_);
    if (settings.step.broad_phase != state_->settings.step.broad_phase) forget_pairs(*state_);
    const bool forbids_sleep = state_->settings.sleeping && !settings.sleeping;
    const bool wakes = settings.gravity != state_->settings.gravity || forbids_sleep;
    state_->settings = settings;
    if (wakes) wake_all(*state_);
    return Done{};
}

Status World::set_threads(const Threads& threads) {
    Result<SharedScheduler> scheduler = make_scheduler(threads);
    if (!scheduler) return tell(*state_, "set_threads", scheduler.error());
    state_->scheduler = *scheduler;
    if (const StageTrace* trace = state_->trace.get())
        state_->trace.begin(scheduler->worker_count(), trace->spans_per_worker());
    return Done{};
}

Status World::set_trace(std::size_t spans_a_thread) {
    if (spans_a_thread > max_trace_spans) {
        return tell(
            *state_, "set_trace",
            Error{ErrorCode::OutOfRange, "spans_a_thread is " + std::to_string(spans_a_thread) +
                                             ", allowed: 0 to " + std::to_string(max_trace_spans)});
    }
    state_->trace.begin(state_->scheduler.worker_count(), spans_a_thread);
    return Done{};
}

Result<BodyId> World::create_body(const BodyDef& def) {
    const FloatEnvironment ieee;
    WorldState& world = *state_;
    if (const Refusal r = check_body(def)) return tell(world, "create_body", *r);
    MobileRecord wanted;
    wanted.given_mass = def.mass.value_or(0.0f);
    wanted.has_given_properties = def.mass_properties.has_value();
    const Result<MassProperties> mass =
        def.mass_properties ? *def.mass_properties : resolve_mass(wanted, def.kind, def.shapes);
    if (!mass) return tell(world, "create_body", mass.error());

    const std::uint32_t slot = take_slot(world.free_bodies, world.bodies.size());
    if (slot == world.bodies.size()) {
        world.bodies.emplace_back();
        world.positions.emplace_back();
        world.rotations.emplace_back();
        world.rest.states.push_back(0);
    }
    BodyRecord& body = world.bodies[slot];
    body.kind = def.kind;
    body.alive = true;
    body.can_sleep = def.can_sleep;
    body.filter = def.collision;
    ++world.body_count;

    const BodyDrive drive = {.gyroscopic = def.gyroscopic,
                             .lock = def.lock,
                             .gravity_scale = def.gravity_scale,
                             .linear_damping = def.linear_damping,
                             .angular_damping = def.angular_damping};
    const bool has_given_mass = def.mass || def.mass_properties;
    if (def.kind != BodyKind::Static || has_given_mass || drive != BodyDrive{}) {
        const std::uint32_t mobile = make_mobile(world, slot);
        world.mobiles[mobile] = wanted;
        world.drives[mobile] = drive;
    }
    if (def.force != Vec3{} || def.torque != Vec3{}) {
        forces_of(world, slot).constant_force = def.force;
        forces_of(world, slot).constant_torque = def.torque;
    }
    world.positions[slot] = def.position;
    world.rotations[slot] = normalize(def.rotation);
    for (const ShapeDef& shape : def.shapes) add_shape(world, slot, shape);
    assign_mass(world, slot, *mass);
    // Given for the center of mass, and nothing moves that is static.
    if (def.kind != BodyKind::Static) {
        BodyTravel& travel = world.travels[body.mobile];
        travel.linear_velocity = def.linear_velocity;
        travel.angular_velocity = def.angular_velocity;
    }
    update_membership(world, slot);
    note_change(world, slot);
    return body_id(world, slot);
}

Status World::destroy_body(BodyId id) {
    WorldState& world = *state_;
    if (!names(world, id)) return tell(world, stale("destroy_body", "body"));
    BodyRecord& body = world.bodies[id.index];
    note_change(world, id.index);
    forget_contacts(world, id.index);
    while (body.last_shape != nothing) remove_shape(world, body.last_shape);
    body.alive = false;
    update_membership(world, id.index);
    make_scenery(world, id.index);
    const std::uint32_t generation = body.generation + 1;
    body = {};
    body.generation = generation;
    world.rotations[id.index] = {};
    world.free_bodies.push_back(id.index);
    --world.body_count;
    return Done{};
}

Result<ShapeId> World::create_shape(BodyId id, const ShapeDef& def) {
    const FloatEnvironment ieee;
    WorldState& world = *state_;
    if (!names(world, id)) return tell(world, stale("create_shape", "body"));
    const BodyKind kind = world.bodies[id.index].kind;
    if (const Refusal r = check_shape("shape", def, kind)) return tell(world, "create_shape", *r);
    std::vector<ShapeDef> defs = shape_defs(world, id.index);
    defs.push_back(def);
    const Result<MassProperties> mass = resolve_mass(mobile_record(world, id.index), kind, defs);
    if (!mass) return tell(world, "create_shape", mass.error());
    const std::uint32_t slot = add_shape(world, id.index, def);
    assign_mass(world, id.index, *mass);
    note_change(world, id.index);
    return shape_id(world, slot);
}

Status World::destroy_shape(ShapeId id) {
    const FloatEnvironment ieee;
    WorldState& world = *state_;
    if (!names(world, id)) return tell(world, stale("destroy_shape", "shape"));
    const std::uint32_t slot = world.shapes[id.index].body;
    std::vector<ShapeDef> defs;
    visit_shapes(world, slot, [&](std::uint32_t s) {
        if (s != id.index) defs.push_back(shape_def(world, s));
    });
    const Result<MassProperties> mass =
        resolve_mass(mobile_record(world, slot), world.bodies[slot].kind, defs);
    if (!mass) return tell(world, "destroy_shape", mass.error());
    note_change(world, slot);
    remove_shape(world, id.index);
    world.contacts.remove_if(
        [&](const PairRecord& p) { return p.shape_a == id.index || p.shape_b == id.index; },
        [&](std::uint32_t contact) { unlink_contact(world, contact); });
    assign_mass(world, slot, *mass);
    return Done{};
}

bool World::is_valid(BodyId body) const { return names(*state_, body); }
bool World::is_valid(ShapeId shape) const { return names(*state_, shape); }
std::size_t World::body_count() const { return state_->body_count; }

std::vector<BodyId> World::bodies() const {
    std::vector<BodyId> ids;
    ids.reserve(state_->body_count);
    for (std::uint32_t slot = 0; slot < state_->bodies.size(); ++slot) {
        if (state_->bodies[slot].alive) ids.push_back(body_id(*state_, slot));
    }
    return ids;
}

std::vector<ShapeId> World::shapes(BodyId id) const {
    std::vector<ShapeId> ids;
    if (!names(*state_, id)) {
        tell(*state_, stale("shapes", "body"));
        return ids;
    }
    visit_shapes(*state_, id.index,
                 [&](std::uint32_t slot) { ids.push_back(shape_id(*state_, slot)); });
    return ids;
}

ShapeDef World::shape(ShapeId id) const {
    if (names(*state_, id)) return shape_def(*state_, id.index);
    tell(*state_, stale("shape", "shape"));
    return {};
}

BodyId World::body_of(ShapeId id) const {
    if (names(*state_, id)) return body_id(*state_, state_->shapes[id.index].body);
    tell(*state_, stale("body_of", "shape"));
    return {};
}

BodyState World::state(BodyId id) const {
    const FloatEnvironment ieee;
    const WorldState& world = *state_;
    if (!names(world, id)) {
        tell(world, stale("state", "body"));
        return {};
    }
    const BodyTravel& travel = travel_of(world, id.index);
    return {.position = origin_position(world, id.index),
            .center_of_mass = world.positions[id.index],
            .rotation = world.rotations[id.index],
            .linear_velocity = travel.linear_velocity,
            .angular_velocity = travel.angular_velocity,
            .kind = world.bodies[id.index].kind,
            .asleep = is_asleep(world, id.index),
            .frozen = world.bodies[id.index].frozen};
}

Position World::position(BodyId id) const { return state(id).position; }
Quat World::rotation(BodyId id) const { return state(id).rotation; }
Vec3 World::linear_velocity(BodyId id) const { return state(id).linear_velocity; }
Vec3 World::angular_velocity(BodyId id) const { return state(id).angular_velocity; }

MassProperties World::mass_properties(BodyId id) const {
    const WorldState& world = *state_;
    if (!names(world, id)) {
        tell(world, stale("mass_properties", "body"));
        return {};
    }
    const MassProperties& properties = mass_of(world, id.index);
    if (world.bodies[id.index].kind == BodyKind::Dynamic) return properties;
    return {.mass = 0, .center_of_mass = properties.center_of_mass, .inertia = {}};
}

Status World::set_pose(BodyId id, const Position& position, const Quat& rotation) {
    const FloatEnvironment ieee;
    WorldState& world = *state_;
    if (!names(world, id)) return tell(world, stale("set_pose", "body"));
    if (const Refusal r = check_position("position", position)) return tell(world, "set_pose", *r);
    if (const Refusal r = check_rotation("rotation", rotation)) return tell(world, "set_pose", *r);
    BodyRecord& body = world.bodies[id.index];
    world.rotations[id.index] = normalize(rotation);
    world.positions[id.index] =
        position + rotate(world.rotations[id.index], center_of_mass(world, id.index));
    if (body.frozen) {
        body.frozen = false;
        world.inertias[body.mobile] =
            can_move(world, id.index) ? make_inertia(mass_of(world, id.index)) : BodyInertia{};
    }
    update_membership(world, id.index);
    note_change(world, id.index);
    forget_contacts(world, id.index);
    keep_in_tree(world, id.index);
    return Done{};
}

Status World::set_linear_velocity(BodyId id, const Vec3& velocity) {
    WorldState& world = *state_;
    if (!names(world, id)) return tell(world, stale("set_linear_velocity", "body"));
    if (const Refusal r = check_finite("velocity", velocity))
        return tell(world, "set_linear_velocity", *r);
    if (world.bodies[id.index].kind == BodyKind::Static) return Done{};
    Vec3& present = world.travels[world.bodies[id.index].mobile].linear_velocity;
    if (present == velocity) return Done{};
    present = velocity;
    wake(world, id.index);
    update_membership(world, id.index);
    return Done{};
}

Status World::set_angular_velocity(BodyId id, const Vec3& velocity) {
    WorldState& world = *state_;
    if (!names(world, id)) return tell(world, stale("set_angular_velocity", "body"));
    if (const Refusal r = check_finite("velocity", velocity))
        return tell(world, "set_angular_velocity", *r);
    if (world.bodies[id.index].kind == BodyKind::Static) return Done{};
    Vec3& present = world.travels[world.bodies[id.index].mobile].angular_velocity;
    if (present == velocity) return Done{};
    present = velocity;
    wake(world, id.index);
    update_membership(world, id.index);
    return Done{};
}

Status World::move_kinematic(BodyId id, const Position& position, const Quat& rotation, double dt) {
    const FloatEnvironment ieee;
    WorldState& world = *state_;
    const char* call = "move_kinematic";
    if (!names(world, id)) return tell(world, stale(call, "body"));
    if (const Refusal r = check_position("position", position)) return tell(world, call, *r);
    if (const Refusal r = check_rotation("rotation", rotation)) return tell(world, call, *r);
    if (const Refusal r = check_positive("dt", dt)) return tell(world, call, *r);
    if (world.bodies[id.index].kind != BodyKind::Kinematic) {
        return tell(world,
                    {ErrorCode::OutOfRange,
                     std::string(call) + ": the body is not kinematic; allowed: kinematic bodies"});
    }
    const Quat target = normalize(rotation);
    const Position center = position + rotate(target, center_of_mass(world, id.index));
    const auto rate = float(1.0 / dt);
    const Vec3 velocity = rate * (center - world.positions[id.index]);
    // The turn's logarithm: the shorter way round.
    Quat turned = target * conjugate(world.rotations[id.index]);
    if (turned.w < 0) turned = {-turned.x, -turned.y, -turned.z, -turned.w};
    const Vec3 axis = {turned.x, turned.y, turned.z};
    const float sine = length(axis);
    const auto angle = float(2 * exact_arc_tangent2(double(sine), double(turned.w)));
    const Vec3 spin = sine > 0 ? (rate * angle / sine) * axis : Vec3{};
    if (const Refusal r = check_finite("position", velocity)) return tell(world, call, *r);
    BodyTravel& travel = world.travels[world.bodies[id.index].mobile];
    travel.linear_velocity = velocity;
    travel.angular_velocity = spin;
    update_membership(world, id.index);
    return Done{};
}

Status World::set_kind(BodyId id, BodyKind kind) {
    const FloatEnvironment ieee;
    WorldState& world = *state_;
    if (!names(world, id)) return tell(world, stale("set_kind", "body"));
    BodyRecord& body = world.bodies[id.index];
    const std::vector<ShapeDef> defs = shape_defs(world, id.index);
    for (const ShapeDef& def : defs) {
        if (const Refusal r = check_shape("shape", def, kind)) return tell(world, "set_kind", *r);
    }
    const Result<MassProperties> mass = resolve_mass(mobile_record(world, id.index), kind, defs);
    if (!mass) return tell(world, "set_kind", mass.error());
    // As what it was: it wakes, and so do the contacts that it sleeps with.
    note_change(world, id.index);
    body.kind = kind;
    if (kind != BodyKind::Static) make_mobile(world, id.index);
    if (kind == BodyKind::Static && body.mobile != scenery) {
        BodyTravel& travel = world.travels[body.mobile];
        travel.linear_velocity = travel.angular_velocity = {};
    }
    assign_mass(world, id.index, *mass);
    update_membership(world, id.index);
    return Done{};
}

Status World::set_mass_properties(BodyId id, const MassProperties& properties) {
    const FloatEnvironment ieee;
    WorldState& world = *state_;
    if (!names(world, id)) return tell(world, stale("set_mass_properties", "body"));
    if (const Refusal r = check_mass_properties("mass_properties", properties))
        return tell(world, "set_mass_properties", *r);
    MobileRecord& record = world.mobiles[make_mobile(world, id.index)];
    record.given_mass = 0;
    record.has_given_properties = true;
    assign_mass(world, id.index, properties);
    note_change(world, id.index);
    return Done{};
}

Status World::step(double dt) {
    if (const Refusal r = check_positive("dt", dt)) return tell(*state_, "step", *r);
    const TraceScope scope(state_->trace.get(), 0, "step");
    step_world(*state_, dt);
    return Done{};
}

}  // namespace cairn
