// The card that tells of one body: what it is, where it is, how it moves, and what it touches now.
// Names come from scene files: they enter the page as text, never as HTML.
"use strict";
(function (cairn) {
  const KINDS = { s: "static", k: "kinematic", d: "dynamic" };
  const number = (value, digits) => {
    const text = value.toFixed(digits);
    return Number(text) === 0 ? (0).toFixed(digits) : text;
  };
  const triple = (x, y, z) =>
    [x, y, z].map((v) => number(v, Math.abs(v) >= 1000 ? 1 : 3)).join(", ");

  function make(tag, text, name) {
    const element = document.createElement(tag);
    if (text !== undefined) element.textContent = text;
    if (name) element.className = name;
    return element;
  }

  function describe_geometry(g) {
    const metres = (v) => cairn.format_si(v, "m");
    if (g.kind === "sphere") return `sphere, radius ${metres(g.radius)}`;
    if (g.kind === "capsule")
      return `capsule, radius ${metres(g.radius)}, height ${metres(g.height)}`;
    if (g.kind === "box")
      return `box, ${g.half_extents.map((h) => metres(2 * h)).join(" \u00d7 ")}`;
    if (g.kind === "plane")
      return `plane, normal (${g.normal.map((v) => number(v, 2)).join(", ")})`;
    return g.kind;
  }

  function describe_shapes(header, body) {
    const counts = new Map();
    for (const [index] of header.bodies.shapes[body]) {
      const text = describe_geometry(header.geometries[index]);
      counts.set(text, (counts.get(text) || 0) + 1);
    }
    if (!counts.size) return ["none"];
    const lines = [...counts].map(([text, count]) =>
      count > 1 ? `${count} \u00d7 ${text}` : text,
    );
    return lines.length > 4 ? [...lines.slice(0, 4), `and ${lines.length - 4} kinds more`] : lines;
  }

  class Panel {
    constructor(element, recording, { select, colour_of }) {
      Object.assign(this, { element, recording, select, colour_of, body: -1 });
      this.name = element.querySelector("[data-name]");
      this.swatch = element.querySelector("[data-swatch]");
      this.facts = element.querySelector("[data-facts]");
      this.contacts = element.querySelector("[data-contacts]");
      this.contacts_title = element.querySelector("[data-contacts-title]");
    }

    show_body(body) {
      this.body = body;
      this.element.hidden = body < 0;
      if (body < 0) return;
      const { header } = this.recording,
        { names, kinds, mass } = header.bodies;
      this.name.textContent = names[body];
      this.facts.replaceChildren();
      this.rows = {};
      const add = (key, label, lines) => {
        const value = make("dd");
        for (const line of lines) value.append(make("div", line));
        this.facts.append(make("dt", label), value);
        this.rows[key] = value;
      };
      add("kind", "Kind", [KINDS[kinds[body]]]);
      add("shape", "Shape", describe_shapes(header, body));
      if (kinds[body] === "d") add("mass", "Mass", [cairn.format_si(mass[body] * 1000, "g")]);
      add("position", "Centre", [""]);
      if (kinds[body] !== "s") {
        add("speed", "Speed", [""]);
        add("spin", "Spin", [""]);
      }
      const frozen = (header.non_finite || []).find((event) => event.body === body);
      if (frozen) add("frozen", "Frozen", [`at step ${frozen.step}: its numbers went wrong`]);
    }

    // `motion`: position (world, metres), velocity and spin of the body at this frame.
    update(motion, contacts, frame) {
      if (this.body < 0) return;
      const body = this.body,
        set = (key, text) => {
          if (this.rows[key]) this.rows[key].textContent = text;
        };
      this.swatch.style.background = this.colour_of(body);
      set("position", triple(...motion.position) + " m");
      set(
        "speed",
        `${number(Math.hypot(...motion.velocity), 3)} m/s  (${motion.velocity.map((v) => number(v, 2)).join(", ")})`,
      );
      set("spin", `${number(Math.hypot(...motion.spin), 2)} rad/s`);
      this.list_contacts(contacts, frame);
    }

    list_contacts(contacts, frame) {
      const others = new Map();
      for (let i = 0; contacts && i < contacts.a.length; ++i) {
        if (contacts.a[i] !== this.body && contacts.b[i] !== this.body) continue;
        const other = contacts.a[i] === this.body ? contacts.b[i] : contacts.a[i];
        const entry = others.get(other) || { points: 0, impulse: 0, separation: Infinity };
        entry.points += 1;
        entry.impulse += contacts.impulse[i];
        entry.separation = Math.min(entry.separation, contacts.separation[i]);
        others.set(other, entry);
      }
      const steps = this.recording.steps;
      const when =
        contacts && contacts.frame !== frame ? ` at step ${steps[contacts.frame]}` : " now";
      this.contacts_title.textContent = others.size
        ? `Touches ${others.size}${when}`
        : `Touches nothing${when}`;
      const sorted = [...others].sort((a, b) => b[1].impulse - a[1].impulse);
      this.contacts.replaceChildren(
        ...sorted.slice(0, 8).map(([other, entry]) => {
          const row = make("button", undefined, "contact");
          row.type = "button";
          row.append(
            make("span", this.recording.header.bodies.names[other], "contact-name"),
            make("span", `${entry.points} pt`),
            make("span", cairn.format_si(entry.impulse, "N s")),
            make("span", cairn.format_si(entry.separation, "m")),
          );
          row.title =
            "Points, impulse over the last step, least separation. Click to go to this body.";
          row.addEventListener("click", () => this.select(other));
          return row;
        }),
      );
      if (sorted.length > 8)
        this.contacts.append(make("div", `and ${sorted.length - 8} more`, "more"));
    }
  }

  cairn.Panel = Panel;
})((globalThis.cairn = globalThis.cairn || {}));
