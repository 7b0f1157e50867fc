#pragma once
// What one pass does to contact rows, W manifolds side by side. Each width is compiled by one file
// (lanes_*.cpp); nothing else includes this.
//
//   warm start   the impulses that the rows hold, onto the bodies
//   solve        soft normals: l <- max(0, l - m (k u + b) - i max(0, l - l_r)), where the
//                separation s < 0 gives b = k r (s + slop) and the spring gives way only to what
//                exceeds the remembered load l_r; rigid with b = s/h where s > 0
//   measure      separations from the bodies' present poses
//   relax        rigid normals without a push, then friction, which so knows the final load
//
// Separations follow the bodies exactly through any rotation R of a step: with g = R^-1 n - n,
// n.(R r) = n.r + g.r, so it takes one rotation a body, and a body that has not turned adds
// nothing at all.
//
// Friction is Coulomb's on a sphere: sliding along t1, t2, and twisting about n measured at the
// lever rho at which the points hold it, |(f1, f2, twist / rho)| <= mu load, with one mass for all
// directions, whose fixed point opposes the motion exactly.

#include <cstddef>

#include "math/lanes.h"
#include "solver/soft_step/ball_rows.h"
#include "solver/soft_step/normal_laws.h"
#include "solver/soft_step/row_lanes.h"
#include "solver/soft_step/soft_fill.h"
#include "solver/soft_step/soft_kernels.h"
#include "solver/soft_step/soft_poses.h"
#include "solver/soft_step/soft_store.h"

namespace cairn {

// Rounds over the points of one manifold, to and fro, on its few numbers alone: a flat face that
// strikes comes to rest level. A manifold is done when a round has changed no load by more than
// this share of the largest: what rests takes one.
constexpr int most_normal_rounds = 6;
constexpr float settled_share = 1e-3f;
// Rounds of the friction of one manifold, likewise.
constexpr int friction_rounds = 4;
template <int W>
struct LaneVelocities {
    Vec3Lanes<W> v, w;
};

template <int W>
inline LaneVelocities<W> gather_velocities(const SoftBody* bodies, const std::uint32_t* places) {
    const float* from[W];
    for (int lane = 0; lane < W; ++lane) from[lane] = &bodies[places[lane]].v.x;
    const FourLanes<W> v = gather_four<W>(from);
    for (int lane = 0; lane < W; ++lane) from[lane] += 4;
    const FourLanes<W> w = gather_four<W>(from);
    return {{v.x, v.y, v.z}, {w.x, w.y, w.z}};
}

template <int W>
inline void scatter_velocities(SoftBody* bodies, const std::uint32_t* places,
                               const LaneVelocities<W>& in) {
    float* to[W];
    for (int lane = 0; lane < W; ++lane) to[lane] = &bodies[places[lane]].v.x;
    scatter_four<W>({in.v.x, in.v.y, in.v.z, {}}, to);
    for (int lane = 0; lane < W; ++lane) to[lane] += 4;
    scatter_four<W>({in.w.x, in.w.y, in.w.z, {}}, to);
}

// One row with its bodies, from the gather to the scatter.
template <int P, bool Special, int W>
class RowPass {
public:
    using Row = SoftRow<P>;
    using F = Lanes<W>;
    using V = Vec3Lanes<W>;

    RowPass(const RowRange& range, std::size_t r, SoftBody* bodies)
        : row_(range.rows + r * row_numbers<P>(Special) * W),
          bodies_(bodies),
          read_a_(range.read_a + r * W),
          read_b_(range.read_b + r * W),
          write_a_(range.write_a + r * W),
          write_b_(range.write_b + r * W),
          n_(row_.vector(CAIRN_FIELD(n))),
          t1_(row_.vector(CAIRN_FIELD(t1))),
          t2_(row_.vector(CAIRN_FIELD(t2))) {}

    void gather() {
        a_ = gather_velocities<W>(bodies_, read_a_);
        b_ = gather_velocities<W>(bodies_, read_b_);
    }
    void scatter() {
        scatter_velocities<W>(bodies_, write_a_, a_);
        scatter_velocities<W>(bodies_, write_b_, b_);
    }

    void apply_all() {
        F load, about_1, about_2;
        for (int i = 0; i < P; ++i) {
            const F l = row_.number(CAIRN_FIELD(normal), i);
            load += l;
            about_1 += row_.number(CAIRN_FIELD(y), i) * l;
            about_2 -= row_.number(CAIRN_FIELD(x), i) * l;
        }
        if constexpr (Special) {
            about_1 += row_.number(CAIRN_FIELD(roll_1));
            about_2 += row_.number(CAIRN_FIELD(roll_2));
        }
        const V f = load * n_ + row_.number(CAIRN_FIELD(friction_1)) * t1_ +
                    row_.number(CAIRN_FIELD(friction_2)) * t2_;
        push(f, about_1 * t1_ + about_2 * t2_ + row_.number(CAIRN_FIELD(twist)) * n_);
    }

    void measure() {
        V moved_a, moved_b;
        const V bend_a = find_bend(read_a_, moved_a);
        const V bend_b = find_bend(read_b_, moved_b);
        const V arm_a = row_.vector(CAIRN_FIELD(arm_a));
        const V arm_b = row_.vector(CAIRN_FIELD(arm_b));
        const F at_a = dot(bend_a, arm_a) - row_.number(CAIRN_FIELD(round_a)) * dot(bend_a, n_);
        const F at_b = dot(bend_b, arm_b) - row_.number(CAIRN_FIELD(round_b)) * dot(bend_b, n_);
        const F opened = dot(n_, moved_b - moved_a) + (at_b - at_a);
        const V bend = bend_b - bend_a;
        const F along_1 = dot(bend, t1_);
        const F along_2 = dot(bend, t2_);
        for (int i = 0; i < P; ++i) {
            F s = row_.number(CAIRN_FIELD(start_separation), i) + opened;
            if constexpr (P > 1) {
                s += row_.number(CAIRN_FIELD(x), i) * along_1 +
                     row_.number(CAIRN_FIELD(y), i) * along_2;
            }
            row_.set(CAIRN_FIELD(separation), s, i);
        }
    }

    void solve_soft(F inverse_h) { solve_normals(SoftLaw<Row, P, W>(row_, inverse_h)); }
    void solve_rigid(F inverse_h) { solve_normals(RigidLaw<Row, P, W>(row_, inverse_h)); }

    void rub() {
        F load, hold;
        for (int i = 0; i < P; ++i) {
            const F l = row_.number(CAIRN_FIELD(normal), i);
            load += l;
            hold += row_.number(CAIRN_FIELD(lever), i) * l;
        }
        const V v = relative_velocity();
        const V spin = b_.w - a_.w;
        const F limit = max(row_.number(CAIRN_FIELD(friction)), F(least_friction)) * load;
        const F rho = hold / max(limit, F(1e-30f));
        const F inverse_rho = F(1) / max(rho, F(1e-15f));
        const F twist_mass = row_.number(CAIRN_FIELD(twist_mass));
        // Bodies that cannot twist at all leave the step to the sliding.
        const F by_twist =
            select(twist_mass > F(0), twist_mass * (inverse_rho * inverse_rho), F(1e30f));
        const F before_1 = row_.number(CAIRN_FIELD(friction_1));
        const F before_2 = row_.number(CAIRN_FIELD(friction_2));
        const F twist = row_.number(CAIRN_FIELD(twist));
        const Rubbing before = {
            .v1 = dot(t1_, v) + row_.number(CAIRN_FIELD(slide_1)),
            .v2 = dot(t2_, v) + row_.number(CAIRN_FIELD(slide_2)),
            .v3 = rho * dot(n_, spin),
            .f1 = before_1,
            .f2 = before_2,
            // Where nothing holds a twist, none is carried on.
            .f3 = select(rho > F(1e-15f), twist * inverse_rho, F(0)),
            .mass = min(row_.number(CAIRN_FIELD(tangent_mass)), by_twist),
            .k_33 = rho * rho / max(twist_mass, F(1e-30f)),
        };
        // Most stick: what is never cut back needs no root.
        Rubbing after = before;
        const auto slides = rub_rounds<false>(after, limit);
        if (any<W>(slides)) {
            Rubbing cut = before;
            rub_rounds<true>(cut, limit);
            after.f1 = select(slides, cut.f1, after.f1);
            after.f2 = select(slides, cut.f2, after.f2);
            after.f3 = select(slides, cut.f3, after.f3);
        }
        const F f1 = after.f1, f2 = after.f2, f3 = after.f3;
        row_.set(CAIRN_FIELD(friction_1), f1);
        row_.set(CAIRN_FIELD(friction_2), f2);
        row_.set(CAIRN_FIELD(twist), rho * f3);
        V turning = (rho * f3 - twist) * n_;
        if constexpr (Special) turning = turning + roll(load, spin);
        push((f1 - before_1) * t1_ + (f2 - before_2) * t2_, turning);
    }

    void add_totals() {
        for (int i = 0; i < P; ++i) add(CAIRN_FIELD(total), CAIRN_FIELD(normal), i);
        add(CAIRN_FIELD(friction_total_1), CAIRN_FIELD(friction_1));
        add(CAIRN_FIELD(friction_total_2), CAIRN_FIELD(friction_2));
        add(CAIRN_FIELD(twist_total), CAIRN_FIELD(twist));
        if constexpr (Special) {
            add(CAIRN_FIELD(roll_total_1), CAIRN_FIELD(roll_1));
            add(CAIRN_FIELD(roll_total_2), CAIRN_FIELD(roll_2));
        }
    }

private:
    V relative_velocity() const {
        return (b_.v + cross(b_.w, row_.vector(CAIRN_FIELD(arm_b)))) -
               (a_.v + cross(a_.w, row_.vector(CAIRN_FIELD(arm_a))));
    }

    // Speeds and impulses along t1, t2, and about n at the lever rho.
    struct Rubbing {
        F v1, v2, v3;
        F f1, f2, f3;
        F mass, k_33;
    };

    // Rounds of one step against the motion, each cut back to what the load can hold if CutBack;
    // tells where it was, or would have to be.
    template <bool CutBack>
    auto rub_rounds(Rubbing& at, F limit) const {
        const F k_11 = row_.number(CAIRN_FIELD(k_11));
        const F k_12 = row_.number(CAIRN_FIELD(k_12));
        const F k_22 = row_.number(CAIRN_FIELD(k_22));
        typename F::Choice slides = {};
        for (int round = 0; round < friction_rounds; ++round) {
            F g1 = at.f1 - at.mass * at.v1;
            F g2 = at.f2 - at.mass * at.v2;
            F g3 = at.f3 - at.mass * at.v3;
            const F squared = g1 * g1 + g2 * g2 + g3 * g3;
            const auto is_longer = squared > limit * limit;
            slides |= is_longer;
            if constexpr (CutBack) {
                const F shorter =
                    select(is_longer, limit / square_root(max(squared, F(1e-36f))), F(1));
                g1 = shorter * g1;
                g2 = shorter * g2;
                g3 = shorter * g3;
            }
            at.v1 += k_11 * (g1 - at.f1) + k_12 * (g2 - at.f2);
            at.v2 += k_12 * (g1 - at.f1) + k_22 * (g2 - at.f2);
            at.v3 += at.k_33 * (g3 - at.f3);
            at.f1 = g1;
            at.f2 = g2;
            at.f3 = g3;
        }
        return slides;
    }

    // Changes both bodies by the impulse f at c and a turning impulse.
    void push(const V& f, const V& turning) {
        if constexpr (Special) {
            a_.v = a_.v - multiply(row_.vector(CAIRN_FIELD(masses_a)), f);
            b_.v = b_.v + multiply(row_.vector(CAIRN_FIELD(masses_b)), f);
        } else {
            a_.v = a_.v - row_.number(CAIRN_FIELD(mass_a)) * f;
            b_.v = b_.v + row_.number(CAIRN_FIELD(mass_b)) * f;
        }
        const V on_a = cross(row_.vector(CAIRN_FIELD(arm_a)), f) + turning;
        const V on_b = cross(row_.vector(CAIRN_FIELD(arm_b)), f) + turning;
        a_.w = a_.w - row_.tensor(CAIRN_FIELD(inertia_a)) * on_a;
        b_.w = b_.w + row_.tensor(CAIRN_FIELD(inertia_b)) * on_b;
    }

    // The points of a manifold to and fro, each by the law.
    // One that comes twice in a row is as it should be and is left out the second time. From load
    // to load it is a chain of five operations: how each load changes each speed is worked out
    // beforehand.
    template <class Law>
    void solve_normals(const Law& law) {
        const V v = relative_velocity();
        const V spin = b_.w - a_.w;
        const F u0 = dot(n_, v);
        if constexpr (P == 1) {
            const F before = row_.number(CAIRN_FIELD(normal));
            const F l = law(0, u0, before);
            row_.set(CAIRN_FIELD(normal), l);
            push((l - before) * n_, V{});
        } else {
            const F u1 = dot(t1_, spin);
            const F u2 = dot(t2_, spin);
            const F k00 = row_.number(CAIRN_FIELD(k00));
            const F k01 = row_.number(CAIRN_FIELD(k01)), k02 = row_.number(CAIRN_FIELD(k02));
            const F k11 = row_.number(CAIRN_FIELD(k11)), k12 = row_.number(CAIRN_FIELD(k12));
            const F k22 = row_.number(CAIRN_FIELD(k22));
            F x[P], y[P], u[P], l[P], coupling[P][P];
            for (int i = 0; i < P; ++i) {
                x[i] = row_.number(CAIRN_FIELD(x), i);
                y[i] = row_.number(CAIRN_FIELD(y), i);
                u[i] = u0 + y[i] * u1 - x[i] * u2;
                l[i] = row_.number(CAIRN_FIELD(normal), i);
                const F q0 = k00 + k01 * y[i] - k02 * x[i];
                const F q1 = k01 + k11 * y[i] - k12 * x[i];
                const F q2 = k02 + k12 * y[i] - k22 * x[i];
                for (int j = 0; j <= i; ++j) {
                    coupling[i][j] = coupling[j][i] = q0 + q1 * y[j] - q2 * x[j];
                }
            }
            F largest_change, unsettled = F(1);  // 0 in a lane that is done
            const auto solve_point = [&](int i) {
                const F change = unsettled * (law(i, u[i], l[i]) - l[i]);
                l[i] += change;
                for (int j = 0; j < P; ++j) u[j] += coupling[i][j] * change;
                largest_change = max(largest_change, max(change, -change));
            };
            solve_point(0);
            for (int round = 0; round < most_normal_rounds; ++round) {
                largest_change = F(0);
                for (int i = 1; i < P; ++i) solve_point(i);
                for (int i = P - 1; i-- > 0;) solve_point(i);
                const F largest_load = max(max(l[0], l[1]), max(l[P - 2], l[P - 1]));
                const auto is_settled = F(settled_share) * largest_load > largest_change;
                unsettled = select(is_settled, F(0), unsettled);
                if (!any<W>(unsettled > F(0))) break;
            }
            F load, about_1, about_2;
            for (int i = 0; i < P; ++i) {
                const F change = l[i] - row_.number(CAIRN_FIELD(normal), i);
                row_.set(CAIRN_FIELD(normal), l[i], i);
                load += change;
                about_1 += y[i] * change;
                about_2 -= x[i] * change;
            }
            push(load * n_, about_1 * t1_ + about_2 * t2_);
        }
    }

    V roll(F load, const V& spin) {
        const F mass = row_.number(CAIRN_FIELD(rolling_mass));
        const F before_1 = row_.number(CAIRN_FIELD(roll_1));
        const F before_2 = row_.number(CAIRN_FIELD(roll_2));
        F r1 = before_1 - mass * dot(t1_, spin);
        F r2 = before_2 - mass * dot(t2_, spin);
        const F limit = row_.number(CAIRN_FIELD(rolling_friction)) * load;
        const F squared = r1 * r1 + r2 * r2;
        const F shorter =
            select(squared > limit * limit, limit / square_root(max(squared, F(1e-36f))), F(1));
        r1 = shorter * r1;
        r2 = shorter * r2;
        row_.set(CAIRN_FIELD(roll_1), r1);
        row_.set(CAIRN_FIELD(roll_2), r2);
        return (r1 - before_1) * t1_ + (r2 - before_2) * t2_;
    }

    // R^-1 n - n = 2 (q x (q x n) - s q x n) for the turn (q, s).
    V find_bend(const std::uint32_t* places, V& moved) const {
        const float* from[W];
        for (int lane = 0; lane < W; ++lane) from[lane] = &bodies_[places[lane]].displacement.x;
        const FourLanes<W> d = gather_four<W>(from);
        for (int lane = 0; lane < W; ++lane) from[lane] += 4;
        const FourLanes<W> q = gather_four<W>(from);
        moved = {d.x, d.y, d.z};
        const V axis = {q.x, q.y, q.z};
        const V t = cross(axis, n_);
        return F(2) * (cross(axis, t) - q.w * t);
    }

    void add(std::size_t to, std::size_t from, int i = 0) {
        row_.set(to, row_.number(to, i) + row_.number(from, i), i);
    }

    RowLanes<W> row_;
    SoftBody* bodies_;
    const std::uint32_t *read_a_, *read_b_, *write_a_, *write_b_;
    V n_, t1_, t2_;
    LaneVelocities<W> a_, b_;
};

template <int P, bool Special, int W>
CAIRN_FLAT void warm_start_rows(const RowRange& range, SoftBody* bodies, const SoftPass&) {
    for (std::size_t r = 0; r < range.count; ++r) {
        RowPass<P, Special, W> row(range, r, bodies);
        row.gather();
        row.apply_all();
        row.scatter();
    }
}

template <int P, bool Special, int W>
CAIRN_FLAT void solve_rows(const RowRange& range, SoftBody* bodies, const SoftPass& pass) {
    for (std::size_t r = 0; r < range.count; ++r) {
        RowPass<P, Special, W> row(range, r, bodies);
        row.gather();
        row.solve_soft(Lanes<W>(pass.inverse_h));
        row.scatter();
    }
}

template <int P, bool Special, int W>
CAIRN_FLAT void measure_rows(const RowRange& range, SoftBody* bodies, const SoftPass&) {
    for (std::size_t r = 0; r < range.count; ++r) {
        RowPass<P, Special, W>(range, r, bodies).measure();
    }
}

template <int P, bool Special, int W>
CAIRN_FLAT void relax_rows(const RowRange& range, SoftBody* bodies, const SoftPass& pass) {
    for (std::size_t r = 0; r < range.count; ++r) {
        RowPass<P, Special, W> row(range, r, bodies);
        row.measure();
        row.gather();
        row.solve_rigid(Lanes<W>(pass.inverse_h));
        row.rub();
        row.scatter();
        if (pass.first) row.add_totals();
    }
}

#undef CAIRN_FIELD

template <int W>
constexpr SoftKernels make_soft_kernels() {
    return {W,
            {warm_start_balls<W>, warm_start_rows<1, false, W>, warm_start_rows<4, false, W>,
             warm_start_rows<1, true, W>, warm_start_rows<4, true, W>},
            {solve_balls<W>, solve_rows<1, false, W>, solve_rows<4, false, W>,
             solve_rows<1, true, W>, solve_rows<4, true, W>},
            {measure_balls<W>, measure_rows<1, false, W>, measure_rows<4, false, W>,
             measure_rows<1, true, W>, measure_rows<4, true, W>},
            {relax_balls<W>, relax_rows<1, false, W>, relax_rows<4, false, W>,
             relax_rows<1, true, W>, relax_rows<4, true, W>},
            {fill_balls<W>, fill_rows<1, false, W>, fill_rows<4, false, W>, fill_rows<1, true, W>,
             fill_rows<4, true, W>},
            {store_balls<W>, store_rows<1, false, W>, store_rows<4, false, W>,
             store_rows<1, true, W>, store_rows<4, true, W>},
            move_bodies<W>};
}

}  // namespace cairn
