// globalThis.cairn_replay: the player for tests, and for people with a console open.
//
//   frame_count, frame, time, step, body_count, playing, selected, header, ready
//   go_to_frame(n), go_to_time(seconds), step_frames(n), play(), pause(), set_speed(x)
//   body(n): {name, kind, position, rotation, velocity, spin}    at the frame shown
//   find(name), select(n), pick(x, y), screen_position(n): [x, y] in CSS pixels
//   contacts(): [{bodies, position, normal, separation, impulse}]
//   set(option, on)    contacts, normals, velocities, speeds, follow, trail, plots, loop
//   draw()             draws at once
"use strict";
(function (cairn) {
  cairn.make_api = function (player) {
    const { recording, header, stage } = player,
      origin = header.lattice.origin;
    const world = (v) => [v.x + origin[0], v.y + origin[1], v.z + origin[2]];
    const list = (array, i, n) => Array.from(array.subarray(n * i, n * i + n));
    return {
      get ready() {
        return true;
      },
      get frame_count() {
        return recording.frame_count;
      },
      get body_count() {
        return recording.body_count;
      },
      get frame() {
        return player.frame;
      },
      get time() {
        return player.time;
      },
      get step() {
        return recording.steps[player.frame];
      },
      get playing() {
        return player.playing;
      },
      get selected() {
        return player.selected;
      },
      header,
      go_to_frame: (n) => player.go_to_frame(n),
      go_to_time: (t) => player.go_to_time(t),
      step_frames: (n) => player.step_frames(n),
      play: () => player.play(),
      pause: () => player.pause(),
      set_speed: (x) => {
        player.speed = x;
      },
      set: (option, on) => player.set(option, on),
      select: (n) => player.select(n),
      find: (name) => header.bodies.names.indexOf(name),
      pick: (x, y) => player.pick(x, y).body,
      draw: () => {
        player.orbit.advance(1);
        player.draw();
      },
      body: (n) => {
        const pose = recording.pose(player.frame),
          ends = player.motion.ends(player.frame),
          p = list(pose.position, n, 3);
        return {
          name: header.bodies.names[n],
          kind: header.bodies.kinds[n],
          position: p.map((v, k) => v + origin[k]),
          rotation: list(pose.rotation, n, 4),
          velocity: player.motion.velocity(n, ends).toArray(),
          spin: player.motion.spin(n, ends).toArray(),
        };
      },
      screen_position: (n) => {
        const at = player.motion.centre_of_mass(player.pose(), n).project(stage.camera);
        return [((at.x + 1) / 2) * stage.viewport.x, ((1 - at.y) / 2) * stage.viewport.y];
      },
      contacts: () => {
        const c = recording.contacts(player.frame);
        return c
          ? Array.from(c.a, (a, i) => ({
              bodies: [header.bodies.names[a], header.bodies.names[c.b[i]]],
              position: world(new THREE.Vector3(...list(c.point, i, 3))),
              normal: list(c.normal, i, 3),
              separation: c.separation[i],
              impulse: c.impulse[i],
            }))
          : [];
      },
    };
  };
})((globalThis.cairn = globalThis.cairn || {}));
