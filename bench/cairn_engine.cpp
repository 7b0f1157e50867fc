// Cairn, by its public headers alone. The plain variant is the library's default settings; the
// others name a solver.

#include "cairn/cairn.h"
#include "engine.h"

namespace cairn::bench {

namespace {

struct Variant {
    const char* name;
    Solver solver;
};

constexpr Variant variants[] = {
    {"cairn", StepSettings{}.solver},
    {"cairn:sequential-impulse", Solver::SequentialImpulse},
    {"cairn:soft-step", Solver::SoftStep},
    {"cairn:xpbd", Solver::Xpbd},
};

Vec3 to_vec3(const Vector& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

Quat to_quat(const Rotation& q) {
    return {static_cast<float>(q[0]), static_cast<float>(q[1]), static_cast<float>(q[2]),
            static_cast<float>(q[3])};
}

Vector to_vector(const Vec3& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

std::string say_count(int n, const char* what) {
    return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

class CairnEngine final : public Engine {
public:
    CairnEngine(const WorldSettings& settings, int threads) : world_(*World::create(settings)) {
        (void)world_.set_threads({.count = threads});
    }

    void add(const BenchScene& scene, const SceneBody& body) override {
        BodyDef def{.kind = body.mobility == Mobility::Dynamic     ? BodyKind::Dynamic
                            : body.mobility == Mobility::Kinematic ? BodyKind::Kinematic
                                                                   : BodyKind::Static,
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
            } else {
                shape.geometry = Sphere{static_cast<float>(part.radius)};
            }
            shape.material.friction = static_cast<float>(scene.friction);
            def.shapes.push_back(shape);
        }
        bodies_.push_back(*world_.create_body(def));
    }

    void step(double dt) override { (void)world_.step(dt); }

    BodyMotion motion(std::size_t body) const override {
        const BodyState state = world_.state(bodies_[body]);
        const Quat& q = state.rotation;
        return {.position = {state.position.x, state.position.y, state.position.z},
                .rotation = {static_cast<double>(q.x), static_cast<double>(q.y),
                             static_cast<double>(q.z), static_cast<double>(q.w)},
                .linear_velocity = to_vector(state.linear_velocity),
                .angular_velocity = to_vector(state.angular_velocity)};
    }

    std::int64_t count_awake() const override {
        std::int64_t count = 0;
        for (const BodyId body : bodies_) {
            const BodyState state = world_.state(body);
            count += state.kind == BodyKind::Dynamic && !state.asleep ? 1 : 0;
        }
        return count;
    }

    std::string settings() const override {
        const StepSettings& step = world_.settings().step;
        const int substeps = step.substeps > 0 ? step.substeps : default_substeps(step.solver);
        const int iterations =
            step.iterations > 0 ? step.iterations : default_iterations(step.solver);
        std::string name;
        for (const Variant& variant : variants) {
            const std::string_view full = variant.name;
            const std::size_t colon = full.find(':');
            if (variant.solver == step.solver && colon != full.npos) name = full.substr(colon + 1);
        }
        return name + ", " + say_count(substeps, "substep") + " of " +
               say_count(iterations, "iteration");
    }

private:
    World world_;
    std::vector<BodyId> bodies_;
};

}  // namespace

EngineDescription describe_engine() {
    EngineDescription description{.name = "Cairn", .version = version(), .variants = {}};
    for (const Variant& variant : variants) description.variants.push_back(variant.name);
    return description;
}

MadeEngine make_engine(const BenchScene& scene, const EngineRequest& request) {
    WorldSettings settings;
    settings.gravity = {0, static_cast<float>(-scene.gravity), 0};
    settings.sleeping = scene.may_sleep;
    for (const Variant& variant : variants) {
        if (variant.name == request.variant) settings.step.solver = variant.solver;
    }
    return {.engine = std::make_unique<CairnEngine>(settings, request.threads), .problem = {}};
}

}  // namespace cairn::bench
