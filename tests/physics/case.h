#pragma once
// What a case of the accuracy table is: a set-up run in one way, and what it writes down.
//
// A case runs once for each way in which it can be run (solver, narrow phase, step) and notes
// figures on a Sheet: a figure, what it ought to be, and how far off it may be. Tolerances stand in
// the case and are never adjusted to a result; a row that a method cannot meet by its nature is
// named in the case's `known_unmet`, with the derivation, and must then really fail.
// docs/validation.md tells the cases.

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cairn/cairn.h"

namespace cairn::physics {

// One way to run a case. Budgets are always the solver's own default.
struct Setup {
    Solver solver = Solver::SequentialImpulse;
    NarrowPhase narrow_phase = NarrowPhase::Sat;
    double dt = 1.0 / 60;
    bool verbose = false;  // the case may print how it goes
};

inline double substep_of(const Setup& setup) { return setup.dt / default_substeps(setup.solver); }
inline int steps_in(const Setup& setup, double seconds) {
    return static_cast<int>(std::lround(seconds / setup.dt));
}
inline bool is_coarse(const Setup& setup) { return setup.dt > 1.0 / 100; }

// A figure that the scene never came to show: meets no tolerance.
inline constexpr double not_seen = std::numeric_limits<double>::quiet_NaN();

struct Row {
    std::string what;
    double measured = 0;
    double expected = 0;
    double error = 0;
    double tolerance = 0;

    // Not finite where the figure is not, and infinite where something is off that must be exact.
    double ratio() const {
        if (error == 0) return 0;
        return tolerance > 0 ? error / tolerance : std::numeric_limits<double>::infinity();
    }
    bool is_met() const { return ratio() <= 1; }
};

class Sheet {
public:
    void compare(std::string what, double measured, double expected, double tolerance) {
        rows_.push_back(
            {std::move(what), measured, expected, std::abs(measured - expected), tolerance});
    }
    // For a figure that ought to be 0 or less, and may be `at_most`.
    void bound(std::string what, double measured, double at_most) {
        const double error = measured <= 0 ? 0 : measured;
        rows_.push_back({std::move(what), measured, 0, error, at_most});
    }
    // For what is so or is not.
    void claim(std::string what, bool holds) {
        rows_.push_back({std::move(what), holds ? 1.0 : 0.0, 1, holds ? 0.0 : 1.0, 0});
    }
    const std::vector<Row>& rows() const { return rows_; }

private:
    std::vector<Row> rows_;
};

enum class Subject {
    Mass,       // neither solver nor narrow phase matters
    Collision,  // runs once for each narrow phase
    Motion,     // runs once for each solver and step
    Piling,     // as Motion, and under both narrow phases
};

// A row that a method cannot meet by its nature: which, under what, and why not.
struct KnownUnmet {
    std::string_view row;  // how its `what` begins; empty for every row of the case
    Solver solver = Solver::SequentialImpulse;
    double dt = 0;  // 0: at every step
    std::string_view reason;
};

struct Case {
    std::string_view id;
    std::string_view title;
    Subject subject = Subject::Motion;
    void (*run)(const Setup& setup, Sheet& sheet) = nullptr;
    bool quick = false;  // belongs to the subset for every working day
    std::vector<double> steps = {1.0 / 60, 1.0 / 240};
    std::optional<Solver> only = {};  // asked of this solver alone
    std::vector<KnownUnmet> known_unmet = {};
};

std::vector<Case> free_body_cases();
std::vector<Case> mass_cases();
std::vector<Case> collision_cases();
std::vector<Case> bounce_cases();
std::vector<Case> friction_cases();
std::vector<Case> rolling_cases();
std::vector<Case> rest_cases();
std::vector<Case> structure_cases();
std::vector<Case> impact_cases();
std::vector<Case> determinism_cases();

}  // namespace cairn::physics
