#pragma once
// Where a shape is in the world, and whose filters agree: what detection and questions share.

#include "world/world_state.h"

namespace cairn {

inline bool agree(const CollisionFilter& a, const CollisionFilter& b) {
    if (a.group == b.group && a.group != 0) return a.group > 0;
    return (a.mask & b.category) != 0 && (b.mask & a.category) != 0;
}

// From the body's center of mass to the shape's origin, along world axes.
inline Vec3 shape_offset(const WorldState& world, const ShapeRecord& shape) {
    if (shape.seat == nothing) return {};
    const Vec3 offset = world.seats[shape.seat].offset;
    return offset == Vec3{} ? Vec3{} : rotate(world.rotations[shape.body], offset);
}

inline Quat shape_rotation(const WorldState& world, const ShapeRecord& shape) {
    const Quat rotation = world.rotations[shape.body];
    if (shape.seat == nothing) return rotation;
    const ShapeSeat& seat = world.seats[shape.seat];
    return seat.is_turned ? rotation * seat.local_pose.rotation : rotation;
}

inline Position shape_position(const WorldState& world, const ShapeRecord& shape) {
    return world.positions[shape.body] + shape_offset(world, shape);
}

}  // namespace cairn
