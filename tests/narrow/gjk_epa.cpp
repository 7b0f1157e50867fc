// GJK's cases one by one, EPA's starts one by one, and both for shapes that are no boxes.

#include <doctest/doctest.h>

#include <numbers>

#include "judge.h"
#include "narrow/epa.h"
#include "narrow/gjk.h"
#include "narrow/gjk_epa.h"

using namespace cairn;
using namespace cairn::judge;
using doctest::Approx;

namespace {

Simplex simplex_of(std::initializer_list<Vec3d> points) {
    Simplex s;
    for (const Vec3d& p : points) s.points[s.size++] = {p, p, {}};
    return s;
}
Vec3d nearest(const Simplex& s) {
    Vec3d v;
    for (int i = 0; i < s.size; ++i) v = v + s.weights[i] * s.points[i].w;
    return v;
}

// A convex shape of explicit vertices.
struct Hull {
    std::vector<Vec3> vertices;
};
Vec3 support_of_hull(const void* core, Vec3 d) {
    const Hull& hull = *static_cast<const Hull*>(core);
    Vec3 best = hull.vertices[0];
    for (const Vec3& v : hull.vertices)
        if (cairn::dot(v, d) > cairn::dot(best, d)) best = v;
    return best;
}
ConvexShape convex_shape(const Hull& hull) { return {&hull, support_of_hull, 0}; }

std::vector<V> placed(const Hull& hull, const Pose& pose) {
    const Mat3 m = to_matrix(pose.rotation);
    std::vector<V> all;
    for (const Vec3& v : hull.vertices) {
        all.push_back(wide(pose.position) + double(v.x) * wide(m.x) + double(v.y) * wide(m.y) +
                      double(v.z) * wide(m.z));
    }
    return all;
}

}  // namespace

TEST_CASE("GJK's segment: behind a, beyond b, between") {
    Simplex behind = simplex_of({{1, 1, 0}, {2, 1, 0}});
    reduce_segment(behind);
    CHECK(behind.size == 1);
    CHECK(nearest(behind).x == 1);
    Simplex beyond = simplex_of({{-2, 1, 0}, {-1, 1, 0}});
    reduce_segment(beyond);
    CHECK(beyond.size == 1);
    CHECK(nearest(beyond).x == -1);
    Simplex between = simplex_of({{-1, 2, 0}, {3, 2, 0}});
    reduce_segment(between);
    CHECK(between.size == 2);
    CHECK(between.weights[1] == Approx(0.25));
    CHECK(nearest(between).x == Approx(0));
}

TEST_CASE("GJK's triangle: three vertices, three edges, the face, and no area") {
    // A triangle in z = 1, moved so that the origin lies below each of its regions in turn.
    struct Case {
        double x, y;
        int size;
        double nearest_x, nearest_y;
    };
    // a (0,0), b (4,0), c (0,4); the origin at (x, y).
    constexpr Case cases[] = {{-1, -2, 1, 0, 0}, {6, -1, 1, 4, 0}, {-1, 7, 1, 0, 4},
                              {2, -1, 2, 2, 0},  {-3, 1, 2, 0, 1}, {3, 3, 2, 2, 2},
                              {1, 1, 3, 1, 1}};
    for (const Case& c : cases) {
        CAPTURE(c.x);
        CAPTURE(c.y);
        Simplex s =
            simplex_of({{0 - c.x, 0 - c.y, 1}, {4 - c.x, 0 - c.y, 1}, {0 - c.x, 4 - c.y, 1}});
        reduce_triangle(s);
        CHECK(s.size == c.size);
        CHECK(nearest(s).x == Approx(c.nearest_x - c.x));
        CHECK(nearest(s).y == Approx(c.nearest_y - c.y));
        CHECK(nearest(s).z == Approx(1));
    }
    Simplex flat = simplex_of({{-1, 1, 0}, {3, 1, 0}, {1, 1, 0}});
    reduce_triangle(flat);
    CHECK(flat.size <= 2);
    CHECK(length(nearest(flat)) == Approx(1));
}

TEST_CASE("GJK's tetrahedron: inside, and the nearest point of its surface from 10^4 places") {
    Random random(41);
    int inside = 0;
    double worst = 0;
    for (int i = 0; i < 10000; ++i) {
        Simplex s;
        for (; s.size < 4; ++s.size)
            s.points[s.size].w = widen(random.vector(1) + Vec3{0.2f, 0, 0});
        const Simplex before = s;
        if (reduce_tetrahedron(s)) {
            ++inside;
            CHECK(s.size == 4);
            worst = std::max(worst, length(nearest(s)));
            continue;
        }
        // Nothing nearer on any of the four faces.
        double best = 1e300;
        for (int skip = 0; skip < 4; ++skip) {
            Simplex face;
            for (int k = 0; k < 4; ++k)
                if (k != skip) face.points[face.size++] = before.points[k];
            reduce_triangle(face);
            best = std::min(best, length(nearest(face)));
        }
        worst = std::max(worst, std::abs(best - length(nearest(s))));
    }
    CHECK(worst < 1e-9);
    CHECK(inside > 200);
}

TEST_CASE("EPA starts from a point, a segment, a triangle and a tetrahedron alike") {
    // Two cubes that overlap by 0.25 along x, by more along the others.
    const Box cube{{0.5f, 0.5f, 0.5f}};
    const MinkowskiDifference d(convex_shape(cube), convex_shape(cube), {{0.75f, 0.1f, -0.2f}, {}});
    const Simplex full = find_closest_points(d, {0, 1, 0}).simplex;
    REQUIRE(find_closest_points(d, {0, 1, 0}).overlap);
    for (int size = 1; size <= 4; ++size) {
        Simplex start = full;
        start.size = std::min(size, full.size);
        // A start whose growth leaves the origin outside is not EPA's: grow from one that touches.
        if (start.size < full.size) continue;
        const EpaResult epa = find_penetration(d, start);
        CHECK(epa.depth == Approx(0.25));
        CHECK(epa.normal.x == Approx(1));
    }
    // Touching in a vertex, an edge, a face: GJK ends on a smaller simplex, the depth is 0.
    for (const Vec3& t :
         {Vec3{1, 1, 1}, Vec3{1, 1, 0.25f}, Vec3{1, 0.25f, 0.125f}, Vec3{1, 0, 0}}) {
        const MinkowskiDifference touch(convex_shape(cube), convex_shape(cube), {t, {}});
        for (const Vec3d& guess : {Vec3d{1, 1, 1}, Vec3d{1, 0, 0}, Vec3d{0, 0, 1}}) {
            const GjkResult gjk = find_closest_points(touch, guess);
            REQUIRE(gjk.overlap);
            const EpaResult epa = find_penetration(touch, gjk.simplex);
            CHECK(std::abs(epa.depth) < 1e-9);
            CHECK(length(epa.normal) == Approx(1));
            CHECK(dot(epa.normal, widen(t)) > 0.5);
        }
    }
}

TEST_CASE("EPA parts shapes without volume at depth 0") {
    const Hull point{{{0, 0, 0}}}, segment{{{-1, 0, 0}, {1, 0, 0}}};
    const Hull square{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}};
    const auto part = [](const Hull& a, const Hull& b) {
        const Axis axis = find_axis_convex({convex_shape(a), convex_shape(b), {}}, {0, 1, 0});
        CHECK(std::abs(axis.separation) < 1e-6f);
        CHECK(double(cairn::length(axis.normal)) == Approx(1));
        return axis.normal;
    };
    part(point, point);
    CHECK(std::abs(part(segment, point).x) < 1e-6f);
    CHECK(std::abs(part(segment, segment).x) < 1e-6f);
    CHECK(std::abs(part(square, segment).z) == Approx(1));
    CHECK(std::abs(part(square, square).z) == Approx(1));
}

TEST_CASE("C10: a cube and an octahedron above it overlap by 0.15, straight up") {
    const Box cube{{0.5f, 0.5f, 0.5f}};
    const Hull octahedron{
        {{0.6f, 0, 0}, {-0.6f, 0, 0}, {0, 0.6f, 0}, {0, -0.6f, 0}, {0, 0, 0.6f}, {0, 0, -0.6f}}};
    const Axis axis = find_axis_convex(
        {convex_shape(cube), convex_shape(octahedron), {{0.3f, 0.25f, 0.95f}, {}}}, {0, 0, 1});
    CHECK(double(axis.separation) == Approx(-0.15).epsilon(1e-5));
    CHECK(axis.normal.z == Approx(1));
}

TEST_CASE("C11: hulls of 8 to 12 random points, against the hull of their differences") {
    Random random(43);
    double worst = 0;
    int overlapping = 0;
    for (int i = 0; i < 60; ++i) {
        Hull a, b;
        for (int k = 0; k < 8; ++k) {
            a.vertices.push_back(0.7f * random.direction());
            b.vertices.push_back(0.5f * random.direction());
        }
        const Pose pose = {random.vector(0.8), random.rotation()};
        const double truth = separation_by_hull(placed(a, {}), placed(b, pose));
        const Axis axis = find_axis_convex({convex_shape(a), convex_shape(b), pose}, {0, 1, 0});
        if (truth < 0) {
            ++overlapping;
            worst = std::max(worst, std::abs(double(axis.separation) - truth));
        } else {
            // Planes of faces bound the distance from below.
            CHECK(double(axis.separation) > truth - 1e-6);
        }
    }
    CHECK(worst < 2e-6);
    CHECK(overlapping > 20);
}

TEST_CASE("C14: with a point for its core a ball is exact under GJK and EPA") {
    Random random(44);
    double worst = 0, worst_deep = 0;
    const Box box{{1, 2, 3}};
    const Sphere ball{0.5f};
    for (int i = 0; i < 5000; ++i) {
        const Pose pose = {{random.real(-1.6, 1.6), random.real(-2.6, 2.6), random.real(-3.6, 3.6)},
                           random.rotation()};
        const Axis closed = axis_of(box, ball, pose, NarrowPhase::Sat);
        const Axis walked = find_axis_convex(
            {cairn::convex_shape(box), cairn::convex_shape(ball), pose}, pose.position);
        const double error = std::abs(double(closed.separation) - double(walked.separation));
        worst = std::max(worst, error);
        if (closed.separation < -ball.radius) worst_deep = std::max(worst_deep, error);
    }
    CHECK(worst < 1e-6);
    CHECK(worst_deep < 1e-6);
    const Axis balls = find_axis_convex(
        {cairn::convex_shape(Sphere{1}), cairn::convex_shape(ball), {{2.5f, 0, 0}, {}}}, {1, 0, 0});
    CHECK(balls.separation == 1.0f);
    const Axis same = find_axis_convex(
        {cairn::convex_shape(Sphere{1}), cairn::convex_shape(ball), {}}, {1, 0, 0});
    CHECK(same.separation == -1.5f);
}
