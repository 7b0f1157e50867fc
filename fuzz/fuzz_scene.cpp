// A libFuzzer target: any bytes as a scene file, read, written, built and stepped.
//
// Reads: bytes. Checks: what reads is written and reads back to the same text; what builds steps
// without leaving a finite state; a copy of the world takes the same future; the doctor ends.
// Bounds on bodies, shapes and steps keep each input fast. Every check that fails ends the program
// with a line that says which.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "scene/check.h"
#include "scene/scene.h"

namespace {

using namespace cairn;

void require(bool claim, const char* words) {
    if (claim) return;
    std::fprintf(stderr, "broken claim: %s\n", words);
    std::abort();
}

bool is_finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool is_finite(const BodyState& s) {
    const bool has_place =
        std::isfinite(s.position.x) && std::isfinite(s.position.y) && std::isfinite(s.position.z);
    const bool has_turn = std::isfinite(s.rotation.x) && std::isfinite(s.rotation.y) &&
                          std::isfinite(s.rotation.z) && std::isfinite(s.rotation.w);
    return has_place && has_turn && is_finite(s.linear_velocity) && is_finite(s.angular_velocity);
}

bool is_small(const scene::Scene& scene) {
    std::size_t shapes = 0;
    for (const scene::SceneBody& body : scene.bodies) shapes += body.def.shapes.size();
    return scene::count_bodies(scene) <= 60 && shapes <= 200;
}

void check_step(World& world, double dt) {
    // A world may refuse a step; it may not break.
    static_cast<void>(world.step(dt));
    for (const BodyId body : world.bodies()) {
        const BodyState state = world.state(body);
        require(is_finite(state), "a body's state is finite after every step");
        const double x = state.rotation.x, y = state.rotation.y, z = state.rotation.z,
                     w = state.rotation.w;
        require(std::fabs(x * x + y * y + z * z + w * w - 1) < 1e-4,
                "a rotation stays a unit quaternion");
    }
    for (const ContactReport& contact : world.contacts()) {
        require(contact.point_count >= 0 && contact.point_count <= 4,
                "a contact has at most four points");
        require(is_finite(contact.normal), "a contact's normal is finite");
        for (int i = 0; i < contact.point_count; ++i) {
            const ContactPointReport& point = contact.points[static_cast<std::size_t>(i)];
            require(std::isfinite(point.separation), "a separation is finite");
            require(point.normal_impulse >= 0, "a normal impulse does not pull");
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const Result<scene::Scene> read =
        scene::read_scene({reinterpret_cast<const char*>(bytes), size});
    if (!read) {
        require(!read.error().message.empty(), "an error says something");
        require(read.error().message.find('\n') == std::string::npos, "an error is one line");
        return 0;
    }
    if (!is_small(*read)) return 0;

    const std::string text = scene::write_scene(*read);
    const Result<scene::Scene> again = scene::read_scene(text);
    require(again.ok(), "what is written can be read");
    require(scene::write_scene(*again) == text, "what is read again is written the same");

    const Result<scene::BuiltWorld> built = scene::build_world(*read);
    if (!built) return 0;
    const Result<scene::BuiltWorld> twin = scene::build_world(*again);
    require(twin.ok(), "what is written makes a world, as the first did");
    require(built->world.state_hash() == twin->world.state_hash(), "both worlds begin the same");
    static_cast<void>(scene::find_misbehaviour(*read));

    // A thousand substeps of a thousand iterations are lawful, and slow.
    World world = built->world, copy = twin->world;
    WorldSettings settings = world.settings();
    settings.step.substeps = std::min(settings.step.substeps, 4);
    settings.step.iterations = std::min(settings.step.iterations, 10);
    if (settings.step.solver == Solver::Xpbd && settings.step.substeps == 0)
        settings.step.substeps = 4;
    require(world.set_settings(settings).ok() && copy.set_settings(settings).ok(),
            "settings of a world fit it");
    for (int step = 0; step < 12; ++step) {
        check_step(world, read->dt);
        static_cast<void>(copy.step(read->dt));
        require(world.state_hash() == copy.state_hash(), "the same world takes the same future");
    }
    return 0;
}
