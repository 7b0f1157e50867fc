// The doctor's look at the world's settings and at each body by itself: units, steps, speeds,
// masses, inertia, materials.
//
// Reads: a Scene. Writes: findings. Each threshold errs towards silence, so that what is told is
// worth reading.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/check_parts.h"

namespace cairn::scene {

namespace {

std::string entry_path(const Scene& scene, std::size_t entry) {
    const SceneBody& body = scene.bodies[entry];
    std::string path = fmt::format("bodies[{}]{}", entry, body.repeat ? ".body" : "");
    if (!body.name.empty()) path += fmt::format(" \"{}\"", body.name);
    return path;
}

bool any_shape_bounces(const Scene& scene) {
    for (const SceneBody& body : scene.bodies) {
        for (const ShapeDef& shape : body.def.shapes) {
            if (shape.material.restitution > 0) return true;
        }
    }
    return false;
}

void check_speed(const Scene& scene, std::size_t entry, const Extent& extent, Findings& findings) {
    const BodyDef& def = scene.bodies[entry].def;
    if (def.kind == BodyKind::Static) return;
    const double speed = find_length(def.linear_velocity);
    const double way = speed * scene.dt;
    if (std::isfinite(extent.least) && way > extent.least) {
        findings.add(
            "fast", entry_path(scene, entry),
            fmt::format("at {:.4g} m/s it moves {:.3g} m in a step, more than its thinnest side "
                        "({:.3g} m): it can pass through things",
                        speed, way, extent.least),
            fmt::format("a step of at most {:.2g} s", 0.5 * extent.least / speed));
    }
    const double turn = find_length(def.angular_velocity) * scene.dt;
    if (turn > 0.5) {
        findings.add(
            "spinning", entry_path(scene, entry),
            fmt::format("it turns {:.0f} degrees in a step, so its contacts are met late",
                        turn * 57.295779513),
            fmt::format("a step of at most {:.2g} s, or more substeps", 0.25 * scene.dt / turn));
    }
}

void check_inertia(const Scene& scene, std::size_t entry, const Extent& extent,
                   Findings& findings) {
    const MassProperties& given = *scene.bodies[entry].def.mass_properties;
    // No solid within this reach has a larger moment than all its mass at the far end.
    const double reach = extent.reach + find_length(given.center_of_mass);
    const double largest = widen(given.mass) * reach * reach;
    const double moment = widen(std::max({given.inertia.xx, given.inertia.yy, given.inertia.zz}));
    const char* const cure =
        "leave mass_properties out and give densities, or check the inertia's unit";
    if (moment > 1.01 * largest) {
        findings.add(
            "inertia", entry_path(scene, entry) + ".mass_properties.inertia",
            fmt::format("{:.4g} kg m^2 is more than its mass within its shapes can have ({:.4g}): "
                        "it will turn too slowly",
                        moment, largest),
            cure);
    } else if (moment < 1e-3 * widen(given.mass) * extent.most * extent.most / 12) {
        findings.add(
            "inertia", entry_path(scene, entry) + ".mass_properties.inertia",
            fmt::format("{:.4g} kg m^2 is tiny for its mass and shapes: touched off centre, it "
                        "will spin wildly",
                        moment),
            cure);
    }
    if (find_length(given.center_of_mass) > extent.reach) {
        findings.add("center", entry_path(scene, entry) + ".mass_properties.center_of_mass",
                     "it lies outside of the body's shapes", "give it in the body frame");
    }
}

void check_mass(const Scene& scene, std::size_t entry, const Extent& extent, Findings& findings) {
    const BodyDef& def = scene.bodies[entry].def;
    if (def.kind != BodyKind::Dynamic) {
        if (def.mass || def.mass_properties) {
            findings.add("mass", entry_path(scene, entry),
                         "it is not dynamic but has a mass, which has no effect",
                         "leave the mass out, or make the body dynamic");
        }
        return;
    }
    if (def.mass_properties) {
        if (extent.most > 0) check_inertia(scene, entry, extent, findings);
        return;
    }
    if (def.mass) return;
    for (std::size_t i = 0; i < def.shapes.size(); ++i) {
        const float density = def.shapes[i].density;
        if (density >= 5 && density <= 25000) continue;
        findings.add(
            "density", fmt::format("{}.shapes[{}].density", entry_path(scene, entry), i),
            fmt::format("{:.4g} kg/m^3, where water has 1000 and the densest metal 22600", density),
            "give it in kg/m^3, or give the body's mass");
    }
}

void check_size(const Scene& scene, std::size_t entry, const Extent& extent, Findings& findings) {
    const BodyDef& def = scene.bodies[entry].def;
    if (def.shapes.empty()) {
        findings.add("shapeless", entry_path(scene, entry),
                     "it has no shapes, so it touches nothing",
                     "give it shapes, if it is meant to collide");
    }
    if (def.kind != BodyKind::Dynamic) return;
    if (extent.most > 500) {
        findings.add(
            "large", entry_path(scene, entry),
            fmt::format("{:.4g} m across: are lengths in another unit than metres?", extent.most),
            "write lengths in metres");
    }
    const double fall = 0.5 * find_length(scene.world.gravity) * scene.dt * scene.dt;
    if (std::isfinite(extent.least) && extent.least < fall) {
        findings.add("thin", entry_path(scene, entry),
                     fmt::format("{:.3g} m thin, less than it falls in its first step ({:.3g} m)",
                                 extent.least, fall),
                     fmt::format("a thicker body, or a step of at most {:.2g} s",
                                 0.5 * scene.dt * std::sqrt(extent.least / fall)));
    }
    if (def.lock == LockedAxes{true, true, true, true, true, true}) {
        findings.add("lock", entry_path(scene, entry) + ".lock",
                     "every axis is locked, so it cannot move at all", "make the body static");
    }
}

void check_materials(const Scene& scene, std::size_t entry, const Extent& extent,
                     Findings& findings) {
    const std::vector<ShapeDef>& shapes = scene.bodies[entry].def.shapes;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const Material& material = shapes[i].material;
        const std::string where = fmt::format("{}.shapes[{}]", entry_path(scene, entry), i);
        if (material.friction > 2) {
            findings.add(
                "friction", where,
                fmt::format("a friction of {:.4g}, where rubber on dry concrete has about 1",
                            material.friction),
                "give a coefficient, not an angle or a percentage");
        }
        const double lever = widen(std::max(material.rolling_friction, material.spinning_friction));
        if (extent.most > 0 && lever > 0.5 * extent.most) {
            findings.add(
                "rolling", where,
                fmt::format("a rolling or spinning friction of {:.4g} m, a lever longer than the "
                            "body's half",
                            lever),
                "give it in metres, some thousandths of the radius");
        }
    }
}

}  // namespace

void check_world(const Scene& scene, Findings& findings) {
    const double gravity = find_length(scene.world.gravity);
    if (gravity > 50) {
        findings.add(
            "gravity", "world.gravity",
            fmt::format("{:.4g} m/s^2 is {:.0f} times the earth's: are lengths in another unit "
                        "than metres?",
                        gravity, gravity / 9.81),
            "write lengths in metres and gravity as [0, -9.81, 0]");
    }
    if (scene.dt > 1.0 / 20) {
        findings.add(
            "dt", "step.dt",
            fmt::format("in a step of {:.4g} s a body at rest falls {:.3g} m before anything is "
                        "looked at",
                        scene.dt, gravity * scene.dt * scene.dt),
            "use 1/60 s or less");
    }
    if (scene.duration / scene.dt > 1e6) {
        findings.add("many steps", "step.dt",
                     fmt::format("{:.4g} s in steps of {:.3g} s are {:.2g} steps", scene.duration,
                                 scene.dt, scene.duration / scene.dt),
                     "a longer step, or fewer seconds by --seconds");
    }
    if (gravity > 0 && widen(scene.world.restitution_threshold) < gravity * scene.dt &&
        any_shape_bounces(scene) && scene.world.restitution_threshold < 0.01f) {
        findings.add(
            "threshold", "world.restitution_threshold",
            fmt::format("{:.3g} m/s is less than gravity gives in a step ({:.3g} m/s), so bodies "
                        "that bounce come to rest late",
                        scene.world.restitution_threshold, gravity * scene.dt),
            "raise it above gravity times dt");
    }
    const bool any_dynamic =
        std::any_of(scene.bodies.begin(), scene.bodies.end(),
                    [](const auto& body) { return body.def.kind == BodyKind::Dynamic; });
    if (!any_dynamic) {
        findings.add("still", "bodies", "no body is dynamic, so nothing will fall or be pushed",
                     "give a body the kind \"dynamic\"");
    }
}

void check_bodies(const Scene& scene, Findings& findings) {
    for (std::size_t entry = 0; entry < scene.bodies.size(); ++entry) {
        const SceneBody& body = scene.bodies[entry];
        const Extent extent = measure(body.def);
        check_speed(scene, entry, extent, findings);
        check_mass(scene, entry, extent, findings);
        check_size(scene, entry, extent, findings);
        check_materials(scene, entry, extent, findings);
        if (body.repeat && extent.most > 0 && body.repeat->jitter > extent.most) {
            findings.add("jitter", fmt::format("bodies[{}].repeat.jitter", entry),
                         fmt::format("{:.4g} m is more than a copy's size, so that copies overlap",
                                     body.repeat->jitter),
                         "a jitter below the gap between copies");
        }
    }
}

}  // namespace cairn::scene
