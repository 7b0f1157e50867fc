#pragma once
// Detection: which shapes meet, along which axis, at which points. The first three stages of a
// step, and what World::contacts() measures anew between steps.

#include "world/world_state.h"

namespace cairn {

// The pairs of shapes that may touch in this step: boxes overlap, bodies differ, filters agree, and
// one of the bodies is looked at (sleep.h). Sorted, and the same whichever broad phase finds them:
// the tree's pairs of fat boxes are put to the same test.
void find_step_pairs(WorldState& world, Team& team, double dt, LargeArray<Pair>& pairs);
// The same between steps, at the present poses and of all bodies, those that rest included.
void find_present_pairs(const WorldState& world, double dt, LargeArray<Pair>& pairs);

// Between steps every shape lies within its box in the tree, or is listed as not there yet: what
// was changed or went farther than foreseen is given a new box at once, as the next step would.
void keep_in_tree(WorldState& world, std::uint32_t body);
// Puts into the tree what is not there yet.
void complete_tree(WorldState& world);
// The shape's own bounding box as it stands.
Aabb find_present_box(const WorldState& world, const ShapeRecord& shape);

// What a body has gone in a step that it began with the motion `before`. False where that is
// farther than was foreseen when its boxes were made.
bool add_to_way(WorldState& world, std::uint32_t body, const BodyMotion& before);
// How far all that move may go in dt seconds.
void look_ahead(WorldState& world, Team& team, double dt);
// Whether a pair that was apart cannot have come within reach since, nor come there in this step.
bool is_apart(const WorldState& world, const PairRecord& pair);
// The shapes were just measured to be so far apart.
void remember_apart(const WorldState& world, PairRecord& pair, float separation);

// Who meets, and what their surfaces do together.
void describe_contact(const WorldState& world, Contact& contact);
// The surfaces' own velocity, which turns with the bodies.
void turn_surface_velocity(const WorldState& world, Contact& contact);

// Along which axis two shapes meet, and how far apart they may be and still touch within dt
// seconds. Of shapes out of reach the axis may be any that shows it, unless `exactly`. False where
// the numbers are beyond binary32.
bool find_meeting(const WorldState& world, std::uint32_t shape_a, std::uint32_t shape_b, double dt,
                  bool exactly, AxisHint& hint, Meeting& meeting);

// Renews the contact's normal and its points, up to four, which have no forces and impulses yet.
// Points farther apart than `max_separation` are left out.
void build_contact_points(const WorldState& world, const Meeting& meeting, float max_separation,
                          Contact& contact);

// Brings the pair's contact to the present from what was found in an earlier step, where the bodies
// have hardly moved against each other since (contact/reuse.h); false where it must be found anew.
bool follow_contact(WorldState& world, const PairRecord& pair);
// What was just found, for that.
void remember_contact(WorldState& world, PairRecord& pair, const Meeting& meeting);

}  // namespace cairn
