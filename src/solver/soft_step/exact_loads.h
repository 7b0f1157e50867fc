#pragma once
// The loads of a small island, solved exactly.
//
// Sweeps pass a load on by one contact a sweep, so a tall column, or a heavy body on a light one,
// would need hundreds of them: what a few sweeps leave is a tilt that grows. For an island whose
// loads pass through many contacts but whose matrix is narrow, the normal impulses l of all points
// are found at once, by Cholesky's method over the points that touch:
//
//     K l = -u,  l >= 0,    K = J M^-1 J^T + e diag(J M^-1 J^T)
//
// u is the closing speed under the forces alone. A point whose load comes out negative is taken
// out, one that would close is taken in, and K solved again. The small e shares a load evenly over
// points that hold the same thing.
//
// The rows of K stand in the order in which a search from the ground reaches the contacts, so a
// column of n boxes costs as much as n boxes.

#include <vector>

#include "solver/contact_rows.h"
#include "solver/soft_step/build_rows.h"

namespace cairn {

class ExactLoads {
public:
    // Once a step: looks for the islands that may call for it, by what the rows know of contacts.
    void find_candidates(const StepProblem& problem, const SoftRows& rows);
    // Whether a body that can be pushed is of one of those.
    bool is_candidate(std::uint32_t body) {
        return any_candidate_ && is_candidate(sketches_[find_root(body)]);
    }
    // Finds those that call for it, and their matrices, from filled rows.
    void prepare(const StepProblem& problem, std::span<const Response> responses, SoftRows& rows);
    // Brings the normal impulses of those islands to where every point moves as its overlap or
    // its gap asks for, and the bodies with them.
    void solve(float h, bool pushes, std::span<const Response> responses,
               std::span<SoftBody> bodies, SoftRows& rows);
    bool empty() const { return islands_.empty(); }

private:
    struct Touch {  // one point of one contact
        RowKind kind = RowKind::OnePoint;
        std::size_t normal = 0, separation = 0, mass_scale = 0, impulse_scale = 0;  // in the rows
        std::uint32_t body_a = 0, body_b = 0;
        Vec3 n, turn_a, turn_b;  // r x n
        float bias_rate = 0, soft_mass_scale = 0, soft_impulse_scale = 0, slop = 0, push_speed = 0;
        double speed = 0;   // u, were there no loads
        double before = 0;  // the load so far
        bool active = true;
    };
    struct Island {
        std::size_t begin = 0, end = 0;  // touches
        bool factored = false;
        bool abandoned = false;  // no answer was found: left to the sweeps
    };

    // By body: another of its island, the root being its own; and what the root knows of all.
    struct Sketch {
        std::uint32_t parent = 0;
        std::uint32_t bodies = 1, points = 0;
        bool leans = false, is_uneven = false;
    };
    static bool is_candidate(const Sketch& all);
    std::uint32_t find_root(std::uint32_t body);
    void gather(const StepProblem& problem, const SoftRows& rows);
    void order_island(const StepProblem& problem, std::uint32_t first_body);
    bool calls_for_it(std::uint32_t body);
    template <class Row>
    void list_contact(const StepProblem& problem, std::uint32_t k, SoftRows& rows);
    void list_touches(const StepProblem& problem, SoftRows& rows);
    bool fill(std::span<const Response> responses, std::size_t begin);
    void measure(float h, bool pushes, std::span<const SoftBody> bodies, SoftRows& rows,
                 const Island& island);
    bool find_active(Island& island);
    void apply(const Island& island, std::span<const Response> responses,
               std::span<SoftBody> bodies, SoftRows& rows);
    void abandon(Island& island, SoftRows& rows);
    void factor(const Island& island);
    void substitute(const Island& island);
    bool exchange(const Island& island);
    // product_ = K x over the island.
    void take_product(const Island& island, std::span<const double> x);
    double* row_of(std::vector<double>& m, std::size_t i) {
        return m.data() + (row_[i] - first_[i]);
    }
    const double* row_of(const std::vector<double>& m, std::size_t i) const {
        return m.data() + (row_[i] - first_[i]);
    }

    std::vector<Sketch> sketches_;
    bool any_candidate_ = false;
    // The contacts of each body of a candidate, as lists by place.
    std::vector<std::uint32_t> begins_, members_;
    std::vector<std::uint8_t> seen_;             // by place in active
    std::vector<std::uint32_t> level_;           // by body: contacts from the ground; 0 unseen
    std::vector<std::uint32_t> queue_, island_;  // bodies; contacts in the order reached
    std::vector<Touch> touches_;
    std::vector<std::uint32_t> first_;  // by row: the first column that is not zero
    std::vector<std::size_t> row_;      // by row: where it begins in the matrix
    std::vector<Island> islands_;
    std::vector<double> matrix_, factor_, load_, before_, product_;
};

}  // namespace cairn
