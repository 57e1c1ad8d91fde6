#!/usr/bin/env bash
# Writes generator/paper/paper.html anew: this project's numbers beside the paper's, with the figure drawn in.
#   bash cmake/paper_page.sh [ZONAL_GEN, default build/release/bin/zonal-gen]
# Needs Node.js and npm, and the npm registry for vega and vega-lite.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
gen=${1:-build/release/bin/zonal-gen}
work=build/paper
mkdir -p "$work"
cp generator/paper/page/{draw.mjs,package.json,package-lock.json} "$work/"
(cd "$work" && npm ci --no-audit --no-fund --silent)
"$gen" paper --html "$work/page.html" >"$work/paper.txt"
node "$work/draw.mjs" "$work/page.html" generator/paper/paper.html
echo generator/paper/paper.html
