#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# compare_pipeline.sh BEFORE AFTER OUTPUT [RUNS [SEED]]: the default pipeline of
# two commits on the scenes of the convergence study, the same seeds, five runs
# of one and of the other in turn, so that both see the same machine; AFTER with
# each metric besides.  Each is a commit, which is built in build/compare, or a
# phongpd program.  Tables go to the directory OUTPUT.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if [[ $# -lt 3 || $# -gt 5 ]]; then
  echo "compare_pipeline: expected BEFORE AFTER OUTPUT [RUNS [SEED]], found" \
    "$# arguments" >&2
  exit 2
fi
output=$3 runs=${4:-10} seed=${5:-101}
if [[ ! $runs =~ ^[1-9][0-9]*$ || ! $seed =~ ^[1-9][0-9]*$ ]]; then
  echo "compare_pipeline: expected RUNS and SEED of at least 1, found" \
    "'$runs' and '$seed'" >&2
  exit 2
fi
program() { # COMMIT|PROGRAM: prints the program
  if [[ -x $1 && -f $1 ]]; then
    realpath "$1"
    return
  fi
  local sha folder
  if ! sha=$(git rev-parse --quiet --verify "$1^{commit}"); then
    echo "compare_pipeline: expected a commit or a program, found '$1'" >&2
    return 2
  fi
  folder=$PWD/build/compare/$sha
  if [[ ! -d $folder/source ]]; then
    mkdir -p "$folder/source"
    git archive "$sha" | tar -x -C "$folder/source"
  fi
  (cd "$folder/source" && cmake --preset release > /dev/null &&
    cmake --build build --target phongpd --parallel "$(nproc)" > /dev/null)
  echo "$folder/source/build/phongpd"
}
# Files as the tables name them, whatever machine this is: by their place in the
# project, or their name alone; commits stay as they are.
shown() { # COMMIT|FILE
  local place=$1
  [[ ! -e $1 ]] || place=$(realpath --relative-to=. "$1")
  [[ $place != ../* && $place != /* ]] || place=${place##*/}
  echo "$place"
}
before=$(program "$1")
after=$(program "$2")
how="scripts/compare_pipeline.sh $(shown "$1") $(shown "$2") $(shown "$3")"
. scripts/convergence_scenes.sh
rows=$PWD/build/compare/pipeline
rm -rf "$rows"
mkdir -p "$rows"
# The user's own cache is neither used nor filled.
export PHONGPD_CACHE_DIR=$PWD/build/cache
run() { # PROGRAM SCENE SEED RUNS ROWS ARGUMENTS...: adds to the rows
  local code=0
  "$1" optimize "$2" --seed "$3" --runs "$4" --no-verify \
    --output "$rows/part.jsonl" "${@:6}" > /dev/null 2>&1 || code=$?
  # 1: a run without an answer, which the tables count.
  if ((code > 1)); then
    echo "compare_pipeline: $1 on $2: exit code $code" >&2
    return 3
  fi
  cat "$rows/part.jsonl" >> "$rows/$5.jsonl"
  rm "$rows/part.jsonl"
}
for scene in "${scenes[@]}"; do
  for ((from = seed; from < seed + runs; from += 5)); do
    count=$((seed + runs - from < 5 ? seed + runs - from : 5))
    run "$before" "$scene" "$from" "$count" before
    run "$after" "$scene" "$from" "$count" after
    run "$after" "$scene" "$from" "$count" metrics --metric euclidean
    run "$after" "$scene" "$from" "$count" metrics --smoothing-length 0
  done
  echo "$scene" >&2
done
python3 results/bench/pipeline_report.py --before "$rows/before.jsonl" \
  --after "$rows/after.jsonl" --metrics "$rows/metrics.jsonl" \
  --rivals results/convergence/rows.csv --output "$output" \
  --how "$how${4:+ $4}${5:+ $5}"
