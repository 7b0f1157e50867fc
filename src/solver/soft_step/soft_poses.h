#pragma once
// Bodies on their way for one part of a substep, W of them side by side: x += h v, and the turn by
// the rotation vector h w,
//
//     q <- exp(h w) q,   exp(t) = (sin(|t|/2) t/|t|, cos(|t|/2))
//
// by series of the half angle up to one radian, and of a 64th of the angle, squared six times,
// beyond. Included by soft_passes.h alone.

#include <cstddef>

#include "math/lanes.h"
#include "solver/soft_step/soft_row.h"

namespace cairn {

template <int W>
struct QuatLanes {
    kernel::Vec3Lanes<W> v;
    kernel::Lanes<W> s;

    friend QuatLanes operator*(const QuatLanes& a, const QuatLanes& b) {
        return {a.s * b.v + b.s * a.v + cross(a.v, b.v), a.s * b.s - dot(a.v, b.v)};
    }
};

// Of t with |t| <= 1; the terms left out are below 1e-9.
template <int W>
inline QuatLanes<W> exponential_of_small(const Vec3Lanes<W>& t) {
    using F = Lanes<W>;
    const F u = F(0.25f) * dot(t, t);
    const F sine = F(1) - u * (F(1.0f / 6) - u * (F(1.0f / 120) - u * F(1.0f / 5040)));
    const F cosine = F(1) - u * (F(0.5f) - u * (F(1.0f / 24) - u * (F(1.0f / 720))));
    return {(F(0.5f) * sine) * t, cosine};
}

template <int W>
inline QuatLanes<W> exponential(const Vec3Lanes<W>& t) {
    using F = Lanes<W>;
    // Beyond ten turns a part nothing can be traced: more are as good as ten.
    constexpr float farthest = 64;
    const QuatLanes<W> direct = exponential_of_small<W>(t);
    const F squared = dot(t, t);
    const auto is_large = squared > F(1);
    if (!any<W>(is_large)) return direct;
    const F length = square_root(max(squared, F(1e-36f)));
    const F shrink = select(length > F(farthest), F(1) / length, F(1 / farthest));
    QuatLanes<W> q = exponential_of_small<W>(shrink * t);
    for (int k = 0; k < 6; ++k) q = q * q;
    return {{select(is_large, q.v.x, direct.v.x), select(is_large, q.v.y, direct.v.y),
             select(is_large, q.v.z, direct.v.z)},
            select(is_large, q.s, direct.s)};
}

// `places` holds count bodies, a multiple of W.
template <int W>
CAIRN_FLAT void move_bodies(SoftBody* bodies, const std::uint32_t* places, std::size_t count,
                            float h) {
    using F = Lanes<W>;
    for (std::size_t i = 0; i < count; i += W) {
        float* numbers[W];
        const float* from[W];
        for (int lane = 0; lane < W; ++lane) {
            numbers[lane] = &bodies[places[i + std::size_t(lane)]].v.x;
            from[lane] = numbers[lane];
        }
        const FourLanes<W> v = gather_four<W>(from);
        for (int lane = 0; lane < W; ++lane) from[lane] += 4;
        const FourLanes<W> w = gather_four<W>(from);
        for (int lane = 0; lane < W; ++lane) from[lane] += 4;
        FourLanes<W> x = gather_four<W>(from);
        for (int lane = 0; lane < W; ++lane) from[lane] += 4;
        const FourLanes<W> q = gather_four<W>(from);
        x.x += F(h) * v.x;
        x.y += F(h) * v.y;
        x.z += F(h) * v.z;
        const QuatLanes<W> turned =
            exponential<W>(F(h) * Vec3Lanes<W>{w.x, w.y, w.z}) * QuatLanes<W>{{q.x, q.y, q.z}, q.w};
        // Newton's step to unit length: |q| is 1 but for rounding.
        const F squared = dot(turned.v, turned.v) + turned.s * turned.s;
        const F scale = F(1.5f) - F(0.5f) * squared;
        for (int lane = 0; lane < W; ++lane) numbers[lane] += 8;
        scatter_four<W>(x, numbers);
        for (int lane = 0; lane < W; ++lane) numbers[lane] += 4;
        scatter_four<W>(
            {scale * turned.v.x, scale * turned.v.y, scale * turned.v.z, scale * turned.s},
            numbers);
    }
}

}  // namespace cairn
