#pragma once
// One answer a kind of shape: visit_shape(geometry, sphere_case, box_case, plane_case,
// capsule_case).
//
// The cases may stand in any order; a kind that is missing does not compile. Unlike std::visit it
// cannot throw, so it works where exceptions are off.

#include <cstddef>
#include <variant>

#include "cairn/shape.h"

namespace cairn {

// The kinds of shapes, in the order of Geometry's alternatives.
enum class ShapeKind : unsigned char { Sphere, Box, Plane, Capsule };
inline constexpr std::size_t shape_kind_count = std::variant_size_v<Geometry>;

inline ShapeKind kind_of(const Geometry& geometry) { return ShapeKind(geometry.index()); }

template <class... Cases>
struct ShapeCases : Cases... {
    using Cases::operator()...;
};
template <class... Cases>
ShapeCases(Cases...) -> ShapeCases<Cases...>;

template <class... Cases>
auto visit_shape(const Geometry& geometry, Cases... cases) {
    const ShapeCases all{cases...};
    switch (kind_of(geometry)) {
        case ShapeKind::Sphere: return all(*std::get_if<Sphere>(&geometry));
        case ShapeKind::Box: return all(*std::get_if<Box>(&geometry));
        case ShapeKind::Plane: return all(*std::get_if<Plane>(&geometry));
        case ShapeKind::Capsule: break;
    }
    return all(*std::get_if<Capsule>(&geometry));
}

static_assert(
    std::is_same_v<std::variant_alternative_t<std::size_t(ShapeKind::Sphere), Geometry>, Sphere>);
static_assert(
    std::is_same_v<std::variant_alternative_t<std::size_t(ShapeKind::Box), Geometry>, Box>);
static_assert(
    std::is_same_v<std::variant_alternative_t<std::size_t(ShapeKind::Plane), Geometry>, Plane>);
static_assert(
    std::is_same_v<std::variant_alternative_t<std::size_t(ShapeKind::Capsule), Geometry>, Capsule>);
static_assert(shape_kind_count == 4, "a new kind of shape needs its case above");

}  // namespace cairn
