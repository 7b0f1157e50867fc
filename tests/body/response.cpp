// How bodies answer impulses when axes are locked.

#include <doctest/doctest.h>

#include "body/body.h"

using namespace cairn;

TEST_CASE("a body that may turn about one axis alone answers a torque as a flywheel does") {
    // About x alone, the angular acceleration is torque / I_xx, however the tensor is coupled.
    const BodyInertia inertia = make_inertia({.mass = 2, .inertia = {3, 4, 5, 0.5f, 0.25f, -0.5f}});
    BodyDrive drive;
    drive.lock.ry = drive.lock.rz = true;
    const Response response = find_response(inertia, drive, {});
    const Vec3 spin = response.inverse_inertia * Vec3{6, 1, 1};
    CHECK(double(spin.x) == doctest::Approx(2).epsilon(1e-6));
    CHECK(spin.y == 0);
    CHECK(spin.z == 0);
}

TEST_CASE("a locked direction has no inverse mass, the others keep theirs") {
    const BodyInertia inertia = make_inertia({.mass = 4, .inertia = {1, 1, 1, 0, 0, 0}});
    BodyDrive drive;
    drive.lock.y = true;
    CHECK(find_response(inertia, drive, {}).inverse_mass == Vec3{0.25f, 0, 0.25f});
}

TEST_CASE("a turned body's response is its own, seen from the world") {
    const BodyInertia inertia = make_inertia({.mass = 1, .inertia = {1, 2, 4, 0, 0, 0}});
    const Quat quarter_about_z = exponential_map({0, 0, 1.57079632679f});
    const Response response = find_response(inertia, {}, quarter_about_z);
    CHECK(double((response.inverse_inertia * Vec3{1, 0, 0}).x) ==
          doctest::Approx(0.5).epsilon(1e-5));
    CHECK(double((response.inverse_inertia * Vec3{0, 1, 0}).y) == doctest::Approx(1).epsilon(1e-5));
}
