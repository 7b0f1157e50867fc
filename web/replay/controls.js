// Buttons, keys and the timeline: everything that the hand does besides turning the camera.
"use strict";
(function (cairn) {
  const SPEEDS = [0.05, 0.1, 0.25, 0.5, 1, 2, 4];

  // Key, what it does in the player, and the line in the help.
  const KEYS = [
    [["Space", "k"], "play", "Play or pause"],
    [["ArrowLeft", ","], "back", "One frame back (Shift: ten)"],
    [["ArrowRight", "."], "forward", "One frame on (Shift: ten)"],
    [["Home"], "first", "To the beginning"],
    [["End"], "last", "To the end"],
    [["["], "slower", "Slower"],
    [["]"], "faster", "Faster"],
    [["l"], "loop", "Loop"],
    [["c"], "contacts", "Contact points"],
    [["n"], "normals", "Contact normals, as long as the root of the impulse"],
    [["v"], "velocities", "Velocities: the way in a quarter of a second"],
    [["s"], "speeds", "Colour by speed"],
    [["f"], "follow", "Follow the selected body"],
    [["t"], "trail", "Trail of the selected body"],
    [["p"], "plots", "Plots"],
    [["r", "0"], "home", "Camera back to the start"],
    [["d"], "theme", "Light or dark"],
    [["u"], "bare", "Hide everything but the scene"],
    [["Escape"], "escape", "Let go of the body, close this"],
    [["?", "h"], "help", "This help"],
  ];
  const KEY_NAMES = { ArrowLeft: "\u2190", ArrowRight: "\u2192", Escape: "Esc" };

  class Controls {
    // `actions`: a function for each name in KEYS; `scrub(x from 0 to 1)`, `scrub_start`,
    // `scrub_end`.
    constructor(player, actions) {
      this.player = player;
      this.actions = actions;
      const find = (this.find = (name) => document.querySelector(`[data-${name}]`));
      for (const button of document.querySelectorAll("[data-do]")) {
        button.addEventListener("click", () => {
          actions[button.dataset.do](false);
          button.blur(); // or the space bar would press it again
        });
      }
      this.fill_help();
      this.fill_speeds();
      globalThis.addEventListener("keydown", (e) => this.press_key(e));
      for (const area of document.querySelectorAll("[data-scrub]")) this.listen_to_scrub(area);
      this.readout = find("time");
      this.step = find("step");
      this.cursors = [...document.querySelectorAll("[data-cursor]")];
      this.progress = find("progress");
    }

    fill_help() {
      const list = this.find("keys");
      for (const [keys, , text] of KEYS) {
        const row = document.createElement("div"),
          names = document.createElement("span");
        for (const key of keys) {
          const cap = document.createElement("kbd");
          cap.textContent = KEY_NAMES[key] || key.toUpperCase();
          names.append(cap);
        }
        const what = document.createElement("span");
        what.textContent = text;
        row.append(names, what);
        list.append(row);
      }
    }

    fill_speeds() {
      const select = this.find("speed");
      for (const speed of SPEEDS) {
        const option = new Option(`${speed}\u00d7`, speed, speed === 1, speed === 1);
        select.append(option);
      }
      select.addEventListener("change", () => {
        this.player.speed = Number(select.value);
        select.blur();
      });
      this.speed_select = select;
    }

    change_speed(by) {
      const at = SPEEDS.indexOf(this.player.speed),
        next = SPEEDS[Math.min(Math.max(at + by, 0), SPEEDS.length - 1)];
      this.player.speed = next;
      this.speed_select.value = String(next);
    }

    press_key(e) {
      if (e.ctrlKey || e.metaKey || e.altKey || e.target.tagName === "SELECT") return;
      const key = e.key === " " ? "Space" : e.key.length === 1 ? e.key.toLowerCase() : e.key;
      const found = KEYS.find(([keys]) => keys.includes(key));
      if (!found) return;
      if (key === "Space" && e.target.closest && e.target.closest("button.contact, summary"))
        return;
      e.preventDefault();
      this.actions[found[1]](e.shiftKey);
    }

    listen_to_scrub(area) {
      const share = (e) => {
        const box = area.getBoundingClientRect();
        return Math.min(Math.max((e.clientX - box.left) / box.width, 0), 1);
      };
      area.addEventListener("pointerdown", (e) => {
        if (e.button !== 0) return;
        area.setPointerCapture(e.pointerId);
        this.scrubbing = e.pointerId;
        this.actions.scrub_start();
        this.actions.scrub(share(e));
      });
      area.addEventListener("pointermove", (e) => {
        if (this.scrubbing === e.pointerId) this.actions.scrub(share(e));
      });
      for (const name of ["pointerup", "pointercancel"]) {
        area.addEventListener(name, (e) => {
          if (this.scrubbing !== e.pointerId) return;
          this.scrubbing = null;
          this.actions.scrub_end();
        });
      }
    }

    show_time(time, last, step, step_count) {
      const share = last > 0 ? time / last : 0,
        digits = last < 1 ? 4 : last < 100 ? 2 : 1;
      this.readout.textContent = `${time.toFixed(digits)} / ${last.toFixed(digits)} s`;
      this.step.textContent = `step ${step} of ${step_count}`;
      for (const cursor of this.cursors) cursor.style.left = `${100 * share}%`;
      this.progress.style.transform = `scaleX(${share})`;
    }

    press_button(name, on) {
      for (const button of document.querySelectorAll(`[data-do="${name}"]`))
        button.setAttribute("aria-pressed", String(on));
    }
  }

  cairn.Controls = Controls;
})((globalThis.cairn = globalThis.cairn || {}));
