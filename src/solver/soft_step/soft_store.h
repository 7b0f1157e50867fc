#pragma once
// What rows came to, into their contacts, W side by side: impulses over the step for the report,
// forces for where the next step begins. Included by soft_passes.h alone.

#include "solver/soft_step/row_lanes.h"
#include "solver/soft_step/soft_contact.h"

namespace cairn {

template <int P, bool Special, int W>
class RowStore {
public:
    using Row = SoftRow<P>;
    using F = Lanes<W>;
    using V = Vec3Lanes<W>;

    RowStore(const RowRange& range, const RowSource& source, std::size_t r)
        : source_(source),
          row_(range.rows + r * row_numbers<P>(Special) * W),
          contacts_(source, range.contacts + r * W),
          n_(row_.vector(CAIRN_FIELD(n))),
          t1_(row_.vector(CAIRN_FIELD(t1))),
          t2_(row_.vector(CAIRN_FIELD(t2))) {}

    void store() {
        const F count = contacts_.count();
        F load, total;
        for (int i = 0; i < P; ++i) {
            load += row_.number(CAIRN_FIELD(normal), i);
            total += row_.number(CAIRN_FIELD(total), i);
        }
        const F inverse_h = F(source_.inverse_h);
        const F twist = store_points(count, load, total);
        const auto bears = load > F(least_load);

        FourLanes<W> torque = {F(0), F(0), F(0), select(bears, inverse_h * twist, F(0))};
        FourLanes<W> impulse = contacts_.read(offsetof(Contact, rolling_impulse));
        impulse.w += row_.number(CAIRN_FIELD(twist_total));
        if constexpr (Special) {
            const V rolling =
                row_.number(CAIRN_FIELD(roll_1)) * t1_ + row_.number(CAIRN_FIELD(roll_2)) * t2_;
            const V rolled = row_.number(CAIRN_FIELD(roll_total_1)) * t1_ +
                             row_.number(CAIRN_FIELD(roll_total_2)) * t2_;
            torque.x = inverse_h * rolling.x;
            torque.y = inverse_h * rolling.y;
            torque.z = inverse_h * rolling.z;
            impulse.x += rolled.x;
            impulse.y += rolled.y;
            impulse.z += rolled.z;
        }
        contacts_.write(offsetof(Contact, rolling_torque), torque);
        contacts_.write(offsetof(Contact, rolling_impulse), impulse);

        if (source_.ends_step) learn_load(contacts_, source_, inverse_h * load);
    }

private:
    // A point bears friction as it bears load. Returns the twist that is left for the whole.
    F store_points(F count, F load, F total) {
        const F inverse_h = F(source_.inverse_h);
        const V friction =
            row_.number(CAIRN_FIELD(friction_1)) * t1_ + row_.number(CAIRN_FIELD(friction_2)) * t2_;
        const V rubbed = row_.number(CAIRN_FIELD(friction_total_1)) * t1_ +
                         row_.number(CAIRN_FIELD(friction_total_2)) * t2_;
        const auto bears = load > F(least_load), bore = total > F(least_load);
        const F inverse_load = select(bears, F(1) / select(bears, load, F(1)), F(0));
        const F inverse_total = select(bore, F(1) / select(bore, total, F(1)), F(0));
        F twist = row_.number(CAIRN_FIELD(twist));
        for (int i = 0; i < P; ++i) {
            const auto is_there = count > F(float(i));
            const F normal = row_.number(CAIRN_FIELD(normal), i);
            const F passed = row_.number(CAIRN_FIELD(total), i);
            const V d = row_.number(CAIRN_FIELD(x), i) * t1_ + row_.number(CAIRN_FIELD(y), i) * t2_;
            const V part = (normal * inverse_load) * friction;
            twist -= select(is_there, dot(n_, cross(d, part)), F(0));

            FourLanes<W> state = read_point(i, offsetof(ContactPoint, separation));
            state.x = row_.number(CAIRN_FIELD(separation), i);
            state.z = inverse_h * normal;
            state.w += passed;
            write_point(i, offsetof(ContactPoint, separation), state);
            FourLanes<W> force = read_point(i, offsetof(ContactPoint, friction_force));
            force.x = inverse_h * part.x;
            force.y = inverse_h * part.y;
            force.z = inverse_h * part.z;
            write_point(i, offsetof(ContactPoint, friction_force), force);
            FourLanes<W> impulse = read_point(i, offsetof(ContactPoint, friction_impulse));
            const F share = passed * inverse_total;
            impulse.x += share * rubbed.x;
            impulse.y += share * rubbed.y;
            impulse.z += share * rubbed.z;
            write_point(i, offsetof(ContactPoint, friction_impulse), impulse);
        }
        return twist;
    }

    FourLanes<W> read_point(int i, std::size_t bytes) const {
        return contacts_.read(ContactLanes<W>::point(i, bytes));
    }
    void write_point(int i, std::size_t bytes, const FourLanes<W>& numbers) {
        contacts_.write(ContactLanes<W>::point(i, bytes), numbers);
    }

    const RowSource& source_;
    RowLanes<W> row_;
    ContactLanes<W> contacts_;
    V n_, t1_, t2_;
};

template <int P, bool Special, int W>
CAIRN_FLAT void store_rows(const RowRange& range, const RowSource& source) {
    for (std::size_t r = 0; r < range.count; ++r) {
        if (r + 1 < range.count) prefetch_contacts<W>(source, range.contacts + (r + 1) * W);
        RowStore<P, Special, W>(range, source, r).store();
    }
}

}  // namespace cairn
