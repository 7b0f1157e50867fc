// How do bodies move? Poses between two frames, and velocities, which the recording does not hold:
// they are taken from the change of pose over the step that led to a frame.
"use strict";
(function (cairn) {
  class Motion {
    constructor(recording) {
      this.recording = recording;
    }

    // The pose at that time, from `frame` on: the frame's, or the way to the next.
    pose(frame, time) {
      const { recording } = this,
        a = recording.pose(frame);
      const span =
        frame + 1 < recording.frame_count ? recording.times[frame + 1] - recording.times[frame] : 0;
      const share = span > 0 ? (time - recording.times[frame]) / span : 0;
      if (share < 1e-6) return a;
      const b = recording.pose(frame + 1),
        out =
          this.between ||
          (this.between = {
            position: new Float32Array(a.position.length),
            rotation: new Float32Array(a.rotation.length),
          });
      const p = out.position,
        q = out.rotation;
      for (let i = 0; i < p.length; ++i)
        p[i] = a.position[i] + share * (b.position[i] - a.position[i]);
      for (let i = 0; i < q.length; i += 4) {
        const from = a.rotation,
          to = b.rotation;
        const dot =
          from[i] * to[i] +
          from[i + 1] * to[i + 1] +
          from[i + 2] * to[i + 2] +
          from[i + 3] * to[i + 3];
        const toward = dot < 0 ? -share : share;
        for (let k = i; k < i + 4; ++k) q[k] = (1 - share) * from[k] + toward * to[k];
        const length = Math.hypot(q[i], q[i + 1], q[i + 2], q[i + 3]) || 1;
        for (let k = i; k < i + 4; ++k) q[k] /= length;
      }
      return out;
    }

    // Where the body's center of mass is in that pose.
    centre_of_mass({ position, rotation }, body) {
      const local = this.recording.header.bodies.center_of_mass[body];
      const at = new THREE.Vector3(
        position[3 * body],
        position[3 * body + 1],
        position[3 * body + 2],
      );
      if (!local) return at;
      const turn = new THREE.Quaternion(...rotation.subarray(4 * body, 4 * body + 4));
      return at.add(new THREE.Vector3(...local).applyQuaternion(turn));
    }

    // The two frames whose difference is the motion at this one: the step that led here, as a step
    // moves bodies by the velocity that it ends with.
    ends(frame) {
      const last = frame > 0 ? frame : Math.min(1, this.recording.frame_count - 1);
      const first = Math.max(last - 1, 0),
        seconds = this.recording.times[last] - this.recording.times[first];
      return { a: this.recording.pose(first), b: this.recording.pose(last), seconds };
    }

    // Of the center of mass, m/s; `ends` are a frame's.
    velocity(body, { a, b, seconds }) {
      if (!(seconds > 0)) return new THREE.Vector3();
      return this.centre_of_mass(b, body).sub(this.centre_of_mass(a, body)).divideScalar(seconds);
    }

    // rad/s, about world axes.
    spin(body, { a, b, seconds }) {
      const from = new THREE.Quaternion(...a.rotation.subarray(4 * body, 4 * body + 4));
      const turn = new THREE.Quaternion(...b.rotation.subarray(4 * body, 4 * body + 4)).multiply(
        from.conjugate(),
      );
      if (turn.w < 0) turn.set(-turn.x, -turn.y, -turn.z, -turn.w);
      const axis = new THREE.Vector3(turn.x, turn.y, turn.z),
        sine = axis.length();
      if (!(seconds > 0) || sine < 1e-9) return new THREE.Vector3();
      return axis.multiplyScalar((2 * Math.atan2(sine, turn.w)) / sine / seconds);
    }

    // The speed at the warm end of the colours: what almost no body exceeds, in the whole
    // recording.
    speed_scale() {
      if (this.fastest) return this.fastest;
      const { recording } = this,
        all = [],
        every = Math.max(1, Math.ceil(recording.frame_count / 30));
      const moving = [...this.recording.header.bodies.kinds].flatMap((k, i) =>
        k === "s" ? [] : [i],
      );
      const thin = Math.max(1, Math.ceil(moving.length / 1000));
      for (let f = 1; f < recording.frame_count; f += every) {
        const a = recording.pose(f - 1),
          b = recording.pose(f),
          seconds = recording.times[f] - recording.times[f - 1];
        for (let k = 0; k < moving.length; k += thin) {
          const i = 3 * moving[k],
            way = [0, 1, 2].map((j) => b.position[i + j] - a.position[i + j]);
          all.push(Math.hypot(...way) / seconds);
        }
      }
      all.sort((a, b) => a - b);
      this.fastest = Math.max(all.length ? all[Math.floor(0.99 * (all.length - 1))] : 0, 1e-3);
      return this.fastest;
    }
  }

  cairn.Motion = Motion;
})((globalThis.cairn = globalThis.cairn || {}));
