// Does a recording give back what was put in, to within its pitch, and what does rest cost?
//
// A thousand bodies fall, tumble and come to rest on paths known in closed form; the errors allowed
// are those that replay_codec.h promises.

#include "scene/replay_codec.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "cairn/math.h"
#include "scene/replay_page.h"

using namespace cairn;
using namespace cairn::scene;

namespace {

constexpr std::size_t body_count = 100;
constexpr double step_seconds = 1.0 / 60;

Lattice test_lattice() {
    return {{1000, 20, -3}, std::exp2(-13), std::exp2(-14), std::exp2(-10), 1e-6, 1e-3};
}

struct Placed {
    Position position;
    Quat rotation;
};

// Body i at time t: a parabola and a turn about a skew axis, until it stops at t = 1.
Placed place_body(std::size_t i, double t) {
    t = std::min(t, 1.0);
    const double k = static_cast<double>(i);
    const double angle = (0.3 + 0.1 * k) * t;
    const double s = std::sin(angle), c = std::cos(angle);
    return {{1000 + k + 2 * t, 20 + 3 * t - 4.905 * t * t, -3 - k * t},
            {static_cast<float>(0.6 * s), static_cast<float>(-0.64 * s),
             static_cast<float>(0.48 * s), static_cast<float>(c)}};
}

double distance(const Position& a, const Position& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

// The angle between two rotations, to first order.
double angle_between(const Quat& a, const Quat& b) {
    const auto wide = [](float x) { return static_cast<double>(x); };
    const double same = wide(a.x) * wide(b.x) + wide(a.y) * wide(b.y) + wide(a.z) * wide(b.z) +
                        wide(a.w) * wide(b.w);
    const double sign = same < 0 ? -1 : 1;
    const double dx = wide(a.x) - sign * wide(b.x), dy = wide(a.y) - sign * wide(b.y);
    const double dz = wide(a.z) - sign * wide(b.z), dw = wide(a.w) - sign * wide(b.w);
    return 2 * std::sqrt(dx * dx + dy * dy + dz * dz + dw * dw);
}

std::vector<LatticePose> quantise_all(const PoseCoder& coder, double t) {
    std::vector<LatticePose> frame(body_count);
    for (std::size_t i = 0; i < body_count; ++i) {
        const Placed placed = place_body(i, t);
        frame[i] = coder.quantise(i, placed.position, placed.rotation);
    }
    return frame;
}

}  // namespace

TEST_CASE("integers of every size come back as they were, signed or not") {
    Bytes bytes;
    const std::vector<std::int64_t> values = {
        0,   1,     -1,   63,        -64,          64,        127,
        128, -8191, 8192, 1ll << 46, -(1ll << 46), INT64_MAX, INT64_MIN};
    for (const std::int64_t value : values) put_signed(bytes, value);
    ByteReader in(bytes);
    for (const std::int64_t value : values) CHECK(in.signed_varint() == value);
    CHECK(in.at_end());
    CHECK_FALSE(in.failed());
    in.varint();
    CHECK(in.failed());
}

TEST_CASE(
    "a recorded pose is within three quarters of a pitch along each axis and 0.0005 rad of the "
    "true one") {
    const Lattice lattice = test_lattice();
    PoseCoder writer(lattice, body_count), reader(lattice, body_count);
    Bytes bytes;
    std::vector<std::vector<LatticePose>> coded;
    for (int step = 0; step <= 90; ++step) {
        coded.push_back(quantise_all(writer, step * step_seconds));
        writer.encode(coded.back(), bytes);
    }
    ByteReader in(bytes);
    std::vector<LatticePose> frame;
    double worst_distance = 0, worst_angle = 0;
    for (int step = 0; step <= 90; ++step) {
        REQUIRE(reader.decode(in, frame));
        REQUIRE(frame == coded[static_cast<std::size_t>(step)]);
        for (std::size_t i = 0; i < body_count; ++i) {
            const Placed truth = place_body(i, step * step_seconds);
            worst_distance = std::max(worst_distance,
                                      distance(decode_position(lattice, frame[i]), truth.position));
            worst_angle = std::max(
                worst_angle, angle_between(decode_rotation(lattice, frame[i]), truth.rotation));
        }
    }
    CHECK(in.at_end());
    CHECK(worst_distance <= 0.75 * std::sqrt(3.0) * lattice.position_pitch * 1.0001);
    CHECK(worst_angle <= 0.0005);
    MESSAGE("worst position " << worst_distance << " m, worst angle " << worst_angle << " rad");
}

TEST_CASE("a frame in which nothing moves takes two bytes, whatever the number of bodies") {
    PoseCoder writer(test_lattice(), body_count);
    Bytes bytes;
    for (int step = 0; step <= 70; ++step)
        writer.encode(quantise_all(writer, step * step_seconds), bytes);
    const std::size_t before = bytes.size();
    writer.encode(quantise_all(writer, 2.0), bytes);
    CHECK(bytes.size() - before <= 2);
}

TEST_CASE("noise of half a pitch about a place of rest is not recorded") {
    const Lattice lattice = test_lattice();
    PoseCoder writer(lattice, 1);
    Bytes bytes;
    for (int step = 0; step < 50; ++step) {
        // On both sides of the edge between two lattice points.
        const double noise = (step % 2 == 0 ? 0.3 : 0.7) * lattice.position_pitch;
        const LatticePose pose = writer.quantise(0, {1000 + noise, 20, -3}, {0, 0, 0, 1});
        writer.encode(std::vector{pose}, bytes);
    }
    CHECK(bytes.size() == 50);
}

TEST_CASE("a body beyond all bounds is pinned where a page can still tell it") {
    const PoseCoder writer(test_lattice(), 1);
    const LatticePose pose = writer.quantise(0, {1e300, -1e300, -3}, {0, 0, 0, 1});
    CHECK(pose.position[0] == 1ll << 46);
    CHECK(pose.position[1] == -(1ll << 46));
    CHECK(pose.position[2] == 0);
}

TEST_CASE("a pose stream that was cut short anywhere, or speaks of more bodies, is refused") {
    PoseCoder writer(test_lattice(), body_count);
    Bytes bytes;
    writer.encode(quantise_all(writer, 0.5), bytes);
    std::vector<LatticePose> frame;
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        PoseCoder reader(test_lattice(), body_count);
        ByteReader in(std::span<const std::uint8_t>(bytes).first(length));
        CHECK_FALSE(reader.decode(in, frame));
    }
    Bytes beyond;
    put_varint(beyond, (body_count + 1) << 2);
    PoseCoder reader(test_lattice(), body_count);
    ByteReader in(beyond);
    CHECK_FALSE(reader.decode(in, frame));
}

TEST_CASE("normals come back within a tenth of a degree, the axes exactly") {
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1}}) {
        const auto [u, v] = encode_normal(axis);
        CHECK(decode_normal(u, v) == axis);
    }
    double worst = 0;
    for (int i = 0; i < 4000; ++i) {
        // A spiral over the whole sphere.
        const double z = -1 + (2 * i + 1) / 4000.0, turn = 2.399963 * i, r = std::sqrt(1 - z * z);
        const Vec3 n = {static_cast<float>(r * std::cos(turn)),
                        static_cast<float>(r * std::sin(turn)), static_cast<float>(z)};
        const auto [u, v] = encode_normal(n);
        worst = std::max(worst, static_cast<double>(length(decode_normal(u, v) - n)));
    }
    CHECK(worst < 0.1 * 3.14159265 / 180);
}

TEST_CASE(
    "impulses keep to 3.3 per cent from a thousandth of the unit to a billion, and zero stays "
    "zero") {
    CHECK(decode_log(encode_log(0, 1e-3, 0), 1e-3) == 0);
    for (double value = 1e-3; value < 1e6; value *= 1.37) {
        const double back = decode_log(encode_log(-value, 1e-3, 0), 1e-3);
        CHECK(std::abs(back + value) <= 0.0331 * (value + 1e-3));
    }
}

TEST_CASE("contacts that come, stay, change and go are each found again at their frame") {
    const Lattice lattice = test_lattice();
    ContactCoder writer(lattice), reader(lattice);
    Bytes bytes;
    std::vector<std::vector<LatticeContact>> coded;
    for (int step = 0; step < 40; ++step) {
        std::vector<ContactSample> contacts;
        // Pairs in no order; the pair (9, 2) has two points; which pairs touch changes with the
        // step.
        for (std::uint32_t k = 0; k < 12; ++k) {
            if ((k * 7 + static_cast<std::uint32_t>(step) / 5) % 4 == 0) continue;
            const std::uint32_t a = (k * 5) % 12, b = k == 3 ? 2u : (k * 3 + 1) % 12;
            const double drift = k < 6 ? 0 : 0.01 * step;
            contacts.push_back({a, b, {1000.0 + k + drift, 20, -3}, {0, 1, 0}, -0.001f, 0.5f});
            if (k == 9) contacts.push_back({a, b, {1000.5 + k, 20, -3}, {0, 1, 0}, -0.002f, 1.5f});
        }
        coded.push_back(writer.quantise(contacts));
        // By bodies, which is how unchanged contacts are found again.
        CHECK(std::is_sorted(coded.back().begin(), coded.back().end(),
                             [](const LatticeContact& a, const LatticeContact& b) {
                                 return std::pair(a.body_a, a.body_b) <
                                        std::pair(b.body_a, b.body_b);
                             }));
        writer.encode(coded.back(), bytes);
    }
    ByteReader in(bytes);
    std::vector<LatticeContact> frame;
    for (const auto& expected : coded) {
        REQUIRE(reader.decode(in, frame));
        CHECK(frame == expected);
    }
    CHECK(in.at_end());
}

TEST_CASE("base64 is RFC 4648's, padding included") {
    const auto encode = [](std::string_view text) {
        return encode_base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    };
    CHECK(encode("") == "");
    CHECK(encode("f") == "Zg==");
    CHECK(encode("fo") == "Zm8=");
    CHECK(encode("foobar") == "Zm9vYmFy");
}

TEST_CASE("a title can neither end an element nor an attribute, and broken UTF-8 is replaced") {
    CHECK(escape_html("</script><b a=\"x\" b='y'>&") ==
          "&lt;/script&gt;&lt;b a=&quot;x&quot; b=&#39;y&#39;&gt;&amp;");
    CHECK(escape_html("caf\xc3\xa9 \xff\x01") == "caf\xc3\xa9 \xef\xbf\xbd");
}
