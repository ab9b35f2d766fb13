#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# core.sh [PREFIX]: builds the core alone (depths, contact spaces, metrics) with what
# it needs and nothing else, installs it (build/core-only/install), and prints seconds
# and size.  Needs cmake, a compiler, libeigen3-dev, libcgal-dev and libtbb-dev.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

work=build/core-only
prefix=${1:-$PWD/$work/install}
rm -rf "$work"
begin=$(date +%s.%N)
cmake -S . -B "$work" -D PHONGPD_BUILD=core -D CMAKE_BUILD_TYPE=Release >/dev/null
cmake --build "$work" --parallel "$(nproc)" >/dev/null
seconds=$(echo "$(date +%s.%N) - $begin" | awk '{ printf "%.0f", $1 - $3 }')
cmake --install "$work" --prefix "$prefix" --component development >/dev/null
echo "core: $seconds s on $(nproc) cores, $(du -sk "$prefix" | cut -f 1) KiB in $prefix"
