// The weight that new contacts will bear; see first_guess.h.

#include "solver/first_guess.h"

#include <algorithm>

namespace cairn {

namespace {

// A contact flatter than 60 degrees from the horizontal bears weight by its normal.
constexpr float least_steepness = 0.5f;
// At rest is what is not open by more than this share of the size.
constexpr float resting_gap_share = 0.001f;

}  // namespace

bool FirstGuess::collect(Vec3 up, float slow, std::span<const Bearing> bearings) {
    supports_.clear();
    bool any_new = false;
    for (std::size_t k = 0; k < bearings.size(); ++k) {
        const Bearing& bearing = bearings[k];
        const float steepness = dot(bearing.normal, up);
        if (absolute(steepness) < least_steepness) continue;
        const bool b_above = steepness > 0;
        const bool at_rest =
            bearing.gap <= resting_gap_share * bearing.size && absolute(bearing.speed) <= slow;
        const bool is_new = bearing.load == 0 && at_rest;
        any_new = any_new || is_new;
        if (!is_new && !(bearing.load > 0)) continue;
        supports_.push_back({.upper = b_above ? bearing.body_b : bearing.body_a,
                             .lower = b_above ? bearing.body_a : bearing.body_b,
                             .bearing = std::uint32_t(k),
                             .steepness = absolute(steepness),
                             .is_new = is_new});
    }
    return any_new;
}

// Highest upper body first; all supports of one body together.
void FirstGuess::sort_from_above(std::span<const float> heights) {
    std::sort(supports_.begin(), supports_.end(), [&](const Support& x, const Support& y) {
        if (heights[x.upper] != heights[y.upper]) return heights[x.upper] > heights[y.upper];
        return x.upper != y.upper ? x.upper < y.upper : x.bearing < y.bearing;
    });
}

bool FirstGuess::add_weights(const StepProblem& problem, float slow, std::span<Bearing> bearings) {
    const float g = length(problem.gravity);
    if (g == 0) return false;
    const Vec3 up = (-1.0f / g) * problem.gravity;
    if (!collect(up, slow, bearings)) return false;
    sort_from_above(problem.heights);

    borne_.assign(problem.motions.size(), 0);
    added_.assign(problem.motions.size(), 0);
    const auto vertical = [&](const Support& s) { return s.steepness * bearings[s.bearing].load; };
    for (const Support& s : supports_) borne_[s.lower] += vertical(s);

    for (std::size_t first = 0, last = 0; first < supports_.size(); first = last) {
        const std::uint32_t body = supports_[first].upper;
        float supported = 0;
        std::size_t fresh = 0;
        for (last = first; last < supports_.size() && supports_[last].upper == body; ++last) {
            supported += vertical(supports_[last]);
            fresh += supports_[last].is_new;
        }
        const BodyInertia& inertia = problem.inertias[body];
        if (inertia.inverse_mass == 0) continue;
        const float weight = g * inertia.mass * problem.drives[body].gravity_scale;
        const float missing = fresh > 0 ? weight + borne_[body] - supported : added_[body];
        if (!(missing > 0)) continue;
        const float share = missing / float(fresh > 0 ? fresh : last - first);
        for (std::size_t i = first; i < last; ++i) {
            const Support& s = supports_[i];
            if (fresh > 0 && !s.is_new) continue;
            bearings[s.bearing].load += share * s.steepness;
            borne_[s.lower] += share;
            added_[s.lower] += share;
        }
    }
    return true;
}

}  // namespace cairn
