#!/usr/bin/env bash
# Compiles the batch kernels for 64-bit ARM, whose NEON packs are chosen at compile time, and counts their
# fused instructions: none would mean that Highway fell back to scalars. Needs g++-aarch64-linux-gnu.
#   bash cmake/check_neon.sh [BUILD_FOLDER with zonal/orders.hpp, default build/release]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$(realpath "${1:-$root/build/release}")
work=$root/build/check_neon
mkdir -p "$work/include"
# Highway's headers alone: those beside them are of this processor.
ln -sfn /usr/include/hwy "$work/include/hwy"
for scalar in float double; do
  aarch64-linux-gnu-g++ -std=c++20 -O1 -march=armv8-a+crypto -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Werror \
    -isystem "$work/include" -I"$root/generated/cpp" -I"$build/runtime/include" \
    -DZONAL_BATCH_SCALAR=$scalar -DZONAL_BATCH_ENTRY=baseline_$scalar \
    -c "$root/runtime/src/batch/kernels.cpp" -o "$work/$scalar.o"
  fused=$(aarch64-linux-gnu-objdump -d "$work/$scalar.o" | grep -cE '\sfml[as]\sv.*\.(4s|2d)') || true
  echo "NEON, $scalar: $fused fused multiply-adds on whole registers"
  [ "$fused" -gt 1000 ]
done
