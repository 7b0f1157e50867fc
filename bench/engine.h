#pragma once
// What a benchmark asks of an engine, Cairn or a peer: to build a scene, to step it, and to say
// where the bodies are. One adapter file an engine, one program an engine; no adapter reads a
// clock.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "scene.h"

namespace cairn::bench {

struct BodyMotion {
    Vector position = {};  // of the body's origin, world
    Rotation rotation = {0, 0, 0, 1};
    Vector linear_velocity = {};
    Vector angular_velocity = {};  // world frame
};

/// One world in one engine. Restitution 0, no damping; the engine's own defaults for all else.
/// Bodies are numbered in the order in which they were added, as in the scene.
class Engine {
public:
    Engine() = default;
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;
    virtual ~Engine() = default;

    /// Also between two steps, for what a scene brings in later.
    virtual void add(const BenchScene& scene, const SceneBody& body) = 0;
    /// After the bodies that are there from the start.
    virtual void finish_building() {}
    virtual void step(double dt) = 0;
    virtual BodyMotion motion(std::size_t body) const = 0;
    /// How many dynamic bodies are awake; negative where the engine does not say.
    virtual std::int64_t count_awake() const { return -1; }
    /// The budget it runs with, in words.
    virtual std::string settings() const = 0;
};

struct EngineRequest {
    std::string variant;  // one of the description's
    int threads = 1;
};

/// An engine, or why there is none.
struct MadeEngine {
    std::unique_ptr<Engine> engine;
    std::string problem;
};

struct EngineDescription {
    std::string name;  // as people write it
    std::string version;
    std::vector<std::string> variants;  // as the command line names them, the default first
};

// Each program has one adapter, and so one definition of these.
EngineDescription describe_engine();
/// A world with the scene's settings, without its bodies.
MadeEngine make_engine(const BenchScene& scene, const EngineRequest& request);

}  // namespace cairn::bench
