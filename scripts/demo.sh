#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Sets up, builds what it needs and shows in build/demo/: the paper's three
# benchmarks, a trajectory out of a trap with both metrics, and a path through
# a narrow passage beside the proof that its closed twin has none.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# The user's own cache is neither used nor filled.
export PHONGPD_CACHE_DIR=$PWD/build/cache

scripts/build.sh phongpd paper_benchmark
demo=build/demo
build/paper_benchmark --output "$demo" --motions 20 --points 2000 --page

# Exit code 1 says that a run found no answer: some here must not.
run() {
  local code=0
  build/phongpd "$@" || code=$?
  ((code <= 1)) || exit "$code"
}
# Runs one of several that share a header: only the first prints it.
more() { run "$@" | tail -n +2; }

echo
echo "A trajectory out of a trap: plain Ipopt from the straight line with monotone"
echo "mu, as the comparison asks, and with adaptive mu, which gets both metrics out"
echo "in more or fewer iterations; then the default pipeline:"
plain=(--start straight --mu-strategy monotone --polish never)
run optimize u_axis --metric euclidean "${plain[@]}" \
  --output "$demo/trap_euclidean.jsonl" --svg "$demo/trap_euclidean.svg"
more optimize u_axis --smoothing-length 0.2 "${plain[@]}" \
  --output "$demo/trap_phong.jsonl" --svg "$demo/trap_phong.svg"
for metric in euclidean phong; do
  more optimize u_axis --metric "$metric" --start straight --polish never \
    --output "$demo/trap_adaptive_$metric.jsonl"
done
more optimize u_axis --output "$demo/trap_pipeline.jsonl" \
  --html "$demo/trap.html" --svg "$demo/trap_pipeline.svg"

echo
echo "A passage one thousandth wide, and the same closed by a ten-thousandth:"
passage=tunnel:delta=0.001,bends=3
run plan "$passage" --output "$demo/tunnel.jsonl" \
  --html "$demo/tunnel.html" --svg "$demo/tunnel.svg"
more plan "$passage,twin=1" --output "$demo/tunnel_twin.jsonl"
more plan "$passage" --planner retraction-forest \
  --output "$demo/tunnel_forest.jsonl"
for scene in "$passage" "$passage,twin=1"; do
  more plan "$scene" --planner rrt-connect --time 1 \
    --output "$demo/tunnel_rrt_connect.jsonl"
done

echo
echo "Look at $demo/index.html, $demo/trap.html and $demo/tunnel.html"
