#!/usr/bin/env bash
# Generated headers as CUDA: every kernel of a rotation is called from device code as it stands, compiled by clang++
# to PTX; needs neither CUDA nor a GPU. Registers and spills, by nvcc: tests/bench/cuda_registers.sh
#   bash cmake/check_cuda.sh [FOLDER of generated C++, default generated/cpp]
# Exit status not zero, and what the compiler says, when a header is refused.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder=${1:-generated/cpp}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# What the toolkit's headers would define.
{
  for side in host device global; do printf '#define __%s__ __attribute__((%s))\n' $side $side; done
  find "$folder/zonal" -path '*/order*/rotate*.hpp' | LC_ALL=C sort | while read -r header; do
    kernel=$(basename "$header" .hpp)
    order=$(basename "$(dirname "$header")")
    order=$((10#${order#order}))
    printf '#include "%s"\n' "$(realpath "$header")"
    printf '__global__ void %s%d(const float* R, const float* f, float* out) { zonal::order%d::%s<float>(R, f, out); }\n' \
      "$kernel" "$order" "$order" "$kernel"
  done
} >"$work/kernels.cu"
clang++ -x cuda -std=c++17 -Wall -Wextra -Werror -Wno-unknown-cuda-version --cuda-device-only --cuda-gpu-arch=sm_70 \
  -nocudainc -nocudalib -D__CUDACC__ -I"$folder" -S -o "$work/kernels.ptx" "$work/kernels.cu"
wanted=$(grep -c '^__global__' "$work/kernels.cu" || true)
found=$(grep -c '^\.visible \.entry' "$work/kernels.ptx" || true)
if [ "$wanted" = 0 ] || [ "$wanted" != "$found" ]; then
  echo "$folder: found $found kernels in the PTX, wanted $wanted and at least one" >&2
  exit 1
fi
echo "$found kernels compile for a GPU"
