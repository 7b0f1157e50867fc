// The player: what moment is shown, and the page's life from its first to its last frame.
//
// Options after the address's #, joined by &: t=SECONDS or frame=N (start there), play=off,
// shadows=on|off, antialias=off, theme=light|dark, contacts=on, normals=on, velocities=on,
// speeds=on, ui=off, select=N, eye=X,Y,Z and target=X,Y,Z (another camera than the scene's, and
// exactly that).
"use strict";
(function (cairn) {
  const SWITCHES = ["contacts", "normals", "velocities", "speeds", "follow", "trail", "loop"];

  function read_options() {
    const given = new URLSearchParams(location.hash.slice(1));
    const dark = globalThis.matchMedia && matchMedia("(prefers-color-scheme: dark)").matches;
    return {
      given,
      theme: given.get("theme") || (dark ? "dark" : "light"),
      // null: the stage decides by who draws.
      shadows: given.has("shadows") ? given.get("shadows") !== "off" : null,
      antialias: given.get("antialias") !== "off",
    };
  }

  // Three numbers, or nothing.
  function read_point(text) {
    const numbers = (text || "").split(",").map(Number);
    return text && numbers.length === 3 && numbers.every(Number.isFinite) ? numbers : null;
  }

  class Player {
    constructor(recording) {
      this.recording = recording;
      this.header = recording.header;
      this.motion = new cairn.Motion(recording);
      this.options = read_options();
      const eye = read_point(this.options.given.get("eye")),
        target = read_point(this.options.given.get("target"));
      if (eye) this.header.camera.eye = eye;
      if (target) this.header.camera.target = target;
      this.camera_given = Boolean(eye || target);
      this.frame = 0;
      this.time = 0;
      this.speed = 1;
      this.playing = false;
      this.selected = -1;
      this.on = { plots: true };
      this.last_time = recording.times[recording.frame_count - 1];
      document.documentElement.dataset.theme = this.options.theme;
      this.canvas = document.querySelector("[data-stage]");
      this.stage = new cairn.Stage(this.canvas, recording, this.options);
      this.overlays = new cairn.Overlays(this.stage);
      this.overlays.set_theme(this.stage.theme);
      this.orbit = new cairn.Orbit(this.canvas, this.stage, {
        changed: () => this.redraw(),
        clicked: (x, y) => this.select(this.pick(x, y).body),
        double_clicked: (x, y) => this.approach(x, y),
      });
      this.panel = new cairn.Panel(document.querySelector("[data-panel]"), recording, {
        select: (body) => this.select(body),
        colour_of: (body) =>
          "#" + this.stage.own_colours[body].clone().convertLinearToSRGB().getHexString(),
      });
      this.plots = cairn.make_plots(
        {
          energy: document.querySelector("[data-plot=energy]"),
          penetration: document.querySelector("[data-plot=penetration]"),
        },
        recording,
      );
      this.controls = new cairn.Controls(this, this.actions());
      this.tell_scene();
      this.listen();
      this.begin();
    }

    tell_scene() {
      const { header } = this,
        set = (name, text) => {
          document.querySelector(`[data-${name}]`).textContent = text;
        };
      set("title", header.scene);
      set("description", header.description);
      set("settings", header.settings);
      const { stride, contact_stride, left_out } = header,
        notes = [];
      if (stride > 1) notes.push(`kept: 1 step in ${stride}`);
      if (contact_stride > stride) notes.push(`contacts of 1 step in ${contact_stride}`);
      if (left_out.bodies) notes.push(`${left_out.bodies} bodies not shown`);
      if (left_out.shapes) notes.push(`${left_out.shapes} shapes not shown`);
      set("notes", notes.join(", "));
      const marks = document.querySelector("[data-marks]");
      for (const event of (header.non_finite || []).slice(0, 50)) {
        const mark = document.createElement("i");
        mark.style.left = `${(100 * event.step * header.dt) / Math.max(this.last_time, header.dt)}%`;
        mark.title = `${header.bodies.names[event.body]} frozen at step ${event.step}: its numbers went wrong`;
        marks.append(mark);
      }
    }

    begin() {
      const { given } = this.options;
      for (const name of SWITCHES) if (given.get(name) === "on") this.set(name, true);
      document.body.classList.toggle("bare", given.get("ui") === "off");
      if (innerWidth < 700 && innerHeight < 620) this.set("plots", false);
      this.resize();
      if (given.has("t")) this.go_to_time(Number(given.get("t")));
      else this.go_to_frame(Number(given.get("frame")) || 0);
      if (given.has("select")) this.select(Number(given.get("select")));
      this.take_in();
      this.orbit.advance(1);
      this.draw();
      const still = globalThis.matchMedia && matchMedia("(prefers-reduced-motion: reduce)").matches;
      const placed = given.has("t") || given.has("frame");
      if (given.get("play") !== "off" && !placed && !still && this.recording.frame_count > 1)
        this.play();
      else this.show_playing();
    }

    take_in() {
      if (!this.camera_given) this.orbit.take_in(this.stage.seen);
    }

    listen() {
      new ResizeObserver(() => this.resize()).observe(document.documentElement);
      new ResizeObserver(() => this.resize()).observe(document.querySelector("[data-dock]"));
      const hint = document.querySelector("[data-hint]");
      this.canvas.addEventListener("pointermove", (e) => {
        if (e.pointerType === "touch" || e.buttons) {
          hint.hidden = true;
          return;
        }
        this.hover_at = [e.clientX, e.clientY];
        this.redraw();
      });
      this.canvas.addEventListener("pointerleave", () => {
        this.hover_at = null;
        this.hover(-1);
      });
      if (globalThis.matchMedia) {
        matchMedia("(prefers-color-scheme: dark)").addEventListener("change", (e) => {
          if (!this.options.given.has("theme")) this.set_theme(e.matches ? "dark" : "light");
        });
      }
    }

    actions() {
      const flip = (name) => () => this.set(name, !this.on[name]);
      const help = document.querySelector("[data-help]");
      const actions = {
        play: () => (this.playing ? this.pause() : this.play()),
        back: (far) => this.step_frames(far ? -10 : -1),
        forward: (far) => this.step_frames(far ? 10 : 1),
        first: () => this.go_to_frame(0),
        last: () => {
          this.pause();
          this.go_to_frame(this.recording.frame_count - 1);
        },
        slower: () => this.controls.change_speed(-1),
        faster: () => this.controls.change_speed(1),
        home: () => {
          this.set("follow", false);
          this.orbit.home();
          this.take_in();
          this.redraw();
        },
        theme: () => this.set_theme(this.options.theme === "dark" ? "light" : "dark"),
        bare: () => {
          document.body.classList.toggle("bare");
          this.resize();
        },
        help: () => {
          help.hidden = !help.hidden;
        },
        escape: () => {
          if (help.hidden) this.select(-1);
          help.hidden = true;
        },
        scrub_start: () => {
          this.was_playing = this.playing;
          this.pause();
        },
        scrub: (share) => this.go_to_time(share * this.last_time),
        scrub_end: () => {
          if (this.was_playing) this.play();
        },
      };
      for (const name of [...SWITCHES, "plots"]) actions[name] = flip(name);
      return actions;
    }

    set(name, on) {
      this.on[name] = on;
      this.controls.press_button(name, on);
      if (name === "plots") {
        document.querySelector("[data-plots]").hidden = !on;
        this.resize();
      }
      if (name === "trail") this.draw_trail();
      if (name === "speeds") {
        document.querySelector("[data-legend]").hidden = !on;
        if (!on) this.stage.paint(null);
      }
      this.shown = null;
      this.redraw();
    }

    set_theme(name) {
      this.options.theme = name;
      document.documentElement.dataset.theme = name;
      this.stage.set_theme(name);
      this.overlays.set_theme(this.stage.theme);
      for (const plot of this.plots) plot.draw();
      this.shown = null;
      this.redraw();
    }

    resize() {
      const dock = document.querySelector("[data-dock]"),
        bare = document.body.classList.contains("bare");
      const bottom = bare ? 0 : Math.max(innerHeight - dock.getBoundingClientRect().top, 0);
      const narrow = innerWidth <= 600 && !bare,
        panel = document.querySelector("[data-panel]");
      const top = narrow ? document.querySelector(".heading").getBoundingClientRect().bottom : 0;
      const sheet = narrow && !panel.hidden ? panel.getBoundingClientRect().height + 8 : 0;
      const ratio = Math.min(globalThis.devicePixelRatio || 1, 2);
      document.documentElement.style.setProperty("--dock-height", `${bottom}px`);
      this.stage.resize(innerWidth, innerHeight, ratio, { bottom: bottom + sheet, top });
      this.overlays.resize(this.stage.viewport, ratio);
      for (const plot of this.plots) plot.draw();
      this.redraw();
    }

    // Time.

    play() {
      if (this.time >= this.last_time) this.go_to_frame(0);
      this.playing = true;
      this.clock = null;
      this.show_playing();
      this.redraw();
    }

    pause() {
      if (!this.playing) return;
      this.playing = false;
      this.go_to_frame(this.frame);
      this.show_playing();
    }

    show_playing() {
      document.body.classList.toggle("playing", this.playing);
      const button = document.querySelector("[data-do=play]");
      button.setAttribute("aria-label", this.playing ? "Pause" : "Play");
    }

    step_frames(count) {
      this.pause();
      this.go_to_frame(this.frame + count);
    }

    go_to_frame(frame) {
      this.frame = Math.min(Math.max(Math.round(frame), 0), this.recording.frame_count - 1);
      this.time = this.recording.times[this.frame];
      this.redraw();
    }

    // While paused the nearest frame is shown, exact; while playing, what lies between two.
    go_to_time(time) {
      const { times, frame_count } = this.recording;
      const t = Math.min(Math.max(time, 0), this.last_time),
        before = this.recording.frame_at(t);
      const next = Math.min(before + 1, frame_count - 1);
      this.go_to_frame(times[next] - t < t - times[before] ? next : before);
    }

    run(seconds) {
      this.time += Math.min(seconds, 0.25) * this.speed;
      if (this.time >= this.last_time) {
        if (this.on.loop) {
          this.time = this.last_time > 0 ? this.time % this.last_time : 0;
        } else {
          this.time = this.last_time;
          this.playing = false;
          this.show_playing();
        }
      }
      this.frame = this.recording.frame_at(this.time);
    }

    // Eight slow frames in a row, and the picture becomes simpler; unless shadows were asked for.
    watch_pace(seconds) {
      this.slow = seconds > 0.09 ? (this.slow || 0) + 1 : 0;
      if (this.slow < 8 || this.stage.plain || this.options.given.get("shadows") === "on") return;
      this.stage.draw_plainly();
      this.resize();
    }

    redraw() {
      if (this.waiting) return;
      this.waiting = requestAnimationFrame((now) => {
        this.waiting = null;
        const seconds = this.clock ? (now - this.clock) / 1000 : 0;
        this.clock = now;
        if (this.playing) this.run(seconds);
        this.watch_pace(seconds);
        const gliding = this.orbit.advance(this.clock ? Math.max(seconds, 0.001) : 0.016);
        this.draw();
        if (this.playing || gliding) this.redraw();
        else this.clock = null;
      });
    }

    // What is shown.

    pose() {
      return this.motion.pose(this.frame, this.time);
    }

    draw() {
      if (!this.stage.viewport) return;
      const pose = (this.current = this.pose());
      this.follow_body(pose);
      if (this.shown !== this.time) {
        this.stage.show(pose.position, pose.rotation);
        this.show_frame(pose);
        this.shown = this.time;
      }
      if (this.stage.set_glass(this.stage.find_walls(cairn.hit_wall)))
        this.stage.show(pose.position, pose.rotation);
      if (this.hover_at) this.hover(this.pick(...this.hover_at).body);
      this.stage.render();
    }

    show_frame(pose) {
      const { recording, frame, on } = this,
        contacts = recording.contacts(frame);
      this.controls.show_time(
        this.time,
        this.last_time,
        recording.steps[frame],
        this.header.step_count,
      );
      for (const plot of this.plots) plot.show(frame);
      this.overlays.show_contacts(
        on.contacts || on.normals ? contacts : null,
        on.contacts,
        on.normals,
      );
      if (on.velocities || on.speeds) this.show_velocities(pose);
      if (!on.velocities) this.overlays.show_velocities(null, null);
      if (this.selected < 0) return;
      const motion = this.motion.ends(frame),
        i = this.selected,
        origin = this.header.lattice.origin;
      const exact = this.motion.centre_of_mass(recording.pose(frame), i).toArray();
      this.panel.update(
        {
          position: exact.map((v, k) => v + origin[k]),
          velocity: this.motion.velocity(i, motion).toArray(),
          spin: this.motion.spin(i, motion).toArray(),
        },
        contacts,
        frame,
      );
    }

    show_velocities(pose) {
      const { kinds } = this.header.bodies,
        motion = this.motion.ends(this.frame),
        n = kinds.length;
      const centres = new Float32Array(3 * n),
        velocities = new Float32Array(3 * n),
        speeds = new Float32Array(n);
      for (let i = 0; i < n; ++i) {
        if (kinds[i] === "s") continue;
        this.motion.centre_of_mass(pose, i).toArray(centres, 3 * i);
        const velocity = this.motion.velocity(i, motion);
        velocity.toArray(velocities, 3 * i);
        speeds[i] = velocity.length();
      }
      if (this.on.velocities) this.overlays.show_velocities(centres, velocities);
      if (!this.on.speeds) return;
      const scale = this.motion.speed_scale();
      document.querySelector("[data-fastest]").textContent = `${scale.toPrecision(2)} m/s`;
      this.stage.paint(speeds.map((speed) => Math.sqrt(speed / scale)));
    }

    follow_body(pose) {
      if (!this.on.follow || this.selected < 0) {
        this.followed = null;
        return;
      }
      const at = this.motion.centre_of_mass(pose, this.selected);
      if (this.followed) this.orbit.shift(at.clone().sub(this.followed));
      else this.orbit.look_at(at);
      this.followed = at;
    }

    draw_trail() {
      if (!this.on.trail || this.selected < 0) {
        this.overlays.show_trail(null);
        return;
      }
      const { recording } = this,
        path = new Float32Array(3 * recording.frame_count);
      for (let f = 0; f < recording.frame_count; ++f) {
        this.motion.centre_of_mass(recording.pose(f), this.selected).toArray(path, 3 * f);
      }
      this.overlays.show_trail(path);
    }

    // Bodies.

    pick(x, y) {
      const pose = this.current || this.pose();
      return cairn.pick_body(this.stage, pose.position, pose.rotation, x, y);
    }

    hover(body) {
      const hint = document.querySelector("[data-hint]");
      const named = body >= 0 && !this.stage.grounds.some((ground) => ground.body === body);
      hint.hidden = !named;
      this.canvas.style.cursor = named ? "pointer" : "";
      if (named) {
        hint.textContent = this.header.bodies.names[body];
        hint.style.transform = `translate(${this.hover_at[0] + 14}px, ${this.hover_at[1] + 16}px)`;
      }
      const shown = named ? body : -1;
      if (this.stage.hovered === shown) return;
      this.stage.hovered = shown;
      if (this.on.speeds) this.shown = null;
      else this.stage.paint(null);
      this.redraw();
    }

    select(body) {
      this.selected = body >= 0 && body < this.recording.body_count ? body : -1;
      this.followed = null;
      this.panel.show_body(this.selected);
      this.stage.outline_body(this.selected);
      if (innerWidth <= 600) this.resize();
      this.draw_trail();
      this.shown = null;
      this.redraw();
    }

    approach(x, y) {
      const { body, distance } = this.pick(x, y);
      if (body < 0) return;
      const ray = new THREE.Raycaster();
      ray.setFromCamera(
        new THREE.Vector2((2 * x) / innerWidth - 1, 1 - (2 * y) / innerHeight),
        this.stage.camera,
      );
      this.orbit.look_at(
        ray.ray.at(distance, new THREE.Vector3()),
        Math.min(this.orbit.distance, 0.55 * distance),
      );
    }
  }

  cairn.start = function () {
    try {
      const source = document.querySelector("[data-recording]");
      const recording = cairn.read_recording(cairn.decode_base64(source.textContent));
      source.remove();
      globalThis.cairn_replay = cairn.make_api(new Player(recording));
      document.body.classList.add("ready");
    } catch (error) {
      const message = document.querySelector("[data-failure]");
      message.hidden = false;
      message.textContent = `This replay cannot be shown: ${error.message}.`;
      throw error;
    }
  };
})((globalThis.cairn = globalThis.cairn || {}));
cairn.start();
