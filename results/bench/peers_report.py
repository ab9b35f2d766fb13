# SPDX-License-Identifier: GPL-3.0-or-later
"""results/peers/README.md and its tables."""

import peers_depth
import peers_distance
import peers_minkowski
import peers_solvers
from python_report import machine, versions, write_tables


def _sums(rows):
    timed = [r for r in rows if not isinstance(r[3], str)]
    peers = [r for r in timed if r[2] != "PhongPD"]
    slower = [r for r in peers if r[4] > 1]
    faster = [r for r in peers if r[4] < 1]
    stopped = [r for r in rows if isinstance(r[3], str)]
    errors = [r[5] for r in peers]
    yield (f"- Minkowski sums: in {len(slower)} of {len(peers)} runs that ended "
           f"manifold3d takes {min(r[4] for r in slower):.2g} to "
           f"{max(r[4] for r in slower):.2g} times PhongPD's time, volumes agree "
           f"to {max(errors):.2g}.")
    for r in faster:
        yield (f"- PhongPD loses: {r[0]}, {r[2]} takes {r[4]:.2g} of its time "
               f"(volume error {r[5]:.2g}).")
    for r in stopped:
        yield f"- {r[0]}, {r[2]}: {r[3]}."


def _depth(rows):
    peers = list(dict.fromkeys(r[1] for r in rows
                               if not r[1].startswith("PhongPD")))
    yield "| depth of | " + " | ".join(peers) + " |"
    yield "|---" * (1 + len(peers)) + "|"
    for pair in dict.fromkeys(r[0] for r in rows):
        of = {r[1]: r for r in rows if r[0] == pair}
        cells = ["no contact" if isinstance(of[p][3], str) else
                 f"{of[p][4]:.0f} %, {of[p][5]:.0f} %, {of[p][7]:.2g}"
                 for p in peers]
        yield f"| {pair} | " + " | ".join(cells) + " |"


def _share_of_query(rows):
    shares = [r[7] for r in rows if r[1] == "PhongPD, contact space"]
    return f"{min(shares):.2g} to {max(shares):.2g}"


def _distance(rows):
    for mesh in dict.fromkeys(r[0] for r in rows):
        said = [f"{r[2]} {r[5]:.2g} times" for r in rows
                if r[0] == mesh and not r[2].startswith("PhongPD")]
        errors = [r[6] for r in rows if r[0] == mesh and "Phong (" not in r[2]]
        yield (f"- Signed distance to the {mesh.replace('its ', '')}: "
               f"{', '.join(said)} the time of PhongPD's Euclidean metric; no "
               f"error above {max(errors):.1g} of the diagonal.")


def _solvers(rows):
    names = list(dict.fromkeys(r[1] for r in rows))
    said = []
    for name in names:
        mine = [r for r in rows if r[1] == name]
        runs, claims, free = (sum(r[k] for r in mine) for k in (2, 3, 4))
        said.append(f"{name} {free} of {runs} free ({claims} said solved)")
    yield "- Trajectories from a line that collides: " + "; ".join(said) + "."


WHAT_FOR = """\
## What the peers are for

- manifold3d is a general solid modeller; its sum of two convex bodies is their
  points' hull, and it is the choice where Booleans, offsets and sums of convex
  tools belong together. Its sums of other bodies are unions of hulls, one for
  each facet or pair of facets.
- coal, FCL and MuJoCo answer whether and where two bodies touch, in
  microseconds, for many bodies that also turn. Depths of convex pairs are right
  (up to their solvers' tolerance), and there they are the better choice. For
  triangle meshes that are not convex their "depth" is that of one pair of
  triangles (coal, FCL) or of the convex hulls (MuJoCo): made for contact forces
  at small overlaps, not for the way out of deep ones, as asked here.
- Whether a motion is free, FCL answers too, but not of meshes:
  [motions.md](motions.md).
- Open3D and trimesh answer distances to any mesh, closed or not; Open3D in
  single precision and on all cores. Neither knows a contact space: for two
  bodies somebody has to build it first.
- CasADi, SciPy and Drake are solvers: they take PhongPD's rows as they take any
  other. Whoever has more in the program than a path (dynamics, time) needs them.
"""


def write_report(folder, how, seed, packages, failures, sums, depth, distance,
                 solvers):
    folder.mkdir(parents=True, exist_ok=True)
    tables = [
        ("minkowski.csv", "Minkowski sums", peers_minkowski.HEADER, sums,
         "Double precision, closed meshes alike. Volume error: relative, against "
         "the closed form for cube + L and L + U (unions of boxes), against "
         "PhongPD's for the others. hulls: the union of facet hulls by "
         "manifold3d's `hull_points` and `batch_boolean`. At most "
         f"{peers_minkowski.LIMIT:g} s of wall time."),
        ("depth.csv", "Depth of two bodies", peers_depth.HEADER, depth,
         f"{peers_depth.POSES} random poses that overlap, deep ones too. Exact: "
         "the nearest point of the exact contact space. Free: the robot moved "
         "by the answer (a millionth more), judged by `DepthQuery`; the better "
         "of both signs of the normal. coal and python-fcl: deepest of all "
         "contacts of two BVHs, of convex hulls for the convex pair. MuJoCo takes "
         "hulls always, tolerance 1e-9. `DepthQuery` builds nothing before; "
         "`contact space` is asked after the build."),
        ("distance.csv", "Signed distance to a mesh", peers_distance.HEADER,
         distance, "Random points in 1.2 times the bounding box, the same for "
         f"all; errors of the first {peers_distance.CHECKED} against brute force "
         "over all triangles in NumPy, signs by the winding number. PhongPD's "
         "Phong metric answers another question than the distance: deeper by "
         "intent."),
        ("solvers.csv", "One program, several solvers", peers_solvers.HEADER,
         solvers, f"{peers_solvers.WAYPOINTS} waypoints, margin 0.01 D, rows of "
         f"{peers_solvers.METRIC} at {peers_solvers.SAMPLES} samples a segment, "
         f"tolerance {peers_solvers.TOLERANCE:g}, at most "
         f"{peers_solvers.ITERATIONS} iterations, all from the straight line. "
         "PhongPD's own pipeline starts from a repaired line, on rows it places "
         "itself, and polishes; it is there for its verdict and is no race. "
         "Free: every point of the path, exactly.")]
    lines = [*_sums(sums), *_distance(distance), *_solvers(solvers), "",
             "Depth of two bodies at random overlapping poses: how often it is "
             "right to 1 %, how often the bodies are apart after moving by it, "
             "and its time over that of PhongPD's `DepthQuery`, which is right "
             "always and precomputes nothing. Asked of a contact space that was "
             "built before, PhongPD takes "
             + _share_of_query(depth) + " of that time.", "", *_depth(depth)]
    led = write_tables(folder, "PhongPD beside its peers", tables)
    if failures:
        lines += ["", "What did not run:", "", *(f"- {f}" for f in failures)]
    text = ["# PhongPD beside its peers", "",
            "All in one run, each from its own wheel; times are processor time "
            "of all threads, so that what else the machine does counts little.",
            "", *lines, "", WHAT_FOR, led, "",
            f"Command: {how}. Seed: {seed}. Machine: {machine()}. Versions: "
            f"{versions('numpy', *packages)}.", ""]
    (folder / "README.md").write_text("\n".join(text), encoding="utf-8")
