// A Scene to a World.
//
// Reads: a Scene. Writes: bodies in the scene's order, with their names. Jitter is drawn x, y, z,
// copy by copy, from one PCG32 a repeat. What the world itself refuses comes back with the path of
// its body.

#include <fmt/format.h>

#include <new>

#include "scene/pcg32.h"
#include "scene/scene.h"

namespace cairn::scene {

namespace {

// Calls visit(entry, name, position) for every body in the scene's order, until it answers false.
template <class Visit>
void visit_bodies(const Scene& scene, Visit visit) {
    std::int64_t place = 0;
    for (std::size_t entry = 0; entry < scene.bodies.size(); ++entry) {
        const SceneBody& body = scene.bodies[entry];
        if (!body.repeat) {
            std::string name = body.name.empty() ? fmt::format("body[{}]", place) : body.name;
            if (!visit(entry, std::move(name), body.def.position)) return;
            ++place;
            continue;
        }
        const Repeat& repeat = *body.repeat;
        Pcg32 random(repeat.seed);
        for (std::int64_t z = 0; z < repeat.count[2]; ++z) {
            for (std::int64_t y = 0; y < repeat.count[1]; ++y) {
                for (std::int64_t x = 0; x < repeat.count[0]; ++x, ++place) {
                    const auto offset = [&](std::int64_t i, std::int64_t count, double spacing) {
                        return (static_cast<double>(i) - 0.5 * static_cast<double>(count - 1)) *
                               spacing;
                    };
                    Position p = body.def.position;
                    p.x += offset(x, repeat.count[0], repeat.spacing.x);
                    p.y += offset(y, repeat.count[1], repeat.spacing.y);
                    p.z += offset(z, repeat.count[2], repeat.spacing.z);
                    if (repeat.jitter > 0) {
                        p.x += random.symmetric(repeat.jitter);
                        p.y += random.symmetric(repeat.jitter);
                        p.z += random.symmetric(repeat.jitter);
                    }
                    std::string name = body.name.empty()
                                           ? fmt::format("body[{}]", place)
                                           : fmt::format("{}[{},{},{}]", body.name, x, y, z);
                    if (!visit(entry, std::move(name), p)) return;
                }
            }
        }
    }
}

}  // namespace

std::int64_t count_bodies(const Scene& scene) {
    std::int64_t total = 0;
    for (const SceneBody& body : scene.bodies) {
        const auto& repeat = body.repeat;
        total += repeat ? repeat->count[0] * repeat->count[1] * repeat->count[2] : 1;
    }
    return total;
}

std::vector<PlacedBody> place_bodies(const Scene& scene) {
    std::vector<PlacedBody> placed;
    placed.reserve(static_cast<std::size_t>(count_bodies(scene)));
    visit_bodies(scene, [&](std::size_t entry, std::string name, const Position& position) {
        placed.push_back({entry, std::move(name), position});
        return true;
    });
    return placed;
}

namespace {

Result<BuiltWorld> create_bodies(const Scene& scene) {
    Result<World> world = World::create(scene.world);
    if (!world) return Error{world.error().code, "world: " + world.error().message};
    BuiltWorld built{std::move(world).value(), {}};
    built.names.reserve(static_cast<std::size_t>(count_bodies(scene)));
    std::optional<Error> error;
    BodyDef def;
    std::size_t loaded_entry = SIZE_MAX;
    visit_bodies(scene, [&](std::size_t entry, std::string name, const Position& position) {
        const SceneBody& body = scene.bodies[entry];
        if (entry != loaded_entry) def = body.def;
        loaded_entry = entry;
        def.position = position;
        const Result<BodyId> id = built.world.create_body(def);
        if (!id) {
            error =
                Error{id.error().code, fmt::format("bodies[{}]{}: {}", entry,
                                                   body.repeat ? ".body" : "", id.error().message)};
            return false;
        }
        built.names.push_back(std::move(name));
        return true;
    });
    if (error) return *error;
    return built;
}

}  // namespace

Result<BuiltWorld> build_world(const Scene& scene) {
    try {
        return create_bodies(scene);
    } catch (const std::bad_alloc&) {
        return Error{
            ErrorCode::OutOfRange,
            fmt::format("the scene's {} bodies do not fit into memory", count_bodies(scene))};
    }
}

}  // namespace cairn::scene
