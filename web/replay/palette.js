// The colours of the page's 3D scene, for daylight and for the night, and who gets which.
//
// Stones in a range of clays, ochres, lichens and slates: apart in hue for the eye, alike in weight
// so that none shouts. Written in sRGB; three.js is given linear light.
"use strict";
(function (cairn) {
  const STONES = [
    "#d8613c",
    "#e9a23b",
    "#5b9a8b",
    "#3f6f9f",
    "#c9508a",
    "#8fae4b",
    "#7a68b3",
    "#e07f6d",
    "#2f8f9d",
    "#d9b54a",
  ];
  // From the foot of a scene to its top, where height tells stones apart best.
  const STRATA = [
    "#355f8c",
    "#3b8c96",
    "#6aa57c",
    "#b4b356",
    "#e8ae49",
    "#e5834a",
    "#d05a4e",
    "#b24a76",
  ];
  const SPEEDS = ["#34407a", "#3877a6", "#41ab97", "#b9c95a", "#f3b13f", "#ee6a3b"];

  cairn.THEMES = {
    light: {
      ground: "#e6e0d5",
      line: "#a3967f",
      wall: "#ded6c8",
      still: "#b9b1a3",
      kinematic: "#8d8577",
      sky: "#ffffff",
      earth: "#d8ccbc",
      sun: "#fff6ea",
      sun_strength: 0.62,
      sky_strength: 0.4,
      top_strength: 0.14,
      stone_gain: 1.15,
      contact: "#111418",
      normal: "#d4263e",
      velocity: "#1769d2",
      outline: "#14181d",
      trail: "#14181d",
    },
    dark: {
      ground: "#20242b",
      line: "#48505c",
      wall: "#2a2f38",
      still: "#5b6069",
      kinematic: "#767d88",
      sky: "#dfe8ff",
      earth: "#5a5350",
      sun: "#fff0dc",
      sun_strength: 0.74,
      sky_strength: 0.5,
      top_strength: 0.16,
      stone_gain: 1.05,
      contact: "#ffffff",
      normal: "#ff5d6c",
      velocity: "#62b4ff",
      outline: "#ffffff",
      trail: "#ffffff",
    },
  };

  cairn.linear = (text) => new THREE.Color(text).convertSRGBToLinear();

  function sample_ramp(ramp, x) {
    const at = Math.min(Math.max(x, 0), 1) * (ramp.length - 1),
      i = Math.min(Math.floor(at), ramp.length - 2);
    return new THREE.Color(ramp[i])
      .lerp(new THREE.Color(ramp[i + 1]), at - i)
      .convertSRGBToLinear();
  }

  cairn.speed_colour = (x) => sample_ramp(SPEEDS, x);
  cairn.SPEED_GRADIENT = `linear-gradient(90deg, ${SPEEDS.join(", ")})`;

  // A colour a body (linear rgb). Few bodies, or a flat scene: one stone each in turn; a heap or a
  // building: by the height at which each began, so that layers show and mixing can be followed.
  cairn.colour_bodies = function (recording, heights, sizes, theme) {
    const { kinds } = recording.header.bodies;
    const moving = [...kinds].flatMap((kind, i) => (kind === "d" ? [i] : []));
    const levels = moving.map((i) => heights[i]).sort((a, b) => a - b);
    const low = levels[0],
      high = levels[levels.length - 1];
    const size = moving.map((i) => sizes[i]).sort((a, b) => a - b)[moving.length >> 1];
    const by_height = moving.length > 12 && high - low > 2.5 * size;
    const colours = [];
    let next = 0;
    for (let i = 0; i < kinds.length; ++i) {
      if (kinds[i] === "s") {
        colours.push(cairn.linear(theme.still));
        continue;
      }
      if (kinds[i] === "k") {
        colours.push(cairn.linear(theme.kinematic));
        continue;
      }
      const colour = by_height
        ? sample_ramp(STRATA, (heights[i] - low) / (high - low))
        : cairn.linear(STONES[next++ % STONES.length]);
      // A little unevenness between neighbours, as stones have; by number, so it never changes.
      const shade = 0.93 + 0.14 * ((i * 0.61803398875) % 1);
      colours.push(colour.multiplyScalar(shade * theme.stone_gain));
    }
    return colours;
  };
})((globalThis.cairn = globalThis.cairn || {}));
