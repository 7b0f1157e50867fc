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
    // A contact's angular frequency over the rate of its sweeps: the stiffest spring that one sweep
    // a part of a substep holds without ringing.
    static constexpr float angular_frequency_share = 0.78539816f;  // 2 pi / 8

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

    // What is asked of every contact before its row is filled, by place in problem.active.
    struct Link {
        RowKind kind = RowKind::OnePoint;
        std::uint8_t point_count = 0;
        bool bounces = false;
        bool touching = false;  // before the step
        bool turns_with_a = false, turns_with_b = false;
        float remembered_load = 0;  // what the contact has long borne, N
        float heavier = 0;          // the mass of the heavier body that can be pushed, kg
        float upright = 0;          // the cosine between its normal and gravity, either way
    };
    void begin_reading(const StepProblem& problem);
    void read(const StepProblem& problem, const Contact& contact, std::size_t k);
    std::span<const Link> links() const { return links_; }
    std::span<const Colouring::Edge> edges() const { return edges_; }

    // Of the contacts as read.
    void build(const StepProblem& problem, std::span<const Response> responses, float h, float part,
               const SoftKernels& kernels);
    // What the rows hold into the contacts, their separations too: rows built from them go on as
    // these would have. Once a step, at its end, contacts learn what they bear.
    void store(const StepProblem& problem, float h, bool ends_step, const SoftKernels& kernels);

    std::span<const Batch> batches() const { return batches_; }
    // Some rows of a batch, counted from its first.
    RowRange range(const Batch& batch, int begin, int end);
    // Rows of a batch are shared out in blocks of so many, about a microsecond's work.
    static int rows_a_block(int width) { return width < 64 ? 64 / width : 1; }
    // Places after the bodies: one that stands still, and one that may be written for each block
    // of the largest batch.
    std::size_t spare_bodies() const { return spare_bodies_; }
    RowArray& array(RowKind kind) { return arrays_[std::size_t(kind)]; }
    // By place in problem.active.
    std::span<const Place> places() const { return places_; }

private:
    bool keeps_bodies_apart(std::size_t body_count) const;
    void give_places(const StepProblem& problem, int width);
    Place take_lane(RowKind kind, std::size_t colour_begin, std::uint32_t nobody);
    RowSource make_source(const StepProblem& problem, float h, float part) const;
    // Rows from their contacts, or what they came to into these.
    void exchange(const StepProblem& problem,
                  const SoftKernels::Exchange (&kernels)[row_kind_count], const RowSource& source);

    Vec3 up_;  // against gravity
    std::vector<Link> links_;
    std::vector<Colouring::Edge> edges_;
    Colouring colouring_;
    Colours colours_;
    std::array<RowArray, row_kind_count> arrays_;
    std::array<std::uint32_t, row_kind_count> free_lanes_ = {};
    std::vector<Batch> batches_;
    std::size_t spare_bodies_ = 2;
    std::vector<Place> places_;
    LargeArray<SoftHeft> hefts_;  // by body
};

}  // namespace cairn
