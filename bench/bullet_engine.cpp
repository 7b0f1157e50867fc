// Bullet: btDiscreteDynamicsWorld with its sequential impulse solver, at its defaults.
//
// Departures: Bullet multiplies the two friction coefficients of a pair, so each body gets the root
// of the scene's; a step is exactly one step, without interpolation.

#include <btBulletDynamicsCommon.h>

#include <cmath>

#include "engine.h"

namespace cairn::bench {

namespace {

btVector3 to_bullet(const Vector& v) {
    return {static_cast<btScalar>(v[0]), static_cast<btScalar>(v[1]), static_cast<btScalar>(v[2])};
}

btTransform to_bullet(const Vector& position, const Rotation& q) {
    return btTransform(btQuaternion(static_cast<btScalar>(q[0]), static_cast<btScalar>(q[1]),
                                    static_cast<btScalar>(q[2]), static_cast<btScalar>(q[3])),
                       to_bullet(position));
}

Vector to_vector(const btVector3& v) {
    return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

// Where a kinematic body is: Bullet asks at every step and takes its velocity from the answers.
class TurningState final : public btMotionState {
public:
    TurningState(const btTransform& start, const btVector3& angular_velocity, const double& time)
        : start_(start), angular_velocity_(angular_velocity), time_(time) {}

    void getWorldTransform(btTransform& pose) const override {
        pose = start_;
        const btScalar angle = angular_velocity_.length() * static_cast<btScalar>(time_);
        if (angle != 0) {
            pose.setRotation(btQuaternion(angular_velocity_.normalized(), angle) *
                             start_.getRotation());
        }
    }
    void setWorldTransform(const btTransform&) override {}

private:
    btTransform start_;
    btVector3 angular_velocity_;
    const double& time_;
};

class BulletEngine final : public Engine {
public:
    explicit BulletEngine(const BenchScene& scene)
        : dispatcher_(&configuration_),
          world_(&dispatcher_, &broad_phase_, &solver_, &configuration_) {
        world_.setGravity({0, static_cast<btScalar>(-scene.gravity), 0});
    }

    ~BulletEngine() override {
        for (const auto& body : bodies_) world_.removeRigidBody(body.get());
    }

    void add(const BenchScene& scene, const SceneBody& body) override {
        btCollisionShape* const shape = share_shape(scene, body);
        btScalar mass = 0;
        btVector3 inertia(0, 0, 0);
        if (body.mobility == Mobility::Dynamic) {
            mass = static_cast<btScalar>(body.density) * volume(scene.parts[body.first_part]);
            shape->calculateLocalInertia(mass, inertia);
        }
        btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape, inertia);
        info.m_startWorldTransform = to_bullet(body.position, body.rotation);
        info.m_friction = static_cast<btScalar>(std::sqrt(scene.friction));
        if (body.mobility == Mobility::Kinematic) {
            const auto& w = body.angular_velocity;
            states_.push_back(std::make_unique<TurningState>(info.m_startWorldTransform,
                                                             btVector3(w[0], w[1], w[2]), time_));
            info.m_motionState = states_.back().get();
        }
        bodies_.push_back(std::make_unique<btRigidBody>(info));
        btRigidBody& made = *bodies_.back();
        if (body.mobility == Mobility::Kinematic) {
            made.setCollisionFlags(made.getCollisionFlags() |
                                   btCollisionObject::CF_KINEMATIC_OBJECT);
        }
        if (body.mobility == Mobility::Kinematic ||
            (body.mobility == Mobility::Dynamic && !scene.may_sleep)) {
            made.setActivationState(DISABLE_DEACTIVATION);
        }
        world_.addRigidBody(&made);
    }

    void step(double dt) override {
        time_ += dt;
        world_.stepSimulation(static_cast<btScalar>(dt), 0);
    }

    BodyMotion motion(std::size_t body) const override {
        const btTransform& pose = bodies_[body]->getWorldTransform();
        const btQuaternion q = pose.getRotation();
        return {.position = to_vector(pose.getOrigin()),
                .rotation = {static_cast<double>(q.x()), static_cast<double>(q.y()),
                             static_cast<double>(q.z()), static_cast<double>(q.w())},
                .linear_velocity = to_vector(bodies_[body]->getLinearVelocity()),
                .angular_velocity = to_vector(bodies_[body]->getAngularVelocity())};
    }

    std::int64_t count_awake() const override {
        std::int64_t count = 0;
        for (const auto& body : bodies_) {
            count += !body->isStaticOrKinematicObject() && body->isActive() ? 1 : 0;
        }
        return count;
    }

    std::string settings() const override {
        return std::to_string(world_.getSolverInfo().m_numIterations) + " iterations";
    }

private:
    static btScalar volume(const Part& part) {
        const Vector& h = part.half_extents;
        constexpr double pi = 3.14159265358979323846;
        // Of a ball the cylinder between the ends is nothing.
        const double round =
            pi * part.radius * part.radius * (4.0 / 3 * part.radius + 2 * part.half_height);
        return static_cast<btScalar>(part.form == Form::Box ? 8 * h[0] * h[1] * h[2] : round);
    }

    btCollisionShape* share_part(const BenchScene& scene, std::uint32_t index) {
        if (parts_.size() <= index) parts_.resize(index + 1);
        if (!parts_[index]) {
            const Part& part = scene.parts[index];
            if (part.form == Form::Box) {
                parts_[index] = std::make_unique<btBoxShape>(to_bullet(part.half_extents));
            } else if (part.form == Form::Capsule) {
                parts_[index] =
                    std::make_unique<btCapsuleShape>(static_cast<btScalar>(part.radius),
                                                     static_cast<btScalar>(2 * part.half_height));
            } else {
                parts_[index] = std::make_unique<btSphereShape>(static_cast<btScalar>(part.radius));
            }
        }
        return parts_[index].get();
    }

    btCollisionShape* share_shape(const BenchScene& scene, const SceneBody& body) {
        if (body.part_count == 1) return share_part(scene, body.first_part);
        compounds_.push_back(std::make_unique<btCompoundShape>());
        for (std::uint32_t i = 0; i < body.part_count; ++i) {
            const Part& part = scene.parts[body.first_part + i];
            compounds_.back()->addChildShape(to_bullet(part.position, part.rotation),
                                             share_part(scene, body.first_part + i));
        }
        return compounds_.back().get();
    }

    double time_ = 0;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broad_phase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_;
    std::vector<std::unique_ptr<btCollisionShape>> parts_;
    std::vector<std::unique_ptr<btCompoundShape>> compounds_;
    std::vector<std::unique_ptr<TurningState>> states_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

}  // namespace

EngineDescription describe_engine() {
    return {.name = "Bullet",
            .version =
                std::to_string(btGetVersion() / 100) + "." + std::to_string(btGetVersion() % 100),
            .variants = {"bullet"}};
}

MadeEngine make_engine(const BenchScene& scene, const EngineRequest& request) {
    if (request.threads > 1) {
        return {.engine = {}, .problem = "its plain dynamics world steps on one thread"};
    }
    return {.engine = std::make_unique<BulletEngine>(scene), .problem = {}};
}

}  // namespace cairn::bench
