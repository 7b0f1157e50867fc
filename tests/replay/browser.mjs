// Opens replay pages in a headless Chromium that can reach no network; shared by the test beside
// this file and by tools/make_pictures.mjs.
//
// open_browser() answers {browser} or {missing: what to install}. Chromium is the one that
// CAIRN_CHROMIUM names, or Debian's. WebGL is drawn in software: a few frames a second at best.

import { existsSync } from "node:fs";

const chromium_places = [
  process.env.CAIRN_CHROMIUM,
  "/usr/bin/chromium",
  "/usr/bin/chromium-browser",
  "/usr/bin/google-chrome",
];

export async function open_browser() {
  const executablePath = chromium_places.find((path) => path && existsSync(path));
  if (!executablePath) return { missing: "chromium (apt-get install chromium)" };
  let playwright;
  try {
    playwright = await import("playwright-core");
  } catch {
    return { missing: "playwright-core (npm ci in tests/replay)" };
  }
  const browser = await playwright.chromium.launch({
    executablePath,
    args: [
      "--no-sandbox",
      "--disable-quic",
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
    ],
  });
  return { browser };
}

// Opens the page written to `path` and waits until it plays. `options` go after the address's #.
// Answers the page and what it complained about or asked the network for.
export async function open_replay(browser, path, options, view = {}) {
  const context = await browser.newContext({
    viewport: { width: 640, height: 480 },
    colorScheme: "light",
    offline: true,
    ...view,
  });
  const page = await context.newPage();
  page.setDefaultTimeout(120000);
  const complaints = [],
    requests = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) complaints.push(message.text());
  });
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) requests.push(request.url());
  });
  await page.goto(`file://${path}#${options}`, { waitUntil: "commit" });
  // By asking again and again: the page's own policy forbids the eval that waitForFunction needs.
  for (let i = 0; ; ++i) {
    if (await page.evaluate(() => Boolean(globalThis.cairn_replay)).catch(() => false)) break;
    if (i > 600 || complaints.some((text) => text.includes("Error"))) {
      throw new Error(`the page did not start: ${complaints.join("; ") || "no word from it"}`);
    }
    await new Promise((resolve) => setTimeout(resolve, 200));
  }
  return { page, context, complaints, requests };
}
