#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Fuzzes the readers, the contact space and the queries with libFuzzer and the
# address and undefined-behaviour sanitizers.
#
#   scripts/fuzz.sh [30s | 1000000] [TARGET ...]
#   scripts/fuzz.sh merge [TARGET ...]
#
# 30s: seconds of each target; 1000000: runs of each (default 30s, all targets;
# their names are the folders of tests/fuzz/corpus).  FUZZ_SEED=1 begins with
# that seed instead of chance.  Prints a row "target, runs, seconds, corpus,
# crashes" for each.  What it finds stays in
# build-asan/corpus, inputs that fail in build-asan/crashes; fails if there are
# any.  An input fails when it crashes, leaks, takes more than 10 s, allocates
# 2 MiB at once (solids and queries more), or breaks what tests/fuzz/fuzz_targets.h
# promises.  merge: keeps in tests/fuzz/corpus the fewest inputs, old and
# found, that reach all that these reach.
# A number of runs of the queries is by fuzz_query_light, which is ten times
# faster (tests/fuzz/light.txt), and prefers inputs that run fast; then what it
# kept is run with all checks.
set -euo pipefail
cd "$(dirname "$0")/.."

amount=${1:-30s}
shift $(($# > 0))
if [[ $amount != merge && ! $amount =~ ^[1-9][0-9]*s?$ ]]; then
  echo "fuzz: expected 30s, a number of runs or merge, found '$amount'" >&2
  exit 2
fi
all=()
for folder in tests/fuzz/corpus/*/; do all+=("$(basename "$folder")"); done
targets=("$@")
[[ ${#targets[@]} -gt 0 ]] || targets=("${all[@]}")
for target in "${targets[@]}"; do
  if [[ ! -d tests/fuzz/corpus/$target ]]; then
    echo "fuzz: expected one of ${all[*]}, found '$target'" >&2
    exit 2
  fi
done

scripts/setup.sh
if ! command -v clang++ >/dev/null ||
  [[ ! -e $(clang++ -print-file-name=libclang_rt.fuzzer-x86_64.a) ]]; then
  as_root=()
  [[ $(id -u) -eq 0 ]] || as_root=(sudo)
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install \
    --yes --quiet --no-install-recommends clang libclang-rt-14-dev
fi
is_light() { [[ $1 == query && $amount =~ ^[0-9]+$ ]]; }
programs=("${targets[@]/#/fuzz_}")
for target in "${targets[@]}"; do
  if is_light "$target"; then programs+=("fuzz_${target}_light"); fi
done
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --parallel "$(nproc)" \
  --target "${programs[@]}" >/dev/null

build=build-asan
# Inputs have at most 512 bytes: 100 times that is far below this base, the
# least libFuzzer can tell.  What all of an input holds is bounded by the
# memory of the process; solids and queries need more than bytes do.
declare -A malloc_mib=([contact_space]=64 [piece]=64 [query]=64 [scene]=16)
declare -A max_len=([cache]=1024 [gltf]=1024 [piece]=4096)
# Weighing inputs by rare features takes two thirds of the time where one run
# has 10^4 of them, and reaches no more.
declare -A entropic=([contact_space]=0)
export ASAN_OPTIONS=malloc_context_size=8:quarantine_size_mb=16
export UBSAN_OPTIONS=print_stacktrace=1

run() {
  local target=$1 log=$build/fuzz_$1.log kept=tests/fuzz/corpus/$1
  mkdir -p "$build/corpus/$target" "$build/crashes/$target"
  local limit=(-runs="$amount")
  [[ $amount != *s ]] || limit=(-max_total_time="${amount%s}")
  local dictionary=() start=$EPOCHREALTIME
  [[ ! -e tests/fuzz/$target.dict ]] ||
    dictionary=(-dict="tests/fuzz/$target.dict")
  local options=(-max_len="${max_len[$target]:-512}" -timeout=10
    -rss_limit_mb=1024 -malloc_limit_mb="${malloc_mib[$target]:-2}"
    -artifact_prefix="$build/crashes/$target/"
    "$build/corpus/$target" "$kept")
  local program=$build/tests/fuzz/fuzz_$target status=0
  local fuzzer=$program
  if is_light "$target"; then
    fuzzer+=_light
    limit+=(-entropic_scale_per_exec_time=1)
  fi
  "$fuzzer" "${limit[@]}" "${dictionary[@]}" -seed="${FUZZ_SEED:-0}" \
    -entropic="${entropic[$target]:-1}" -print_final_stats=1 \
    "${options[@]}" >"$log" 2>&1 || status=$?
  if is_light "$target" && [[ $status -eq 0 ]]; then
    "$program" -runs=0 "${options[@]}" >>"$log" 2>&1 || status=$?
  fi
  local runs seconds inputs crashes
  runs=$(sed -n 's/^stat::number_of_executed_units: //p' "$log")
  seconds=$(awk -v a="$start" -v b="$EPOCHREALTIME" \
    'BEGIN { printf "%.0f", b - a }')
  inputs=$(find "$build/corpus/$target" "$kept" -type f | wc -l)
  crashes=$(find "$build/crashes/$target" -type f | wc -l)
  echo "$target,${runs:-0},$seconds,$inputs,$crashes"
  if [[ $status -ne 0 || $crashes -ne 0 ]]; then
    grep -E 'ERROR|SUMMARY|broken promise|runtime error' "$log" | head -3 >&2
    echo "fuzz: $target failed; inputs in $build/crashes/$target, output in" \
      "$log" >&2
    return 1
  fi
}

merge() {
  local kept=tests/fuzz/corpus/$1 least=$build/least/$1
  rm -rf "$least"
  mkdir -p "$least" "$build/corpus/$1"
  "$build/tests/fuzz/fuzz_$1" -set_cover_merge=1 -use_counters=0 \
    "$least" "$kept" "$build/corpus/$1" >"$build/fuzz_$1.log" 2>&1
  rm -rf "$kept"
  mv "$least" "$kept"
}

if [[ $amount == merge ]]; then
  for target in "${targets[@]}"; do merge "$target"; done
  exit
fi
# One on each processor.
failed=0
echo "target,runs,seconds,corpus,crashes"
running=()
for target in "${targets[@]}"; do
  while (($(jobs -rp | wc -l) >= $(nproc))); do sleep 0.2; done
  run "$target" &
  running+=($!)
done
for one in "${running[@]}"; do wait "$one" || failed=1; done
exit "$failed"
