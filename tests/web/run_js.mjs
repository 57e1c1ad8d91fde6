// Runs JavaScript kernels: every call that zonal-language-turns writes.
//   node run_js.mjs TURNS.json JS_FOLDER OUT.f64
// JS_FOLDER holds orderNN/KERNEL.mjs. Writes OUT.f64: little-endian doubles, [order][kernel][vector][coefficient].

import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";

/// One vector a call, where it lies in longer arrays.
function turnOne(rotate, R, f, out, at) {
  rotate(R, f, out, at, at);
}

/// Three channels: one holds the signal, another one of every vector in turn, the others hold it backwards. Two
/// vectors a call, the second one the first one's channels in another order, which must turn to the same numbers.
function turnThree(rotateRgb, R, f, out, at, size, vector) {
  const held = vector % 3;
  const triples = new Float64Array(6 * size);
  for (let i = 0; i < size; ++i)
    for (let c = 0; c < 3; ++c) {
      const value = c === held ? f[at + i] : f[at + size - 1 - i];
      triples[3 * i + c] = value;
      triples[3 * (size + i) + ((c + 1) % 3)] = value;
    }
  rotateRgb(R, triples, triples, 0, 0, 2);
  for (let i = 0; i < size; ++i) {
    out[at + i] = triples[3 * i + held];
    if (!Object.is(out[at + i], triples[3 * (size + i) + ((held + 1) % 3)]))
      throw new Error(`vector ${vector}, coefficient ${i}: the second vector of a call turns otherwise than the first`);
  }
}

const [turnsFile, folder, outFile] = process.argv.slice(2);
if (!outFile) throw new Error("wanted: node run_js.mjs TURNS.json JS_FOLDER OUT.f64");
const parts = [];
for (const { order, count, signals, kernels } of JSON.parse(readFileSync(turnsFile, "utf8"))) {
  const size = order * order;
  const input = new Float64Array(signals);
  for (const { call, files, channels, rotations } of kernels) {
    const file = path.join(folder, `order${String(order).padStart(2, "0")}`, `${files[0]}.mjs`);
    const kernel = (await import(pathToFileURL(file)))[call];
    if (!kernel) throw new Error(`${file}: found no function ${call}`);
    const out = new Float64Array(input.length);
    for (let vector = 0; vector < count; ++vector) {
      const R = rotations.slice(9 * vector, 9 * vector + 9);
      const at = size * vector;
      if (channels === 3) turnThree(kernel, R, input, out, at, size, vector);
      else turnOne(kernel, R, input, out, at);
    }
    parts.push(Buffer.from(out.buffer));
  }
}
writeFileSync(outFile, Buffer.concat(parts));
console.log(`${parts.length} kernels of JavaScript run`);
