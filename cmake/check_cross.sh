#!/usr/bin/env bash
# Takes the committed compute modules through spirv-cross to HLSL, MSL and ESSL 3.10, and the ESSL through
# glslangValidator. Fails if a tool refuses one; names every such module and prints what the tool said.
#   bash cmake/check_cross.sh [FOLDER of .spvasm files, default generated/spirv]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=$(realpath "${1:-$root/generated/spirv}")
for tool in spirv-as spirv-cross glslangValidator; do
  command -v $tool >/dev/null || { echo "found no $tool; run: bash cmake/install_packages.sh" >&2; exit 1; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# One module; its output is shown where a tool refuses it.
check() {
  local name out
  name=$(basename "$(dirname "$1")")_$(basename "$1" .spvasm)
  out=$2/$name
  if ! {
    spirv-as --preserve-numeric-ids --target-env spv1.3 "$1" -o "$out.spv" &&
    spirv-cross "$out.spv" --hlsl --shader-model 50 --output "$out.hlsl" &&
    spirv-cross "$out.spv" --msl --output "$out.metal" &&
    spirv-cross "$out.spv" --es --version 310 --output "$out.comp" &&
    glslangValidator -S comp "$out.comp"
  } >"$out.log" 2>&1; then
    printf '%s:\n%s\n' "$1" "$(cat "$out.log")" >&2
    return 1
  fi
  rm -f "$out".*
}
export -f check

mapfile -t modules < <(find "$folder" -name '*.spvasm' | LC_ALL=C sort)
[ ${#modules[@]} -gt 0 ] || { echo "$folder: found no .spvasm, wanted compute modules" >&2; exit 1; }
printf '%s\0' "${modules[@]}" | xargs -0 -P "$(nproc)" -I{} bash -c 'check "$1" "$2"' check {} "$work"
echo "${#modules[@]} modules go through spirv-cross to HLSL, MSL and ESSL 3.10, and the ESSL through glslang"
