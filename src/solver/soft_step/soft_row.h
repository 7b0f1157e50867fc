#pragma once
// The contact rows of the soft step as they lie in memory: records of floats, W of them turned so
// that each number stands beside the same number of its neighbours.
//
// All points of a manifold share one normal and one pair of bodies, so the manifold moves as one
// rigid frame at its friction center c: v the relative velocity there, w the relative angular
// velocity. With n, t1, t2 the frame and d_i = x_i t1 + y_i t2 from c to point i,
//
//     u_i = n.v + y_i (t1.w) - x_i (t2.w)
//
// so the normals of all points see the bodies through three numbers U = (n.v, t1.w, t2.w), an
// impulse l at point i changes them by K (1, y_i, -x_i) l with one symmetric 3x3 K, and the bodies
// are touched once a manifold however many points it has.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/large_array.h"
#include "math/mat3.h"

namespace cairn {

// What a body does within the step. Four floats a group, so that lanes are turned in and out.
struct alignas(64) SoftBody {
    Vec3 v;
    float unused_0 = 0;
    Vec3 w;
    float unused_1 = 0;
    Vec3 displacement;  // since its contacts were anchored, as `turn`
    float unused_2 = 0;
    Quat turn;
};
static_assert(sizeof(SoftBody) == 64);

// What a row is built from of each of its bodies; four floats a group, likewise.
struct alignas(64) SoftHeft {
    float xx = 0, yy = 0, zz = 0, xy = 0;  // inverse inertia, world
    float xz = 0, yz = 0;
    float inverse_mass = 0;
    float unused_0 = 0;
    Vec3 inverse_masses;  // by world axis: zero along a locked one
    float unused_1 = 0;
    Quat rotation;
};
static_assert(sizeof(SoftHeft) == 64);

// Of P points at most.
template <int P>
struct SoftRow {
    Vec3 n, t1, t2;
    Vec3 arm_a, arm_b;  // from the centers of mass to c
    // How far along n a round surface lies from what turns with the body: that part of the arm
    // stays as the body turns.
    float round_a = 0, round_b = 0;
    float mass_a = 0, mass_b = 0;        // inverse
    SymmetricMat3 inertia_a, inertia_b;  // inverse, world

    // Normals.
    float x[P] = {}, y[P] = {};
    float start_separation[P] = {}, separation[P] = {};
    float normal[P] = {};      // impulse of one substep, N s
    float remembered[P] = {};  // the load to which the spring gives way, N s
    float total[P] = {};       // over the step
    float mass[P] = {};        // 1 / K_ii; 0 where there is no point
    float k00 = 0, k01 = 0, k02 = 0, k11 = 0, k12 = 0, k22 = 0;
    float bias_rate = 0, mass_scale = 0, impulse_scale = 0;
    float push_speed = 0;
    float slop = 0;

    // Friction at c, and turning about n.
    float friction = 0;
    float slide_1 = 0, slide_2 = 0;  // the surfaces' own velocity along t1, t2
    float tangent_mass = 0, k_11 = 0, k_12 = 0, k_22 = 0;
    float friction_1 = 0, friction_2 = 0;
    float friction_total_1 = 0, friction_total_2 = 0;
    float lever[P] = {};  // twist that a unit normal impulse at point i can hold
    float twist_mass = 0, twist = 0, twist_total = 0;

    // From here on for special rows alone: those that resist rolling, or whose bodies have locked
    // axes.
    Vec3 masses_a, masses_b;  // inverse, by world axis: zero along a locked one
    float rolling_friction = 0, rolling_mass = 0;
    float roll_1 = 0, roll_2 = 0;
    float roll_total_1 = 0, roll_total_2 = 0;
};

// Between balls about their centers of mass, or such a ball and what stands still, of which nothing
// resists rolling or spinning: the arms are along the normal, a turn moves nothing, and friction
// meets one mass in every direction (ball_rows.h).
struct BallRow {
    Vec3 n, t1;
    float arm_a = 0, arm_b = 0;          // along n
    float mass_a = 0, mass_b = 0;        // inverse
    float inertia_a = 0, inertia_b = 0;  // inverse

    float start_separation = 0, separation = 0;
    float normal = 0, remembered = 0, total = 0;
    float mass = 0;
    float bias_rate = 0, mass_scale = 0, impulse_scale = 0;
    float push_speed = 0;
    float slop = 0;

    float friction = 0;
    float slide_1 = 0, slide_2 = 0;
    float tangent_mass = 0;
    float friction_1 = 0, friction_2 = 0;
    float friction_total_1 = 0, friction_total_2 = 0;
};

// How many numbers of a record are kept.
constexpr std::size_t ball_numbers = sizeof(BallRow) / 4;
template <int P>
constexpr std::size_t row_numbers(bool special) {
    return (special ? sizeof(SoftRow<P>) : offsetof(SoftRow<P>, masses_a)) / 4;
}

// The kinds of rows, each in an array of its own.
enum class RowKind : std::uint8_t {
    Balls,
    OnePoint,
    FourPoints,
    OnePointSpecial,
    FourPointsSpecial,
};
constexpr std::size_t row_kind_count = 5;

constexpr std::size_t numbers_of(RowKind kind) {
    switch (kind) {
        case RowKind::Balls: return ball_numbers;
        case RowKind::OnePoint: return row_numbers<1>(false);
        case RowKind::FourPoints: return row_numbers<4>(false);
        case RowKind::OnePointSpecial: return row_numbers<1>(true);
        case RowKind::FourPointsSpecial: break;
    }
    return row_numbers<4>(true);
}

// Rows of one kind, W lanes each. A lane without a contact pushes nothing.
class RowArray {
public:
    void clear(int width, std::size_t numbers_a_lane) {
        width_ = std::size_t(width);
        stride_ = numbers_a_lane * width_;
        read_a.clear();
        read_b.clear();
        write_a.clear();
        write_b.clear();
        contacts.clear();
    }
    std::size_t count() const { return contacts.size() / width_; }
    std::size_t width() const { return width_; }
    std::size_t numbers() const { return stride_ / width_; }
    float* row(std::size_t r) { return numbers_.data() + r * stride_; }
    const float* row(std::size_t r) const { return numbers_.data() + r * stride_; }
    // Where number `field` of lane `lane` of row r is.
    std::size_t place(std::size_t r, std::size_t lane, std::size_t field) const {
        return r * stride_ + field * width_ + lane;
    }
    float& operator[](std::size_t place) { return numbers_[place]; }
    float operator[](std::size_t place) const { return numbers_[place]; }

    // For so many rows at most; their numbers are whatever was there, and all are yet to be filled.
    void make_room(std::size_t rows) {
        if (numbers_.size() >= rows * stride_) return;
        // What was there need not be kept.
        numbers_.clear();
        numbers_.resize(rows * stride_);
    }
    // Adds a row of idle lanes that read `still` and write `nowhere`; no two rows that are worked
    // on at once may write the same.
    std::size_t add_row(std::uint32_t still, std::uint32_t nowhere) {
        const std::size_t lanes = contacts.size() + width_;
        read_a.resize(lanes, still);
        read_b.resize(lanes, still);
        write_a.resize(lanes, nowhere);
        write_b.resize(lanes, nowhere);
        contacts.resize(lanes, idle);
        return count() - 1;
    }

    static constexpr std::uint32_t idle = 0xffffffffu;
    // By row and lane. Bodies that cannot be pushed are read, but never written.
    std::vector<std::uint32_t> read_a, read_b, write_a, write_b;
    std::vector<std::uint32_t> contacts;  // place in the step's list of contacts

private:
    LargeArray<float> numbers_;
    std::size_t width_ = 1;
    std::size_t stride_ = 0;
};

}  // namespace cairn
