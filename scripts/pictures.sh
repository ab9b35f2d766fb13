#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# pictures.sh: draws the picture of README and the pages, docs/motion.png.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh chromium
scripts/build.sh phongpd
w=build/pictures
way=(--from 0.3 -1.2 0.1 --to 0.3 1.2 0.05)
build/phongpd scenes write ball_wrench --meshes $w
build/phongpd contact-space --robot $w/robot.off --obstacle $w/obstacle.off \
  --output $w/contact.off
build/phongpd motion --contact-space $w/contact.off "${way[@]}" --frames 400 \
  --smoothing-length 0.1 --output $w/motion.csv
build/phongpd view $w/motion.csv $w/contact.off $w/obstacle.off "${way[@]}" \
  --robot $w/robot.off --title "Pushed over the handle of a wrench" \
  --png docs/motion.png
