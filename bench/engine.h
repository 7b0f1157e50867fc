#pragma once
// What a benchmark asks of an engine, Cairn or a peer: to build a scene of boxes, to step it, and
// to say where the boxes are. One adapter file an engine; none of them reads a clock.

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace cairn::bench {

struct BoxBody {
    std::array<double, 3> position = {};      // m
    std::array<double, 3> half_extents = {};  // m
    double density = 0;                       // kg/m^3; 0: static
};

struct BenchScene {
    std::string name;
    std::vector<BoxBody> boxes;
    double gravity = 9.81;  // m/s^2, downward along y
    double friction = 0.6;  // of every pair
    double dt = 1.0 / 60;   // s
    std::size_t top = 0;    // the box whose drift is reported
};

struct BoxMotion {
    std::array<double, 3> position = {};
    std::array<double, 4> rotation = {0, 0, 0, 1};  // x, y, z, w
    std::array<double, 3> linear_velocity = {};
    std::array<double, 3> angular_velocity = {};  // world frame
};

// One world in one engine. Restitution is 0, nothing sleeps, one thread, the engine's own defaults
// for all else.
class Engine {
public:
    Engine() = default;
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;
    virtual ~Engine() = default;

    virtual void step(double dt) = 0;
    virtual BoxMotion motion(std::size_t box) const = 0;
};

struct EngineEntry {
    std::string name;     // with its version
    std::string setting;  // what stands for its default budget
    std::unique_ptr<Engine> (*make)(const BenchScene& scene);
};

std::vector<EngineEntry> cairn_engines();
std::vector<EngineEntry> bullet_engines();  // only where Bullet was found
std::vector<EngineEntry> ode_engines();     // only where ODE was found

}  // namespace cairn::bench
