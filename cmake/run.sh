#!/usr/bin/env bash
# The main job: searches lobes for an order, emits and compiles its kernels, and rotates a real environment map
# by them. Writes under build/run/, and builds zonal-gen in build/release/.
#   bash cmake/run.sh [--accept] [ORDER [MAP [options of zonal rotate-map, such as --axis 0 0 1 --angle-degrees 30]]]
# ORDER: 3 … 20, default 4. MAP: latitude-longitude .exr or .hdr, default tests/data/studio.exr.
# --accept: also puts the table and the code in place, under generator/tables and generated/.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
accept=no
if [ "${1:-}" = --accept ]; then accept=yes; shift; fi
order=${1:-4}
map=$(realpath -m "${2:-$root/tests/data/studio.exr}")
shift $(($# < 2 ? $# : 2))
cd "$root"

bash cmake/install_packages.sh
out=$root/build/run
mkdir -p "$out"
log=$out/build.log
quietly() { "$@" >"$log" 2>&1 || { cat "$log" >&2; exit 1; }; }
build() { # FOLDER TARGETS [options of cmake]: by the release preset; a terminal shows ninja's progress, a pipe nothing
  local folder=$1 targets=$2
  shift 2
  echo "building: $targets"
  quietly cmake --preset release -B "$folder" "$@"
  if [ -t 1 ]; then
    cmake --build "$folder" --target $targets
  else
    quietly cmake --build "$folder" --target $targets
  fi
}

build build/release zonal-gen # where cmake/test.sh builds too
gen=$root/build/release/bin/zonal-gen
table=$out/tables/order$(printf %02d "$order" 2>/dev/null || echo "$order").json
"$gen" search --order "$order" --out "$table"
"$gen" emit --order "$order" --language cpp --table "$table" --out "$out/generated/cpp"
"$gen" stats --order "$order" --table "$table" --json >"$out/stats.json"

build "$out/kernels" "zonal zonal-report" -DZONAL_BUILD_GENERATOR=OFF -DZONAL_BUILD_GPU_TESTS=OFF \
  -DZONAL_BATCH_TARGETS=baseline -DZONAL_ORDERS="$order" -DZONAL_GENERATED_DIR="$out/generated/cpp"
"$out/kernels/bin/zonal" rotate-map --order "$order" --map "$map" --out "$out/images" "$@"
"$out/kernels/bin/zonal-report" --stats "$out/stats.json"

if [ "$accept" = yes ]; then
  committed=generator/tables/shared/$(basename "$table")
  if ! cmp -s "$table" "$committed"; then # no code without the bound of its table
    cp "$table" "$committed"
    build build/release zonal-measure-bounds
    build/release/bin/zonal-measure-bounds --missing --orders "$order" --out generator/bounds/bounds.json
  fi
  "$gen" emit --order "$order" --language cpp --out generated/cpp
  echo "accepted. Next: list the order in cmake/orders.cmake"
fi
