#!/usr/bin/env bash
# Speed and error of orders that have no committed code: writes their kernels, builds zonal-bench with them in
# build/high_orders and runs it. Order 20 takes minutes to compile, so batches are built for one instruction set.
# Usage: bash tests/bench/high_orders.sh "12 16 20" [OPTIONS OF zonal-bench...]
# TARGET names that set, by default the best this processor has (none but the baseline outside x86);
# ZONAL_GEN names another zonal-gen.
set -euo pipefail
gen=$(realpath -m "${ZONAL_GEN:-$(dirname "${BASH_SOURCE[0]}")/../../build/release/bin/zonal-gen}")
[ -x "$gen" ] || { echo "$gen: not found; build it, or name another by ZONAL_GEN" >&2; exit 1; }
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
orders=${1:?the orders, in quotes}
shift
best=baseline
for flag_and_set in sse4_2:sse4 avx2:avx2 avx512vl:avx512; do
  if grep -qw "${flag_and_set%:*}" /proc/cpuinfo; then best=${flag_and_set#*:}; fi
done
target=${TARGET:-$best}
build=build/high_orders
for order in $orders; do
  "$gen" emit --order "$order" --language cpp --out "$build/kernels" >&2
done
cmake -G Ninja -S . -B "$build" -DCMAKE_BUILD_TYPE=Release -DZONAL_ORDERS="${orders// /;}" \
  -DZONAL_GENERATED_DIR="$PWD/$build/kernels" -DZONAL_BATCH_TARGETS="$target" -DZONAL_BUILD_GENERATOR=OFF \
  -DZONAL_BUILD_GPU_TESTS=OFF >&2
cmake --build "$build" --target zonal-bench >&2
"$build/bin/zonal-bench" "$@"
