#pragma once
// Rows between balls about their centers of mass, or such a ball and what stands still, W side by
// side: the same passes as soft_passes.h makes over other rows, of which each is a special case.
// Included by soft_passes.h alone.
//
// A ball's arm lies along the normal, r n, so that its spin has no part in how the surfaces close,
// and it may turn as it likes without moving the contact. Its inertia is one number: an impulse
// across the normal meets the same mass in every direction, and one round of friction is exact.

#include <cstddef>

#include "math/lanes.h"
#include "solver/soft_step/normal_laws.h"
#include "solver/soft_step/row_lanes.h"
#include "solver/soft_step/soft_contact.h"
#include "solver/soft_step/soft_kernels.h"

namespace cairn {

template <int W>
class BallPass {
public:
    using Row = BallRow;
    using F = Lanes<W>;
    using V = Vec3Lanes<W>;

    BallPass(const RowRange& range, std::size_t r, SoftBody* bodies)
        : row_(range.rows + r * ball_numbers * W),
          bodies_(bodies),
          read_a_(range.read_a + r * W),
          read_b_(range.read_b + r * W),
          write_a_(range.write_a + r * W),
          write_b_(range.write_b + r * W),
          n_(row_.vector(CAIRN_FIELD(n))) {}

    void warm_start() {
        V va = read(read_a_, 0), vb = read(read_b_, 0);
        V wa = read(read_a_, 4), wb = read(read_b_, 4);
        push(va, vb, row_.number(CAIRN_FIELD(normal)));
        const V t1 = row_.vector(CAIRN_FIELD(t1));
        rub(va, vb, wa, wb, t1, cross(n_, t1), row_.number(CAIRN_FIELD(friction_1)),
            row_.number(CAIRN_FIELD(friction_2)));
        write(va, vb, 0);
        write(wa, wb, 4);
    }

    void measure() {
        const V moved = read(read_b_, 8) - read(read_a_, 8);
        row_.set(CAIRN_FIELD(separation),
                 row_.number(CAIRN_FIELD(start_separation)) + dot(n_, moved));
    }

    void solve(F inverse_h) {
        V va = read(read_a_, 0), vb = read(read_b_, 0);
        change_load(va, vb, SoftLaw<Row, 1, W>(row_, inverse_h));
        write(va, vb, 0);
    }

    void relax(F inverse_h) {
        V va = read(read_a_, 0), vb = read(read_b_, 0);
        V wa = read(read_a_, 4), wb = read(read_b_, 4);
        change_load(va, vb, RigidLaw<Row, 1, W>(row_, inverse_h));
        change_friction(va, vb, wa, wb);
        write(va, vb, 0);
        write(wa, wb, 4);
    }

    void add_totals() {
        add(CAIRN_FIELD(total), CAIRN_FIELD(normal));
        add(CAIRN_FIELD(friction_total_1), CAIRN_FIELD(friction_1));
        add(CAIRN_FIELD(friction_total_2), CAIRN_FIELD(friction_2));
    }

private:
    // Three numbers of each body from one place in its record on.
    V read(const std::uint32_t* places, int first) const {
        const float* from[W];
        for (int lane = 0; lane < W; ++lane) from[lane] = &bodies_[places[lane]].v.x + first;
        return first_three(gather_four<W>(from));
    }
    void write(const V& a, const V& b, int first) {
        float* to[W];
        for (int lane = 0; lane < W; ++lane) to[lane] = &bodies_[write_a_[lane]].v.x + first;
        scatter_four<W>({a.x, a.y, a.z, {}}, to);
        for (int lane = 0; lane < W; ++lane) to[lane] = &bodies_[write_b_[lane]].v.x + first;
        scatter_four<W>({b.x, b.y, b.z, {}}, to);
    }

    template <class Law>
    void change_load(V& va, V& vb, const Law& law) {
        const F before = row_.number(CAIRN_FIELD(normal));
        const F load = law(0, dot(n_, vb - va), before);
        row_.set(CAIRN_FIELD(normal), load);
        push(va, vb, load - before);
    }

    void change_friction(V& va, V& vb, V& wa, V& wb) {
        const V t1 = row_.vector(CAIRN_FIELD(t1)), t2 = cross(n_, t1);
        const V v = vb - va;
        // Of both surfaces together: s x n is their speed.
        const V spin = row_.number(CAIRN_FIELD(arm_b)) * wb - row_.number(CAIRN_FIELD(arm_a)) * wa;
        const F v1 = dot(t1, v) + dot(t2, spin) + row_.number(CAIRN_FIELD(slide_1));
        const F v2 = dot(t2, v) - dot(t1, spin) + row_.number(CAIRN_FIELD(slide_2));
        const F before_1 = row_.number(CAIRN_FIELD(friction_1));
        const F before_2 = row_.number(CAIRN_FIELD(friction_2));
        const F mass = row_.number(CAIRN_FIELD(tangent_mass));
        F f1 = before_1 - mass * v1, f2 = before_2 - mass * v2;
        const F limit = max(row_.number(CAIRN_FIELD(friction)), F(least_friction)) *
                        row_.number(CAIRN_FIELD(normal));
        const F squared = f1 * f1 + f2 * f2;
        const auto slides = squared > limit * limit;
        if (any<W>(slides)) {
            const F shorter = select(slides, limit / square_root(max(squared, F(1e-36f))), F(1));
            f1 = shorter * f1;
            f2 = shorter * f2;
        }
        row_.set(CAIRN_FIELD(friction_1), f1);
        row_.set(CAIRN_FIELD(friction_2), f2);
        rub(va, vb, wa, wb, t1, t2, f1 - before_1, f2 - before_2);
    }

    void push(V& va, V& vb, F load) {
        va = va - (row_.number(CAIRN_FIELD(mass_a)) * load) * n_;
        vb = vb + (row_.number(CAIRN_FIELD(mass_b)) * load) * n_;
    }

    // Changes both bodies by the impulse f1 t1 + f2 t2 at their arms.
    void rub(V& va, V& vb, V& wa, V& wb, const V& t1, const V& t2, F f1, F f2) {
        const V f = f1 * t1 + f2 * t2;
        const V turning = f1 * t2 - f2 * t1;  // n x f
        va = va - row_.number(CAIRN_FIELD(mass_a)) * f;
        vb = vb + row_.number(CAIRN_FIELD(mass_b)) * f;
        wa = wa - (row_.number(CAIRN_FIELD(inertia_a)) * row_.number(CAIRN_FIELD(arm_a))) * turning;
        wb = wb + (row_.number(CAIRN_FIELD(inertia_b)) * row_.number(CAIRN_FIELD(arm_b))) * turning;
    }

    void add(std::size_t to, std::size_t from) {
        row_.set(to, row_.number(to) + row_.number(from));
    }

    RowLanes<W> row_;
    SoftBody* bodies_;
    const std::uint32_t *read_a_, *read_b_, *write_a_, *write_b_;
    V n_;
};

// One row on its way from its contacts into memory.
template <int W>
class BallFill {
public:
    using Row = BallRow;
    using F = Lanes<W>;
    using V = Vec3Lanes<W>;

    BallFill(const RowRange& range, const RowSource& source, std::size_t r)
        : source_(source),
          row_(range.rows + r * ball_numbers * W),
          contacts_(source, range.contacts + r * W),
          a_(read_heft(range.read_a + r * W)),
          b_(read_heft(range.read_b + r * W)) {}

    void fill() {
        const FourLanes<W> normal = contacts_.read(offsetof(Contact, normal));
        const FourLanes<W> slide = contacts_.read(offsetof(Contact, surface_velocity));
        const V n = first_three(normal);
        const V t1 = any_perpendicular(n), t2 = cross(n, t1);
        const FourLanes<W> p = read_point(0), q = read_point(16), r = read_point(32);
        const F arm_a = dot(V{p.w, q.x, q.y}, n), arm_b = dot(V{r.y, r.z, r.w}, n);
        const FourLanes<W> state = read_point(offsetof(ContactPoint, separation));
        const V friction = first_three(read_point(offsetof(ContactPoint, friction_force)));
        const F load = F(source_.h) * state.z, share = F(source_.h) * normal.w;
        row_.set(CAIRN_FIELD(n), n);
        row_.set(CAIRN_FIELD(t1), t1);
        row_.set(CAIRN_FIELD(arm_a), arm_a);
        row_.set(CAIRN_FIELD(arm_b), arm_b);
        row_.set(CAIRN_FIELD(mass_a), a_.mass);
        row_.set(CAIRN_FIELD(mass_b), b_.mass);
        row_.set(CAIRN_FIELD(inertia_a), a_.inertia);
        row_.set(CAIRN_FIELD(inertia_b), b_.inertia);
        const F eased = a_.mass + b_.mass;
        const F rolled = arm_a * arm_a * a_.inertia + arm_b * arm_b * b_.inertia;
        row_.set(CAIRN_FIELD(mass), inverse_or_nothing(eased));
        row_.set(CAIRN_FIELD(tangent_mass), inverse_or_nothing(eased + rolled));
        row_.set(CAIRN_FIELD(start_separation), state.x);
        row_.set(CAIRN_FIELD(separation), state.x);
        row_.set(CAIRN_FIELD(normal), load);
        row_.set(CAIRN_FIELD(remembered), min(share, load));
        set_softness<Row>(row_, source_, min(a_.mass, b_.mass) > F(0), slide.w);
        row_.set(CAIRN_FIELD(friction), contacts_.read(offsetof(Contact, friction)).x);
        row_.set(CAIRN_FIELD(slide_1), dot(t1, first_three(slide)));
        row_.set(CAIRN_FIELD(slide_2), dot(t2, first_three(slide)));
        row_.set(CAIRN_FIELD(friction_1), F(source_.h) * dot(t1, friction));
        row_.set(CAIRN_FIELD(friction_2), F(source_.h) * dot(t2, friction));
        row_.set(CAIRN_FIELD(total), F(0));
        row_.set(CAIRN_FIELD(friction_total_1), F(0));
        row_.set(CAIRN_FIELD(friction_total_2), F(0));
    }

private:
    struct Heft {
        F inertia, mass;
    };
    Heft read_heft(const std::uint32_t* bodies) const {
        const float* from[W];
        for (int lane = 0; lane < W; ++lane) from[lane] = &source_.hefts[bodies[lane]].xx;
        const F inertia = gather_four<W>(from).x;
        for (int lane = 0; lane < W; ++lane) from[lane] += 4;
        return {inertia, gather_four<W>(from).z};
    }
    FourLanes<W> read_point(std::size_t bytes) const {
        return contacts_.read(ContactLanes<W>::point(0, bytes));
    }

    const RowSource& source_;
    RowLanes<W> row_;
    ContactLanes<W> contacts_;
    Heft a_, b_;
};

// What rows came to, into their contacts.
template <int W>
class BallStore {
public:
    using Row = BallRow;
    using F = Lanes<W>;
    using V = Vec3Lanes<W>;

    BallStore(const RowRange& range, const RowSource& source, std::size_t r)
        : source_(source),
          row_(range.rows + r * ball_numbers * W),
          contacts_(source, range.contacts + r * W) {}

    void store() {
        const F inverse_h = F(source_.inverse_h);
        const V n = row_.vector(CAIRN_FIELD(n)), t1 = row_.vector(CAIRN_FIELD(t1));
        const V t2 = cross(n, t1);
        const F load = row_.number(CAIRN_FIELD(normal)), total = row_.number(CAIRN_FIELD(total));
        const auto along = [&](std::size_t along_1, std::size_t along_2) {
            return row_.number(along_1) * t1 + row_.number(along_2) * t2;
        };
        FourLanes<W> state = read_point(offsetof(ContactPoint, separation));
        state.x = row_.number(CAIRN_FIELD(separation));
        state.z = inverse_h * load;
        state.w += total;
        write_point(offsetof(ContactPoint, separation), state);
        // What bears nothing holds nothing.
        const V force = select(load > F(least_load), inverse_h, F(0)) *
                        along(CAIRN_FIELD(friction_1), CAIRN_FIELD(friction_2));
        FourLanes<W> friction = read_point(offsetof(ContactPoint, friction_force));
        friction.x = force.x;
        friction.y = force.y;
        friction.z = force.z;
        write_point(offsetof(ContactPoint, friction_force), friction);
        const V rubbed = select(total > F(least_load), F(1), F(0)) *
                         along(CAIRN_FIELD(friction_total_1), CAIRN_FIELD(friction_total_2));
        FourLanes<W> impulse = read_point(offsetof(ContactPoint, friction_impulse));
        impulse.x += rubbed.x;
        impulse.y += rubbed.y;
        impulse.z += rubbed.z;
        write_point(offsetof(ContactPoint, friction_impulse), impulse);
        contacts_.write(offsetof(Contact, rolling_torque), {F(0), F(0), F(0), F(0)});
        if (source_.ends_step) learn_load(contacts_, source_, inverse_h * load);
    }

private:
    FourLanes<W> read_point(std::size_t bytes) const {
        return contacts_.read(ContactLanes<W>::point(0, bytes));
    }
    void write_point(std::size_t bytes, const FourLanes<W>& numbers) {
        contacts_.write(ContactLanes<W>::point(0, bytes), numbers);
    }

    const RowSource& source_;
    RowLanes<W> row_;
    ContactLanes<W> contacts_;
};

template <int W>
CAIRN_FLAT void warm_start_balls(const RowRange& range, SoftBody* bodies, const SoftPass&) {
    for (std::size_t r = 0; r < range.count; ++r) BallPass<W>(range, r, bodies).warm_start();
}
template <int W>
CAIRN_FLAT void solve_balls(const RowRange& range, SoftBody* bodies, const SoftPass& pass) {
    for (std::size_t r = 0; r < range.count; ++r)
        BallPass<W>(range, r, bodies).solve(Lanes<W>(pass.inverse_h));
}
template <int W>
CAIRN_FLAT void measure_balls(const RowRange& range, SoftBody* bodies, const SoftPass&) {
    for (std::size_t r = 0; r < range.count; ++r) BallPass<W>(range, r, bodies).measure();
}
template <int W>
CAIRN_FLAT void relax_balls(const RowRange& range, SoftBody* bodies, const SoftPass& pass) {
    for (std::size_t r = 0; r < range.count; ++r) {
        BallPass<W> row(range, r, bodies);
        row.measure();
        row.relax(Lanes<W>(pass.inverse_h));
        if (pass.first) row.add_totals();
    }
}
template <int W>
CAIRN_FLAT void fill_balls(const RowRange& range, const RowSource& source) {
    for (std::size_t r = 0; r < range.count; ++r) {
        if (r + 1 < range.count) prefetch_contacts<W>(source, range.contacts + (r + 1) * W);
        BallFill<W>(range, source, r).fill();
    }
}
template <int W>
CAIRN_FLAT void store_balls(const RowRange& range, const RowSource& source) {
    for (std::size_t r = 0; r < range.count; ++r) {
        if (r + 1 < range.count) prefetch_contacts<W>(source, range.contacts + (r + 1) * W);
        BallStore<W>(range, source, r).store();
    }
}

}  // namespace cairn
