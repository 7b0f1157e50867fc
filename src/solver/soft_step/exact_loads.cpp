// Cholesky over the points of an island; see exact_loads.h.

#include "solver/soft_step/exact_loads.h"

#include <algorithm>

namespace cairn {

namespace {

// Layers from the ground from which on an island counts as tall, and the ratio of masses in touch
// from which on it counts as uneven: what the sweeps of a step still manage by themselves.
constexpr std::uint32_t tall = 12;
constexpr float uneven = 8;
// Every contact's normal must be this near to the vertical: what leans holds by friction, without
// which its normals alone would have no answer, or a huge one.
constexpr float steep = 0.95f;
// Multiplications that one factorization may cost, in all and for each point.
constexpr std::size_t most_work = 400000;
constexpr std::size_t most_work_a_point = 4000;
constexpr std::size_t most_points = 1024;
// The share of K's diagonal that is added to it.
constexpr double evenness = 1e-6;
constexpr int most_exchanges = 12;
// Shares of the largest load and the fastest closing that count as none.
constexpr double rounding = 1e-9;

}  // namespace

void ExactLoads::prepare(const StepProblem& problem, std::span<const Response> responses,
                         SoftRows& rows) {
    islands_.clear();
    touches_.clear();
    first_.clear();
    row_.assign(1, 0);
    matrix_.clear();
    if (!any_candidate_) return;
    gather(problem, rows);
    for (const std::uint32_t body : problem.moving) {
        if (level_[body] != 0 || begins_[body] == begins_[body + 1]) continue;
        order_island(problem, body);
        if (!calls_for_it(body)) continue;
        const std::size_t begin = touches_.size();
        list_touches(problem, rows);
        if (fill(responses, begin)) {
            islands_.push_back({begin, touches_.size()});
            // Rigid: what is known exactly needs no give.
            for (const Touch& t : std::span(touches_).subspan(begin)) {
                rows.array(t.kind)[t.mass_scale] = 1;
                rows.array(t.kind)[t.impulse_scale] = 0;
            }
            continue;
        }
        touches_.resize(begin);
        first_.resize(begin);
        row_.resize(begin + 1);
    }
    factor_.resize(matrix_.size());
    load_.resize(touches_.size());
    before_.resize(touches_.size());
    product_.resize(touches_.size());
}

void ExactLoads::solve(float h, bool pushes, std::span<const Response> responses,
                       std::span<SoftBody> bodies, SoftRows& rows) {
    for (Island& island : islands_) {
        if (island.abandoned) continue;
        measure(h, pushes, bodies, rows, island);
        if (find_active(island)) {
            apply(island, responses, bodies, rows);
        } else {
            abandon(island, rows);
        }
    }
}

bool ExactLoads::find_active(Island& island) {
    for (int i = 0; i < most_exchanges; ++i) {
        if (!island.factored) factor(island);
        island.factored = true;
        substitute(island);
        if (!exchange(island)) return true;
        island.factored = false;
    }
    return false;
}

void ExactLoads::apply(const Island& island, std::span<const Response> responses,
                       std::span<SoftBody> bodies, SoftRows& rows) {
    for (std::size_t i = island.begin; i < island.end; ++i) {
        const Touch& t = touches_[i];
        const double load = t.active ? std::max(0.0, load_[i]) : 0.0;
        const auto change = float(load - before_[i]);
        rows.array(t.kind)[t.normal] = float(load);
        SoftBody& a = bodies[t.body_a];
        SoftBody& b = bodies[t.body_b];
        const Response& to_a = responses[t.body_a];
        const Response& to_b = responses[t.body_b];
        a.v -= multiply(to_a.inverse_mass, change * t.n);
        a.w -= to_a.inverse_inertia * (change * t.turn_a);
        b.v += multiply(to_b.inverse_mass, change * t.n);
        b.w += to_b.inverse_inertia * (change * t.turn_b);
    }
}

void ExactLoads::abandon(Island& island, SoftRows& rows) {
    island.abandoned = true;
    for (std::size_t i = island.begin; i < island.end; ++i) {
        const Touch& t = touches_[i];
        rows.array(t.kind)[t.mass_scale] = t.soft_mass_scale;
        rows.array(t.kind)[t.impulse_scale] = t.soft_impulse_scale;
    }
}

std::uint32_t ExactLoads::find_root(std::uint32_t body) {
    while (sketches_[body].parent != body) {
        sketches_[body].parent = sketches_[sketches_[body].parent].parent;
        body = sketches_[body].parent;
    }
    return body;
}

void ExactLoads::find_candidates(const StepProblem& problem, const SoftRows& rows) {
    any_candidate_ = false;
    if (problem.is_one_island && problem.active.size() > most_points) return;
    sketches_.resize(problem.motions.size());
    for (const std::uint32_t body : problem.moving) sketches_[body] = {.parent = body};
    for (std::size_t k = 0; k < problem.active.size(); ++k) {
        const Colouring::Edge& edge = rows.edges()[k];
        const SoftRows::Link& link = rows.links()[k];
        if (!edge.pushes_a && !edge.pushes_b) continue;
        std::uint32_t root = find_root(edge.pushes_a ? edge.body_a : edge.body_b);
        if (edge.pushes_a && edge.pushes_b) {
            const float a = problem.inertias[edge.body_a].mass;
            const float b = problem.inertias[edge.body_b].mass;
            if (a > uneven * b || b > uneven * a) sketches_[root].is_uneven = true;
            std::uint32_t other = find_root(edge.body_b);
            if (other != root) {
                if (sketches_[root].bodies < sketches_[other].bodies) std::swap(root, other);
                Sketch& all = sketches_[root];
                const Sketch& part = sketches_[other];
                all.bodies += part.bodies;
                all.points += part.points;
                all.leans = all.leans || part.leans;
                all.is_uneven = all.is_uneven || part.is_uneven;
                sketches_[other].parent = root;
            }
        }
        sketches_[root].points += link.point_count;
        if (link.upright < steep) sketches_[root].leans = true;
    }
    for (const std::uint32_t body : problem.moving) {
        const Sketch& all = sketches_[body];
        any_candidate_ = any_candidate_ || (all.parent == body && is_candidate(all));
    }
}

bool ExactLoads::is_candidate(const Sketch& all) {
    return !all.leans && all.points > 0 && all.points <= most_points &&
           (all.is_uneven || all.bodies >= tall);
}

void ExactLoads::gather(const StepProblem& problem, const SoftRows& rows) {
    const std::size_t count = problem.motions.size();
    begins_.assign(count + 1, 0);
    const auto each = [&](auto&& visit) {
        for (std::size_t k = 0; k < problem.active.size(); ++k) {
            const Colouring::Edge& edge = rows.edges()[k];
            if (!edge.pushes_a && !edge.pushes_b) continue;
            const std::uint32_t pushed = edge.pushes_a ? edge.body_a : edge.body_b;
            if (!is_candidate(pushed)) continue;
            if (edge.pushes_a) visit(edge.body_a, std::uint32_t(k));
            if (edge.pushes_b) visit(edge.body_b, std::uint32_t(k));
        }
    };
    each([&](std::uint32_t body, std::uint32_t) { ++begins_[body + 1]; });
    for (std::size_t i = 0; i < count; ++i) begins_[i + 1] += begins_[i];
    members_.resize(begins_[count]);
    std::vector<std::uint32_t> next(begins_.begin(), begins_.end() - 1);
    each([&](std::uint32_t body, std::uint32_t k) { members_[next[body]++] = k; });
    seen_.assign(problem.active.size(), 0);
    level_.assign(count, 0);
}

void ExactLoads::order_island(const StepProblem& problem, std::uint32_t first_body) {
    // Who belongs together ...
    const auto other = [&](std::uint32_t k, std::uint32_t body) {
        const Contact& c = problem.contacts[problem.active[k]];
        return c.body_a == body ? c.body_b : c.body_a;
    };
    const auto is_pushed = [&](std::uint32_t b) { return problem.inertias[b].inverse_mass > 0; };
    constexpr std::uint32_t reached = 0xffffffffu;
    queue_.assign(1, first_body);
    level_[first_body] = reached;
    for (std::size_t i = 0; i < queue_.size(); ++i) {
        for (std::uint32_t m = begins_[queue_[i]]; m < begins_[queue_[i] + 1]; ++m) {
            const std::uint32_t b = other(members_[m], queue_[i]);
            if (!is_pushed(b) || level_[b] == reached) continue;
            level_[b] = reached;
            queue_.push_back(b);
        }
    }
    // ... and then from the ground up, or from the first body where nothing stands on any.
    std::vector<std::uint32_t> all;
    all.swap(queue_);
    for (const std::uint32_t b : all) {
        for (std::uint32_t m = begins_[b]; m < begins_[b + 1]; ++m) {
            if (is_pushed(other(members_[m], b)) || level_[b] != reached) continue;
            level_[b] = 1;
            queue_.push_back(b);
        }
    }
    if (queue_.empty()) {
        level_[first_body] = 1;
        queue_.push_back(first_body);
    }
    island_.clear();
    for (std::size_t i = 0; i < queue_.size(); ++i) {
        const std::uint32_t body = queue_[i];
        for (std::uint32_t m = begins_[body]; m < begins_[body + 1]; ++m) {
            const std::uint32_t k = members_[m];
            if (!seen_[k]) {
                seen_[k] = 1;
                island_.push_back(k);
            }
            const std::uint32_t b = other(k, body);
            if (!is_pushed(b) || level_[b] != reached) continue;
            level_[b] = level_[body] + 1;
            queue_.push_back(b);
        }
    }
}

bool ExactLoads::calls_for_it(std::uint32_t body) {
    return sketches_[find_root(body)].is_uneven || level_[queue_.back()] >= tall;
}

namespace {

// Where the record has these numbers.
template <class Row>
struct Fields {
    static constexpr std::size_t normal = offsetof(Row, normal) / 4;
    static constexpr std::size_t separation = offsetof(Row, separation) / 4;
    static constexpr std::size_t bias_rate = offsetof(Row, bias_rate) / 4;
    static constexpr std::size_t mass_scale = offsetof(Row, mass_scale) / 4;
    static constexpr std::size_t impulse_scale = offsetof(Row, impulse_scale) / 4;
    static constexpr std::size_t push_speed = offsetof(Row, push_speed) / 4;
    static constexpr std::size_t slop = offsetof(Row, slop) / 4;
};

}  // namespace

template <class Row>
void ExactLoads::list_contact(const StepProblem& problem, std::uint32_t k, SoftRows& rows) {
    const Contact& c = problem.contacts[problem.active[k]];
    const SoftRows::Place place = rows.places()[k];
    RowArray& array = rows.array(place.kind);
    const auto at = [&](std::size_t field) { return array.place(place.row, place.lane, field); };
    for (std::size_t i = 0; i < std::size_t(c.point_count); ++i) {
        const ContactPoint& p = c.points[i];
        const Vec3 r_a = find_arm(p.arm_a, problem.motions[c.body_a].rotation);
        const Vec3 r_b = find_arm(p.arm_b, problem.motions[c.body_b].rotation);
        touches_.push_back({.kind = place.kind,
                            .normal = at(Fields<Row>::normal + i),
                            .separation = at(Fields<Row>::separation + i),
                            .mass_scale = at(Fields<Row>::mass_scale),
                            .impulse_scale = at(Fields<Row>::impulse_scale),
                            .body_a = c.body_a,
                            .body_b = c.body_b,
                            .n = c.normal,
                            .turn_a = cross(r_a, c.normal),
                            .turn_b = cross(r_b, c.normal),
                            .bias_rate = array[at(Fields<Row>::bias_rate)],
                            .soft_mass_scale = array[at(Fields<Row>::mass_scale)],
                            .soft_impulse_scale = array[at(Fields<Row>::impulse_scale)],
                            .slop = array[at(Fields<Row>::slop)],
                            .push_speed = array[at(Fields<Row>::push_speed)]});
    }
}

void ExactLoads::list_touches(const StepProblem& problem, SoftRows& rows) {
    for (const std::uint32_t k : island_) {
        switch (rows.places()[k].kind) {
            case RowKind::Balls: list_contact<BallRow>(problem, k, rows); break;
            case RowKind::OnePoint:
            case RowKind::OnePointSpecial: list_contact<SoftRow<1>>(problem, k, rows); break;
            case RowKind::FourPoints:
            case RowKind::FourPointsSpecial: list_contact<SoftRow<4>>(problem, k, rows); break;
        }
    }
}

bool ExactLoads::fill(std::span<const Response> responses, std::size_t begin) {
    const std::size_t end = touches_.size();
    const auto pushed = [&](std::uint32_t b) { return responses[b].inverse_mass != Vec3{}; };
    std::size_t work = 0;
    // Contacts were reached in order: the first that a row meets shares a pushed body with it.
    for (std::size_t i = begin; i < end; ++i) {
        const Touch& t = touches_[i];
        const bool pushes_a = pushed(t.body_a), pushes_b = pushed(t.body_b);
        std::size_t first = begin;
        for (; first < i; ++first) {
            const Touch& u = touches_[first];
            if (pushes_a && (t.body_a == u.body_a || t.body_a == u.body_b)) break;
            if (pushes_b && (t.body_b == u.body_a || t.body_b == u.body_b)) break;
        }
        first_.push_back(std::uint32_t(first));
        row_.push_back(row_.back() + (i - first + 1));
        work += (i - first + 1) * (i - first + 1) / 2;
    }
    if (work > most_work || work > most_work_a_point * (end - begin)) return false;
    matrix_.resize(row_[end]);
    const auto side = [&](const Touch& t, Vec3 turn, double sign, std::uint32_t body,
                          const Touch& u) {
        const Response& r = responses[body];
        const Vec3 spin = r.inverse_inertia * turn;
        const Vec3 linear = multiply(r.inverse_mass, t.n);
        double k = 0;
        if (u.body_a == body) k -= sign * double(dot(linear, u.n) + dot(spin, u.turn_a));
        if (u.body_b == body) k += sign * double(dot(linear, u.n) + dot(spin, u.turn_b));
        return k;
    };
    for (std::size_t i = begin; i < end; ++i) {
        const Touch& t = touches_[i];
        double* row = row_of(matrix_, i);
        for (std::size_t j = first_[i]; j <= i; ++j) {
            const Touch& u = touches_[j];
            row[j] = side(t, t.turn_a, -1, t.body_a, u) + side(t, t.turn_b, 1, t.body_b, u);
        }
        row[i] *= 1 + evenness;
    }
    return true;
}

void ExactLoads::measure(float h, bool pushes, std::span<const SoftBody> bodies, SoftRows& rows,
                         const Island& island) {
    for (std::size_t i = island.begin; i < island.end; ++i) {
        Touch& t = touches_[i];
        const SoftBody& a = bodies[t.body_a];
        const SoftBody& b = bodies[t.body_b];
        const RowArray& array = rows.array(t.kind);
        const float s = array[t.separation];
        const float push_back =
            pushes ? max(t.bias_rate * min(s + t.slop, 0), -t.push_speed) : 0.0f;
        const float bias = s > 0 ? s / h : push_back;
        before_[i] = double(array[t.normal]);
        t.speed = double(dot(t.n, b.v - a.v) + dot(t.turn_b, b.w) - dot(t.turn_a, a.w) + bias);
    }
    take_product(island, before_);
    for (std::size_t i = island.begin; i < island.end; ++i) touches_[i].speed -= product_[i];
}

void ExactLoads::take_product(const Island& island, std::span<const double> x) {
    std::fill(product_.begin() + std::ptrdiff_t(island.begin),
              product_.begin() + std::ptrdiff_t(island.end), 0.0);
    for (std::size_t i = island.begin; i < island.end; ++i) {
        const double* row = row_of(matrix_, i);
        double sum = row[i] * x[i];
        for (std::size_t j = first_[i]; j < i; ++j) {
            sum += row[j] * x[j];
            product_[j] += row[j] * x[i];
        }
        product_[i] += sum;
    }
}

void ExactLoads::factor(const Island& island) {
    // L D L^T row by row; what is not active is a row and column of the identity.
    for (std::size_t i = island.begin; i < island.end; ++i) {
        double* li = row_of(factor_, i);
        const double* ki = row_of(matrix_, i);
        if (!touches_[i].active) {
            for (std::size_t j = first_[i]; j < i; ++j) li[j] = 0;
            li[i] = 1;
            continue;
        }
        for (std::size_t j = first_[i]; j < i; ++j) {
            const double* lj = row_of(factor_, j);
            double x = touches_[j].active ? ki[j] : 0;
            for (std::size_t m = std::max(first_[i], first_[j]); m < j; ++m) x -= li[m] * lj[m];
            li[j] = x;  // L D, until the row is done
        }
        double diagonal = ki[i];
        for (std::size_t j = first_[i]; j < i; ++j) {
            const double l = li[j] / row_of(factor_, j)[j];
            diagonal -= li[j] * l;
            li[j] = l;
        }
        li[i] = diagonal;
    }
}

void ExactLoads::substitute(const Island& island) {
    for (std::size_t i = island.begin; i < island.end; ++i) {
        const double* li = row_of(factor_, i);
        double sum = touches_[i].active ? -touches_[i].speed : 0;
        for (std::size_t j = first_[i]; j < i; ++j) sum -= li[j] * load_[j];
        load_[i] = sum;
    }
    for (std::size_t i = island.begin; i < island.end; ++i) load_[i] /= row_of(factor_, i)[i];
    for (std::size_t i = island.end; i-- > island.begin;) {
        const double* li = row_of(factor_, i);
        for (std::size_t j = first_[i]; j < i; ++j) load_[j] -= li[j] * load_[i];
    }
}

bool ExactLoads::exchange(const Island& island) {
    take_product(island, load_);
    double largest = 0, fastest = 0;
    for (std::size_t i = island.begin; i < island.end; ++i) {
        largest = std::max(largest, load_[i]);
        fastest = std::max(fastest, std::abs(touches_[i].speed));
    }
    bool changed = false;
    for (std::size_t i = island.begin; i < island.end; ++i) {
        Touch& t = touches_[i];
        const bool was = t.active;
        if (was) {
            t.active = load_[i] >= -rounding * largest;
        } else {
            t.active = t.speed + product_[i] < -rounding * fastest;
        }
        changed = changed || was != t.active;
    }
    return changed;
}

}  // namespace cairn
