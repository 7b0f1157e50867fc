// Ordering rows and running loops over them; see row_sweeps.h.

#include "solver/row_sweeps.h"

#include <algorithm>

namespace cairn {

void RowSweeps::order_rows(const StepProblem& problem, RowOrder order) {
    const std::size_t count = problem.active.size();
    edges_.resize(count);
    problem.for_range(count, 64, [&](int begin, int end) {
        for (auto k = std::size_t(begin); k < std::size_t(end); ++k) {
            const Contact& contact = problem.contacts[problem.active[k]];
            edges_[k] = {contact.body_a, contact.body_b,
                         problem.inertias[contact.body_a].inverse_mass > 0,
                         problem.inertias[contact.body_b].inverse_mass > 0};
        }
    });
    if (order == RowOrder::Waves)
        find_waves(problem);
    else
        colouring_.colour(edges_, problem.motions.size(), groups_);
    contacts_.resize(count);
    for (std::size_t k = 0; k < count; ++k) contacts_[k] = problem.active[groups_.order[k]];
    parts_.clear();
    for (std::size_t g = 0; g < groups_.count(); ++g) {
        add_part(groups_.begins[g], groups_.begins[g + 1]);
    }
}

void RowSweeps::find_waves(const StepProblem& problem) {
    next_wave_.assign(problem.motions.size(), 0);
    waves_.resize(edges_.size());
    std::vector<std::uint32_t>& begins = groups_.begins;
    begins.assign(2, 0);
    for (std::size_t k = 0; k < edges_.size(); ++k) {
        const Colouring::Edge& edge = edges_[k];
        const std::uint32_t wave = std::max(edge.pushes_a ? next_wave_[edge.body_a] : 0,
                                            edge.pushes_b ? next_wave_[edge.body_b] : 0);
        waves_[k] = wave;
        if (edge.pushes_a) next_wave_[edge.body_a] = wave + 1;
        if (edge.pushes_b) next_wave_[edge.body_b] = wave + 1;
        if (wave + 2 >= begins.size()) begins.push_back(0);
        ++begins[wave + 2];
    }
    // A counting sort: begins[w + 1] goes on from where wave w begins to where it ends.
    for (std::size_t w = 2; w < begins.size(); ++w) begins[w] += begins[w - 1];
    groups_.order.resize(edges_.size());
    for (std::size_t k = 0; k < edges_.size(); ++k) {
        groups_.order[begins[waves_[k] + 1]++] = std::uint32_t(k);
    }
    begins.pop_back();
}

void RowSweeps::add_part(std::size_t begin, std::size_t end) {
    const bool is_small = end - begin < least_shared_rows;
    if (is_small && !parts_.empty() && parts_.back().in_one_block) {
        parts_.back().end = end;
        return;
    }
    parts_.push_back({begin, end, is_small});
}

void RowSweeps::run(const StepProblem& problem) {
    stages_.clear();
    for (Job& job : jobs_) {
        if (job.count > 0) stages_.push_back(TeamStage(job.count, job.block_size, job));
    }
    if (problem.team) {
        problem.team->run_stages(stages_);
    } else {
        for (const TeamStage& stage : stages_) stage.kernel(0, stage.count, 0);
    }
    stages_.clear();
    jobs_.clear();
}

}  // namespace cairn
