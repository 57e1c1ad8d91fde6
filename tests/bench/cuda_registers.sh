#!/usr/bin/env bash
# Registers, spills and stack of the C++ kernels compiled as CUDA, one vector a thread; needs nvcc and no GPU.
#   bash tests/bench/cuda_registers.sh [ARCHITECTURE [ORDER...]]      e.g. sm_86 3 4 5 6
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
command -v nvcc >/dev/null || { echo "cuda_registers: found no nvcc on PATH; install the CUDA toolkit" >&2; exit 1; }
architecture=${1:-sm_86}
shift $(($# > 0))
[ $# -gt 0 ] || set -- 3 4 5 6 7 8 9 10
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
nvcc --version | sed -n 's/.*release \([^,]*\),.*/nvcc \1/p'
printf '%s\n\n| N | kernel | registers | spill stores, loads, bytes | stack, bytes |\n|---|---|---|---|---|\n' "$architecture"
for order in "$@"; do
  for kernel in rotate rotate_accurate rotate_zhf; do
    cat >"$folder/kernel.cu" <<CODE
#include "zonal/order$(printf %02d "$order")/$kernel.hpp"
extern "C" __global__ void turn(const float* R, const float* f, float* out, unsigned count) {
    const unsigned v = blockIdx.x * blockDim.x + threadIdx.x;
    if (v < count)
        zonal::order$order::$kernel<float>(R + 9 * v, f + $((order * order)) * v, out + $((order * order)) * v);
}
CODE
    nvcc -std=c++17 -Igenerated/cpp -cubin -arch="$architecture" -Xptxas -v -o "$folder/kernel.cubin" "$folder/kernel.cu" 2>&1 |
      awk -v order="$order" -v kernel="$kernel" '
        /stack frame/ { stack = $1; stores = $5; loads = $9 }
        /Used/ { for (i = 1; i <= NF; ++i) if ($i == "Used") registers = $(i + 1) }
        /error|warning/ && ++errors <= 5 { print > "/dev/stderr" }
        END { if (errors || registers == "") exit 1
              printf "| %d | %s | %d | %d, %d | %d |\n", order, kernel, registers, stores, loads, stack }'
  done
done
