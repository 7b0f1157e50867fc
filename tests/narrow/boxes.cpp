// Box against box: the cases with a known answer, and thousands against judges that work otherwise.
// Each for SAT and for GJK with EPA.

#include <doctest/doctest.h>

#include "judge.h"
#include "narrow/box_pair.h"

using namespace cairn;
using namespace cairn::judge;
using doctest::Approx;

namespace {

constexpr double pi = 3.14159265358979323846;
const Box cube{{0.5f, 0.5f, 0.5f}};

// Stands a cube's diagonal upright: (1, 1, 1) becomes z.
Quat diagonal_upright() { return turn({1, -1, 0}, std::acos(1 / std::sqrt(3.0))); }

// The worst of what a pair of boxes can be wrong in, as a part of the smaller one's size.
struct Verdict {
    double separation = 0;
    double along_normal = 0;
    double unit = 0;
    double witness = 0;

    void judge(const Box& a, const Box& b, const Pose& pose, const Axis& axis, double truth) {
        const WideBox wide_a(a, {}), wide_b(b, pose);
        const double s = axis.separation;
        separation = std::max(separation, std::abs(s - truth));
        along_normal = std::max(along_normal,
                                std::abs(s - separation_along(wide_a, wide_b, wide(axis.normal))));
        unit = std::max(unit, std::abs(length(wide(axis.normal)) - 1));
        if (s > 0) {
            const V gap = wide(pose.position) + wide(axis.point_b) - wide(axis.point_a);
            witness = std::max({witness, std::abs(length(gap) - s),
                                wide_a.distance_to(wide(axis.point_a)),
                                wide_b.distance_to(wide(pose.position) + wide(axis.point_b))});
        }
    }
};

}  // namespace

TEST_CASE("C05: a cube on its corner above a face is dz - 1/2 - sqrt(3)/2 away") {
    for (NarrowPhase method : methods) {
        CAPTURE(int(method));
        for (double dz : {1.6, 1.3}) {
            const Axis axis =
                axis_of(cube, cube, {{0.1f, -0.07f, float(dz)}, diagonal_upright()}, method);
            CHECK(std::abs(double(axis.separation) - (dz - 0.5 - std::sqrt(3.0) / 2)) < 1e-5);
            CHECK(length(axis.normal - Vec3{0, 0, 1}) < 1e-5f);
            CHECK(length(axis.point_b - Vec3{0, 0, -float(std::sqrt(3.0) / 2)}) < 1e-5f);
        }
    }
}

TEST_CASE("C06: crossed edges are dz - sqrt(2) away, along their common perpendicular") {
    for (NarrowPhase method : methods) {
        CAPTURE(int(method));
        for (double dz : {1.5, 1.4}) {
            const Pose a = {{}, turn({1, 0, 0}, pi / 4)},
                       b = {{0, 0, float(dz)}, turn({0, 1, 0}, pi / 4)};
            AxisHint hint;
            const Axis axis = find_axis(cube, cube, inverse(a) * b, method, hint);
            CHECK(std::abs(double(axis.separation) - (dz - std::sqrt(2.0))) < 1e-5);
            CHECK(length(rotate(a.rotation, axis.normal) - Vec3{0, 0, 1}) < 1e-5f);
            CHECK(hint.kind == std::uint8_t(BoxAxisKind::EdgePair));
            CHECK(hint.index_a == 0);
            CHECK(hint.index_b == 1);
            const Vec3 point = rotate(a.rotation, axis.point_a);
            CHECK(std::abs(point.x) < 1e-4f);
            CHECK(std::abs(point.y) < 1e-4f);
        }
    }
}

TEST_CASE("C07, C08: an edge in a face, a face in a face") {
    for (NarrowPhase method : methods) {
        CAPTURE(int(method));
        const Axis edge =
            axis_of(cube, cube, {{0.2f, 0.1f, 1.15f}, turn({1, 0, 0}, pi / 4)}, method);
        CHECK(std::abs(double(edge.separation) + 0.0571068) < 1e-5);
        CHECK(length(edge.normal - Vec3{0, 0, 1}) < 1e-5f);
        const Axis face = axis_of(cube, cube, {{0.9f, 0.2f, 0.1f}, {}}, method);
        CHECK(std::abs(face.separation + 0.1f) < 1e-6f);
        CHECK(face.normal == Vec3{1, 0, 0});
    }
}

TEST_CASE(
    "C11: the depth of overlapping boxes is that of the hull of their vertices' differences") {
    Random random(11);
    for (NarrowPhase method : methods) {
        Verdict worst;
        int overlapping = 0;
        while (overlapping < 150) {
            const Box a{{random.real(0.2, 1.5), random.real(0.2, 1.5), random.real(0.2, 1.5)}};
            const Box b{{random.real(0.2, 1.5), random.real(0.2, 1.5), random.real(0.2, 1.5)}};
            const Pose pose = {random.vector(1.5), random.rotation()};
            const double truth = separation_by_hull(WideBox(a, {}), WideBox(b, pose));
            if (truth > 0) continue;
            ++overlapping;
            worst.judge(a, b, pose, axis_of(a, b, pose, method), truth);
        }
        CAPTURE(int(method));
        // A face may win over an edge pair that is better by a trifle: 2e-5 of the smaller box.
        CHECK(worst.separation < 1e-5);
        CHECK(worst.along_normal < 2e-6);
        CHECK(worst.unit < 1e-6);
    }
}

TEST_CASE("C11: the distance of boxes apart is the least over all pairs of their features") {
    Random random(12);
    for (NarrowPhase method : methods) {
        Verdict worst;
        int apart = 0;
        while (apart < 10000) {
            const Box a{{random.real(0.2, 1.5), random.real(0.2, 1.5), random.real(0.2, 1.5)}};
            const Box b{{random.real(0.2, 1.5), random.real(0.2, 1.5), random.real(0.2, 1.5)}};
            const Pose pose = {random.vector(3), random.rotation()};
            const Axis axis = axis_of(a, b, pose, method);
            const double truth = distance_by_features(WideBox(a, {}), WideBox(b, pose));
            // Overlapping boxes have touching features too, or one swallows the other.
            if (axis.separation <= 0) continue;
            ++apart;
            worst.judge(a, b, pose, axis, truth);
        }
        CAPTURE(int(method));
        CHECK(worst.separation < 1e-5);
        CHECK(worst.along_normal < 1e-5);
        CHECK(worst.witness < 1e-5);
    }
}

TEST_CASE("C11: SAT and GJK with EPA agree on 20,000 pairs, overlapping or apart") {
    Random random(13);
    double worst = 0;
    int overlapping = 0;
    for (int i = 0; i < 20000; ++i) {
        const Box a{{random.real(0.1, 2), random.real(0.1, 2), random.real(0.1, 2)}};
        const Box b{{random.real(0.1, 2), random.real(0.1, 2), random.real(0.1, 2)}};
        const Pose pose = {random.vector(2.5), random.rotation()};
        const Axis sat = axis_of(a, b, pose, NarrowPhase::Sat);
        const Axis gjk = axis_of(a, b, pose, NarrowPhase::GjkEpa);
        worst = std::max(worst, std::abs(double(sat.separation) - double(gjk.separation)));
        overlapping += sat.separation < 0;
    }
    CHECK(worst < 1e-5);
    CHECK(overlapping > 4000);
    CHECK(overlapping < 16000);
}

TEST_CASE("C11: moved apart by the depth along the normal, two boxes just touch") {
    Random random(14);
    for (NarrowPhase method : methods) {
        double worst = 0;
        for (int i = 0; i < 2000; ++i) {
            const Box a{random.vector(1)}, b{random.vector(1)};
            const Box pos_a{absolute(a.half_extents) + Vec3{0.1f, 0.1f, 0.1f}};
            const Box pos_b{absolute(b.half_extents) + Vec3{0.1f, 0.1f, 0.1f}};
            Pose pose = {random.vector(0.7), random.rotation()};
            const Axis axis = axis_of(pos_a, pos_b, pose, method);
            if (axis.separation >= 0) continue;
            pose.position = pose.position - axis.separation * axis.normal;
            worst =
                std::max(worst, std::abs(double(axis_of(pos_a, pos_b, pose, method).separation)));
        }
        CAPTURE(int(method));
        CHECK(worst < 1e-5);
    }
}

TEST_CASE("a face wins over an edge pair that is no better than rounding") {
    // A cube flat on another, turned about the upright: crossed edges separate no better than the
    // faces.
    for (NarrowPhase method : methods) {
        for (double yaw : {0.0, 1e-7, 1e-4, 0.01, 0.3, pi / 4}) {
            for (double tilt : {0.0, 1e-7, 1e-6}) {
                AxisHint hint;
                const Quat q = turn({1, 0, 0}, tilt) * turn({0, 0, 1}, yaw);
                find_axis(cube, cube, {{0.1f, 0.2f, 0.9999f}, q}, method, hint);
                CAPTURE(yaw);
                CAPTURE(tilt);
                CHECK(hint.kind != std::uint8_t(BoxAxisKind::EdgePair));
                CHECK(hint.kind != 0);
            }
        }
    }
}

TEST_CASE("the last step's axis is kept while it is within a thousandth of the best") {
    for (NarrowPhase method : methods) {
        AxisHint hint;
        // 0.1 deep along x; then z becomes the better by 0.0001, and by 0.01.
        CHECK(find_axis(cube, cube, {{0.9f, 0, 0.8f}, {}}, method, hint).normal == Vec3{1, 0, 0});
        CHECK(find_axis(cube, cube, {{0.9f, 0, 0.9001f}, {}}, method, hint).normal ==
              Vec3{1, 0, 0});
        CHECK(find_axis(cube, cube, {{0.9f, 0, 0.91f}, {}}, method, hint).normal == Vec3{0, 0, 1});
    }
}
