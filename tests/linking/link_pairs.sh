#!/usr/bin/env bash
# No copy of a kernel is shared between files that are compiled differently: whatever else is linked, and in
# whatever order, each file turns to the same bits as alone; and no object holds a symbol of zonal's that another
# file's could replace.
#   bash tests/linking/link_pairs.sh COMPILER SOURCE_FOLDER
set -euo pipefail
compiler=$1
root=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
here=$root/tests/linking
wide=$(grep -qw avx2 /proc/cpuinfo 2>/dev/null && grep -qw fma /proc/cpuinfo && echo "-O2 -mavx2 -mfma" || echo "-O2 -ftree-vectorize")
pairs=("-O2|$wide" "-O0|-O3" "-O2|-O2 -ffast-math" "$wide|$wide -DZONAL_NO_FMA")

object() { # NAME FLAGS
  $compiler -std=c++20 $2 -DZONAL_NAME="$1" -I"$root/generated/cpp" -I"$root/runtime/include" -c "$here/turn.cpp" -o "$work/$1.o"
  if nm -C "$work/$1.o" | grep -E ' [WVu] ' >"$work/weak"; then
    echo "$compiler $2: symbols that another file's could replace:" >&2
    cat "$work/weak" >&2
    return 1
  fi
}
run() { # NAME OBJECTS...: what the function of that name gives in a program of these objects
  $compiler -std=c++20 -DZONAL_NAME="$1" "$here/main.cpp" "${@:2}" -o "$work/program"
  "$work/program"
}

status=0
for pair in "${pairs[@]}"; do
  object first "${pair%%|*}" || status=1
  object second "${pair##*|}" || status=1
  for name in first second; do
    run $name "$work/$name.o" >"$work/alone"
    for order in "first second" "second first"; do
      objects=()
      for other in $order; do objects+=("$work/$other.o"); done
      if ! run $name "${objects[@]}" | cmp -s "$work/alone" -; then
        echo "$compiler, $pair, linked as $order: the $name file turns by another file's copy" >&2
        status=1
      fi
    done
  done
done
exit $status
