#pragma once
// W numbers side by side, each of which goes through the same IEEE operations that a single float
// would: the width changes how many constraints are worked on at once, never a result.
//
// Built on the compilers' vector types, so that one source serves 1, 4, 8 and 16 lanes on every
// machine. Nothing here adds across lanes, and there is no fused product and no estimate. Each W
// is used by one source file alone, which may be compiled for more than the oldest processor.

#include <cstdint>
#include <utility>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

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

/// Whether it is so in any lane: never to decide what a lane's own result is.
template <int W>
inline bool any(typename LaneTypes<W>::Choice choice) {
#if defined(__AVX512F__)
    if constexpr (W == 16) return _mm512_test_epi32_mask(__m512i(choice), __m512i(choice)) != 0;
#endif
#if defined(__AVX__)
    if constexpr (W == 8) return _mm256_movemask_ps(__m256(choice)) != 0;
#endif
#if defined(__SSE2__)
    if constexpr (W == 4) return _mm_movemask_ps(__m128(choice)) != 0;
#endif
    std::int32_t found = 0;
    for (int lane = 0; lane < W; ++lane) found |= choice[lane];
    return found != 0;
}

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
    // Compilers take the loop at the end lane by lane; every machine rounds a root alike.
#if defined(__AVX512F__)
    if constexpr (W == 16) return Lanes<W>(_mm512_mask_sqrt_ps(a.v, 0xffff, a.v));
#endif
#if defined(__AVX__)
    if constexpr (W == 8) return Lanes<W>(_mm256_sqrt_ps(a.v));
#endif
#if defined(__SSE2__)
    if constexpr (W == 4) return Lanes<W>(_mm_sqrt_ps(a.v));
#endif
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

// One vector after the other.
template <int W, int... I>
inline typename LaneTypes<2 * W>::Float join(typename LaneTypes<W>::Float a,
                                             typename LaneTypes<W>::Float b,
                                             std::integer_sequence<int, I...>) {
    return __builtin_shufflevector(a, b, I...);
}

// Four numbers of every fourth record from `first` on.
template <int W, int Part = W>
inline typename LaneTypes<Part>::Float load_fours(const float* const (&from)[W], int first) {
    if constexpr (Part == 4) {
        return *reinterpret_cast<const typename LaneTypes<4>::Loose*>(from[first]);
    } else {
        return join<Part / 2>(load_fours<W, Part / 2>(from, first),
                              load_fours<W, Part / 2>(from, first + Part / 2),
                              std::make_integer_sequence<int, Part>{});
    }
}

// The other way.
template <int W, int... Quad>
inline void store_fours(typename LaneTypes<W>::Float v, float* const (&to)[W], int first,
                        std::integer_sequence<int, Quad...>) {
    ((*reinterpret_cast<typename LaneTypes<4>::Loose*>(to[first + 4 * Quad]) =
          __builtin_shufflevector(v, v, 4 * Quad, 4 * Quad + 1, 4 * Quad + 2, 4 * Quad + 3)),
     ...);
}

// Within every four numbers, in turn of a and b: their first two, or their last two, mixed.
template <int W, int... I>
inline void mix_singles(typename LaneTypes<W>::Float& a, typename LaneTypes<W>::Float& b,
                        std::integer_sequence<int, I...>) {
    const auto low = __builtin_shufflevector(a, b, (I / 4 * 4 + I % 4 / 2 + I % 2 * W)...);
    b = __builtin_shufflevector(a, b, (I / 4 * 4 + 2 + I % 4 / 2 + I % 2 * W)...);
    a = low;
}
template <int W, int... I>
inline void mix_couples(typename LaneTypes<W>::Float& a, typename LaneTypes<W>::Float& b,
                        std::integer_sequence<int, I...>) {
    const auto low = __builtin_shufflevector(a, b, (I / 4 * 4 + I % 2 + I % 4 / 2 * W)...);
    b = __builtin_shufflevector(a, b, (I / 4 * 4 + 2 + I % 2 + I % 4 / 2 * W)...);
    a = low;
}

// Rows of every 4x4 block become its columns.
template <int W>
inline void turn_fours(typename LaneTypes<W>::Float& a, typename LaneTypes<W>::Float& b,
                       typename LaneTypes<W>::Float& c, typename LaneTypes<W>::Float& d) {
    constexpr std::make_integer_sequence<int, W> all;
    mix_singles<W>(a, b, all);  // a0 b0 a1 b1, a2 b2 a3 b3
    mix_singles<W>(c, d, all);
    mix_couples<W>(a, c, all);  // a0 b0 c0 d0, a1 b1 c1 d1
    mix_couples<W>(b, d, all);
    const auto second = c;
    c = b;
    b = second;
}

template <int W>
inline FourLanes<W> gather_four(const float* const (&from)[W]) {
    FourLanes<W> out;
    if constexpr (W % 4 == 0) {
        out.x.v = load_fours<W>(from, 0);
        out.y.v = load_fours<W>(from, 1);
        out.z.v = load_fours<W>(from, 2);
        out.w.v = load_fours<W>(from, 3);
        turn_fours<W>(out.x.v, out.y.v, out.z.v, out.w.v);
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
inline void scatter_four(FourLanes<W> in, float* const (&to)[W]) {
    if constexpr (W % 4 == 0) {
        turn_fours<W>(in.x.v, in.y.v, in.z.v, in.w.v);
        constexpr std::make_integer_sequence<int, W / 4> quads;
        store_fours<W>(in.x.v, to, 0, quads);
        store_fours<W>(in.y.v, to, 1, quads);
        store_fours<W>(in.z.v, to, 2, quads);
        store_fours<W>(in.w.v, to, 3, quads);
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
