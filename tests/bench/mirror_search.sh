#!/usr/bin/env bash
# Searches for lobes closed under mirrors, of any length: every band under some numbers of mirrors, the seed and the meridians
# change with every round; the table of fewest instructions (then of the least condition) of each band is kept.
# A line a search: what it found, its options and the best so far. Stop with Ctrl-C.
# Usage: nice bash tests/bench/mirror_search.sh FOLDER [SECONDS_EACH [ZONAL_GEN [FIRST_SEED [BANDS [MIRRORS]]]]] | tee -a tests/bench/mirror_search.log
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
best=${1:?the folder for the best tables}
seconds=${2:-60}
gen=${3:-build/release/bin/zonal-gen}
bands=${5:-3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18}
numbers=${6:-1 2 3 4 5 6}
mkdir -p "$best"
trap 'exit 130' INT

search() { # BAND MIRRORS OPTIONS...
  local band=$1 mirrors=$2 table record found instructions condition
  shift 2
  table=$(printf '%s/band%02d.json' "$best" "$band")
  record=$best/$band.best
  rm -f "$best/new.json" # of another band: a search overwrites no other table
  found=$("$gen" search --band "$band" --mirrors "$mirrors" --seconds "$seconds" "$@" --out "$best/new.json" \
    2>&1 >"$best/path") || {
    printf 'band %d, %d mirrors: %s [%s]\n' "$band" "$mirrors" "$(tail -n 1 <<<"$found")" "$*"
    return 0
  }
  instructions=$(sed -n 's/.*: \([0-9]*\) instructions.*/\1/p' <<<"$found")
  condition=$(sed -n 's/.*cond \([0-9.]*\);.*/\1/p' <<<"$found")
  if awk -v n="$instructions" -v c="$condition" -v best="$(cat "$record" 2>/dev/null || echo 100000 0)" \
    'BEGIN { split(best, b, " "); exit !(n < b[1] || (n == b[1] && c < b[2])) }'; then
    mv "$best/new.json" "$table"
    echo "$instructions $condition" >"$record"
  fi
  printf 'band %d, %d mirrors: %s [%s] best %s\n' "$band" "$mirrors" "$found" "$*" "$(cat "$record")"
}

rings=("" "--rings 12" "--rings 24" "--rings 8 10 12")
for ((seed = ${4:-1};; ++seed)); do
  for band in $bands; do
    for mirrors in $numbers; do
      search "$band" "$mirrors" --seed "$seed" ${rings[$(((seed - 1) % 4))]}
    done
  done
done
