// Shapes and materials of a scene file.
//
// Reads: an element of "shapes". Writes: a ShapeDef with its material filled in. Shapes that later
// versions will know are refused by name.

#include <fmt/format.h>

#include <algorithm>

#include "scene/read_bodies.h"

namespace cairn::scene {

namespace {

constexpr std::string_view supported_shapes[] = {"sphere", "box", "capsule", "plane"};
constexpr std::string_view all_shapes[] = {"sphere", "box",       "capsule",     "cylinder",
                                           "cone",   "ellipsoid", "hull",        "compound",
                                           "plane",  "mesh",      "height_field"};

bool is_one_of(std::string_view word, std::span<const std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

// The keys that a kind of shape may have.
std::vector<std::string_view> list_shape_keys(std::string_view kind) {
    std::vector<std::string_view> keys = {"kind", "position", "rotation", "density", "material"};
    keys.insert(keys.end(), std::begin(material_keys), std::end(material_keys));
    keys.push_back("sensor");
    if (kind == "sphere") keys.push_back("radius");
    if (kind == "box") keys.insert(keys.end(), {"half_extents", "rounding"});
    if (kind == "capsule") keys.insert(keys.end(), {"radius", "height"});
    if (kind == "plane") keys.insert(keys.end(), {"normal", "offset"});
    return keys;
}

std::string_view read_shape_kind(const JsonValue& value, const Place& at) {
    if (value.kind != JsonValue::Kind::Object) {
        at.fail(
            fmt::format("found {}; allowed: an object that describes a shape", describe(value)));
    }
    const auto key = std::find(value.keys.begin(), value.keys.end(), "kind");
    const Place kind_at = {&at, "kind", 0};
    if (key == value.keys.end()) {
        kind_at.fail("missing; the key \"kind\" is required: " + list_words(supported_shapes));
    }
    const JsonValue& kind = value.items[static_cast<std::size_t>(key - value.keys.begin())];
    const std::string& word = read_string(kind, kind_at);
    if (is_one_of(word, supported_shapes)) return word;
    if (is_one_of(word, all_shapes)) {
        kind_at.fail(
            fmt::format("the shape \"{}\" is not yet supported by this version; supported: {}",
                        word, list_words(supported_shapes)));
    }
    const std::string_view near = find_nearest(word, supported_shapes);
    kind_at.fail(fmt::format("found {}{}; allowed: {}", describe(kind),
                             near.empty() ? "" : fmt::format(", did you mean \"{}\"?", near),
                             list_words(supported_shapes)));
}

Geometry read_geometry(std::string_view kind, const Fields& fields) {
    if (kind == "sphere") {
        Sphere sphere;
        fields.require("radius", "metres, greater than 0");
        fields.read("radius", sphere.radius, positive);
        return sphere;
    }
    if (kind == "box") {
        const JsonValue& half_extents = fields.require("half_extents", "[x, y, z], metres");
        return Box{read_vec3(half_extents, fields.place("half_extents"), positive)};
    }
    if (kind == "capsule") {
        Capsule capsule;
        fields.require("radius", "metres, greater than 0");
        fields.read("radius", capsule.radius, positive);
        fields.require("height", "metres, of the cylindrical part");
        fields.read("height", capsule.height, not_negative);
        return capsule;
    }
    Plane plane;
    fields.require("normal", "[x, y, z], out of the solid");
    fields.read("normal", plane.normal);
    fields.read("offset", plane.offset);
    if (plane.normal == Vec3{}) {
        fields.place("normal").fail("found a normal of length 0; allowed: any other length");
    }
    return plane;
}

Material read_shape_material(const Fields& fields, const std::vector<NamedMaterial>& materials,
                             std::string& material_name) {
    const JsonValue* name_value = fields.find("material");
    if (name_value == nullptr) return read_material_fields(fields);
    const Place at = fields.place("material");
    const std::string& name = read_string(*name_value, at);
    for (const std::string_view key : material_keys) {
        if (fields.find(key) != nullptr) {
            fields.place(key).fail(
                fmt::format("found beside \"material\": \"{}\"; allowed: a material by name, or "
                            "its fields in the "
                            "shape, not both",
                            make_printable(name)));
        }
    }
    std::vector<std::string_view> names;
    for (const NamedMaterial& material : materials) {
        if (material.name == name) {
            material_name = name;
            return material.material;
        }
        names.push_back(material.name);
    }
    const std::string_view near = find_nearest(name, names);
    if (names.size() > 20) names.resize(20);
    at.fail(fmt::format(
        "found \"{}\", which is no material of this scene{}; allowed: {}", make_printable(name),
        near.empty() ? "" : fmt::format(", did you mean \"{}\"?", make_printable(near)),
        names.empty() ? "none, \"materials\" is empty" : make_printable(list_words(names), 400)));
}

}  // namespace

Material read_material_fields(const Fields& fields) {
    Material material;
    fields.read("friction", material.friction, not_negative);
    fields.read("restitution", material.restitution, zero_to_one);
    fields.read("rolling_friction", material.rolling_friction, not_negative);
    fields.read("spinning_friction", material.spinning_friction, not_negative);
    fields.read("surface_velocity", material.surface_velocity);
    return material;
}

ShapeDef read_shape(const JsonValue& value, const Place& at, BodyKind body_kind,
                    const std::vector<NamedMaterial>& materials, std::string& material_name) {
    const std::string_view kind = read_shape_kind(value, at);
    const Fields fields(value, at, list_shape_keys(kind));
    ShapeDef def;
    def.geometry = read_geometry(kind, fields);
    fields.read("position", def.local_pose.position);
    fields.read("rotation", def.local_pose.rotation);
    fields.read("density", def.density, positive);
    def.material = read_shape_material(fields, materials, material_name);

    float rounding = 0;
    fields.read("rounding", rounding, not_negative);
    if (rounding > 0) {
        fields.place("rounding")
            .fail("\"rounding\" is not yet supported by this version; allowed: 0");
    }
    bool sensor = false;
    fields.read("sensor", sensor);
    if (sensor) {
        fields.place("sensor").fail(
            "sensors are not yet supported by this version; allowed: false");
    }
    if (kind == "plane" && body_kind != BodyKind::Static) {
        fields.place("kind").fail(
            fmt::format("found a plane on a {} body; allowed: planes on static "
                        "bodies",
                        body_kind == BodyKind::Dynamic ? "dynamic" : "kinematic"));
    }
    return def;
}

}  // namespace cairn::scene
