#!/usr/bin/env bash
# Regenerates the committed kernels into a temporary folder and compares the list of files, then their bytes.
#   cmake/check_generated.sh [--accept] PATH/TO/zonal-gen [GENERATED_FOLDER]
# Exit status 1 and the difference when something differs; --accept puts the regenerated files in place.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
accept=no
if [ "${1:-}" = --accept ]; then accept=yes; shift; fi
if [ $# -lt 1 ]; then sed -n '2,4s/^# //p' "$0" >&2; exit 2; fi
generator=$1
[ -x "$generator" ] || { echo "$generator: found no program, wanted zonal-gen; run: bash cmake/test.sh" >&2; exit 2; }
committed=${2:-$root/generated}
if [ "$accept" = no ] && [ ! -d "$committed" ]; then
  echo "$committed: found no such folder, wanted the kernels to compare; name another, or write it: bash $0 --accept $generator $committed" >&2
  exit 2
fi

fresh=$(mktemp -d)
trap 'rm -rf "$fresh"' EXIT
cmake -DZONAL_GEN="$generator" -DOUT="$fresh" -P "$root/cmake/regenerate.cmake"

if [ "$accept" = yes ]; then
  # Whole beside the old files before those go: a full disk or an interrupt loses nothing.
  whole=$(mktemp -d "$(dirname "$committed")/.accepted-XXXXXX")
  trap 'if [ -e "$whole/old" ] && [ ! -e "$committed" ]; then mv "$whole/old" "$committed"; fi; rm -rf "$fresh" "$whole"' EXIT
  cp -r "$fresh" "$whole/new"
  chmod 755 "$whole/new"  # mktemp made it for its owner alone
  if [ -e "$committed" ]; then mv "$committed" "$whole/old"; fi
  mv "$whole/new" "$committed"
  echo "accepted: $committed holds what $(basename "$generator") writes"
  exit 0
fi

list() { (cd "$1" && find . -type f | LC_ALL=C sort); }
status=0
if ! diff <(list "$committed") <(list "$fresh"); then
  echo "the list of files differs (<: committed and orphaned, >: missing)" >&2
  status=1
fi
if ! diff -ru "$committed" "$fresh"; then
  echo "the committed code differs from what the generator writes" >&2
  status=1
fi
if [ $status -ne 0 ]; then
  echo "to accept the generator's output: bash cmake/check_generated.sh --accept build/release/bin/zonal-gen" >&2
fi
exit $status
