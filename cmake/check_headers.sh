#!/usr/bin/env bash
# Compiles every kernel of every generated header, each header alone, as C++17 under strict warnings that are errors:
# in float, in double, and of a signal value that has no more than kernels may use. Kernels are found by their
# signatures in the header, so that none is forgotten.
#   bash cmake/check_headers.sh [FOLDER of generated C++, default generated/cpp [COMPILER..., default g++ clang++]]
# Exit status not zero and what the compiler says, for every header, where one is refused.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=$(realpath "${1:-$root/generated/cpp}")
compilers=("${@:2}")
[ ${#compilers[@]} -gt 0 ] || compilers=(g++ clang++)
for compiler in "${compilers[@]}"; do
  command -v "$compiler" >/dev/null || { echo "found no $compiler; install it, or name other compilers" >&2; exit 1; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# A signal value of two channels.
cat >"$work/signal.hpp" <<'CPP'
#pragma once
struct Signal {
    using value_type = float;
    float a, b;
};
inline Signal operator+(Signal p, Signal q) { return {p.a + q.a, p.b + q.b}; }
inline Signal operator-(Signal p, Signal q) { return {p.a - q.a, p.b - q.b}; }
inline Signal operator-(Signal p) { return {-p.a, -p.b}; }
inline Signal operator*(float s, Signal p) { return {s * p.a, s * p.b}; }
inline Signal fma(float s, Signal p, Signal q) { return s * p + q; }
CPP

# From a header to explicit instantiations of its kernels, one a line.
cat >"$work/instantiate.awk" <<'AWK'
function fail(text) { printf "%s:%d: %s\n", FILENAME, FNR, text > "/dev/stderr"; failed = 1; exit 1 }
function instantiate(parameters, T, V,    call, types) {
    call = signature
    types = parameters == "T" ? T : parameters == "V" ? V : T ", " V
    gsub(/T\*/, T "*", call)
    gsub(/V\*/, V "*", call)
    sub(/\(/, "<" types ">(", call)
    sub(/^void /, "template void " place "::", call)
    print call ";"
}
/^namespace .* \{$/ { place = place == "" ? $2 : place "::" $2; depth = depth + 1; length_of[depth] = length(place); next }
/^}  \/\/ namespace/ {
    --depth
    place = depth > 0 ? substr(place, 1, length_of[depth]) : ""
    next
}
/^template </ { parameters = $0; is_open = 1; signature = ""; next }
is_open && /^struct / { is_open = 0; next }
is_open {
    signature = signature (signature == "" ? "" : " ") $0
    if ($0 !~ /\{$/) { if ($0 ~ /[;}]$/) fail("wanted a function's head, found " signature); next }
    is_open = 0
    sub(/ *\{$/, "", signature)
    gsub(/\(  */, "(", signature)
    # Helpers that return a value are compiled with the kernels that call them.
    if (signature !~ /^(ZONAL_HOST_DEVICE static |inline )?void [a-z_0-9]+\(/) next
    sub(/^(ZONAL_HOST_DEVICE static |inline )/, "", signature)
    ++kernels
    if (parameters == "template <class T>") {
        instantiate("T", "float", ""); instantiate("T", "double", "")
    } else if (parameters == "template <class T, class V = T>") {
        instantiate("T V", "float", "float"); instantiate("T V", "double", "double"); instantiate("T V", "float", "Signal")
    } else if (parameters == "template <class V>" || parameters == "template <class V, class T = typename kernel_support::scalar_of<V>::type>") {
        instantiate("V", "float", "float"); instantiate("V", "double", "double"); instantiate("V", "float", "Signal")
    } else {
        fail("a kernel of unknown parameters, " parameters "; teach cmake/check_headers.sh what to compile it with")
    }
}
END { if (!failed && kernels == 0 && !includes) fail("found no kernel and no header to include") }
/^#include "/ { includes = 1 }
/^#ifndef ZONAL_KERNEL_/ { includes = 1 } # what kernels share
AWK

# One header, by every compiler.
check() {
  local work=$1 folder=$2 header=$3 compiler source status=0
  shift 3
  source=$work/$$.cpp
  { printf '#include "%s"\n#include "%s/signal.hpp"\n' "${header#"$folder/"}" "$work"; awk -f "$work/instantiate.awk" "$header"; } \
    >"$source" || return 1
  grep -c '^template void' "$source" >>"$work/counts" || true
  for compiler in "$@"; do
    "$compiler" -std=c++17 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror -fsyntax-only \
      -I"$folder" "$source" || { echo "$header: $compiler refuses it" >&2; status=1; }
  done
  return $status
}
export -f check

mapfile -t headers < <(find "$folder" -name '*.hpp' | LC_ALL=C sort)
[ ${#headers[@]} -gt 0 ] || { echo "$folder: found no .hpp, wanted generated headers" >&2; exit 1; }
printf '%s\0' "${headers[@]}" | xargs -0 -P "$(nproc)" -I{} bash -c 'check "$@"' check "$work" "$folder" {} "${compilers[@]}"
echo "${#headers[@]} headers, $(awk '{n += $1} END {print n}' "$work/counts") instantiations: no warning by ${compilers[*]}"
