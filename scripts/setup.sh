#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# setup.sh [PACKAGE...]: installs the Debian packages PhongPD is built from and
# the named ones, only those missing.  Needs the network only then; everything
# else works offline.  Worth naming: chromium, by which phongpd view --png draws
# and the tests open pages; zsh, fish, man-db and groff, by which the tests try
# completion and the manual page.
set -euo pipefail

# clang, lld and what they compile for wasm32 with: the queries that the pages
# of the viewer run themselves.
# Ipopt's package names blas and lapack to the linker without bringing them.
packages=(
  g++ cmake make pkg-config libeigen3-dev libcgal-dev libgmp-dev libmpfr-dev
  libtbb-dev libfcl-dev libgtest-dev librapidcheck-dev libcli11-dev
  nlohmann-json3-dev coinor-libipopt-dev libblas-dev liblapack-dev libompl-dev
  libboost-serialization-dev libboost-filesystem-dev gnuplot-nox libjs-three
  clang lld wasi-libc libc++-14-dev-wasm32 libc++abi-14-dev-wasm32
  libclang-rt-14-dev-wasm32 libassimp-dev libtinyxml2-dev zlib1g-dev
  libcpp-httplib-dev
  "$@"
)

missing=()
for package in "${packages[@]}"; do
  state=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $state == installed ]] || missing+=("$package")
done
[[ ${#missing[@]} -eq 0 ]] && exit 0

echo "setup: installing ${missing[*]}"
as_root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "setup: needs root or sudo to install: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
install_missing() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install \
    --yes --quiet --no-install-recommends "${missing[@]}"
}
# Package lists may be absent or too old; refresh them only if that shows.
if ! install_missing; then
  "${as_root[@]}" apt-get update --quiet
  install_missing
fi
