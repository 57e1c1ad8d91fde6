#!/usr/bin/env bash
# Where the time of the last build and tests went: the compile jobs and the tests that took longest, and how long all of
# them took together, from the logs that ninja and ctest keep. Seconds by the clock, so a busy machine has larger ones.
#   bash cmake/cost.sh [BUILD_FOLDER, default build/release] [COUNT, default 20]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${1:-$root/build/release}
count=${2:-20}
jobs=$build/.ninja_log
tests=$build/Testing/Temporary/LastTest.log
[[ $count =~ ^[0-9]+$ ]] || { echo "COUNT: found '$count', wanted a whole number" >&2; exit 2; }
[ -f "$jobs" ] || { echo "$jobs: no such file, wanted the log of a build; run: bash cmake/test.sh" >&2; exit 1; }

longest() { # TITLE: of lines "seconds name", sorted; their sum first
  sort -rn | awk -v title="$1" -v count="$count" '
    { sum += $1; if (NR <= count) line[NR] = sprintf("%8.1f  %s", $1, substr($0, index($0, $2))) }
    END { printf "%s: %d, %.0f s together\n", title, NR, sum; for (i = 1; i <= count && i in line; i++) print line[i] }'
}

# A job with several outputs has a line for each; of a job done twice the last one counts.
awk -F '\t' 'NF >= 5 { last[$4] = $0 }
  END { for (output in last) { split(last[output], field, FS); key = field[1] FS field[2] FS field[5]
        if (!(key in seen)) { seen[key] = 1; print (field[2] - field[1]) / 1000, output } } }' "$jobs" |
  longest "build jobs"
[ -f "$tests" ] || { echo "no test was run in $build"; exit 0; }
awk '/^[0-9]+\/[0-9]+ Testing: / { sub(/^[^:]*: /, ""); name = $0 } /^Test time = / { print $4, name }' "$tests" |
  longest "tests of the last run of ctest"
