# SPDX-License-Identifier: GPL-3.0-or-later
"""How the time of a motion grows: with its pieces, in mazes of more and more
cells, and with the triangles of obstacles, in a forest of rounder and rounder
trees."""
import functools
from typing import NamedTuple

import numpy as np
import trajectories_worlds as worlds
from python_report import cell, verdict
from step_figure import render
from trajectories_run import NOT_AT_ALL, cpu_of

CELLS = (4, 6, 8, 12, 16, 24, 32)  # a side
SIDES = (12, 24, 48, 96, 192)      # of a tree
PAIRS = 5
LIMITS = {"pieces": (1.0, 2.0, 8.0), "triangles": (2.0, 3.0, 8.0)}
MOST = 1.3  # exponent of pieces
JUDGED = 50  # times, of which the mean is kept
MOST_JUDGE, OF_TRIANGLES = 50.0, 10_000  # us a piece, of so many of contact

HEADER = ["of", "size", "pair", "pieces", "triangles", "certified", "duration",
          "CPU s, plan and first", "CPU s, first to refined",
          "contact triangles", "judge, CPU us a piece"]


class Instance(NamedTuple):
    scene: str  # what grows
    size: int
    pair: int

    @property
    def key(self):
        return f"{self.scene}|{self.size}|{self.pair}"


def instances(cells=CELLS, sides=SIDES, pairs=PAIRS):
    return ([Instance("pieces", size, pair) for size in cells
             for pair in range(pairs)]
            + [Instance("triangles", size, pair) for size in sides
               for pair in range(pairs)])


@functools.lru_cache(2)
def _world(scene, size):
    world = (worlds.maze(size, size, seed=11) if scene == "pieces"
             else worlds.forest("forest50", seed=11, sides=size))
    world.contact_spaces()
    return world


@functools.lru_cache(None)
def _pairs(scene, size):
    if scene == "pieces":
        return worlds.maze_pairs(size, PAIRS, seed=11)
    # Trees lie within rounder ones: the same ends are free in all forests.
    return worlds.random_pairs(_world(scene, max(SIDES)), PAIRS, 15.0, seed=11)


def measure(instance):
    """Processor time of all threads; what a world builds once is there."""
    ends = _pairs(instance.scene, instance.size)[instance.pair]
    world = _world(instance.scene, instance.size)
    world.plan(*ends)
    row = {"key": instance.key, "scene": instance.scene, "size": instance.size,
           "pair": instance.pair}
    for name, wishes in (("first", {"max_seconds": NOT_AT_ALL}), ("all", {})):
        motion, row[f"cpu_{name}"] = cpu_of(lambda more=wishes: world.optimize(
            *ends, limits=LIMITS[instance.scene], **more))
    check, seconds = cpu_of(lambda: [world.check_curve(motion)
                                     for _ in range(JUDGED)][0])
    pieces = len(motion.durations)
    return row | {"certified": motion.certified and check.free,
                  "duration": motion.duration, "pieces": pieces,
                  "contact": sum(space.report["triangles"]
                                 for space in world.contact_spaces()),
                  "judge": 1e6 * seconds / JUDGED / pieces}


def _triangles(row):
    """Of the trees; of mazes it is not what grows."""
    trees = worlds.FORESTS["forest50"][2]
    return trees * (4 * row["size"] - 4) if row["scene"] == "triangles" else "-"


def _refined(row):
    return max(row["cpu_all"] - row["cpu_first"], 1e-6)


def table(rows):
    for r in rows:
        if "pieces" in r:
            yield (r["scene"], r["size"], r["pair"], r["pieces"], _triangles(r),
                   r["certified"], r["duration"], r["cpu_first"], _refined(r),
                   r["contact"], r["judge"])


def exponent(sizes, seconds):
    """Of the power law that fits best, least squares of logarithms."""
    return float(np.polyfit(np.log(sizes), np.log(seconds), 1)[0])


def of(rows, scene):
    seen = [r for r in rows if r["scene"] == scene and "pieces" in r]
    return seen, [r["pieces"] if scene == "pieces" else _triangles(r)
                  for r in seen]


def figure(rows):
    script = ("set termoption noenhanced\nset multiplot layout 1,2\n"
              "set logscale xy\nset grid lc rgb '#DDDDDD'\nset key top left\n"
              "set format '%g'\nset ylabel 'CPU seconds'\n")
    for scene, what in (("pieces", "pieces of the curve"),
                        ("triangles", "triangles of the obstacles")):
        seen, sizes = of(rows, scene)
        for name, cost in (("first", lambda r: r["cpu_first"]),
                           ("refined", _refined)):
            script += f"${scene}_{name} << EOD\n" + "".join(
                f"{size} {cost(r)}\n" for r, size in zip(seen, sizes)) + "EOD\n"
        script += (f"set xlabel '{what}'\n"
                   f"plot ${scene}_first w p pt 6 lc rgb '#888888' t 'plan and "
                   f"first curve', ${scene}_refined w p pt 7 ps 0.7 lc rgb "
                   "'#0B6E99' t 'from first to refined'\n")
    return render(script + "unset multiplot\n", 1000, 400)


def _judges(rows):
    """In the forests, whose contact spaces are of so many triangles."""
    seen = [r for r in rows if r["scene"] == "triangles" and "pieces" in r]
    large = [r for r in seen if r["contact"] >= OF_TRIANGLES]
    most = {size: max(r["judge"] for r in large if r["contact"] == size)
            for size in sorted({r["contact"] for r in large})}
    told = ", ".join(f"{us:.1f} us of {size:,}" for size, us in most.items())
    if not told:
        told = "no contact space of the forests is so large"
        return f"- The judge, of {OF_TRIANGLES:,} contact triangles and more: {told}."
    return (f"- The judge, a piece of the refined curve, at most: {told} contact "
            f"triangles; at most {MOST_JUDGE:g} us of {OF_TRIANGLES:,} were asked"
            + verdict(max(most.values()) <= MOST_JUDGE).rstrip())


def page(rows):
    """The section of README.md."""
    yield "## Growth"
    yield ""
    if not any("pieces" in r for r in rows):
        yield "Not run."
        return
    certified = sum(bool(r.get("certified")) for r in rows)
    yield (f"{len(rows)} motions, {certified} certified: through mazes of "
           f"{min(CELLS)} to {max(CELLS)} cells a side, and the same {PAIRS} pairs "
           f"in a forest of 50 trees of {min(SIDES)} to {max(SIDES)} sides.")
    yield ""
    for scene, aim in (("pieces", MOST), ("triangles", None)):
        seen, sizes = of(rows, scene)
        if len(set(sizes)) < 2:
            continue
        power = exponent(sizes, [_refined(r) for r in seen])
        met = ("." if aim is None else f"; at most {aim:g} were asked"
               + verdict(power <= aim).rstrip())
        yield (f"- From the first curve to the refined one, {min(sizes):,} to "
               f"{max(sizes):,} {scene}: time grows with exponent "
               f"{cell(power)}{met}")
        first = exponent(sizes, [r["cpu_first"] for r in seen])
        yield f"- Plan and first curve, the same: exponent {cell(first)}."
    yield ("- Ways of many corners are not compared with others: on the longest "
           "the time is that of one way.")
    yield _judges(rows)
    yield ""
    yield ("Robots: [fleets](../fleets/README.md). Contact spaces, which are there "
           "already: [contact-space](../contact-space/README.md).")
    yield ""
    yield "![time against pieces and triangles](growth.svg)"
    yield ""
    yield "Each motion: [growth.csv](growth.csv)."
