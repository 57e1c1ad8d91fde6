#!/usr/bin/env bash
# Searches of any length for sparse lobes, band after band and order after order, in rounds. An even round begins
# afresh: a genetic search with another seed, weights and rings, then a walk off the grid from what it found, unless that
# is hopeless. An odd round walks on from the best. The best table of each is kept, at first the committed one.
# Band 10 and order 10 are given SECONDS a search, the others a time in proportion to their number.
# A line a search: what it found, its options, the best so far and the goal in nonzeros. Stop with Ctrl-C; the search
# under way is then lost.
# Usage: nice bash tests/bench/long_search.sh FOLDER [SECONDS [ZONAL_GEN [FIRST_ROUND]]] | tee -a tests/bench/long_search.log
# ITEMS="band07:92 order10:680" seeks these alone.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
best=${1:?the folder for the best tables}
seconds=${2:-60}
gen=${3:-build/release/bin/zonal-gen}
items=${ITEMS:-order07:218 order08:334 order09:490 order10:680 band07:92 band05:46 order06:130 order05:66 band08:119
  band09:166 band10:198 band06:65 band11:264 band12:287 order11 band13:379 order12 band14:437 order13 band15:499 order14
  band16:566 order15 band17:637 order16 band18:711 order17 order18 order19 order20}
[ -x "$gen" ] || { echo "$gen: not found; build it, or name another" >&2; exit 1; }
mkdir -p "$best"

nonzeros_of() { sed -n 's/^  "nonzeros": \([0-9]*\).*/\1/p' "$1"; }

search() { # OPTIONS...: leaves its table in $best/found.json and says what it found
  local found least
  rm -f "$best/found.json" # of another order: a search overwrites no other table
  if found=$("$gen" search "$use" "$number" "$@" --seed "$round" --seconds "$time" --out "$best/found.json" 2>&1 >"$best/path"); then
    least=$(printf '%s\n' "$(nonzeros_of "$best/found.json")" "$(nonzeros_of "$table")" | sort -n | head -1)
    echo "${use#--} $number: $found [${*//$best\//} --seed $round] best $least, goal $goal"
  else
    echo "${use#--} $number: nothing: ${found##*$'\n'} [${*//$best\//} --seed $round]"
    return 1
  fi
}

weights=("--multiplication-weight 0.02 --condition-weight 0.1" "--multiplication-weight 0 --condition-weight 0.3" "")
rings=("" "--rings 4 6 12" "--rings 6 8" "--rings 3 6 9" "--rings 8 10 12")
for ((round = ${4:-1};; ++round)); do
  for item in $items; do
    name=${item%:*} goal=-
    [[ $item == *:* ]] && goal=${item#*:}
    use=--${name%%[0-9]*} number=$((10#${name#"${name%%[0-9]*}"}))
    time=$((seconds * number / 10 + 5))
    table=$best/$name.json
    [ -e "$table" ] || { folder=shared; [ "$use" = --band ] && folder=band; cp "generator/tables/$folder/$name.json" "$table"; }
    some=${weights[$((round % 3))]}
    start=$table
    if [ $((round % 2)) -eq 0 ]; then
      fresh=$some
      [ "$use" = --band ] && [ $((number % 2)) -eq 1 ] && fresh+=" ${rings[$((round / 2 % 5))]}"
      [ "$number" -gt 10 ] && fresh+=" --on-grid"
      search $fresh || continue
      start=$best/fresh.json
      mv "$best/found.json" "$start"
      [ $(($(nonzeros_of "$start") * 100)) -gt $(($(nonzeros_of "$table") * 115)) ] && continue
    fi
    search --walk --resume "$start" $some || continue
    more=$(($(nonzeros_of "$best/found.json") - $(nonzeros_of "$table")))
    # The first weights see multiplications and the condition too: at the same nonzeros, a walk from the table is cheaper.
    if [ $more -lt 0 ] || { [ $more -eq 0 ] && [ "$start" = "$table" ] && [ $((round % 3)) -eq 0 ]; }; then
      mv "$best/found.json" "$table"
    fi
  done
done
