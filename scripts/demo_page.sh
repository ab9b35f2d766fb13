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
said() { # FILE: the lines of a command, for who wants them
  printf '<details><summary>What the command printed</summary><pre>'
  readable "$1"
  printf '</pre></details>\n'
}
rows() { # KIND FILE...: of the same rows sentences, by nobody's expectation, ...
  echo '<ul>'
  "$scripts/demo_sentences.py" "$@" | sed 's|.*|<li>&</li>|'
  echo '</ul>'
}
table() { # ... and a table
  echo '<details><summary>All runs, in numbers</summary><div class="wide"><table>'
  "$scripts/demo_sentences.py" --table "$@"
  echo '</table></div></details>'
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
  .small, summary { font-size: 14px; }
  .small { margin-top: 4px; }
  summary { cursor: pointer; }
  /* Three panes, one above the other, need the height. */
  @media (max-width: 760px) { iframe { height: min(88vh, 760px); } }
  li { margin: 6px 0; max-width: 46em; }
</style>
<section>
<h1>How deep, and which way out?</h1>
<p>Two solids overlap. How far must one of them move until they are apart, and in which
direction? PhongPD answers exactly, for any two closed triangle meshes. Its way out turns
as the solid moves on, where the shortest way out jumps. On that stand motions for
machines, and proofs that there is no way. Here are six pictures of it: turn them, play
them.</p>
<h2>1. The shortest way out jumps; PhongPD turns</h2>
<p>A ball is pushed over the handle of a wrench. The arrow is the way out, the pale ball
where that leads. Press play: twice the shortest way out (orange, Euclidean) is suddenly on
another side, and its arrow jumps from one frame to the next; the chart shows how much each
arrow turns. PhongPD (blue) keeps to one side for as long as that goes on, and turns. The
sliding contact (green) moves over the surface no faster than a limit that you set. Or push
the ball yourself: tick <em>drag the robot</em>.</p>
HTML
  frame motion.html "Three ways out along one motion"
  said motion.txt
  echo '</section><section><h2>2. Which direction helps a solver</h2>
<p>A solver (Ipopt) looks for a way for the ball from one side of a U to the other. It begins
with the straight line, which goes through the walls, and is told in each step which way
is out of them. A solid line is free, as an exact check found; a dashed one still
collides. This is one example. Over many scenes and seeds both directions solve about as
many, where Ipopt adapts its steps (mu).</p>'
  trap=(trap trap_euclidean.jsonl trap_phong.jsonl trap_adaptive_euclidean.jsonl
    trap_adaptive_phong.jsonl trap_pipeline.jsonl)
  frame trap.html "Paths that a solver found, by either direction"
  rows "${trap[@]}"
  table "${trap[@]}"
  echo '</section><section><h2>3. A motion that a machine can run</h2>
<p>The gripper of a gantry goes over a wall, to a camera that looks at the part for a
fifth of a second, and into a rack. It touches nothing and keeps its limits of velocity,
acceleration and jerk at every moment: that is proved for the whole curve, not at samples.
Press play: it takes as long as the machine would, and the chart shows how much of each
limit it uses.</p>'
  frame gantry.html "A motion of a gantry, played in its own time"
  said gantry.txt
  echo '<p>For its controller: <a href="gantry.csv">a row every 4 ms</a>, <a
href="gantry.json">the curve</a>; also <code>.gcode</code> and ROS 2, by the name of the
file.</p>'
  echo '</section><section><h2>4. Robots that change places</h2>
<p>Three carriages on a table go past a column and past each other, each within limits of
its own. That no two ever touch is proved for every moment. Press play, and click a name
to see what its robot asks of its limits.</p>'
  frame robots.html "Three robots that change places, in one time"
  said robots.txt
  echo '</section><section><h2>5. A body that turns to get out of a trap</h2>
<p>A rod lies across a closed box. The one way out is a tunnel that reaches into the box
and is narrower than the rod is long: the rod has to find its mouth and turn into it. From
pose to pose it moves and turns at once, and all of each motion is proved free. (Where no
way is found for a body that turns, that proves nothing.) Open it alone, drag its start or
goal, and press Solve: the planner is in the page.</p>'
  frame turning.html "A rod on its way out of a box"
  rows turning turning.jsonl
  table turning turning.jsonl
  echo '</section><section><h2>6. A proof that there is no way</h2>
<p>A cube is to go through a bent channel into a closed room. First the channel is a
thousandth wider than the cube, and there is a way. Then it is a ten-thousandth narrower
than the cube, which nobody can see: there is none. Planners that try places at random
cannot know that; they look until their time is up. PhongPD knows every place where the
cube touches anything, and with it all the room that it has: start and goal lie in parts of
it that are not connected.</p>'
  tunnel=(tunnel tunnel.jsonl tunnel_twin.jsonl tunnel_forest.jsonl
    tunnel_rrt_connect.jsonl tunnel_twin_rrt_connect.jsonl)
  frame tunnel.html "A path through a channel that is open"
  frame tunnel_twin.html "The same channel, closed: no path, and the proof"
  echo '<p>What planners said of either, each by its name:</p>'
  rows "${tunnel[@]}"
  echo '<p>Seconds are those of the search; what the cube touches is found before.</p>'
  table "${tunnel[@]}"
  echo '</section><section><h2>Your own two meshes</h2>
<p>STL, OBJ, OFF or PLY, closed, in one unit. Nothing is prepared beforehand. The depth is
the least there is, with a certificate and the two points that touch.</p>
<pre>'
  readable depth.txt
  echo '</pre><p>Repair, many poses, turned robots: <code>build/phongpd depth --help</code>. From
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
