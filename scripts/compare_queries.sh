#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# compare_queries.sh A B: instructions a query of two commits beside each
# other.  Both are built, in build/compare, with this tree's counting program.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if [[ $# -ne 2 ]]; then
  echo "compare_queries: expected two commits, found $# arguments" >&2
  exit 2
fi
for commit in "$@"; do
  if ! git rev-parse --quiet --verify "$commit^{commit}" > /dev/null; then
    echo "compare_queries: expected a commit, found '$commit'" >&2
    exit 2
  fi
done
scripts/setup.sh valgrind
count() { # COMMIT OUTPUT.csv
  local sha folder
  sha=$(git rev-parse "$1^{commit}")
  folder=$PWD/build/compare/$sha
  if [[ ! -d $folder/source ]]; then
    mkdir -p "$folder/source"
    git archive "$sha" | tar -x -C "$folder/source"
  fi
  cmake -S results/bench/instructions -B "$folder/build" \
    -D PHONGPD_SOURCE="$folder/source" -D CMAKE_BUILD_TYPE=Release > /dev/null
  cmake --build "$folder/build" --parallel "$(nproc)" > /dev/null
  scripts/count_queries.sh "$folder/build/query_instructions" > "$2"
}
first=build/compare/first.csv second=build/compare/second.csv
mkdir -p build/compare
count "$1" "$first"
count "$2" "$second"
paste -d , "$first" "$second" | awk -F , -v a="$1" -v b="$2" '
  NR == 1 { printf "%-14s %-10s %14s %14s %7s\n", $1, $2, a, b, "ratio"; next }
  { printf "%-14s %-10s %14d %14d %7.3f\n", $1, $2, $3, $6, $6 / $3 }'
