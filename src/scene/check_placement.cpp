// The doctor's look at the first instant: what overlaps, what carries what, what has nothing below
// it.
//
// Reads: the World that a scene makes, not stepped. Writes: findings. Loads are handed down from
// body to body along gravity, each body's weight shared evenly by the dynamic bodies that it stands
// on.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cairn/math.h"
#include "scene/check_parts.h"

namespace cairn::scene {

namespace {

struct Placed {
    const std::string* name = nullptr;
    BodyKind kind = BodyKind::Static;
    Position position;
    double height = 0;  // m, against gravity
    double mass = 0;
    Extent extent;
    bool falls = false;  // gravity acts on it
};

struct Support {
    std::size_t upper, lower;
};

double project(const Position& p, const Vec3& direction) {
    return p.x * widen(direction.x) + p.y * widen(direction.y) + p.z * widen(direction.z);
}

std::vector<Placed> place(const Scene& scene, const BuiltWorld& built, const Vec3& up) {
    std::vector<Placed> placed;
    const std::vector<BodyId> ids = built.world.bodies();
    std::vector<Extent> extents;
    for (const SceneBody& body : scene.bodies) extents.push_back(measure(body.def));
    const std::vector<PlacedBody> list = place_bodies(scene);
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const BodyDef& def = scene.bodies[list[i].entry].def;
        placed.push_back({&built.names[i], def.kind, list[i].position,
                          project(list[i].position, up),
                          widen(built.world.mass_properties(ids[i]).mass), extents[list[i].entry],
                          def.kind == BodyKind::Dynamic && def.gravity_scale > 0});
    }
    return placed;
}

std::string name_pair(const Placed& a, const Placed& b) {
    return fmt::format("\"{}\" and \"{}\"", *a.name, *b.name);
}

void check_overlap(const ContactReport& contact, const Placed& a, const Placed& b,
                   Findings& findings) {
    double deepest = 0;
    for (int i = 0; i < contact.point_count; ++i) {
        deepest = std::max(deepest, -widen(contact.points[static_cast<std::size_t>(i)].separation));
    }
    const double size = std::min(a.extent.least, b.extent.least);
    // A hundredth of the thinner body is what a resting contact may sink in anyway.
    if (deepest <= 0.01 * size) return;
    findings.add(
        "overlap", name_pair(a, b),
        fmt::format("they start {:.3g} m inside each other, {:.0f}% of the thinner one: they will "
                    "be pushed apart",
                    deepest, 100 * deepest / size),
        fmt::format("move one {:.3g} m along [{:.3g}, {:.3g}, {:.3g}]", deepest, contact.normal.x,
                    contact.normal.y, contact.normal.z));
}

void check_loads(std::vector<Placed>& placed, std::vector<Support>& supports, Findings& findings) {
    std::vector<std::vector<std::size_t>> lowers(placed.size());
    for (const Support& support : supports) lowers[support.upper].push_back(support.lower);
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < placed.size(); ++i) {
        if (placed[i].falls) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return placed[a].height > placed[b].height;
    });
    std::vector<double> load(placed.size(), 0.0);
    for (const std::size_t i : order) {
        std::vector<std::size_t>& below = lowers[i];
        std::sort(below.begin(), below.end());
        below.erase(std::unique(below.begin(), below.end()), below.end());
        for (const std::size_t lower : below) {
            load[lower] += (load[i] + placed[i].mass) / static_cast<double>(below.size());
        }
    }
    // Sequential impulses lose a stack's grip at some dozens to one; see the mass-ratio scene.
    constexpr double heavy = 40;
    for (const std::size_t i : order) {
        if (!(load[i] > heavy * placed[i].mass)) continue;
        findings.add(
            "load", fmt::format("\"{}\"", *placed[i].name),
            fmt::format("{:.3g} kg carry {:.3g} kg, {:.0f} times as much: it will be pressed in",
                        placed[i].mass, load[i], load[i] / placed[i].mass),
            "bring the masses closer, or take more iterations (or --solver xpbd)");
    }
}

void check_contacts(const BuiltWorld& built, std::vector<Placed>& placed, Findings& findings) {
    const std::vector<BodyId> ids = built.world.bodies();
    std::map<std::uint32_t, std::size_t> place_of;
    for (std::size_t i = 0; i < ids.size(); ++i) place_of[ids[i].index] = i;
    std::vector<Support> supports;
    for (const ContactReport& contact : built.world.contacts()) {
        const std::size_t a = place_of[contact.body_a.index], b = place_of[contact.body_b.index];
        check_overlap(contact, placed[a], placed[b], findings);
        if (placed[a].kind != BodyKind::Dynamic || placed[b].kind != BodyKind::Dynamic) continue;
        const bool a_is_upper = placed[a].height > placed[b].height;
        supports.push_back(a_is_upper ? Support{a, b} : Support{b, a});
    }
    check_loads(placed, supports, findings);
}

// Whether a half-space of the scene catches whatever falls, wherever it is.
bool has_floor(const Scene& scene, const Vec3& up) {
    for (const SceneBody& body : scene.bodies) {
        for (const ShapeDef& shape : body.def.shapes) {
            const auto* plane = std::get_if<Plane>(&shape.geometry);
            if (plane == nullptr) continue;
            const Vec3 normal =
                rotate(body.def.rotation, rotate(shape.local_pose.rotation, plane->normal));
            if (dot(normal, up) > 1e-3f * length(normal)) return true;
        }
    }
    return false;
}

void check_falls(const Scene& scene, const std::vector<Placed>& placed, const Vec3& up,
                 Findings& findings) {
    if (up == Vec3{} || has_floor(scene, up)) return;
    double lowest = std::numeric_limits<double>::infinity();
    for (const Placed& body : placed) {
        if (body.kind != BodyKind::Dynamic)
            lowest = std::min(lowest, body.height - body.extent.reach);
    }
    for (const Placed& body : placed) {
        if (!body.falls) continue;
        if (body.height < lowest || !std::isfinite(lowest)) {
            findings.add("falls", fmt::format("\"{}\"", *body.name),
                         "nothing is below it, so it will fall for ever",
                         "a static plane or box below it, or no gravity");
        }
    }
}

void check_distance(const std::vector<Placed>& placed, Findings& findings) {
    if (placed.empty()) return;
    // The middle of the coordinates, which one stray body does not move.
    const auto find_median = [&](double Position::*axis) {
        std::vector<double> values;
        for (const Placed& body : placed) values.push_back(body.position.*axis);
        std::nth_element(values.begin(),
                         values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                         values.end());
        return values[values.size() / 2];
    };
    const Position middle = {find_median(&Position::x), find_median(&Position::y),
                             find_median(&Position::z)};
    constexpr double far = 10'000;
    for (const Placed& body : placed) {
        const double dx = body.position.x - middle.x, dy = body.position.y - middle.y,
                     dz = body.position.z - middle.z;
        const double distance = std::sqrt(dx * dx + dy * dy + dz * dz);
        if (distance <= far) continue;
        findings.add(
            "far", fmt::format("\"{}\"", *body.name),
            fmt::format("it stands {:.3g} km from the middle of the scene", distance / 1000),
            "check its position, which is in metres");
    }
}

}  // namespace

void check_placement(const Scene& scene, const BuiltWorld& built, Findings& findings) {
    const Vec3 up = normalize(-scene.world.gravity);
    std::vector<Placed> placed = place(scene, built, up);
    check_contacts(built, placed, findings);
    check_falls(scene, placed, up, findings);
    check_distance(placed, findings);
}

}  // namespace cairn::scene
