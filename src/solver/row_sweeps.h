#pragma once
// In which order a method sweeps its rows, and the loops of a substep as stages that a team shares.
//
// Rows are put in groups of which no two rows push the same body, so the threads take what they
// like of a group, and the result is that of one thread going from the first row to the last. The
// groups are either
// - colours: few and large, but neighbours are swept in no order that means anything; or
// - waves: a row comes in the first group after those of the rows before it, in the order of the
//   problem, that push one of its bodies. A sweep over the waves gives to the bit what one in the
//   problem's order gives, backward too, for a method that passes loads on from row to row.
//
// Small groups that follow each other are one block, which one thread does in their order: a
// thread called for less is called in vain.
//
//     sweeps.order_rows(problem, RowOrder::Waves);       // once a step
//     prepare_rows(problem, sweeps.contacts(), rows_);   // rows in the order of their sweeps
//     sweeps.add_bodies(predict);                        // each visit(i) must outlive the run
//     sweeps.add_sweep(solve, backward);
//     sweeps.run(problem);                               // one after the other
//
// docs/decisions/0014-orders-of-sweeps.md has what the orders cost and what they hold.

#include <cstdint>
#include <span>
#include <vector>

#include "constraint/step_problem.h"
#include "island/colouring.h"

namespace cairn {

enum class RowOrder : std::uint8_t { Colours, Waves };

class RowSweeps {
public:
    void order_rows(const StepProblem& problem, RowOrder order);
    // Places in StepProblem::contacts: row k is of contacts()[k].
    std::span<const std::uint32_t> contacts() const { return contacts_; }

    // visit(k) for every row: forward, or backward from the last group to the first.
    template <class Visit>
    void add_sweep(Visit& visit, bool backward = false) {
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            const Part& part = parts_[backward ? parts_.size() - 1 - i : i];
            const std::size_t count = part.end - part.begin;
            jobs_.push_back({&visit_each<Visit>, &visit, part.begin, backward, int(count),
                             part.in_one_block ? int(count) : rows_a_block});
        }
    }
    // visit(k) for every row, where one row's visit does not touch what another's reads.
    template <class Visit>
    void add_rows(Visit& visit) {
        add_loop(contacts_.size(), free_rows_a_block, visit);
    }
    // visit(i) for i in [0, count): bodies, or places in a list of bodies.
    template <class Visit>
    void add_bodies(std::size_t count, Visit& visit) {
        add_loop(count, bodies_a_block, visit);
    }
    // visit(0), by one thread.
    template <class Visit>
    void add_alone(Visit& visit) {
        add_loop(1, 1, visit);
    }
    // Does what was added, in order.
    void run(const StepProblem& problem);

private:
    // Each about a microsecond's work or two.
    static constexpr int rows_a_block = 16;
    // Smaller groups are not shared: all threads meet after each.
    static constexpr std::size_t least_shared_rows = 32;
    static constexpr int free_rows_a_block = 32;
    static constexpr int bodies_a_block = 64;

    // Rows that are a stage of a sweep.
    struct Part {
        std::size_t begin = 0, end = 0;
        bool in_one_block = false;
    };
    struct Job {
        void (*visit_range)(void* visit, std::size_t begin, std::size_t end, bool backward);
        void* visit;
        std::size_t first;
        bool backward;
        int count, block_size;
        void operator()(int begin, int end, int) const {
            visit_range(visit, first + std::size_t(begin), first + std::size_t(end), backward);
        }
    };

    template <class Visit>
    static void visit_each(void* visit, std::size_t begin, std::size_t end, bool backward) {
        Visit& visit_one = *static_cast<Visit*>(visit);
        if (backward) {
            while (end-- > begin) visit_one(end);
        } else {
            for (; begin < end; ++begin) visit_one(begin);
        }
    }
    template <class Visit>
    void add_loop(std::size_t count, int block_size, Visit& visit) {
        jobs_.push_back({&visit_each<Visit>, &visit, 0, false, int(count), block_size});
    }

    void find_waves(const StepProblem& problem);
    void add_part(std::size_t begin, std::size_t end);

    std::vector<std::uint32_t> contacts_;
    std::vector<Part> parts_;
    std::vector<Job> jobs_;
    std::vector<TeamStage> stages_;

    // Room of order_rows().
    std::vector<Colouring::Edge> edges_;
    Colouring colouring_;
    Colours groups_;
    std::vector<std::uint32_t> next_wave_;  // by body
    std::vector<std::uint32_t> waves_;      // by row
};

}  // namespace cairn
