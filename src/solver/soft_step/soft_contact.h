#pragma once
// Contacts by their numbers, W of them side by side. Included by soft_passes.h alone.

#include <cstddef>

#include "contact/contact.h"
#include "math/lanes.h"
#include "solver/soft_step/soft_kernels.h"

namespace cairn {

// A load of less, N s or N, bears nothing: the inverse of a smaller one may be infinite.
constexpr float least_load = 1e-30f;
// Surfaces without friction count as having this little, so that what holds only a twist has a
// lever.
constexpr float least_friction = 1e-6f;

// The contacts of one row; a lane without one reads and writes room of its own.
template <int W>
class ContactLanes {
public:
    ContactLanes(const RowSource& source, const std::uint32_t* contacts) {
        for (int lane = 0; lane < W; ++lane) {
            const std::uint32_t k = contacts[lane];
            contacts_[lane] =
                k == RowArray::idle ? nothing_ : source.contacts + std::size_t(k) * stride;
        }
    }
    ContactLanes(const ContactLanes&) = delete;
    ContactLanes& operator=(const ContactLanes&) = delete;

    // How many points each has; a point's place is below that.
    Lanes<W> count() const {
        Lanes<W> count;
        for (int lane = 0; lane < W; ++lane) {
            int n = 0;
            __builtin_memcpy(&n, contacts_[lane] + offsetof(Contact, point_count) / 4, sizeof n);
            count.v[lane] = float(n);
        }
        return count;
    }
    // The four numbers that begin there.
    FourLanes<W> read(std::size_t bytes) const {
        const float* from[W];
        for (int lane = 0; lane < W; ++lane) from[lane] = contacts_[lane] + bytes / 4;
        return gather_four<W>(from);
    }
    void write(std::size_t bytes, const FourLanes<W>& numbers) {
        float* to[W];
        for (int lane = 0; lane < W; ++lane) to[lane] = contacts_[lane] + bytes / 4;
        scatter_four<W>(numbers, to);
    }
    static constexpr std::size_t point(int i, std::size_t bytes) {
        return offsetof(Contact, points) + std::size_t(i) * sizeof(ContactPoint) + bytes;
    }

private:
    static constexpr std::size_t stride = sizeof(Contact) / 4;
    alignas(16) float nothing_[stride] = {};
    float* contacts_[W];
};

// Contacts lie far apart in memory: a row's are asked for while the one before it is worked on.
template <int W>
[[gnu::always_inline]] inline void prefetch_contacts(const RowSource& source,
                                                     const std::uint32_t* contacts) {
    for (int lane = 0; lane < W; ++lane) {
        const std::uint32_t k = contacts[lane];
        if (k == RowArray::idle) continue;
        const auto* bytes =
            reinterpret_cast<const char*>(source.contacts) + std::size_t(k) * sizeof(Contact);
        for (std::size_t i = 0; i < sizeof(Contact); i += 64) __builtin_prefetch(bytes + i);
    }
}

template <int W>
inline Vec3Lanes<W> first_three(const FourLanes<W>& four) {
    return {four.x, four.y, four.z};
}

// A unit vector across n.
template <int W>
inline Vec3Lanes<W> any_perpendicular(const Vec3Lanes<W>& n) {
    using F = Lanes<W>;
    const auto along_x = max(n.x, -n.x) > F(0.57735f);
    const Vec3Lanes<W> p = {select(along_x, n.y, F(0)), select(along_x, -n.x, n.z),
                            select(along_x, F(0), -n.y)};
    return (F(1) / square_root(max(dot(p, p), F(1e-30f)))) * p;
}

// 1 / x; 0 where x is not above 0.
template <int W>
inline Lanes<W> inverse_or_nothing(Lanes<W> x) {
    using F = Lanes<W>;
    const auto above = x > F(0);
    return select(above, F(1) / select(above, x, F(1)), F(0));
}

// What a contact bears it learns slowly and forgets at once.
template <int W>
inline void learn_load(ContactLanes<W>& contacts, const RowSource& source, Lanes<W> force) {
    FourLanes<W> normal = contacts.read(offsetof(Contact, normal));
    normal.w = min(normal.w + Lanes<W>(source.learning_share) * (force - normal.w), force);
    contacts.write(offsetof(Contact, normal), normal);
}

}  // namespace cairn
