// Reads the recording inside the page: the twin of src/scene/replay_codec.cpp, where the format is
// told.
//
// cairn.read_recording(bytes) gives the header, the figures of every frame as typed arrays, and
// pose(frame) and contacts(frame) for any frame in any order. Frames are coded as differences, so
// one pass over the whole stream at the start leaves a checkpoint every so many frames to go on
// from.
// Positions are in metres about header.lattice.origin: binary32 is enough there, however far the
// scene.
"use strict";
(function (cairn) {
  const POSE_INTERVAL = 64; // frames between checkpoints: a jump decodes at most as many
  const CONTACT_INTERVAL = 16;
  const NOT_KEPT = 0xffffffff;
  const KEPT_FRAMES = 12; // decoded frames that stay at hand

  class ByteCursor {
    constructor(bytes, at) {
      this.bytes = bytes;
      this.at = at;
    }

    varint() {
      const bytes = this.bytes;
      let byte = bytes[this.at++];
      if (byte < 0x80) return byte;
      let value = byte & 0x7f,
        scale = 128;
      do {
        byte = bytes[this.at++];
        value += (byte & 0x7f) * scale; // not by shifts: values reach beyond 32 bits
        scale *= 128;
      } while (byte >= 0x80);
      return value;
    }

    signed() {
      const value = this.varint();
      return value % 2 === 0 ? value / 2 : -(value + 1) / 2;
    }
  }

  class PoseStream {
    constructor(bytes, start, body_count) {
      this.in = new ByteCursor(bytes, start);
      this.frame = -1;
      this.position = new Float64Array(3 * body_count);
      this.old_position = new Float64Array(3 * body_count);
      this.rotation = new Float64Array(3 * body_count);
      this.old_rotation = new Float64Array(3 * body_count);
      this.dropped = new Uint8Array(body_count).fill(3);
    }

    next() {
      this.go_straight_on(this.position, this.old_position);
      this.go_straight_on(this.rotation, this.old_rotation);
      const { position, rotation, dropped } = this,
        n = dropped.length,
        input = this.in;
      for (let body = 0; body < n; ++body) {
        const entry = input.varint(),
          what = entry % 4;
        body += (entry - what) / 4;
        if (body >= n) break;
        const at = 3 * body;
        if (what === 0) {
          dropped[body] = input.varint();
          for (let i = 0; i < 3; ++i) position[at + i] = input.signed();
          for (let i = 0; i < 3; ++i) {
            this.old_rotation[at + i] = rotation[at + i] = input.signed();
          }
        } else {
          if (what !== 2) for (let i = 0; i < 3; ++i) position[at + i] += input.signed();
          if (what !== 1) for (let i = 0; i < 3; ++i) rotation[at + i] += input.signed();
        }
      }
      if (++this.frame === 0) {
        this.old_position.set(position);
        this.old_rotation.set(rotation);
      }
    }

    go_straight_on(now, old) {
      for (let i = 0; i < now.length; ++i) {
        const next = 2 * now[i] - old[i];
        old[i] = now[i];
        now[i] = next;
      }
    }

    copy_from(other) {
      this.in.at = other.in.at;
      this.frame = other.frame;
      for (const key of ["position", "old_position", "rotation", "old_rotation", "dropped"]) {
        this[key].set(other[key]);
      }
    }

    copy() {
      const twin = new PoseStream(this.in.bytes, 0, this.dropped.length);
      twin.copy_from(this);
      return twin;
    }
  }

  // One list of contact points: bodies a and b, and seven whole numbers each in `fields`.
  function next_contacts(input, old) {
    const count = input.varint();
    const a = new Uint32Array(count),
      b = new Uint32Array(count);
    const fields = new Float64Array(7 * count);
    let at = 0,
      from = 0,
      last_new = 0;
    while (at < count || from < old.a.length) {
      const run = input.varint(),
        what = run % 4,
        length = (run - what) / 4;
      if (length === 0) throw new Error("the recording's contacts are damaged");
      if (what === 3) {
        from += length;
        continue;
      }
      if (what === 0) {
        if (length === count && length === old.a.length) return old;
        a.set(old.a.subarray(from, from + length), at);
        b.set(old.b.subarray(from, from + length), at);
        fields.set(old.fields.subarray(7 * from, 7 * (from + length)), 7 * at);
        at += length;
        from += length;
        continue;
      }
      for (let i = 0; i < length; ++i, ++at) {
        if (what === 2) {
          last_new = a[at] = last_new + input.signed();
          b[at] = input.varint();
          for (let k = 0; k < 7; ++k) fields[7 * at + k] = input.signed();
        } else {
          a[at] = old.a[from];
          b[at] = old.b[from];
          for (let k = 0; k < 7; ++k)
            fields[7 * at + k] = old.fields[7 * from + k] + input.signed();
          ++from;
        }
      }
    }
    return { a, b, fields };
  }

  class Recording {
    constructor(bytes) {
      const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
      if (String.fromCharCode(...bytes.subarray(0, 4)) !== "CRN1") {
        throw new Error("this page's recording is damaged: it does not begin with CRN1");
      }
      const header_size = view.getUint32(4, true);
      this.header = JSON.parse(new TextDecoder().decode(bytes.subarray(8, 8 + header_size)));
      this.body_count = this.header.bodies.names.length;
      let at = Math.ceil((8 + header_size) / 8) * 8;
      const n = (this.frame_count = view.getUint32(at, true));
      at += 8;
      const column = (Type) => {
        const values = new Type(bytes.buffer, bytes.byteOffset + at, n);
        at += Type.BYTES_PER_ELEMENT * n;
        return values;
      };
      this.kinetic = column(Float64Array);
      this.potential = column(Float64Array);
      this.total = column(Float64Array);
      this.penetration = column(Float64Array);
      this.steps = column(Uint32Array);
      const pose_sizes = column(Uint32Array),
        contact_sizes = column(Uint32Array);
      this.times = Float64Array.from(this.steps, (step) => step * this.header.dt);
      const pose_bytes = pose_sizes.reduce((sum, size) => sum + size, 0);
      this.scan_poses(bytes, at);
      this.scan_contacts(bytes, at + pose_bytes, contact_sizes);
    }

    scan_poses(bytes, start) {
      this.kept = new Map();
      this.pose_stream = new PoseStream(bytes, start, this.body_count);
      this.pose_checkpoints = [];
      for (let frame = 0; frame < this.frame_count; ++frame) {
        this.pose_stream.next();
        if (frame % POSE_INTERVAL === 0) this.pose_checkpoints.push(this.pose_stream.copy());
      }
    }

    scan_contacts(bytes, start, sizes) {
      const input = (this.contact_input = new ByteCursor(bytes, start));
      this.contact_frame_of = new Int32Array(this.frame_count); // index in contact_frames
      this.contact_frames = [];
      this.contact_checkpoints = [];
      let list = { a: new Uint32Array(0), b: new Uint32Array(0), fields: new Float64Array(0) };
      for (let frame = 0; frame < this.frame_count; ++frame) {
        if (sizes[frame] !== NOT_KEPT) {
          list = next_contacts(input, list);
          if (this.contact_frames.length % CONTACT_INTERVAL === 0) {
            this.contact_checkpoints.push({ list, at: input.at });
          }
          this.contact_frames.push(frame);
        }
        this.contact_frame_of[frame] = this.contact_frames.length - 1;
      }
      this.contact_cache = new Map();
    }

    // {position: Float32Array of 3 a body, rotation: Float32Array of 4 a body}.
    pose(frame) {
      let found = this.kept.get(frame);
      if (found) {
        this.kept.delete(frame);
      } else {
        const stream = this.pose_stream;
        const checkpoint = this.pose_checkpoints[Math.floor(frame / POSE_INTERVAL)];
        if (stream.frame > frame || stream.frame < checkpoint.frame) stream.copy_from(checkpoint);
        while (stream.frame < frame) stream.next();
        found = this.read_pose(stream);
        if (this.kept.size >= KEPT_FRAMES) this.kept.delete(this.kept.keys().next().value);
      }
      this.kept.set(frame, found);
      return found;
    }

    read_pose(stream) {
      const n = this.body_count,
        lattice = this.header.lattice;
      const position = new Float32Array(3 * n),
        rotation = new Float32Array(4 * n);
      for (let i = 0; i < 3 * n; ++i) position[i] = stream.position[i] * lattice.position_pitch;
      for (let body = 0; body < n; ++body) {
        const dropped = stream.dropped[body];
        let rest = 1,
          next = 3 * body;
        for (let i = 0; i < 4; ++i) {
          if (i === dropped) continue;
          const value = stream.rotation[next++] * lattice.rotation_pitch;
          rotation[4 * body + i] = value;
          rest -= value * value;
        }
        rotation[4 * body + dropped] = Math.sqrt(Math.max(rest, 0));
      }
      return { position, rotation };
    }

    // The contact points of the frame, or of the last one before it whose contacts were kept:
    // {frame, a, b, point (3 each), normal (3 each), separation, impulse}.
    contacts(frame) {
      const index = this.contact_frame_of[frame];
      if (index < 0) return null;
      let found = this.contact_cache.get(index);
      if (found) return found;
      const { list, at } = this.contact_checkpoints[Math.floor(index / CONTACT_INTERVAL)];
      let now = list;
      this.contact_input.at = at;
      for (let i = 0; i < index % CONTACT_INTERVAL; ++i)
        now = next_contacts(this.contact_input, now);
      found = this.read_contacts(now, this.contact_frames[index]);
      if (this.contact_cache.size >= 4) {
        this.contact_cache.delete(this.contact_cache.keys().next().value);
      }
      this.contact_cache.set(index, found);
      return found;
    }

    read_contacts({ a, b, fields }, frame) {
      const n = a.length,
        lattice = this.header.lattice;
      const point = new Float32Array(3 * n),
        normal = new Float32Array(3 * n);
      const separation = new Float32Array(n),
        impulse = new Float32Array(n);
      const from_log = (code, unit) =>
        Math.sign(code) * unit * (Math.pow(2, Math.abs(code) / lattice.log_steps) - 1);
      for (let i = 0; i < n; ++i) {
        const f = 7 * i;
        for (let k = 0; k < 3; ++k) point[3 * i + k] = fields[f + k] * lattice.contact_pitch;
        let u = fields[f + 3] / lattice.normal_steps,
          v = fields[f + 4] / lattice.normal_steps;
        const z = 1 - Math.abs(u) - Math.abs(v);
        if (z < 0) {
          const unfolded = (1 - Math.abs(v)) * (u < 0 ? -1 : 1);
          v = (1 - Math.abs(u)) * (v < 0 ? -1 : 1);
          u = unfolded;
        }
        const length = Math.hypot(u, v, z);
        normal[3 * i] = u / length;
        normal[3 * i + 1] = v / length;
        normal[3 * i + 2] = z / length;
        separation[i] = from_log(fields[f + 5], lattice.separation_unit);
        impulse[i] = from_log(fields[f + 6], lattice.impulse_unit);
      }
      return { frame, a, b, point, normal, separation, impulse };
    }

    frame_at(time) {
      let low = 0,
        high = this.frame_count - 1;
      while (low < high) {
        const middle = (low + high + 1) >> 1;
        if (this.times[middle] <= time) low = middle;
        else high = middle - 1;
      }
      return low;
    }
  }

  cairn.decode_base64 = function (text) {
    const clean = text.trim();
    const padding = clean.endsWith("==") ? 2 : clean.endsWith("=") ? 1 : 0;
    const bytes = new Uint8Array((clean.length / 4) * 3 - padding);
    const piece = 1 << 20; // characters at a time: a whole multiple of four
    for (let start = 0, at = 0; start < clean.length; start += piece) {
      const binary = atob(clean.slice(start, start + piece));
      for (let i = 0; i < binary.length; ++i) bytes[at++] = binary.charCodeAt(i);
    }
    return bytes;
  };

  cairn.read_recording = (bytes) => new Recording(bytes);
})((globalThis.cairn = globalThis.cairn || {}));
