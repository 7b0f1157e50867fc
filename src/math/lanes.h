#pragma once
// W numbers side by side, each of which goes through the same IEEE operations that a single float
// would: the width changes how many constraints are worked on at once, never a result.
//
// Built on the compilers' vector types, so that one source serves 1, 4, 8 and 16 lanes on every
// machine. Nothing here adds across lanes, and there is no fused product and no estimate. Each W
// is used by one source file alone, which may be compiled for more than the oldest processor.

#include <cstdint>

#include "cairn/types.h"

namespace cairn {
inline namespace kernel {

// The compilers' types, apart: gcc 12 takes a vector whose size depends on the parameter for a
// scalar inside the class that declares it.
template <int W>
struct LaneTypes {
    typedef float Float __attribute__((vector_size(4 * W)));
    typedef float Loose __attribute__((vector_size(4 * W), aligned(4), may_alias));
    typedef std::int32_t Choice __attribute__((vector_size(4 * W)));
};

template <int W>
struct Lanes {
    using Vector = typename LaneTypes<W>::Float;
    using Loose = typename LaneTypes<W>::Loose;
    using Choice = typename LaneTypes<W>::Choice;

    Vector v;

    Lanes() : v{} {}
    explicit Lanes(Vector x) : v(x) {}
    Lanes(float x) : v(Vector{} + x) {}  // a number stands for all lanes of it
    static Lanes load(const float* from) {
        return Lanes(Vector(*reinterpret_cast<const Loose*>(from)));
    }
    void store(float* to) const { *reinterpret_cast<Loose*>(to) = v; }

    friend Lanes operator+(Lanes a, Lanes b) { return Lanes(a.v + b.v); }
    friend Lanes operator-(Lanes a, Lanes b) { return Lanes(a.v - b.v); }
    friend Lanes operator*(Lanes a, Lanes b) { return Lanes(a.v * b.v); }
    friend Lanes operator/(Lanes a, Lanes b) { return Lanes(a.v / b.v); }
    friend Lanes operator-(Lanes a) { return Lanes(-a.v); }
    Lanes& operator+=(Lanes b) { return *this = *this + b; }
    Lanes& operator-=(Lanes b) { return *this = *this - b; }
    friend Choice operator>(Lanes a, Lanes b) { return a.v > b.v; }
};

/// a where the choice is so, b elsewhere.
template <int W>
inline Lanes<W> select(typename Lanes<W>::Choice choice, Lanes<W> a, Lanes<W> b) {
    return Lanes<W>(choice ? a.v : b.v);
}
template <int W>
inline Lanes<W> min(Lanes<W> a, Lanes<W> b) {
    return Lanes<W>(b.v < a.v ? b.v : a.v);
}
template <int W>
inline Lanes<W> max(Lanes<W> a, Lanes<W> b) {
    return Lanes<W>(a.v < b.v ? b.v : a.v);
}
template <int W>
inline Lanes<W> square_root(Lanes<W> a) {
    Lanes<W> root;
    for (int lane = 0; lane < W; ++lane) root.v[lane] = __builtin_sqrtf(a.v[lane]);
    return root;
}

template <int W>
struct Vec3Lanes {
    Lanes<W> x, y, z;

    friend Vec3Lanes operator+(const Vec3Lanes& a, const Vec3Lanes& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend Vec3Lanes operator-(const Vec3Lanes& a, const Vec3Lanes& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend Vec3Lanes operator*(Lanes<W> s, const Vec3Lanes& v) {
        return {s * v.x, s * v.y, s * v.z};
    }
};

template <int W>
inline Lanes<W> dot(const Vec3Lanes<W>& a, const Vec3Lanes<W>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <int W>
inline Vec3Lanes<W> cross(const Vec3Lanes<W>& a, const Vec3Lanes<W>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <int W>
inline Vec3Lanes<W> multiply(const Vec3Lanes<W>& a, const Vec3Lanes<W>& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}

template <int W>
struct SymmetricLanes {
    Lanes<W> xx, yy, zz, xy, xz, yz;

    friend Vec3Lanes<W> operator*(const SymmetricLanes& m, const Vec3Lanes<W>& v) {
        return {m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
                m.xz * v.x + m.yz * v.y + m.zz * v.z};
    }
};

// Four numbers of each of W records, as four lanes: from[lane] points at them.
template <int W>
struct FourLanes {
    Lanes<W> x, y, z, w;
};

// Rows of a 4x4 block become its columns. (By W too, so that each width's file has its own.)
template <int W, class Four>
inline void turn_four(Four& a, Four& b, Four& c, Four& d) {
    const Four t0 = __builtin_shufflevector(a, b, 0, 4, 1, 5);
    const Four t1 = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    const Four t2 = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Four t3 = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    a = __builtin_shufflevector(t0, t1, 0, 1, 4, 5);
    b = __builtin_shufflevector(t0, t1, 2, 3, 6, 7);
    c = __builtin_shufflevector(t2, t3, 0, 1, 4, 5);
    d = __builtin_shufflevector(t2, t3, 2, 3, 6, 7);
}

template <int W>
inline FourLanes<W> gather_four(const float* const (&from)[W]) {
    FourLanes<W> out;
    if constexpr (W % 4 == 0) {
        using Four = typename Lanes<4>::Vector;
        using Loose = typename Lanes<4>::Loose;
        for (int base = 0; base < W; base += 4) {
            Four a = *reinterpret_cast<const Loose*>(from[base]);
            Four b = *reinterpret_cast<const Loose*>(from[base + 1]);
            Four c = *reinterpret_cast<const Loose*>(from[base + 2]);
            Four d = *reinterpret_cast<const Loose*>(from[base + 3]);
            turn_four<W>(a, b, c, d);
            for (int k = 0; k < 4; ++k) {
                out.x.v[base + k] = a[k];
                out.y.v[base + k] = b[k];
                out.z.v[base + k] = c[k];
                out.w.v[base + k] = d[k];
            }
        }
    } else {
        for (int lane = 0; lane < W; ++lane) {
            out.x.v[lane] = from[lane][0];
            out.y.v[lane] = from[lane][1];
            out.z.v[lane] = from[lane][2];
            out.w.v[lane] = from[lane][3];
        }
    }
    return out;
}

template <int W>
inline void scatter_four(const FourLanes<W>& in, float* const (&to)[W]) {
    if constexpr (W % 4 == 0) {
        using Four = typename Lanes<4>::Vector;
        using Loose = typename Lanes<4>::Loose;
        for (int base = 0; base < W; base += 4) {
            Four a, b, c, d;
            for (int k = 0; k < 4; ++k) {
                a[k] = in.x.v[base + k];
                b[k] = in.y.v[base + k];
                c[k] = in.z.v[base + k];
                d[k] = in.w.v[base + k];
            }
            turn_four<W>(a, b, c, d);
            *reinterpret_cast<Loose*>(to[base]) = a;
            *reinterpret_cast<Loose*>(to[base + 1]) = b;
            *reinterpret_cast<Loose*>(to[base + 2]) = c;
            *reinterpret_cast<Loose*>(to[base + 3]) = d;
        }
    } else {
        for (int lane = 0; lane < W; ++lane) {
            to[lane][0] = in.x.v[lane];
            to[lane][1] = in.y.v[lane];
            to[lane][2] = in.z.v[lane];
            to[lane][3] = in.w.v[lane];
        }
    }
}

}  // namespace kernel
}  // namespace cairn
