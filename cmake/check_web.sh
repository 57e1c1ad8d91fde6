#!/usr/bin/env bash
# Runs the JavaScript of generated/js in node. In headless Chromium: compiles generated/glsl as GLSL ES 3.00, and
# generated/wgsl; runs the WGSL of orders 3, 4 and 6; compares every turn with the oracle; renders a ball under a turning
# light by orders 3 and 4 in WebGL2, and compares every pixel with C++ and with the oracle. Draws tests/bench/speed_error.svg
# again and compares. Installs Chromium, Node.js and npm where missing.
#   bash cmake/check_web.sh [BUILD_FOLDER, default build/release]
# Writes build/check_web/: lit_sphere.png (orders downwards, turns to the right), scene.json, values.f32; turns.json and
# turned.f32 of the WGSL, js_turns.json and js_turned.f64 of JavaScript.
# Exit status not zero, and what differs, when a turn is not within its published bound, or a pixel is off by more than
# rounding explains.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$(realpath "${1:-$root/build/release}")
work=$root/build/check_web

packages=(chromium)
command -v node >/dev/null || packages+=(nodejs)
command -v npm >/dev/null || packages+=(npm) # a Node.js from elsewhere brings its own, and refuses Debian's
bash "$root/cmake/install_packages.sh" "${packages[@]}"
chromium=$(command -v chromium)

cmake --build "$build" --target zonal-lit-sphere zonal-language-turns
judge=$build/bin/zonal-lit-sphere

# npm installs beside the scripts that import: copies, so that the sources stay clean.
mkdir -p "$work"
rm -f "$work"/{values.f32,lit_sphere.png,turned.f32,js_turned.f64}
cp "$root"/tests/web/{*.mjs,package.json,package-lock.json} "$work/"
if ! (cd "$work" && npm ci --no-audit --no-fund) >"$work/npm.log" 2>&1; then
  cat "$work/npm.log" >&2
  echo "npm ci failed: playwright-core could not be installed from the npm registry" >&2
  exit 1
fi

node "$root/tests/bench/speed_error.mjs" "$root/tests/bench/speed_error.json" "$work/speed_error.svg"
cmp "$work/speed_error.svg" "$root/tests/bench/speed_error.svg" || {
  echo "tests/bench/speed_error.svg is not what its numbers give; draw it: node tests/bench/speed_error.mjs" >&2
  exit 1
}

turns=$build/bin/zonal-language-turns
"$turns" js write "$work/js_turns.json"
timeout 120 node "$work/run_js.mjs" "$work/js_turns.json" "$root/generated/js" "$work/js_turned.f64"
"$turns" js compare "$work/js_turned.f64"

timeout 120 node "$work/check_wgsl.mjs" "$chromium" "$root"/generated/wgsl/*/*.wgsl || {
  echo "Chromium's WebGPU does not take what generator/emit/wgsl.cpp prints (status $?)" >&2
  exit 1
}

"$turns" wgsl write "$work/turns.json"
timeout 300 node "$work/run_wgsl.mjs" "$chromium" "$work/turns.json" "$root/generated/wgsl" "$work/turned.f32" || {
  echo "Chromium's WebGPU did not run what generator/emit/wgsl.cpp prints (status $?; 124: not within five minutes)" >&2
  exit 1
}
"$turns" wgsl compare "$work/turned.f32"

"$judge" scene --map "$root/tests/data/studio.exr" --out "$work/scene.json"
timeout 120 node "$work/render.mjs" "$chromium" "$root" "$work/scene.json" "$work" || {
  echo "Chromium did not render tests/web/lit_sphere.html (status $?; 124: not within two minutes)" >&2
  exit 1
}
"$judge" compare "$work/scene.json" "$work/values.f32"
echo "the browser draws what C++ computes: $work/lit_sphere.png"
