#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# determinism.sh RUNS PROGRAM...: runs phongpd RUNS times with one thread and
# with two, for each of the programs (by gcc, by clang), and compares every
# output byte for byte; rows of results without seconds and compiler.  Prints
# a table; fails if runs, threads or programs differ.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

runs=$1
programs=("${@:2}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Writes one run's outputs into the current folder.
outputs() { # COMMAND...
  local pair
  for pair in cone_axes clutter torus_hole; do
    "$@" scenes write "$pair" --meshes "meshes_$pair"
    "$@" contact-space --robot "meshes_$pair/robot.off" \
      --obstacle "meshes_$pair/obstacle.off" --output "contact_$pair.off" \
      --no-cache
    "$@" query --contact-space "contact_$pair.off" --points ../points.csv \
      --output "query_$pair.csv" --smoothing-length 0.2
    "$@" query --contact-space "contact_$pair.off" --points ../points.csv \
      --output "query_paper_$pair.csv" --tracked
    "$@" motion --contact-space "contact_$pair.off" --from -0.9 0.2 0.1 \
      --to 0.8 -0.3 0.2 --frames 500 --output "motion_$pair.csv"
  done
  local scene
  for scene in u_trap l torus_hole; do
    "$@" optimize "$scene" --output "optimize_$scene.jsonl" --no-cache
  done
  for scene in clutter tunnel:delta=0.01; do
    "$@" plan "$scene" --output "plan_${scene%%:*}.jsonl" --no-cache
    # Seeded, and far from its time limit.
    "$@" plan "$scene" --planner retraction-forest --time 60 \
      --output "plan_forest_${scene%%:*}.jsonl" --no-cache
  done
  # Exit code 1: proved that there is no path.
  "$@" plan tunnel:delta=0.01,twin=1 --output plan_closed.jsonl --no-cache ||
    [[ $? -eq 1 ]]
  sed -E -i 's/"([a-z_]*_)?seconds":(\{[^}]*\}|[^,}]*)//g
    s/"compiler":"[^"]*"//' ./*.jsonl
}

awk 'BEGIN { srand(7); print "x,y,z"
  for (i = 0; i < 2000; ++i)
    printf "%.17g,%.17g,%.17g\n", 3 * rand() - 1.5, 3 * rand() - 1.5,
      2 * rand() - 1 }' >"$work/points.csv"

count=0
for program in "${programs[@]}"; do
  for threads in 1 2; do
    for ((run = 0; run < runs; ++run)); do
      mkdir "$work/$((++count))"
      (cd "$work/$count" &&
        outputs taskset -c "$(seq -s, 0 $((threads - 1)))" \
          "$OLDPWD/$program" >/dev/null)
    done
    echo "check: determinism: $program, threads: $threads, $runs runs" >&2
  done
done

per_program=$((2 * runs))
head="| output |" rule="|---|"
for program in "${programs[@]}"; do
  head+=" $program, $runs runs with 1 and with 2 threads |" rule+="---|"
done
printf '%s\n' "$head" "$rule"
differ=0
for file in "$work"/1/*.{off,csv,jsonl}; do
  name=${file##*/}
  line="| $name |"
  for ((p = 0; p < ${#programs[@]}; ++p)); do
    first=$((p * per_program + 1))
    state="the same bytes"
    cmp -s "$file" "$work/$first/$name" ||
      { state="other than the first's"; differ=1; }
    for ((k = first; k < first + per_program; ++k)); do
      if ! cmp -s "$work/$first/$name" "$work/$k/$name"; then
        state="run or threads change it"
        differ=1
      fi
    done
    line+=" $state |"
  done
  echo "$line"
done
exit "$differ"
