// The tree finds what brute force finds: the same future, to the bit, while bodies come and go.

#include <doctest/doctest.h>

#include "pile.h"

using namespace cairn;

TEST_CASE("a heap takes the same future whichever broad phase finds its pairs") {
    WorldSettings settings;
    settings.step.broad_phase = BroadPhase::BruteForce;
    World brute = test::make_pile(test::methods[2], 40);
    settings = brute.settings();
    settings.step.broad_phase = BroadPhase::Tree;
    World tree = brute;
    REQUIRE(tree.set_settings(settings).ok());
    settings.step.broad_phase = BroadPhase::BruteForce;
    REQUIRE(brute.set_settings(settings).ok());
    for (int step = 0; step < 400; ++step) {
        for (World* world : {&brute, &tree}) {
            const std::vector<BodyId> bodies = world->bodies();
            const BodyId some = bodies[1 + static_cast<std::size_t>(step) % (bodies.size() - 1)];
            if (step % 7 == 3) (void)world->destroy_body(some);
            if (step % 7 == 5) (void)world->create_body(test::pile_body(step % 30));
            if (step % 31 == 8) (void)world->set_pose(some, {0.5, 4, 0.3}, {});
            if (step % 43 == 9) (void)world->set_kind(some, BodyKind::Static);
            if (step % 53 == 10) (void)world->set_kind(some, BodyKind::Dynamic);
            (void)world->step(test::pile_dt);
        }
        REQUIRE(brute.state_hash() == tree.state_hash());
        REQUIRE(brute.last_step().pair_count == tree.last_step().pair_count);
    }
}
