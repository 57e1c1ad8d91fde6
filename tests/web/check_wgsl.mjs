// Compiles WGSL files by Chromium's WebGPU and prints what it says of them.
//   node check_wgsl.mjs CHROMIUM FILE.wgsl...
// Exit status 1 when a file has an error, or there is no WebGPU.

import { readFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { run, withPage } from "./browser.mjs";

/// In the page: [{ type, line, column, text }] of one module.
async function messagesOf(code) {
  if (!navigator.gpu) throw new Error("the browser has no navigator.gpu: check its flags");
  if (!window.device) {
    const adapter = await navigator.gpu.requestAdapter();
    if (!adapter) throw new Error("WebGPU gives no adapter: check the flags in browser.mjs");
    window.device = await adapter.requestDevice();
  }
  window.device.pushErrorScope("validation");
  const info = await window.device.createShaderModule({ code }).getCompilationInfo();
  await window.device.popErrorScope();
  return info.messages.map((m) => ({ type: m.type, line: m.lineNum, column: m.linePos, text: m.message }));
}

run(async () => {
  const [chromium, ...files] = process.argv.slice(2);
  if (files.length === 0) throw new Error("wanted: node check_wgsl.mjs CHROMIUM FILE.wgsl...");
  const here = path.dirname(fileURLToPath(import.meta.url));
  await withPage(chromium, here, { "/": fileURLToPath(import.meta.url) }, async (page) => {
    await page.goto("https://zonal.test/");
    let errors = 0;
    for (const file of files) {
      for (const message of await page.evaluate(messagesOf, readFileSync(file, "utf8"))) {
        console.log(`${file}:${message.line}:${message.column}: ${message.type}: ${message.text}`);
        errors += message.type === "error" ? 1 : 0;
      }
    }
    if (errors > 0) throw new Error(`${errors} errors in WGSL, wanted none`);
    console.log(`${files.length} WGSL files compile`);
  });
});
