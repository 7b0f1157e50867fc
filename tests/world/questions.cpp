// Rays, overlaps and distances in whole worlds, against brute force in long double that is worked
// out another way than the engine's: a box by its six faces, a ball by the quadratic.

#include <cairn/cairn.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "support/random.h"

using namespace cairn;

namespace {

using Real = long double;
using Vec = std::array<Real, 3>;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct RandomPlaces : test::Random {
    explicit RandomPlaces(std::uint64_t seed) : Random{seed} {}
    Vec3 vector(double reach) {
        const double x = between(-reach, reach), y = between(-reach, reach);
        return {float(x), float(y), float(between(-reach, reach))};
    }
    Quat turn() {
        const Vec3 v = vector(1);
        return {v.x, v.y, v.z, float(between(0.1, 1))};
    }
};

Real dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec add(const Vec& a, Real s, const Vec& b) {
    return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}
Vec from(const Vec3& v) { return {Real(v.x), Real(v.y), Real(v.z)}; }
Vec from(const Position& p) { return {Real(p.x), Real(p.y), Real(p.z)}; }
Vec unit(const Vec& v) { return add({}, 1 / std::sqrt(dot(v, v)), v); }

// q v q*, for a quaternion of any length.
Vec turn(const Quat& q, const Vec& v, int sign) {
    const Vec u = {sign * Real(q.x), sign * Real(q.y), sign * Real(q.z)};
    const Real w = Real(q.w), n = dot(u, u) + w * w;
    const Vec c = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const Real along = 2 * dot(u, v) / n, keep = (w * w - dot(u, u)) / n;
    return add(add(add({}, keep, v), along, u), 2 * w / n, c);
}

// A shape with the frame in which it is simplest.
struct Placed {
    BodyId body;
    ShapeId shape;
    ShapeDef def;
    BodyState state;
    CollisionFilter filter;

    Vec to_local(const Vec& v, bool is_point) const {
        const Vec in_body =
            turn(state.rotation, is_point ? add(v, -1, from(state.position)) : v, -1);
        return turn(def.local_pose.rotation,
                    is_point ? add(in_body, -1, from(def.local_pose.position)) : in_body, -1);
    }
    Vec to_world(const Vec& v) const {
        return turn(state.rotation, turn(def.local_pose.rotation, v, 1), 1);
    }
};

std::vector<Placed> place_all(const World& world) {
    std::vector<Placed> placed;
    for (const BodyId body : world.bodies()) {
        for (const ShapeId shape : world.shapes(body))
            placed.push_back({body, shape, world.shape(shape), world.state(body), {}});
    }
    return placed;
}

struct Met {
    Real distance = -1;  // below 0: nothing
    Vec normal = {};
    bool inside = false;
    Real margin = 0;  // how far the line is from passing by
};

Met meet_ball(Real r, const Vec& o, const Vec& d) {
    const Real b = dot(o, d), c = dot(o, o) - r * r, gap = b * b - c;
    const Vec nearest = add(o, -b, d);
    Met met{.margin = r - std::sqrt(dot(nearest, nearest))};
    if (c < 0) return {.distance = 0, .normal = add({}, -1, d), .inside = true};
    if (gap < 0 || b >= 0) return met;
    met.distance = -b - std::sqrt(gap);
    met.normal = add({}, 1 / r, add(o, met.distance, d));
    return met;
}

Met meet_box(const Vec3& half, const Vec& o, const Vec& d) {
    const Vec h = from(half);
    Met met{.margin = -1};
    if (std::abs(o[0]) < h[0] && std::abs(o[1]) < h[1] && std::abs(o[2]) < h[2])
        return {.distance = 0, .normal = add({}, -1, d), .inside = true};
    for (int k = 0; k < 3; ++k) {
        for (const Real side : {Real(-1), Real(1)}) {
            const auto i = std::size_t(k), j = std::size_t((k + 1) % 3),
                       l = std::size_t((k + 2) % 3);
            const Real t = (side * h[i] - o[i]) / d[i];
            if (side * d[i] >= 0 || !(t >= 0)) continue;
            const Vec at = add(o, t, d);
            const Real margin = std::min(h[j] - std::abs(at[j]), h[l] - std::abs(at[l]));
            met.margin = std::max(met.margin, margin);
            if (margin < 0) continue;
            met.distance = t;
            met.normal = {};
            met.normal[i] = side;
        }
    }
    return met;
}

// A cylinder along y and a ball at either end.
Met meet_capsule(const Capsule& capsule, const Vec& o, const Vec& d) {
    const Real r = Real(capsule.radius), half = Real(capsule.height) / 2;
    Met met{.margin = -1};
    const auto keep = [&](const Met& part) {
        met.inside |= part.inside;
        met.margin = std::max(met.margin, part.margin);
        if (part.distance < 0 || (met.distance >= 0 && met.distance <= part.distance)) return;
        met.distance = part.distance;
        met.normal = part.normal;
    };
    for (const Real end : {-half, half}) keep(meet_ball(r, {o[0], o[1] - end, o[2]}, d));
    const Real a = d[0] * d[0] + d[2] * d[2], b = o[0] * d[0] + o[2] * d[2];
    const Real c = o[0] * o[0] + o[2] * o[2] - r * r, gap = b * b - a * c;
    if (c < 0 && std::abs(o[1]) < half) keep({.distance = 0, .inside = true});
    const Real nearest = o[1] - b / a * d[1];
    if (std::abs(nearest) <= half)
        met.margin = std::max(met.margin, r - std::sqrt(r * r - gap / a));
    if (gap >= 0) {
        const Real t = (-b - std::sqrt(gap)) / a;
        const Vec at = add(o, t, d);
        if (t >= 0 && std::abs(at[1]) <= half)
            keep({.distance = t, .normal = {at[0] / r, 0, at[2] / r}, .margin = -1});
    }
    if (met.inside) return {.distance = 0, .normal = add({}, -1, d), .inside = true};
    return met;
}

Met meet_plane(const Plane& plane, const Vec& o, const Vec& d) {
    const Vec n = unit(from(plane.normal));
    const Real height = dot(n, o) - Real(plane.offset), slope = dot(n, d);
    if (height < 0) return {.distance = 0, .normal = add({}, -1, d), .inside = true};
    if (slope >= 0) return {.margin = 1};
    return {.distance = height / -slope, .normal = n, .margin = 1};
}

// Whether the line comes nowhere near a body of the crowd, all of which lie within 4 m of their
// positions.
bool passes_far(const Placed& placed, const Ray& ray) {
    if (std::holds_alternative<Plane>(placed.def.geometry)) return false;
    const Vec d = unit(from(ray.direction));
    const Vec arm = add(from(placed.state.position), -1, from(ray.origin));
    const Vec off = add(arm, -dot(arm, d), d);
    return dot(off, off) > 16;
}

Met meet(const Placed& placed, const Ray& ray) {
    if (passes_far(placed, ray)) return {.margin = -1};
    const Vec o = placed.to_local(from(ray.origin), true);
    const Vec d = placed.to_local(unit(from(ray.direction)), false);
    Met met;
    if (const auto* ball = std::get_if<Sphere>(&placed.def.geometry))
        met = meet_ball(Real(ball->radius), o, d);
    else if (const auto* box = std::get_if<Box>(&placed.def.geometry))
        met = meet_box(box->half_extents, o, d);
    else if (const auto* capsule = std::get_if<Capsule>(&placed.def.geometry))
        met = meet_capsule(*capsule, o, d);
    else
        met = meet_plane(*std::get_if<Plane>(&placed.def.geometry), o, d);
    met.normal = placed.to_world(met.normal);
    if (met.distance > Real(ray.length)) met.distance = -1;
    return met;
}

struct Crowd {
    World world;
    Position center;

    // Mixed bodies of one to three shapes that are turned and off their body's middle.
    Crowd(int count, Position at, BroadPhase broad_phase, std::uint64_t seed = 5) : center(at) {
        WorldSettings settings;
        settings.step.broad_phase = broad_phase;
        REQUIRE(world.set_settings(settings));
        RandomPlaces random{seed};
        for (int i = 0; i < count; ++i) {
            BodyDef def;
            def.kind = i % 4 == 0 ? BodyKind::Static : BodyKind::Dynamic;
            def.position = place(random.vector(10));
            def.rotation = random.turn();
            def.collision.category = 1u << (i % 5);
            for (int k = 0; k <= i % 3; ++k) {
                const Vec3 h = {float(random.between(0.1, 1)), float(random.between(0.1, 1)),
                                float(random.between(0.1, 1))};
                ShapeDef shape;
                if ((i + k) % 3 == 1)
                    shape.geometry = Sphere{h.x};
                else if ((i + k) % 3 == 2)
                    shape.geometry = Capsule{h.x, 2 * h.y};
                else
                    shape.geometry = Box{h};
                if (i % 3) shape.local_pose = {random.vector(1), random.turn()};
                def.shapes.push_back(shape);
            }
            REQUIRE(world.create_body(def));
        }
        BodyDef floor;
        floor.kind = BodyKind::Static;
        floor.position = place({0, -20, 0});
        floor.shapes = {{.geometry = Plane{}}};
        REQUIRE(world.create_body(floor));
    }
    Position place(Vec3 v) const {
        return {center.x + double(v.x), center.y + double(v.y), center.z + double(v.z)};
    }
    Ray ray(RandomPlaces& random) const {
        const Position origin = place(random.vector(15));
        return {origin, random.vector(1), random.unit() < 0.5 ? infinite : random.between(0, 30)};
    }
};

// The answers to many questions, to compare worlds by.
struct Answers {
    std::vector<RayHit> first;
    std::vector<std::vector<RayHit>> all;
    std::vector<NearestHit> nearest;
    std::vector<std::vector<BodyId>> within;
    std::vector<std::vector<ShapeId>> touching;
    bool operator==(const Answers&) const = default;
};

Answers ask(const Crowd& crowd, int count, std::uint64_t seed = 3) {
    Answers answers;
    RandomPlaces random{seed};
    const World& world = crowd.world;
    for (int i = 0; i < count; ++i) {
        const Ray ray = crowd.ray(random);
        answers.first.push_back(world.cast_ray(ray));
        answers.all.push_back(world.all_hits(ray));
        CHECK(world.any_hit(ray) == bool(answers.first.back()));
        const Position p = crowd.place(random.vector(25));
        answers.nearest.push_back(world.closest_point(p, i % 2 ? infinite : 3));
        answers.within.push_back(world.bodies_in({p, {p.x + 3, p.y + 4, p.z + 5}}));
        answers.touching.push_back(i % 2 ? world.overlapping(Sphere{2}, p, {})
                                         : world.overlapping(Box{{1, 2, 3}}, p, random.turn()));
    }
    return answers;
}

// Every ray against every shape; how many met something.
int check_rays(const Crowd& crowd, int count) {
    const std::vector<Placed> placed = place_all(crowd.world);
    // Float offsets of shapes, rounded in the world, and the grid of positions there.
    const Real rounding = 3e-6L + 4e-16L * Real(std::abs(crowd.center.x));
    RandomPlaces random{17};
    int met_count = 0;
    for (int i = 0; i < count; ++i) {
        const Ray ray = crowd.ray(random);
        const RayHit hit = crowd.world.cast_ray(ray);
        Real nearest = -1;
        bool grazes = false;
        Met at_hit;
        for (const Placed& shape : placed) {
            const Met met = meet(shape, ray);
            grazes |= std::abs(met.margin) < rounding;
            grazes |= std::abs(met.distance - Real(ray.length)) < rounding;
            if (shape.shape == hit.shape) at_hit = met;
            if (met.distance >= 0 && (nearest < 0 || met.distance < nearest))
                nearest = met.distance;
        }
        if (grazes) continue;
        REQUIRE(bool(hit) == (nearest >= 0));
        if (!hit) continue;
        ++met_count;
        REQUIRE(hit.inside == at_hit.inside);
        // A slanting ray stretches what rounding does to a surface.
        const Real slant = -dot(from(hit.normal), unit(from(ray.direction)));
        REQUIRE(slant > 0);
        CHECK(std::abs(Real(hit.distance) - nearest) * slant < 4 * rounding);
        const Vec off = add(from(hit.point), -1,
                            add(from(ray.origin), Real(hit.distance), unit(from(ray.direction))));
        CHECK(std::sqrt(dot(off, off)) < rounding);
        CHECK(dot(from(hit.normal), unit(at_hit.normal)) > 1 - 1e-6L);
        CHECK(crowd.world.body_of(hit.shape) == hit.body);
    }
    return met_count;
}

}  // namespace

TEST_CASE(
    "10,000 rays meet 500 mixed bodies where brute force says, near and far from the origin") {
    for (const double away : {0.0, 3e6}) {
        Crowd crowd(500, {away, -away, away}, BroadPhase::Tree);
        crowd.world.prepare_questions();
        CHECK(check_rays(crowd, away == 0 ? 10000 : 3000) > 1000);
    }
}

TEST_CASE("answers are the same bits by tree and brute force, prepared or not, moving or moved") {
    Crowd tree(200, {}, BroadPhase::Tree), brute(200, {}, BroadPhase::BruteForce);
    Crowd prepared = tree;
    prepared.world.prepare_questions();
    CHECK(ask(tree, 300) == ask(brute, 300));
    CHECK(ask(prepared, 300) == ask(brute, 300));
    for (int i = 0; i < 40; ++i) {
        for (Crowd* crowd : {&tree, &brute, &prepared}) REQUIRE(crowd->world.step(1.0 / 60));
        const Answers expected = ask(brute, 60, std::uint64_t(i));
        REQUIRE(ask(tree, 60, std::uint64_t(i)) == expected);
        REQUIRE(ask(prepared, 60, std::uint64_t(i)) == expected);
        REQUIRE(tree.world.state_hash() == brute.world.state_hash());
        REQUIRE(prepared.world.state_hash() == brute.world.state_hash());
        // Between steps bodies go elsewhere, come, go and change.
        RandomPlaces random{std::uint64_t(i)};
        const Vec3 to = random.vector(15), hit = random.vector(3000);
        const Quat turned = random.turn();
        for (Crowd* crowd : {&tree, &brute, &prepared}) {
            World& world = crowd->world;
            const std::vector<BodyId> bodies = world.bodies();
            REQUIRE(world.set_pose(bodies[std::size_t(i)], crowd->place(to), turned));
            REQUIRE(world.apply_impulse(bodies[std::size_t(i) + 60], hit));
            REQUIRE(world.destroy_body(bodies[std::size_t(i) + 120]));
            REQUIRE(world.create_body({.position = crowd->place(to), .shapes = {{}}}));
            REQUIRE(
                world.create_shape(bodies[std::size_t(i) + 40], {.geometry = Box{{2, 0.1f, 1}}}));
            if (crowd == &prepared && i % 2) world.prepare_questions();
        }
        const Answers changed = ask(brute, 60, std::uint64_t(i) + 100);
        REQUIRE(ask(tree, 60, std::uint64_t(i) + 100) == changed);
        REQUIRE(ask(prepared, 60, std::uint64_t(i) + 100) == changed);
    }
}

TEST_CASE("what is struck in a step is found where it went, however fast") {
    // A still ball far lighter than what hits it leaves faster than its box foresaw.
    for (const Solver solver : {Solver::SoftStep, Solver::SequentialImpulse, Solver::Xpbd}) {
        WorldSettings settings;
        settings.gravity = {};
        settings.step.solver = solver;
        World world = *World::create(settings);
        std::vector<BodyId> balls;
        const auto add_ball = [&](double x, Vec3 velocity, float density) {
            ShapeDef ball{.geometry = Sphere{0.1f}, .density = density};
            ball.material.restitution = 1;
            balls.push_back(*world.create_body(
                {.position = {x, 0, 0}, .linear_velocity = velocity, .shapes = {ball}}));
        };
        add_ball(0, {}, 1);
        add_ball(-3, {200, 0, 0}, 1000);
        for (int i = 0; i < 20; ++i) {
            REQUIRE(world.step(1.0 / 60));
            const Position at = world.position(balls[0]);
            const RayHit hit = world.cast_ray({{at.x, 5, 0}, {0, -1, 0}, 10}, {.except = balls[1]});
            REQUIRE(hit.body == balls[0]);
            CHECK(hit.distance == doctest::Approx(4.9 - at.y).epsilon(1e-6));
        }
        CHECK(world.position(balls[0]).x > 10);
    }
}

TEST_CASE("filters: category and mask, group, the one that asks, and a callback") {
    World world;
    std::vector<BodyId> balls;
    for (int i = 0; i < 4; ++i) {
        BodyDef def{.position = {double(2 * i), 0, 0}, .shapes = {{.geometry = Sphere{0.5f}}}};
        def.collision = {
            .category = 1u << i, .mask = i == 3 ? 0u : 0xffffffffu, .group = i == 1 ? -7 : 0};
        balls.push_back(*world.create_body(def));
    }
    const Ray ray{{-5, 0, 0}, {1, 0, 0}};
    const auto first = [&](const QueryFilter& filter) { return world.cast_ray(ray, filter).body; };
    CHECK(first({}) == balls[0]);
    CHECK(first({.except = balls[0]}) == balls[1]);
    CHECK(first({.collision = CollisionFilter{.mask = 4}}) == balls[2]);
    CHECK(first({.collision = CollisionFilter{.mask = 6}}) == balls[1]);
    CHECK(first({.collision = CollisionFilter{.mask = 6, .group = -7}}) == balls[2]);
    // The last one's mask lets nobody in; without a filter it is seen.
    CHECK_FALSE(first({.collision = CollisionFilter{.mask = 8}}));
    CHECK(world.all_hits(ray).size() == 4);
    const auto odd = [&](BodyId body, ShapeId) { return body == balls[1] || body == balls[3]; };
    const std::vector<RayHit> hits = world.all_hits(ray, {.accepts = odd});
    REQUIRE(hits.size() == 2);
    CHECK(hits[0].body == balls[1]);
    CHECK(hits[1].distance == doctest::Approx(10.5));
    CHECK(world.closest_point({0, 0.6, 0}, infinite, {.accepts = odd}).body == balls[1]);
    CHECK(world.bodies_in({{-1, -1, -1}, {7, 1, 1}}, {.accepts = odd}).size() == 2);
    CHECK(world.overlapping(Sphere{20}, {}, {}, {.except = balls[2]}).size() == 3);
    CHECK_FALSE(world.any_hit(ray, {.accepts = [](BodyId, ShapeId) { return false; }}));
}

TEST_CASE("a ray that begins in a body meets it at once, unless told to look beyond") {
    World world;
    const BodyId inner = *world.create_body({.shapes = {{.geometry = Box{{1, 1, 1}}}}});
    const BodyId outer = *world.create_body({.position = {5, 0, 0}, .shapes = {{}}});
    const RayHit hit = world.cast_ray({{0.5, 0, 0}, {2, 0, 0}});
    CHECK(hit.body == inner);
    CHECK(hit.inside);
    CHECK(hit.distance == 0);
    CHECK(hit.normal == Vec3{-1, 0, 0});
    CHECK(hit.point == Position{0.5, 0, 0});
    CHECK(world.cast_ray({{0.5, 0, 0}, {2, 0, 0}}, {.skip_inside = true}).body == outer);
    // Of length 0 only what holds the origin is met.
    CHECK(world.cast_ray({{0.5, 0, 0}, {1, 0, 0}, 0}).body == inner);
    CHECK_FALSE(world.cast_ray({{1.5, 0, 0}, {1, 0, 0}, 0}));
    const NearestHit nearest = world.closest_point({0.75, 0, 0});
    CHECK(nearest.body == inner);
    CHECK(nearest.distance == -0.25);
    CHECK(nearest.point == Position{1, 0, 0});
    CHECK_FALSE(world.closest_point({0, 9, 0}, 7.9));
}

TEST_CASE("a callback sees every shape once, and may shorten or end the ray") {
    Crowd crowd(500, {}, BroadPhase::Tree);
    const Ray ray{{-30, 0, 0}, {1, 0, 0}};
    const std::vector<RayHit> all = crowd.world.all_hits(ray);
    REQUIRE(all.size() > 3);
    CHECK(std::is_sorted(all.begin(), all.end(),
                         [](const RayHit& a, const RayHit& b) { return a.distance < b.distance; }));
    std::set<ShapeId> seen;
    crowd.world.visit_hits(ray, [&](const RayHit& hit) {
        CHECK(seen.insert(hit.shape).second);
        return ray.length;
    });
    CHECK(seen.size() == all.size());
    RayHit last;
    crowd.world.visit_hits(ray, [&](const RayHit& hit) {
        last = hit;
        return hit.distance;
    });
    CHECK(last == all[0]);
    for (const double ending : {-1.0, not_a_number}) {
        int calls = 0;
        crowd.world.visit_hits(ray, [&](const RayHit&) { return ++calls, ending; });
        CHECK(calls == 1);
    }
}

TEST_CASE("a ball or box touches what separation says: corners, edges and the floor") {
    World world;
    const BodyId block =
        *world.create_body({.kind = BodyKind::Static, .shapes = {{.geometry = Box{{1, 1, 1}}}}});
    const BodyId floor = *world.create_body(
        {.kind = BodyKind::Static, .position = {0, -5, 0}, .shapes = {{.geometry = Plane{}}}});
    const auto touched = [&](const Geometry& geometry, Position at) {
        std::vector<BodyId> bodies;
        for (const ShapeId shape : world.overlapping(geometry, at, {}))
            bodies.push_back(world.body_of(shape));
        return bodies;
    };
    using Bodies = std::vector<BodyId>;
    // Its bounding box overlaps, the ball does not: the corner is sqrt(3) * 0.6 away.
    CHECK(touched(Sphere{1}, {1.6, 1.6, 1.6}) == Bodies{});
    CHECK(touched(Sphere{1.1f}, {1.6, 1.6, 1.6}) == Bodies{block});
    CHECK(touched(Box{{0.5f, 0.5f, 0.5f}}, {1.49, 0, 0}) == Bodies{block});
    CHECK(touched(Box{{0.5f, 0.5f, 0.5f}}, {1.51, 0, 0}) == Bodies{});
    CHECK(touched(Sphere{1}, {50, -4.01, 0}) == Bodies{floor});
    CHECK(touched(Sphere{10}, {0, 3, 0}) == Bodies{block, floor});
    CHECK(world.bodies_in({{0.9, 0.9, 0.9}, {2, 2, 2}}) == Bodies{block, floor});
    CHECK(world.closest_point({4, 5, 0}).body == block);
    CHECK(world.closest_point({4, 5, 0}).distance == doctest::Approx(5));
    CHECK(world.closest_point({40, -2, 0}).body == floor);
    CHECK(world.closest_point({40, -2, 0}).distance == doctest::Approx(3));
}

TEST_CASE("many threads may ask at once, and hear what one hears") {
    Crowd crowd(300, {}, BroadPhase::Tree);
    REQUIRE(crowd.world.step(1.0 / 60));
    const Answers expected = ask(crowd, 200);
    std::array<Answers, 4> heard;
    std::vector<std::thread> threads;
    for (Answers& answers : heard) threads.emplace_back([&] { answers = ask(crowd, 200); });
    for (std::thread& thread : threads) thread.join();
    for (const Answers& answers : heard) CHECK(answers == expected);
}

TEST_CASE("questions that make no sense find nothing and say why") {
    World world;
    REQUIRE(world.create_body({.shapes = {{.geometry = Sphere{3}}}}));
    std::string said;
    world.set_error_handler([&](const Error& error) { said = error.message; });
    const auto says = [&](bool answer, const std::string& words) {
        CHECK_FALSE(answer);
        CHECK(said.find(words) != std::string::npos);
        said.clear();
    };
    const auto no_float = float(not_a_number);
    says(bool(world.cast_ray({{not_a_number, 0, 0}})),
         "cast_ray: ray.origin.x: nan; allowed: a finite");
    says(bool(world.cast_ray({{}, {0, no_float, 0}})), "ray.direction.y: nan");
    says(bool(world.cast_ray({{}, {0, 0, 0}})), "ray.direction: a vector of length 0");
    says(bool(world.cast_ray({{}, {0, 1, 0}, not_a_number})), "ray.length: nan");
    says(world.any_hit({{}, {0, 1, 0}, -1}), "any_hit: ray.length: -1; allowed: at least 0");
    says(world.any_hit({{}, {0, 1, 0}, -infinite}), "ray.length: -inf");
    says(!world.all_hits({{2e15, 0, 0}}).empty(), "all_hits: ray.origin.x: 2e+15");
    world.visit_hits({{not_a_number, 0, 0}}, [](const RayHit&) { return 1.0; });
    says(false, "visit_hits: ray.origin.x");
    says(!world.bodies_in({{0, 0, 0}, {0, not_a_number, 0}}).empty(), "box.upper.y: nan");
    says(!world.bodies_in({{0, 1, 0}, {0, 0, 0}}).empty(), "box.upper: a coordinate below");
    says(!world.overlapping(Plane{}, {}, {}).empty(), "a plane on a body that is not static");
    says(!world.overlapping(Sphere{-1}, {}, {}).empty(), "shape.geometry.radius: -1");
    says(!world.overlapping(Sphere{1}, {}, {0, 0, 0, 0}).empty(), "rotation: a quaternion");
    says(bool(world.closest_point({0, 0, infinite})), "closest_point: point.z: inf");
    says(bool(world.closest_point({}, -1)), "reach: -1");
    CHECK(world.cast_ray({}));
    CHECK(said.empty());
}

TEST_CASE("a ray along an axis at the far end of the world meets what is there") {
    World world;
    const BodyId far = *world.create_body({.kind = BodyKind::Static,
                                           .position = {9e14, 9e14, 0},
                                           .shapes = {{.geometry = Box{{2, 2, 2}}}}});
    REQUIRE(world.step(1.0 / 60));
    const RayHit hit = world.cast_ray({{-9e14, 9e14, 0}, {1, 0, 0}});
    CHECK(hit.body == far);
    CHECK(hit.distance == doctest::Approx(1.8e15 - 2).epsilon(1e-15));
    CHECK(world.cast_ray({{9e14, 9e14, 10}, {0, 0, -1}}).distance == 8);
}
