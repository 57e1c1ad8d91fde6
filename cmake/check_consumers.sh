#!/usr/bin/env bash
# Builds and tests the projects under tests/consumer that add zonal as a folder of theirs, each in build/check_consumers:
# one with a fmt of its own, one where no package can be found, one whose warnings are errors (by g++ and clang++), a
# plug-in (with static and shared libraries), kernels without exceptions, and what README shows. Orders 3 and 4 only, to
# be quick.
#   bash cmake/check_consumers.sh [NAME of one of those folders]
# Exit status not zero, and what the step printed, when one fails.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
work=$root/build/check_consumers
mkdir -p "$work"
only=${1:-}

check() { # NAME FOLDER [options of cmake]
  local name=$1 folder=$2
  shift 2
  if [ -n "$only" ] && [ "$only" != "$folder" ]; then return 0; fi
  rm -rf "${work:?}/$name"
  step() { "$@" >"$work/$name.log" 2>&1 || { cat "$work/$name.log" >&2; echo "tests/consumer/$folder: failed as $name" >&2; exit 1; }; }
  step cmake -S "$root/tests/consumer/$folder" -B "$work/$name" -G Ninja -DCMAKE_UNITY_BUILD=ON "$@"
  step cmake --build "$work/$name"
  if [ -f "$work/$name/CTestTestfile.cmake" ]; then
    step ctest --test-dir "$work/$name" --output-on-failure --no-tests=error
  fi
  echo "$name: passed"
}

check with_own_fmt with_own_fmt -DCMAKE_CXX_FLAGS=-O1
check with_own_fmt_and_generator with_own_fmt -DZONAL_BUILD_GENERATOR=ON -DCMAKE_DISABLE_FIND_PACKAGE_fmt=ON
check no_packages no_packages -DCMAKE_CXX_FLAGS=-O1
check strict_warnings_by_g++ strict_warnings -DCMAKE_CXX_COMPILER=g++
check strict_warnings_by_clang++ strict_warnings -DCMAKE_CXX_COMPILER=clang++
check plugin plugin -DCMAKE_CXX_FLAGS=-O1
check plugin_with_shared_libraries plugin -DCMAKE_CXX_FLAGS=-O1 -DBUILD_SHARED_LIBS=ON
shared=$work/plugin_with_shared_libraries/zonal/runtime/libzonal_rotate.so
if [ -f "$shared" ] && nm -DC --defined-only "$shared" | grep 'zonal::order'; then
  echo "libzonal_rotate.so: found the kernels above among what it exports, wanted what ZONAL_API marks" >&2
  exit 1
fi
check no_exceptions no_exceptions
check readme readme -DCMAKE_CXX_FLAGS=-O1
