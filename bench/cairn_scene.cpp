// From plain data to definitions; see cairn_scene.h.

#include "cairn_scene.h"

namespace cairn::bench {

namespace {

Vec3 to_vec3(const Vector& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

Quat to_quat(const Rotation& q) {
    return {static_cast<float>(q[0]), static_cast<float>(q[1]), static_cast<float>(q[2]),
            static_cast<float>(q[3])};
}

BodyKind to_kind(Mobility mobility) {
    switch (mobility) {
        case Mobility::Dynamic: return BodyKind::Dynamic;
        case Mobility::Kinematic: return BodyKind::Kinematic;
        case Mobility::Static: break;
    }
    return BodyKind::Static;
}

}  // namespace

WorldSettings describe_world(const BenchScene& scene) {
    WorldSettings settings;
    settings.gravity = {0, static_cast<float>(-scene.gravity), 0};
    settings.sleeping = scene.may_sleep;
    return settings;
}

BodyDef describe_body(const BenchScene& scene, const SceneBody& body) {
    BodyDef def{.kind = to_kind(body.mobility),
                .position = {body.position[0], body.position[1], body.position[2]},
                .rotation = to_quat(body.rotation),
                .angular_velocity = {body.angular_velocity[0], body.angular_velocity[1],
                                     body.angular_velocity[2]}};
    def.shapes.reserve(body.part_count);
    for (std::uint32_t i = 0; i < body.part_count; ++i) {
        const Part& part = scene.parts[body.first_part + i];
        ShapeDef shape{.local_pose = {to_vec3(part.position), to_quat(part.rotation)},
                       .density = body.density};
        if (part.form == Form::Box) {
            shape.geometry = Box{to_vec3(part.half_extents)};
        } else if (part.form == Form::Capsule) {
            shape.geometry =
                Capsule{static_cast<float>(part.radius), static_cast<float>(2 * part.half_height)};
        } else {
            shape.geometry = Sphere{static_cast<float>(part.radius)};
        }
        shape.material.friction = static_cast<float>(scene.friction);
        def.shapes.push_back(shape);
    }
    return def;
}

}  // namespace cairn::bench
