// Inertia and response of bodies; see body.h.

#include "body/body.h"

namespace cairn {

namespace {

// Rotation about the world axis `locked` is forbidden: the inverse of what is left of the inertia
// when its row and column are struck out. Zeroing the inverse's own row would answer too softly. As
// an update of the inverse that already honours earlier locks: J' = J - (J e)(J e)^T / (e.J e).
SymmetricMat3 lock_rotation(const SymmetricMat3& j, Vec3 e) {
    const Vec3 je = j * e;
    const float pivot = dot(e, je);
    if (!(pivot > 0)) return j;
    const float s = 1.0f / pivot;
    SymmetricMat3 r = {j.xx - s * je.x * je.x, j.yy - s * je.y * je.y, j.zz - s * je.z * je.z,
                       j.xy - s * je.x * je.y, j.xz - s * je.x * je.z, j.yz - s * je.y * je.z};
    // Exactly zero along the locked axis, whatever the rounding.
    if (e.x != 0) r.xx = r.xy = r.xz = 0;
    if (e.y != 0) r.yy = r.xy = r.yz = 0;
    if (e.z != 0) r.zz = r.xz = r.yz = 0;
    return r;
}

}  // namespace

BodyInertia make_inertia(const MassProperties& p) {
    BodyInertia result;
    result.mass = p.mass;
    result.inverse_mass = p.mass > 0 ? 1.0f / p.mass : 0;
    result.inertia = p.inertia;
    result.inverse_inertia = inverse(p.inertia);
    const SymmetricMat3& i = p.inertia;
    result.isotropic = i.xx == i.yy && i.yy == i.zz && i.xy == 0 && i.xz == 0 && i.yz == 0;
    return result;
}

Response find_response(const BodyInertia& inertia, const BodyDrive& drive, Quat rotation) {
    Response response;
    const float m = inertia.inverse_mass;
    response.inverse_mass = {drive.lock.x ? 0 : m, drive.lock.y ? 0 : m, drive.lock.z ? 0 : m};
    if (inertia.isotropic) {
        response.inverse_inertia = inertia.inverse_inertia;
    } else {
        response.inverse_inertia = rotate(to_matrix(rotation), inertia.inverse_inertia);
    }
    if (drive.lock.rx)
        response.inverse_inertia = lock_rotation(response.inverse_inertia, {1, 0, 0});
    if (drive.lock.ry)
        response.inverse_inertia = lock_rotation(response.inverse_inertia, {0, 1, 0});
    if (drive.lock.rz)
        response.inverse_inertia = lock_rotation(response.inverse_inertia, {0, 0, 1});
    return response;
}

}  // namespace cairn
