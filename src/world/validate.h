#pragma once
// What the public face refuses, and in which words: the argument, what was found, what is allowed.

#include <optional>
#include <string>
#include <string_view>

#include "cairn/world.h"

namespace cairn {

using Refusal = std::optional<Error>;

// The name of an argument, as a chain of parts that becomes a string only where something is
// refused.
class Path {
public:
    Path(const char* part) : part_(part) {}
    Path(std::string_view part) : part_(part) {}
    Path(const Path& parent, std::string_view part) : parent_(&parent), part_(part) {}
    std::string text() const {
        std::string text = parent_ ? parent_->text() : std::string();
        return text.append(part_);
    }

private:
    const Path* parent_ = nullptr;  // outlives this: both are temporaries of one call
    std::string_view part_;
};

// Lengths a shape may have, and the largest coordinate, speed, force or other quantity: beyond them
// binary32 products overflow. All are far outside anything that a simulation could mean.
inline constexpr float smallest_length = 1e-9f;
inline constexpr float largest_length = 1e9f;
inline constexpr double largest_quantity = 1e15;

Refusal check_finite(const Path& name, double value);
Refusal check_finite(const Path& name, const Vec3& value);
Refusal check_position(const Path& name, const Position& value);
Refusal check_rotation(const Path& name, const Quat& value);
Refusal check_at_least(const Path& name, double value, double least);
Refusal check_positive(const Path& name, double value);
Refusal check_material(const Path& name, const Material& material);
Refusal check_mass_properties(const Path& name, const MassProperties& properties);
Refusal check_shape(const Path& name, const ShapeDef& def, BodyKind kind);
Refusal check_settings(const WorldSettings& settings);
// Everything in the definition but the mass that results from it.
Refusal check_body(const BodyDef& def);

}  // namespace cairn
