#pragma once
// How the load at a point answers the speed u at which its surfaces part: law(point, u, load) is
// the load that it comes to. What soft_passes.h says of its passes stands here as formulas;
// included by it alone.

#include "math/lanes.h"
#include "solver/soft_step/row_lanes.h"
#include "solver/soft_step/soft_kernels.h"

namespace cairn {

// Springs, as far as points overlap.
template <class Row, int P, int W>
class SoftLaw {
public:
    using F = Lanes<W>;

    SoftLaw(const RowLanes<W>& row, F inverse_h) : row_(row) {
        const F bias_rate = row_.number(CAIRN_FIELD(bias_rate));
        const F mass_scale = row_.number(CAIRN_FIELD(mass_scale));
        const F impulse_scale = row_.number(CAIRN_FIELD(impulse_scale));
        const F slowest = -row_.number(CAIRN_FIELD(push_speed));
        const F slop = row_.number(CAIRN_FIELD(slop));
        for (int i = 0; i < P; ++i) {
            const F s = row_.number(CAIRN_FIELD(separation), i);
            const F mass = row_.number(CAIRN_FIELD(mass), i);
            const auto open = s > F(0);
            const F bias =
                select(open, s * inverse_h, max(bias_rate * min(s + slop, F(0)), slowest));
            answer_[i] = mass * select(open, F(1), mass_scale);
            pushed_[i] = mass * bias;
            leak_[i] = select(open, F(0), impulse_scale);
        }
    }
    F operator()(int i, F u, F l) const {
        const F kept = l - leak_[i] * (l - row_.number(CAIRN_FIELD(remembered), i));
        return max((kept - pushed_[i]) - answer_[i] * u, F(0));
    }

private:
    RowLanes<W> row_;
    F answer_[P], pushed_[P], leak_[P];
};

template <class Row, int P, int W>
class RigidLaw {
public:
    using F = Lanes<W>;

    RigidLaw(const RowLanes<W>& row, F inverse_h) {
        for (int i = 0; i < P; ++i) {
            const F s = row.number(CAIRN_FIELD(separation), i);
            answer_[i] = row.number(CAIRN_FIELD(mass), i);
            pushed_[i] = answer_[i] * (max(s, F(0)) * inverse_h);
            // What is open has yet to close: that is the next substep's to meet.
            most_[i] = select(s > F(0), row.number(CAIRN_FIELD(normal), i), F(1e30f));
        }
    }
    F operator()(int i, F u, F l) const {
        return min(max((l - pushed_[i]) - answer_[i] * u, F(0)), most_[i]);
    }

private:
    F answer_[P], pushed_[P], most_[P];
};

// A row's springs, of two bodies or of a body and what cannot be pushed.
template <class Row, int W>
inline void set_softness(RowLanes<W>& row, const RowSource& source,
                         typename Lanes<W>::Choice moves_both, Lanes<W> size) {
    using F = Lanes<W>;
    const auto either = [&](float between, float ground) {
        return select(moves_both, F(between), F(ground));
    };
    const Softness &between = source.between, &ground = source.ground;
    row.set(CAIRN_FIELD(bias_rate), either(between.bias_rate, ground.bias_rate));
    row.set(CAIRN_FIELD(mass_scale), either(between.mass_scale, ground.mass_scale));
    row.set(CAIRN_FIELD(impulse_scale), either(between.impulse_scale, ground.impulse_scale));
    row.set(CAIRN_FIELD(push_speed),
            max(square_root(F(source.speed_squared_a_size) * size), F(source.speed_a_size) * size));
    row.set(CAIRN_FIELD(slop), F(source.slop_a_size) * size);
}

}  // namespace cairn
