// The coding of poses and contacts described in replay_codec.h.
//
// A pose frame is a list of entries, each varint(quiet << 2 | what): so many bodies that go on as
// predicted, then one that does not. `what`: 1 position, 2 rotation, 3 both, as differences to the
// prediction; 0 both in full, the rotation with its dropped component. A quiet rest of a frame is
// an entry that stands one past the last body and has nothing after it.
//
// A contact frame is varint(point count), then runs, each varint(length << 2 | what) over the merge
// of the last frame's list with this one's by bodies: 0 unchanged, 1 changed (seven differences
// each), 2 new (body a as difference to the one before, body b, seven fields each), 3 gone.

#include "scene/replay_codec.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace cairn::scene {

namespace {

// Three quarters of a pitch: more than the half that rounding takes, so that noise at the edge
// between two lattice points does not flip back and forth.
constexpr double hysteresis = 0.75;
// The dropped component may shrink to this before another takes its place (the largest is never
// below 0.5); at this size its error is 2.3 times that of the others.
constexpr double smallest_dropped = 0.4;
// Beyond 2^46 pitches (five million kilometres at 0.1 mm) positions are pinned: the page reads
// binary64.
constexpr double largest_coordinate = 70368744177664.0;

enum RunKind : std::uint8_t { Unchanged, Changed, New, Gone };

double widen(float value) { return static_cast<double>(value); }

std::int64_t round_near(double value, std::int64_t predicted) {
    const double clamped = std::clamp(value, -largest_coordinate, largest_coordinate);
    const bool as_predicted = std::abs(clamped - static_cast<double>(predicted)) <= hysteresis;
    return as_predicted ? predicted : std::llround(clamped);
}

bool same_bodies(const LatticeContact& a, const LatticeContact& b) {
    return a.body_a == b.body_a && a.body_b == b.body_b;
}

bool stands_before(const LatticeContact& a, const LatticeContact& b) {
    return a.body_a != b.body_a ? a.body_a < b.body_a : a.body_b < b.body_b;
}

// Collects like neighbours of the merge into runs.
class RunWriter {
public:
    explicit RunWriter(Bytes& out) : out_(out) {}
    ~RunWriter() { flush(); }
    Bytes& add(RunKind kind) {
        if (kind != kind_) {
            flush();
            kind_ = kind;
        }
        ++length_;
        return payload_;
    }

private:
    void flush() {
        if (length_ > 0) put_varint(out_, length_ << 2 | kind_);
        out_.insert(out_.end(), payload_.begin(), payload_.end());
        payload_.clear();
        length_ = 0;
    }
    Bytes& out_;
    Bytes payload_;
    RunKind kind_ = Unchanged;
    std::uint64_t length_ = 0;
};

}  // namespace

void put_varint(Bytes& out, std::uint64_t value) {
    while (value >= 0x80) {
        out.push_back(static_cast<std::uint8_t>(value | 0x80));
        value >>= 7;
    }
    out.push_back(static_cast<std::uint8_t>(value));
}

void put_signed(Bytes& out, std::int64_t value) {
    put_varint(out,
               static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63));
}

std::uint64_t ByteReader::varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
        if (next_ == bytes_.size()) break;
        const std::uint8_t byte = bytes_[next_++];
        value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
        if (byte < 0x80) return value;
    }
    failed_ = true;
    return 0;
}

std::int64_t ByteReader::signed_varint() {
    const std::uint64_t value = varint();
    return static_cast<std::int64_t>(value >> 1 ^ (0 - (value & 1)));
}

Position decode_position(const Lattice& lattice, const LatticePose& pose) {
    const auto along = [&](double origin, std::int64_t steps) {
        return origin + static_cast<double>(steps) * lattice.position_pitch;
    };
    return {along(lattice.origin.x, pose.position[0]), along(lattice.origin.y, pose.position[1]),
            along(lattice.origin.z, pose.position[2])};
}

Quat decode_rotation(const Lattice& lattice, const LatticePose& pose) {
    std::array<double, 4> q = {};
    double rest = 1;
    std::size_t next = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        if (i == pose.dropped) continue;
        q[i] = pose.rotation[next++] * lattice.rotation_pitch;
        rest -= q[i] * q[i];
    }
    q[pose.dropped] = std::sqrt(std::max(rest, 0.0));
    return {static_cast<float>(q[0]), static_cast<float>(q[1]), static_cast<float>(q[2]),
            static_cast<float>(q[3])};
}

PoseCoder::PoseCoder(const Lattice& lattice, std::size_t body_count)
    : lattice_(lattice), last_(body_count), before_(body_count) {}

LatticePose PoseCoder::predict(std::size_t body) const {
    LatticePose pose = last_[body];
    for (std::size_t i = 0; i < 3; ++i) {
        pose.position[i] += last_[body].position[i] - before_[body].position[i];
        pose.rotation[i] += last_[body].rotation[i] - before_[body].rotation[i];
    }
    return pose;
}

LatticePose PoseCoder::quantise(std::size_t body, const Position& position,
                                const Quat& rotation) const {
    LatticePose pose = predict(body);
    const std::array<double, 3> offset = {position.x - lattice_.origin.x,
                                          position.y - lattice_.origin.y,
                                          position.z - lattice_.origin.z};
    for (std::size_t i = 0; i < 3; ++i) {
        pose.position[i] = round_near(offset[i] / lattice_.position_pitch, pose.position[i]);
    }

    const std::array<double, 4> q = {widen(rotation.x), widen(rotation.y), widen(rotation.z),
                                     widen(rotation.w)};
    const auto smaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
    if (std::abs(q[pose.dropped]) < smallest_dropped) {
        const auto largest = std::max_element(q.begin(), q.end(), smaller);
        pose.dropped = static_cast<std::uint8_t>(std::distance(q.begin(), largest));
    }
    const double sign = q[pose.dropped] < 0 ? -1 : 1;
    std::size_t next = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        if (i == pose.dropped) continue;
        const double steps = sign * q[i] / lattice_.rotation_pitch;
        pose.rotation[next] = static_cast<std::int32_t>(round_near(steps, pose.rotation[next]));
        ++next;
    }
    return pose;
}

void PoseCoder::encode(std::span<const LatticePose> frame, Bytes& out) {
    std::uint64_t quiet = 0;
    for (std::size_t body = 0; body < frame.size(); ++body) {
        const LatticePose& pose = frame[body];
        const LatticePose predicted = predict(body);
        if (pose == predicted) {
            ++quiet;
            continue;
        }
        const bool in_full = pose.dropped != predicted.dropped;
        const unsigned what = in_full ? 0u
                                      : (pose.position != predicted.position ? 1u : 0u) |
                                            (pose.rotation != predicted.rotation ? 2u : 0u);
        put_varint(out, quiet << 2 | what);
        quiet = 0;
        if (in_full) put_varint(out, pose.dropped);
        for (std::size_t i = 0; i < 3 && what != 2; ++i) {
            put_signed(out, pose.position[i] - (in_full ? 0 : predicted.position[i]));
        }
        for (std::size_t i = 0; i < 3 && what != 1; ++i) {
            put_signed(out, pose.rotation[i] - (in_full ? 0 : predicted.rotation[i]));
        }
    }
    if (quiet > 0) put_varint(out, quiet << 2);
    remember(frame);
}

bool PoseCoder::decode(ByteReader& in, std::vector<LatticePose>& frame) {
    frame.resize(last_.size());
    for (std::size_t body = 0; body < frame.size(); ++body) frame[body] = predict(body);
    for (std::size_t body = 0; body < frame.size(); ++body) {
        const std::uint64_t entry = in.varint();
        const std::uint64_t quiet = entry >> 2;
        if (in.failed() || quiet > frame.size() - body) return false;
        body += quiet;
        if (body == frame.size()) break;
        LatticePose& pose = frame[body];
        const unsigned what = entry & 3;
        if (what == 0) {
            pose = {};
            pose.dropped = static_cast<std::uint8_t>(in.varint() & 3);
        }
        for (std::size_t i = 0; i < 3 && what != 2; ++i) pose.position[i] += in.signed_varint();
        for (std::size_t i = 0; i < 3 && what != 1; ++i) {
            pose.rotation[i] += static_cast<std::int32_t>(in.signed_varint());
        }
    }
    remember(frame);
    return !in.failed();
}

void PoseCoder::remember(std::span<const LatticePose> frame) {
    before_.swap(last_);
    last_.assign(frame.begin(), frame.end());
    // The first frame has no course to go on with, and a rotation given in full starts a new one.
    if (fresh_) before_ = last_;
    fresh_ = false;
    for (std::size_t body = 0; body < last_.size(); ++body) {
        if (before_[body].dropped != last_[body].dropped)
            before_[body].rotation = last_[body].rotation;
    }
}

std::int64_t encode_log(double value, double unit, std::int64_t previous) {
    const double size = log_steps * std::log2(1 + std::abs(value) / unit);
    return round_near(value < 0 ? -size : size, previous);
}

double decode_log(std::int64_t code, double unit) {
    const double size = unit * (std::exp2(std::abs(static_cast<double>(code)) / log_steps) - 1);
    return code < 0 ? -size : size;
}

std::array<std::int64_t, 2> encode_normal(const Vec3& normal) {
    // The sphere's projection onto an octahedron, whose lower half is folded out over the corners.
    const double x = widen(normal.x), y = widen(normal.y), z = widen(normal.z);
    const double sum = std::max(std::abs(x) + std::abs(y) + std::abs(z), 1e-30);
    double u = x / sum, v = y / sum;
    if (z < 0) {
        const double folded = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
        v = (1 - std::abs(u)) * (v < 0 ? -1 : 1);
        u = folded;
    }
    return {std::llround(u * normal_steps), std::llround(v * normal_steps)};
}

Vec3 decode_normal(std::int64_t u_steps, std::int64_t v_steps) {
    double u = static_cast<double>(u_steps) / normal_steps;
    double v = static_cast<double>(v_steps) / normal_steps;
    const double z = 1 - std::abs(u) - std::abs(v);
    if (z < 0) {
        const double unfolded = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
        v = (1 - std::abs(u)) * (v < 0 ? -1 : 1);
        u = unfolded;
    }
    const double length = std::sqrt(u * u + v * v + z * z);
    return {static_cast<float>(u / length), static_cast<float>(v / length),
            static_cast<float>(z / length)};
}

std::vector<LatticeContact> ContactCoder::quantise(std::vector<ContactSample> contacts) const {
    std::stable_sort(contacts.begin(), contacts.end(), [](const auto& a, const auto& b) {
        return a.body_a != b.body_a ? a.body_a < b.body_a : a.body_b < b.body_b;
    });
    std::vector<LatticeContact> frame;
    frame.reserve(contacts.size());
    auto old = last_.begin();
    for (const ContactSample& contact : contacts) {
        LatticeContact coded{contact.body_a, contact.body_b, {}};
        while (old != last_.end() && stands_before(*old, coded)) ++old;
        const bool known = old != last_.end() && same_bodies(*old, coded);
        if (known) coded.fields = (old++)->fields;
        auto& fields = coded.fields;
        const Position& p = contact.position;
        const Position& o = lattice_.origin;
        fields[PointX] = round_near((p.x - o.x) / lattice_.contact_pitch, fields[PointX]);
        fields[PointY] = round_near((p.y - o.y) / lattice_.contact_pitch, fields[PointY]);
        fields[PointZ] = round_near((p.z - o.z) / lattice_.contact_pitch, fields[PointZ]);
        const auto normal = encode_normal(contact.normal);
        fields[NormalU] = normal[0];
        fields[NormalV] = normal[1];
        fields[Separation] =
            encode_log(widen(contact.separation), lattice_.separation_unit, fields[Separation]);
        fields[Impulse] =
            encode_log(widen(contact.impulse), lattice_.impulse_unit, fields[Impulse]);
        frame.push_back(coded);
    }
    return frame;
}

void ContactCoder::encode(std::span<const LatticeContact> frame, Bytes& out) {
    put_varint(out, frame.size());
    {
        RunWriter runs(out);
        auto old = last_.begin();
        std::uint32_t last_new = 0;
        for (const LatticeContact& contact : frame) {
            for (; old != last_.end() && stands_before(*old, contact); ++old) runs.add(Gone);
            if (old == last_.end() || !same_bodies(*old, contact)) {
                Bytes& payload = runs.add(New);
                put_signed(payload, static_cast<std::int64_t>(contact.body_a) - last_new);
                put_varint(payload, contact.body_b);
                for (const std::int64_t field : contact.fields) put_signed(payload, field);
                last_new = contact.body_a;
                continue;
            }
            if (*old == contact) {
                runs.add(Unchanged);
            } else {
                Bytes& payload = runs.add(Changed);
                for (std::size_t i = 0; i < contact_field_count; ++i) {
                    put_signed(payload, contact.fields[i] - old->fields[i]);
                }
            }
            ++old;
        }
        for (; old != last_.end(); ++old) runs.add(Gone);
    }
    last_.assign(frame.begin(), frame.end());
}

bool ContactCoder::decode(ByteReader& in, std::vector<LatticeContact>& frame) {
    frame.clear();
    const std::uint64_t count = in.varint();
    std::size_t old = 0;
    std::uint32_t last_new = 0;
    while (!in.failed() && (frame.size() < count || old < last_.size())) {
        const std::uint64_t run = in.varint();
        const auto kind = static_cast<RunKind>(run & 3);
        for (std::uint64_t i = 0; i < run >> 2 && !in.failed(); ++i) {
            if (kind != New && old == last_.size()) return false;
            LatticeContact contact = kind == New ? LatticeContact{} : last_[old++];
            if (kind == Gone) continue;
            if (kind == New) {
                contact.body_a = static_cast<std::uint32_t>(last_new + in.signed_varint());
                contact.body_b = static_cast<std::uint32_t>(in.varint());
                last_new = contact.body_a;
            }
            for (std::int64_t& field : contact.fields) {
                if (kind != Unchanged) field += in.signed_varint();
            }
            frame.push_back(contact);
        }
    }
    last_ = frame;
    return !in.failed() && frame.size() == count;
}

}  // namespace cairn::scene
