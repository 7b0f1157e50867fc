// Building and reading the cases' scenes through the public face.

#include "scene.h"

#include <algorithm>
#include <stdexcept>

namespace cairn::physics {

namespace {

void require(bool ok, const Error& error) {
    if (!ok) throw std::runtime_error(error.message);
}

}  // namespace

Turn turn_about(const Vec& axis, double angle) {
    const double s = std::sin(angle / 2) / length(axis);
    return {s * axis.x, s * axis.y, s * axis.z, std::cos(angle / 2)};
}

Turn from(const Quat& q) {
    return {static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z),
            static_cast<double>(q.w)};
}

Quat to_quat(const Turn& q) {
    return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z),
            static_cast<float>(q.w)};
}

Turn operator*(const Turn& a, const Turn& b) {
    return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
            a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

Turn inverse(const Turn& q) { return {-q.x, -q.y, -q.z, q.w}; }

Vec rotate(const Turn& q, const Vec& v) {
    const Vec u = {q.x, q.y, q.z};
    const Vec t = 2 * cross(u, v);
    return v + q.w * t + cross(u, t);
}

double angle_between(const Turn& a, const Turn& b) {
    const Turn d = inverse(a) * b;
    return 2 * std::atan2(length({d.x, d.y, d.z}), std::abs(d.w));
}

std::uint32_t Random::next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005u + 1442695040888963407u;
    const auto mixed = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
    const auto by = static_cast<std::uint32_t>(old >> 59);
    return (mixed >> by) | (mixed << ((32 - by) & 31));
}

double Random::uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(next()) / 4294967296.0);
}

Vec Random::in_cube(double half) {
    const double x = uniform(-half, half);
    const double y = uniform(-half, half);
    const double z = uniform(-half, half);
    return {x, y, z};
}

Turn Random::turn() {
    // A point in the unit ball of four dimensions, pulled onto its surface: even over all
    // rotations.
    for (;;) {
        const Vec v = in_cube(1);
        const double w = uniform(-1, 1);
        const double n = dot(v, v) + w * w;
        if (n < 0.01 || n > 1) continue;
        const double s = 1 / std::sqrt(n);
        return {s * v.x, s * v.y, s * v.z, s * w};
    }
}

World make_world(const Setup& setup, const WorldOptions& options) {
    WorldSettings settings;
    settings.gravity = to_vec3({0, 0, -options.gravity});
    settings.restitution_threshold = static_cast<float>(options.restitution_threshold);
    settings.step.solver = setup.solver;
    settings.step.narrow_phase = setup.narrow_phase;
    settings.step.substeps = options.substeps;
    Result<World> world = World::create(settings);
    require(world.ok(), world.error());
    return std::move(world).value();
}

Material rough(double friction, double restitution) {
    Material material;
    material.friction = static_cast<float>(friction);
    material.restitution = static_cast<float>(restitution);
    return material;
}

ShapeDef ball(double radius, const Material& material, double density) {
    ShapeDef shape;
    shape.geometry = Sphere{static_cast<float>(radius)};
    shape.density = static_cast<float>(density);
    shape.material = material;
    return shape;
}

ShapeDef capsule(double radius, double height, const Material& material, double density) {
    ShapeDef shape;
    shape.geometry = Capsule{static_cast<float>(radius), static_cast<float>(height)};
    shape.density = static_cast<float>(density);
    shape.material = material;
    return shape;
}

ShapeDef block(const Vec& full_size, const Material& material, double density) {
    ShapeDef shape;
    shape.geometry = Box{to_vec3(0.5 * full_size)};
    shape.density = static_cast<float>(density);
    shape.material = material;
    return shape;
}

BodyId add(World& world, const BodyDef& def) {
    const Result<BodyId> body = world.create_body(def);
    require(body.ok(), body.error());
    return *body;
}

BodyId add_static(World& world, const ShapeDef& shape, const Vec& at, const Turn& turn) {
    BodyDef def;
    def.kind = BodyKind::Static;
    def.position = to_position(at);
    def.rotation = to_quat(turn);
    def.shapes = {shape};
    return add(world, def);
}

BodyId add_plane(World& world, const Vec& normal, double offset, const Material& material) {
    ShapeDef shape;
    shape.geometry = Plane{to_vec3(normal), static_cast<float>(offset)};
    shape.material = material;
    return add_static(world, shape, {});
}

const char* name(Ground ground) { return ground == Ground::Plane ? "on a plane" : "on a box"; }

BodyId add_ground(World& world, Ground ground, const Material& material, double tilt) {
    const Slope slope = slope_of(tilt);
    if (ground == Ground::Plane) return add_plane(world, slope.normal, 0, material);
    return add_static(world, block({40, 40, 2}, material), -1 * slope.normal, slope.turn);
}

Slope slope_of(double tilt) {
    Slope slope;
    slope.turn = turn_about({0, 1, 0}, tilt);
    slope.downhill = rotate(slope.turn, {1, 0, 0});
    slope.across = {0, 1, 0};
    slope.normal = rotate(slope.turn, {0, 0, 1});
    return slope;
}

void set_pose(World& world, BodyId body, const Vec& at, const Turn& turn) {
    const Status status = world.set_pose(body, to_position(at), to_quat(turn));
    require(status.ok(), status.error());
}

void advance(World& world, double dt) {
    const Status status = world.step(dt);
    require(status.ok(), status.error());
    if (!world.non_finite().empty()) {
        throw std::runtime_error("a body became non-finite at " +
                                 std::to_string(world.non_finite()[0].time) + " s");
    }
}

void run(World& world, const Setup& setup, double seconds) {
    const int count = steps_in(setup, seconds);
    for (int i = 0; i < count; ++i) advance(world, setup.dt);
}

Vec center_of(const World& world, BodyId body) { return from(world.state(body).center_of_mass); }
Vec velocity_of(const World& world, BodyId body) { return from(world.linear_velocity(body)); }
Vec spin_of(const World& world, BodyId body) { return from(world.angular_velocity(body)); }
Turn turn_of(const World& world, BodyId body) { return from(world.rotation(body)); }

double speed_of(const World& world, BodyId body, double reach) {
    return length(velocity_of(world, body)) + reach * length(spin_of(world, body));
}

double flight_energy(const World& world, const Setup& setup) {
    double energy = world.energy().kinetic;
    const double g = -from(world.settings().gravity).z;
    for (const BodyId body : world.bodies()) {
        const BodyState state = world.state(body);
        if (state.kind != BodyKind::Dynamic) continue;
        const auto mass = static_cast<double>(world.mass_properties(body).mass);
        const double v_z = from(state.linear_velocity).z;
        energy += mass * g * (state.center_of_mass.z - substep_of(setup) * v_z / 2);
    }
    return energy;
}

double normal_impulse(const World& world, BodyId one, BodyId other) {
    double sum = 0;
    for (const ContactReport& contact : world.contacts()) {
        const bool is_pair = (contact.body_a == one && contact.body_b == other) ||
                             (contact.body_a == other && contact.body_b == one);
        if (!is_pair) continue;
        for (int i = 0; i < contact.point_count; ++i) {
            sum += static_cast<double>(contact.points[static_cast<std::size_t>(i)].normal_impulse);
        }
    }
    return sum;
}

}  // namespace cairn::physics
