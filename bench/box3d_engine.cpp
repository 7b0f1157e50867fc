// Box3D by its C interface, at its defaults: 4 substeps, contacts recycled, continuous collision.
//
// Departure: it is told in advance how many bodies there will be, as its own benchmarks do.

#include <box3d/box3d.h>

#include <algorithm>

#include "engine.h"
#include "overlap.h"

namespace cairn::bench {

namespace {

constexpr int substeps = 4;

b3Vec3 to_box3d(const Vector& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

b3Quat to_box3d(const Rotation& q) {
    return {{static_cast<float>(q[0]), static_cast<float>(q[1]), static_cast<float>(q[2])},
            static_cast<float>(q[3])};
}

Vector to_vector(const b3Vec3& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

class Box3dEngine final : public Engine {
public:
    Box3dEngine(const BenchScene& scene, int threads) {
        b3WorldDef def = b3DefaultWorldDef();
        def.gravity = {0, static_cast<float>(-scene.gravity), 0};
        def.enableSleep = scene.may_sleep;
        def.workerCount = static_cast<std::uint32_t>(threads);
        for (const SceneBody& body : scene.bodies) {
            const bool is_static = body.mobility == Mobility::Static;
            (is_static ? def.capacity.staticBodyCount : def.capacity.dynamicBodyCount) += 1;
            (is_static ? def.capacity.staticShapeCount : def.capacity.dynamicShapeCount) +=
                static_cast<int>(body.part_count);
        }
        world_ = b3CreateWorld(&def);
    }

    ~Box3dEngine() override { b3DestroyWorld(world_); }

    void add(const BenchScene& scene, const SceneBody& body) override {
        b3BodyDef def = b3DefaultBodyDef();
        def.type = body.mobility == Mobility::Dynamic     ? b3_dynamicBody
                   : body.mobility == Mobility::Kinematic ? b3_kinematicBody
                                                          : b3_staticBody;
        const b3Vec3 position = to_box3d(body.position);
        def.position = b3ToPos(position);
        def.rotation = to_box3d(body.rotation);
        const auto& w = body.angular_velocity;
        def.angularVelocity = {w[0], w[1], w[2]};
        const b3BodyId made = b3CreateBody(world_, &def);

        b3ShapeDef shape = b3DefaultShapeDef();
        shape.density = body.density;
        shape.baseMaterial.friction = static_cast<float>(scene.friction);
        for (std::uint32_t i = 0; i < body.part_count; ++i) {
            const Part& part = scene.parts[body.first_part + i];
            if (part.form == Form::Box) {
                const b3Vec3 h = to_box3d(part.half_extents);
                const b3BoxHull box = b3MakeTransformedBoxHull(
                    h.x, h.y, h.z, {to_box3d(part.position), to_box3d(part.rotation)});
                b3CreateHullShape(made, &shape, &box.base);
            } else if (part.form == Form::Capsule) {
                const Vector arm = turn(part.rotation, {0, part.half_height, 0});
                const Vector& p = part.position;
                const b3Capsule capsule = {
                    to_box3d(Vector{p[0] - arm[0], p[1] - arm[1], p[2] - arm[2]}),
                    to_box3d(Vector{p[0] + arm[0], p[1] + arm[1], p[2] + arm[2]}),
                    static_cast<float>(part.radius)};
                b3CreateCapsuleShape(made, &shape, &capsule);
            } else {
                const b3Sphere sphere = {to_box3d(part.position), static_cast<float>(part.radius)};
                b3CreateSphereShape(made, &shape, &sphere);
            }
        }
        bodies_.push_back(made);
    }

    void step(double dt) override { b3World_Step(world_, static_cast<float>(dt), substeps); }

    BodyMotion motion(std::size_t body) const override {
        const b3BodyId id = bodies_[body];
        const b3Quat q = b3Body_GetRotation(id);
        return {.position = to_vector(b3ToVec3(b3Body_GetPosition(id))),
                .rotation = {static_cast<double>(q.v.x), static_cast<double>(q.v.y),
                             static_cast<double>(q.v.z), static_cast<double>(q.s)},
                .linear_velocity = to_vector(b3Body_GetLinearVelocity(id)),
                .angular_velocity = to_vector(b3Body_GetAngularVelocity(id))};
    }

    std::int64_t count_awake() const override {
        return std::count_if(bodies_.begin(), bodies_.end(), [](b3BodyId id) {
            return b3Body_GetType(id) == b3_dynamicBody && b3Body_IsAwake(id);
        });
    }

    std::string settings() const override { return std::to_string(substeps) + " substeps"; }

private:
    b3WorldId world_ = {};
    std::vector<b3BodyId> bodies_;
};

}  // namespace

EngineDescription describe_engine() {
    const b3Version version = b3GetVersion();
    return {.name = "Box3D",
            .version = std::to_string(version.major) + "." + std::to_string(version.minor) + "." +
                       std::to_string(version.revision),
            .variants = {"box3d"}};
}

MadeEngine make_engine(const BenchScene& scene, const EngineRequest& request) {
    return {.engine = std::make_unique<Box3dEngine>(scene, request.threads), .problem = {}};
}

}  // namespace cairn::bench
