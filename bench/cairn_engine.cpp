// Cairn, once with each solver, at its default budget.

#include "cairn/cairn.h"
#include "engine.h"

namespace cairn::bench {

namespace {

Vec3 to_vec3(const std::array<double, 3>& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

std::array<double, 3> to_array(const Vec3& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

class CairnEngine final : public Engine {
public:
    CairnEngine(const BenchScene& scene, Solver solver) {
        world_ = *World::create(
            {.gravity = {0, static_cast<float>(-scene.gravity), 0}, .step = {.solver = solver}});
        for (const BoxBody& box : scene.boxes) {
            BodyDef def;
            def.kind = box.density > 0 ? BodyKind::Dynamic : BodyKind::Static;
            def.position = {box.position[0], box.position[1], box.position[2]};
            ShapeDef shape{.geometry = Box{to_vec3(box.half_extents)}};
            if (box.density > 0) shape.density = static_cast<float>(box.density);
            shape.material.friction = static_cast<float>(scene.friction);
            def.shapes.push_back(shape);
            bodies_.push_back(*world_.create_body(def));
        }
    }

    void step(double dt) override { (void)world_.step(dt); }

    BoxMotion motion(std::size_t box) const override {
        const BodyState state = world_.state(bodies_[box]);
        const Quat& q = state.rotation;
        return {.position = {state.position.x, state.position.y, state.position.z},
                .rotation = {static_cast<double>(q.x), static_cast<double>(q.y),
                             static_cast<double>(q.z), static_cast<double>(q.w)},
                .linear_velocity = to_array(state.linear_velocity),
                .angular_velocity = to_array(state.angular_velocity)};
    }

private:
    World world_;
    std::vector<BodyId> bodies_;
};

std::string count(int n, const char* what) {
    return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

std::string budget(Solver solver) {
    return count(default_substeps(solver), "substep") + " of " +
           count(default_iterations(solver), "iteration");
}

}  // namespace

std::vector<EngineEntry> cairn_engines() {
    const std::string name = std::string("Cairn ") + version();
    return {{name + " sequential-impulse", budget(Solver::SequentialImpulse),
             [](const BenchScene& scene) -> std::unique_ptr<Engine> {
                 return std::make_unique<CairnEngine>(scene, Solver::SequentialImpulse);
             }},
            {name + " xpbd", budget(Solver::Xpbd),
             [](const BenchScene& scene) -> std::unique_ptr<Engine> {
                 return std::make_unique<CairnEngine>(scene, Solver::Xpbd);
             }}};
}

}  // namespace cairn::bench
