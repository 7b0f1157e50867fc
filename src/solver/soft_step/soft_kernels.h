#pragma once
// The passes over contact rows, compiled for several widths, and the choice among them.

#include <cstdint>

#include "solver/soft_step/soft_row.h"

namespace cairn {

// A stretch of rows of one kind that share no body that can be pushed.
struct RowRange {
    float* rows = nullptr;
    const std::uint32_t* read_a = nullptr;
    const std::uint32_t* read_b = nullptr;
    const std::uint32_t* write_a = nullptr;
    const std::uint32_t* write_b = nullptr;
    const std::uint32_t* contacts = nullptr;  // by lane, places in StepProblem::contacts
    std::size_t count = 0;
};

struct SoftPass {
    float inverse_h = 0;
    bool first = false;  // the first relaxation of a substep's rows adds to the totals
};

// A contact's spring as factors of a rigid row: implicit Euler of angular frequency and damping.
struct Softness {
    float bias_rate = 0, mass_scale = 0, impulse_scale = 0;
};

// Where rows are filled from and emptied to. Contacts as their numbers: only pointers cross into
// the files that are compiled for wider processors.
struct RowSource {
    float* contacts = nullptr;
    const SoftHeft* hefts = nullptr;  // by body
    float h = 0, inverse_h = 0;       // of a substep
    Softness between, ground;         // two bodies; a body and what cannot be pushed
    // An overlap is pushed out at sqrt(speed_squared_a_size size), but at speed_a_size size at
    // least.
    float speed_squared_a_size = 0, speed_a_size = 0;
    float slop_a_size = 0;
    bool ends_step = false;  // contacts learn what they bear, this share of the difference
    float learning_share = 0;
};

struct SoftKernels {
    using Kernel = void (*)(const RowRange& range, SoftBody* bodies, const SoftPass& pass);
    int width = 0;
    // By kind of row. What each does stands in soft_passes.h.
    Kernel warm_start[row_kind_count];
    Kernel solve[row_kind_count];
    Kernel measure[row_kind_count];
    Kernel relax[row_kind_count];
    // soft_fill.h, soft_store.h
    using Exchange = void (*)(const RowRange& range, const RowSource& source);
    Exchange fill[row_kind_count];
    Exchange store[row_kind_count];
    // soft_poses.h; the number of bodies is a multiple of the width.
    void (*move_bodies)(SoftBody* bodies, const std::uint32_t* places, std::size_t count, float h);
};

// The widest kernels of 1, 4, 8 or 16 lanes that this machine runs and that are no wider than
// `most`; 0 sets no limit.
const SoftKernels& find_soft_kernels(int most);

}  // namespace cairn
