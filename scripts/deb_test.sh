#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# deb_test.sh DEB...: tries Debian packages as deb.sh --test says.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

readonly root=$PWD/build/roots/deb
say() { printf 'deb: %s\n' "$*"; }
fail() { say "$*"; exit 1; }
there() { scripts/root.sh run "$root" bash -euc "$1"; }
install() { # OPTION-OF-APT... PACKAGE...
  there "apt-get install --yes -qq -o Dpkg::Use-Pty=0 $* >/apt.log 2>&1 ||
    { tail -n 20 /apt.log; exit 1; }"
}

# What is installed, from where, and whom it needs.
test_contents() {
  scripts/setup.sh lintian
  lintian --fail-on error --info "$@" || fail "lintian found errors"
}

test_program() {
  say "the program and the module, with what they depend on"
  install --no-install-recommends /debs/phongpd_*.deb \
    /debs/python3-phongpd_*.deb
  there 'cd /tmp
    phongpd --version | head -n 1
    # The root leaves documentation out of no package.
    ls /usr/share/man/man1/phongpd.1.gz \
      /usr/share/bash-completion/completions/phongpd \
      /usr/share/zsh/vendor-completions/_phongpd \
      /usr/share/fish/vendor_completions.d/phongpd.fish >/dev/null
    . /usr/share/bash-completion/completions/phongpd
    phongpd scenes write ball_wrench --meshes wrench
    phongpd depth wrench/robot.off wrench/obstacle.off --at 0.3 0 0.1
    phongpd plan tunnel:delta=0.01 --output plan.jsonl
    phongpd optimize u_axis --output run.jsonl
    python3 /first_depth.py
    python3 -c "import importlib.metadata as m; print(m.version(\"phongpd\"))"'
}

# Nothing of ours may be left.
test_removal() {
  say "removing what was installed"
  there 'rm -rf /tmp/* /root/.cache
    apt-get purge --yes -qq -o Dpkg::Use-Pty=0 "*phongpd*" >/apt.log 2>&1 ||
      { cat /apt.log; exit 1; }
    left=$(find / -xdev -iname "*phongpd*" -not -path "/debs/*" \
      -not -path "/var/log/*")
    [[ ! $left ]] || { echo "left behind: $left"; exit 1; }'
}

# Examples, by an outsider who has nothing but a compiler and the package.
test_library() {
  say "the library with a compiler: example of core, then of all components"
  install --no-install-recommends g++ cmake make /debs/libphongpd-dev_*.deb
  there 'cd /tmp
    cp -r /usr/share/doc/libphongpd-dev/examples .
    cd examples
    cmake -S . -B core >/cmake.log
    cmake --build core >>/cmake.log
    core/01_depth cube.off u.off | tee out
    grep -q "Euclidean depth 0.3, out along 1 0 0" out'
  install $(dpkg-deb --field "$1" Recommends | tr -d ',')
  there 'cd /tmp/examples
    parts=core,planners,ipopt,ompl,solve
    cmake -S . -B all -D COMPONENTS=$parts >/cmake.log
    cmake --build all --parallel 2 >>/cmake.log
    all/03_ipopt cube.off u.off | tee out
    grep -q "the judge says free" out
    all/08_world cube.off u.off | grep "confirmed on the solids"
    all/04_ompl cube.off u.off | grep "no way around: no path, proved"'
}

[[ $# -eq 3 ]] || { echo "deb_test: expected three packages" >&2; exit 2; }
test_contents "$@"
scripts/root.sh make "$root"
tar -C "$(dirname "$1")" -cf - $(basename -a "$@") |
  scripts/root.sh run "$root" sh -c 'mkdir /debs && tar -C /debs -xf -'
scripts/root.sh run "$root" sh -c 'cat >/first_depth.py' \
  <packaging/first_depth.py
test_program
test_removal
test_library "$(dirname "$1")"/libphongpd-dev_*.deb
test_removal
scripts/root.sh remove "$root"
say "the packages install, run and leave nothing behind"
