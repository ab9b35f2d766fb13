#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Sets up, builds what it needs and shows in build/demo/: the paper's three
# benchmarks, a trajectory out of a trap with both metrics, one that a gantry
# runs, robots that change places, a body that turns, and a path through a narrow
# passage beside the proof that its closed twin has none.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# The user's own cache is neither used nor filled.
export PHONGPD_CACHE_DIR=$PWD/build/cache

scripts/build.sh phongpd paper_benchmark
demo=build/demo
build/paper_benchmark --output "$demo" --motions 20 --points 2000
python3 -B results/bench/paper_report.py --output "$demo" --page

# Exit code 1 says that a run found no answer: some here must not.
run() {
  local code=0
  build/phongpd "$@" || code=$?
  ((code <= 1)) || exit "$code"
}
# Runs one of several that share a header: only the first prints it.
more() { run "$@" | tail -n +2; }
# Also for the page.
note() { tee -a "$demo/$1.txt"; }
# Before its other columns the strategy a run of the trap had for mu.
with_mu() { sed "s/^scene,/mu, scene,/; t; s/^\([^ ]\)/$1, \1/"; }
rm -f "$demo"/*.txt "$demo"/*.jsonl

mv "$demo/index.html" "$demo/benchmarks.html"
wrench=$demo/wrench
way=(--from 0.3 -1.2 0.1 --to 0.3 1.2 0.05)
run scenes write ball_wrench --meshes "$wrench" >/dev/null
echo
echo "A ball pushed over the handle of a wrench:"
run motion --robot "$wrench/robot.off" --obstacle "$wrench/obstacle.off" \
  "${way[@]}" --frames 400 --smoothing-length 0.1 \
  --output "$demo/motion.csv" --html "$demo/motion.html" | note motion
echo
echo "How deep are the two as they lie?"
echo "\$ build/phongpd depth $wrench/robot.off $wrench/obstacle.off" | note depth
run depth "$wrench/robot.off" "$wrench/obstacle.off" | note depth

echo
echo "A trajectory out of a trap: plain Ipopt from the straight line with monotone"
echo "mu, as the comparison asks, and with adaptive mu; then the default pipeline:"
plain=(--start straight --mu-strategy monotone --polish never)
run optimize u_axis --metric euclidean "${plain[@]}" \
  --output "$demo/trap_euclidean.jsonl" --svg "$demo/trap_euclidean.svg" |
  with_mu monotone
more optimize u_axis --smoothing-length 0.2 "${plain[@]}" \
  --output "$demo/trap_phong.jsonl" --svg "$demo/trap_phong.svg" |
  with_mu monotone
for metric in euclidean phong; do
  more optimize u_axis --metric "$metric" --start straight --polish never \
    --output "$demo/trap_adaptive_$metric.jsonl" | with_mu adaptive
done
more optimize u_axis --output "$demo/trap_pipeline.jsonl" \
  --svg "$demo/trap_pipeline.svg" | with_mu adaptive
run view "$demo/trap_euclidean.jsonl" "$demo/trap_phong.jsonl" \
  "$demo/trap_pipeline.jsonl" --build --html "$demo/trap.html" >/dev/null

echo
echo "A gantry's trajectory, in millimetres, within its limits, by way of a camera:"
run optimize examples/gantry.json --output "$demo/gantry.json" \
  --html "$demo/gantry.html" | note gantry
run optimize examples/gantry.json --rate 250 --output "$demo/gantry.csv" >/dev/null

echo
echo "Three carriages that change places past a column:"
run optimize examples/robots.json --html "$demo/robots.html" | note robots

echo
echo "A rod that has to turn to get out of a box:"
run plan rod_trap:0.5 --time 60 --output "$demo/turning.jsonl" \
  --html "$demo/turning.html"

echo
echo "A passage one thousandth wide, and the same closed by a ten-thousandth:"
passage=tunnel:delta=0.001,bends=3
run plan "$passage" --output "$demo/tunnel.jsonl" \
  --html "$demo/tunnel.html" --svg "$demo/tunnel.svg"
more plan "$passage,twin=1" --output "$demo/tunnel_twin.jsonl" \
  --html "$demo/tunnel_twin.html"
more plan "$passage" --planner retraction-forest \
  --output "$demo/tunnel_forest.jsonl"
for twin in "" _twin; do
  more plan "$passage${twin:+,twin=1}" --planner rrt-connect --time 1 \
    --output "$demo/tunnel${twin}_rrt_connect.jsonl"
done
scripts/demo_page.sh "$demo"
scripts/links.py "$demo" >"$demo/links.log" || { cat "$demo/links.log"; exit 1; }

echo
echo "Look at $demo/index.html"
