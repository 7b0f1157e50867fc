// Bullet: its sequential impulse solver with its defaults.

#include <btBulletDynamicsCommon.h>

#include <cmath>

#include "engine.h"

namespace cairn::bench {

namespace {

btVector3 to_bullet(const std::array<double, 3>& v) {
    return {static_cast<btScalar>(v[0]), static_cast<btScalar>(v[1]), static_cast<btScalar>(v[2])};
}

std::array<double, 3> to_array(const btVector3& v) {
    return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

class BulletEngine final : public Engine {
public:
    explicit BulletEngine(const BenchScene& scene)
        : dispatcher_(&configuration_),
          world_(&dispatcher_, &broad_phase_, &solver_, &configuration_) {
        world_.setGravity({0, static_cast<btScalar>(-scene.gravity), 0});
        // Bullet multiplies the two coefficients of a pair.
        const auto friction = static_cast<btScalar>(std::sqrt(scene.friction));
        for (const BoxBody& box : scene.boxes) {
            const std::array<double, 3>& h = box.half_extents;
            const auto mass = static_cast<btScalar>(8 * h[0] * h[1] * h[2] * box.density);
            shapes_.push_back(std::make_unique<btBoxShape>(to_bullet(h)));
            btVector3 inertia(0, 0, 0);
            if (mass > 0) shapes_.back()->calculateLocalInertia(mass, inertia);
            btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shapes_.back().get(),
                                                          inertia);
            info.m_startWorldTransform.setOrigin(to_bullet(box.position));
            info.m_friction = friction;
            bodies_.push_back(std::make_unique<btRigidBody>(info));
            bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
            world_.addRigidBody(bodies_.back().get());
        }
    }

    ~BulletEngine() override {
        for (const auto& body : bodies_) world_.removeRigidBody(body.get());
    }

    // No substeps of its own: exactly one step of dt.
    void step(double dt) override { world_.stepSimulation(static_cast<btScalar>(dt), 0); }

    BoxMotion motion(std::size_t box) const override {
        const btTransform& pose = bodies_[box]->getWorldTransform();
        const btQuaternion q = pose.getRotation();
        return {.position = to_array(pose.getOrigin()),
                .rotation = {static_cast<double>(q.x()), static_cast<double>(q.y()),
                             static_cast<double>(q.z()), static_cast<double>(q.w())},
                .linear_velocity = to_array(bodies_[box]->getLinearVelocity()),
                .angular_velocity = to_array(bodies_[box]->getAngularVelocity())};
    }

private:
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broad_phase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_;
    std::vector<std::unique_ptr<btBoxShape>> shapes_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

}  // namespace

std::vector<EngineEntry> bullet_engines() {
    const std::string version =
        std::to_string(btGetVersion() / 100) + "." + std::to_string(btGetVersion() % 100);
    return {{"Bullet " + version, "10 iterations",
             [](const BenchScene& scene) -> std::unique_ptr<Engine> {
                 return std::make_unique<BulletEngine>(scene);
             }}};
}

}  // namespace cairn::bench
