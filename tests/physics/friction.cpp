// Cases D08 to D11 and D18 to D20: sliding, sticking, twisting, tipping.
//
// Coulomb's law with one coefficient: a sliding box loses mu g, one on a slope gains
// g (sin - mu cos), a twisted square patch of side a loses alpha = mu g (a / sqrt 2) / (a^2 / 6).

#include <algorithm>

#include "scene.h"

namespace cairn::physics {

namespace {

// The box 0.5 x 0.5 x 0.2 on ground that falls away by `tilt`, in touch with it, at rest.
struct Slide {
    World world;
    BodyId body;
    Slope slope;
};

Slide make_slide(const Setup& setup, Ground ground, double tilt, double friction) {
    Slide slide{make_world(setup), {}, slope_of(tilt)};
    add_ground(slide.world, ground, rough(friction), tilt);
    BodyDef def;
    def.shapes = {block({0.5, 0.5, 0.2}, rough(friction))};
    def.position = to_position(0.1 * slide.slope.normal);
    def.rotation = to_quat(slide.slope.turn);
    slide.body = add(slide.world, def);
    return slide;
}

void stick_or_slide(const Setup& setup, Sheet& sheet) {
    for (const Ground ground : {Ground::Plane, Ground::Box}) {
        for (const double angle : {16.6, 16.8, 17.5, 20.0}) {
            Slide slide = make_slide(setup, ground, radians(angle), 0.3);
            run(slide.world, setup, 1);
            const Vec at = center_of(slide.world, slide.body);
            const double v1 = dot(velocity_of(slide.world, slide.body), slide.slope.downhill);
            run(slide.world, setup, 1);
            const double v2 = dot(velocity_of(slide.world, slide.body), slide.slope.downhill);
            char what[80];
            if (angle < 16.7) {
                std::snprintf(what, sizeof what, "creep in 1 s at %.1f degrees, m, %s", angle,
                              name(ground));
                sheet.bound(what, length(center_of(slide.world, slide.body) - at), 1e-3);
                continue;
            }
            const double a = gravity * (std::sin(radians(angle)) - 0.3 * std::cos(radians(angle)));
            std::snprintf(what, sizeof what, "acceleration at %.1f degrees, m/s2, %s", angle,
                          name(ground));
            sheet.compare(what, v2 - v1, a, std::max(0.01 * a, 1e-3));
        }
    }
}

void slide_down(const Setup& setup, Sheet& sheet) {
    const double a = gravity * (std::sin(radians(30)) - 0.5 * std::cos(radians(30)));
    for (const Ground ground : {Ground::Plane, Ground::Box}) {
        Slide slide = make_slide(setup, ground, radians(30), 0.5);
        const Vec start = center_of(slide.world, slide.body);
        run(slide.world, setup, 1);
        const double x = dot(center_of(slide.world, slide.body) - start, slide.slope.downhill);
        sheet.compare(std::string("way in 1 s, m, ") + name(ground), x, a / 2,
                      0.01 * a / 2 + a * substep_of(setup) / 2);
    }
}

struct Stop {
    double way = 0, aside = 0, yaw = 0;
};

Stop slide_to_stop(const Setup& setup, Ground ground, double speed, double friction,
                   double direction) {
    Slide slide = make_slide(setup, ground, 0, friction);
    const Vec along = {std::cos(direction), std::sin(direction), 0};
    if (!slide.world.set_linear_velocity(slide.body, to_vec3(speed * along)).ok()) return {};
    const Vec start = center_of(slide.world, slide.body);
    run(slide.world, setup, speed / (friction * gravity) + 1);
    const Vec way = center_of(slide.world, slide.body) - start;
    const Turn turn = turn_of(slide.world, slide.body);
    return {dot(way, along), std::abs(cross(along, way).z), 2 * std::atan2(turn.z, turn.w)};
}

void slide_to_stops(const Setup& setup, Sheet& sheet) {
    struct Throw {
        double speed, friction;
    };
    for (const Ground ground : {Ground::Plane, Ground::Box}) {
        for (const Throw t : {Throw{2, 0.2}, Throw{2, 0.4}, Throw{2, 0.7}, Throw{3, 0.5}}) {
            const double way = t.speed * t.speed / (2 * t.friction * gravity);
            char what[80];
            std::snprintf(what, sizeof what, "way from %.0f m/s, mu %.1f, m, %s", t.speed,
                          t.friction, name(ground));
            sheet.compare(what, slide_to_stop(setup, ground, t.speed, t.friction, 0).way, way,
                          0.01 * way + t.speed * substep_of(setup));
        }
    }
}

void slide_all_ways(const Setup& setup, Sheet& sheet) {
    double least = 1e9, most = 0, sum = 0, aside = 0, yaw = 0;
    for (int i = 0; i < 24; ++i) {
        const Stop stop = slide_to_stop(setup, Ground::Plane, 3, 0.5, radians(15 * i));
        least = std::min(least, stop.way);
        most = std::max(most, stop.way);
        sum += stop.way;
        aside = std::max(aside, stop.aside);
        yaw = std::max(yaw, std::abs(stop.yaw));
    }
    sheet.bound("spread of the ways, relative", (most - least) / (sum / 24), 0.003);
    sheet.bound("aside, m", aside, 2e-3);
    sheet.bound("yaw, rad", yaw, 2e-3);
}

void twist_cube(const Setup& setup, Sheet& sheet) {
    const double alpha = 0.3 * gravity * (std::sqrt(2.0) / 2) / (1.0 / 6);
    for (const Ground ground : {Ground::Plane, Ground::Box}) {
        World world = make_world(setup);
        add_ground(world, ground, rough(0.3));
        BodyDef def;
        def.shapes = {block({1, 1, 1}, rough(0.3))};
        def.position = {0, 0, 0.5};
        def.angular_velocity = {0, 0, 10};
        const BodyId body = add(world, def);
        run(world, setup, 0.5);
        const std::string where = std::string(", ") + name(ground);
        const double w = 10 - 0.5 * alpha;
        sheet.compare("spin after 0.5 s, rad/s" + where, spin_of(world, body).z, w, 0.01 * w);
        double stop = not_seen, last = spin_of(world, body).z;
        for (int i = steps_in(setup, 0.5); i < steps_in(setup, 2); ++i) {
            advance(world, setup.dt);
            const double now = spin_of(world, body).z;
            // What is left at the step's start lasts w / alpha.
            if (last > 1e-3 && now <= 1e-3) stop = i * setup.dt + last / alpha;
            last = now;
        }
        sheet.compare("stops at, s" + where, stop, 10 / alpha, setup.dt);
    }
}

void ride_belt(const Setup& setup, Sheet& sheet) {
    const double speed = 2, friction = 0.4;
    World world = make_world(setup);
    BodyDef belt;
    belt.kind = BodyKind::Kinematic;
    belt.shapes = {block({40, 4, 1}, rough(friction))};
    belt.position = {0, 0, -0.5};
    belt.linear_velocity = to_vec3({speed, 0, 0});
    const BodyId under = add(world, belt);
    BodyDef def;
    def.shapes = {block({0.5, 0.5, 0.2}, rough(friction))};
    def.position = {0, 0, 0.1};
    const BodyId body = add(world, def);
    run(world, setup, 0.4);
    const double v = friction * gravity * 0.4;
    sheet.compare("speed after 0.4 s, m/s", velocity_of(world, body).x, v, 0.01 * v);
    run(world, setup, 1.1);
    const double slip = speed * speed / (2 * friction * gravity);
    sheet.compare("slip, m", center_of(world, under).x - center_of(world, body).x, slip,
                  0.01 * slip + speed * substep_of(setup));
    sheet.compare("speed at last, m/s", velocity_of(world, body).x, speed, 0.01 * speed);
}

double lean_after(const Setup& setup, Ground ground, double angle, double seconds) {
    World world = make_world(setup);
    const Slope slope = slope_of(radians(angle));
    add_ground(world, ground, rough(1), radians(angle));
    BodyDef def;
    def.shapes = {block({1, 1, 2}, rough(1))};
    def.position = to_position(slope.normal);
    def.rotation = to_quat(slope.turn);
    const BodyId body = add(world, def);
    double most = 0;
    for (int i = 0; i < steps_in(setup, seconds); ++i) {
        advance(world, setup.dt);
        most = std::max(most, degrees(angle_between(slope.turn, turn_of(world, body))));
    }
    return most;
}

void tip_over(const Setup& setup, Sheet& sheet) {
    for (const Ground ground : {Ground::Plane, Ground::Box}) {
        const std::string where = std::string(", ") + name(ground);
        sheet.bound("turn in 5 s at 26.2 degrees, degrees" + where,
                    lean_after(setup, ground, 26.2, 5), 0.1);
        sheet.claim("falls over at 27 degrees" + where, lean_after(setup, ground, 27, 5) > 45);
    }
}

}  // namespace

std::vector<Case> friction_cases() {
    return {
        {.id = "D08", .title = "stick or slide", .run = stick_or_slide, .quick = true},
        {.id = "D09", .title = "sliding down", .run = slide_down, .quick = true},
        {.id = "D10", .title = "sliding to a stop", .run = slide_to_stops, .quick = true},
        {.id = "D11", .title = "the same in 24 directions", .run = slide_all_ways, .quick = true},
        {.id = "D18", .title = "a twisted cube", .run = twist_cube, .quick = true},
        {.id = "D19", .title = "put on a moving belt", .run = ride_belt, .quick = true},
        {.id = "D20", .title = "tipping", .run = tip_over, .quick = true},
    };
}

}  // namespace cairn::physics
