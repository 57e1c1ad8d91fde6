// Times and errors of generated JavaScript beside the rotation of @playcanvas/splat-transform, in one process:
// order 4 (degree 3), three channels, Float32Array, kernels in turn.
//   npm install --prefix FOLDER @playcanvas/splat-transform
//   node tests/bench/js_rotation.mjs FOLDER/node_modules/@playcanvas/splat-transform
// Its class is not exported: a copy of its bundle that exports it is written beside that.

import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { rotate_rgb } from "../../generated/js/order04/rotate.mjs";
import { rotate_accurate, rotate_accurate_rgb } from "../../generated/js/order04/rotate_accurate.mjs";

const [folder] = process.argv.slice(2);
if (!folder) throw new Error("wanted: node js_rotation.mjs FOLDER of @playcanvas/splat-transform");
const bundle = readFileSync(path.join(folder, "dist/index.mjs"), "utf8");
const copy = path.join(folder, "dist/with_rotate_sh.mjs");
writeFileSync(copy, `${bundle}\nexport { RotateSH };\n`);
const { RotateSH } = await import(pathToFileURL(path.resolve(copy)));
const { version } = JSON.parse(readFileSync(path.join(folder, "package.json"), "utf8"));

const kVectors = 1024;
const kRounds = 40;
let state = 12345; // xorshift: the same numbers every time
const uniform = () => {
  state ^= state << 13;
  state ^= state >>> 17;
  state ^= state << 5;
  return (state >>> 0) / 2 ** 32;
};

function randomRotation() {
  const [a, b, c] = [uniform(), uniform(), uniform()];
  const [x, y, z, w] = [
    Math.sqrt(1 - a) * Math.sin(2 * Math.PI * b),
    Math.sqrt(1 - a) * Math.cos(2 * Math.PI * b),
    Math.sqrt(a) * Math.sin(2 * Math.PI * c),
    Math.sqrt(a) * Math.cos(2 * Math.PI * c),
  ];
  return [
    1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
    2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
    2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y),
  ];
}

const rotations = Array.from({ length: kVectors }, randomRotation);
// Theirs: columns, and the sign (-1)^m of 3DGS; ours: rows, and that sign as ZRZ.
const theirs = rotations.map((R) => ({ data: Float32Array.from([0, 3, 6, 1, 4, 7, 2, 5, 8], (k) => R[k]) }));
const ours = rotations.map((R) => Float32Array.from(R, (r, k) => ([2, 5, 6, 7].includes(k) ? -r : r)));
const signal = Float32Array.from({ length: 48 * kVectors }, () => uniform() - 0.5);
const channels = Array.from({ length: 3 * kVectors }, (_, k) =>
  Float32Array.from({ length: 15 }, (_, i) => signal[48 * Math.floor(k / 3) + 3 * (i + 1) + (k % 3)]),
);
const out = new Float32Array(signal.length);
const turned = channels.map((channel) => new Float32Array(channel.length));

function theirApply(rotation, v) {
  for (let c = 0; c < 3; ++c) rotation.apply(turned[3 * v + c], channels[3 * v + c]);
}
const one = new RotateSH(theirs[0]);
const each = (kernel) => () => {
  for (let v = 0; v < kVectors; ++v) kernel(ours[v], signal, out, 48 * v, 48 * v);
};
const contestants = {
  each: {
    "splat-transform": () => {
      for (let v = 0; v < kVectors; ++v) theirApply(new RotateSH(theirs[v]), v);
    },
    rotate_rgb: each(rotate_rgb),
    rotate_accurate_rgb: each(rotate_accurate_rgb),
  },
  one: {
    "splat-transform": () => {
      for (let v = 0; v < kVectors; ++v) theirApply(one, v);
    },
    rotate_rgb: () => rotate_rgb(ours[0], signal, out, 0, 0, kVectors),
    rotate_accurate_rgb: () => rotate_accurate_rgb(ours[0], signal, out, 0, 0, kVectors),
  },
};

/// Largest relative error of a channel, beside rotate_accurate in double by the matrix that was given.
function largestError(name, rotationOf) {
  let largest = 0;
  const exact = new Float64Array(16);
  for (let v = 0; v < kVectors; ++v)
    for (let c = 0; c < 3; ++c) {
      const f = Float64Array.from({ length: 16 }, (_, i) => signal[48 * v + 3 * i + c]);
      rotate_accurate(rotationOf(v), f, exact);
      let squares = 0;
      let norm = 0;
      for (let i = 1; i < 16; ++i) {
        const found = name === "splat-transform" ? turned[3 * v + c][i - 1] : out[48 * v + 3 * i + c];
        squares += (found - exact[i]) ** 2;
        norm += exact[i] ** 2;
      }
      largest = Math.max(largest, Math.sqrt(squares / norm));
    }
  return largest;
}

console.log(`node ${process.version}, @playcanvas/splat-transform ${version}, order 4, RGB, best of ${kRounds} rounds`);
for (const [workload, kernels] of Object.entries(contestants)) {
  const best = {};
  for (let round = 0; round < kRounds; ++round)
    for (const [name, run] of Object.entries(kernels)) {
      const start = performance.now();
      run();
      best[name] = Math.min(best[name] ?? Infinity, performance.now() - start);
    }
  console.log(workload === "each" ? "a rotation of its own for each vector:" : "one rotation:");
  for (const [name, run] of Object.entries(kernels)) {
    run();
    const error = largestError(name, (v) => ours[workload === "each" ? v : 0]);
    const time = (1e6 * best[name]) / kVectors;
    console.log(
      `  ${name.padEnd(20)} ${time.toFixed(1).padStart(8)} ns a vector, ` +
        `${(best["splat-transform"] / best[name]).toFixed(1)} times as fast, error ${error.toExponential(1)}`,
    );
  }
}
