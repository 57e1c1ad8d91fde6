// Renders lit_sphere.html in headless Chromium.
//   node render.mjs CHROMIUM SOURCES SCENE.json OUT_FOLDER
// Compiles besides every file of generated/glsl that is for ES 3.00: all but rotate_tailored.glsl.
// Writes OUT_FOLDER/values.f32 (little-endian floats, laid out as lit_sphere.mjs says) and OUT_FOLDER/lit_sphere.png.

import { readdirSync, writeFileSync } from "node:fs";
import path from "node:path";
import { run, withPage } from "./browser.mjs";

run(async () => {
  const [chromium, sources, scene, out] = process.argv.slice(2);
  if (!out) throw new Error("wanted: node render.mjs CHROMIUM SOURCES SCENE.json OUT_FOLDER");
  await withPage(chromium, sources, { "/scene.json": scene }, async (page) => {
    const kernels = readdirSync(path.join(sources, "generated/glsl"), { recursive: true })
      .filter((name) => name.endsWith(".glsl") && !name.endsWith("rotate_tailored.glsl"))
      .map((name) => `/generated/glsl/${name}`);
    await page.setViewportSize({ width: 1280, height: 800 });
    await page.goto("https://zonal.test/tests/web/lit_sphere.html?scene=/scene.json");
    await page.waitForFunction(() => window.result);
    const { renderer, uniforms, values } = await page.evaluate(() => window.result);
    writeFileSync(path.join(out, "values.f32"), Buffer.from(values, "base64"));
    await page.locator("#pictures").screenshot({ path: path.join(out, "lit_sphere.png"), omitBackground: true });
    await page.evaluate(async (urls) => (await import("./lit_sphere.mjs")).compileAll(urls), kernels);
    console.log(`${kernels.length} files of generated/glsl compile as GLSL ES 3.00`);
    console.log(`rendered by ${renderer} (${uniforms} uniform vectors a fragment shader)`);
  });
});
