#pragma once
// A scene as a value: what a scene file says, before it becomes a world.
//
// Reads: the text of a scene file (docs/scene.schema.json). Writes: the same text, and a world.
// A scene that is read is checked: every number in it is finite and makes sense, every name that it
// mentions exists. Errors are one line, "path: what was found; what is allowed", with the path of
// the offending value as `bodies[3].shapes[0].radius`. Nothing here throws or prints.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cairn/cairn.h"
#include "scene/replay.h"

namespace cairn::scene {

/// Copies of a body on a grid along the world's axes, centred on the body's position.
struct Repeat {
    std::array<std::int64_t, 3> count = {1, 1, 1};  ///< each >= 1
    Position spacing = {};                          ///< m
    double jitter = 0;       ///< m, >= 0: each coordinate is moved by up to this, either way
    std::uint64_t seed = 0;  ///< of the PCG32 that jitters
    friend bool operator==(const Repeat&, const Repeat&) = default;
};

/// An entry of the scene's list of bodies.
struct SceneBody {
    std::string name = {};  ///< empty: the body is called after its place in the scene's order
    BodyDef def = {};
    /// The material's name for each shape, empty where the shape has its own numbers. Not longer
    /// than def.shapes; the numbers stand in def either way.
    std::vector<std::string> materials = {};
    bool continuous = false;
    std::optional<Repeat> repeat = {};
};

struct NamedMaterial {
    std::string name;
    Material material;
};

struct Scene {
    std::string name = {};
    std::string description = {};
    double duration = 10;  ///< s, that a run takes unless told otherwise
    double dt = 1.0 / 60;  ///< s
    WorldSettings world = {};
    bool continuous = true;
    std::vector<NamedMaterial> materials = {};
    std::vector<SceneBody> bodies = {};
    Camera camera = {};
};

/// A scene may ask for this many bodies in all.
inline constexpr std::int64_t max_bodies = 10'000'000;
/// A scene file may be this long, bytes.
inline constexpr std::size_t max_scene_bytes = std::size_t{1} << 30;
/// What a step may last, s.
inline constexpr double min_dt = 1e-9;
inline constexpr double max_dt = 100;

/// Reads a scene from the text of a scene file.
Result<Scene> read_scene(std::string_view text);
/// Reads a scene from a file, or from standard input where the path is "-".
Result<Scene> read_scene_file(const std::string& path);
/// The text of a scene file that reads back to the same scene, to the bit.
std::string write_scene(const Scene& scene);

/// How many bodies the scene has, copies included.
std::int64_t count_bodies(const Scene& scene);

/// A body of the scene after the repeats are written out.
struct PlacedBody {
    std::size_t entry = 0;  ///< its entry in Scene::bodies
    std::string name = {};
    Position position = {};
};
/// Every body in the scene's order, copies x fastest, then y, then z.
std::vector<PlacedBody> place_bodies(const Scene& scene);

struct BuiltWorld {
    World world;
    std::vector<std::string> names;  ///< in the order of World::bodies(), which is the scene's
};
/// A world as the scene says, or the error, with its path, that forbids it.
Result<BuiltWorld> build_world(const Scene& scene);

// The words of the format, in the order in which messages list them.
std::string_view solver_name(Solver solver);
std::string_view narrow_phase_name(NarrowPhase narrow_phase);
std::string_view broad_phase_name(BroadPhase broad_phase);
/// What a word names, or an error: what is allowed, or that it is not yet supported.
Result<Solver> parse_solver(std::string_view word);
Result<NarrowPhase> parse_narrow_phase(std::string_view word);
Result<BroadPhase> parse_broad_phase(std::string_view word);

}  // namespace cairn::scene
