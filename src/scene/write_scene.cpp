// A Scene to the text of a scene file.
//
// Reads: a Scene. Writes: JSON that reads back to the same bits. What has its default is left out
// of bodies and shapes, and written out in "world" and "step", where a reader wants to see it.

#include "scene/json_writer.h"
#include "scene/scene.h"

namespace cairn::scene {

namespace {

void write_material_fields(JsonWriter& json, const Material& material) {
    const Material plain;
    if (material.friction != plain.friction) json.member("friction", material.friction);
    if (material.restitution != plain.restitution) json.member("restitution", material.restitution);
    if (material.rolling_friction != plain.rolling_friction) {
        json.member("rolling_friction", material.rolling_friction);
    }
    if (material.spinning_friction != plain.spinning_friction) {
        json.member("spinning_friction", material.spinning_friction);
    }
    if (material.surface_velocity != plain.surface_velocity) {
        json.member("surface_velocity", material.surface_velocity);
    }
}

void write_shape(JsonWriter& json, const ShapeDef& shape, const std::string& material_name) {
    const ShapeDef plain;
    json.begin_object(Layout::Inline);
    if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
        json.member("kind", "sphere").member("radius", sphere->radius);
    } else if (const auto* box = std::get_if<Box>(&shape.geometry)) {
        json.member("kind", "box").member("half_extents", box->half_extents);
    } else if (const auto* capsule = std::get_if<Capsule>(&shape.geometry)) {
        json.member("kind", "capsule")
            .member("radius", capsule->radius)
            .member("height", capsule->height);
    } else if (const auto* plane = std::get_if<Plane>(&shape.geometry)) {
        json.member("kind", "plane")
            .member("normal", plane->normal)
            .member("offset", plane->offset);
    }
    if (shape.local_pose.position != Vec3{}) json.member("position", shape.local_pose.position);
    if (shape.local_pose.rotation != Quat{}) json.member("rotation", shape.local_pose.rotation);
    if (shape.density != plain.density) json.member("density", shape.density);
    if (!material_name.empty()) {
        json.member("material", material_name);
    } else {
        write_material_fields(json, shape.material);
    }
    json.end();
}

void write_lock(JsonWriter& json, const LockedAxes& lock) {
    json.key("lock").begin_array(Layout::Inline);
    if (lock.x) json.value("x");
    if (lock.y) json.value("y");
    if (lock.z) json.value("z");
    if (lock.rx) json.value("rx");
    if (lock.ry) json.value("ry");
    if (lock.rz) json.value("rz");
    json.end();
}

// A zero that has a sign differs from the default, though it compares equal.
template <class T>
bool has_default_bits(const T& value) {
    std::string given, plain;
    JsonWriter a, b;
    a.value(value);
    b.value(T{});
    return a.take() == b.take();
}

void write_motion(JsonWriter& json, const BodyDef& def) {
    const BodyDef plain;
    if (!has_default_bits(def.position)) json.member("position", def.position);
    if (!has_default_bits(def.rotation)) json.member("rotation", def.rotation);
    if (!has_default_bits(def.linear_velocity)) json.member("linear_velocity", def.linear_velocity);
    if (!has_default_bits(def.angular_velocity)) {
        json.member("angular_velocity", def.angular_velocity);
    }
    if (def.mass) json.member("mass", *def.mass);
    if (def.mass_properties) {
        json.key("mass_properties").begin_object(Layout::Inline);
        json.member("mass", def.mass_properties->mass);
        json.member("center_of_mass", def.mass_properties->center_of_mass);
        json.member("inertia", def.mass_properties->inertia);
        json.end();
    }
    if (def.gravity_scale != plain.gravity_scale) json.member("gravity_scale", def.gravity_scale);
    if (def.linear_damping != plain.linear_damping)
        json.member("linear_damping", def.linear_damping);
    if (def.angular_damping != plain.angular_damping) {
        json.member("angular_damping", def.angular_damping);
    }
    if (!def.gyroscopic) json.member("gyroscopic", false);
    if (def.force != plain.force) json.member("force", def.force);
    if (def.torque != plain.torque) json.member("torque", def.torque);
    if (def.lock != plain.lock) write_lock(json, def.lock);
}

void write_body(JsonWriter& json, const SceneBody& body) {
    const BodyDef& def = body.def;
    json.begin_object(def.shapes.size() > 1 ? Layout::Lines : Layout::Inline);
    if (!body.name.empty()) json.member("name", body.name);
    if (def.kind == BodyKind::Static) json.member("kind", "static");
    if (def.kind == BodyKind::Kinematic) json.member("kind", "kinematic");
    write_motion(json, def);
    if (!def.can_sleep) json.member("can_sleep", false);
    if (body.continuous) json.member("continuous", true);
    if (def.collision != CollisionFilter{}) {
        json.key("collision").begin_object(Layout::Inline);
        json.member("category", std::int64_t{def.collision.category});
        json.member("mask", std::int64_t{def.collision.mask});
        json.member("group", std::int64_t{def.collision.group});
        json.end();
    }
    json.key("shapes").begin_array();
    for (std::size_t i = 0; i < def.shapes.size(); ++i) {
        write_shape(json, def.shapes[i],
                    i < body.materials.size() ? body.materials[i] : std::string{});
    }
    json.end().end();
}

void write_entry(JsonWriter& json, const SceneBody& body) {
    if (!body.repeat) return write_body(json, body);
    const Repeat& repeat = *body.repeat;
    json.begin_object();
    json.key("repeat").begin_object(Layout::Inline);
    json.key("count").begin_array(Layout::Inline);
    for (const std::int64_t count : repeat.count) json.value(count);
    json.end();
    json.member("spacing", repeat.spacing);
    if (repeat.jitter > 0) json.member("jitter", repeat.jitter).member("seed", repeat.seed);
    json.end();
    json.key("body");
    write_body(json, body);
    json.end();
}

void write_step(JsonWriter& json, const Scene& scene) {
    const StepSettings& step = scene.world.step;
    json.key("step").begin_object();
    json.member("dt", scene.dt).member("solver", solver_name(step.solver));
    if (step.substeps != 0) json.member("substeps", step.substeps);
    if (step.iterations != 0) json.member("iterations", step.iterations);
    json.member("narrow_phase", narrow_phase_name(step.narrow_phase));
    json.member("broad_phase", broad_phase_name(step.broad_phase));
    json.end();
}

}  // namespace

std::string write_scene(const Scene& scene) {
    JsonWriter json;
    json.begin_object();
    json.member("cairn", 1).member("name", scene.name).member("description", scene.description);
    json.member("duration", scene.duration);
    json.key("world").begin_object();
    json.member("gravity", scene.world.gravity).member("sleeping", scene.world.sleeping);
    if (scene.world.sleep_time != WorldSettings{}.sleep_time)
        json.member("sleep_time", scene.world.sleep_time);
    json.member("continuous", scene.continuous);
    json.member("restitution_threshold", scene.world.restitution_threshold).end();
    write_step(json, scene);
    if (!scene.materials.empty()) {
        json.key("materials").begin_object();
        for (const NamedMaterial& material : scene.materials) {
            json.key(material.name).begin_object(Layout::Inline);
            write_material_fields(json, material.material);
            json.end();
        }
        json.end();
    }
    json.key("bodies").begin_array();
    for (const SceneBody& body : scene.bodies) write_entry(json, body);
    json.end();
    json.key("camera").begin_object(Layout::Inline);
    json.member("eye", scene.camera.eye).member("target", scene.camera.target).end();
    json.end();
    return json.take();
}

}  // namespace cairn::scene
