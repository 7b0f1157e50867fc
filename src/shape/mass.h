#pragma once
// Mass, center of mass and inertia of shapes, in closed form, and of several shapes together.

#include <span>

#include "cairn/body.h"
#include "cairn/shape.h"

namespace cairn {

// What shapes of these densities weigh together, in the body's frame; worked in binary64, rounded
// once. A plane weighs nothing.
MassProperties combined_mass_properties(std::span<const ShapeDef> shapes);

}  // namespace cairn
