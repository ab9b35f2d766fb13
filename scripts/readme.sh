#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# readme.sh: runs the commands of README's command-line part as they stand, in
# a copy of nothing but build/, and stops at the first that fails.  Answers that
# must not be found (exit code 1) are named in README by a comment "no answer".
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export PHONGPD_CACHE_DIR=$PWD/build/cache

scripts/build.sh phongpd
mkdir -p build/check
awk '/^## From the command line/ { on = 1 } /^## From C\+\+/ { on = 0 }
  on && /^    / { print substr($0, 5) }' README.md >build/check/readme.commands
# Each command with its continued lines, and whether "no answer" stands above.
bash -n build/check/readme.commands
code=0 count=0 command='' may_fail=0
while IFS= read -r line; do
  if [[ $line == '#'* ]]; then
    [[ $line != *'no answer'* ]] || may_fail=1
    continue
  fi
  command+=$line$'\n'
  [[ $line != *'\' ]] || continue
  count=$((count + 1))
  code=0
  bash -c "$command" >build/check/readme.log 2>&1 || code=$?
  if ((code > may_fail)); then
    printf 'readme: exit code %d from:\n%s' "$code" "$command" >&2
    tail -n 5 build/check/readme.log >&2
    exit 1
  fi
  command='' may_fail=0
done <build/check/readme.commands
echo "readme: $count commands ran"
