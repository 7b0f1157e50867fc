#pragma once
// Impacts: contacts that close faster than the restitution threshold bounce, before the forces of
// the substep act. Shared by the methods, since a collision is over before either of them begins.
//
// All contacts that strike at one instant are solved together (accumulated and clamped impulses,
// friction on a circle), each toward Newton's rebound; what they set in motion may strike others,
// which makes the next round, so that a row of balls passes momentum on to the last one.
//
// Newton's rebound and Coulomb's friction together can make energy out of nothing where a spinning
// corner strikes (Kane and Levinson 1985), and so can sweeps that have not settled, where a body is
// struck against others. What the impulses P of strikes that share bodies do to these is work, sum
// P.(v_before + v_after)/2; where that exceeds what the rebounds alone would give, all of these P
// are shortened alike until the work is nothing. Strike by strike would not do: a blow shortened
// leaves the blow that answered it too strong.
//
// The rebound's speed counts for where in the substep the surfaces meet. For a relative
// acceleration a along n, semi-implicit Euler conserves Q = u^2/2 - a s + h a u/2 (u = n.v_rel, s
// the separation) in free flight. A bounce that sets u' so that Q' = e^2 Q, both seen from s = 0,
// gives the continuous motion's heights at every h; taking u' = e |u| instead costs g h/2 of speed
// a bounce.

#include <span>
#include <vector>

#include "solver/contact_rows.h"

namespace cairn {

class ImpactSolver {
public:
    // Once a step: which of the rows may bounce.
    void choose(std::span<const ContactRows> rows);
    bool any_may_bounce() const { return !bouncing_.empty(); }
    // Changes velocities only. Impulses are added to the contacts' reports, not to what warm
    // starting uses.
    void resolve(const StepProblem& problem, std::span<const Response> responses,
                 std::span<const ContactRows> rows, float h);

private:
    struct Strike {
        std::uint32_t row = 0;
        std::array<bool, 4> strikes = {};
        std::array<float, 4> target = {};  // n.v_rel after the impact
        std::array<float, 4> normal_impulse = {};
        std::array<Vec3, 4> friction_impulse = {};
        std::array<Vec3, 4> before = {};  // relative velocity of the surfaces when they struck
    };

    // One entry a body; the impulses scaled by x do the work x spent + x^2 made / 2, to which the
    // rebounds alone may add `due`. Kept with the body that stands for all of its group.
    struct Work {
        std::uint32_t group = 0;  // the body that stands for this one, or one nearer to it
        float spent = 0;
        float made = 0;
        float due = 0;
    };

    bool collect(const StepProblem& problem, std::span<const ContactRows> rows, float h);
    float solve_round(const StepProblem& problem, std::span<const Response> responses,
                      std::span<const ContactRows> rows, bool backward);
    void group(const StepProblem& problem, std::span<const ContactRows> rows);
    std::uint32_t find_group(std::uint32_t body);
    Work& find_work(const StepProblem& problem, const ContactRows& row);
    void forbid_gain(const StepProblem& problem, std::span<const Response> responses,
                     std::span<const ContactRows> rows);
    void report(const StepProblem& problem, std::span<const ContactRows> rows) const;

    std::vector<std::uint32_t> bouncing_;  // rows
    std::vector<Strike> strikes_;
    std::vector<Work> works_;
};

// The u' above: the relative speed after a bounce of restitution e, from relative speed u < 0 at
// separation s.
float rebound_speed(float u, float s, float a, float h, float e);

}  // namespace cairn
