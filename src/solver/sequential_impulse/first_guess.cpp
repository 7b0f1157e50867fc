// The weight that new contacts will bear; see first_guess.h.

#include "solver/sequential_impulse/first_guess.h"

#include <algorithm>

namespace cairn {

namespace {

// A contact flatter than 60 degrees from the horizontal bears weight by its normal.
constexpr float least_steepness = 0.5f;
// At rest: neither open by more than this share of the size, nor moving by more than gravity makes
// in two substeps.
constexpr float resting_gap_share = 0.001f;
constexpr float resting_substeps = 2;

}  // namespace

bool FirstGuess::collect(const StepProblem& problem, std::span<const ContactRows> rows, Vec3 up,
                         float h, std::span<const float> loads) {
    supports_.clear();
    bool any_new = false;
    const float slow = resting_substeps * h * length(problem.gravity);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const ContactRows& row = rows[k];
        const float steepness = dot(row.normal, up);
        if (absolute(steepness) < least_steepness) continue;
        const bool b_above = steepness > 0;
        Support support = {.upper = b_above ? row.body_b : row.body_a,
                           .lower = b_above ? row.body_a : row.body_b,
                           .row = std::uint32_t(k),
                           .steepness = absolute(steepness)};
        const BodyMotion& a = problem.motions[row.body_a];
        const BodyMotion& b = problem.motions[row.body_b];
        const PointRow& p = row.points[0];
        const bool at_rest =
            p.separation <= resting_gap_share * row.size &&
            absolute(dot(row.normal, relative_velocity(a, p.r_a, b, p.r_b))) <= slow;
        support.is_new = loads[k] == 0 && at_rest;
        any_new = any_new || support.is_new;
        if (support.is_new || loads[k] > 0) supports_.push_back(support);
    }
    return any_new;
}

void FirstGuess::add_weights(const StepProblem& problem, std::span<const ContactRows> rows, float h,
                             std::span<float> loads) {
    const float g = length(problem.gravity);
    if (g == 0) return;
    const Vec3 up = (-1.0f / g) * problem.gravity;
    if (!collect(problem, rows, up, h, loads)) return;

    // Highest upper body first; all supports of one body together. Heights within a step are
    // measured from the contact, which needs no world positions: a support is above another if its
    // upper body rests on it.
    borne_.assign(problem.motions.size(), 0);
    added_.assign(problem.motions.size(), 0);
    const auto height = [&](std::uint32_t body) { return problem.heights[body]; };
    std::sort(supports_.begin(), supports_.end(), [&](const Support& x, const Support& y) {
        if (height(x.upper) != height(y.upper)) return height(x.upper) > height(y.upper);
        return x.upper != y.upper ? x.upper < y.upper : x.row < y.row;
    });
    for (const Support& s : supports_) borne_[s.lower] += s.steepness * loads[s.row];

    for (std::size_t first = 0, last = 0; first < supports_.size(); first = last) {
        const std::uint32_t body = supports_[first].upper;
        float supported = 0;
        std::size_t fresh = 0;
        for (last = first; last < supports_.size() && supports_[last].upper == body; ++last) {
            supported += supports_[last].steepness * loads[supports_[last].row];
            fresh += supports_[last].is_new;
        }
        const BodyInertia& inertia = problem.inertias[body];
        if (inertia.inverse_mass == 0) continue;
        const float weight = h * g * inertia.mass * problem.drives[body].gravity_scale;
        const float missing = fresh > 0 ? weight + borne_[body] - supported : added_[body];
        if (!(missing > 0)) continue;
        const float share = missing / float(fresh > 0 ? fresh : last - first);
        for (std::size_t i = first; i < last; ++i) {
            const Support& s = supports_[i];
            if (fresh > 0 && !s.is_new) continue;
            loads[s.row] += share * s.steepness;
            borne_[s.lower] += share;
            added_[s.lower] += share;
        }
    }
}

}  // namespace cairn
