// Free motion: what a substep must conserve.

#include <doctest/doctest.h>

#include <cmath>

#include "integrate/integrate.h"

using namespace cairn;

namespace {

struct Tumbling {
    SymmetricMat3 inertia = {13.0f / 300, 10.0f / 300, 5.0f / 300, 0, 0, 0};
    SymmetricMat3 inverse_inertia = inverse(inertia);
    Quat rotation;
    Vec3 spin = {1, 5, 0.1f};

    double energy() const {
        const Vec3 w = rotate_inverse(rotation, spin);
        const Vec3 l = inertia * w;
        return 0.5 *
               (double(w.x) * double(l.x) + double(w.y) * double(l.y) + double(w.z) * double(l.z));
    }
    Vec3 momentum() const { return rotate(rotation, inertia * rotate_inverse(rotation, spin)); }
};

}  // namespace

TEST_CASE("a tumbling box keeps its energy and its angular momentum, in size and direction") {
    for (const float h : {1.0f / 60, 1.0f / 1200}) {
        Tumbling body;
        const double energy = body.energy();
        const Vec3 momentum = body.momentum();
        for (int i = 0; i < 6000; ++i) {
            free_rotation(body.rotation, body.spin, body.inertia, body.inverse_inertia, h);
        }
        CHECK(std::abs(body.energy() / energy - 1) < 1e-3);
        CHECK(double(length(body.momentum() - momentum) / length(momentum)) < 1e-3);
    }
}

TEST_CASE("a spin faster than a turn a substep neither blows up nor gains energy") {
    Tumbling body;
    body.spin = {30, 400, 20};
    const double energy = body.energy();
    for (int i = 0; i < 2000; ++i) {
        free_rotation(body.rotation, body.spin, body.inertia, body.inverse_inertia, 1.0f / 60);
        REQUIRE(body.energy() < 1.002 * energy);
    }
}

TEST_CASE("a steady spin turns by h w a substep, whatever the substep") {
    Quat q;
    for (int i = 0; i < 600; ++i) q = turn(q, {0, 0, 20.0f / 60});
    // 200 rad about z, less 31 turns.
    const double angle = 2 * std::atan2(double(q.z), double(q.w));
    CHECK(std::abs(std::remainder(angle - 200, 2 * 3.14159265358979)) < 1e-4);
}

TEST_CASE("a damped speed is divided by 1 + c h every substep") {
    const BodyInertia inertia = make_inertia({.mass = 1, .inertia = {1, 1, 1, 0, 0, 0}});
    BodyDrive drive;
    drive.linear_damping = 0.5f;
    BodyMotion motion;
    motion.linear_velocity = {1, 0, 0};
    const Response response = find_response(inertia, drive, {});
    for (int i = 0; i < 24000; ++i)
        integrate_velocity(motion, inertia, drive, response, {}, 1.0f / 4800);
    CHECK(double(motion.linear_velocity.x) ==
          doctest::Approx(std::pow(1 + 0.5 / 4800, -24000.0)).epsilon(1e-5));
}

TEST_CASE("a box that tumbles slowly does as one that is solved, to the rounding of a substep") {
    for (const float speed : {1e-3f, 0.1f, 2.0f}) {
        Tumbling solved, slow;
        solved.rotation = slow.rotation = turn({}, {0.3f, -1, 0.7f});
        solved.spin = slow.spin = speed * normalize_or(Vec3{1, 2, 0.1f}, {});
        const float h = 1.0f / 240;
        REQUIRE(h * speed < slow_turn);
        const float before = length(slow.spin);
        for (int i = 0; i < 240; ++i) {
            free_rotation(solved.rotation, solved.spin, solved.inertia, solved.inverse_inertia, h);
            const Vec3 steady =
                tumble_slowly(slow.rotation, slow.spin, slow.inertia, slow.inverse_inertia, h);
            slow.rotation = turn(slow.rotation, h * steady);
        }
        // Rounded 240 times, a few operations each.
        CHECK(double(length(slow.spin - solved.spin)) < 5e-5 * double(before));
        const Quat apart = slow.rotation * conjugate(solved.rotation);
        const double turned = std::hypot(double(apart.x), double(apart.y), double(apart.z));
        CHECK(turned < 5e-5);
        CHECK(std::abs(slow.energy() / solved.energy() - 1) < 1e-4);
    }
}
