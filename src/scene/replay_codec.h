#pragma once
// How little room do the poses and contacts of a frame take? Integers on a lattice, coded as what a
// straight continuation of the last two frames does not foresee: what rests costs nothing.
//
// Positions are whole multiples of a pitch about the recording's origin. Rotations are the three
// components of the unit quaternion other than a `dropped` one, which is kept positive and follows
// from the unit length; it changes only when it has become small, so that the others stay smooth in
// time. A contact point is seven integers (ContactField); sizes that span decades are kept as
// logarithms.
//
// Quantising is told the prediction and keeps to it while that is within three quarters of a pitch:
// noise below the pitch is not recorded, and no error adds up. Decoding gives back exactly the
// integers that were coded, so thinning a recording (decode, drop, code again) loses nothing but
// the frames.
//
// The page's twin of the decoder is web/replay/decode.js.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/types.h"

namespace cairn::scene {

using Bytes = std::vector<std::uint8_t>;

// Unsigned integers, seven bits a byte, the low ones first; signed ones zigzag (0, -1, 1, -2 ...).
void put_varint(Bytes& out, std::uint64_t value);
void put_signed(Bytes& out, std::int64_t value);

// Reads what put_* wrote; past the end it answers 0 and `failed` becomes true.
class ByteReader {
public:
    explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
    std::uint64_t varint();
    std::int64_t signed_varint();
    bool at_end() const { return next_ == bytes_.size(); }
    bool failed() const { return failed_; }

private:
    std::span<const std::uint8_t> bytes_;
    std::size_t next_ = 0;
    bool failed_ = false;
};

struct LatticePose {
    std::array<std::int64_t, 3> position = {};
    std::array<std::int32_t, 3> rotation =
        {};                    // components in the order x, y, z, w without `dropped`
    std::uint8_t dropped = 3;  // 0..3: x, y, z, w
    friend bool operator==(const LatticePose&, const LatticePose&) = default;
};

// What the integers mean.
struct Lattice {
    Position origin = {};
    double position_pitch = 1;   // m
    double rotation_pitch = 1;   // of a quaternion's component
    double contact_pitch = 1;    // m, of contact points
    double separation_unit = 1;  // m: separations below it are told apart linearly, above by ratio
    double impulse_unit = 1;     // N s, likewise
};

Position decode_position(const Lattice& lattice, const LatticePose& pose);
Quat decode_rotation(const Lattice& lattice, const LatticePose& pose);

// The poses of all bodies, frame after frame: one coder writes a stream, another, fresh one reads
// it.
class PoseCoder {
public:
    PoseCoder(const Lattice& lattice, std::size_t body_count);
    // The lattice pose to code for this body in the next frame.
    LatticePose quantise(std::size_t body, const Position& position, const Quat& rotation) const;
    void encode(std::span<const LatticePose> frame, Bytes& out);
    // False where the bytes are not what encode() wrote for as many bodies.
    bool decode(ByteReader& in, std::vector<LatticePose>& frame);

private:
    LatticePose predict(std::size_t body) const;
    void remember(std::span<const LatticePose> frame);

    Lattice lattice_;
    std::vector<LatticePose> last_, before_;
    bool fresh_ = true;
};

enum ContactField : std::uint8_t {
    PointX,
    PointY,
    PointZ,
    NormalU,  // octahedral, -normal_steps..normal_steps
    NormalV,
    Separation,  // sign and logarithm
    Impulse,     // logarithm
};
inline constexpr std::size_t contact_field_count = 7;
inline constexpr int normal_steps = 2047;
// Sixteen steps an octave: a size is kept to within 3.3 per cent.
inline constexpr double log_steps = 16;

struct LatticeContact {
    std::uint32_t body_a = 0, body_b = 0;
    std::array<std::int64_t, contact_field_count> fields = {};
    friend bool operator==(const LatticeContact&, const LatticeContact&) = default;
};

// A contact point as the world reports it.
struct ContactSample {
    std::uint32_t body_a = 0, body_b = 0;
    Position position = {};
    Vec3 normal = {};
    float separation = 0;
    float impulse = 0;
};

std::int64_t encode_log(double value, double unit, std::int64_t previous);
double decode_log(std::int64_t code, double unit);
std::array<std::int64_t, 2> encode_normal(const Vec3& normal);
Vec3 decode_normal(std::int64_t u, std::int64_t v);

// The contact points of all bodies, frame after frame, in the order of their bodies.
class ContactCoder {
public:
    explicit ContactCoder(const Lattice& lattice) : lattice_(lattice) {}
    // Sorts by bodies (points of one pair keep their order) and quantises against the last frame.
    std::vector<LatticeContact> quantise(std::vector<ContactSample> contacts) const;
    void encode(std::span<const LatticeContact> frame, Bytes& out);
    bool decode(ByteReader& in, std::vector<LatticeContact>& frame);

private:
    Lattice lattice_;
    std::vector<LatticeContact> last_;
};

}  // namespace cairn::scene
