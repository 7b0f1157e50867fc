// Filling and emptying rows; see build_rows.h.

#include "solver/soft_step/build_rows.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace cairn {

namespace {

// Damping over critical: contacts creep back, they do not bounce.
constexpr float damping_ratio = 10;
// Against what cannot be pushed there is but one body to move: twice as stiff, half as damped.
constexpr float ground_frequency_factor = 2;
constexpr float ground_damping_factor = 0.5f;
// Overlap that is left alone, as a share of the smaller shape: keeps a resting contact closed.
constexpr float slop_share = 0.0001f;
// The share of a load that its contact learns in a step. Slower than the slowest swing of what the
// sweeps still hold, or the memory and the swing drive each other.
constexpr float learning_share = 0.02f;
// An overlap is pushed out no faster than this share of the speed sqrt(size g) that falling makes
// of the smaller shape's size: similar scenes at two scales do alike ...
constexpr float push_speed_share = 1.2f;
// ... and where there is no gravity to measure by, than this share of the size a step.
constexpr float push_share_a_step = 0.004f;

struct Softness {
    float bias_rate = 0, mass_scale = 0, impulse_scale = 0;
};

// Implicit Euler of a spring of angular frequency omega and damping ratio z, as factors of a rigid
// row.
Softness soften(float omega, float z, float h) {
    const float a1 = 2 * z + h * omega;
    const float a2 = h * omega * a1;
    const float a3 = 1 / (1 + a2);
    return {omega / a1, a2 * a3, a3};
}

// 1 / the larger eigenvalue of a symmetric 2x2 matrix; 0 where nothing gives.
float softest(float tt, float tu, float uu) {
    const float half_difference = 0.5f * (tt - uu);
    const float largest =
        0.5f * (tt + uu) + square_root(half_difference * half_difference + tu * tu);
    return largest > 0 ? 1.0f / largest : 0;
}

bool has_locked_axes(const StepProblem& problem, std::uint32_t body) {
    const LockedAxes& lock = problem.drives[body].lock;
    return lock.x || lock.y || lock.z;
}

RowKind kind_of(const StepProblem& problem, const Contact& contact) {
    const bool special = contact.rolling_friction > 0 || has_locked_axes(problem, contact.body_a) ||
                         has_locked_axes(problem, contact.body_b);
    if (contact.point_count == 1) return special ? RowKind::OnePointSpecial : RowKind::OnePoint;
    return special ? RowKind::FourPointsSpecial : RowKind::FourPoints;
}

// Fills the records of one contact.
template <int P>
class RowFiller {
public:
    RowFiller(const StepProblem& problem, std::span<const Response> responses,
              const Contact& contact, float h, float part)
        : problem_(problem),
          contact_(contact),
          a_(responses[contact.body_a]),
          b_(responses[contact.body_b]),
          h_(h),
          part_(part) {}

    SoftRow<P> fill() {
        find_center();
        fill_bodies();
        fill_normals();
        fill_softness();
        fill_friction();
        return row_;
    }

private:
    void find_center() {
        const BodyMotion& a = problem_.motions[contact_.body_a];
        const BodyMotion& b = problem_.motions[contact_.body_b];
        row_.n = contact_.normal;
        row_.t1 = any_perpendicular(row_.n);
        row_.t2 = cross(row_.n, row_.t1);
        // Friction acts where the load does.
        const auto count = std::size_t(contact_.point_count);
        float load = 0;
        for (std::size_t i = 0; i < count; ++i) load += contact_.points[i].normal_force;
        for (std::size_t i = 0; i < count; ++i) {
            const ContactPoint& p = contact_.points[i];
            const float weight = load > 0 ? p.normal_force / load : 1.0f / float(count);
            arms_[i] = find_arm(p.arm_a, a.rotation);
            row_.arm_a += weight * arms_[i];
            row_.arm_b += weight * find_arm(p.arm_b, b.rotation);
            row_.round_a += weight * dot(p.arm_a.offset, row_.n);
            row_.round_b += weight * dot(p.arm_b.offset, row_.n);
        }
    }

    void fill_bodies() {
        row_.mass_a = problem_.inertias[contact_.body_a].inverse_mass;
        row_.mass_b = problem_.inertias[contact_.body_b].inverse_mass;
        row_.masses_a = a_.inverse_mass;
        row_.masses_b = b_.inverse_mass;
        row_.inertia_a = a_.inverse_inertia;
        row_.inertia_b = b_.inverse_inertia;
    }

    // The speed along d that a unit impulse along e at the center makes.
    float answer(Vec3 d, Vec3 e) const {
        return dot(d, multiply(row_.masses_a + row_.masses_b, e)) +
               dot(cross(row_.arm_a, d), row_.inertia_a * cross(row_.arm_a, e)) +
               dot(cross(row_.arm_b, d), row_.inertia_b * cross(row_.arm_b, e));
    }

    void fill_normals() {
        const Vec3 n = row_.n, t1 = row_.t1, t2 = row_.t2;
        const Vec3 spin =
            row_.inertia_a * cross(row_.arm_a, n) + row_.inertia_b * cross(row_.arm_b, n);
        const SymmetricMat3 turning = row_.inertia_a + row_.inertia_b;
        const float k00 = row_.k00 = answer(n, n);
        const float k01 = row_.k01 = dot(spin, t1);
        const float k02 = row_.k02 = dot(spin, t2);
        const float k11 = row_.k11 = dot(t1, turning * t1);
        const float k12 = row_.k12 = dot(t1, turning * t2);
        const float k22 = row_.k22 = dot(t2, turning * t2);
        const auto count = std::size_t(contact_.point_count);
        const float share = contact_.remembered_load / float(count);
        for (std::size_t i = 0; i < count; ++i) {
            const ContactPoint& p = contact_.points[i];
            const Vec3 d = arms_[i] - row_.arm_a;
            const float x = row_.x[i] = dot(d, t1);
            const float y = row_.y[i] = dot(d, t2);
            row_.start_separation[i] = row_.separation[i] = p.separation;
            row_.normal[i] = h_ * p.normal_force;
            row_.remembered[i] = min(h_ * share, row_.normal[i]);
            const float k =
                k00 + y * y * k11 + x * x * k22 + 2 * y * k01 - 2 * x * k02 - 2 * x * y * k12;
            row_.mass[i] = k > 0 ? 1.0f / k : 0;
        }
    }

    void fill_softness() {
        const bool ground = !(row_.mass_a > 0 && row_.mass_b > 0);
        const float omega =
            SoftRows::angular_frequency_share / part_ * (ground ? ground_frequency_factor : 1);
        const Softness soft =
            soften(omega, damping_ratio * (ground ? ground_damping_factor : 1), part_);
        row_.bias_rate = soft.bias_rate;
        // The push, too, is answered by the softened mass.
        row_.mass_scale = soft.mass_scale;
        row_.impulse_scale = soft.impulse_scale;
        const float by_gravity =
            push_speed_share * square_root(contact_.size * length(problem_.gravity));
        row_.push_speed = max(by_gravity, push_share_a_step * contact_.size / float(problem_.dt));
        row_.slop = slop_share * contact_.size;
    }

    void fill_friction() {
        const Vec3 n = row_.n, t1 = row_.t1, t2 = row_.t2;
        row_.friction = contact_.friction;
        row_.slide_1 = dot(t1, contact_.surface_velocity);
        row_.slide_2 = dot(t2, contact_.surface_velocity);
        row_.k_11 = answer(t1, t1);
        row_.k_12 = answer(t1, t2);
        row_.k_22 = answer(t2, t2);
        row_.tangent_mass = softest(row_.k_11, row_.k_12, row_.k_22);
        Vec3 friction;
        float twist = contact_.spinning_torque;
        for (std::size_t i = 0; i < std::size_t(contact_.point_count); ++i) {
            const ContactPoint& p = contact_.points[i];
            const float x = row_.x[i], y = row_.y[i];
            row_.lever[i] =
                contact_.friction * square_root(x * x + y * y) + contact_.spinning_friction;
            friction += p.friction_force;
            twist += dot(n, cross(arms_[i] - row_.arm_a, p.friction_force));
        }
        row_.friction_1 = h_ * dot(t1, friction);
        row_.friction_2 = h_ * dot(t2, friction);
        row_.twist = h_ * twist;
        const float about = dot(n, (row_.inertia_a + row_.inertia_b) * n);
        row_.twist_mass = about > 0 ? 1.0f / about : 0;
        if (!(contact_.rolling_friction > 0)) return;
        row_.rolling_friction = contact_.rolling_friction;
        row_.rolling_mass = softest(row_.k11, row_.k12, row_.k22);
        row_.roll_1 = h_ * dot(t1, contact_.rolling_torque);
        row_.roll_2 = h_ * dot(t2, contact_.rolling_torque);
    }

    const StepProblem& problem_;
    const Contact& contact_;
    const Response& a_;
    const Response& b_;
    float h_;
    float part_;
    SoftRow<P> row_;
    std::array<Vec3, 4> arms_;
};

// The numbers of a row that a contact is told at the end: the others are not read.
template <int P>
SoftRow<P> read_result(const RowArray& rows, const SoftRows::Place& place) {
    using Row = SoftRow<P>;
    SoftRow<P> row;
    auto* numbers = reinterpret_cast<float*>(&row);
    const auto read = [&](std::size_t from, std::size_t to) {
        for (std::size_t k = from / 4; k < to / 4; ++k)
            numbers[k] = rows[rows.place(place.row, place.lane, k)];
    };
    read(offsetof(Row, n), offsetof(Row, arm_a));
    read(offsetof(Row, x), offsetof(Row, start_separation));
    read(offsetof(Row, separation), offsetof(Row, remembered));
    read(offsetof(Row, total), offsetof(Row, mass));
    read(offsetof(Row, friction_1), offsetof(Row, lever));
    read(offsetof(Row, twist), offsetof(Row, masses_a));
    if (is_special(place.kind)) read(offsetof(Row, roll_1), sizeof(Row));
    return row;
}

// The row's impulses over the step into the contact's report, and its forces for the next step.
template <int P>
void store_row(const RowArray& rows, const SoftRows::Place& place, float h, Contact& contact) {
    const SoftRow<P> row = read_result<P>(rows, place);
    const float inverse_h = 1.0f / h;
    const auto count = std::size_t(contact.point_count);
    const Vec3 friction = row.friction_1 * row.t1 + row.friction_2 * row.t2;
    const Vec3 friction_total = row.friction_total_1 * row.t1 + row.friction_total_2 * row.t2;
    float load = 0, total = 0;
    for (std::size_t i = 0; i < count; ++i) {
        load += row.normal[i];
        total += row.total[i];
    }
    // A point bears friction as it bears load; what is left of the twist turns the whole.
    float twist = row.twist;
    for (std::size_t i = 0; i < count; ++i) {
        ContactPoint& p = contact.points[i];
        const Vec3 d = row.x[i] * row.t1 + row.y[i] * row.t2;
        const Vec3 part = load > 0 ? (row.normal[i] / load) * friction : Vec3{};
        twist -= dot(row.n, cross(d, part));
        p.normal_force = inverse_h * row.normal[i];
        p.friction_force = inverse_h * part;
        p.normal_impulse += row.total[i];
        p.separation = row.separation[i];
        if (total > 0) p.friction_impulse += (row.total[i] / total) * friction_total;
    }
    contact.spinning_torque = load > 0 ? inverse_h * twist : 0;
    contact.spinning_impulse += row.twist_total;
    contact.rolling_torque = inverse_h * (row.roll_1 * row.t1 + row.roll_2 * row.t2);
    contact.rolling_impulse += row.roll_total_1 * row.t1 + row.roll_total_2 * row.t2;
}

void remember_load(Contact& contact) {
    float force = 0;
    for (int i = 0; i < contact.point_count; ++i) {
        force += contact.points[std::size_t(i)].normal_force;
    }
    const float before = contact.remembered_load;
    contact.remembered_load = min(before + learning_share * (force - before), force);
}

// Contacts are read, filled in and stored in blocks of so many, some microseconds' work.
constexpr int contacts_a_block = 64;
// Contacts lie far apart in memory: each is asked for some time before it is used.
constexpr std::size_t far_ahead = 6;
void prefetch(const Contact& contact) {
    const auto* bytes = reinterpret_cast<const char*>(&contact);
    for (std::size_t i = 0; i < 5; ++i) __builtin_prefetch(bytes + 64 * i);
}

}  // namespace

RowRange SoftRows::range(const Batch& batch) {
    RowArray& rows = array(batch.kind);
    const std::size_t first = batch.begin * rows.width();
    return {rows.row(batch.begin),       rows.read_a.data() + first,  rows.read_b.data() + first,
            rows.write_a.data() + first, rows.write_b.data() + first, batch.end - batch.begin};
}

void SoftRows::read_contacts(const StepProblem& problem) {
    const Vec3 up = normalize_or(-problem.gravity, {});
    const std::size_t count = problem.active.size();
    links_.resize(count);
    edges_.resize(count);
    problem.for_range(count, contacts_a_block, [&](int begin, int end) {
        for (auto k = std::size_t(begin); k < std::size_t(end); ++k) {
            const Contact& contact = problem.contacts[problem.active[k]];
            links_[k] = {.kind = kind_of(problem, contact),
                         .point_count = std::uint8_t(contact.point_count),
                         .bounces = contact.restitution > 0,
                         .turns_with_a = contact.turns_with_a,
                         .turns_with_b = contact.turns_with_b,
                         .upright = absolute(dot(contact.normal, up))};
            edges_[k] = {contact.body_a, contact.body_b,
                         problem.inertias[contact.body_a].inverse_mass > 0,
                         problem.inertias[contact.body_b].inverse_mass > 0};
        }
    });
}

SoftRows::Place SoftRows::take_lane(RowKind kind, std::size_t colour_begin, std::uint32_t nobody) {
    RowArray& rows = array(kind);
    std::uint32_t& free = free_lanes_[std::size_t(kind)];
    if (rows.count() == colour_begin || free == rows.width()) {
        const std::size_t block =
            (rows.count() - colour_begin) / std::size_t(rows_a_block(int(rows.width())));
        spare_bodies_ = std::max(spare_bodies_, block + 2);
        rows.add_row(nobody, nobody + 1 + std::uint32_t(block));
        free = 0;
    }
    return {kind, std::uint32_t(rows.count() - 1), free++};
}

void SoftRows::give_places(const StepProblem& problem, int width) {
    for (std::size_t k = 0; k < row_kind_count; ++k) {
        const auto kind = RowKind(k);
        const bool special = is_special(kind);
        arrays_[k].clear(width,
                         points_of(kind) == 1 ? row_numbers<1>(special) : row_numbers<4>(special));
    }
    batches_.clear();
    places_.resize(problem.active.size());
    spare_bodies_ = 2;
    const auto nobody = std::uint32_t(problem.motions.size());
    for (std::size_t c = 0; c < colours_.count(); ++c) {
        std::array<std::size_t, row_kind_count> begins;
        for (std::size_t k = 0; k < row_kind_count; ++k) begins[k] = arrays_[k].count();
        for (const std::uint32_t k : colours_[c]) {
            const RowKind kind = links_[k].kind;
            const Place place = take_lane(kind, begins[std::size_t(kind)], nobody);
            places_[k] = place;
            RowArray& rows = array(kind);
            const Colouring::Edge& edge = edges_[k];
            const std::size_t lane = place.row * rows.width() + place.lane;
            rows.contacts[lane] = problem.active[k];
            rows.read_a[lane] = edge.body_a;
            rows.read_b[lane] = edge.body_b;
            if (edge.pushes_a) rows.write_a[lane] = edge.body_a;
            if (edge.pushes_b) rows.write_b[lane] = edge.body_b;
        }
        for (std::size_t k = 0; k < row_kind_count; ++k) {
            if (arrays_[k].count() > begins[k])
                batches_.push_back({RowKind(k), begins[k], arrays_[k].count()});
        }
    }
}

// Whether no two rows of a colour push the same body.
bool SoftRows::keeps_bodies_apart(std::size_t body_count) const {
    std::vector<std::size_t> last_colour(body_count, colours_.count());
    const auto push = [&](std::uint32_t body, std::size_t colour) {
        return std::exchange(last_colour[body], colour) != colour;
    };
    for (std::size_t c = 0; c < colours_.count(); ++c) {
        for (const std::uint32_t k : colours_[c]) {
            const Colouring::Edge& edge = edges_[k];
            if (edge.pushes_a && !push(edge.body_a, c)) return false;
            if (edge.pushes_b && !push(edge.body_b, c)) return false;
        }
    }
    return true;
}

void SoftRows::build(const StepProblem& problem, std::span<const Response> responses, float h,
                     float part, int width) {
    colouring_.colour(edges_, problem.motions.size(), colours_);
    assert(keeps_bodies_apart(problem.motions.size()));
    give_places(problem, width);
    // In the order of the rows, so that what is written lies together.
    problem.for_range(colours_.order.size(), contacts_a_block, [&](int begin, int end) {
        fill(problem, responses, h, part,
             std::span(colours_.order).subspan(std::size_t(begin), std::size_t(end - begin)));
    });
}

void SoftRows::fill(const StepProblem& problem, std::span<const Response> responses, float h,
                    float part, std::span<const std::uint32_t> places_in_active) {
    for (std::size_t i = 0; i < places_in_active.size(); ++i) {
        const std::size_t ahead = std::min(i + far_ahead, places_in_active.size() - 1);
        prefetch(problem.contacts[problem.active[places_in_active[ahead]]]);
        const std::uint32_t k = places_in_active[i];
        const Contact& contact = problem.contacts[problem.active[k]];
        const Place place = places_[k];
        RowArray& rows = array(place.kind);
        if (points_of(place.kind) == 1) {
            put_lane(rows, place.row, place.lane,
                     RowFiller<1>(problem, responses, contact, h, part).fill());
        } else {
            put_lane(rows, place.row, place.lane,
                     RowFiller<4>(problem, responses, contact, h, part).fill());
        }
    }
}

void SoftRows::store(const StepProblem& problem, float h, bool ends_step) const {
    problem.for_range(places_.size(), contacts_a_block, [&](int begin, int end) {
        for (auto k = std::size_t(begin); k < std::size_t(end); ++k) {
            const Place place = places_[k];
            const RowArray& rows = arrays_[std::size_t(place.kind)];
            Contact& contact = problem.contacts[problem.active[k]];
            const std::size_t ahead = std::min(k + far_ahead, places_.size() - 1);
            prefetch(problem.contacts[problem.active[ahead]]);
            if (points_of(place.kind) == 1) {
                store_row<1>(rows, place, h, contact);
            } else {
                store_row<4>(rows, place, h, contact);
            }
            if (ends_step) remember_load(contact);
        }
    });
}

}  // namespace cairn
