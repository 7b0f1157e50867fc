// The methods by name; see solver.h.

#include "solver/solver.h"

namespace cairn {

SolverState make_solver(Solver solver) {
    switch (solver) {
        case Solver::SequentialImpulse: return SequentialImpulse{};
        case Solver::SoftStep: return SoftStep{};
        case Solver::Xpbd: return Xpbd{};
    }
    return {};
}

int default_substeps(Solver solver) {
    return std::visit([](const auto& method) { return method.default_substeps; },
                      make_solver(solver));
}

int default_iterations(Solver solver) {
    return std::visit([](const auto& method) { return method.default_iterations; },
                      make_solver(solver));
}

}  // namespace cairn
