#pragma once
// The closed set of methods: what each must offer, and the one that a world holds. A method is a
// value.

#include <concepts>
#include <variant>

#include "cairn/settings.h"
#include "solver/sequential_impulse/sequential_impulse.h"
#include "solver/soft_step/soft_step.h"
#include "solver/xpbd/xpbd.h"

namespace cairn {

template <class Method>
concept SolverMethod = std::copyable<Method> &&
    requires(Method method, const StepProblem& problem) {
    { Method::default_substeps } -> std::convertible_to<int>;
    { Method::default_iterations } -> std::convertible_to<int>;
    method.advance(problem);
};

static_assert(SolverMethod<SequentialImpulse> && SolverMethod<SoftStep> && SolverMethod<Xpbd>);

// In the order of the enumerators of Solver.
using SolverState = std::variant<SequentialImpulse, SoftStep, Xpbd>;

SolverState make_solver(Solver solver);

}  // namespace cairn
