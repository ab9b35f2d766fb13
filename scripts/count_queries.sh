#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# count_queries.sh PROGRAM: instructions a query, counted by callgrind in
# PROGRAM (query_instructions), as CSV on stdout.  The same to a few in a
# thousand on every run and under any load.
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
echo "contact space,query,instructions"
for space in torus_440 torus_10000 organic_5120; do
  for kind in euclidean cold@0 cold@0.2 warm@0 warm@0.2 segment; do
    queries=$(valgrind --tool=callgrind --toggle-collect=phongpd_counted \
      --callgrind-out-file="$scratch/out" "$1" "$kind" "$space" \
      2> "$scratch/log") || { cat "$scratch/log" >&2; exit 1; }
    total=$(awk '/^(summary|totals):/ { n = $2 } END { print n }' \
      "$scratch/out")
    echo "$space,$kind,$((total / queries))"
  done
done
