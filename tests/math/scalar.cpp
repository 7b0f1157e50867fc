// Cairn's own trigonometry against the C library's, which tests may use.

#include "math/scalar.h"

#include <doctest/doctest.h>

#include <cmath>

#include "math/aabb.h"
#include "math/quat.h"

TEST_CASE("sine and cosine err below 1e-15 near 0 and below 1e-14 out to 1e6 radians") {
    for (int i = -20000; i <= 20000; ++i) {
        const double x = i * 0.001;
        const cairn::SineCosine got = cairn::sine_cosine(x);
        REQUIRE(std::abs(got.sine - std::sin(x)) < 1e-15);
        REQUIRE(std::abs(got.cosine - std::cos(x)) < 1e-15);
        const double far = i * 49.987;
        REQUIRE(std::abs(cairn::sine_cosine(far).sine - std::sin(far)) < 1e-14);
    }
}

TEST_CASE("the arc tangent errs below 1e-15 in all four quadrants and on the axes") {
    for (int i = -100; i <= 100; ++i) {
        for (int j = -100; j <= 100; ++j) {
            if (i == 0 && j == 0) continue;
            REQUIRE(std::abs(cairn::exact_arc_tangent2(i * 0.37, j * 0.21) -
                             std::atan2(i * 0.37, j * 0.21)) < 1e-15);
        }
    }
    CHECK(cairn::exact_arc_tangent2(0, 0) == 0);
}

TEST_CASE("the exponential map turns by |theta| about theta at every angle") {
    for (int i = 1; i < 400; ++i) {
        const float angle = float(i) * 0.05f;
        const cairn::Quat q = cairn::exponential_map({0, angle, 0});
        REQUIRE(std::abs(double(q.y) - std::sin(0.5 * double(angle))) < 1e-7);
        REQUIRE(std::abs(double(q.w) - std::cos(0.5 * double(angle))) < 1e-7);
    }
    CHECK(cairn::exponential_map({}) == cairn::Quat{});
}

TEST_CASE("a bounding box holds its body wherever it lies, and loses at most one rounding") {
    for (const double x : {0.0, 0.1, -0.3, 1234.567, -1e7, 3.3e12}) {
        const cairn::Aabb box = cairn::box_around({x, x, x}, {0.25f, 0.25f, 0.25f});
        CHECK(double(box.lower.x) <= x - 0.25);
        CHECK(double(box.upper.x) >= x + 0.25);
        CHECK(double(box.upper.x) - x - 0.25 <= std::abs(x) * 1.2e-7 + 1e-7);
    }
}

TEST_CASE("a symmetric matrix times its inverse is the identity") {
    const cairn::SymmetricMat3 m = {4, 5, 6, 0.5f, -0.25f, 1};
    const cairn::SymmetricMat3 inverse = cairn::inverse(m);
    const cairn::Vec3 x = m * (inverse * cairn::Vec3{1, 2, 3});
    CHECK(double(x.x) == doctest::Approx(1).epsilon(1e-6));
    CHECK(double(x.y) == doctest::Approx(2).epsilon(1e-6));
    CHECK(double(x.z) == doctest::Approx(3).epsilon(1e-6));
}
