// Cases C: where two shapes touch, how deep, and along which normal, through World::contacts().
//
// The world reports shapes that touch or are about to; a gap is therefore measured by closing it
// along the normal that the closed form names. C01 is in pairs.cpp, C04 in
// capsules.cpp.

#include <algorithm>

#include "pair.h"

namespace cairn::physics {

namespace {

const ShapeDef unit_cube = block({1, 1, 1}, rough(0.6));
const double half_root_3 = std::sqrt(3.0) / 2;

// A unit cube's turn that stands its body diagonal upright.
Turn diagonal_upright() {
    return turn_about(cross({1, 1, 1}, {0, 0, 1}), std::acos(1 / std::sqrt(3.0)));
}

double separation_of(const std::optional<Touch>& touch) {
    return touch ? touch->separation : not_seen;
}
double off_normal(const std::optional<Touch>& touch, const Vec& normal) {
    return touch ? length(touch->normal - normal) : not_seen;
}
// NaN is the worst of all.
void keep_worst(double& worst, double error) {
    if (!(error <= worst)) worst = error;
}

void touch_balls(const Setup& setup, Sheet& sheet) {
    const double tolerance = 1e-6;
    Pair pair(setup, ball(1, rough(0)), ball(0.5, rough(0)));
    pair.put_second({2.5, 0, 0});
    sheet.compare("gap of 1", pair.gap_along({1, 0, 0}, 1), 1, tolerance);
    pair.put_second({});
    sheet.compare("same centre", separation_of(pair.touch()), -1.5, tolerance);
    const std::optional<Touch> same = pair.touch();
    sheet.compare("same centre, |n|", same ? length(same->normal) : not_seen, 1, tolerance);

    Pair far(setup, ball(1, rough(0)), ball(1, rough(0)));
    far.put_first({-1.5, 0, 0});
    far.put_second({1.5, 0, 0});
    sheet.compare("two of radius 1, 3 apart", far.gap_along({1, 0, 0}, 1), 1, tolerance);
    far.put_second({0.498, 0, 0});
    const std::optional<Touch> met = far.touch();
    sheet.compare("halfway point", met ? met->points[0].x : not_seen, -0.501, tolerance);

    Pair deep(setup, ball(3, rough(0)), ball(3, rough(0)));
    deep.put_first({-1, 0, 0});
    deep.put_second({3, 0, 0});
    sheet.compare("two of radius 3, 4 apart", separation_of(deep.touch()), -2, tolerance);
    sheet.bound("normal off", off_normal(deep.touch(), {1, 0, 0}), tolerance);
}

struct BallInBox {
    double separation = 0;
    Vec normal;             // from box to ball
    bool is_sharp = false;  // whether the normal is well defined
};

// The closed form, in the box's frame: faces, edges, corners, inside.
BallInBox measure_ball_in_box(const Vec& c, const Vec& half, double r) {
    const Vec nearest = {std::clamp(c.x, -half.x, half.x), std::clamp(c.y, -half.y, half.y),
                         std::clamp(c.z, -half.z, half.z)};
    const Vec out = c - nearest;
    const double distance = length(out);
    if (distance > 0) return {distance - r, (1 / distance) * out, distance > 0.01};
    double left[3] = {half.x - std::abs(c.x), half.y - std::abs(c.y), half.z - std::abs(c.z)};
    const std::size_t axis = static_cast<std::size_t>(std::min_element(left, left + 3) - left);
    Vec n;
    if (axis == 0) n.x = c.x > 0 ? 1 : -1;
    if (axis == 1) n.y = c.y > 0 ? 1 : -1;
    if (axis == 2) n.z = c.z > 0 ? 1 : -1;
    const double depth = left[axis];
    std::sort(left, left + 3);
    return {-r - depth, n, left[1] - left[0] > 1e-4};
}

struct WorstOf {
    double separation = 0, normal = 0;
    int phantoms = 0, missed = 0;
};

WorstOf try_balls_in_box(const Setup& setup, bool turned) {
    const Vec half = {1, 2, 3};
    const double r = 0.5;
    Pair pair(setup, block(2 * half, rough(0)), ball(r, rough(0)));
    Random random(3);
    WorstOf worst;
    for (int i = 0; i < 10000; ++i) {
        const Vec c = {random.uniform(-1.6, 1.6), random.uniform(-2.6, 2.6),
                       random.uniform(-3.6, 3.6)};
        const Turn turn = turned ? random.turn() : Turn{};
        const Vec at = turned ? random.in_cube(1) : Vec{};
        pair.put_first(at, turn);
        pair.put_second(at + rotate(turn, c));
        const BallInBox expected = measure_ball_in_box(c, half, r);
        const std::optional<Touch> found = pair.touch();
        if (!found) {
            if (expected.separation < -1e-5) ++worst.missed;
            continue;
        }
        if (expected.separation > 1e-5 && found->separation <= 0) ++worst.phantoms;
        keep_worst(worst.separation, std::abs(found->separation - expected.separation));
        if (!expected.is_sharp) continue;
        keep_worst(worst.normal, length(found->normal - rotate(turn, expected.normal)));
    }
    return worst;
}

void touch_ball_and_box(const Setup& setup, Sheet& sheet) {
    const WorstOf worst = try_balls_in_box(setup, true);
    sheet.bound("10000 in all regions, separation off", worst.separation, 1e-5);
    sheet.bound("normal off", worst.normal, 1e-4);
    sheet.bound("overlaps not seen", worst.missed, 0);
    sheet.bound("overlaps that are none", worst.phantoms, 0);
}

void touch_smoothly(const Setup& setup, Sheet& sheet) {
    const WorstOf worst = try_balls_in_box(setup, false);
    sheet.bound("ball and box, separation off", worst.separation, 1e-6);
    sheet.bound("ball and box, overlaps not seen", worst.missed, 0);
    Random random(14);
    Pair pair(setup, ball(0.7, rough(0)), ball(0.4, rough(0)));
    double off = 0;
    for (int i = 0; i < 10000; ++i) {
        const Vec at = random.in_cube(0.6);
        pair.put_second(at);
        keep_worst(off, std::abs(separation_of(pair.touch()) - (length(at) - 1.1)));
    }
    sheet.bound("two balls, separation off", off, 1e-6);
}

void touch_corner_and_face(const Setup& setup, Sheet& sheet) {
    Pair pair(setup, unit_cube, unit_cube);
    pair.put_second({0.1, -0.07, 1.6}, diagonal_upright());
    const double gap = 1.6 - 0.5 - half_root_3;
    sheet.compare("apart", pair.gap_along({0, 0, 1}, gap), gap, 1e-5);
    pair.put_second({0.1, -0.07, 1.3}, diagonal_upright());
    sheet.compare("overlapping", separation_of(pair.touch()), 1.3 - 0.5 - half_root_3, 1e-5);
    sheet.bound("normal off", off_normal(pair.touch(), {0, 0, 1}), 1e-5);
}

void touch_edge_and_edge(const Setup& setup, Sheet& sheet) {
    Pair pair(setup, unit_cube, unit_cube);
    const Turn turn = turn_about({0, 1, 0}, pi / 4);
    pair.put_first({}, turn_about({1, 0, 0}, pi / 4));
    pair.put_second({0, 0, 1.5}, turn);
    const double gap = 1.5 - std::sqrt(2.0);
    sheet.compare("apart", pair.gap_along({0, 0, 1}, gap), gap, 1e-5);
    pair.put_second({0, 0, 1.4}, turn);
    const std::optional<Touch> touch = pair.touch();
    sheet.compare("overlapping", separation_of(touch), 1.4 - std::sqrt(2.0), 1e-5);
    sheet.bound("normal off", off_normal(touch, {0, 0, 1}), 1e-5);
    sheet.compare("points", touch ? static_cast<double>(touch->points.size()) : 0, 1, 0);
    sheet.bound("point off the axis",
                touch ? std::hypot(touch->points[0].x, touch->points[0].y) : not_seen, 1e-4);
}

void touch_edge_and_face(const Setup& setup, Sheet& sheet) {
    Pair pair(setup, unit_cube, unit_cube);
    pair.put_second({0.2, 0.1, 1.15}, turn_about({1, 0, 0}, pi / 4));
    const std::optional<Touch> touch = pair.touch();
    sheet.compare("overlapping", separation_of(touch), 0.65 - std::sqrt(0.5), 1e-5);
    sheet.bound("normal off", off_normal(touch, {0, 0, 1}), 1e-5);
    sheet.compare("points", touch ? static_cast<double>(touch->points.size()) : 0, 2, 0);
    if (!touch || touch->points.size() != 2) return;
    std::vector<Vec> points = touch->points;
    if (points[0].x > points[1].x) std::swap(points[0], points[1]);
    sheet.bound("one end off", std::hypot(points[0].x + 0.3, points[0].y - 0.1), 1e-4);
    sheet.bound("other end off", std::hypot(points[1].x - 0.5, points[1].y - 0.1), 1e-4);
}

void touch_face_and_face(const Setup& setup, Sheet& sheet) {
    Pair pair(setup, unit_cube, unit_cube);
    pair.put_second({0.9, 0.2, 0.1});
    const std::optional<Touch> touch = pair.touch();
    sheet.compare("overlapping", separation_of(touch), -0.1, 1e-5);
    sheet.bound("normal off", off_normal(touch, {1, 0, 0}), 1e-5);
    sheet.compare("points", touch ? static_cast<double>(touch->points.size()) : 0, 4, 0);
    sheet.compare("area", touch ? area_of(*touch) : not_seen, 0.72, 1e-4);
}

ShapeDef random_shape(Random& random, bool is_ball) {
    if (is_ball) return ball(random.uniform(0.1, 0.5), rough(0));
    const Vec size = {random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1)};
    return block(size, rough(0));
}

void touch_symmetrically(const Setup& setup, Sheet& sheet) {
    Random random(12);
    double swapped_depth = 0, swapped_normal = 0, moved_depth = 0;
    int compared = 0;
    for (int i = 0; i < 3000; ++i) {
        const ShapeDef a = random_shape(random, i % 3 == 2), b = random_shape(random, i % 3 > 0);
        Pair pair(setup, a, b), swapped(setup, a, b, Pair::Order::Swapped);
        const Vec at = random.in_cube(0.4);
        const Turn turn_a = random.turn(), turn_b = random.turn();
        pair.put_first({}, turn_a);
        pair.put_second(at, turn_b);
        swapped.put_first({}, turn_a);
        swapped.put_second(at, turn_b);
        const std::optional<Touch> one = pair.touch(), other = swapped.touch();
        const Turn turn = random.turn();
        const Vec to = random.in_cube(5);
        pair.put_first(to, turn * turn_a);
        pair.put_second(to + rotate(turn, at), turn * turn_b);
        const std::optional<Touch> moved = pair.touch();
        if (!one || one->separation > -1e-4) continue;
        ++compared;
        keep_worst(swapped_depth, std::abs(one->separation - separation_of(other)));
        keep_worst(swapped_normal, off_normal(other, one->normal));
        keep_worst(moved_depth, std::abs(one->separation - separation_of(moved)));
    }
    sheet.bound("pairs that overlap, short of 1000", 1000 - compared, 0);
    sheet.bound("depth, the two swapped", swapped_depth, 1e-5);
    sheet.bound("normal, the two swapped", swapped_normal, 1e-4);
    sheet.bound("depth, both moved", moved_depth, 1e-5);
}

void touch_thin_things(const Setup& setup, Sheet& sheet) {
    const ShapeDef needle = block({1, 1e-3, 1e-3}, rough(0));
    const ShapeDef plate = block({10, 10, 1e-3}, rough(0));
    const Turn quarter = turn_about({0, 0, 1}, pi / 2);
    const auto depth = [&](const ShapeDef& a, const ShapeDef& b, const Vec& at, const Turn& turn) {
        Pair pair(setup, a, b);
        pair.put_second(at, turn);
        return separation_of(pair.touch());
    };
    sheet.compare("needle lying on a cube", depth(unit_cube, needle, {0.1, 0.2, 0.5003}, {}), -2e-4,
                  1e-4);
    sheet.compare("needle standing in a cube",
                  depth(unit_cube, needle, {0.1, 0.2, 0.999}, turn_about({0, 1, 0}, pi / 2)), -1e-3,
                  1e-4);
    sheet.compare("needles crossing", depth(needle, needle, {0.1, 0.2, 8e-4}, quarter), -2e-4,
                  1e-4);
    sheet.compare("cube on a plate", depth(plate, unit_cube, {3, -2, 0.5001}, {}), -4e-4, 1e-3);
    sheet.compare("plates", depth(plate, plate, {1, 2, 5e-4}, turn_about({0, 0, 1}, 0.3)), -5e-4,
                  1e-3);
}

void touch_degenerately(const Setup& setup, Sheet& sheet) {
    Pair pair(setup, unit_cube, unit_cube);
    double sliding = 0;
    for (int i = 0; i <= 20; ++i) {
        pair.put_second({0.05 * i, 0.02 * i, 1});
        keep_worst(sliding, std::abs(separation_of(pair.touch())));
    }
    sheet.bound("faces that touch, sliding", sliding, 1e-6);
    pair.put_second({});
    sheet.compare("one in the other", separation_of(pair.touch()), -1, 1e-4);
    pair.put_second({1, 1, 1});
    sheet.compare("corner on corner", separation_of(pair.touch()), 0, 1e-4);
    pair.put_second({0.1, -0.07, 0.5 + half_root_3}, diagonal_upright());
    sheet.compare("corner on face", separation_of(pair.touch()), 0, 1e-4);
    touch_thin_things(setup, sheet);

    double faces = 0, corners = 0;
    for (const double size : {1e-2, 1e-1, 1.0, 1e1, 1e2, 1e3}) {
        const ShapeDef cube = block({size, size, size}, rough(0));
        Pair scaled(setup, cube, cube);
        scaled.put_second(size * Vec{0.9, 0.2, 0.1});
        keep_worst(faces, std::abs(separation_of(scaled.touch()) / size + 0.1));
        scaled.put_second(size * Vec{0.1, -0.07, 1.3}, diagonal_upright());
        keep_worst(corners, std::abs(separation_of(scaled.touch()) / size - 0.8 + half_root_3));
    }
    sheet.bound("sizes 0.01 to 1000, faces, relative", faces, 1e-4);
    sheet.bound("sizes 0.01 to 1000, corner in face, relative", corners, 1e-4);
}

void clip_octagon(const Setup& setup, Sheet& sheet) {
    const double best = 0.5857864;  // the largest four of the eight corners
    Pair pair(setup, unit_cube, unit_cube);
    const Turn yaw = turn_about({0, 0, 1}, pi / 4);
    pair.put_second({0, 0, 0.99}, yaw);
    std::optional<Touch> touch = pair.touch();
    sheet.compare("points", touch ? static_cast<double>(touch->points.size()) : 0, 4, 0);
    sheet.bound("area short of 0.95 of the best", touch ? 0.95 * best - area_of(*touch) : not_seen,
                0);
    sheet.claim("the center of mass stands inside", touch && surrounds(*touch, {}));

    // Leaning a little, so that one corner of the octagon is the deepest.
    const double in = 0.5 * (std::sqrt(2.0) - 1);
    double off = 0;
    for (int i = 0; i < 16; ++i) {
        const double around = (i + 0.3) * pi / 8;
        const Turn lean = turn_about({std::cos(around), std::sin(around), 0}, radians(0.5)) * yaw;
        pair.put_second({0, 0, 0.99}, lean);
        const Vec n = rotate(lean, {0, 0, 1});
        double least = 1;
        for (const Vec& corner :
             {Vec{0.5, in, 0}, Vec{0.5, -in, 0}, Vec{-0.5, in, 0}, Vec{-0.5, -in, 0},
              Vec{in, 0.5, 0}, Vec{in, -0.5, 0}, Vec{-in, 0.5, 0}, Vec{-in, -0.5, 0}}) {
            // Where the leaning face stands above that corner of the octagon.
            least = std::min(
                least, 0.49 - (0.5 / n.z - 0.5) - (n.x * corner.x + n.y * corner.y) / n.z - 0.5);
        }
        touch = pair.touch();
        keep_worst(off, std::abs(separation_of(touch) - least));
    }
    sheet.bound("deepest point lost, leaning 0.5 degrees", off, 1e-4);
}

Case collision_case(std::string_view id, std::string_view title,
                    void (*run)(const Setup&, Sheet&)) {
    return {.id = id,
            .title = title,
            .subject = Subject::Collision,
            .run = run,
            .quick = true,
            .steps = {1.0 / 60}};
}

}  // namespace

void find_all_pairs(const Setup& setup, Sheet& sheet);  // pairs.cpp
void touch_capsules(const Setup& setup, Sheet& sheet);  // capsules.cpp

std::vector<Case> collision_cases() {
    return {
        collision_case("C01", "all pairs", find_all_pairs),
        collision_case("C02", "two balls", touch_balls),
        collision_case("C03", "ball and box", touch_ball_and_box),
        collision_case("C04", "two capsules", touch_capsules),
        collision_case("C05", "corner and face", touch_corner_and_face),
        collision_case("C06", "edge and edge", touch_edge_and_edge),
        collision_case("C07", "edge and face", touch_edge_and_face),
        collision_case("C08", "face and face", touch_face_and_face),
        collision_case("C12", "symmetry", touch_symmetrically),
        collision_case("C13", "degenerate shapes", touch_degenerately),
        collision_case("C14", "round shapes are exact", touch_smoothly),
        collision_case("C15", "eight corners become four", clip_octagon),
    };
}

}  // namespace cairn::physics
