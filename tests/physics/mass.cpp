// Cases B: what a shape weighs and how hard it is to turn.

#include <algorithm>

#include "scene.h"

namespace cairn::physics {

namespace {

double as_double(float value) { return static_cast<double>(value); }

MassProperties weigh(const std::vector<ShapeDef>& shapes) {
    World world;
    BodyDef def;
    def.shapes = shapes;
    return world.mass_properties(add(world, def));
}

void compare_inertia(Sheet& sheet, const std::string& what, const MassProperties& found,
                     const Vec& expected) {
    const SymmetricMat3& i = found.inertia;
    sheet.compare(what + ", Ixx", as_double(i.xx), expected.x, 1e-6 * expected.x);
    sheet.compare(what + ", Iyy", as_double(i.yy), expected.y, 1e-6 * expected.y);
    sheet.compare(what + ", Izz", as_double(i.zz), expected.z, 1e-6 * expected.z);
    const double off =
        std::max({std::abs(as_double(i.xy)), std::abs(as_double(i.xz)), std::abs(as_double(i.yz))});
    sheet.bound(what + ", off the diagonal", off, 1e-6 * expected.x);
}

void weigh_solids(const Setup&, Sheet& sheet) {
    const double a = 0.7, b = 1.3, c = 2.9, density = 250;
    const MassProperties box = weigh({block({a, b, c}, rough(0), density)});
    const double mass = density * a * b * c;
    sheet.compare("box, mass", as_double(box.mass), mass, 1e-6 * mass);
    compare_inertia(sheet, "box", box,
                    (mass / 12) * Vec{b * b + c * c, a * a + c * c, a * a + b * b});

    const double r = 0.37;
    const MassProperties sphere = weigh({ball(r, rough(0), density)});
    const double heavy = density * 4 / 3 * pi * r * r * r;
    const double inertia = 0.4 * heavy * r * r;
    sheet.compare("sphere, mass", as_double(sphere.mass), heavy, 1e-6 * heavy);
    compare_inertia(sheet, "sphere", sphere, {inertia, inertia, inertia});
}

void weigh_capsule(const Setup&, Sheet& sheet) {
    // A cylinder of mass c and two half balls of mass s in all, h long between them.
    const double r = 0.5, h = 2;
    const MassProperties found = weigh({capsule(r, h, rough(0), 1)});
    const double c = pi * r * r * h, s = 4.0 / 3 * pi * r * r * r;
    const double along = c * r * r / 2 + s * 2 * r * r / 5;
    const double across =
        c * (h * h / 12 + r * r / 4) + s * (2 * r * r / 5 + h * h / 4 + 3 * h * r / 8);
    sheet.compare("capsule, mass", as_double(found.mass), c + s, 1e-6 * (c + s));
    compare_inertia(sheet, "capsule", found, {across, along, across});
    sheet.compare("capsule, Ixx / m", across / (c + s), 0.665625, 1e-6);
    sheet.compare("capsule, Iyy / m", along / (c + s), 0.11875, 1e-6);
}

void weigh_dumbbell(const Setup&, Sheet& sheet) {
    const double density = 1 / (4.0 / 3 * pi * 0.001);
    ShapeDef left = ball(0.1, rough(0), density), right = left;
    left.local_pose.position = {-0.5f, 0, 0};
    right.local_pose.position = {0.5f, 0, 0};
    const MassProperties found = weigh({left, right});
    sheet.compare("mass", as_double(found.mass), 2, 2e-6);
    compare_inertia(sheet, "dumbbell", found, {0.008, 0.508, 0.508});
}

}  // namespace

std::vector<Case> mass_cases() {
    return {
        {.id = "B01",
         .title = "box and sphere",
         .subject = Subject::Mass,
         .run = weigh_solids,
         .quick = true},
        {.id = "B02",
         .title = "capsule",
         .subject = Subject::Mass,
         .run = weigh_capsule,
         .quick = true},
        {.id = "B07",
         .title = "a dumbbell of two spheres",
         .subject = Subject::Mass,
         .run = weigh_dumbbell,
         .quick = true},
    };
}

}  // namespace cairn::physics
