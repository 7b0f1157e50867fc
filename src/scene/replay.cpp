// From a world to a recording: which bodies are recorded, on what lattice, and what of a step is
// noted.
//
// Reads the world through its public face, after each step that the track wants to keep. A scene
// with more bodies or shapes than a page can carry is recorded in part, and the page says so.

#include "scene/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>

#include "scene/replay_page.h"
#include "scene/replay_track.h"

namespace cairn::scene {

namespace {

using nlohmann::json;

// The page must stay under 30 MB (30 million bytes); base64 makes four bytes of three.
constexpr std::size_t most_page_bytes = 29'500'000;
constexpr std::size_t most_bodies = 60'000;
constexpr std::size_t most_shapes = 120'000;
// Names are for reading; together they may take four megabytes, after that bodies go by their
// number.
constexpr std::size_t longest_name = 120;
constexpr std::size_t most_name_bytes = 4'000'000;
constexpr std::size_t longest_text = 20'000;

json to_json(const Vec3& v) { return {v.x, v.y, v.z}; }
json to_json(const Position& p) { return {p.x, p.y, p.z}; }

struct GeometryWriter {
    json operator()(const Sphere& s) const { return {{"kind", "sphere"}, {"radius", s.radius}}; }
    json operator()(const Box& b) const {
        return {{"kind", "box"}, {"half_extents", to_json(b.half_extents)}};
    }
    json operator()(const Capsule& c) const {
        return {{"kind", "capsule"}, {"radius", c.radius}, {"height", c.height}};
    }
    json operator()(const Plane& p) const {
        return {{"kind", "plane"}, {"normal", to_json(p.normal)}, {"offset", p.offset}};
    }
};

// The radius of the ball about the shape's own origin that holds it; 0 for what has no end.
struct ReachFinder {
    double operator()(const Sphere& s) const { return static_cast<double>(s.radius); }
    double operator()(const Box& b) const { return static_cast<double>(length(b.half_extents)); }
    double operator()(const Capsule& c) const {
        return 0.5 * static_cast<double>(c.height) + static_cast<double>(c.radius);
    }
    double operator()(const Plane&) const { return 0; }
};

std::string shorten(const std::string& text, std::size_t most) {
    if (text.size() <= most) return text;
    std::size_t end = most;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
    return text.substr(0, end) + "\xe2\x80\xa6";
}

double power_of_two_below(double value) { return std::exp2(std::floor(std::log2(value))); }

// The bodies that are recorded: all, or, of too many, what stands still and an even choice of the
// rest.
std::vector<std::size_t> choose_bodies(const World& world, const std::vector<BodyId>& bodies) {
    std::vector<std::size_t> still, moving, chosen;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        (world.state(bodies[i]).kind == BodyKind::Dynamic ? moving : still).push_back(i);
    }
    if (still.size() > most_bodies / 2 && bodies.size() > most_bodies)
        still.resize(most_bodies / 2);
    chosen = still;
    const std::size_t room =
        std::min(most_bodies - std::min(most_bodies, still.size()), moving.size());
    for (std::size_t i = 0; i < room; ++i) chosen.push_back(moving[i * moving.size() / room]);
    std::sort(chosen.begin(), chosen.end());
    return chosen;
}

}  // namespace

struct ReplayRecorder::Recording {
    ReplayInfo info;
    std::size_t body_count = 0;        // of the world
    std::vector<BodyId> bodies;        // those recorded
    std::vector<std::uint32_t> place;  // by slot in the world: index in `bodies`, or nowhere
    std::uint64_t first_step = 0;
    json header;
    std::optional<ReplayTrack> track;
    std::vector<Position> positions;
    std::vector<Quat> rotations;

    static constexpr std::uint32_t nowhere = 0xffffffffu;

    void choose(const World& world);
    void describe(const World& world);
    json describe_shapes(const World& world);
    Lattice choose_lattice(const World& world) const;
    void add_frame(const World& world, bool is_last);
    std::vector<ContactSample> sample(const std::vector<ContactReport>& contacts) const;
    std::uint32_t place_of(BodyId body) const {
        const bool known = body.index < place.size() && place[body.index] != nowhere;
        return known && bodies[place[body.index]] == body ? place[body.index] : nowhere;
    }
};

void ReplayRecorder::Recording::choose(const World& world) {
    const std::vector<BodyId> all = world.bodies();
    body_count = all.size();
    std::vector<std::string> names;
    std::size_t name_bytes = 0;
    for (const std::size_t i : choose_bodies(world, all)) {
        std::string name = i < info.body_names.size() ? info.body_names[i] : std::string();
        name = shorten(name, longest_name);
        // Six bytes is the most that JSON makes of one.
        name_bytes += 6 * name.size();
        if (name.empty() || name_bytes > most_name_bytes) name = fmt::format("body[{}]", i);
        names.push_back(std::move(name));
        if (all[i].index >= place.size()) place.resize(all[i].index + 1, nowhere);
        place[all[i].index] = static_cast<std::uint32_t>(bodies.size());
        bodies.push_back(all[i]);
    }
    info.body_names = std::move(names);
}

json ReplayRecorder::Recording::describe_shapes(const World& world) {
    // Equal geometries stand once: most scenes are made of a few kinds of stone.
    std::map<std::string, std::size_t> known;
    json geometries = json::array(), shapes = json::array();
    std::size_t count = 0, left_out = 0;
    for (const BodyId body : bodies) {
        json list = json::array();
        for (const ShapeId id : world.shapes(body)) {
            if (++count > most_shapes) {
                ++left_out;
                continue;
            }
            const ShapeDef shape = world.shape(id);
            json geometry = std::visit(GeometryWriter{}, shape.geometry);
            const auto [place_found, is_new] =
                known.try_emplace(geometry.dump(), geometries.size());
            if (is_new) geometries.push_back(std::move(geometry));
            json entry = json::array({place_found->second});
            if (shape.local_pose != Pose{}) {
                const auto& [p, q] = shape.local_pose;
                for (const float value : {p.x, p.y, p.z, q.x, q.y, q.z, q.w})
                    entry.push_back(value);
            }
            list.push_back(std::move(entry));
        }
        shapes.push_back(std::move(list));
    }
    header["geometries"] = std::move(geometries);
    header["left_out"] = {{"bodies", body_count - bodies.size()}, {"shapes", left_out}};
    return shapes;
}

void ReplayRecorder::Recording::describe(const World& world) {
    const Vec3 gravity = world.settings().gravity;
    header["scene"] = info.scene;
    header["description"] = shorten(info.description, longest_text);
    header["settings"] = shorten(info.settings, longest_text);
    header["version"] = version();
    header["dt"] = info.dt;
    header["gravity"] = to_json(gravity);
    header["camera"] = {{"eye", to_json(info.camera.eye)}, {"target", to_json(info.camera.target)}};

    std::string kinds;
    json mass = json::array(), center_of_mass = json::array();
    for (const BodyId body : bodies) {
        const BodyKind kind = world.state(body).kind;
        kinds += kind == BodyKind::Static ? 's' : kind == BodyKind::Kinematic ? 'k' : 'd';
        const MassProperties properties = world.mass_properties(body);
        mass.push_back(properties.mass);
        const Vec3 com = properties.center_of_mass;
        center_of_mass.push_back(com == Vec3{} ? json(0) : to_json(com));
    }
    json shapes = describe_shapes(world);
    header["bodies"] = {{"names", info.body_names},
                        {"kinds", kinds},
                        {"mass", mass},
                        {"center_of_mass", center_of_mass},
                        {"shapes", shapes}};
}

Lattice ReplayRecorder::Recording::choose_lattice(const World& world) const {
    // The scene's size: the box about all that moves, and no less than what the camera looks
    // across.
    Position low = {1e300, 1e300, 1e300}, high = {-1e300, -1e300, -1e300};
    double mass = 0;
    std::size_t moving = 0;
    for (const BodyId body : bodies) {
        const BodyState state = world.state(body);
        if (state.kind == BodyKind::Static) continue;
        double reach = 0;
        for (const ShapeId id : world.shapes(body)) {
            const ShapeDef shape = world.shape(id);
            const double away = static_cast<double>(length(shape.local_pose.position));
            reach = std::max(reach, away + std::visit(ReachFinder{}, shape.geometry));
        }
        const Position& p = state.position;
        low = {std::min(low.x, p.x - reach), std::min(low.y, p.y - reach),
               std::min(low.z, p.z - reach)};
        high = {std::max(high.x, p.x + reach), std::max(high.y, p.y + reach),
                std::max(high.z, p.z + reach)};
        mass += static_cast<double>(world.mass_properties(body).mass);
        ++moving;
    }
    Lattice lattice;
    const Vec3 view = info.camera.eye - info.camera.target;
    double size = static_cast<double>(length(view));
    if (moving > 0) {
        lattice.origin = {0.5 * (low.x + high.x), 0.5 * (low.y + high.y), 0.5 * (low.z + high.z)};
        size = std::max(size, std::hypot(high.x - low.x, high.y - low.y, high.z - low.z));
    }
    if (!(size > 0 && size < 1e30)) size = 1;
    // A view 1000 pixels wide across the scene has pixels of size/1000; 2^-17 of the size is a
    // 130th of that, and stays under a pixel when one stone fills the view. Small scenes can afford
    // more.
    const bool small = moving <= 1000;
    lattice.position_pitch = power_of_two_below(size) * std::exp2(small ? -20 : -17);
    lattice.rotation_pitch = std::exp2(small ? -17 : -14);
    lattice.contact_pitch = power_of_two_below(size) * std::exp2(-15);
    lattice.separation_unit = power_of_two_below(size) * std::exp2(-24);
    // The impulse that carries a body of mean mass for one step, cut in 256.
    const double speed = static_cast<double>(length(world.settings().gravity)) * info.dt;
    const double mean_mass = moving > 0 && mass > 0 ? mass / static_cast<double>(moving) : 1;
    lattice.impulse_unit = mean_mass * (speed > 0 ? speed : 0.1) / 256;
    return lattice;
}

std::vector<ContactSample> ReplayRecorder::Recording::sample(
    const std::vector<ContactReport>& contacts) const {
    std::vector<ContactSample> samples;
    for (const ContactReport& contact : contacts) {
        const std::uint32_t a = place_of(contact.body_a), b = place_of(contact.body_b);
        if (a == nowhere || b == nowhere) continue;
        for (int i = 0; i < contact.point_count; ++i) {
            const ContactPointReport& point = contact.points[static_cast<std::size_t>(i)];
            samples.push_back(
                {a, b, point.position, contact.normal, point.separation, point.normal_impulse});
        }
    }
    return samples;
}

void ReplayRecorder::Recording::add_frame(const World& world, bool is_last) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (!world.is_valid(bodies[i])) continue;  // gone: it stays where it was
        positions[i] = world.position(bodies[i]);
        rotations[i] = world.rotation(bodies[i]);
    }
    const std::vector<ContactReport> contacts = world.contacts();
    const Energy energy = world.energy();
    const FrameFigures figures = {
        static_cast<std::uint32_t>(world.last_step().step - first_step),
        energy.kinetic,
        energy.potential,
        energy.total,
        World::penetration(contacts).deepest,
    };
    track->add(figures, positions, rotations, sample(contacts), is_last);

    json& frozen = header["non_finite"] = json::array();
    for (const NonFinite& event : world.non_finite()) {
        const std::uint32_t body = place_of(event.body);
        if (body == nowhere || frozen.size() == 1000) continue;
        frozen.push_back({{"body", body}, {"step", event.step - first_step}});
    }
}

ReplayRecorder::ReplayRecorder(const World& world, ReplayInfo info)
    : recording_(std::make_unique<Recording>()) {
    Recording& r = *recording_;
    r.info = std::move(info);
    r.info.scene = shorten(r.info.scene, longest_name);
    r.first_step = world.last_step().step;
    r.choose(world);
    r.describe(world);
    const Lattice lattice = r.choose_lattice(world);
    r.header["lattice"] = {{"origin", to_json(lattice.origin)},
                           {"position_pitch", lattice.position_pitch},
                           {"rotation_pitch", lattice.rotation_pitch},
                           {"contact_pitch", lattice.contact_pitch},
                           {"separation_unit", lattice.separation_unit},
                           {"impulse_unit", lattice.impulse_unit},
                           {"log_steps", log_steps},
                           {"normal_steps", normal_steps}};

    const std::size_t header_size =
        r.header.dump(-1, ' ', false, json::error_handler_t::replace).size() + 100'000;
    const std::size_t room = (most_page_bytes - replay_page_overhead(r.info.scene)) / 4 * 3;
    r.track.emplace(lattice, r.bodies.size(), room - std::min(room, header_size));
    r.positions.resize(r.bodies.size());
    r.rotations.resize(r.bodies.size());
    r.add_frame(world, false);
}

ReplayRecorder::~ReplayRecorder() = default;

void ReplayRecorder::record(const World& world) {
    const std::uint64_t step = world.last_step().step - recording_->first_step;
    const bool is_last = step == recording_->info.step_count;
    if (is_last || recording_->track->wants(step)) recording_->add_frame(world, is_last);
}

Status ReplayRecorder::write(const std::string& path) const {
    const Recording& r = *recording_;
    json header = r.header;
    header["step_count"] = r.info.step_count;
    header["stride"] = r.track->stride();
    header["contact_stride"] = r.track->contact_stride();
    const std::string text = header.dump(-1, ' ', false, json::error_handler_t::replace);

    Bytes bytes = {'C', 'R', 'N', '1'};
    put_u32(bytes, static_cast<std::uint32_t>(text.size()));
    bytes.insert(bytes.end(), text.begin(), text.end());
    while (bytes.size() % 8 != 0) bytes.push_back(0);
    r.track->append_to(bytes);
    return write_replay_page(path, r.info.scene, bytes);
}

}  // namespace cairn::scene
