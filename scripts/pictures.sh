#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# pictures.sh: draws the moving picture of README and the pages,
# docs/motion.webp, a frame at a time: some minutes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh chromium webp
scripts/build.sh phongpd
w=build/pictures
way=(--from 0.3 -1.2 0.1 --to 0.3 1.2 0.05)
build/phongpd scenes write ball_wrench --meshes $w
build/phongpd contact-space --robot $w/robot.off --obstacle $w/obstacle.off \
  --output $w/contact.off
build/phongpd motion --contact-space $w/contact.off "${way[@]}" --frames 400 \
  --smoothing-length 0.1 --output $w/motion.csv

# From where the ball goes in to where it is out again, and a rest there.
frames=60
list=()
for ((i = 0; i < frames; ++i)); do
  moment=$(awk -v i=$i -v n=$frames \
    'BEGIN { printf "%.4f", 0.14 + 0.74 * i / (n - 1) }')
  build/phongpd view $w/motion.csv $w/contact.off $w/obstacle.off "${way[@]}" \
    --robot $w/robot.off --title "Pushed over the handle of a wrench" \
    --png $w/frame.png --moment "$moment" > /dev/null
  cwebp -quiet -q 80 -m 6 -resize 960 600 $w/frame.png -o "$w/frame-$i.webp"
  list+=(-frame "$w/frame-$i.webp" "+$((i == frames - 1 ? 1500 : 80))")
done
webpmux "${list[@]}" -loop 0 -o docs/motion.webp
