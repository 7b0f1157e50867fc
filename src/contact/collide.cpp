// Axis and manifold at one go; see collide.h.

#include "contact/collide.h"

#include "contact/build_manifold.h"
#include "contact/manifold_box_box.h"
#include "narrow/axis_box_box.h"
#include "narrow/find_axis.h"

namespace cairn {

bool collide(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase method,
             const Reach& reach, AxisHint& hint, Axis& axis, Manifold& manifold) {
    const Box* box_a = std::get_if<Box>(&a);
    const Box* box_b = std::get_if<Box>(&b);
    manifold.point_count = 0;
    if (box_a && box_b) {
        const BoxPair pair = make_box_pair(*box_a, *box_b, b_in_a);
        if (!find_axis_box_box(pair, method, reach, hint, axis)) return false;
        manifold.normal = axis.normal;
        push_box_box(manifold, pair, axis, reach.along(axis.normal));
    } else {
        axis = find_axis(a, b, b_in_a, method, hint);
        manifold = build_manifold(a, b, b_in_a, axis, reach.along(axis.normal));
    }
    return manifold.point_count > 0;
}

}  // namespace cairn
