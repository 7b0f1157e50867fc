// The two plots under the timeline: energies, and the deepest penetration. They share the
// timeline's horizontal axis, so that one cursor runs through all three, and are drawn to fit on
// every resize.
"use strict";
(function (cairn) {
  const PREFIX = [
    [1e9, "G"],
    [1e6, "M"],
    [1e3, "k"],
    [1, ""],
    [1e-3, "m"],
    [1e-6, "\u00b5"],
    [1e-9, "n"],
  ];

  // Three digits and a prefix: 1.23 kJ.
  cairn.format_si = function (value, unit) {
    if (!Number.isFinite(value)) return `${value} ${unit}`;
    const size = Math.abs(value);
    if (size < 1e-12) return `0 ${unit}`;
    const [scale, prefix] = PREFIX.find(([s]) => size >= 0.9995 * s) || PREFIX[PREFIX.length - 1];
    const digits = size / scale >= 99.95 ? 0 : size / scale >= 9.995 ? 1 : 2;
    return `${(value / scale).toFixed(digits)} ${prefix}${unit}`;
  };

  function from_lowest(values, reference) {
    let low = Infinity;
    for (const v of reference) low = Math.min(low, v);
    return values.map((v) => v - low);
  }

  class Plot {
    // series: [{name, values, colour (a CSS variable), fill}]
    constructor(element, recording, { title, unit, series, from_zero }) {
      Object.assign(this, { element, recording, title, unit, series, from_zero });
      this.canvas = document.createElement("canvas");
      this.labels = document.createElement("div");
      this.labels.className = "plot-labels";
      this.values = series.map(({ name, colour }) => {
        const row = document.createElement("span"),
          value = document.createElement("b");
        row.style.setProperty("--series", `var(${colour})`);
        row.append(document.createTextNode(name), value);
        this.labels.append(row);
        return value;
      });
      const heading = document.createElement("h2");
      heading.textContent = title;
      this.labels.prepend(heading);
      this.element.prepend(this.labels, this.canvas);
      this.find_range();
    }

    find_range() {
      let low = this.from_zero ? 0 : Infinity,
        high = -Infinity;
      for (const { values } of this.series) {
        for (const v of values)
          if (Number.isFinite(v)) {
            low = Math.min(low, v);
            high = Math.max(high, v);
          }
      }
      if (!(high > low)) {
        low = Math.min(low, 0);
        high = low + (Math.abs(low) || 1);
      }
      const margin = 0.08 * (high - low);
      this.low = this.from_zero ? 0 : low - margin;
      this.high = high + margin;
    }

    draw() {
      const { canvas, recording } = this,
        ratio = Math.min(globalThis.devicePixelRatio || 1, 2);
      const width = canvas.clientWidth,
        height = canvas.clientHeight;
      if (!width || !height) return;
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
      const pen = canvas.getContext("2d"),
        style = getComputedStyle(this.element);
      pen.scale(ratio, ratio);
      const last = recording.times[recording.frame_count - 1] || 1;
      const x_of = (i) => (recording.times[i] / last) * width;
      const y_of = (v) => height - 1 - ((v - this.low) / (this.high - this.low)) * (height - 2);
      pen.strokeStyle = style.getPropertyValue("--hair");
      pen.lineWidth = 1;
      const zero = Math.round(y_of(Math.max(this.low, Math.min(0, this.high)))) - 0.5;
      pen.beginPath();
      pen.moveTo(0, zero);
      pen.lineTo(width, zero);
      pen.stroke();
      for (const { values, colour, fill } of this.series) {
        pen.strokeStyle = style.getPropertyValue(colour);
        pen.lineWidth = 1.5;
        pen.lineJoin = "round";
        this.trace(pen, values, width, x_of, y_of);
        pen.stroke();
        if (!fill) continue;
        pen.lineTo(width, zero);
        pen.lineTo(0, zero);
        pen.globalAlpha = 0.16;
        pen.fillStyle = style.getPropertyValue(colour);
        pen.fill();
        pen.globalAlpha = 1;
      }
    }

    // Where frames are denser than pixels, each pixel shows its lowest and highest value.
    trace(pen, values, width, x_of, y_of) {
      pen.beginPath();
      if (values.length <= 2 * width) {
        values.forEach((v, i) => pen.lineTo(x_of(i), y_of(v)));
        return;
      }
      let column = 0,
        low = Infinity,
        high = -Infinity;
      for (let i = 0; i < values.length; ++i) {
        low = Math.min(low, values[i]);
        high = Math.max(high, values[i]);
        if (x_of(i) < column + 1 && i < values.length - 1) continue;
        pen.lineTo(column, y_of(high));
        pen.lineTo(column, y_of(low));
        column = Math.floor(x_of(i));
        low = Infinity;
        high = -Infinity;
      }
    }

    show(frame) {
      this.series.forEach(({ values }, i) => {
        this.values[i].textContent = cairn.format_si(values[frame], this.unit);
      });
    }
  }

  // Potential energy has no zero of its own: it is counted from its lowest value, or the kinetic
  // energy of a tall building would be a flat line.
  cairn.make_plots = (elements, recording) => [
    new Plot(elements.energy, recording, {
      title: "Energy",
      unit: "J",
      from_zero: false,
      series: [
        {
          name: "total",
          values: from_lowest(recording.total, recording.potential),
          colour: "--total",
        },
        {
          name: "potential",
          values: from_lowest(recording.potential, recording.potential),
          colour: "--potential",
        },
        { name: "kinetic", values: recording.kinetic, colour: "--kinetic" },
      ],
    }),
    new Plot(elements.penetration, recording, {
      title: "Penetration",
      unit: "m",
      from_zero: true,
      series: [{ name: "deepest", values: recording.penetration, colour: "--depth", fill: true }],
    }),
  ];
})((globalThis.cairn = globalThis.cairn || {}));
