#pragma once
// Rows from contacts and bodies, W side by side: everything about a contact that stays as it is
// until it is anchored anew. Included by soft_passes.h alone.

#include "solver/soft_step/normal_laws.h"
#include "solver/soft_step/row_lanes.h"
#include "solver/soft_step/soft_contact.h"

namespace cairn {

template <int W>
inline Vec3Lanes<W> rotate(const FourLanes<W>& q, const Vec3Lanes<W>& v) {
    const Vec3Lanes<W> u = {q.x, q.y, q.z};
    const Vec3Lanes<W> t = Lanes<W>(2) * cross(u, v);
    return v + q.w * t + cross(u, t);
}

// 1 / the larger eigenvalue of a symmetric 2x2 matrix; 0 where nothing gives.
template <int W>
inline Lanes<W> softest(Lanes<W> tt, Lanes<W> tu, Lanes<W> uu) {
    using F = Lanes<W>;
    const F half_difference = F(0.5f) * (tt - uu);
    const F largest =
        F(0.5f) * (tt + uu) + square_root(half_difference * half_difference + tu * tu);
    return inverse_or_nothing(largest);
}

// One row on its way from its contacts into memory.
template <int P, bool Special, int W>
class RowFill {
public:
    using Row = SoftRow<P>;
    using F = Lanes<W>;
    using V = Vec3Lanes<W>;

    RowFill(const RowRange& range, const RowSource& source, std::size_t r)
        : source_(source),
          row_(range.rows + r * row_numbers<P>(Special) * W),
          contacts_(source, range.contacts + r * W),
          a_(read_heft(range.read_a + r * W)),
          b_(read_heft(range.read_b + r * W)) {}

    void fill() {
        find_frame();
        find_arms();
        fill_bodies();
        fill_normals();
        fill_softness();
        fill_friction();
        clear_totals();
    }

private:
    struct Heft {
        SymmetricLanes<W> inertia;
        F mass;
        V masses;
        FourLanes<W> rotation;
    };

    Heft read_heft(const std::uint32_t* bodies) const {
        const float* from[W];
        for (int lane = 0; lane < W; ++lane) from[lane] = &source_.hefts[bodies[lane]].xx;
        const FourLanes<W> first = gather_four<W>(from);
        for (int lane = 0; lane < W; ++lane) from[lane] += 4;
        const FourLanes<W> second = gather_four<W>(from);
        for (int lane = 0; lane < W; ++lane) from[lane] += 4;
        const FourLanes<W> masses = gather_four<W>(from);
        for (int lane = 0; lane < W; ++lane) from[lane] += 4;
        return {{first.x, first.y, first.z, first.w, second.x, second.y},
                second.z,
                first_three(masses),
                gather_four<W>(from)};
    }

    void find_frame() {
        const FourLanes<W> normal = contacts_.read(offsetof(Contact, normal));
        n_ = first_three(normal);
        remembered_load_ = normal.w;
        t1_ = any_perpendicular(n_);
        t2_ = cross(n_, t1_);
        surfaces_ = contacts_.read(offsetof(Contact, friction));
        slide_ = contacts_.read(offsetof(Contact, surface_velocity));
        row_.set(CAIRN_FIELD(n), n_);
        row_.set(CAIRN_FIELD(t1), t1_);
        row_.set(CAIRN_FIELD(t2), t2_);
    }

    // Friction acts where the load does.
    void find_arms() {
        const F count = contacts_.count();
        F load;
        for (int i = 0; i < P; ++i) {
            const auto is_there = is_there_[i] = count > F(float(i));
            const FourLanes<W> state = read_point(i, offsetof(ContactPoint, separation));
            separation_[i] = select(is_there, state.x, F(0));
            force_[i] = select(is_there, state.z, F(0));
            load += force_[i];
        }
        const auto bears = load > F(least_load);
        const F inverse_load = F(1) / select(bears, load, F(1));
        const F even = F(1) / max(count, F(1));
        for (int i = 0; i < P; ++i) {
            const FourLanes<W> p = read_point(i, 0), q = read_point(i, 16), r = read_point(i, 32);
            const V off_a = keep(i, {p.w, q.x, q.y}), off_b = keep(i, {r.y, r.z, r.w});
            arms_[i] = keep(i, rotate(a_.rotation, V{p.x, p.y, p.z})) + off_a;
            const V arm_b = keep(i, rotate(b_.rotation, V{q.z, q.w, r.x})) + off_b;
            const F weight =
                select(bears, force_[i] * inverse_load, select(is_there_[i], even, F(0)));
            arm_a_ = arm_a_ + weight * arms_[i];
            arm_b_ = arm_b_ + weight * arm_b;
            round_a_ += weight * dot(off_a, n_);
            round_b_ += weight * dot(off_b, n_);
        }
    }

    void fill_bodies() {
        row_.set(CAIRN_FIELD(arm_a), arm_a_);
        row_.set(CAIRN_FIELD(arm_b), arm_b_);
        row_.set(CAIRN_FIELD(round_a), round_a_);
        row_.set(CAIRN_FIELD(round_b), round_b_);
        row_.set(CAIRN_FIELD(mass_a), a_.mass);
        row_.set(CAIRN_FIELD(mass_b), b_.mass);
        set(CAIRN_FIELD(inertia_a), a_.inertia);
        set(CAIRN_FIELD(inertia_b), b_.inertia);
        if constexpr (Special) {
            row_.set(CAIRN_FIELD(masses_a), a_.masses);
            row_.set(CAIRN_FIELD(masses_b), b_.masses);
        }
    }

    void fill_normals() {
        const V turn_a = cross(arm_a_, n_), turn_b = cross(arm_b_, n_);
        const V spin_a = a_.inertia * turn_a, spin_b = b_.inertia * turn_b;
        const V spin = spin_a + spin_b;
        const V about_1 = a_.inertia * t1_ + b_.inertia * t1_;
        const V about_2 = a_.inertia * t2_ + b_.inertia * t2_;
        const F k00 = dot(n_, multiply(a_.masses + b_.masses, n_)) + dot(turn_a, spin_a) +
                      dot(turn_b, spin_b);
        const F k01 = dot(spin, t1_), k02 = dot(spin, t2_);
        const F k11 = dot(t1_, about_1), k12 = dot(t1_, about_2), k22 = dot(t2_, about_2);
        row_.set(CAIRN_FIELD(k00), k00);
        row_.set(CAIRN_FIELD(k01), k01);
        row_.set(CAIRN_FIELD(k02), k02);
        row_.set(CAIRN_FIELD(k11), k11);
        row_.set(CAIRN_FIELD(k12), k12);
        row_.set(CAIRN_FIELD(k22), k22);
        if constexpr (Special) rolling_mass_ = softest(k11, k12, k22);
        const F share = F(source_.h) * (remembered_load_ / max(contacts_.count(), F(1)));
        for (int i = 0; i < P; ++i) {
            const V d = arms_[i] - arm_a_;
            const F x = x_[i] = select(is_there_[i], dot(d, t1_), F(0));
            const F y = y_[i] = select(is_there_[i], dot(d, t2_), F(0));
            const F load = F(source_.h) * force_[i];
            const F k = k00 + y * y * k11 + x * x * k22 + F(2) * y * k01 - F(2) * x * k02 -
                        F(2) * x * y * k12;
            row_.set(CAIRN_FIELD(x), x, i);
            row_.set(CAIRN_FIELD(y), y, i);
            row_.set(CAIRN_FIELD(start_separation), separation_[i], i);
            row_.set(CAIRN_FIELD(separation), separation_[i], i);
            row_.set(CAIRN_FIELD(normal), load, i);
            row_.set(CAIRN_FIELD(remembered), min(share, load), i);
            row_.set(CAIRN_FIELD(mass), select(is_there_[i], inverse_or_nothing(k), F(0)), i);
        }
    }

    void fill_softness() {
        set_softness<Row>(row_, source_, min(a_.mass, b_.mass) > F(0), slide_.w);
    }

    void fill_friction() {
        const V one_a = cross(arm_a_, t1_), two_a = cross(arm_a_, t2_);
        const V one_b = cross(arm_b_, t1_), two_b = cross(arm_b_, t2_);
        const V ease_1 = multiply(a_.masses + b_.masses, t1_);
        const V ease_2 = multiply(a_.masses + b_.masses, t2_);
        const V spin_a = a_.inertia * two_a, spin_b = b_.inertia * two_b;
        const F k_11 =
            dot(t1_, ease_1) + dot(one_a, a_.inertia * one_a) + dot(one_b, b_.inertia * one_b);
        const F k_12 = dot(t1_, ease_2) + dot(one_a, spin_a) + dot(one_b, spin_b);
        const F k_22 = dot(t2_, ease_2) + dot(two_a, spin_a) + dot(two_b, spin_b);
        const F friction = surfaces_.x;
        const V sliding = first_three(slide_);
        row_.set(CAIRN_FIELD(friction), friction);
        row_.set(CAIRN_FIELD(slide_1), dot(t1_, sliding));
        row_.set(CAIRN_FIELD(slide_2), dot(t2_, sliding));
        row_.set(CAIRN_FIELD(k_11), k_11);
        row_.set(CAIRN_FIELD(k_12), k_12);
        row_.set(CAIRN_FIELD(k_22), k_22);
        row_.set(CAIRN_FIELD(tangent_mass), softest(k_11, k_12, k_22));
        const FourLanes<W> torque = contacts_.read(offsetof(Contact, rolling_torque));
        V force;
        F twist = torque.w;
        for (int i = 0; i < P; ++i) {
            const V f = keep(i, first_three(read_point(i, offsetof(ContactPoint, friction_force))));
            row_.set(CAIRN_FIELD(lever),
                     friction * square_root(x_[i] * x_[i] + y_[i] * y_[i]) + surfaces_.w, i);
            force = force + f;
            twist += dot(n_, cross(arms_[i] - arm_a_, f));
        }
        const F h = F(source_.h);
        row_.set(CAIRN_FIELD(friction_1), h * dot(t1_, force));
        row_.set(CAIRN_FIELD(friction_2), h * dot(t2_, force));
        row_.set(CAIRN_FIELD(twist), h * twist);
        const F about = dot(n_, a_.inertia * n_) + dot(n_, b_.inertia * n_);
        row_.set(CAIRN_FIELD(twist_mass), inverse_or_nothing(about));
        if constexpr (Special) {
            row_.set(CAIRN_FIELD(rolling_friction), surfaces_.z);
            row_.set(CAIRN_FIELD(rolling_mass), rolling_mass_);
            row_.set(CAIRN_FIELD(roll_1), h * dot(t1_, first_three(torque)));
            row_.set(CAIRN_FIELD(roll_2), h * dot(t2_, first_three(torque)));
        }
    }

    void clear_totals() {
        for (int i = 0; i < P; ++i) row_.set(CAIRN_FIELD(total), F(0), i);
        row_.set(CAIRN_FIELD(friction_total_1), F(0));
        row_.set(CAIRN_FIELD(friction_total_2), F(0));
        row_.set(CAIRN_FIELD(twist_total), F(0));
        if constexpr (Special) {
            row_.set(CAIRN_FIELD(roll_total_1), F(0));
            row_.set(CAIRN_FIELD(roll_total_2), F(0));
        }
    }

    FourLanes<W> read_point(int i, std::size_t bytes) const {
        return contacts_.read(ContactLanes<W>::point(i, bytes));
    }
    // v where there is a point i, nothing elsewhere.
    V keep(int i, const V& v) const {
        return {select(is_there_[i], v.x, F(0)), select(is_there_[i], v.y, F(0)),
                select(is_there_[i], v.z, F(0))};
    }
    void set(std::size_t bytes, const SymmetricLanes<W>& m) {
        row_.set(bytes, m.xx, 0);
        row_.set(bytes, m.yy, 1);
        row_.set(bytes, m.zz, 2);
        row_.set(bytes, m.xy, 3);
        row_.set(bytes, m.xz, 4);
        row_.set(bytes, m.yz, 5);
    }

    const RowSource& source_;
    RowLanes<W> row_;
    ContactLanes<W> contacts_;
    Heft a_, b_;
    V n_, t1_, t2_;
    F remembered_load_;
    FourLanes<W> surfaces_;  // friction, restitution, rolling, spinning
    FourLanes<W> slide_;     // the surfaces' own velocity; size
    typename F::Choice is_there_[P];
    F separation_[P], force_[P], x_[P], y_[P];
    V arms_[P];  // of body A
    V arm_a_, arm_b_;
    F round_a_, round_b_;
    F rolling_mass_;
};

template <int P, bool Special, int W>
CAIRN_FLAT void fill_rows(const RowRange& range, const RowSource& source) {
    for (std::size_t r = 0; r < range.count; ++r) {
        if (r + 1 < range.count) prefetch_contacts<W>(source, range.contacts + (r + 1) * W);
        RowFill<P, Special, W>(range, source, r).fill();
    }
}

}  // namespace cairn
