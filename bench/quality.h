#pragma once
// How good a result is, by one ruler for every engine: exact geometry in binary64, no engine's own
// idea of a contact.

#include <optional>
#include <span>

#include "engine.h"
#include "scene.h"

namespace cairn::bench {

struct Quality {
    double deepest_penetration = 0;  // m: how far some pair of parts would have to be moved apart
    double mean_penetration = 0;     // m, over the pairs that overlap
    std::size_t overlapping_pairs = 0;
    std::optional<double> drift;  // m: the farthest that what should stand is from its place
    double kinetic_energy = 0;    // J, of dynamic bodies
    std::size_t lost_bodies = 0;  // dynamic ones under the ground, or nowhere (not a number)
};

/// `motions` are those of the scene's bodies, in order; of the later ones there may be fewer.
Quality measure_quality(const BenchScene& scene, std::span<const BodyMotion> motions);

}  // namespace cairn::bench
