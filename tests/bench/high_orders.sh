#!/usr/bin/env bash
# Speed and error of orders that have no committed code: writes their kernels, builds zonal-bench with them in
# build/high_orders, best instruction set alone, and runs it. Order 20 takes minutes to compile.
# Usage: bash tests/bench/high_orders.sh "12 16 20" [OPTIONS OF zonal-bench...]
# TARGET=avx2 has batches compiled for that set; ZONAL_GEN names another zonal-gen.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
orders=${1:?the orders, in quotes}
shift
gen=${ZONAL_GEN:-build/release/bin/zonal-gen}
[ -x "$gen" ] || { echo "$gen: not found; build it, or name another by ZONAL_GEN" >&2; exit 1; }
target=${TARGET:-avx512}
build=build/high_orders
for order in $orders; do
  "$gen" emit --order "$order" --language cpp --out "$build/kernels" >&2
done
cmake -G Ninja -S . -B "$build" -DCMAKE_BUILD_TYPE=Release -DZONAL_ORDERS="${orders// /;}" \
  -DZONAL_GENERATED_DIR="$PWD/$build/kernels" -DZONAL_BATCH_TARGETS="$target" -DZONAL_BUILD_GENERATOR=OFF \
  -DZONAL_BUILD_GPU_TESTS=OFF >&2
cmake --build "$build" --target zonal-bench >&2
"$build/bin/zonal-bench" "$@"
