#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# bench.sh [paper|contact-space|all]: regenerates the tables and figures of
# results/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# The user's own cache is neither used nor filled.
export PHONGPD_CACHE_DIR=$PWD/build/cache

suite=${1:-all}
case $suite in
  paper | contact-space | all) ;;
  *)
    echo "bench: expected paper, contact-space or all, found $suite" >&2
    exit 2
    ;;
esac
if [[ $suite == paper || $suite == all ]]; then
  scripts/build.sh paper_benchmark
  build/paper_benchmark --output results/paper
fi
if [[ $suite == contact-space || $suite == all ]]; then
  # The competitors compile for minutes: only here, and remembered in build/.
  scripts/setup.sh
  cmake --preset release -DPHONGPD_BUILD_COMPETITORS=ON
  scripts/build.sh contact_space_benchmark
  build/contact_space_benchmark --output results/contact-space
fi
