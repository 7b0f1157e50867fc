// ODE: its iterative solver, dWorldQuickStep, with its defaults, and friction that knows the normal
// force (dContactApprox1; without it ODE's coefficient is a force).

#include <ode/ode.h>

#include "engine.h"

namespace cairn::bench {

namespace {

std::array<double, 3> to_array(const dReal* v) { return {v[0], v[1], v[2]}; }

class OdeEngine final : public Engine {
public:
    explicit OdeEngine(const BenchScene& scene)
        : world_(dWorldCreate()),
          space_(dHashSpaceCreate(nullptr)),
          contacts_(dJointGroupCreate(0)),
          friction_(scene.friction) {
        dWorldSetGravity(world_, 0, -scene.gravity, 0);
        for (const BoxBody& box : scene.boxes) {
            const std::array<double, 3>& h = box.half_extents;
            const dGeomID geometry = dCreateBox(space_, 2 * h[0], 2 * h[1], 2 * h[2]);
            geometries_.push_back(geometry);
            if (box.density > 0) {
                const dBodyID body = dBodyCreate(world_);
                dMass mass;
                dMassSetBox(&mass, box.density, 2 * h[0], 2 * h[1], 2 * h[2]);
                dBodySetMass(body, &mass);
                dGeomSetBody(geometry, body);
            }
            dGeomSetPosition(geometry, box.position[0], box.position[1], box.position[2]);
        }
    }

    ~OdeEngine() override {
        dJointGroupDestroy(contacts_);
        dSpaceDestroy(space_);
        dWorldDestroy(world_);
    }

    void step(double dt) override {
        dSpaceCollide(space_, this, &OdeEngine::collide);
        dWorldQuickStep(world_, dt);
        dJointGroupEmpty(contacts_);
    }

    BoxMotion motion(std::size_t box) const override {
        const dGeomID geometry = geometries_[box];
        dQuaternion q;  // w, x, y, z
        dGeomGetQuaternion(geometry, q);
        BoxMotion motion{.position = to_array(dGeomGetPosition(geometry)),
                         .rotation = {q[1], q[2], q[3], q[0]}};
        if (const dBodyID body = dGeomGetBody(geometry)) {
            motion.linear_velocity = to_array(dBodyGetLinearVel(body));
            motion.angular_velocity = to_array(dBodyGetAngularVel(body));
        }
        return motion;
    }

private:
    static void collide(void* engine, dGeomID a, dGeomID b) {
        constexpr int most_contacts = 8;
        auto* self = static_cast<OdeEngine*>(engine);
        dContact contacts[most_contacts];
        const int count = dCollide(a, b, most_contacts, &contacts[0].geom, sizeof(dContact));
        for (int i = 0; i < count; ++i) {
            contacts[i].surface = {};
            contacts[i].surface.mode = dContactApprox1;
            contacts[i].surface.mu = self->friction_;
            const dJointID joint = dJointCreateContact(self->world_, self->contacts_, &contacts[i]);
            dJointAttach(joint, dGeomGetBody(a), dGeomGetBody(b));
        }
    }

    dWorldID world_;
    dSpaceID space_;
    dJointGroupID contacts_;
    double friction_;
    std::vector<dGeomID> geometries_;
};

}  // namespace

std::vector<EngineEntry> ode_engines() {
    dInitODE2(0);
    return {{"ODE " dODE_VERSION " quickstep", "20 iterations, binary64",
             [](const BenchScene& scene) -> std::unique_ptr<Engine> {
                 return std::make_unique<OdeEngine>(scene);
             }}};
}

}  // namespace cairn::bench
