#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# build.sh [TARGET...]: sets up, configures build/ and builds the targets
# (everything when none is named).  Another preset than release by PRESET=NAME.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=${PRESET:-release}
scripts/setup.sh
options=()
# What scripts/python.sh has prepared.
if [[ $preset == release && -x build/venv/bin/python ]]; then
  options=(-DPHONGPD_BUILD_PYTHON=ON
    -DPython_EXECUTABLE="$PWD/build/venv/bin/python")
fi
cmake --preset "$preset" "${options[@]}"

# A translation unit that includes CGAL takes up to 1.5 GiB to compile.
jobs=$(nproc)
memory=$(awk '/MemAvailable/ { print int($2 / 1572864) }' /proc/meminfo)
((memory >= 1)) || memory=1
((jobs <= memory)) || jobs=$memory

targets=()
[[ $# -eq 0 ]] || targets=(--target "$@")
cmake --build --preset "$preset" --parallel "$jobs" "${targets[@]}"
