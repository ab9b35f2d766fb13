#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# models.sh [FOLDER]: meshes of scans and machine parts, as Debian packages
# them with CGAL's demos (libcgal-demo), in FOLDER (build/models).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder=${1:-build/models}
[[ -f $folder/joint.off ]] && exit 0
scripts/setup.sh libcgal-demo
archive=/usr/share/doc/libcgal-dev/data.tar.gz
if [[ ! -f $archive ]]; then
  # Systems that drop documentation drop this, too.
  echo "models: expected $archive of the package libcgal-demo, found none;" \
    "does dpkg exclude /usr/share/doc?" >&2
  exit 1
fi
mkdir -p "$folder"
tar -xzf "$archive" -C "$folder" --strip-components=2 \
  --wildcards 'data/meshes/*.off'
