// Does a recording stay within its budget, and is what it keeps still right?

#include "scene/replay_track.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

using namespace cairn;
using namespace cairn::scene;

namespace {

Lattice test_lattice() { return {{}, std::exp2(-13), std::exp2(-14), std::exp2(-10), 1e-6, 1e-3}; }

// A small generator of its own: results must not hang on a library's.
struct Noise {
    std::uint32_t state = 1;
    double next() {
        state = state * 1664525u + 1013904223u;
        return static_cast<double>(state >> 8) / 16777216.0 - 0.5;
    }
};

std::uint32_t read_u32(const Bytes& bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
}

struct Written {
    std::vector<std::uint32_t> steps, pose_sizes, contact_sizes;
    std::size_t poses_at = 0;
    Bytes bytes;
};

Written write_out(const ReplayTrack& track) {
    Written w;
    track.append_to(w.bytes);
    const std::size_t n = read_u32(w.bytes, 0);
    std::size_t at = 8 + 4 * 8 * n;
    for (auto* column : {&w.steps, &w.pose_sizes, &w.contact_sizes}) {
        for (std::size_t i = 0; i < n; ++i, at += 4) column->push_back(read_u32(w.bytes, at));
    }
    w.poses_at = at;
    return w;
}

// Bodies that shake beyond all prediction, each with a contact that does too.
void shake(ReplayTrack& track, std::size_t bodies, std::uint32_t steps, std::uint32_t first = 0) {
    Noise noise;
    std::vector<Position> positions(bodies);
    std::vector<Quat> rotations(bodies);
    for (std::uint32_t step = first; step <= steps; ++step) {
        std::vector<ContactSample> contacts;
        for (std::size_t i = 0; i < bodies; ++i) {
            // The first coordinate tells the step, so that what is kept can be checked.
            positions[i] = {0.5 * step, noise.next(), noise.next()};
            contacts.push_back({static_cast<std::uint32_t>(i), 0, positions[i], {0, 1, 0}, 0, 1});
        }
        const bool is_last = step == steps;
        if (track.wants(step) || is_last)
            track.add({step}, positions, rotations, contacts, is_last);
    }
}

}  // namespace

TEST_CASE(
    "a recording that outgrows its budget thins out to fit, keeps its first and last step, and "
    "tells the truth") {
    constexpr std::size_t budget = 60000;
    ReplayTrack track(test_lattice(), 20, budget);
    shake(track, 20, 3001);
    CHECK(track.byte_count() <= budget);
    CHECK(track.stride() > 1);

    const Written w = write_out(track);
    REQUIRE(w.bytes.size() == track.byte_count());
    CHECK(w.steps.front() == 0);
    CHECK(w.steps.back() == 3001);
    CHECK(w.steps.size() >= 20);

    PoseCoder reader(test_lattice(), 20);
    ByteReader in(std::span(w.bytes).subspan(w.poses_at));
    std::vector<LatticePose> frame;
    for (const std::uint32_t step : w.steps) {
        REQUIRE(reader.decode(in, frame));
        for (const LatticePose& pose : frame) {
            CHECK(std::abs(decode_position(test_lattice(), pose).x - 0.5 * step) <= std::exp2(-13));
        }
    }
    ContactCoder contact_reader(test_lattice());
    std::vector<LatticeContact> contacts;
    std::size_t frames_with_contacts = 0;
    for (std::size_t i = 0; i < w.steps.size(); ++i) {
        if (w.contact_sizes[i] == 0xffffffffu) continue;
        ++frames_with_contacts;
        REQUIRE(contact_reader.decode(in, contacts));
        REQUIRE(contacts.size() == 20);
        for (const LatticeContact& contact : contacts) {
            const double x = static_cast<double>(contact.fields[PointX]) * std::exp2(-10);
            CHECK(std::abs(x - 0.5 * w.steps[i]) <= std::exp2(-10));
        }
    }
    CHECK(in.at_end());
    CHECK(frames_with_contacts >= 5);
}

TEST_CASE("the last step stays, also where adding it is what thins the recording out") {
    for (std::uint32_t steps = 101; steps < 300; steps += 2) {
        ReplayTrack track(test_lattice(), 4, 6000);
        shake(track, 4, steps);
        CHECK(write_out(track).steps.back() == steps);
    }
}

TEST_CASE("where contacts take the room, contacts go first") {
    ReplayTrack track(test_lattice(), 2, 120000);
    std::vector<Position> positions(2);
    std::vector<Quat> rotations(2);
    Noise noise;
    for (std::uint32_t step = 0; step <= 1000; ++step) {
        std::vector<ContactSample> contacts;
        for (int k = 0; k < 50; ++k) {
            contacts.push_back({0, 1, {noise.next(), noise.next(), noise.next()}, {0, 1, 0}, 0, 1});
        }
        if (track.wants(step)) track.add({step}, positions, rotations, contacts, step == 1000);
    }
    CHECK(track.stride() == 1);
    CHECK(track.contact_stride() > 1);
    CHECK(track.byte_count() <= 120000);
    const Written w = write_out(track);
    CHECK(w.steps.size() == 1001);
    CHECK(w.contact_sizes.front() != 0xffffffffu);
    CHECK(w.contact_sizes.back() != 0xffffffffu);
    CHECK(w.contact_sizes[1] == 0xffffffffu);
}

TEST_CASE(
    "five thousand bodies that never rest, for a minute, take less than the budget of a page") {
    constexpr std::size_t budget = 20'000'000;
    ReplayTrack track(test_lattice(), 5000, budget);
    shake(track, 5000, 3600);
    CHECK(track.byte_count() <= budget);
    CHECK(track.frame_count() >= 60);
    MESSAGE(track.frame_count() << " frames of 3601 kept in " << track.byte_count() << " bytes");
}

TEST_CASE("a very long run of one body keeps a bounded number of frames") {
    ReplayTrack track(test_lattice(), 1, 20'000'000);
    const std::vector<Position> positions(1);
    const std::vector<Quat> rotations(1);
    for (std::uint32_t step = 0; step <= 200'000; ++step) {
        if (track.wants(step)) track.add({step}, positions, rotations, {}, step == 200'000);
    }
    CHECK(track.frame_count() <= 36'000);
    CHECK(track.frame_count() > 18'000);
}
