// Renders lit_sphere.html in headless Chromium.
//   node render.mjs CHROMIUM SOURCES SCENE.json OUT_FOLDER
// Writes OUT_FOLDER/values.f32 (little-endian floats, laid out as lit_sphere.mjs says) and OUT_FOLDER/lit_sphere.png.

import { writeFileSync } from "node:fs";
import path from "node:path";
import { run, withPage } from "./browser.mjs";

run(async () => {
  const [chromium, sources, scene, out] = process.argv.slice(2);
  if (!out) throw new Error("wanted: node render.mjs CHROMIUM SOURCES SCENE.json OUT_FOLDER");
  await withPage(chromium, sources, { "/scene.json": scene }, async (page) => {
    await page.setViewportSize({ width: 1280, height: 800 });
    await page.goto("https://zonal.test/tests/web/lit_sphere.html?scene=/scene.json");
    await page.waitForFunction(() => window.result);
    const { renderer, uniforms, values } = await page.evaluate(() => window.result);
    writeFileSync(path.join(out, "values.f32"), Buffer.from(values, "base64"));
    await page.locator("#pictures").screenshot({ path: path.join(out, "lit_sphere.png"), omitBackground: true });
    console.log(`rendered by ${renderer} (${uniforms} uniform vectors a fragment shader)`);
  });
});
