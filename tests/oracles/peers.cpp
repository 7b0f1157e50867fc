// FCL's and libccd's answers; see peers.h.

#ifdef CAIRN_HAS_FCL

#include "peers.h"

#include <ccd/ccd.h>
#include <ccd/quat.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "math/quat.h"

namespace cairn::oracles {
namespace {

// The same axes that the narrow phase sees, in binary64.
struct Placed {
    Geometry geometry;
    double axes[3][3];  // columns
    double center[3];

    Placed(const Geometry& shape, const Pose& pose) : geometry(shape) {
        const Mat3 m = to_matrix(pose.rotation);
        const Vec3 columns[3] = {m.x, m.y, m.z};
        for (int k = 0; k < 3; ++k) {
            axes[k][0] = double(columns[k].x);
            axes[k][1] = double(columns[k].y);
            axes[k][2] = double(columns[k].z);
            center[k] = double(component(pose.position, k));
        }
    }
    fcl::Transform3d transform() const {
        fcl::Transform3d t = fcl::Transform3d::Identity();
        // FCL's capsules lie along z, Cairn's along y.
        const int turned = std::holds_alternative<Capsule>(geometry) ? 2 : 0;
        for (int k = 0; k < 3; ++k) {
            for (int i = 0; i < 3; ++i) t.linear()(i, k) = axes[(k + turned) % 3][i];
            t.translation()(k) = center[k];
        }
        return t;
    }
};

std::shared_ptr<fcl::CollisionGeometryd> fcl_shape(const Geometry& geometry) {
    if (const auto* box = std::get_if<Box>(&geometry)) {
        const Vec3 h = box->half_extents;
        return std::make_shared<fcl::Boxd>(2 * double(h.x), 2 * double(h.y), 2 * double(h.z));
    }
    if (const auto* capsule = std::get_if<Capsule>(&geometry))
        return std::make_shared<fcl::Capsuled>(double(capsule->radius), double(capsule->height));
    return std::make_shared<fcl::Sphered>(double(std::get<Sphere>(geometry).radius));
}

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* out) {
    const Placed& placed = *static_cast<const Placed*>(object);
    const double d[3] = {direction->v[0], direction->v[1], direction->v[2]};
    double point[3] = {placed.center[0], placed.center[1], placed.center[2]};
    if (const auto* box = std::get_if<Box>(&placed.geometry)) {
        for (int k = 0; k < 3; ++k) {
            const double* u = placed.axes[k];
            const double along = d[0] * u[0] + d[1] * u[1] + d[2] * u[2];
            const double h = double(component(box->half_extents, k));
            for (int i = 0; i < 3; ++i) point[i] += (along < 0 ? -h : h) * u[i];
        }
    } else {
        const auto* capsule = std::get_if<Capsule>(&placed.geometry);
        const double r =
            double(capsule ? capsule->radius : std::get<Sphere>(placed.geometry).radius);
        const double half = capsule ? 0.5 * double(capsule->height) : 0;
        const double* u = placed.axes[1];
        const double along = d[0] * u[0] + d[1] * u[1] + d[2] * u[2];
        for (int i = 0; i < 3; ++i) point[i] += (along < 0 ? -half : half) * u[i];
        const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        for (int i = 0; i < 3; ++i) point[i] += r * d[i] / length;
    }
    ccdVec3Set(out, point[0], point[1], point[2]);
}

}  // namespace

PeerAnswers ask_peers(const Geometry& a, const Geometry& b, const Pose& b_in_a) {
    const Placed placed_a(a, {}), placed_b(b, b_in_a);
    const auto shape_a = fcl_shape(a), shape_b = fcl_shape(b);
    PeerAnswers answers;

    const fcl::CollisionRequestd collision(8, true);
    fcl::CollisionResultd contacts;
    fcl::collide(shape_a.get(), placed_a.transform(), shape_b.get(), placed_b.transform(),
                 collision, contacts);
    answers.fcl_overlaps = contacts.isCollision();
    if (answers.fcl_overlaps) {
        for (std::size_t i = 0; i < contacts.numContacts(); ++i) {
            answers.fcl_separation =
                std::min(answers.fcl_separation, -contacts.getContact(i).penetration_depth);
        }
    } else {
        const fcl::DistanceRequestd request(true);
        fcl::DistanceResultd result;
        answers.fcl_separation = fcl::distance(shape_a.get(), placed_a.transform(), shape_b.get(),
                                               placed_b.transform(), request, result);
    }

    ccd_t ccd;
    CCD_INIT(&ccd);
    ccd.support1 = ccd.support2 = support;
    ccd.max_iterations = 100;
    ccd.epa_tolerance = 1e-6;
    ccd_real_t depth = 0;
    ccd_vec3_t direction, position;
    answers.ccd_overlaps =
        ccdGJKPenetration(&placed_a, &placed_b, &ccd, &depth, &direction, &position) == 0;
    answers.ccd_separation = answers.ccd_overlaps ? -depth : 0;
    return answers;
}

}  // namespace cairn::oracles

#endif
