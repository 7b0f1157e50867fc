// The result file: what a run ended in, as JSON whose numbers read back to the same bits.
//
// Reads: a World after its last step, the plan and the record. Writes: text. Contacts, separations
// and penetrations are measured anew at the final poses; impulses are those of the last step.

#include "scene/result.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "scene/json_writer.h"
#include "scene/run.h"

namespace cairn::scene {

namespace {

void write_vector(JsonWriter& json, const std::array<double, 3>& v) {
    json.value(Position{v[0], v[1], v[2]});
}

void write_energy_and_momentum(JsonWriter& json, const World& world) {
    const Energy energy = world.energy();
    json.key("energy").begin_object(Layout::Inline);
    json.member("kinetic", energy.kinetic).member("potential", energy.potential);
    json.member("total", energy.total).end();
    const Momentum momentum = world.momentum();
    json.key("momentum").begin_object(Layout::Inline);
    json.key("linear");
    write_vector(json, momentum.linear);
    json.key("angular");
    write_vector(json, momentum.angular);
    json.end();
}

void write_motion(JsonWriter& json, const BodyState& state) {
    json.member("position", state.position).member("rotation", state.rotation);
    json.member("linear_velocity", state.linear_velocity);
    json.member("angular_velocity", state.angular_velocity);
}

void write_bodies(JsonWriter& json, const BuiltWorld& built, const std::vector<BodyId>& ids) {
    json.key("bodies").begin_array();
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const BodyState state = built.world.state(ids[i]);
        const MassProperties mass = built.world.mass_properties(ids[i]);
        json.begin_object(Layout::Inline).member("name", built.names[i]);
        write_motion(json, state);
        json.member("asleep", state.asleep).member("mass", mass.mass);
        json.member("center_of_mass", mass.center_of_mass).member("inertia", mass.inertia).end();
    }
    json.end();
}

// Which body of the scene an id names, and which of its body's shapes.
class Places {
public:
    Places(const World& world, const std::vector<BodyId>& ids) {
        for (std::size_t i = 0; i < ids.size(); ++i) {
            bodies_[ids[i].index] = i;
            const std::vector<ShapeId> shapes = world.shapes(ids[i]);
            for (std::size_t k = 0; k < shapes.size(); ++k) shapes_[shapes[k].index] = k;
        }
    }
    std::size_t body(BodyId id) const { return bodies_.at(id.index); }
    std::size_t shape(ShapeId id) const { return shapes_.at(id.index); }

private:
    std::unordered_map<std::uint32_t, std::size_t> bodies_, shapes_;
};

void write_contact(JsonWriter& json, const BuiltWorld& built, const Places& places,
                   const ContactReport& contact) {
    json.begin_object(Layout::Inline);
    json.key("bodies").begin_array(Layout::Inline);
    json.value(built.names[places.body(contact.body_a)]);
    json.value(built.names[places.body(contact.body_b)]).end();
    json.key("shapes").begin_array(Layout::Inline);
    json.value(static_cast<std::uint64_t>(places.shape(contact.shape_a)));
    json.value(static_cast<std::uint64_t>(places.shape(contact.shape_b))).end();
    json.member("normal", contact.normal);
    json.key("points").begin_array(Layout::Inline);
    for (int i = 0; i < contact.point_count; ++i) {
        const ContactPointReport& point = contact.points[static_cast<std::size_t>(i)];
        json.begin_object(Layout::Inline).member("position", point.position);
        json.member("separation", point.separation)
            .member("normal_impulse", point.normal_impulse)
            .end();
    }
    json.end();
    json.member("friction_impulse", contact.friction_impulse);
    json.member("spinning_impulse", contact.spinning_impulse);
    json.member("rolling_impulse", contact.rolling_impulse).end();
}

const char* quantity_name(Quantity quantity) {
    switch (quantity) {
        case Quantity::LinearVelocity: return "linear_velocity";
        case Quantity::AngularVelocity: return "angular_velocity";
        case Quantity::Position: return "position";
        case Quantity::Rotation: return "rotation";
    }
    return "";
}

void write_times(JsonWriter& json, const RunRecord& record) {
    const StepTimes times = summarise_times(record.step_ms);
    json.key("step_ms").begin_object(Layout::Inline);
    json.member("first", times.first).member("mean", times.mean).member("p50", times.p50);
    json.member("p95", times.p95).member("max", times.max).end();
    const double steps = static_cast<double>(std::max<std::size_t>(record.step_ms.size(), 2) - 1);
    json.key("stage_ms").begin_object(Layout::Inline);
    for (std::size_t i = 0; i < stage_count; ++i) {
        std::string name = stage_name(static_cast<Stage>(i));
        std::replace(name.begin(), name.end(), '-', '_');
        json.member(name, record.stage_ms[i] / steps);
    }
    json.end();
}

void write_step(JsonWriter& json, const Scene& scene) {
    const StepSettings& step = scene.world.step;
    json.key("step").begin_object(Layout::Inline);
    json.member("dt", scene.dt).member("solver", solver_name(step.solver));
    json.member("substeps", step.substeps).member("iterations", step.iterations);
    json.member("narrow_phase", narrow_phase_name(step.narrow_phase));
    json.member("broad_phase", broad_phase_name(step.broad_phase)).end();
}

}  // namespace

void append_sample(std::string& samples, const BuiltWorld& built, double time) {
    const World& world = built.world;
    const std::vector<BodyId> ids = world.bodies();
    const std::vector<ContactReport> contacts = world.contacts();
    JsonWriter json;
    json.begin_object(Layout::Inline).member("time", time);
    json.key("bodies").begin_array(Layout::Inline);
    for (std::size_t i = 0; i < ids.size(); ++i) {
        json.begin_object(Layout::Inline).member("name", built.names[i]);
        write_motion(json, world.state(ids[i]));
        json.end();
    }
    json.end();
    write_energy_and_momentum(json, world);
    json.member("max_penetration", World::penetration(contacts).deepest);
    json.member("contact_count", static_cast<std::uint64_t>(contacts.size())).end();
    std::string text = json.take();
    text.pop_back();  // the line's end
    samples += (samples.empty() ? "\n    " : ",\n    ") + text;
}

std::string write_result(const BuiltWorld& built, const RunPlan& plan, const RunRecord& record) {
    const World& world = built.world;
    const std::vector<BodyId> ids = world.bodies();
    const std::vector<ContactReport> contacts = world.contacts();
    const Places places(world, ids);
    JsonWriter json;
    json.begin_object().member("cairn", version()).member("scene", plan.scene.name);
    write_step(json, plan.scene);
    const auto steps = static_cast<std::uint64_t>(record.step_ms.size());
    json.member("threads", static_cast<std::uint64_t>(plan.threads)).member("steps", steps);
    json.member("time", static_cast<double>(steps) * plan.scene.dt);
    write_bodies(json, built, ids);
    json.key("joints").begin_array().end();
    json.key("contacts").begin_array();
    for (const ContactReport& contact : contacts) write_contact(json, built, places, contact);
    json.end();
    write_energy_and_momentum(json, world);
    const Penetration penetration = World::penetration(contacts);
    json.member("max_penetration", penetration.deepest)
        .member("mean_penetration", penetration.mean);
    json.key("non_finite").begin_array();
    for (const NonFinite& event : world.non_finite()) {
        json.begin_object(Layout::Inline).member("body", built.names[places.body(event.body)]);
        json.member("step", event.step).member("time", event.time);
        json.member("quantity", quantity_name(event.quantity)).end();
    }
    json.end();
    json.member("state_hash", fmt::format("{:016x}", world.state_hash()));
    write_times(json, record);
    if (plan.sample_every > 0) json.key("samples").value_verbatim("[" + record.samples + "\n  ]");
    json.end();
    return json.take();
}

}  // namespace cairn::scene
