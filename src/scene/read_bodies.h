#pragma once
// The sections of a scene file that describe bodies and what they are made of. All throw a Fault.

#include "scene/fields.h"
#include "scene/scene.h"

namespace cairn::scene {

/// The materials' fields, as an object of the file's "materials" or as they stand in a shape.
inline constexpr std::string_view material_keys[] = {"friction", "restitution", "rolling_friction",
                                                     "spinning_friction", "surface_velocity"};
Material read_material_fields(const Fields& fields);

/// One shape; its material's name goes to `material_name`, empty where it has its own numbers.
ShapeDef read_shape(const JsonValue& value, const Place& at, BodyKind kind,
                    const std::vector<NamedMaterial>& materials, std::string& material_name);

/// An entry of "bodies": a body, or a repeat and its body.
SceneBody read_body_entry(const JsonValue& value, const Place& at,
                          const std::vector<NamedMaterial>& materials);

}  // namespace cairn::scene
