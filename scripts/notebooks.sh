#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# notebooks.sh [ARGUMENTS...]: sets up, builds the Python package and opens the
# notebooks of docs/notebooks in JupyterLab, which it installs in build/venv if
# it is not there; ARGUMENTS go to jupyter lab.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/python.sh
scripts/build.sh phongpd_python
if [[ ! -x build/venv/bin/jupyter-lab ]]; then
  echo "notebooks: installing jupyterlab"
  build/venv/bin/pip install --quiet --disable-pip-version-check jupyterlab
fi
PYTHONPATH=$PWD/build/python exec build/venv/bin/jupyter-lab "$@" docs/notebooks
