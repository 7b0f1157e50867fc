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

// Implicit Euler of a spring of angular frequency omega and damping ratio z, as factors of a rigid
// row.
Softness soften(float omega, float z, float h) {
    const float a1 = 2 * z + h * omega;
    const float a2 = h * omega * a1;
    const float a3 = 1 / (1 + a2);
    return {omega / a1, a2 * a3, a3};
}

bool has_locked_axes(const StepProblem& problem, std::uint32_t body) {
    const LockedAxes& lock = problem.drives[body].lock;
    return lock.x || lock.y || lock.z;
}

bool stands_still(const StepProblem& problem, std::uint32_t body) {
    const BodyMotion& motion = problem.motions[body];
    return problem.inertias[body].inverse_mass == 0 && motion.linear_velocity == Vec3{} &&
           motion.angular_velocity == Vec3{};
}

// Whether nothing of the body but where its center of mass goes moves the contact.
bool is_ball(const StepProblem& problem, std::uint32_t body, const Arm& arm) {
    return (problem.inertias[body].isotropic && arm.core == Vec3{}) || stands_still(problem, body);
}

RowKind kind_of(const StepProblem& problem, const Contact& contact) {
    const bool special = contact.rolling_friction > 0 || has_locked_axes(problem, contact.body_a) ||
                         has_locked_axes(problem, contact.body_b);
    if (contact.point_count > 1) return special ? RowKind::FourPointsSpecial : RowKind::FourPoints;
    if (special) return RowKind::OnePointSpecial;
    const ContactPoint& point = contact.points[0];
    const bool are_balls = contact.spinning_friction == 0 &&
                           is_ball(problem, contact.body_a, point.arm_a) &&
                           is_ball(problem, contact.body_b, point.arm_b);
    return are_balls ? RowKind::Balls : RowKind::OnePoint;
}

constexpr int bodies_a_block = 128;

SoftHeft make_heft(const BodyInertia& inertia, const Response& response, Quat rotation) {
    const SymmetricMat3& m = response.inverse_inertia;
    return {.xx = m.xx,
            .yy = m.yy,
            .zz = m.zz,
            .xy = m.xy,
            .xz = m.xz,
            .yz = m.yz,
            .inverse_mass = inertia.inverse_mass,
            .inverse_masses = response.inverse_mass,
            .rotation = rotation};
}

}  // namespace

RowRange SoftRows::range(const Batch& batch, int begin, int end) {
    RowArray& rows = array(batch.kind);
    const std::size_t row = batch.begin + std::size_t(begin);
    const std::size_t lane = row * rows.width();
    return {.rows = rows.row(row),
            .read_a = rows.read_a.data() + lane,
            .read_b = rows.read_b.data() + lane,
            .write_a = rows.write_a.data() + lane,
            .write_b = rows.write_b.data() + lane,
            .contacts = rows.contacts.data() + lane,
            .count = std::size_t(end - begin)};
}

void SoftRows::begin_reading(const StepProblem& problem) {
    up_ = normalize_or(-problem.gravity, {});
    links_.resize(problem.active.size());
    edges_.resize(problem.active.size());
}

void SoftRows::read(const StepProblem& problem, const Contact& contact, std::size_t k) {
    links_[k] = {.kind = kind_of(problem, contact),
                 .point_count = std::uint8_t(contact.point_count),
                 .bounces = contact.restitution > 0,
                 .touching = contact.touching,
                 .turns_with_a = contact.turns_with_a,
                 .turns_with_b = contact.turns_with_b,
                 .remembered_load = contact.remembered_load,
                 // Where one cannot be pushed it has no mass.
                 .heavier = max(problem.inertias[contact.body_a].mass,
                                problem.inertias[contact.body_b].mass),
                 .upright = absolute(dot(contact.normal, up_))};
    edges_[k] = {contact.body_a, contact.body_b, problem.inertias[contact.body_a].inverse_mass > 0,
                 problem.inertias[contact.body_b].inverse_mass > 0};
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
    std::array<std::size_t, row_kind_count> contacts = {};
    for (const Link& link : links_) ++contacts[std::size_t(link.kind)];
    for (std::size_t k = 0; k < row_kind_count; ++k) {
        const auto kind = RowKind(k);
        arrays_[k].clear(width, numbers_of(kind));
        // The last row of each colour may be half empty.
        if (contacts[k] > 0)
            arrays_[k].make_room(contacts[k] / std::size_t(width) + colours_.count());
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
                     float part, const SoftKernels& kernels) {
    colouring_.colour(edges_, problem.motions.size(), colours_);
    assert(keeps_bodies_apart(problem.motions.size()));
    give_places(problem, kernels.width);
    // And one that idle lanes read.
    hefts_.resize(problem.motions.size() + 1);
    hefts_.back() = {};
    problem.for_range(problem.motions.size(), bodies_a_block, [&](int begin, int end) {
        for (auto i = std::size_t(begin); i < std::size_t(end); ++i)
            hefts_[i] = make_heft(problem.inertias[i], responses[i], problem.motions[i].rotation);
    });
    exchange(problem, kernels.fill, make_source(problem, h, part));
}

void SoftRows::store(const StepProblem& problem, float h, bool ends_step,
                     const SoftKernels& kernels) {
    RowSource source = make_source(problem, h, h);
    source.ends_step = ends_step;
    exchange(problem, kernels.store, source);
}

RowSource SoftRows::make_source(const StepProblem& problem, float h, float part) const {
    const float omega = angular_frequency_share / part;
    return {.contacts = reinterpret_cast<float*>(problem.contacts.data()),
            .hefts = hefts_.data(),
            .h = h,
            .inverse_h = 1.0f / h,
            .between = soften(omega, damping_ratio, part),
            .ground = soften(ground_frequency_factor * omega, ground_damping_factor * damping_ratio,
                             part),
            .speed_squared_a_size = square(push_speed_share) * length(problem.gravity),
            .speed_a_size = push_share_a_step / float(problem.dt),
            .slop_a_size = slop_share,
            .learning_share = learning_share};
}

void SoftRows::exchange(const StepProblem& problem,
                        const SoftKernels::Exchange (&kernels)[row_kind_count],
                        const RowSource& source) {
    for (const Batch& batch : batches_) {
        const SoftKernels::Exchange kernel = kernels[std::size_t(batch.kind)];
        const int block = rows_a_block(int(array(batch.kind).width()));
        problem.for_range(batch.end - batch.begin, block,
                          [&](int begin, int end) { kernel(range(batch, begin, end), source); });
    }
}

}  // namespace cairn
