#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes build/venv, the virtual environment that the Python package is built
# and tested in, of Debian's own Python; installs only what is missing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

wanted=$(sha256sum python/requirements.txt)
if [[ -e build/venv/wanted && $(<build/venv/wanted) == "$wanted" ]]; then
  exit 0
fi
scripts/setup.sh python3-dev python3-venv
rm -rf build/venv
/usr/bin/python3 -m venv build/venv
echo "python: installing $(grep -v '^#' python/requirements.txt | xargs)"
build/venv/bin/pip install --quiet --disable-pip-version-check \
  --requirement python/requirements.txt
echo "$wanted" >build/venv/wanted
