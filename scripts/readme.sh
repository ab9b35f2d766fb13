#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# readme.sh: compiles and runs every block of C++, Python and the shell in README
# and docs as it stands (scripts/doc_blocks.py), and stops at the first that
# fails; of Python if scripts/python.sh has prepared it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export PHONGPD_CACHE_DIR=$PWD/build/cache

targets=(phongpd documented_cpp)
[[ ! -x build/venv/bin/python ]] || targets+=(phongpd_python)
scripts/build.sh "${targets[@]}"
shopt -s extglob  # the walk-throughs have a script of their own
scripts/doc_blocks.py run build README.md python/README.md core/README.md \
  docs/!(walk-*).md
