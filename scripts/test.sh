#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Sets up, builds everything and runs the whole test suite.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# The user's own cache is neither used nor filled.
export PHONGPD_CACHE_DIR=$PWD/build/cache

scripts/python.sh
scripts/build.sh
ctest --preset release --parallel 2 --output-log build/tests.log
