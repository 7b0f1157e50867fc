// Scenes that are lawful and mad: whatever becomes of their bodies, every number stays one, what
// cannot move stays as it was, and what went wrong is told. Runs tests/corpus/hostile by every
// method.

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>

#include "scene/scene.h"

using namespace cairn;

namespace {

bool is_finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool is_finite(const BodyState& s) {
    return is_finite(s.linear_velocity) && is_finite(s.angular_velocity) &&
           std::isfinite(s.position.x) && std::isfinite(s.position.y) &&
           std::isfinite(s.position.z) && std::isfinite(s.rotation.x) &&
           std::isfinite(s.rotation.y) && std::isfinite(s.rotation.z) &&
           std::isfinite(s.rotation.w);
}

void run_hostile(const std::string& file, Solver solver, NarrowPhase narrow_phase) {
    Result<scene::Scene> read = scene::read_scene_file(file);
    REQUIRE(read.ok());
    Result<scene::BuiltWorld> built = scene::build_world(*read);
    REQUIRE(built.ok());
    World world = built->world;
    WorldSettings settings = world.settings();
    settings.step = {.solver = solver, .narrow_phase = narrow_phase};
    REQUIRE(world.set_settings(settings).ok());
    for (int step = 0; step < 30; ++step) {
        REQUIRE(world.step(read->dt).ok());
        for (const BodyId body : world.bodies()) {
            const BodyState state = world.state(body);
            REQUIRE(is_finite(state));
            if (state.kind != BodyKind::Static) continue;
            REQUIRE(state.linear_velocity == Vec3{});
            REQUIRE(state.angular_velocity == Vec3{});
        }
    }
}

}  // namespace

TEST_CASE("in mad scenes every number stays one, and what cannot move stays as it was") {
    std::size_t count = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(CAIRN_SOURCE_DIR "/tests/corpus/hostile")) {
        ++count;
        for (const Solver solver : {Solver::SequentialImpulse, Solver::SoftStep, Solver::Xpbd}) {
            for (const NarrowPhase narrow_phase : {NarrowPhase::Sat, NarrowPhase::GjkEpa}) {
                CAPTURE(entry.path().string());
                CAPTURE(static_cast<int>(solver));
                run_hostile(entry.path().string(), solver, narrow_phase);
            }
        }
    }
    CHECK(count > 0);
}
