#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# core.sh [PREFIX]: builds the core alone (depths, contact spaces, metrics) with what
# it needs and nothing else, installs it (build/core-only/install), and prints seconds,
# those of processors too, which other work on the machine changes less, and size.
# Needs cmake, a compiler, libeigen3-dev, libcgal-dev and libtbb-dev.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

work=build/core-only
prefix=${1:-$PWD/$work/install}
rm -rf "$work"
mkdir -p build  # for the log: a fresh clone has none
# Of a compiler, all in one process group, TIMEFORMAT tells wall, user and system.
TIMEFORMAT='%R %U %S'
seconds=$({ time {
  cmake -S . -B "$work" -D PHONGPD_BUILD=core -D CMAKE_BUILD_TYPE=Release &&
    cmake --build "$work" --parallel "$(nproc)"
} >"$PWD/build/core-only.log" 2>&1; } 2>&1) ||
  { tail -n 20 build/core-only.log; exit 1; }
cmake --install "$work" --prefix "$prefix" --component development >/dev/null
awk -v cores="$(nproc)" -v kib="$(du -sk "$prefix" | cut -f 1)" -v where="$prefix" '{
  printf "core: %.0f s on %d cores, %.0f s of processors, %d KiB in %s\n",
         $1, cores, $2 + $3, kib, where }' <<<"$seconds"
