// Jolt: PhysicsSystem at its default settings, a thread pool where more than one thread is asked
// for.
//
// Departures: no damping (its default is 0.05 a second), for the scenes have none; and buffers
// large enough for every scene, since Jolt drops contacts without a word when one is full.

#include <Jolt/Jolt.h>
// Jolt.h comes before all else of Jolt's.
#include <Jolt/Core/Factory.h>
#include <Jolt/Core/JobSystemSingleThreaded.h>
#include <Jolt/Core/JobSystemThreadPool.h>
#include <Jolt/Core/TempAllocator.h>
#include <Jolt/Physics/Body/BodyCreationSettings.h>
#include <Jolt/Physics/Collision/BroadPhase/BroadPhaseLayerInterfaceTable.h>
#include <Jolt/Physics/Collision/BroadPhase/ObjectVsBroadPhaseLayerFilterTable.h>
#include <Jolt/Physics/Collision/ObjectLayerPairFilterTable.h>
#include <Jolt/Physics/Collision/Shape/BoxShape.h>
#include <Jolt/Physics/Collision/Shape/CapsuleShape.h>
#include <Jolt/Physics/Collision/Shape/SphereShape.h>
#include <Jolt/Physics/Collision/Shape/StaticCompoundShape.h>
#include <Jolt/Physics/PhysicsSystem.h>
#include <Jolt/RegisterTypes.h>

#include <algorithm>

#include "engine.h"

namespace cairn::bench {

namespace {

constexpr JPH::ObjectLayer still_layer = 0;
constexpr JPH::ObjectLayer moving_layer = 1;
constexpr JPH::uint layer_count = 2;

// The installation's own choice, which its headers pass on.
#if defined(JPH_USE_AVX512)
constexpr const char* instructions = "AVX-512";
#elif defined(JPH_USE_AVX2)
constexpr const char* instructions = "AVX2";
#else
constexpr const char* instructions = "SSE";
#endif

JPH::Vec3 to_jolt(const Vector& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

JPH::Quat to_jolt(const Rotation& q) {
    return {static_cast<float>(q[0]), static_cast<float>(q[1]), static_cast<float>(q[2]),
            static_cast<float>(q[3])};
}

template <class JoltVector>
Vector to_vector(const JoltVector& v) {
    return {static_cast<double>(v.GetX()), static_cast<double>(v.GetY()),
            static_cast<double>(v.GetZ())};
}

// What stands still meets what moves; what moves meets everything.
struct Layers {
    JPH::ObjectLayerPairFilterTable pairs{layer_count};
    JPH::BroadPhaseLayerInterfaceTable broad{layer_count, layer_count};
    // Reads the two others when it is made, so it is made once they are complete.
    std::unique_ptr<JPH::ObjectVsBroadPhaseLayerFilterTable> filter = fill();

private:
    std::unique_ptr<JPH::ObjectVsBroadPhaseLayerFilterTable> fill() {
        pairs.EnableCollision(still_layer, moving_layer);
        pairs.EnableCollision(moving_layer, moving_layer);
        broad.MapObjectToBroadPhaseLayer(still_layer, JPH::BroadPhaseLayer(still_layer));
        broad.MapObjectToBroadPhaseLayer(moving_layer, JPH::BroadPhaseLayer(moving_layer));
        return std::make_unique<JPH::ObjectVsBroadPhaseLayerFilterTable>(broad, layer_count, pairs,
                                                                         layer_count);
    }
};

class JoltEngine final : public Engine {
public:
    JoltEngine(const BenchScene& scene, int threads) : allocator_(256 << 20) {
        if (threads > 1) {
            jobs_ = std::make_unique<JPH::JobSystemThreadPool>(
                JPH::cMaxPhysicsJobs, JPH::cMaxPhysicsBarriers, threads - 1);
        } else {
            jobs_ = std::make_unique<JPH::JobSystemSingleThreaded>(JPH::cMaxPhysicsJobs);
        }
        const auto moving = static_cast<JPH::uint>(
            std::count_if(scene.bodies.begin(), scene.bodies.end(),
                          [](const SceneBody& body) { return body.mobility != Mobility::Static; }));
        const JPH::uint pairs = std::max(65536u, 16 * moving);
        system_.Init(static_cast<JPH::uint>(scene.bodies.size()), 0, pairs, pairs, layers_.broad,
                     *layers_.filter, layers_.pairs);
        system_.SetGravity({0, static_cast<float>(-scene.gravity), 0});
        JPH::PhysicsSettings settings = system_.GetPhysicsSettings();
        settings.mAllowSleeping = scene.may_sleep;
        system_.SetPhysicsSettings(settings);
    }

    void add(const BenchScene& scene, const SceneBody& body) override {
        const bool is_static = body.mobility == Mobility::Static;
        JPH::BodyCreationSettings def(
            share_shape(scene, body), JPH::RVec3(to_jolt(body.position)), to_jolt(body.rotation),
            is_static                            ? JPH::EMotionType::Static
            : body.mobility == Mobility::Dynamic ? JPH::EMotionType::Dynamic
                                                 : JPH::EMotionType::Kinematic,
            is_static ? still_layer : moving_layer);
        def.mFriction = static_cast<float>(scene.friction);
        def.mLinearDamping = 0;
        def.mAngularDamping = 0;
        const auto& w = body.angular_velocity;
        def.mAngularVelocity = {w[0], w[1], w[2]};
        JPH::BodyInterface& interface = system_.GetBodyInterfaceNoLock();
        bodies_.push_back(interface.CreateBody(def)->GetID());
        if (is_built_) {
            interface.AddBody(bodies_.back(), JPH::EActivation::Activate);
            return;
        }
        (is_static ? still_ : moving_).push_back(bodies_.back());
    }

    // In batches, as its manual asks of whoever adds many.
    void finish_building() override {
        JPH::BodyInterface& interface = system_.GetBodyInterfaceNoLock();
        for (std::vector<JPH::BodyID>* batch : {&still_, &moving_}) {
            const auto count = static_cast<int>(batch->size());
            if (count == 0) continue;
            const auto state = interface.AddBodiesPrepare(batch->data(), count);
            interface.AddBodiesFinalize(
                batch->data(), count, state,
                batch == &moving_ ? JPH::EActivation::Activate : JPH::EActivation::DontActivate);
            batch->clear();
            batch->shrink_to_fit();
        }
        system_.OptimizeBroadPhase();
        is_built_ = true;
    }

    void step(double dt) override {
        const JPH::EPhysicsUpdateError error =
            system_.Update(static_cast<float>(dt), 1, &allocator_, jobs_.get());
        has_failed_ = has_failed_ || error != JPH::EPhysicsUpdateError::None;
    }

    BodyMotion motion(std::size_t body) const override {
        const JPH::BodyInterface& interface = system_.GetBodyInterfaceNoLock();
        const JPH::BodyID id = bodies_[body];
        JPH::RVec3 position;
        JPH::Quat q;
        interface.GetPositionAndRotation(id, position, q);
        return {.position = to_vector(position),
                .rotation = {static_cast<double>(q.GetX()), static_cast<double>(q.GetY()),
                             static_cast<double>(q.GetZ()), static_cast<double>(q.GetW())},
                .linear_velocity = to_vector(interface.GetLinearVelocity(id)),
                .angular_velocity = to_vector(interface.GetAngularVelocity(id))};
    }

    std::int64_t count_awake() const override {
        const JPH::BodyInterface& interface = system_.GetBodyInterfaceNoLock();
        return std::count_if(bodies_.begin(), bodies_.end(), [&](JPH::BodyID id) {
            return interface.GetMotionType(id) == JPH::EMotionType::Dynamic &&
                   interface.IsActive(id);
        });
    }

    std::string settings() const override {
        const JPH::PhysicsSettings& s = system_.GetPhysicsSettings();
        return std::to_string(s.mNumVelocitySteps) + " velocity and " +
               std::to_string(s.mNumPositionSteps) + " position iterations, slop 2 cm, built for " +
               instructions + (has_failed_ ? ", a buffer overflowed" : "");
    }

private:
    JPH::ShapeRefC share_part(const BenchScene& scene, std::uint32_t index, float density) {
        if (parts_.size() <= index) parts_.resize(index + 1);
        PartShape& kept = parts_[index];
        if (kept.shape == nullptr || kept.density != density) {
            const Part& part = scene.parts[index];
            JPH::ConvexShape* shape = nullptr;
            if (part.form == Form::Box) {
                shape = new JPH::BoxShape(to_jolt(part.half_extents));
            } else if (part.form == Form::Capsule) {
                shape = new JPH::CapsuleShape(static_cast<float>(part.half_height),
                                              static_cast<float>(part.radius));
            } else {
                shape = new JPH::SphereShape(static_cast<float>(part.radius));
            }
            shape->SetDensity(density);
            kept = {shape, density};
        }
        return kept.shape;
    }

    JPH::ShapeRefC share_shape(const BenchScene& scene, const SceneBody& body) {
        if (body.part_count == 1) return share_part(scene, body.first_part, body.density);
        JPH::StaticCompoundShapeSettings compound;
        for (std::uint32_t i = 0; i < body.part_count; ++i) {
            const Part& part = scene.parts[body.first_part + i];
            compound.AddShape(to_jolt(part.position), to_jolt(part.rotation),
                              share_part(scene, body.first_part + i, body.density));
        }
        return compound.Create().Get();
    }

    struct PartShape {
        JPH::ShapeRefC shape;
        float density = 0;
    };

    Layers layers_;
    JPH::TempAllocatorImplWithMallocFallback allocator_;
    std::unique_ptr<JPH::JobSystem> jobs_;
    JPH::PhysicsSystem system_;
    std::vector<PartShape> parts_;
    std::vector<JPH::BodyID> bodies_, still_, moving_;
    bool is_built_ = false;
    bool has_failed_ = false;
};

}  // namespace

EngineDescription describe_engine() {
    return {.name = "Jolt",
            .version = std::to_string(JPH_VERSION_MAJOR) + "." + std::to_string(JPH_VERSION_MINOR) +
                       "." + std::to_string(JPH_VERSION_PATCH),
            .variants = {"jolt"}};
}

MadeEngine make_engine(const BenchScene& scene, const EngineRequest& request) {
    JPH::RegisterDefaultAllocator();
    JPH::Factory::sInstance = new JPH::Factory();
    JPH::RegisterTypes();
    return {.engine = std::make_unique<JoltEngine>(scene, request.threads), .problem = {}};
}

}  // namespace cairn::bench
