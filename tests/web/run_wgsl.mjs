// Runs WGSL by Chromium's WebGPU: every call of kernels that zonal-language-turns writes.
//   node run_wgsl.mjs CHROMIUM TURNS.json WGSL_FOLDER OUT.f32
// WGSL_FOLDER holds orderNN/KERNEL.wgsl. Writes OUT.f32: little-endian floats, [order][kernel][vector][coefficient].
// Exit status 1 when a module has an error, or there is no WebGPU.

import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { run, withPage } from "./browser.mjs";

/// The functions of an order's file, and a compute shader around each call. Of three channels one holds the signal,
/// another one of every vector in turn, and that one is written; the others hold the signal backwards.
function shaders(functions, { order, count, kernels }) {
  const size = order * order;
  const loads = {
    1: "f[i] = signals[first + i];",
    3: `f[i] = vec3<f32>(signals[first + ${size - 1}u - i]);
        f[i][vector % 3u] = signals[first + i];`,
  };
  const main = ({ call, channels }, number) => `
@compute @workgroup_size(64)
fn main_${number}(@builtin(global_invocation_id) id: vec3<u32>) {
    let vector = id.x;
    let first = ${size}u * vector;
    if (vector >= ${count}u) {
        return;
    }
    var R: array<f32, 9>;
    for (var i = 0u; i < 9u; i++) {
        R[i] = rotations[9u * vector + i];
    }
    var f: array<${channels === 3 ? "vec3<f32>" : "f32"}, ${size}>;
    for (var i = 0u; i < ${size}u; i++) {
        ${loads[channels]}
    }
    var turned = ${call};
    for (var i = 0u; i < ${size}u; i++) {
        results[first + i] = turned[i]${channels === 3 ? "[vector % 3u]" : ""};
    }
}
`;
  return `${functions}
@group(0) @binding(0) var<storage, read> rotations: array<f32>;
@group(0) @binding(1) var<storage, read> signals: array<f32>;
@group(0) @binding(2) var<storage, read_write> results: array<f32>;
${kernels.map(main).join("")}`;
}

/// In the page: what every shader makes of the signals, each base64 of floats.
async function resultsOf({ code, turn: { count, signals, kernels } }) {
  if (!navigator.gpu) throw new Error("the browser has no navigator.gpu: check its flags");
  const adapter = await navigator.gpu.requestAdapter();
  if (!adapter) throw new Error("WebGPU gives no adapter: check the flags in browser.mjs");
  const device = await adapter.requestDevice();
  const buffer = (size, usage) => device.createBuffer({ size, usage });
  const filled = (values) => {
    const array = new Float32Array(values);
    const made = buffer(array.byteLength, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST);
    device.queue.writeBuffer(made, 0, array);
    return made;
  };
  const bytes = 4 * signals.length;
  const parts = [];
  device.pushErrorScope("validation");
  const module = device.createShaderModule({ code });
  const input = filled(signals);
  for (const [number, { rotations }] of kernels.entries()) {
    const results = buffer(bytes, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC);
    const readable = buffer(bytes, GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST);
    const pipeline = await device.createComputePipelineAsync({
      layout: "auto",
      compute: { module, entryPoint: `main_${number}` },
    });
    const group = device.createBindGroup({
      layout: pipeline.getBindGroupLayout(0),
      entries: [filled(rotations), input, results].map((made, binding) => ({ binding, resource: { buffer: made } })),
    });
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginComputePass();
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, group);
    pass.dispatchWorkgroups(Math.ceil(count / 64));
    pass.end();
    encoder.copyBufferToBuffer(results, 0, readable, 0, bytes);
    device.queue.submit([encoder.finish()]);
    await readable.mapAsync(GPUMapMode.READ);
    let characters = "";
    for (const byte of new Uint8Array(readable.getMappedRange())) characters += String.fromCharCode(byte);
    parts.push(btoa(characters));
  }
  const error = await device.popErrorScope();
  if (error) throw new Error(error.message);
  return parts;
}

run(async () => {
  const [chromium, turns, folder, out] = process.argv.slice(2);
  if (!out) throw new Error("wanted: node run_wgsl.mjs CHROMIUM TURNS.json WGSL_FOLDER OUT.f32");
  const here = path.dirname(fileURLToPath(import.meta.url));
  await withPage(chromium, here, { "/": fileURLToPath(import.meta.url) }, async (page) => {
    await page.goto("https://zonal.test/");
    const parts = [];
    for (const turn of JSON.parse(readFileSync(turns, "utf8"))) {
      const order = path.join(folder, `order${String(turn.order).padStart(2, "0")}`);
      const names = [...new Set(turn.kernels.flatMap((kernel) => kernel.files))];
      const functions = names.map((name) => readFileSync(path.join(order, `${name}.wgsl`), "utf8")).join("");
      const code = shaders(functions, turn);
      for (const part of await page.evaluate(resultsOf, { code, turn })) parts.push(Buffer.from(part, "base64"));
    }
    writeFileSync(out, Buffer.concat(parts));
    console.log(`${parts.length} kernels of WGSL run`);
  });
});
