// The frames of a recording, and their thinning; see replay_track.h.

#include "scene/replay_track.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace cairn::scene {

namespace {

// Figures and the two sizes of a frame in the page.
constexpr std::size_t bytes_a_frame = 44;
// Ten minutes at 60 steps a second. Beyond, the plots have many frames to a pixel and the page's
// index of them costs more than it shows.
constexpr std::size_t most_frames = 36000;
constexpr std::uint32_t no_contacts = 0xffffffffu;

}  // namespace

void put_u32(Bytes& out, std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) {
        out.push_back(static_cast<std::uint8_t>(value >> shift));
    }
}

void put_f64(Bytes& out, double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    put_u32(out, static_cast<std::uint32_t>(bits));
    put_u32(out, static_cast<std::uint32_t>(bits >> 32));
}

ReplayTrack::ReplayTrack(const Lattice& lattice, std::size_t body_count, std::size_t budget)
    : lattice_(lattice),
      body_count_(body_count),
      budget_(budget),
      pose_coder_(lattice, body_count),
      contact_coder_(lattice) {}

void ReplayTrack::add(const FrameFigures& figures, std::span<const Position> positions,
                      std::span<const Quat> rotations, std::vector<ContactSample> contacts,
                      bool is_last) {
    Frame frame{figures, is_last, poses_.size(), {}};
    std::vector<LatticePose> poses(body_count_);
    for (std::size_t body = 0; body < body_count_; ++body) {
        poses[body] = pose_coder_.quantise(body, positions[body], rotations[body]);
    }
    pose_coder_.encode(poses, poses_);
    frame.pose_size = poses_.size() - frame.pose_size;

    if (frame.belongs_to(contact_stride_)) {
        const std::size_t start = contacts_.size();
        contact_coder_.encode(contact_coder_.quantise(std::move(contacts)), contacts_);
        frame.contact_size = contacts_.size() - start;
    }
    frames_.push_back(frame);
    while (is_over_budget()) thin_out();
}

std::size_t ReplayTrack::byte_count() const {
    return 8 + frames_.size() * bytes_a_frame + poses_.size() + contacts_.size();
}

bool ReplayTrack::is_over_budget() const {
    return frames_.size() > 2 && (byte_count() > budget_ || frames_.size() > most_frames);
}

void ReplayTrack::thin_out() {
    // Motion matters more than the dots on it: contacts may take no more than half.
    const bool too_many_frames = frames_.size() > most_frames;
    const std::size_t room_for_contacts = budget_ / 2;
    if (!too_many_frames && contacts_.size() > room_for_contacts) {
        keep_contacts_of(contact_stride_ * 2);
    } else {
        keep_poses_of(stride_ * 2);
    }
}

void ReplayTrack::keep_poses_of(std::uint64_t stride) {
    PoseCoder reader(lattice_, body_count_), writer(lattice_, body_count_);
    ByteReader in(poses_);
    std::vector<LatticePose> poses;
    Bytes kept_bytes;
    std::vector<Frame> kept;
    for (Frame frame : frames_) {
        reader.decode(in, poses);
        // A frame that goes leaves its contacts' bytes behind: keep_contacts_of reads past them.
        if (!frame.belongs_to(stride)) {
            frame.pose_size = 0;
        } else {
            const std::size_t start = kept_bytes.size();
            writer.encode(poses, kept_bytes);
            frame.pose_size = kept_bytes.size() - start;
        }
        kept.push_back(frame);
    }
    stride_ = stride;
    poses_ = std::move(kept_bytes);
    pose_coder_ = std::move(writer);
    frames_ = std::move(kept);
    keep_contacts_of(std::max(contact_stride_, stride));
    std::erase_if(frames_, [&](const Frame& frame) { return !frame.belongs_to(stride); });
}

void ReplayTrack::keep_contacts_of(std::uint64_t stride) {
    ContactCoder reader(lattice_), writer(lattice_);
    ByteReader in(contacts_);
    std::vector<LatticeContact> contacts;
    Bytes kept_bytes;
    for (Frame& frame : frames_) {
        if (!frame.contact_size) continue;
        reader.decode(in, contacts);
        frame.contact_size.reset();
        if (!frame.belongs_to(stride)) continue;
        const std::size_t start = kept_bytes.size();
        writer.encode(contacts, kept_bytes);
        frame.contact_size = kept_bytes.size() - start;
    }
    contact_stride_ = stride;
    contacts_ = std::move(kept_bytes);
    contact_coder_ = std::move(writer);
}

void ReplayTrack::append_to(Bytes& out) const {
    put_u32(out, static_cast<std::uint32_t>(frames_.size()));
    put_u32(out, 0);
    for (const Frame& frame : frames_) put_f64(out, frame.figures.kinetic);
    for (const Frame& frame : frames_) put_f64(out, frame.figures.potential);
    for (const Frame& frame : frames_) put_f64(out, frame.figures.total);
    for (const Frame& frame : frames_) put_f64(out, frame.figures.penetration);
    for (const Frame& frame : frames_) put_u32(out, frame.figures.step);
    for (const Frame& frame : frames_) put_u32(out, static_cast<std::uint32_t>(frame.pose_size));
    for (const Frame& frame : frames_) {
        const auto size = frame.contact_size;
        put_u32(out, size ? static_cast<std::uint32_t>(*size) : no_contacts);
    }
    out.insert(out.end(), poses_.begin(), poses_.end());
    out.insert(out.end(), contacts_.begin(), contacts_.end());
}

}  // namespace cairn::scene
