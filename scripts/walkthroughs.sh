#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# walkthroughs.sh [NAME...]: runs the walk-throughs of docs (research, gantry, cpp)
# line by line, each in a fresh folder with nothing in it, and says how long each
# took (scripts/doc_blocks.py walk); stops at the first line that fails.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export PHONGPD=$PWD

names=("$@")
((${#names[@]} > 0)) || names=(research gantry cpp)
scripts/build.sh phongpd
scripts/doc_blocks.py walk build "${names[@]/#/docs/walk-}"
