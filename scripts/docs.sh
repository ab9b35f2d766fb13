#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# docs.sh: builds the pages into build/site/html, a folder that any web server
# serves and that needs no network.  Warnings are errors, dead links too.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh doxygen python3-sphinx python3-myst-parser python3-breathe \
  furo python3-numpy
mkdir -p build/site
doxygen docs/Doxyfile
/usr/bin/python3 docs/figures/figures.py build/site/figures
/usr/bin/python3 -m sphinx -q -W --keep-going -b html -d build/site/doctrees \
  docs build/site/html
# Debian's furo wants this from the root of a server of Debian's own.
styles=build/site/html/_static/styles
cp /usr/share/javascript/normalize.css/normalize.css $styles
sed -i 's|/javascript/normalize.css/normalize.css|normalize.css|' \
  $styles/furo.css
scripts/docs_dark.py $styles/furo.css
# Two columns of the index do not fit a narrow screen; figures scroll there, or
# their words are too small.
echo '@media (max-width:46em) {
  .indextable td { display: block; width: auto !important }
  a.image-reference { display: block; overflow-x: auto }
  a.image-reference img[src$=".svg"] { max-width: none; width: 36em }
}' >>$styles/furo.css
# Its script imports another, which browsers do in modules only, and of files not
# at all: both in one.
parts=build/site/html/_static/scripts
{ cat $parts/gumshoe-patched.js; grep -v '^import Gumshoe' $parts/furo.js; } \
  >$parts/whole.js
mv $parts/whole.js $parts/furo.js
scripts/links.py build/site/html
echo "docs: build/site/html/index.html"
