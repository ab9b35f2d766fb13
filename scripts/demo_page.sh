#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# demo_page.sh DIR: writes DIR/index.html, the story of what scripts/demo.sh has
# put there: pages as frames, sentences and tables of its rows (*.jsonl), and lines
# that its commands printed (*.txt).
set -euo pipefail
scripts=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cd "$1"

# Numbers to four digits, and what HTML takes for its own.
readable() {
  awk '{
    gsub(/&/, "\\&amp;"); gsub(/</, "\\&lt;"); text = ""
    while (match($0, /[0-9]+\.[0-9][0-9][0-9][0-9][0-9]+(e[-+]?[0-9]+)?/)) {
      text = text substr($0, 1, RSTART - 1) \
        sprintf("%.4g", substr($0, RSTART, RLENGTH))
      $0 = substr($0, RSTART + RLENGTH)
    }
    print text $0
  }' "$1"
}
said() { # FILE: the lines of a command
  printf '<pre>'
  readable "$1"
  printf '</pre>\n'
}
rows() { # KIND FILE...: of the same rows sentences, by nobody's expectation, ...
  echo '<p>'
  "$scripts/demo_sentences.py" "$@"
  echo '</p>'
}
table() { # ... and a table
  echo '<div class="wide"><table>'
  "$scripts/demo_sentences.py" --table "$@"
  echo '</table></div>'
}
frame() { # PAGE TITLE
  printf '<iframe src="%s" title="%s" loading="lazy"></iframe>\n' "$1" "$2"
  printf '<p class="small"><a href="%s">Open it alone</a>: turn it, cut it, ' "$1"
  printf 'play it, probe it; ? lists the keys.</p>\n'
}

{
  cat <<'HTML'
<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>PhongPD</title>
<style>
  :root { color-scheme: light dark; --line: #8886; }
  body { font: 17px/1.55 system-ui, sans-serif; margin: 0 auto; padding: 0 16px 80px;
         max-width: 1100px; }
  section { padding-top: 7vh; }
  h1 { font-size: clamp(28px, 5vw, 46px); line-height: 1.15; margin: 0 0 12px; }
  h2 { font-size: clamp(23px, 3.6vw, 32px); margin: 0 0 8px; }
  p { max-width: 46em; }
  iframe { width: 100%; height: min(68vh, 640px); border: 1px solid var(--line);
           border-radius: 10px; box-sizing: border-box; }
  pre { white-space: pre-wrap; overflow-wrap: anywhere; font-size: 13px; line-height: 1.45; padding: 12px;
        border: 1px solid var(--line); border-radius: 10px; }
  .wide { overflow-x: auto; }
  .why td { white-space: normal; }
  table { border-collapse: collapse; font-size: 14px; width: 100%; }
  th, td { text-align: left; padding: 4px 12px 4px 0; border-bottom: 1px solid var(--line);
           min-width: 4.5em; }
  .why td { color: #888; padding-left: 16px; }
  .small { font-size: 14px; margin-top: 4px; }
  li { margin: 6px 0; max-width: 46em; }
</style>
<section>
<h1>How deep, and which way out?</h1>
<p>PhongPD answers that for any two closed triangle meshes of which one translates:
exactly, and with a direction that turns continuously.</p>
<h2>The moment Euclidean depth flips</h2>
<p>A ball is pushed over the handle of a wrench. Press play: half-way the nearest way
out is on the other side, and the Euclidean arrow flips within one frame. PhongPD
follows one side until its branch ends and says when; the sliding contact moves over
the surface at a bounded speed and does not jump while the ball is inside. Or push it yourself: the probe (P) lets
you drag the ball and answers in the page, by the library compiled to WebAssembly.</p>
HTML
  frame motion.html "Three metrics along one motion"
  said motion.txt
  echo '</section><section><h2>Out of a trap</h2>
<p>Ipopt starts on the straight line, through the wall of a U. The exact
judge has the last word on every path. This is one seed; over many scenes and seeds
Euclidean depth and PhongPD solve about as many with adaptive mu.</p>'
  trap=(trap trap_euclidean.jsonl trap_phong.jsonl trap_adaptive_euclidean.jsonl
    trap_adaptive_phong.jsonl trap_pipeline.jsonl)
  rows "${trap[@]}"
  frame trap.html "Paths out of a trap"
  table "${trap[@]}"
  echo '</section><section><h2>A trajectory that a machine runs</h2>
<p>The gripper of a gantry goes over a wall, by way of a camera that looks at the part,
into a rack. The curve is free and within the limits of velocity, acceleration and jerk
for all t: proved on the curve itself, not at samples. Press play: it moves in its own
time, and the chart says what it asks of the limits.</p>'
  frame gantry.html "A trajectory of a gantry, played in its own time"
  said gantry.txt
  echo '<p>For its controller: <a href="gantry.csv">rows every 4 ms</a>, <a
href="gantry.json">the curve</a>; <code>.gcode</code> and ROS 2 by the name of the
file.</p>'
  echo '</section><section><h2>Robots that change places</h2>
<p>Three carriages of a table, each with limits of its own, past a column. Every pair
keeps apart for all t, proved on the curves; one waits, or goes first.</p>'
  frame robots.html "Three robots that change places, in one time"
  said robots.txt
  echo '</section><section><h2>A body that turns through a window</h2>
<p>Neither leg of the L fits through with the other beside it: it goes through one leg
first, and turns. Between two poses it moves and turns at once, and every such motion
is proved free for all t. Not to find a way would prove nothing here.</p>'
  rows turning turning.jsonl
  frame turning.html "An L on its way through a window"
  table turning turning.jsonl
  echo '</section><section><h2>A passage a thousandth wide, and a proof</h2>
<p>A channel a thousandth wide, and the same closed by a ten-thousandth. A proof says
that start and goal lie in different cells of free space; a sampler can find a path, and
never prove that there is none. Seconds are those of the search; the contact space,
where one is built, comes before.</p>'
  tunnel=(tunnel tunnel.jsonl tunnel_twin.jsonl tunnel_forest.jsonl
    tunnel_rrt_connect.jsonl tunnel_twin_rrt_connect.jsonl)
  rows "${tunnel[@]}"
  frame tunnel.html "A path through a narrow passage"
  table "${tunnel[@]}"
  echo '</section><section><h2>Your own two meshes</h2>
<p>STL, OBJ, OFF or PLY, closed, in one unit. Nothing is precomputed; the answer is the
global one, with a certificate and the two points that touch.</p>'
  said depth.txt
  echo '<p>Repair, many poses, turned robots: <code>build/phongpd depth --help</code>. From
Python: <code>phongpd.depth("tool.stl", "part.stl")</code>.</p>
<h2>What it costs, and where Euclidean depth is the better choice</h2>
<ul>
<li>Time and memory of every benchmark, with what is won and lost:
<a href="benchmarks.html">the paper'"'"'s three benchmarks</a>.</li>
<li>You want the least translation that parts two solids: Euclidean depth is that, and
PhongPD is never less deep.</li>
<li>Narrow tunnels: in the widest published one none of 50 runs from a colliding start
converges with either; with Euclidean PD 27 end in a stall stop, exactly free, with
PhongPD 19.</li>
<li>You only want a free path: take the planner or the default pipeline; the metric
hardly matters there.</li>
<li>A cold query costs more than a Euclidean one; a warm one costs less.</li>
</ul>
<p>Published figures, wins and losses: <code>results/</code>. Pages to read:
<code>scripts/docs.sh</code>.</p>
</section>
</html>'
} >index.html
