#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A Debian root of its own, with nothing in it but what is asked for: where
# wheel.sh and deb.sh try what they built.  Needs root (or sudo), and the network
# for packages; the mirror is the one this machine's apt is configured with.
#   root.sh make DIR [PACKAGE...]  debootstrap's smallest root plus packages; the
#                                  bare one is kept in build/roots for next time
#   root.sh run DIR COMMAND...     runs it in there, with the network
#   root.sh run-offline DIR COMMAND...   and without
#   root.sh remove DIR
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

fail() { echo "root: $*" >&2; exit 2; }
as_root=()
if [[ $(id -u) -ne 0 ]]; then
  command -v sudo >/dev/null || fail "needs root or sudo to change roots"
  as_root=(sudo)
fi

# One line a source of Debian's that apt has: site, release, component.
sources() {
  apt-get indextargets 'Created-By: Packages' 'Origin: Debian' \
    --format '$(SITE) $(RELEASE) $(COMPONENT)' | sort -u
}

make_bare() { # TAR
  local suite site component proxy
  suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
  read -r site _ component < <(sources | awk -v s="$suite" '$2 == s') ||
    fail "apt knows no source of Debian's for $suite; apt-get update?"
  eval "$(apt-config shell proxy Acquire::http::Proxy)"
  [[ ! ${proxy:-} ]] || export http_proxy=$proxy
  rm -rf "$1.part"
  "${as_root[@]}" debootstrap --variant=minbase --components="$component" \
    "$suite" "$PWD/$1.part" "$site" >build/roots/debootstrap.log ||
    { tail -n 5 build/roots/debootstrap.log >&2; exit 1; }
  sources | sed 's/^/deb /' |
    "${as_root[@]}" tee "$1.part/etc/apt/sources.list" >/dev/null
  "${as_root[@]}" tar -C "$1.part" -cf "$1.tmp" .
  "${as_root[@]}" rm -rf "$1.part"
  mv "$1.tmp" "$1"
}

# Mounts are of that process alone, and go with it.
run() { # OPTIONS-OF-UNSHARE DIR COMMAND...
  local options=$1 dir=$2
  shift 2
  # What this shell exports is none of the root's business.
  "${as_root[@]}" unshare --mount --pid --fork $options \
    --mount-proc="$dir/proc" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin \
    HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    chroot "$dir" "$@"
}

make() { # DIR PACKAGE...
  local dir=$1 bare=build/roots/bare.tar
  shift
  scripts/setup.sh debootstrap
  mkdir -p build/roots
  [[ -e $bare ]] || make_bare "$bare"
  "${as_root[@]}" rm -rf "$dir"
  mkdir -p "$dir"
  "${as_root[@]}" tar -C "$dir" -xf "$bare"
  "${as_root[@]}" cp /etc/resolv.conf "$dir/etc/resolv.conf"
  # It is thrown away: nothing need reach the disk.
  echo force-unsafe-io | "${as_root[@]}" tee "$dir/etc/dpkg/dpkg.cfg.d/fast" \
    >/dev/null
  run "" "$dir" apt-get update --quiet --quiet
  [[ $# -eq 0 ]] || run "" "$dir" apt-get install --yes --quiet --quiet \
    --no-install-recommends "$@" >build/roots/apt.log 2>&1 ||
    { tail -n 5 build/roots/apt.log >&2; exit 1; }
}

verb=${1:-} dir=${2:-}
[[ $verb && $dir ]] || fail "expected a verb and a folder, found '$*'"
shift 2
case $verb in
  make) make "$dir" "$@" ;;
  run) run "" "$dir" "$@" ;;
  run-offline) run --net "$dir" "$@" ;;
  remove) "${as_root[@]}" rm -rf "$dir" ;;
  *) fail "expected make, run, run-offline or remove, found $verb" ;;
esac
