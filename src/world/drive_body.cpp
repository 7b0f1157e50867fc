// The public face's changes to how a body is driven: what pulls and pushes it, what holds it back,
// whether it may sleep. Each checks what it is given first, as all of world.cpp does.

#include "base/float_environment.h"
#include "world/calls.h"
#include "world/detect.h"
#include "world/sleep.h"
#include "world/validate.h"

namespace cairn {

Status World::set_gravity_scale(BodyId id, float scale) {
    if (!names(*state_, id)) return tell(*state_, stale("set_gravity_scale", "body"));
    if (const Refusal r = check_finite("scale", double(scale)))
        return tell(*state_, "set_gravity_scale", *r);
    if (drive_of(*state_, id.index).gravity_scale == scale) return Done{};
    state_->drives[make_mobile(*state_, id.index)].gravity_scale = scale;
    wake(*state_, id.index);
    return Done{};
}

Status World::set_damping(BodyId id, float linear, float angular) {
    if (!names(*state_, id)) return tell(*state_, stale("set_damping", "body"));
    if (const Refusal r = check_at_least("linear", double(linear), 0))
        return tell(*state_, "set_damping", *r);
    if (const Refusal r = check_at_least("angular", double(angular), 0))
        return tell(*state_, "set_damping", *r);
    BodyDrive& drive = state_->drives[make_mobile(*state_, id.index)];
    drive.linear_damping = linear;
    drive.angular_damping = angular;
    return Done{};
}

Status World::set_gyroscopic(BodyId id, bool on) {
    if (!names(*state_, id)) return tell(*state_, stale("set_gyroscopic", "body"));
    state_->drives[make_mobile(*state_, id.index)].gyroscopic = on;
    return Done{};
}

Status World::set_locked_axes(BodyId id, const LockedAxes& lock) {
    if (!names(*state_, id)) return tell(*state_, stale("set_locked_axes", "body"));
    if (drive_of(*state_, id.index).lock == lock) return Done{};
    state_->drives[make_mobile(*state_, id.index)].lock = lock;
    wake(*state_, id.index);
    return Done{};
}

Status World::set_collision_filter(BodyId id, const CollisionFilter& filter) {
    if (!names(*state_, id)) return tell(*state_, stale("set_collision_filter", "body"));
    if (state_->bodies[id.index].filter == filter) return Done{};
    state_->bodies[id.index].filter = filter;
    note_change(*state_, id.index);
    return Done{};
}

Status World::set_material(ShapeId id, const Material& material) {
    if (!names(*state_, id)) return tell(*state_, stale("set_material", "shape"));
    if (const Refusal r = check_material("material", material))
        return tell(*state_, "set_material", *r);
    ShapeRecord& shape = state_->shapes[id.index];
    if (material_of(*state_, shape) == material) return Done{};
    const float density = state_->substances[shape.substance].density;
    state_->substances.give_back(shape.substance);
    shape.substance = state_->substances.take({material, density});
    note_change(*state_, shape.body);
    state_->contacts.list_returned();
    for (const PairRecord& pair : state_->contacts.pairs()) {
        if (pair.contact == ContactStore::none) continue;
        if (pair.shape_a == id.index || pair.shape_b == id.index)
            describe_contact(*state_, state_->contacts[pair.contact]);
    }
    return Done{};
}

Status World::set_constant_force(BodyId id, const Vec3& force, const Vec3& torque) {
    if (!names(*state_, id)) return tell(*state_, stale("set_constant_force", "body"));
    if (const Refusal r = check_finite("force", force))
        return tell(*state_, "set_constant_force", *r);
    if (const Refusal r = check_finite("torque", torque))
        return tell(*state_, "set_constant_force", *r);
    UserForces& forces = forces_of(*state_, id.index);
    if (forces.constant_force == force && forces.constant_torque == torque) return Done{};
    forces.constant_force = force;
    forces.constant_torque = torque;
    wake(*state_, id.index);
    return Done{};
}

bool World::is_awake(BodyId id) const {
    if (names(*state_, id)) return moves(*state_, id.index);
    tell(*state_, stale("is_awake", "body"));
    return false;
}

Status World::set_awake(BodyId id, bool awake) {
    if (!names(*state_, id)) return tell(*state_, stale("set_awake", "body"));
    if (awake)
        wake(*state_, id.index);
    else
        put_to_sleep(*state_, id.index);
    return Done{};
}

Status World::set_can_sleep(BodyId id, bool can_sleep) {
    if (!names(*state_, id)) return tell(*state_, stale("set_can_sleep", "body"));
    state_->bodies[id.index].can_sleep = can_sleep;
    if (!can_sleep) wake(*state_, id.index);
    return Done{};
}

Status World::apply_force(BodyId id, const Vec3& force) {
    if (!names(*state_, id)) return tell(*state_, stale("apply_force", "body"));
    if (const Refusal r = check_finite("force", force)) return tell(*state_, "apply_force", *r);
    const FloatEnvironment ieee;
    if (force != Vec3{}) wake(*state_, id.index);
    forces_of(*state_, id.index).step_force += force;
    return Done{};
}

Status World::apply_force_at(BodyId id, const Vec3& force, const Position& point) {
    if (!names(*state_, id)) return tell(*state_, stale("apply_force_at", "body"));
    if (const Refusal r = check_finite("force", force)) return tell(*state_, "apply_force_at", *r);
    if (const Refusal r = check_position("point", point))
        return tell(*state_, "apply_force_at", *r);
    const FloatEnvironment ieee;
    if (force != Vec3{}) wake(*state_, id.index);
    forces_of(*state_, id.index).step_force += force;
    forces_of(*state_, id.index).step_torque += cross(point - state_->positions[id.index], force);
    return Done{};
}

Status World::apply_torque(BodyId id, const Vec3& torque) {
    if (!names(*state_, id)) return tell(*state_, stale("apply_torque", "body"));
    if (const Refusal r = check_finite("torque", torque)) return tell(*state_, "apply_torque", *r);
    const FloatEnvironment ieee;
    if (torque != Vec3{}) wake(*state_, id.index);
    forces_of(*state_, id.index).step_torque += torque;
    return Done{};
}

namespace {

void push(WorldState& world, std::uint32_t slot, Vec3 linear, Vec3 angular) {
    const FloatEnvironment ieee;
    if (linear != Vec3{} || angular != Vec3{}) wake(world, slot);
    const std::uint32_t mobile = world.bodies[slot].mobile;
    if (mobile == scenery) return;
    const Response response =
        find_response(world.inertias[mobile], world.drives[mobile], world.rotations[slot]);
    world.travels[mobile].linear_velocity += multiply(response.inverse_mass, linear);
    world.travels[mobile].angular_velocity += response.inverse_inertia * angular;
}

}  // namespace

Status World::apply_impulse(BodyId id, const Vec3& impulse) {
    if (!names(*state_, id)) return tell(*state_, stale("apply_impulse", "body"));
    if (const Refusal r = check_finite("impulse", impulse))
        return tell(*state_, "apply_impulse", *r);
    push(*state_, id.index, impulse, {});
    return Done{};
}

Status World::apply_impulse_at(BodyId id, const Vec3& impulse, const Position& point) {
    if (!names(*state_, id)) return tell(*state_, stale("apply_impulse_at", "body"));
    if (const Refusal r = check_finite("impulse", impulse))
        return tell(*state_, "apply_impulse_at", *r);
    if (const Refusal r = check_position("point", point))
        return tell(*state_, "apply_impulse_at", *r);
    push(*state_, id.index, impulse, cross(point - state_->positions[id.index], impulse));
    return Done{};
}

Status World::apply_angular_impulse(BodyId id, const Vec3& impulse) {
    if (!names(*state_, id)) return tell(*state_, stale("apply_angular_impulse", "body"));
    if (const Refusal r = check_finite("impulse", impulse))
        return tell(*state_, "apply_angular_impulse", *r);
    push(*state_, id.index, {}, impulse);
    return Done{};
}

}  // namespace cairn
