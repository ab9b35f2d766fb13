#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Sets up, builds what it needs and runs the paper's three benchmarks into
# build/demo/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# The user's own cache is neither used nor filled.
export PHONGPD_CACHE_DIR=$PWD/build/cache

scripts/build.sh phongpd paper_benchmark
build/paper_benchmark --output build/demo --motions 20 --points 2000 --page
echo
echo "Look at build/demo/index.html"
