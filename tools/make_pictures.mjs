// Draws the README's pictures: runs built-in scenes, opens their replay pages in a headless
// Chromium and writes docs/pictures/NAME.png, and docs/pictures/showcase.gif, which moves.
//
//   node tools/make_pictures.mjs [--cairn PATH] [--no-gif] [NAME ...]
//
// Without names: all built-in scenes. Needs chromium, imagemagick (convert), ffmpeg, and `npm ci` in
// tests/replay. Software WebGL takes about ten seconds a picture and two a frame of the film.

import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { open_browser, open_replay } from "../tests/replay/browser.mjs";

// The moment of each scene that shows what it is about, s; others are shown at a quarter of their
// time. `options` go to the page.
const moments = {
  showcase: { time: 10.4 },
  drop: { time: 0.75, options: "&velocities=on" },
  bounce: { time: 1.2 },
  incline: { time: 1.2, options: "&velocities=on" },
  roll: { time: 1, options: "&velocities=on&eye=-0.5,3.2,7.5&target=2.6,0.2,0" },
  conveyor: { time: 5 },
  pyramid: { time: 1 },
  tower: { time: 1, options: "&contacts=on&normals=on" },
  dominoes: { time: 1.6 },
  "card-house": { time: 0.5 },
  "mass-ratio": { time: 2, options: "&contacts=on&normals=on" },
  pit: { time: 1.1 },
  logs: { time: 1 },
  billiards: { time: 0.5, options: "&velocities=on" },
  cradle: { time: 1, options: "&velocities=on" },
  "t-handle": { time: 2.1 },
};
const film = {
  scene: "showcase",
  frames_a_second: 12,
  start: 3.5,
  end: 11,
  width: 480,
  height: 300,
};
const most_bytes = { png: 60e3, gif: 3e6 };

const root = join(dirname(fileURLToPath(import.meta.url)), "..");
const folder = join(root, "docs", "pictures");

function read_arguments(given) {
  const wanted = { cairn: join(root, "build", "release", "cairn"), gif: true, names: [] };
  for (let i = 0; i < given.length; ++i) {
    if (given[i] === "--cairn") wanted.cairn = given[++i];
    else if (given[i] === "--no-gif") wanted.gif = false;
    else wanted.names.push(given[i]);
  }
  if (!wanted.names.length) {
    const list = execFileSync(wanted.cairn, ["scenes"], { encoding: "utf8" });
    wanted.names = list
      .split("\n")
      .filter((line) => /^[a-z]/.test(line))
      .map((line) => line.split(" ")[0]);
  }
  return wanted;
}

function check_size(path, most) {
  const { size } = statSync(path);
  console.log(`${path.slice(root.length + 1)}  ${(size / 1000).toFixed(0)} kB`);
  if (size > most) throw new Error(`${path} has ${size} bytes, more than ${most}`);
}

async function draw_picture(browser, html, name, work) {
  const { time, options = "" } = moments[name] || {};
  const { page, context } = await open_replay(
    browser,
    html,
    `play=off&ui=off&shadows=on&theme=light${options}`,
    { viewport: { width: 960, height: 600 } },
  );
  await page.evaluate(
    (t) => {
      const replay = globalThis.cairn_replay;
      replay.go_to_time(t === null ? (replay.header.step_count * replay.header.dt) / 4 : t);
      replay.draw();
    },
    time === undefined ? null : time,
  );
  const raw = join(work, `${name}.png`),
    path = join(folder, `${name}.png`);
  await page.screenshot({ path: raw, timeout: 300000 });
  await context.close();
  execFileSync("convert", [
    raw,
    "-filter",
    "Lanczos",
    "-resize",
    "480x300",
    "-strip",
    "-dither",
    "None",
    "-colors",
    "224",
    "-define",
    "png:compression-level=9",
    `png8:${path}`,
  ]);
  check_size(path, most_bytes.png);
}

async function draw_film(browser, html, work) {
  const { page, context } = await open_replay(
    browser,
    html,
    "play=off&ui=off&shadows=on&theme=light",
    { viewport: { width: film.width, height: film.height } },
  );
  const last = await page.evaluate(
    () => globalThis.cairn_replay.header.step_count * globalThis.cairn_replay.header.dt,
  );
  const count = Math.round((Math.min(film.end, last) - film.start) * film.frames_a_second),
    frames = [];
  for (let i = 0; i < count; ++i) {
    await page.evaluate(
      (t) => {
        globalThis.cairn_replay.go_to_time(t);
        globalThis.cairn_replay.draw();
      },
      film.start + i / film.frames_a_second,
    );
    frames.push(join(work, `film${String(i).padStart(4, "0")}.png`));
    await page.screenshot({ path: frames[i], timeout: 300000 });
  }
  await context.close();
  const path = join(folder, `${film.scene}.gif`);
  // One palette for all frames, and of each frame only the part that changed.
  const palette = "palettegen=max_colors=256:stats_mode=full";
  const paint = "paletteuse=dither=none:diff_mode=rectangle";
  execFileSync("ffmpeg", [
    ...["-loglevel", "error", "-y", "-framerate", String(film.frames_a_second)],
    ...["-i", join(work, "film%04d.png"), "-vf", `split[a][b];[a]${palette}[p];[b][p]${paint}`],
    ...["-loop", "0", path],
  ]);
  check_size(path, most_bytes.gif);
}

const wanted = read_arguments(process.argv.slice(2));
const { browser, missing } = await open_browser();
if (missing) {
  console.error(`the pictures need ${missing}`);
  process.exit(2);
}
mkdirSync(folder, { recursive: true });
const work = mkdtempSync(join(tmpdir(), "cairn-pictures-"));
for (const name of wanted.names) {
  const html = join(work, `${name}.html`);
  execFileSync(wanted.cairn, ["run", name, "--replay", html, "--quiet"], {
    stdio: ["ignore", "ignore", "inherit"],
  });
  await draw_picture(browser, html, name, work);
  if (name === film.scene && wanted.gif) await draw_film(browser, html, work);
}
await browser.close();
rmSync(work, { recursive: true });
