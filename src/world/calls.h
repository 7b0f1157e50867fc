#pragma once
// What every call of the public face begins with: does the id name something, and who is told if
// not.

#include <string>

#include "world/world_state.h"

namespace cairn {

inline Error stale(const char* call, const char* kind) {
    return {ErrorCode::InvalidId, std::string(call) + ": the id names no " + kind +
                                      " of this world; allowed: the id of one that exists"};
}

inline Error tell(const WorldState& world, Error error) {
    if (world.on_error) world.on_error(error);
    return error;
}

inline Error tell(const WorldState& world, const char* call, const Error& refusal) {
    return tell(world, {refusal.code, std::string(call) + ": " + refusal.message});
}

inline bool names(const WorldState& world, BodyId id) {
    return id.index < world.bodies.size() && world.bodies[id.index].alive &&
           world.bodies[id.index].generation == id.generation;
}

inline bool names(const WorldState& world, ShapeId id) {
    return id.index < world.shapes.size() && world.shapes[id.index].is_alive() &&
           world.shapes[id.index].generation == id.generation;
}

// The body's place among the mobiles; it is given one of its own where it was scenery.
inline std::uint32_t make_mobile(WorldState& world, std::uint32_t body) {
    std::uint32_t& mobile = world.bodies[body].mobile;
    if (mobile != scenery) return mobile;
    if (world.free_mobiles.empty()) {
        mobile = std::uint32_t(world.mobiles.size());
        world.mobiles.emplace_back();
        world.travels.emplace_back();
        world.inertias.emplace_back();
        world.drives.emplace_back();
        world.ways.emplace_back();
        return mobile;
    }
    mobile = world.free_mobiles.back();
    world.free_mobiles.pop_back();
    world.mobiles[mobile] = {};
    world.travels[mobile] = {};
    world.inertias[mobile] = {};
    world.drives[mobile] = {};
    world.ways[mobile] = {};
    return mobile;
}

// What the user pushes the body with; it is given room for that when it first is.
inline UserForces& forces_of(WorldState& world, std::uint32_t body) {
    std::uint32_t& place = world.mobiles[make_mobile(world, body)].forces;
    if (place == nothing && !world.free_forces.empty()) {
        place = world.free_forces.back();
        world.free_forces.pop_back();
    } else if (place == nothing) {
        place = std::uint32_t(world.forces.size());
        world.forces.emplace_back();
    }
    return world.forces[place];
}

// Gives up what the body had of its own.
inline void make_scenery(WorldState& world, std::uint32_t body) {
    std::uint32_t& mobile = world.bodies[body].mobile;
    if (mobile == scenery) return;
    if (const std::uint32_t place = world.mobiles[mobile].forces; place != nothing) {
        world.forces[place] = {};
        world.free_forces.push_back(place);
    }
    world.free_mobiles.push_back(mobile);
    mobile = scenery;
}

}  // namespace cairn
