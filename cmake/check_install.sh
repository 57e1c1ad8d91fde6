#!/usr/bin/env bash
# Installs a finished build into a prefix under build/, then builds, runs and tests tests/consumer/installed against it.
#   bash cmake/check_install.sh [BUILD_FOLDER, default build/release]
# With zonal-gen in the build, it also has the installed program write kernels, and checks what it says of
# mistakes; with the program zonal, that it prints what README shows. Exit status not zero and the output of the step that failed, when one fails.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$(realpath "${1:-$root/build/release}")
work=$root/build/check_install
rm -rf "$work"
mkdir -p "$work"

quietly() { "$@" >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }; }
fails_with() { # MESSAGE COMMAND...: the command must fail and say so
  local message=$1
  shift
  if "$@" >"$work/log" 2>&1; then echo "succeeded, but had to fail: $*" >&2; exit 1; fi
  tr -s '\n ' ' ' <"$work/log" | grep -qF -- "$message" || { cat "$work/log" >&2; echo "wanted: $message" >&2; exit 1; }
}

# The package has to work from wherever it is moved to.
quietly cmake --install "$build" --prefix "$work/installed"
mv "$work/installed" "$work/prefix"
prefix=$work/prefix
test -s "$prefix/share/doc/zonal/LICENSE"
# No kernel that a file compiled otherwise could replace.
for library in "$prefix"/lib*/libzonal_*.a; do
  nm -C "$library" 2>/dev/null | grep -E 'zonal::order[0-9]+::' >>"$work/kernels" || true
done
if ! grep -q ' t ' "$work/kernels"; then
  echo "$prefix: found no kernel in its libraries, wanted some; teach cmake/check_install.sh their names" >&2
  exit 1
fi
if grep -E ' [WVu] ' "$work/kernels" >&2; then
  echo "$prefix: found the kernels above, which another file's copy could replace, wanted none" >&2
  exit 1
fi

has_generator=OFF
if [ -x "$prefix/bin/zonal-gen" ]; then has_generator=ON; fi
consumer() { # FOLDER [options]
  cmake -S "$root/tests/consumer/installed" -B "$work/$1" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix" \
    -DCONSUMER_HAS_GENERATOR=$has_generator "${@:2}"
}
quietly consumer consumer
quietly cmake --build "$work/consumer"
quietly ctest --test-dir "$work/consumer" --output-on-failure --no-tests=error

# The program prints what README says, errors aside, which compilers change; it names what it does not know.
if [ -x "$prefix/bin/zonal" ]; then
  without_errors() { sed -E 's/[0-9.]+e-[0-9]+/E/g; s/^ +//' "$@"; }
  "$prefix/bin/zonal" rotate-map --map "$root/tests/data/studio.exr" --order 4 --axis 1 2 3 --angle-degrees 70 \
    --out "$work/images" >"$work/printed"
  if ! diff <(sed '1,/^    \$ .*rotate-map/d; /^$/,$d' "$root/README.md" | without_errors) \
    <(without_errors "$work/printed"); then
    echo "zonal rotate-map: printed what stands at > above, wanted what README.md shows; correct one of them" >&2
    exit 1
  fi
  quietly "$prefix/bin/zonal" --help
  quietly "$prefix/bin/zonal" rotate-map --help
  fails_with "subcommand: found none, wanted one of: rotate-map" "$prefix/bin/zonal"
  fails_with "subcommand: found 'turn-map', wanted one of: rotate-map" "$prefix/bin/zonal" turn-map --order 4
fi

if [ $has_generator = ON ]; then
  for order in 1 21 four; do
    fails_with "zonal_add_kernels(kernels_at_build): ORDERS: found '$order', wanted whole numbers from 2 to 20" \
      consumer bad_order "-DCONSUMER_ORDERS=3;$order"
  done
  # The program must read the tables that came with it, and those it is told to.
  mkdir -p "$work/truncated/shared"
  head -c 100 "$prefix/share/zonal/tables/shared/order04.json" >"$work/truncated/shared/order04.json"
  emit=("$prefix/bin/zonal-gen" emit --order 4 --language cpp --out "$work/emitted")
  fails_with "$work/truncated/shared/order04.json: JSON text" env ZONAL_TABLES_DIR="$work/truncated" "${emit[@]}"
  quietly "${emit[@]}"
  cp "$work/truncated/shared/order04.json" "$prefix/share/zonal/tables/shared/"
  fails_with "$prefix/share/zonal/tables/shared/order04.json: JSON text" "${emit[@]}"
fi
echo "the installed package works (zonal-gen: $has_generator)"
