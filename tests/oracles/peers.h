#pragma once
// What FCL and libccd say about a pair of boxes or balls.
//
// - fcl::collide: for boxes its own SAT (after ODE), for balls closed forms: depth and normal.
// - fcl::distance: libccd's GJK, for boxes; closed forms for balls.
// - ccdGJKPenetration: libccd's GJK and EPA, called directly.

#ifdef CAIRN_HAS_FCL

#include <optional>

#include "cairn/shape.h"

namespace cairn::oracles {

// Signed metres; negative where they overlap.
struct PeerAnswers {
    bool fcl_overlaps = false;
    double fcl_separation = 0;  // collide's depth where it overlaps, distance's distance where not
    bool ccd_overlaps = false;
    double ccd_separation = 0;  // of overlapping pairs
};

PeerAnswers ask_peers(const Geometry& a, const Geometry& b, const Pose& b_in_a);

}  // namespace cairn::oracles

#endif
