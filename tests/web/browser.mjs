// Debian's Chromium, headless, with graphics on the processor (SwiftShader): the same result on every machine.

import { mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { chromium } from "playwright-core";

const FLAGS = [
  "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update",
  "--disable-sync", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
  "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader",
];
const TYPES = { ".html": "text/html", ".mjs": "text/javascript", ".json": "application/json" };

/// Calls `use(page)` with a page that sees the files of `root` under https://zonal.test/ and nothing of the network;
/// `extra` maps further paths to files. Returns what `use` returns; the browser is closed either way.
/// A secure origin: WebGPU needs one.
export async function withPage(executablePath, root, extra, use) {
  const profile = mkdtempSync(path.join(tmpdir(), "zonal-chromium-"));
  const context = await chromium.launchPersistentContext(profile, { executablePath, headless: true, args: FLAGS });
  try {
    await context.route("**/*", (route) => {
      const url = new URL(route.request().url());
      const file = extra[url.pathname] ?? path.join(root, url.pathname);
      const isFile = url.host === "zonal.test" && statSync(file, { throwIfNoEntry: false })?.isFile();
      if (!isFile) return route.fulfill({ status: 404, body: "" });
      return route.fulfill({
        body: readFileSync(file),
        contentType: TYPES[path.extname(file)] ?? "text/plain",
      });
    });
    const page = context.pages()[0] ?? (await context.newPage());
    page.on("console", (message) => {
      if (message.type() === "error") console.error(`page: ${message.text()}`);
    });
    page.on("pageerror", (error) => console.error(`page: ${error.message}`));
    return await use(page);
  } finally {
    await context.close();
    rmSync(profile, { recursive: true, force: true });
  }
}

/// Runs a script's main function; a failure is one line on stderr and exit status 1.
export async function run(main) {
  try {
    await main();
  } catch (error) {
    console.error(`error: ${error.message.split("\n")[0]}`);  // the rest is where in the page
    process.exitCode = 1;
  }
}
