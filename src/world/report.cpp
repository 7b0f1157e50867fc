// What can be read from a world between steps: contacts measured anew, energy, momentum, the
// state's hash.

#include <algorithm>

#include "base/float_environment.h"
#include "cairn/version.h"
#include "world/detect.h"
#include "world/sleep.h"
#include "world/world_state.h"

namespace cairn {

const char* version() { return CAIRN_VERSION; }

const char* stage_name(Stage stage) {
    switch (stage) {
        case Stage::FindPairs: return "find-pairs";
        case Stage::FindAxes: return "find-axes";
        case Stage::BuildManifolds: return "build-manifolds";
        case Stage::Solve: return "solve";
        case Stage::Finish: return "finish";
    }
    return "";
}

namespace {

// Gives each renewed point the impulses of the stored one with its feature, and what is left over
// to the nearest point, so that the report's sum is what the step exchanged.
void assign_impulses(const Contact& stored, Contact& measured) {
    for (int j = 0; j < stored.point_count; ++j) {
        const ContactPoint& old = stored.points[std::size_t(j)];
        if (old.normal_impulse == 0 && old.friction_impulse == Vec3{}) continue;
        ContactPoint* heir = nullptr;
        float nearest = std::numeric_limits<float>::infinity();
        for (int i = 0; i < measured.point_count; ++i) {
            ContactPoint& point = measured.points[std::size_t(i)];
            const Vec3 apart =
                (point.arm_b.core - old.arm_b.core) + (point.arm_b.offset - old.arm_b.offset);
            const float distance = point.feature == old.feature ? -1 : length_squared(apart);
            if (distance < nearest) {
                nearest = distance;
                heir = &point;
            }
        }
        if (!heir) continue;
        heir->normal_impulse += old.normal_impulse;
        heir->friction_impulse += old.friction_impulse;
    }
    measured.rolling_impulse = stored.rolling_impulse;
    measured.spinning_impulse = stored.spinning_impulse;
}

bool carries_impulse(const Contact& contact) {
    for (int i = 0; i < contact.point_count; ++i) {
        if (contact.points[std::size_t(i)].normal_impulse > 0) return true;
    }
    return false;
}

ContactReport describe(const WorldState& world, const Contact& contact, float within) {
    ContactReport report = {.body_a = body_id(world, contact.body_a),
                            .body_b = body_id(world, contact.body_b),
                            .shape_a = shape_id(world, contact.shape_a),
                            .shape_b = shape_id(world, contact.shape_b),
                            .normal = contact.normal,
                            .rolling_impulse = contact.rolling_impulse};
    report.spinning_impulse = contact.spinning_impulse;
    for (int i = 0; i < contact.point_count; ++i) {
        const ContactPoint& from = contact.points[std::size_t(i)];
        if (from.separation > within && from.normal_impulse == 0) continue;
        ContactPointReport& to = report.points[std::size_t(report.point_count++)];
        to.position =
            world.positions[contact.body_b] + find_arm(from.arm_b, world.rotations[contact.body_b]);
        to.separation = from.separation;
        to.normal_impulse = from.normal_impulse;
        to.feature = from.feature;
        report.friction_impulse += from.friction_impulse;
    }
    return report;
}

}  // namespace

std::vector<ContactReport> World::contacts() const {
    const FloatEnvironment ieee;
    const WorldState& world = *state_;
    LargeArray<Pair> pairs;
    std::vector<ContactReport> reports;
    find_present_pairs(world, world.last_dt, pairs);
    for (const Pair& pair : pairs) {
        Contact contact;
        contact.shape_a = pair.a;
        contact.shape_b = pair.b;
        const PairRecord* known = world.contacts.find_pair(pair.a, pair.b);
        const bool met = known && known->contact != ContactStore::none;
        const Contact* stored = met ? &world.contacts[known->contact] : nullptr;
        AxisHint hint = known ? known->hint : AxisHint{};
        describe_contact(world, contact);
        Meeting meeting;
        if (!find_meeting(world, pair.a, pair.b, 0, true, hint, meeting)) continue;
        // A pair that exchanged an impulse is reported however far it has flown apart since.
        const bool struck = stored && carries_impulse(*stored);
        const float within = meeting.within;
        const float wanted = struck ? std::numeric_limits<float>::max() : within;
        if (meeting.axis.separation > wanted) continue;
        build_contact_points(world, meeting, wanted, contact);
        if (stored) assign_impulses(*stored, contact);
        const ContactReport report = describe(world, contact, within);
        if (report.point_count > 0) reports.push_back(report);
    }
    return reports;
}

Penetration World::penetration(std::span<const ContactReport> contacts) {
    Penetration result;
    std::size_t count = 0;
    for (const ContactReport& contact : contacts) {
        for (int i = 0; i < contact.point_count; ++i) {
            const double depth = -double(contact.points[std::size_t(i)].separation);
            if (!(depth > 0)) continue;
            result.deepest = std::max(result.deepest, depth);
            result.mean += depth;
            ++count;
        }
    }
    if (count > 0) result.mean /= double(count);
    return result;
}

Trace World::trace() const {
    const StageTrace* trace = state_->trace.get();
    return trace == nullptr ? Trace{} : Trace{trace->spans(), trace->forgotten_count()};
}

const StepReport& World::last_step() const { return state_->report; }
std::span<const ContactEvent> World::contact_events() const { return state_->events; }
std::span<const NonFinite> World::non_finite() const { return state_->non_finite; }

Energy World::energy() const {
    const FloatEnvironment ieee;
    const WorldState& world = *state_;
    Energy energy;
    const Vec3 g = world.settings.gravity;
    for (std::uint32_t slot = 0; slot < world.bodies.size(); ++slot) {
        const BodyInertia& inertia = inertia_of(world, slot);
        if (inertia.mass == 0) continue;
        const BodyMotion motion = motion_of(world, slot);
        const Vec3 v = motion.linear_velocity;
        const Vec3 w = rotate_inverse(motion.rotation, motion.angular_velocity);
        const Position& x = world.positions[slot];
        const double mass = inertia.mass;
        energy.kinetic +=
            0.5 * mass *
            (double(v.x) * double(v.x) + double(v.y) * double(v.y) + double(v.z) * double(v.z));
        const Vec3 momentum = inertia.inertia * w;
        energy.kinetic +=
            0.5 * (double(w.x) * double(momentum.x) + double(w.y) * double(momentum.y) +
                   double(w.z) * double(momentum.z));
        energy.potential -= mass * double(drive_of(world, slot).gravity_scale) *
                            (double(g.x) * x.x + double(g.y) * x.y + double(g.z) * x.z);
    }
    energy.total = energy.kinetic + energy.potential;
    return energy;
}

Momentum World::momentum() const {
    const FloatEnvironment ieee;
    const WorldState& world = *state_;
    Momentum momentum;
    for (std::uint32_t slot = 0; slot < world.bodies.size(); ++slot) {
        const BodyInertia& inertia = inertia_of(world, slot);
        if (inertia.mass == 0) continue;
        const BodyMotion motion = motion_of(world, slot);
        const Position& x = world.positions[slot];
        const double px = double(inertia.mass) * double(motion.linear_velocity.x);
        const double py = double(inertia.mass) * double(motion.linear_velocity.y);
        const double pz = double(inertia.mass) * double(motion.linear_velocity.z);
        const Vec3 spin =
            rotate(motion.rotation,
                   inertia.inertia * rotate_inverse(motion.rotation, motion.angular_velocity));
        momentum.linear[0] += px;
        momentum.linear[1] += py;
        momentum.linear[2] += pz;
        momentum.angular[0] += x.y * pz - x.z * py + double(spin.x);
        momentum.angular[1] += x.z * px - x.x * pz + double(spin.y);
        momentum.angular[2] += x.x * py - x.y * px + double(spin.z);
    }
    return momentum;
}

namespace {

class Fnv1a {
public:
    template <class Number>
    void add(Number number) {
        using Bits = std::conditional_t<
            sizeof(Number) == 8, std::uint64_t,
            std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint8_t>>;
        const Bits bits = __builtin_bit_cast(Bits, number);
        for (std::size_t i = 0; i < sizeof(Bits); ++i) {
            hash_ = (hash_ ^ std::uint64_t((bits >> (8 * i)) & 0xff)) * 0x100000001b3u;
        }
    }
    void add(Vec3 v) {
        add(v.x);
        add(v.y);
        add(v.z);
    }
    std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace

std::uint64_t World::state_hash() const {
    const FloatEnvironment ieee;
    const WorldState& world = *state_;
    Fnv1a hash;
    for (std::uint32_t slot = 0; slot < world.bodies.size(); ++slot) {
        if (!world.bodies[slot].alive) continue;
        const BodyMotion motion = motion_of(world, slot);
        const Position position = origin_position(world, slot);
        hash.add(position.x);
        hash.add(position.y);
        hash.add(position.z);
        hash.add(motion.rotation.x);
        hash.add(motion.rotation.y);
        hash.add(motion.rotation.z);
        hash.add(motion.rotation.w);
        hash.add(motion.linear_velocity);
        hash.add(motion.angular_velocity);
        hash.add(std::uint8_t(is_asleep(world, slot)));
    }
    return hash.value();
}

}  // namespace cairn
