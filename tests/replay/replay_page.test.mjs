// Does the page that `cairn run --replay` writes show what the run did?
//
// Takes the path of the cairn program. Runs three scenes, opens their pages from disk in a browser
// without network, plays, steps, scrubs and clicks, and compares with closed forms, with the run's
// own result file and with the picture's pixels. Exit status 77: skipped, with a line that says
// what is missing.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { open_browser, open_replay } from "./browser.mjs";

const cairn = process.argv[2];
const { browser, missing } = await open_browser();
if (missing) {
  console.log(`skipped: ${missing} is not installed`);
  process.exit(77);
}
const folder = mkdtempSync(join(tmpdir(), "cairn-replay-"));
const quiet = "play=off&shadows=off&antialias=off";
const nasty = `</script><b onclick="x">&amp;'`;
const page_limit = 30e6;

function run(scene, name, ...flags) {
  const path = join(folder, `${name}.html`);
  execFileSync(cairn, ["run", scene, "--replay", path, "--quiet", ...flags], {
    stdio: ["ignore", "ignore", "inherit"],
  });
  assert.ok(statSync(path).size < page_limit, `${name}: ${statSync(path).size} bytes`);
  return path;
}

function write_scene(name, scene) {
  const path = join(folder, `${name}.json`);
  writeFileSync(path, JSON.stringify(scene));
  return path;
}

async function check(claim, body) {
  const start = performance.now();
  try {
    await body();
  } catch (error) {
    console.log(`FAILED: ${claim}`);
    throw error;
  }
  console.log(`ok: ${claim} (${((performance.now() - start) / 1000).toFixed(1)} s)`);
}

// Calls cairn_replay in the page: ask(page, "body", 3).
const ask = (page, name, ...given) =>
  page.evaluate(
    ([method, values]) => {
      const found = globalThis.cairn_replay[method];
      const answer = typeof found === "function" ? found(...values) : found;
      return answer === undefined ? null : answer;
    },
    [name, given],
  );

// The average colour about a point of the picture, as drawn.
async function colour_at(page, [x, y], reach = 2) {
  await ask(page, "draw");
  return page.evaluate(
    ([cx, cy, r]) => {
      const stage = document.querySelector("[data-stage]"),
        copy = document.createElement("canvas");
      copy.width = stage.width;
      copy.height = stage.height;
      const pen = copy.getContext("2d");
      pen.drawImage(stage, 0, 0);
      const scale = stage.width / innerWidth;
      const { data } = pen.getImageData(
        Math.round(cx * scale) - r,
        Math.round(cy * scale) - r,
        2 * r + 1,
        2 * r + 1,
      );
      const sum = [0, 0, 0, 0];
      data.forEach((value, i) => {
        sum[i % 4] += value;
      });
      return sum.map((value) => value / (data.length / 4));
    },
    [x, y, reach],
  );
}
const difference = (a, b) => Math.hypot(...a.map((value, i) => value - b[i]));

// A ball falls freely for a second beside a box that never moves; the ball has a name that would
// break a careless page, and so has the scene.
const fall = write_scene("fall", {
  cairn: 1,
  name: nasty,
  description: `${nasty} falls 4.9 m`,
  duration: 1,
  step: { dt: 0.01, solver: "sequential-impulse" },
  bodies: [
    { name: "ground", kind: "static", shapes: [{ kind: "plane", normal: [0, 1, 0], offset: -20 }] },
    {
      name: nasty,
      position: [0, 3, 0],
      linear_velocity: [1, 0, 0],
      angular_velocity: [0, 0, 2],
      shapes: [{ kind: "sphere", radius: 0.5 }],
    },
    {
      name: "post",
      kind: "static",
      position: [3, 0, 0],
      shapes: [{ kind: "box", half_extents: [0.4, 1, 0.4] }],
    },
  ],
  camera: { eye: [0, 1, 14], target: [0, 1, 0] },
});

await check(
  "a falling ball follows its parabola on the page, and is seen where it is said to be",
  async () => {
    const { page, context, complaints, requests } = await open_replay(
      browser,
      run(fall, "fall"),
      quiet,
    );
    assert.equal(await ask(page, "frame_count"), 101);
    const ball = await ask(page, "find", nasty);
    assert.equal(ball, 1);

    const before = await ask(page, "body", ball);
    await ask(page, "draw");
    const place = await ask(page, "screen_position", ball);
    const drawn_before = await colour_at(page, place);
    await ask(page, "step_frames", 50);
    const after = await ask(page, "body", ball);
    assert.equal(await ask(page, "step"), 50);
    // Semi-implicit Euler after n steps of h: y = y0 - g h^2 n (n + 1) / 2; at most 0.1 mm of
    // recording.
    assert.ok(
      Math.abs(after.position[1] - (before.position[1] - (9.81 * 1e-4 * 50 * 51) / 2)) < 1e-4,
      String(after.position),
    );
    assert.ok(Math.abs(after.position[0] - 0.5) < 1e-4);
    assert.ok(Math.abs(after.velocity[1] + 9.81 * 0.5) < 0.02, String(after.velocity));
    assert.ok(Math.abs(after.spin[2] - 2) < 0.02, String(after.spin));

    // The ball has left its first place in the picture and colours its new one; the post stays as
    // it was.
    const drawn_after = await colour_at(page, place);
    assert.ok(difference(drawn_before, drawn_after) > 60, `${drawn_before} ${drawn_after}`);
    const new_place = await ask(page, "screen_position", ball);
    assert.ok(new_place[1] > place[1] + 15);
    const drawn_there = await colour_at(page, new_place);
    assert.ok(difference(drawn_there, drawn_after) > 60, `${drawn_there} ${drawn_after}`);

    await ask(page, "go_to_frame", 1e9);
    assert.equal(await ask(page, "time"), 1);
    await ask(page, "step_frames", -100);
    assert.deepEqual(await ask(page, "body", ball), before);
    assert.deepEqual(complaints, []);
    assert.deepEqual(requests, []);
    await context.close();
  },
);

await check(
  "a click shows the body's name and facts, and a name full of HTML stays text",
  async () => {
    const { page, context, complaints } = await open_replay(
      browser,
      join(folder, "fall.html"),
      quiet,
      { viewport: { width: 1280, height: 800 } },
    );
    await page.evaluate(() => globalThis.cairn_replay.go_to_time(0.2));
    await ask(page, "draw");
    const [x, y] = await ask(page, "screen_position", 1);
    await page.mouse.click(x, y);
    assert.equal(await ask(page, "selected"), 1);
    await ask(page, "draw");
    assert.equal(await page.textContent("[data-name]"), nasty);
    assert.equal(await page.textContent("[data-title]"), nasty);
    assert.equal(await page.title(), `${nasty} - Cairn replay`);
    assert.equal(await page.evaluate(() => document.querySelectorAll("b[onclick]").length), 0);
    const facts = await page.textContent("[data-facts]");
    for (const expected of ["dynamic", "sphere, radius 500 mm", "524 kg"])
      assert.ok(facts.includes(expected), facts);
    const html = readFileSync(join(folder, "fall.html"), "utf8");
    assert.ok(!html.includes(nasty), "the name stands in the page's source as it is");
    await page.keyboard.press("Escape");
    assert.equal(await ask(page, "selected"), -1);
    assert.deepEqual(complaints, []);
    await context.close();
  },
);

await check(
  "a capsule is drawn and found along its whole length, its round ends included, and not beyond",
  async () => {
    // Level along x from -1.9 to 1.9; specks within it and just outside mark the places.
    const within = [
      [0, 0, 0],
      [1.2, -0.3, 0],
      [-1.8, 0.1, 0],
      [1.75, 0, 0],
    ];
    const outside = [
      [0, 0.5, 0],
      [1.85, 0.35, 0],
      [-2.05, 0, 0],
    ];
    const specks = [...within, ...outside].map((position) => ({
      kind: "static",
      position,
      shapes: [{ kind: "sphere", radius: 0.01 }],
    }));
    const rod = {
      name: "rod",
      kind: "static",
      rotation: { axis: [0, 0, 1], degrees: 90 },
      shapes: [{ kind: "capsule", radius: 0.4, height: 3 }],
    };
    const scene = write_scene("rod", {
      cairn: 1,
      name: "rod",
      duration: 0.1,
      bodies: [rod, ...specks],
      camera: { eye: [0, 0, 9], target: [0, 0, 0] },
    });
    const { page, context, complaints } = await open_replay(browser, run(scene, "rod"), quiet, {
      viewport: { width: 1280, height: 800 },
    });
    await ask(page, "draw");
    for (let i = 1; i <= specks.length; ++i) {
      const [x, y] = await ask(page, "screen_position", i);
      await page.mouse.click(x, y);
      const is_rod = (await ask(page, "selected")) === 0;
      assert.equal(is_rod, i <= within.length, `speck ${i} at ${x}, ${y}`);
      await page.keyboard.press("Escape");
    }
    await page.mouse.click(...(await ask(page, "screen_position", 1)));
    await ask(page, "draw");
    const facts = await page.textContent("[data-facts]");
    assert.ok(facts.includes("capsule, radius 400 mm, height 3"), facts);
    assert.deepEqual(complaints, []);
    await context.close();
  },
);

await check("the timeline scrubs, the keys step, play moves on and stops at the end", async () => {
  const { page, context, complaints } = await open_replay(
    browser,
    join(folder, "fall.html"),
    quiet,
    { viewport: { width: 800, height: 700 } },
  );
  const rail = await page.locator(".timeline").boundingBox();
  await page.mouse.click(rail.x + 0.75 * rail.width, rail.y + rail.height / 2);
  assert.ok(Math.abs((await ask(page, "frame")) - 75) <= 1);
  await page.keyboard.press("ArrowRight");
  assert.ok(Math.abs((await ask(page, "frame")) - 76) <= 1);
  await page.keyboard.press("Home");
  assert.equal(await ask(page, "frame"), 0);
  await page.keyboard.press("Space");
  assert.equal(await ask(page, "playing"), true);
  for (let i = 0; i < 300 && (await ask(page, "playing")); ++i) await page.waitForTimeout(100);
  assert.equal(await ask(page, "playing"), false);
  assert.equal(await ask(page, "frame"), 100);
  await page.keyboard.press("?");
  assert.ok(await page.isVisible("[data-help]"));
  await page.keyboard.press("Escape");
  assert.ok(!(await page.isVisible("[data-help]")));
  assert.deepEqual(complaints, []);
  await context.close();
});

await check("poses, energies and contacts are those of the run's result file", async () => {
  const result_path = join(folder, "drop.json");
  const path = run("drop", "drop", "--json", result_path);
  const result = JSON.parse(readFileSync(result_path, "utf8"));
  const { page, context, complaints } = await open_replay(
    browser,
    path,
    quiet + "&contacts=on&normals=on&velocities=on&speeds=on",
  );
  await ask(page, "go_to_frame", 1e9);
  assert.equal(await ask(page, "step"), result.steps);
  for (const [i, body] of result.bodies.entries()) {
    const shown = await ask(page, "body", i);
    assert.equal(shown.name, body.name);
    const away = Math.hypot(...shown.position.map((v, k) => v - body.position[k]));
    assert.ok(away < 1e-3, `${body.name} is ${away} m away`);
    const same = Math.abs(shown.rotation.reduce((sum, v, k) => sum + v * body.rotation[k], 0));
    assert.ok(same > 1 - 1e-6, `${body.name} is turned: ${same}`);
  }
  const points = result.contacts.flatMap((contact) => contact.points);
  const shown = await ask(page, "contacts");
  assert.equal(shown.length, points.length);
  const total = (list) => list.reduce((sum, value) => sum + value, 0);
  const expected = total(points.map((p) => p.normal_impulse)),
    given = total(shown.map((c) => c.impulse));
  assert.ok(Math.abs(expected - given) <= 0.04 * expected, `${given} N s, not ${expected}`);
  await ask(page, "draw");
  assert.deepEqual(complaints, []);
  await context.close();
});

await check("a page of five thousand bodies opens, is under 30 MB and moves", async () => {
  const path = run("pit", "pit", "--set", "count=5000", "--steps", "6");
  const { page, context, complaints } = await open_replay(browser, path, quiet, {
    viewport: { width: 320, height: 240 },
  });
  assert.ok((await ask(page, "body_count")) >= 5000);
  const last = (await ask(page, "body_count")) - 1;
  const before = await ask(page, "body", last);
  await ask(page, "step_frames", 6);
  const after = await ask(page, "body", last);
  assert.ok(after.position[1] < before.position[1], "the last body does not fall");
  await ask(page, "draw");
  assert.deepEqual(complaints, []);
  await context.close();
});

await browser.close();
rmSync(folder, { recursive: true });
