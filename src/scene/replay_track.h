#pragma once
// Which frames does a recording keep, and how does it stay within its size? Frames are coded as
// they come (replay_codec.h); when the whole outgrows its budget, every second frame goes, or,
// where the contacts take most of the room, every second frame's contacts.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/replay_codec.h"

namespace cairn::scene {

// What the page plots and shows for a frame.
struct FrameFigures {
    std::uint32_t step = 0;
    double kinetic = 0, potential = 0, total = 0;  // J
    double penetration = 0;                        // m, the deepest, >= 0
};

class ReplayTrack {
public:
    // `budget` bytes for poses, contacts and figures together; the thinning never goes below two
    // frames.
    ReplayTrack(const Lattice& lattice, std::size_t body_count, std::size_t budget);

    // Whether the frame of this step would be kept; the last one of a run always is.
    bool wants(std::uint64_t step) const { return step % stride_ == 0; }
    void add(const FrameFigures& figures, std::span<const Position> positions,
             std::span<const Quat> rotations, std::vector<ContactSample> contacts, bool is_last);

    std::size_t frame_count() const { return frames_.size(); }
    std::uint64_t stride() const { return stride_; }
    std::uint64_t contact_stride() const { return contact_stride_; }
    std::size_t byte_count() const;
    const Lattice& lattice() const { return lattice_; }

    // Frame count u32, 0 u32; then, one array after the other over all frames, little-endian:
    // kinetic, potential, total, penetration f64; step, bytes of pose, bytes of contacts (2^32 - 1:
    // not kept) u32; then all pose bytes, all contact bytes. To stand at a multiple of eight.
    void append_to(Bytes& out) const;

private:
    struct Frame {
        FrameFigures figures;
        bool is_last = false;
        std::size_t pose_size = 0;
        std::optional<std::size_t> contact_size;
        bool belongs_to(std::uint64_t stride) const {
            return is_last || figures.step % stride == 0;
        }
    };
    bool is_over_budget() const;
    void thin_out();
    void keep_poses_of(std::uint64_t stride);
    void keep_contacts_of(std::uint64_t stride);

    Lattice lattice_;
    std::size_t body_count_;
    std::size_t budget_;
    std::uint64_t stride_ = 1;
    std::uint64_t contact_stride_ = 1;
    PoseCoder pose_coder_;
    ContactCoder contact_coder_;
    std::vector<Frame> frames_;
    Bytes poses_, contacts_;
};

void put_u32(Bytes& out, std::uint32_t value);
void put_f64(Bytes& out, double value);

}  // namespace cairn::scene
