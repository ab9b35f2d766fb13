#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# bench.sh [paper|all]: regenerates the tables and figures of results/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# The user's own cache is neither used nor filled.
export PHONGPD_CACHE_DIR=$PWD/build/cache

suite=${1:-all}
case $suite in
  paper | all) ;;
  *)
    echo "bench: expected paper or all, found $suite" >&2
    exit 2
    ;;
esac
if [[ $suite == paper || $suite == all ]]; then
  scripts/build.sh paper_benchmark
  build/paper_benchmark --output results/paper
fi
