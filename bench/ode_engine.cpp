// ODE: its iterative solver, dWorldQuickStep, with its defaults.
//
// Departures: friction that knows the normal force (dContactApprox1; without it ODE's coefficient
// is a force), and up to 8 contacts a pair, both as its manual advises. Pairs that cannot push each
// other (fixed, or both asleep) are passed over, as its manual advises too.

#include <ode/ode.h>

#include <cmath>

#include "engine.h"

namespace cairn::bench {

namespace {

Vector to_vector(const dReal* v) { return {v[0], v[1], v[2]}; }

class OdeEngine final : public Engine {
public:
    explicit OdeEngine(const BenchScene& scene)
        : world_(dWorldCreate()),
          space_(dHashSpaceCreate(nullptr)),
          contacts_(dJointGroupCreate(0)),
          friction_(scene.friction) {
        dWorldSetGravity(world_, 0, -scene.gravity, 0);
        dWorldSetAutoDisableFlag(world_, scene.may_sleep ? 1 : 0);
    }

    ~OdeEngine() override {
        dJointGroupDestroy(contacts_);
        dSpaceDestroy(space_);
        dWorldDestroy(world_);
    }

    void add(const BenchScene& scene, const SceneBody& body) override {
        dBodyID made = nullptr;
        if (body.mobility != Mobility::Static) {
            made = dBodyCreate(world_);
            place(body, made);
        }
        for (std::uint32_t i = 0; i < body.part_count; ++i) {
            add_part(scene.parts[body.first_part + i], body, made);
        }
        bodies_.push_back(made);
        statics_.push_back(made != nullptr ? Vector{} : body.position);
    }

    void step(double dt) override {
        dSpaceCollide(space_, this, &OdeEngine::collide);
        dWorldQuickStep(world_, dt);
        dJointGroupEmpty(contacts_);
    }

    BodyMotion motion(std::size_t index) const override {
        const dBodyID body = bodies_[index];
        if (body == nullptr) return {.position = statics_[index]};
        const dReal* const q = dBodyGetQuaternion(body);  // w, x, y, z
        return {.position = to_vector(dBodyGetPosition(body)),
                .rotation = {q[1], q[2], q[3], q[0]},
                .linear_velocity = to_vector(dBodyGetLinearVel(body)),
                .angular_velocity = to_vector(dBodyGetAngularVel(body))};
    }

    std::int64_t count_awake() const override {
        std::int64_t count = 0;
        for (const dBodyID body : bodies_) {
            const bool moves = body != nullptr && dBodyIsKinematic(body) == 0;
            count += moves && dBodyIsEnabled(body) != 0 ? 1 : 0;
        }
        return count;
    }

    std::string settings() const override {
        return "quickstep, " + std::to_string(dWorldGetQuickStepNumIterations(world_)) +
               " iterations, binary64";
    }

private:
    static void place(const SceneBody& body, dBodyID made) {
        const Rotation& q = body.rotation;
        const dQuaternion rotation = {q[3], q[0], q[1], q[2]};
        dBodySetPosition(made, body.position[0], body.position[1], body.position[2]);
        dBodySetQuaternion(made, rotation);
        if (body.mobility == Mobility::Kinematic) {
            const auto& w = body.angular_velocity;
            dBodySetKinematic(made);
            dBodySetAngularVel(made, w[0], w[1], w[2]);
            dBodySetAutoDisableFlag(made, 0);
        }
    }

    void add_part(const Part& part, const SceneBody& body, dBodyID made) {
        const Vector& h = part.half_extents;
        const dGeomID geometry =
            part.form == Form::Box      ? dCreateBox(space_, 2 * h[0], 2 * h[1], 2 * h[2])
            : part.form == Form::Sphere ? dCreateSphere(space_, part.radius)
                                        : dCreateCapsule(space_, part.radius, 2 * part.half_height);
        if (made == nullptr) {
            dGeomSetPosition(geometry, body.position[0], body.position[1], body.position[2]);
            return;
        }
        dGeomSetBody(geometry, made);
        if (body.mobility == Mobility::Dynamic) {
            const auto density = static_cast<dReal>(body.density);
            dMass mass;
            if (part.form == Form::Box) dMassSetBox(&mass, density, 2 * h[0], 2 * h[1], 2 * h[2]);
            if (part.form == Form::Sphere) dMassSetSphere(&mass, density, part.radius);
            if (part.form == Form::Capsule) {
                constexpr int along_y = 2;
                dMassSetCapsule(&mass, density, along_y, part.radius, 2 * part.half_height);
                // Its capsules lie along z: a quarter turn about x brings that to y.
                const double half = std::sqrt(0.5);
                const dQuaternion z_to_y = {half, -half, 0, 0};
                dGeomSetOffsetQuaternion(geometry, z_to_y);
            }
            dBodySetMass(made, &mass);
        } else if (part.position != Vector{} || part.rotation != Rotation{0, 0, 0, 1}) {
            const Rotation& q = part.rotation;
            const dQuaternion rotation = {q[3], q[0], q[1], q[2]};
            dGeomSetOffsetPosition(geometry, part.position[0], part.position[1], part.position[2]);
            dGeomSetOffsetQuaternion(geometry, rotation);
        }
    }

    static void collide(void* engine, dGeomID a, dGeomID b) {
        constexpr int most_contacts = 8;
        auto* self = static_cast<OdeEngine*>(engine);
        const dBodyID body_a = dGeomGetBody(a);
        const dBodyID body_b = dGeomGetBody(b);
        const auto can_move = [](dBodyID body) {
            return body != nullptr && dBodyIsKinematic(body) == 0 && dBodyIsEnabled(body) != 0;
        };
        if (body_a == body_b || (!can_move(body_a) && !can_move(body_b))) return;
        dContact contacts[most_contacts];
        const int count = dCollide(a, b, most_contacts, &contacts[0].geom, sizeof(dContact));
        for (int i = 0; i < count; ++i) {
            contacts[i].surface = {};
            contacts[i].surface.mode = dContactApprox1;
            contacts[i].surface.mu = self->friction_;
            const dJointID joint = dJointCreateContact(self->world_, self->contacts_, &contacts[i]);
            dJointAttach(joint, body_a, body_b);
        }
    }

    dWorldID world_;
    dSpaceID space_;
    dJointGroupID contacts_;
    double friction_;
    std::vector<dBodyID> bodies_;
    std::vector<Vector> statics_;
};

}  // namespace

EngineDescription describe_engine() {
    return {.name = "ODE", .version = dODE_VERSION, .variants = {"ode"}};
}

MadeEngine make_engine(const BenchScene& scene, const EngineRequest& request) {
    if (request.threads > 1) {
        return {.engine = {}, .problem = "its step runs on one thread unless given a pool"};
    }
    dInitODE2(0);
    return {.engine = std::make_unique<OdeEngine>(scene), .problem = {}};
}

}  // namespace cairn::bench
