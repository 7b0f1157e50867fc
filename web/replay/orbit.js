// The camera in the user's hand: one finger or the left button turns it about a point, two fingers
// or the right button move that point, wheel and pinch come nearer. Any direction can be up.
"use strict";
(function (cairn) {
  const HIGHEST = 1.54; // radians above the horizon, just short of straight down
  const SETTLE_S = 0.07; // time constant of the glide after a hand's move
  const CLICK_PIXELS = 6; // a press that moves less is a click

  class Orbit {
    // `changed` is called when a redraw is due, `clicked(x, y)` on a press without a move.
    constructor(element, stage, { changed, clicked, double_clicked }) {
      Object.assign(this, { element, stage, changed, clicked, double_clicked });
      const origin = new THREE.Vector3(...stage.header.lattice.origin);
      this.home_eye = new THREE.Vector3(...stage.header.camera.eye).sub(origin);
      this.home_target = new THREE.Vector3(...stage.header.camera.target).sub(origin);
      const up = stage.up;
      this.east = new THREE.Vector3(1, 0, 0);
      if (Math.abs(up.x) > 0.9) this.east.set(0, 0, 1);
      this.east.addScaledVector(up, -this.east.dot(up)).normalize();
      this.south = new THREE.Vector3().crossVectors(this.east, up);
      this.pointers = new Map();
      this.home();
      this.listen();
    }

    home() {
      const offset = this.home_eye.clone().sub(this.home_target);
      this.target = this.home_target.clone();
      this.distance = Math.max(offset.length(), 1e-6);
      this.height = Math.asin(Math.min(Math.max(offset.dot(this.stage.up) / this.distance, -1), 1));
      this.turn = Math.atan2(offset.dot(this.east), offset.dot(this.south));
      this.now = {
        target: this.target.clone(),
        distance: this.distance,
        height: this.height,
        turn: this.turn,
      };
      this.place();
    }

    // The scene's camera says from where to look, not through which lens: where it would cut off
    // what happens, the point looked at moves to the middle of that, and the eye moves back.
    take_in(balls) {
      const { camera, viewport, covered } = this.stage;
      const upward = Math.tan((camera.fov * Math.PI) / 360) * (1 - covered / viewport.y) * 0.93;
      const across = Math.tan((camera.fov * Math.PI) / 360) * camera.aspect * 0.93;
      const axes = [0, 1, 2].map((i) =>
        new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, i),
      );
      const own_target = this.target.clone(),
        own_distance = this.distance;
      for (let round = 0; round < 6; ++round) {
        // Slopes of the view's edges that would just hold everything: left, right, down, up.
        const eye = this.target.clone().addScaledVector(axes[2], this.distance);
        const hold = [Infinity, -Infinity, Infinity, -Infinity];
        for (const { at, reach } of balls) {
          const to = at.clone().sub(eye),
            deep = Math.max(-to.dot(axes[2]), 0.05 * this.distance);
          const x = to.dot(axes[0]) / deep,
            y = to.dot(axes[1]) / deep,
            r = reach / deep;
          hold[0] = Math.min(hold[0], x - r);
          hold[1] = Math.max(hold[1], x + r);
          hold[2] = Math.min(hold[2], y - r);
          hold[3] = Math.max(hold[3], y + r);
        }
        const over = Math.max(
          -hold[0] / across,
          hold[1] / across,
          -hold[2] / upward,
          hold[3] / upward,
        );
        if (!(over > 1.001)) break;
        this.target
          .addScaledVector(axes[0], 0.5 * (hold[0] + hold[1]) * this.distance)
          .addScaledVector(axes[1], 0.5 * (hold[2] + hold[3]) * this.distance);
        const needed = Math.max((hold[1] - hold[0]) / 2 / across, (hold[3] - hold[2]) / 2 / upward);
        this.distance *= Math.max(needed, 1);
      }
      // What rolls far away may leave the picture, or everything else would be specks.
      const most = across > upward ? 1.4 : 2,
        ratio = this.distance / own_distance;
      if (ratio > most) {
        this.target.lerpVectors(own_target, this.target, Math.log(most) / Math.log(ratio));
        this.distance = most * own_distance;
      }
      this.now.target.copy(this.target);
      this.now.distance = this.distance;
      this.place();
    }

    listen() {
      const { element } = this;
      element.addEventListener("pointerdown", (e) => this.press(e));
      element.addEventListener("pointermove", (e) => this.move(e));
      for (const name of ["pointerup", "pointercancel"])
        element.addEventListener(name, (e) => this.release(e, name));
      element.addEventListener("contextmenu", (e) => e.preventDefault());
      element.addEventListener("dblclick", (e) => this.double_clicked(e.clientX, e.clientY));
      element.addEventListener(
        "wheel",
        (e) => {
          e.preventDefault();
          const pixels = e.deltaY * (e.deltaMode === 1 ? 18 : e.deltaMode === 2 ? 400 : 1);
          this.zoom(Math.exp(Math.min(Math.max(pixels, -240), 240) * 0.0016));
        },
        { passive: false },
      );
    }

    press(e) {
      this.element.setPointerCapture(e.pointerId);
      this.pointers.set(e.pointerId, { x: e.clientX, y: e.clientY });
      this.travelled = this.pointers.size > 1 ? 1e9 : 0;
      this.moving_target = e.button === 2 || e.button === 1 || e.shiftKey || e.ctrlKey;
    }

    move(e) {
      const pointer = this.pointers.get(e.pointerId);
      if (!pointer) return;
      const before = this.spread(),
        dx = e.clientX - pointer.x,
        dy = e.clientY - pointer.y;
      pointer.x = e.clientX;
      pointer.y = e.clientY;
      this.travelled += Math.abs(dx) + Math.abs(dy);
      if (this.travelled < CLICK_PIXELS) return;
      if (this.pointers.size === 2) {
        this.zoom(before / Math.max(this.spread(), 1));
        this.pan(dx / 2, dy / 2);
      } else if (this.moving_target) {
        this.pan(dx, dy);
      } else {
        this.turn -= dx * 0.0062;
        this.height = Math.min(Math.max(this.height + dy * 0.0062, -HIGHEST), HIGHEST);
      }
      this.changed();
    }

    release(e, name) {
      const was_click = this.pointers.size === 1 && this.travelled < CLICK_PIXELS;
      this.pointers.delete(e.pointerId);
      if (was_click && name === "pointerup" && e.button === 0) this.clicked(e.clientX, e.clientY);
    }

    spread() {
      const [a, b] = [...this.pointers.values()];
      return b ? Math.max(Math.hypot(a.x - b.x, a.y - b.y), 1) : 1;
    }

    zoom(factor) {
      const { typical, radius } = this.stage;
      this.distance = Math.min(Math.max(this.distance * factor, 0.5 * typical), 30 * radius);
      this.changed();
    }

    pan(dx, dy) {
      const camera = this.stage.camera;
      const metres =
        (2 * this.distance * Math.tan((camera.fov * Math.PI) / 360)) / this.stage.viewport.y;
      const right = new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, 0);
      const upward = new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, 1);
      this.target.addScaledVector(right, -dx * metres).addScaledVector(upward, dy * metres);
      this.changed();
    }

    // Puts the point about which the camera turns there, gliding.
    look_at(point, distance) {
      this.target.copy(point);
      if (distance) this.distance = distance;
      this.changed();
    }

    // Moves all at once: what follows a body must not lag behind it.
    shift(by) {
      this.target.add(by);
      this.now.target.add(by);
      this.place();
    }

    // Glides towards where the hand has put it; true while there is a way to go.
    advance(seconds) {
      const now = this.now,
        share = seconds > 0.3 ? 1 : 1 - Math.exp(-seconds / SETTLE_S);
      const gap =
        now.target.distanceTo(this.target) / this.distance +
        Math.abs(Math.log(this.distance / now.distance)) +
        Math.abs(this.turn - now.turn) +
        Math.abs(this.height - now.height);
      const rest = gap < 2e-4 ? 1 : share;
      now.target.lerp(this.target, rest);
      now.distance *= Math.pow(this.distance / now.distance, rest);
      now.turn += (this.turn - now.turn) * rest;
      now.height += (this.height - now.height) * rest;
      this.place();
      return rest < 1;
    }

    place() {
      const { target, distance, height, turn } = this.now,
        camera = this.stage.camera;
      const level = distance * Math.cos(height);
      camera.position
        .copy(target)
        .addScaledVector(this.stage.up, distance * Math.sin(height))
        .addScaledVector(this.east, level * Math.sin(turn))
        .addScaledVector(this.south, level * Math.cos(turn));
      camera.up.copy(this.stage.up);
      camera.lookAt(target);
      camera.updateMatrixWorld();
    }
  }

  cairn.Orbit = Orbit;
})((globalThis.cairn = globalThis.cairn || {}));
