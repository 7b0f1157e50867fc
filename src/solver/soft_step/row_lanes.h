#pragma once
// One row in lanes: numbers by their place in the record. Included by soft_passes.h alone.

#include <cstddef>

#include "math/lanes.h"
#include "solver/soft_step/soft_row.h"

namespace cairn {

template <int W>
class RowLanes {
public:
    using F = Lanes<W>;
    using V = Vec3Lanes<W>;
    explicit RowLanes(float* row) : row_(row) {}

    F number(std::size_t bytes, int i = 0) const { return F::load(at(bytes, i)); }
    void set(std::size_t bytes, F x, int i = 0) { x.store(at(bytes, i)); }
    void set(std::size_t bytes, const V& v) {
        set(bytes, v.x, 0);
        set(bytes, v.y, 1);
        set(bytes, v.z, 2);
    }
    V vector(std::size_t bytes) const {
        return {number(bytes), number(bytes, 1), number(bytes, 2)};
    }
    SymmetricLanes<W> tensor(std::size_t bytes) const {
        return {number(bytes),    number(bytes, 1), number(bytes, 2),
                number(bytes, 3), number(bytes, 4), number(bytes, 5)};
    }

private:
    float* at(std::size_t bytes, int i) const { return row_ + (bytes / 4 + std::size_t(i)) * W; }
    float* row_;
};

// A pass calls nothing: what it calls lies within it, so that lanes stay in registers.
#define CAIRN_FLAT [[gnu::flatten]]

// For classes that name their record Row; soft_passes.h ends it.
#define CAIRN_FIELD(name) offsetof(Row, name)

}  // namespace cairn
