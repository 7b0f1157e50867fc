#pragma once
// From contacts to the rows of the soft step, and from the rows back to contacts.

#include <array>
#include <vector>

#include "constraint/step_problem.h"
#include "island/colouring.h"
#include "solver/soft_step/soft_kernels.h"

namespace cairn {

// A step's rows, colour by colour.
class SoftRows {
public:
    // The rows of one kind that share a colour.
    struct Batch {
        RowKind kind = RowKind::OnePoint;
        std::size_t begin = 0, end = 0;
    };
    // Where the rows of a contact lie.
    struct Place {
        RowKind kind = RowKind::OnePoint;
        std::uint32_t row = 0, lane = 0;
    };

    void build(const StepProblem& problem, std::span<const Response> responses, float h, float part,
               int width);
    // What the rows hold into the contacts, their separations too: rows built from them go on as
    // these would have.
    void store(const StepProblem& problem, float h) const;
    // Once a step: contacts learn what they bear.
    void remember_loads(const StepProblem& problem) const;

    std::span<const Batch> batches() const { return batches_; }
    RowRange range(const Batch& batch);
    RowArray& array(RowKind kind) { return arrays_[std::size_t(kind)]; }
    // By place in problem.active.
    std::span<const Place> places() const { return places_; }

private:
    void colour(const StepProblem& problem);
    Place take_lane(RowKind kind, std::size_t colour_begin, std::uint32_t nobody);

    std::vector<Colouring::Edge> edges_;
    Colouring colouring_;
    Colours colours_;
    std::array<RowArray, row_kind_count> arrays_;
    std::array<std::uint32_t, row_kind_count> free_lanes_ = {};
    std::vector<Batch> batches_;
    std::vector<Place> places_;
};

}  // namespace cairn
