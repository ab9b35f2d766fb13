#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# deb.sh [--test]: builds the Debian packages libphongpd-dev, phongpd and
# python3-phongpd for this machine's Debian, into build/packages.
#   --test  lintian, and in a Debian root of its own: installs them with what
#           they depend on, runs them, builds examples, removes them and looks
#           for what they left (needs root or sudo)
# MAINTAINER='Name <address>' says who makes them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

readonly out=$PWD/build/packages
readonly log=$out/deb.log
say() { printf 'deb: %s\n' "$*"; }

build_packages() {
  scripts/setup.sh dpkg-dev
  scripts/python.sh
  local date
  date=$(git log -1 --format=%cD 2>/dev/null || date -Ru)
  {
    cmake --preset deb -D PHONGPD_CHANGELOG_DATE="$date" \
      -D Python_EXECUTABLE="$PWD/build/venv/bin/python" \
      ${MAINTAINER:+-D PHONGPD_MAINTAINER="$MAINTAINER"}
    say "compiling, which takes minutes" >&2
    PRESET=deb scripts/build.sh
  } >"$log" || { tail -n 20 "$log"; exit 1; }
  rm -f "$out"/*.deb
  # 022: packages hold files that everybody may read.
  (umask 022 && cpack --config build-deb/CPackConfig.cmake -B "$out/cpack") \
    >>"$log" 2>&1 || { tail -n 20 "$log"; exit 1; }
  mv "$out"/cpack/*.deb "$out"
  rm -rf "$out/cpack"
  ls -l "$out"/*.deb
}

case ${1:-} in
  '' | --test) ;;
  *) echo "deb: expected --test or nothing, found $1" >&2; exit 2 ;;
esac
mkdir -p "$out"
build_packages
[[ ! ${1:-} ]] || scripts/deb_test.sh "$out"/*.deb
