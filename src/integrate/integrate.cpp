// Free motion of one body; see integrate.h.

#include "integrate/integrate.h"

namespace cairn {

namespace {

// Newton's steps for one piece, and the change, as a share of the speed, that ends them: three or
// four reach it.
constexpr int most_newton_steps = 8;
constexpr float settled_share = 1e-7f;
// Radians a piece: larger ones would need more steps for the same rounding.
constexpr float piece_angle = 0.2f;
// A body that turns more often than this in one substep is beyond tracing; pieces grow instead.
constexpr int most_pieces = 64;

struct BodyFrameSpin {
    Vec3 mean;   // Wm
    Vec3 after;  // W'
};

BodyFrameSpin solve_spin(Vec3 before, const SymmetricMat3& inertia,
                         const SymmetricMat3& inverse_inertia, float h) {
    const Vec3 momentum = inertia * before;
    const float settled = settled_share * length(before);
    Vec3 after = before;
    Vec3 mean = before;
    for (int i = 0; i < most_newton_steps; ++i) {
        const Vec3 turned = rotate_inverse(exponential_map(h * mean), momentum);
        // d/dW' of I W' - exp(-h Wm) I W, to second order in h: I - (h/2) [m]x, m the mean
        // momentum.
        const Vec3 k = (0.25f * h) * (momentum + turned);
        const Mat3 jacobian = {{inertia.xx, inertia.xy - k.z, inertia.xz + k.y},
                               {inertia.xy + k.z, inertia.yy, inertia.yz - k.x},
                               {inertia.xz - k.y, inertia.yz + k.x, inertia.zz}};
        const Vec3 change = solve(jacobian, inertia * after - turned);
        after -= change;
        mean = 0.5f * (before + after);
        if (length(change) <= settled) break;
    }
    // What the turn by `mean` makes of the momentum, exactly: no momentum is lost to a residual.
    after = inverse_inertia * rotate_inverse(exponential_map(h * mean), momentum);
    return {mean, after};
}

Vec3 without_locked(Vec3 v, bool x, bool y, bool z) {
    return {x ? 0 : v.x, y ? 0 : v.y, z ? 0 : v.z};
}

}  // namespace

Quat turn(Quat rotation, Vec3 theta) { return normalize(exponential_map(theta) * rotation); }

void free_rotation(Quat& rotation, Vec3& angular_velocity, const SymmetricMat3& inertia,
                   const SymmetricMat3& inverse_inertia, float h) {
    Vec3 spin = rotate_inverse(rotation, angular_velocity);
    const float angle = h * length(spin);
    const int pieces =
        angle < piece_angle * float(most_pieces) ? 1 + int(angle / piece_angle) : most_pieces;
    const float piece = h / float(pieces);
    for (int i = 0; i < pieces; ++i) {
        const BodyFrameSpin solved = solve_spin(spin, inertia, inverse_inertia, piece);
        rotation = normalize(rotation * exponential_map(piece * solved.mean));
        spin = solved.after;
    }
    angular_velocity = rotate(rotation, spin);
}

Vec3 tumble_slowly(Quat rotation, Vec3& angular_velocity, const SymmetricMat3& inertia,
                   const SymmetricMat3& inverse_inertia, float h) {
    const auto change_over = [&](float time, Vec3 spin) {
        return (-time) * (inverse_inertia * cross(spin, inertia * spin));
    };
    const Vec3 before = rotate_inverse(rotation, angular_velocity);
    const Vec3 middle = before + change_over(0.5f * h, before);
    const Vec3 after = before + change_over(h, middle);
    const Vec3 steady = rotate(rotation, middle);
    // Turned along with the body by the small vector h steady.
    const Vec3 turning = h * steady;
    const Vec3 along = rotate(rotation, after);
    const Vec3 aside = cross(turning, along);
    angular_velocity = along + (aside + 0.5f * cross(turning, aside));
    return steady;
}

bool tumbles(const BodyInertia& inertia, const BodyDrive& drive) {
    const bool turns_freely = !drive.lock.rx && !drive.lock.ry && !drive.lock.rz;
    return inertia.inverse_mass > 0 && drive.gyroscopic && !inertia.isotropic && turns_freely;
}

void integrate_velocity(BodyMotion& motion, const BodyInertia& inertia, const BodyDrive& drive,
                        const Response& response, Vec3 gravity, float h) {
    if (inertia.inverse_mass == 0) return;
    const LockedAxes& lock = drive.lock;
    Vec3 v = motion.linear_velocity +
             h * (drive.gravity_scale * gravity + inertia.inverse_mass * drive.force);
    Vec3 w = motion.angular_velocity + h * (response.inverse_inertia * drive.torque);
    // As a loss: the small share rounds far finer than a factor near 1 would.
    const float linear_loss = h * drive.linear_damping;
    const float angular_loss = h * drive.angular_damping;
    v -= (linear_loss / (1.0f + linear_loss)) * v;
    w -= (angular_loss / (1.0f + angular_loss)) * w;
    motion.linear_velocity = without_locked(v, lock.x, lock.y, lock.z);
    motion.angular_velocity = without_locked(w, lock.rx, lock.ry, lock.rz);
}

void integrate_pose(BodyMotion& motion, const BodyInertia& inertia, const BodyDrive& drive,
                    float h) {
    motion.displacement += h * motion.linear_velocity;
    if (motion.angular_velocity == Vec3{}) return;
    if (tumbles(inertia, drive)) {
        free_rotation(motion.rotation, motion.angular_velocity, inertia.inertia,
                      inertia.inverse_inertia, h);
    } else {
        motion.rotation = turn(motion.rotation, h * motion.angular_velocity);
    }
}

}  // namespace cairn
