// Cairn, by its public headers alone. The plain variant is the library's default settings; the
// others name a solver.

#include "cairn/cairn.h"
#include "cairn_scene.h"
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
        bodies_.push_back(*world_.create_body(describe_body(scene, body)));
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
    WorldSettings settings = describe_world(scene);
    for (const Variant& variant : variants) {
        if (variant.name == request.variant) settings.step.solver = variant.solver;
    }
    return {.engine = std::make_unique<CairnEngine>(settings, request.threads), .problem = {}};
}

}  // namespace cairn::bench
