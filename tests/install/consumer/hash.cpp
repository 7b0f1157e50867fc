// Prints the state hash of a heap of spinning boxes and balls that is made with the public
// arithmetic (turned, scaled, normalised), so that any of it that a user's flags could reach would
// show.

#include <cairn/cairn.h>

#include <cstdio>

int main() {
    cairn::World world;
    (void)world.create_body({.kind = cairn::BodyKind::Static,
                             .shapes = {{.geometry = cairn::Plane{{0.02f, 1, 0.01f}}}}});
    const cairn::Vec3 aside = cairn::normalize(cairn::Vec3{1, 0.3f, 0.7f});
    for (int i = 0; i < 24; ++i) {
        const cairn::Quat turn = cairn::rotation_about({1, 2, 3}, 0.37 * i);
        const cairn::Vec3 place =
            cairn::rotate(turn, 0.6f * aside) + cairn::Vec3{0, 0.4f * static_cast<float>(i), 0};
        cairn::BodyDef def{.position = cairn::Position{0, 1, 0} + place,
                           .rotation = turn * turn,
                           .linear_velocity = cairn::cross(place, aside),
                           .angular_velocity = cairn::rotate_inverse(turn, {1, 0, 3})};
        def.shapes.push_back({.geometry = cairn::Box{{0.2f, 0.1f, 0.3f}}});
        if (i % 3 == 0) def.shapes.push_back({.geometry = cairn::Sphere{0.25f}});
        if (!world.create_body(def).ok()) return 1;
    }
    for (int step = 0; step < 240; ++step) {
        // Denormal forces: a processor told to flush them must not change a bit.
        const cairn::BodyId body = world.bodies()[1 + static_cast<std::size_t>(step) % 24];
        (void)world.apply_force(body, {1e-39f, 0, 0});
        if (!world.step(1.0 / 60).ok()) return 1;
    }
    std::printf("%016llx\n", static_cast<unsigned long long>(world.state_hash()));
    return 0;
}
