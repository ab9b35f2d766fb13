#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# install_times.sh [wheel [FILE] | core | walks]: how long a first answer takes, into
# results/python/install.csv, a row a step with seconds of the clock and of processors,
# which other work on the machine changes less, and the load before.
#   wheel  from FILE, or the one in build/packages, to the first depth, in a fresh
#          environment; NumPy comes from the index, nothing from pip's cache
#   core   scripts/core.sh, from the clone to the archives
#   walks  the walk-throughs of docs, each in a fresh Debian root
#          (scripts/walkthroughs.sh --root), without what makes that root
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

readonly rows=results/python/install.csv
readonly header='step,seconds,processor seconds,cores,load before,date'
fail() { echo "install_times: $*" >&2; exit 2; }

# STEP SECONDS PROCESSOR_SECONDS: in place of the row of that step.
keep() {
  [[ -e $rows ]] || echo "$header" >"$rows"
  sed -i "/^$1,/d" "$rows"
  echo "$1,$2,$3,$(nproc),$load,$(date +%F)" >>"$rows"
  echo "$1: $2 s, of processors $3 s"
}

# STEP COMMAND...
timed() {
  local step=$1 told
  shift
  TIMEFORMAT='%R %U %S'
  told=$({ time "$@" >"$work/$step.log" 2>&1; } 2>&1) ||
    { cat "$work/$step.log"; exit 1; }
  read -r wall user system <<<"$told"
  keep "$step" "$(printf '%.1f' "$wall")" \
    "$(awk -v a="$user" -v b="$system" 'BEGIN { printf "%.1f", a + b }')"
}

first_depth='import phongpd
world = phongpd.World.load("ball_wrench")
print(phongpd.depth(world.robot, world.obstacles[0], at=(0.3, 0, 0.1)))'

time_wheel() { # [FILE]
  local wheel=${1:-$(echo build/packages/phongpd-*.whl)}
  [[ -f $wheel ]] || fail "expected a wheel, found no $wheel; run scripts/wheel.sh"
  rm -rf "$work/venv"
  timed environment python3 -m venv "$work/venv"
  timed install "$work/venv/bin/pip" install --disable-pip-version-check \
    --no-cache-dir "$wheel"
  timed 'first depth' "$work/venv/bin/python" -c "$first_depth"
  grep -q '^penetrating, depth 0.55 along (0, 0, 1)$' "$work/first depth.log" ||
    { cat "$work/first depth.log"; exit 1; }
}

time_core() {
  local said
  said=$(scripts/core.sh "$work/core")
  keep core $(sed -E 's/^core: ([0-9]+) s on .* cores, ([0-9]+) s of .*/\1 \2/' \
    <<<"$said")
}

time_walks() {
  local name clock used
  scripts/walkthroughs.sh --root | tee "$work/walks.log"
  while read -r name clock used; do
    keep "walk $name" "$clock" "$used"
  done < <(sed -nE 's!^walk: docs/walk-(.*)\.md: .* commands, (.*) s, (.*) s of .*!\1 \2 \3!p' \
    "$work/walks.log")
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
load=$(cut -d ' ' -f 1 /proc/loadavg)
case ${1:-} in
  wheel) time_wheel "${2:-}" ;;
  core) time_core ;;
  walks) time_walks ;;
  '') time_wheel; time_core; time_walks ;;
  *) fail "expected wheel, core, walks or nothing, found $1" ;;
esac
