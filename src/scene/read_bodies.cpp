// Bodies of a scene file, and their repeats.
//
// Reads: an element of "bodies". Writes: a SceneBody. Mass properties given by hand are checked
// against what a solid can have: principal moments above zero, none larger than the sum of the
// other two.

#include "scene/read_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cairn::scene {

namespace {

constexpr std::string_view body_keys[] = {"name",
                                          "kind",
                                          "position",
                                          "rotation",
                                          "linear_velocity",
                                          "angular_velocity",
                                          "shapes",
                                          "mass",
                                          "mass_properties",
                                          "gravity_scale",
                                          "linear_damping",
                                          "angular_damping",
                                          "gyroscopic",
                                          "force",
                                          "torque",
                                          "lock",
                                          "can_sleep",
                                          "continuous",
                                          "collision"};

BodyKind read_body_kind(const Fields& fields) {
    const JsonValue* value = fields.find("kind");
    if (value == nullptr) return BodyKind::Dynamic;
    static constexpr std::string_view words[] = {"static", "kinematic", "dynamic"};
    static constexpr BodyKind kinds[] = {BodyKind::Static, BodyKind::Kinematic, BodyKind::Dynamic};
    const std::string& word = read_string(*value, fields.place("kind"));
    for (std::size_t i = 0; i < 3; ++i) {
        if (word == words[i]) return kinds[i];
    }
    const std::string_view near = find_nearest(word, words);
    fields.place("kind").fail(fmt::format(
        "found {}{}; allowed: {}", describe(*value),
        near.empty() ? "" : fmt::format(", did you mean \"{}\"?", near), list_words(words)));
}

// Eigenvalues of a symmetric 3x3 matrix by Jacobi rotations: square roots only, and exact for a
// diagonal.
std::array<double, 3> find_principal_moments(const SymmetricMat3& inertia) {
    double a[3][3] = {{static_cast<double>(inertia.xx), static_cast<double>(inertia.xy),
                       static_cast<double>(inertia.xz)},
                      {static_cast<double>(inertia.xy), static_cast<double>(inertia.yy),
                       static_cast<double>(inertia.yz)},
                      {static_cast<double>(inertia.xz), static_cast<double>(inertia.yz),
                       static_cast<double>(inertia.zz)}};
    constexpr int planes[3][2] = {{0, 1}, {0, 2}, {1, 2}};
    for (int sweep = 0; sweep < 20; ++sweep) {
        for (const auto& plane : planes) {
            const int p = plane[0], q = plane[1], r = 3 - p - q;
            if (a[p][q] == 0) continue;
            const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
            const double t =
                (theta >= 0 ? 1 : -1) / (std::fabs(theta) + std::sqrt(theta * theta + 1));
            const double c = 1 / std::sqrt(t * t + 1), s = t * c;
            const double pq = a[p][q], rp = a[r][p], rq = a[r][q];
            a[p][p] -= t * pq;
            a[q][q] += t * pq;
            a[p][q] = a[q][p] = 0;
            a[r][p] = a[p][r] = c * rp - s * rq;
            a[r][q] = a[q][r] = s * rp + c * rq;
        }
    }
    std::array<double, 3> moments = {a[0][0], a[1][1], a[2][2]};
    std::sort(moments.begin(), moments.end());
    return moments;
}

SymmetricMat3 read_inertia(const JsonValue& value, const Place& at) {
    read_array(value, at, "an array of 6 numbers, [xx, yy, zz, xy, xz, yz]", 6);
    float entries[6];
    for (std::size_t i = 0; i < 6; ++i) entries[i] = read_float(value.items[i], {&at, {}, i});
    const SymmetricMat3 inertia = {entries[0], entries[1], entries[2],
                                   entries[3], entries[4], entries[5]};
    const auto moments = find_principal_moments(inertia);
    if (!(moments[0] > 0)) {
        at.fail(
            fmt::format("found principal moments {:.6g}, {:.6g}, {:.6g}; allowed: a positive "
                        "definite tensor, all three greater than 0",
                        moments[0], moments[1], moments[2]));
    }
    // A flat body meets this with equality, so binary32's rounding is let pass.
    if (moments[0] + moments[1] < moments[2] * (1 - 1e-5)) {
        at.fail(
            fmt::format("found principal moments {:.6g}, {:.6g}, {:.6g}, which break the triangle "
                        "inequality; allowed: none larger than the sum of the other two",
                        moments[0], moments[1], moments[2]));
    }
    return inertia;
}

MassProperties read_mass_properties(const JsonValue& value, const Place& at) {
    static constexpr std::string_view keys[] = {"mass", "center_of_mass", "inertia"};
    const Fields fields(value, at, keys);
    MassProperties properties;
    fields.require("mass", "kg, greater than 0");
    fields.read("mass", properties.mass, positive);
    fields.read("center_of_mass", properties.center_of_mass);
    properties.inertia = read_inertia(
        fields.require("inertia", "[xx, yy, zz, xy, xz, yz], kg m^2, about the center of mass"),
        fields.place("inertia"));
    return properties;
}

LockedAxes read_lock(const JsonValue& value, const Place& at) {
    static constexpr std::string_view words[] = {"x", "y", "z", "rx", "ry", "rz"};
    read_array(value, at, "an array of axes out of x, y, z, rx, ry, rz");
    LockedAxes lock;
    bool* const flags[] = {&lock.x, &lock.y, &lock.z, &lock.rx, &lock.ry, &lock.rz};
    for (std::size_t i = 0; i < value.items.size(); ++i) {
        const Place item_at = {&at, {}, i};
        const std::string& word = read_string(value.items[i], item_at);
        const auto found = std::find(std::begin(words), std::end(words), word);
        if (found == std::end(words)) {
            item_at.fail(
                fmt::format("found {}; allowed: {}", describe(value.items[i]), list_words(words)));
        }
        bool& flag = *flags[found - std::begin(words)];
        if (flag) item_at.fail(fmt::format("found \"{}\" again; allowed: each axis once", word));
        flag = true;
    }
    return lock;
}

CollisionFilter read_filter(const JsonValue& value, const Place& at) {
    static constexpr std::string_view keys[] = {"category", "mask", "group"};
    const Fields fields(value, at, keys);
    CollisionFilter filter;
    constexpr std::int64_t all_bits = 0xffffffff;
    if (const JsonValue* category = fields.find("category")) {
        filter.category = static_cast<std::uint32_t>(
            read_integer(*category, fields.place("category"), 0, all_bits));
    }
    if (const JsonValue* mask = fields.find("mask")) {
        filter.mask =
            static_cast<std::uint32_t>(read_integer(*mask, fields.place("mask"), 0, all_bits));
    }
    if (const JsonValue* group = fields.find("group")) {
        filter.group = static_cast<std::int32_t>(
            read_integer(*group, fields.place("group"), INT32_MIN, INT32_MAX));
    }
    return filter;
}

void read_mass(const Fields& fields, BodyDef& def) {
    const JsonValue* mass = fields.find("mass");
    const JsonValue* properties = fields.find("mass_properties");
    if (mass != nullptr && properties != nullptr) {
        fields.place("mass_properties")
            .fail("found together with \"mass\"; allowed: one of the two");
    }
    if (mass != nullptr) def.mass = read_float(*mass, fields.place("mass"), positive);
    if (properties != nullptr) {
        def.mass_properties = read_mass_properties(*properties, fields.place("mass_properties"));
    }
    if (def.kind == BodyKind::Dynamic && def.shapes.empty() && !def.mass_properties) {
        fields.at().fail(
            "found a dynamic body without mass; allowed: shapes, or \"mass_properties\"");
    }
}

void read_motion(const Fields& fields, BodyDef& def) {
    fields.read("position", def.position);
    fields.read("rotation", def.rotation);
    fields.read("linear_velocity", def.linear_velocity);
    fields.read("angular_velocity", def.angular_velocity);
    fields.read("gravity_scale", def.gravity_scale);
    fields.read("linear_damping", def.linear_damping, not_negative);
    fields.read("angular_damping", def.angular_damping, not_negative);
    fields.read("gyroscopic", def.gyroscopic);
    fields.read("force", def.force);
    fields.read("torque", def.torque);
    if (const JsonValue* lock = fields.find("lock"))
        def.lock = read_lock(*lock, fields.place("lock"));
}

SceneBody read_body(const JsonValue& value, const Place& at,
                    const std::vector<NamedMaterial>& materials) {
    const Fields fields(value, at, body_keys);
    SceneBody body;
    fields.read("name", body.name);
    if (fields.find("name") != nullptr && body.name.empty()) {
        fields.place("name").fail("found \"\"; allowed: a name of at least one character");
    }
    body.def.kind = read_body_kind(fields);
    read_motion(fields, body.def);
    if (const JsonValue* shapes = fields.find("shapes")) {
        const Place shapes_at = fields.place("shapes");
        read_array(*shapes, shapes_at, "an array of shapes");
        for (std::size_t i = 0; i < shapes->items.size(); ++i) {
            std::string material;
            body.def.shapes.push_back(read_shape(shapes->items[i], {&shapes_at, {}, i},
                                                 body.def.kind, materials, material));
            body.materials.push_back(std::move(material));
        }
    }
    read_mass(fields, body.def);
    fields.read("can_sleep", body.def.can_sleep);
    fields.read("continuous", body.continuous);
    if (const JsonValue* filter = fields.find("collision")) {
        body.def.collision = read_filter(*filter, fields.place("collision"));
    }
    return body;
}

Repeat read_repeat(const JsonValue& value, const Place& at) {
    static constexpr std::string_view keys[] = {"count", "spacing", "jitter", "seed"};
    const Fields fields(value, at, keys);
    Repeat repeat;
    const Place count_at = fields.place("count");
    const JsonValue& count =
        read_array(fields.require("count", "[x, y, z], copies along each axis"), count_at,
                   "an array of 3 whole numbers, [x, y, z]", 3);
    std::int64_t total = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        repeat.count[i] = read_integer(count.items[i], {&count_at, {}, i}, 1, max_bodies);
        total *= repeat.count[i];
        if (total > max_bodies) {
            count_at.fail(
                fmt::format("found more than {} copies; allowed: at most {} bodies in a scene",
                            max_bodies, max_bodies));
        }
    }
    fields.require("spacing", "[x, y, z], metres from copy to copy");
    fields.read("spacing", repeat.spacing);
    constexpr Range jitter_range = {0, 1e18, false, "metres from 0 to 1e18"};
    fields.read("jitter", repeat.jitter, jitter_range);
    if (const JsonValue* seed = fields.find("seed")) {
        if (seed->kind != JsonValue::Kind::Number || !seed->is_unsigned) {
            fields.place("seed").fail(
                fmt::format("found {}; allowed: a whole number from 0 to 18446744073709551615",
                            describe(*seed)));
        }
        repeat.seed = seed->natural;
    }
    return repeat;
}

}  // namespace

SceneBody read_body_entry(const JsonValue& value, const Place& at,
                          const std::vector<NamedMaterial>& materials) {
    const auto has_key = [&](std::string_view key) {
        return std::find(value.keys.begin(), value.keys.end(), key) != value.keys.end();
    };
    if (!has_key("repeat") && !has_key("body")) return read_body(value, at, materials);
    static constexpr std::string_view keys[] = {"repeat", "body"};
    const Fields fields(value, at, keys);
    const Repeat repeat = read_repeat(fields.require("repeat", "the grid of copies of \"body\""),
                                      fields.place("repeat"));
    SceneBody body = read_body(fields.require("body", "the body that is repeated"),
                               fields.place("body"), materials);
    body.repeat = repeat;
    return body;
}

}  // namespace cairn::scene
