#!/usr/bin/env bash
# Searches of any length for the bands and orders whose goal is not reached yet, in turn: the seed, the weights and the
# rings change with every round; the best table of each is kept, and those of orders are taken up again in every third
# round. Band 10 and order 10 are given SECONDS, the others a time in proportion to their number.
# A line a search: what it found, its options, the best so far and the goal. Stop with Ctrl-C.
# Usage: nice bash tests/bench/long_search.sh FOLDER [SECONDS [ZONAL_GEN [FIRST_SEED]]] | tee -a tests/bench/long_search.log
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
best=${1:?the folder for the best tables}
seconds=${2:-120}
gen=${3:-build/release/bin/zonal-gen}
mkdir -p "$best"

nonzeros_of() { sed -n 's/.*: \([0-9]*\) nonzeros.*/\1/p' <<<"$1"; }

search() { # OPTION NUMBER GOAL_IN_NONZEROS OPTIONS...: keeps the table if it has fewer nonzeros
  local use=$1 number=$2 goal=$3 found nonzeros known
  shift 3
  local table=$best/${use#--}$number.json record=$best/${use#--}$number.nonzeros
  found=$("$gen" search "$use" "$number" --seconds $((seconds * number / 10 + 1)) "$@" --out "$best/new.json" 2>&1 >"$best/path") || {
    printf '%s %d: nothing [%s]\n' "${use#--}" "$number" "$*"
    return
  }
  nonzeros=$(nonzeros_of "$found")
  known=$(cat "$record" 2>/dev/null || echo 1000000)
  if [ "$nonzeros" -lt "$known" ]; then
    mv "$best/new.json" "$table"
    echo "$nonzeros" >"$record"
    known=$nonzeros
  fi
  printf '%s %d: %s [%s] best %d, goal %d\n' "${use#--}" "$number" "$found" "$*" "$known" "$goal"
}

weights=("--multiplication-weight 0.02 --condition-weight 0.1" "" "--multiplication-weight 0 --condition-weight 0.5")
odd_rings=("" "--rings 4 6 12" "--rings 6 8" "--rings 3 6 9" "--rings 8 10 12")
for ((seed = ${4:-1};; ++seed)); do
  some=${weights[$((seed % 3))]}
  rings=${odd_rings[$((seed % 5))]}
  for goal in 5:46 7:92 15:499 17:637; do
    search --band "${goal%:*}" "${goal#*:}" --seed "$seed" $some $rings $([ "${goal%:*}" -gt 10 ] && echo --on-grid)
  done
  for goal in 8:119 12:287; do
    search --band "${goal%:*}" "${goal#*:}" --seed "$seed" $some $([ "${goal%:*}" -gt 10 ] && echo --on-grid)
  done
  for goal in 5:66 6:130 7:218 8:334 9:490 10:680; do
    again=$best/order${goal%:*}.json
    [ $((seed % 3)) -eq 0 ] && [ -e "$again" ] && again="--resume $again" || again=
    search --order "${goal%:*}" "${goal#*:}" --seed "$seed" $some $again
  done
done
