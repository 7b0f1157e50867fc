#pragma once
// The world: bodies, and the step that moves them.
//
// A world is a value. Copying one takes a complete snapshot: the copy, stepped, goes through
// exactly the states that the original goes through, to the bit, and ids of the one are valid in
// the other.
//
// Every call checks what it is given, in every build. A refused call changes nothing, returns an
// Error, and tells the error handler if there is one. Questions about an id that is gone answer
// with zeros and tell the error handler. Not to be called from two threads at once, but for the
// questions of the last section; distinct worlds share nothing.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "cairn/body.h"
#include "cairn/ids.h"
#include "cairn/query.h"
#include "cairn/report.h"
#include "cairn/result.h"
#include "cairn/settings.h"
#include "cairn/shape.h"
#include "cairn/threads.h"
#include "cairn/trace.h"

namespace cairn {

struct WorldState;

class World {
public:
    World();
    /// A world with these settings, or why they make none.
    static Result<World> create(const WorldSettings& settings);
    World(const World& other);
    World(World&& other) noexcept;
    World& operator=(const World& other);
    World& operator=(World&& other) noexcept;
    ~World();

    /// Called with every error, before the call that met it returns. Copied with the world.
    void set_error_handler(std::function<void(const Error&)> handler);

    const WorldSettings& settings() const;
    Status set_settings(const WorldSettings& settings);
    /// Which threads may work on a step; copies of the world share them. Never changes a result,
    /// and a small world stays on the caller's thread. An error for a count out of range.
    Status set_threads(const Threads& threads);

    // Bodies and shapes.

    Result<BodyId> create_body(const BodyDef& def);
    Status destroy_body(BodyId body);
    /// Adds a shape; mass properties follow the shapes unless they were given.
    Result<ShapeId> create_shape(BodyId body, const ShapeDef& def);
    Status destroy_shape(ShapeId shape);

    bool is_valid(BodyId body) const;
    bool is_valid(ShapeId shape) const;
    std::size_t body_count() const;
    /// Every body, in the order of their slots: the order of creation where none was destroyed.
    std::vector<BodyId> bodies() const;
    std::vector<ShapeId> shapes(BodyId body) const;
    ShapeDef shape(ShapeId shape) const;
    BodyId body_of(ShapeId shape) const;

    // State.

    BodyState state(BodyId body) const;
    /// Of the body frame's origin.
    Position position(BodyId body) const;
    Quat rotation(BodyId body) const;
    Vec3 linear_velocity(BodyId body) const;
    Vec3 angular_velocity(BodyId body) const;
    /// Zero mass and inertia for static and kinematic bodies; the center of mass is true for all.
    MassProperties mass_properties(BodyId body) const;

    /// Puts the body frame's origin there at once; velocities stay. Thaws a frozen body.
    Status set_pose(BodyId body, const Position& position, const Quat& rotation);
    Status set_linear_velocity(BodyId body, const Vec3& velocity);
    Status set_angular_velocity(BodyId body, const Vec3& velocity);
    /// Gives a kinematic body the velocities that take it there in dt seconds.
    Status move_kinematic(BodyId body, const Position& position, const Quat& rotation, double dt);
    Status set_kind(BodyId body, BodyKind kind);
    Status set_mass_properties(BodyId body, const MassProperties& mass_properties);
    Status set_gravity_scale(BodyId body, float scale);
    Status set_damping(BodyId body, float linear, float angular);
    Status set_gyroscopic(BodyId body, bool on);
    Status set_locked_axes(BodyId body, const LockedAxes& lock);
    Status set_collision_filter(BodyId body, const CollisionFilter& filter);
    Status set_material(ShapeId shape, const Material& material);
    /// The force and torque that act in every step, as in BodyDef.
    Status set_constant_force(BodyId body, const Vec3& force, const Vec3& torque);

    /// Whether a body takes part in the step: a dynamic one that is not asleep, a kinematic one
    /// that moves.
    bool is_awake(BodyId body) const;
    /// Wakes the body and all that it is in touch with, or puts them to sleep at once: all of them
    /// stop. Does nothing to static and kinematic bodies. Whatever else is done to a body or to
    /// what it touches wakes it by itself.
    Status set_awake(BodyId body, bool awake);
    Status set_can_sleep(BodyId body, bool can_sleep);

    /// For the next step alone; calls add up. N at the center of mass, world frame.
    Status apply_force(BodyId body, const Vec3& force);
    Status apply_force_at(BodyId body, const Vec3& force, const Position& point);
    Status apply_torque(BodyId body, const Vec3& torque);
    /// At once. N s at the center of mass, world frame.
    Status apply_impulse(BodyId body, const Vec3& impulse);
    Status apply_impulse_at(BodyId body, const Vec3& impulse, const Position& point);
    Status apply_angular_impulse(BodyId body, const Vec3& impulse);

    // Stepping.

    /// Moves the world on by dt seconds, 0 < dt.
    Status step(double dt);

    // What the step did.

    /// From here on the world keeps what its steps do when, up to so many spans of each thread, 32
    /// bytes each, the latest: a stage is one span, a large step some hundreds a thread. 0: no
    /// longer. Never changes a result, and costs a step two looks at the clock a span. A copy of
    /// the world keeps none; other threads begin anew. An error above max_trace_spans.
    Status set_trace(std::size_t spans_a_thread);
    /// All that was kept since set_trace().
    Trace trace() const;
    const StepReport& last_step() const;
    /// Contacts that began and ended in the last step, in the order of their shapes.
    std::span<const ContactEvent> contact_events() const;
    /// Every body that was ever frozen, in order of time.
    std::span<const NonFinite> non_finite() const;
    /// The contacts as they are at the present poses, measured anew, with the last step's impulses.
    std::vector<ContactReport> contacts() const;
    static Penetration penetration(std::span<const ContactReport> contacts);
    Energy energy() const;
    Momentum momentum() const;
    /// FNV-1a, 64 bits, over the bodies in the order of bodies(), little-endian: position 3 x
    /// binary64, rotation, linear and angular velocity binary32, asleep one byte.
    std::uint64_t state_hash() const;

    // Questions (query.h). Any number of threads may ask at once, while nobody steps or changes the
    // world. They answer with nothing where what they are given is not finite or makes no sense,
    // and tell the error handler, on the thread that asked.

    /// What the ray meets first.
    RayHit cast_ray(const Ray& ray, const QueryFilter& filter = {}) const;
    /// Whether it meets anything: less work.
    bool any_hit(const Ray& ray, const QueryFilter& filter = {}) const;
    /// All that it meets, by distance, each shape once, where the ray comes to it.
    std::vector<RayHit> all_hits(const Ray& ray, const QueryFilter& filter = {}) const;
    /// visit(hit) for what it meets, in any order; what it returns is the length of the ray from
    /// there on: hit.distance looks only for what is nearer, ray.length for all, below 0 ends.
    void visit_hits(const Ray& ray, const std::function<double(const RayHit&)>& visit,
                    const QueryFilter& filter = {}) const;

    /// Bodies with a shape whose own bounding box overlaps the box, in the order of bodies().
    std::vector<BodyId> bodies_in(const Bounds& box, const QueryFilter& filter = {}) const;
    /// Shapes that a ball or box, put there, would touch or overlap, by their ids.
    std::vector<ShapeId> overlapping(const Geometry& geometry, const Position& position,
                                     const Quat& rotation, const QueryFilter& filter = {}) const;
    /// The shape whose surface is nearest, no farther than `reach` m (>= 0, may be infinite), with
    /// the signed distance of the point to it.
    NearestHit closest_point(const Position& point,
                             double reach = std::numeric_limits<double>::infinity(),
                             const QueryFilter& filter = {}) const;

    /// Puts shapes that were created since the last step, which every question tries one by one,
    /// where a search finds them. A step does so by itself; this is for those who ask much of a
    /// world that was just built. Never changes an answer.
    void prepare_questions();

private:
    std::unique_ptr<WorldState> state_;
};

}  // namespace cairn
