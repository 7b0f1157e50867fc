#pragma once
// What can be read from a world after a step: contacts with their impulses, events, energy,
// momentum, times, and what went wrong.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/ids.h"
#include "cairn/types.h"

namespace cairn {

struct ContactPointReport {
    Position position = {};    ///< halfway between the two surfaces, world
    float separation = 0;      ///< m, negative where the shapes overlap
    float normal_impulse = 0;  ///< N s over the last step, >= 0, on body b along the normal
    /// Which features of the two shapes meet here; stable while they do.
    std::uint32_t feature = 0;
};

/// One pair of shapes in touch, or about to be.
struct ContactReport {
    BodyId body_a, body_b;
    ShapeId shape_a, shape_b;
    Vec3 normal = {};  ///< unit, from a to b, world
    std::array<ContactPointReport, 4> points = {};
    int point_count = 0;
    Vec3 friction_impulse = {};  ///< N s on body b over the last step, across the normal
    float spinning_impulse = 0;  ///< N m s on body b about the normal, from spinning friction
    Vec3 rolling_impulse = {};   ///< N m s on body b, from rolling friction
};

enum class ContactEventKind : std::uint8_t { Begin, End };

/// Two shapes began to touch (some point's separation <= 0, or an impulse), or ceased to.
struct ContactEvent {
    ContactEventKind kind = ContactEventKind::Begin;
    BodyId body_a, body_b;
    ShapeId shape_a, shape_b;
};

struct Energy {
    double kinetic = 0;    ///< J
    double potential = 0;  ///< J: minus the sum of m gravity_scale g . x_com
    double total = 0;
};

struct Momentum {
    std::array<double, 3> linear = {};   ///< kg m/s
    std::array<double, 3> angular = {};  ///< kg m^2/s about the world's origin
};

struct Penetration {
    double deepest = 0;  ///< m, >= 0
    double mean = 0;     ///< m, over the points that overlap; 0 where none does
};

enum class Quantity : std::uint8_t { LinearVelocity, AngularVelocity, Position, Rotation };

/// A body whose numbers went wrong, frozen where it last was well.
struct NonFinite {
    BodyId body;
    std::uint64_t step = 0;  ///< counted from 1
    double time = 0;         ///< s, at the end of that step
    Quantity quantity = Quantity::LinearVelocity;
};

/// The stages of a step, in the order in which they run.
enum class Stage : std::uint8_t { FindPairs, FindAxes, BuildManifolds, Solve, Finish };
inline constexpr std::size_t stage_count = 5;
/// The stage's name in kebab-case: "find-pairs".
const char* stage_name(Stage stage);

struct StepReport {
    std::uint64_t step = 0;         ///< how many steps the world has taken
    double time = 0;                ///< s since the world began
    std::size_t pair_count = 0;     ///< pairs whose boxes overlap, of which one is awake
    std::size_t contact_count = 0;  ///< contact points of the step
    /// Pairs whose points were carried along from an earlier step, StepSettings::reuse_contacts.
    std::size_t reused_count = 0;
    std::size_t awake_count = 0;   ///< dynamic bodies that are not asleep, at its end
    std::size_t asleep_count = 0;  ///< and those that are
    /// Wall time; no part of the world's state.
    std::array<double, stage_count> stage_seconds = {};
};

}  // namespace cairn
