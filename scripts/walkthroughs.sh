#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# walkthroughs.sh [--root] [NAME...]: runs the walk-throughs of docs (research,
# gantry, cpp) line by line, each in a fresh folder with nothing in it, and says how
# long each took (scripts/doc_blocks.py walk); stops at the first line that fails.
# With --root in a fresh Debian root (scripts/root.sh) and without a network: there
# are the sources, the program and the Python package that build/ has (built first
# unless they are there), the libraries these link, and what the pages say that one
# needs; nothing else of this machine.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

in_root=false
if [[ ${1:-} == --root ]]; then in_root=true; shift; fi
names=("$@")
((${#names[@]} > 0)) || names=(research gantry cpp)
pages=("${names[@]/#/docs/walk-}")

build() {
  local targets=(phongpd)
  if [[ " ${names[*]} " == *" research "* ]]; then
    scripts/python.sh
    targets+=(phongpd_python)
  fi
  scripts/build.sh "${targets[@]}"
}

# Packages of Debian's that hold the shared libraries of these files; dpkg knows
# some of them in /lib, some in /usr/lib, which are one folder.
libraries() { # FILE...
  local file
  ldd "$@" | awk '$3 ~ "^/" { print $3 }' | sort -u | xargs realpath |
    while read -r file; do
      dpkg-query -S "$file" 2>/dev/null || dpkg-query -S "${file#/usr}"
    done | cut -d : -f 1 | sort -u
}

walk_in_root() {
  local root=build/roots/walk built=(build/phongpd) packages=(python3)
  [[ " ${names[*]} " != *" research "* ]] || {
    built+=(build/python)
    packages+=(python3-numpy python3-scipy)
  }
  [[ " ${names[*]} " != *" cpp "* ]] ||
    packages+=(g++ cmake make libeigen3-dev libcgal-dev libtbb-dev)
  mapfile -O "${#packages[@]}" -t packages < <(
    libraries $(find "${built[@]}" -name phongpd -type f -o -name '*.so'))
  scripts/root.sh make "$root" "${packages[@]}"
  { git ls-files -z --cached --others --exclude-standard
    printf '%s\0' "${built[@]}"; } |
    tar --null --files-from - --create --file - --dereference --ignore-failed-read |
    scripts/root.sh run-offline "$root" sh -c \
      'mkdir /phongpd && tar -C /phongpd --no-same-owner -xf -'
  scripts/root.sh run-offline "$root" /phongpd/scripts/doc_blocks.py walk \
    /phongpd/build "${pages[@]}"
  scripts/root.sh remove "$root"
}

if $in_root; then
  [[ -x build/phongpd && (" ${names[*]} " != *" research "* ||
    -d build/python/phongpd) ]] || build
  walk_in_root
else
  build
  scripts/doc_blocks.py walk build "${pages[@]}"
fi
