#pragma once
// Everything a world is: copied whole, it is a snapshot.
//
// Bodies and shapes live in slots with a generation; parallel arrays keep apart what a step moves,
// what resists, and what is rarely touched. Written by the user's changes and by step.cpp alone.

#include <functional>
#include <optional>
#include <vector>

#include "base/large_array.h"
#include "base/scheduler.h"
#include "base/shared_values.h"
#include "base/stage_trace.h"
#include "broad/brute_force.h"
#include "broad/tree_pairs.h"
#include "cairn/world.h"
#include "constraint/step_problem.h"
#include "contact/contact_store.h"
#include "solver/solver.h"
#include "world/dense_bodies.h"
#include "world/rest_state.h"
#include "world/step_groups.h"

namespace cairn {

constexpr std::uint32_t nothing = 0xffffffffu;

// Where the mobiles begin: the place of all scenery.
constexpr std::uint32_t scenery = 0;

// What every body has beside its pose.
struct BodyRecord {
    std::uint32_t generation = 0;
    BodyKind kind = BodyKind::Static;
    bool alive = false;
    bool frozen = false;
    bool can_sleep = true;
    CollisionFilter filter;
    std::uint32_t first_shape = nothing, last_shape = nothing;  // in order of creation
    std::uint32_t mobile = scenery;                             // its place among the mobiles
};

// A mobile's cold side: what the user said of it.
struct MobileRecord {
    MassProperties mass_properties;     // as dynamic, whatever the kind is now
    float given_mass = 0;               // what the shapes' densities are scaled to; 0: as they are
    bool has_given_properties = false;  // its mass properties are the user's, not the shapes'
    std::uint32_t forces = nothing;     // its place among the user's forces, if there were any
};

// How a body goes: its motion but for the rotation, which scenery has too.
struct BodyTravel {
    Vec3 linear_velocity, angular_velocity, displacement;  // as in BodyMotion
};

// What the user pushes a body with.
struct UserForces {
    Vec3 constant_force, constant_torque;
    Vec3 step_force, step_torque;  // for the next step alone
};

struct ShapeRecord {
    std::uint32_t generation = 0;
    std::uint32_t body = nothing;                      // nothing: there is no such shape
    std::uint32_t next = nothing, previous = nothing;  // of the same body
    Geometry geometry;
    std::uint32_t substance = nothing;  // its number among the world's
    std::uint32_t seat = nothing;       // its place among the seats, unless its frame is its body's
    float size = 0;                     // smallest half extent
    float reach = 0;  // largest distance of a point from the body's center of mass

    bool is_alive() const { return body != nothing; }
};

// What a shape is made of: most are made of the same.
struct Substance {
    Material material;
    float density = 0;
};

// Where a shape sits that is not in the middle of its body.
struct ShapeSeat {
    Pose local_pose;
    Vec3 offset;             // of its origin from the body's center of mass, body frame
    bool is_turned = false;  // its axes are not the body's
};

// How far a body's points have gone at most, m: what two shapes that were apart have left to go.
struct BodyWay {
    double gone = 0;     // up to the last step's end
    double horizon = 0;  // and when this step is over
    float reach = 0;     // largest distance of a point from the center of mass
};

// A pair of shapes within reach of each other, between two stages.
struct Meeting {
    Quat rotation_a;  // of shape A
    Pose b_in_a;      // of the shapes
    Axis axis;        // in shape A's frame
    AxisHint hint;
    float within = 0;  // points farther apart than this are left out
};

// What a stage found in one block of the list of pairs.
struct PairBlock {
    std::uint32_t contact_count = 0;  // pairs that meet
    std::uint32_t point_count = 0;
    std::uint32_t reused_count = 0;
    std::uint32_t news_count = 0;  // contacts that began, ended or have no points
};

// Where a step took a body.
struct BodyArrival {
    std::optional<Quantity> wrong = {};  // which of its numbers, if one is: it stays where it was
    bool strayed = false;                // farther than was foreseen when the step began
};

struct WorldState {
    WorldSettings settings;
    std::function<void(const Error&)> on_error;
    SharedScheduler scheduler;  // copies share it
    OwnTrace trace;

    // By body slot.
    LargeArray<BodyRecord> bodies;
    LargeArray<Position> positions;  // of the centers of mass
    LargeArray<Quat> rotations;      // body to world
    LargeArray<std::uint32_t> free_bodies;
    std::size_t body_count = 0;

    // By mobile: what bodies need only once they can move. Scenery is all that is static, turns
    // about its own origin and has nothing said of it that would matter if it moved; it shares the
    // first place, which holds what moves nowhere and is never written.
    LargeArray<MobileRecord> mobiles{1};
    LargeArray<BodyTravel> travels{1};
    LargeArray<BodyInertia> inertias{1};
    LargeArray<BodyDrive> drives{1};
    LargeArray<BodyWay> ways{1};
    LargeArray<std::uint32_t> free_mobiles;
    std::vector<UserForces> forces;  // of the few bodies that were ever given any
    std::vector<std::uint32_t> free_forces;

    LargeArray<ShapeRecord> shapes;  // by shape slot
    LargeArray<std::uint32_t> free_shapes;
    SharedValues<Substance> substances;
    LargeArray<ShapeSeat> seats;
    LargeArray<std::uint32_t> free_seats;

    // By shape slot: a box that holds the shape throughout the step, as of the last step that
    // looked at it.
    LargeArray<Aabb> boxes;
    TreePairs tree;  // fat boxes, by shape slot
    // Shapes that are not in the tree yet, and some that are no more.
    LargeArray<ShapeId> unplaced;
    LargeArray<Pair> fat_pairs;  // those among them of which a body is looked at, sorted

    ContactStore contacts;
    RestState rest;

    StepReport report;
    double last_dt = 0;
    LargeArray<ContactEvent> events;
    std::vector<NonFinite> non_finite;

    // Where a worker advances groups of the step, of no meaning between steps.
    struct Workshop {
        DenseBodies bodies;
        SolverState solver;
    };

    // Room that steps use again, of no meaning between them.
    struct Scratch {
        LargeArray<Proxy> proxies;
        BruteForce broad;
        LargeArray<Pair> pairs, found_pairs, merged_pairs;
        std::vector<LargeArray<Pair>> found_parts;  // by worker
        LargeArray<Proxy> new_proxies;
        LargeArray<std::uint32_t> updated;      // shapes
        LargeArray<std::uint8_t> escaped;       // likewise: whether its box must go to the tree
        LargeArray<std::uint32_t> kept_counts;  // by block of pairs
        LargeArray<std::uint32_t> moving;
        LargeArray<Meeting> meetings;       // by place in the list of pairs
        LargeArray<PairBlock> pair_blocks;  // of that list
        LargeArray<std::uint32_t> active;
        LargeArray<BodyMotion> before;
        LargeArray<std::optional<Quantity>> overdriven;  // of the bodies that were driven last
        LargeArray<BodyArrival> arrivals;                // as `moving`
        StepGroups groups;
        std::vector<Workshop> workshops;  // by worker
    } scratch;
};

inline BodyId body_id(const WorldState& world, std::uint32_t slot) {
    return {slot, world.bodies[slot].generation};
}
inline ShapeId shape_id(const WorldState& world, std::uint32_t slot) {
    return {slot, world.shapes[slot].generation};
}

inline const Material& material_of(const WorldState& world, const ShapeRecord& shape) {
    return world.substances[shape.substance].material;
}
inline ShapeSeat seat_of(const WorldState& world, const ShapeRecord& shape) {
    return shape.seat == nothing ? ShapeSeat{} : world.seats[shape.seat];
}
inline ShapeDef shape_def(const WorldState& world, std::uint32_t slot) {
    const ShapeRecord& shape = world.shapes[slot];
    return {.geometry = shape.geometry,
            .local_pose = seat_of(world, shape).local_pose,
            .density = world.substances[shape.substance].density,
            .material = material_of(world, shape)};
}

// visit(slot) for each shape of the body; it may remove the one that it is given.
template <class Visit>
void visit_shapes(const WorldState& world, std::uint32_t body, Visit&& visit) {
    for (std::uint32_t slot = world.bodies[body].first_shape; slot != nothing;) {
        const std::uint32_t next = world.shapes[slot].next;
        visit(slot);
        slot = next;
    }
}

inline const BodyTravel& travel_of(const WorldState& world, std::uint32_t body) {
    return world.travels[world.bodies[body].mobile];
}
inline const BodyInertia& inertia_of(const WorldState& world, std::uint32_t body) {
    return world.inertias[world.bodies[body].mobile];
}
inline const BodyDrive& drive_of(const WorldState& world, std::uint32_t body) {
    return world.drives[world.bodies[body].mobile];
}
inline const BodyWay& way_of(const WorldState& world, std::uint32_t body) {
    return world.ways[world.bodies[body].mobile];
}
inline const MassProperties& mass_of(const WorldState& world, std::uint32_t body) {
    return world.mobiles[world.bodies[body].mobile].mass_properties;
}

inline BodyMotion motion_of(const WorldState& world, std::uint32_t body) {
    const BodyTravel& travel = travel_of(world, body);
    return {travel.linear_velocity, travel.angular_velocity, world.rotations[body],
            travel.displacement};
}
// Of a body that is not scenery.
inline void set_motion(WorldState& world, std::uint32_t body, const BodyMotion& motion) {
    world.rotations[body] = motion.rotation;
    world.travels[world.bodies[body].mobile] = {motion.linear_velocity, motion.angular_velocity,
                                                motion.displacement};
}

inline void forget_step_forces(WorldState& world, std::uint32_t body) {
    const std::uint32_t place = world.mobiles[world.bodies[body].mobile].forces;
    if (place != nothing) world.forces[place].step_force = world.forces[place].step_torque = {};
}

inline Vec3 center_of_mass(const WorldState& world, std::uint32_t body) {
    return mass_of(world, body).center_of_mass;  // body frame
}

// Where the body frame's origin is.
inline Position origin_position(const WorldState& world, std::uint32_t slot) {
    return world.positions[slot] - rotate(world.rotations[slot], center_of_mass(world, slot));
}

}  // namespace cairn
