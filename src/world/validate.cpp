// Checks of everything that a user hands in; see validate.h.

#include "world/validate.h"

#include <charconv>
#include <string>

#include "body/body.h"

namespace cairn {

namespace {

std::string format(double value) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    return std::string(text, end);
}

Error refuse(ErrorCode code, const Path& name, std::string_view found, std::string_view allowed) {
    std::string message = name.text();
    message.append(": ").append(found).append("; allowed: ").append(allowed);
    return {code, std::move(message)};
}

// The first refusal of several checks, none of which is costly.
template <class... Refusals>
Refusal first_of(Refusals&&... refusals) {
    Refusal result;
    ((result || !(refusals) ? void() : void(result = *refusals)), ...);
    return result;
}

// Eigenvalues need not be known: leading minors say whether a symmetric matrix is positive
// definite.
bool is_positive_definite(double xx, double yy, double zz, double xy, double xz, double yz) {
    const double minor = xx * yy - xy * xy;
    const double determinant =
        xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
    return xx > 0 && minor > 0 && determinant > 0;
}

}  // namespace

Refusal check_finite(const Path& name, double value) {
    if (!is_finite(value))
        return refuse(ErrorCode::NotFinite, name, format(value), "a finite number");
    if (value > largest_quantity || value < -largest_quantity) {
        return refuse(ErrorCode::OutOfRange, name, format(value), "at most 1e15 in magnitude");
    }
    return {};
}

Refusal check_finite(const Path& name, const Vec3& v) {
    return first_of(check_finite(Path(name, ".x"), double(v.x)),
                    check_finite(Path(name, ".y"), double(v.y)),
                    check_finite(Path(name, ".z"), double(v.z)));
}

Refusal check_position(const Path& name, const Position& p) {
    return first_of(check_finite(Path(name, ".x"), p.x), check_finite(Path(name, ".y"), p.y),
                    check_finite(Path(name, ".z"), p.z));
}

Refusal check_rotation(const Path& name, const Quat& q) {
    if (Refusal r = first_of(check_finite(Path(name, ".x"), double(q.x)),
                             check_finite(Path(name, ".y"), double(q.y)),
                             check_finite(Path(name, ".z"), double(q.z)),
                             check_finite(Path(name, ".w"), double(q.w)))) {
        return r;
    }
    const double squared = double(q.x) * double(q.x) + double(q.y) * double(q.y) +
                           double(q.z) * double(q.z) + double(q.w) * double(q.w);
    if (squared < 1e-20)
        return refuse(ErrorCode::OutOfRange, name, "a quaternion of length 0", "any other");
    return {};
}

Refusal check_at_least(const Path& name, double value, double least) {
    if (Refusal r = check_finite(name, value)) return r;
    if (value < least)
        return refuse(ErrorCode::OutOfRange, name, format(value), "at least " + format(least));
    return {};
}

Refusal check_positive(const Path& name, double value) {
    if (Refusal r = check_finite(name, value)) return r;
    if (!(value > 0)) return refuse(ErrorCode::OutOfRange, name, format(value), "more than 0");
    return {};
}

namespace {

Refusal check_length(const Path& name, float value) {
    if (Refusal r = check_finite(name, double(value))) return r;
    if (value < smallest_length || value > largest_length) {
        return refuse(ErrorCode::OutOfRange, name, format(double(value)), "1e-9 to 1e9 metres");
    }
    return {};
}

Refusal check_geometry(const Path& name, const Geometry& geometry, BodyKind kind) {
    if (const auto* sphere = std::get_if<Sphere>(&geometry)) {
        return check_length(Path(name, ".radius"), sphere->radius);
    }
    if (const auto* box = std::get_if<Box>(&geometry)) {
        return first_of(check_length(Path(name, ".half_extents.x"), box->half_extents.x),
                        check_length(Path(name, ".half_extents.y"), box->half_extents.y),
                        check_length(Path(name, ".half_extents.z"), box->half_extents.z));
    }
    if (const auto* capsule = std::get_if<Capsule>(&geometry)) {
        if (Refusal r = check_length(Path(name, ".radius"), capsule->radius)) return r;
        const Path height(name, ".height");
        if (Refusal r = check_finite(height, double(capsule->height))) return r;
        if (capsule->height < 0 || capsule->height > largest_length)
            return refuse(ErrorCode::OutOfRange, height, format(double(capsule->height)),
                          "0 to 1e9 metres");
        return {};
    }
    const auto& plane = *std::get_if<Plane>(&geometry);
    if (kind != BodyKind::Static) {
        return refuse(ErrorCode::OutOfRange, name, "a plane on a body that is not static",
                      "static bodies only");
    }
    if (Refusal r = first_of(check_finite(Path(name, ".normal"), plane.normal),
                             check_finite(Path(name, ".offset"), double(plane.offset)))) {
        return r;
    }
    if (absolute(plane.offset) > largest_length) {
        return refuse(ErrorCode::OutOfRange, Path(name, ".offset"), format(double(plane.offset)),
                      "-1e9 to 1e9 metres");
    }
    if (!(length_squared(plane.normal) > 1e-20f)) {
        return refuse(ErrorCode::OutOfRange, Path(name, ".normal"), "a vector of length 0",
                      "any other");
    }
    return {};
}

}  // namespace

Refusal check_material(const Path& name, const Material& m) {
    if (Refusal r = first_of(
            check_at_least(Path(name, ".friction"), double(m.friction), 0),
            check_at_least(Path(name, ".restitution"), double(m.restitution), 0),
            check_at_least(Path(name, ".rolling_friction"), double(m.rolling_friction), 0),
            check_at_least(Path(name, ".spinning_friction"), double(m.spinning_friction), 0),
            check_finite(Path(name, ".surface_velocity"), m.surface_velocity))) {
        return r;
    }
    if (m.restitution > 1) {
        return refuse(ErrorCode::OutOfRange, Path(name, ".restitution"),
                      format(double(m.restitution)), "0 to 1");
    }
    return {};
}

Refusal check_mass_properties(const Path& name, const MassProperties& p) {
    const SymmetricMat3& i = p.inertia;
    const Path inertia(name, ".inertia");
    if (Refusal r = first_of(check_positive(Path(name, ".mass"), double(p.mass)),
                             check_finite(Path(name, ".center_of_mass"), p.center_of_mass),
                             check_finite(Path(inertia, ".xx"), double(i.xx)),
                             check_finite(Path(inertia, ".yy"), double(i.yy)),
                             check_finite(Path(inertia, ".zz"), double(i.zz)),
                             check_finite(Path(inertia, ".xy"), double(i.xy)),
                             check_finite(Path(inertia, ".xz"), double(i.xz)),
                             check_finite(Path(inertia, ".yz"), double(i.yz)))) {
        return r;
    }
    const double xx = i.xx, yy = i.yy, zz = i.zz, xy = i.xy, xz = i.xz, yz = i.yz;
    if (!is_positive_definite(xx, yy, zz, xy, xz, yz)) {
        return refuse(ErrorCode::OutOfRange, inertia, "a tensor that is not positive definite",
                      "the inertia of a body with extent in every direction");
    }
    // The covariance trace/2 - I of a mass distribution has no negative eigenvalue: no principal
    // moment exceeds the sum of the other two. A rod or plate sits on the border, so rounding is
    // let pass.
    const double half_trace = 0.5 * (xx + yy + zz);
    const double slack = 1e-5 * half_trace;
    if (!is_positive_definite(half_trace - xx + slack, half_trace - yy + slack,
                              half_trace - zz + slack, -xy, -xz, -yz)) {
        return refuse(ErrorCode::OutOfRange, inertia,
                      "a principal moment above the sum of the other two",
                      "the inertia of some distribution of mass");
    }
    const BodyInertia numbers = make_inertia(p);
    if (!is_finite(numbers.inverse_mass) || !is_finite(numbers.inverse_inertia.xx) ||
        !is_finite(numbers.inverse_inertia.yy) || !is_finite(numbers.inverse_inertia.zz) ||
        !(numbers.inverse_inertia.xx > 0)) {
        return refuse(ErrorCode::OutOfRange, name,
                      "a mass or inertia too small or too large for binary32", "1e-30 to 1e30");
    }
    return {};
}

Refusal check_shape(const Path& name, const ShapeDef& def, BodyKind kind) {
    if (Refusal r =
            first_of(check_geometry(Path(name, ".geometry"), def.geometry, kind),
                     check_finite(Path(name, ".local_pose.position"), def.local_pose.position),
                     check_rotation(Path(name, ".local_pose.rotation"), def.local_pose.rotation),
                     check_positive(Path(name, ".density"), double(def.density)),
                     check_material(Path(name, ".material"), def.material))) {
        return r;
    }
    const Vec3 p = absolute(def.local_pose.position);
    if (max(p.x, max(p.y, p.z)) > largest_length) {
        return refuse(ErrorCode::OutOfRange, Path(name, ".local_pose.position"),
                      format(double(max(p.x, max(p.y, p.z)))),
                      "at most 1e9 metres from the body's origin");
    }
    return {};
}

Refusal check_settings(const WorldSettings& s) {
    if (Refusal r = first_of(
            check_finite("settings.gravity", s.gravity),
            check_at_least("settings.restitution_threshold", double(s.restitution_threshold), 0),
            check_positive("settings.sleep_time", double(s.sleep_time)),
            check_at_least("settings.step.contact_compliance", double(s.step.contact_compliance),
                           0))) {
        return r;
    }
    const auto check_count = [](const Path& name, int count) -> Refusal {
        if (count >= 0 && count <= 1000) return {};
        return refuse(ErrorCode::OutOfRange, name, format(count),
                      "0 (the solver's default) to 1000");
    };
    if (s.step.lanes < 0 || s.step.lanes > 1024) {
        return refuse(ErrorCode::OutOfRange, "settings.step.lanes", format(s.step.lanes),
                      "0 (as many as the processor can) to 1024");
    }
    return first_of(check_count("settings.step.substeps", s.step.substeps),
                    check_count("settings.step.iterations", s.step.iterations));
}

Refusal check_body(const BodyDef& d) {
    if (Refusal r =
            first_of(check_position("position", d.position), check_rotation("rotation", d.rotation),
                     check_finite("linear_velocity", d.linear_velocity),
                     check_finite("angular_velocity", d.angular_velocity),
                     check_finite("gravity_scale", double(d.gravity_scale)),
                     check_at_least("linear_damping", double(d.linear_damping), 0),
                     check_at_least("angular_damping", double(d.angular_damping), 0),
                     check_finite("force", d.force), check_finite("torque", d.torque))) {
        return r;
    }
    for (std::size_t i = 0; i < d.shapes.size(); ++i) {
        const std::string name = "shapes[" + std::to_string(i) + "]";
        if (Refusal r = check_shape(std::string_view(name), d.shapes[i], d.kind)) return r;
    }
    if (d.mass && d.mass_properties) {
        return refuse(ErrorCode::OutOfRange, "mass", "given together with mass_properties",
                      "one of the two");
    }
    if (d.mass) {
        if (Refusal r = check_positive("mass", double(*d.mass))) return r;
    }
    if (d.mass_properties) return check_mass_properties("mass_properties", *d.mass_properties);
    return {};
}

}  // namespace cairn
