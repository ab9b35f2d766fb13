# SPDX-License-Identifier: GPL-3.0-or-later
"""Motions among obstacles that move: rooms of boxes through which one to three
others fly, hover and turn back, and what the same ends take without these."""
from typing import NamedTuple

import numpy as np
import phongpd
import trajectories_worlds as worlds
from python_report import cell, told, verdict
from trajectories_run import cpu_of
from trajectories_statistics import median_interval, share_interval

LIMITS = (1.0, 2.0, 10.0)
ROBOT, FLYER = 0.4, 0.45  # half a side
ROOMS = 260
SEED = 9_000  # of the first room; tests and tuning know others
SAMPLES = 10_000
LONGER, MOST = 1.2, 300.0  # of the time alone; ms
BLOCKED = ("start_in_collision", "goal_in_collision")

HEADER = ["room", "flyers", "status", "certified", "duration", "alone",
          "duration / alone", "hits at samples", "CPU s", "CPU s, alone"]


class Instance(NamedTuple):
    pair: int
    scene: str = "flyers"

    @property
    def key(self):
        return f"{self.scene}|{self.pair}"


def instances(rooms=ROOMS):
    return [Instance(k) for k in range(rooms)]


def _cube(half):
    return worlds.box((-half,) * 3, (half,) * 3)


def _flat(chance, size):
    return chance.uniform(-size, size, 3) * (1.0, 1.0, 0.3)


def room(pair):
    """A world, free ends 3 apart at least, and (durations, points) of flyers."""
    chance = np.random.default_rng(SEED + pair)
    boxes = {}
    for k in range(4):
        at = _flat(chance, 4.5)
        half = np.array([0.5 + 0.4 * chance.uniform(-1, 1), 0.9, 2.0])
        boxes[f"box {k}"] = worlds.box(at - half, at + half)
    world = phongpd.World(_cube(ROBOT), boxes, name="flyers",
                          bounds=[[-6, -6, -1], [6, 6, 1]])
    while True:
        ends = np.array([_flat(chance, 5.5), _flat(chance, 5.5)])
        if np.linalg.norm(ends[1] - ends[0]) >= 3 and world.is_free(ends).all():
            break
    flyers = []
    for _ in range(pair % 3 + 1):
        stops = np.array([_flat(chance, 6.0)]
                         + [_flat(chance, 7.0) for _ in range(3)])
        flyers.append((3.0 + chance.uniform(-1, 1, 3),
                       np.array([[a, a, b, b] for a, b in zip(stops, stops[1:])])))
    return world, ends, flyers


def place(flyer, times):
    """Where it is, by Bernstein's polynomials; it stays at its end."""
    durations, points = flyer
    starts = np.concatenate([[0.0], np.cumsum(durations)])
    piece = np.clip(np.searchsorted(starts, times, side="right") - 1, 0,
                    len(durations) - 1)
    s = np.clip((times - starts[piece]) / durations[piece], 0.0, 1.0)[:, None]
    b = points[piece]
    return ((1 - s) ** 3 * b[:, 0] + 3 * s * (1 - s) ** 2 * b[:, 1]
            + 3 * s ** 2 * (1 - s) * b[:, 2] + s ** 3 * b[:, 3])


def hits(motion, flyers):
    """Samples at which the robot's box and a flyer's overlap: nothing of
    PhongPD's is asked."""
    times = np.linspace(0.0, motion.duration, SAMPLES)
    apart = [np.abs(motion.at(times) - place(flyer, times)).max(axis=1)
             for flyer in flyers]
    return int(sum((a < ROBOT + FLYER).sum() for a in apart))


def measure(instance):
    """What the room builds once is there; the contact spaces of robot and flyers
    are built within the call."""
    world, ends, flyers = room(instance.pair)
    world.plan(*ends)
    alone, cpu_alone = cpu_of(lambda: world.optimize(*ends, limits=LIMITS))
    row = {"key": instance.key, "scene": instance.scene, "pair": instance.pair,
           "flyers": len(flyers), "alone": alone.duration,
           "alone_status": alone.status, "cpu_alone": cpu_alone}
    if not alone.certified:
        return row
    moving = {f"flyer {k}": (_cube(FLYER), flyer)
              for k, flyer in enumerate(flyers)}
    try:
        motion, cpu = cpu_of(lambda: world.optimize(*ends, limits=LIMITS,
                                                    moving=moving))
    except phongpd.InputError as error:
        return row | {"error": told(error, 300)}
    row |= {"status": motion.status, "reason": motion.reason, "cpu": cpu,
            "certified": motion.certified, "duration": motion.duration}
    if motion.certified:
        row["hits"] = hits(motion, flyers)
    return row


def asked(rows):
    """Where there is a motion without flyers, and none stands on an end."""
    return [r for r in rows if "status" in r and r["status"] not in BLOCKED]


def table(rows):
    for r in asked(rows):
        ratio = r["duration"] / r["alone"] if r["certified"] else "-"
        yield (r["pair"], r["flyers"], r["status"], r["certified"],
               r["duration"] if r["certified"] else "-", r["alone"], ratio,
               r.get("hits", "-"), r["cpu"], r["cpu_alone"])


def _share(k, n):
    low, high = share_interval(k, n)
    return f"{k} of {n} ({100 * low:.4g} % to {100 * high:.4g} %)"


def page(rows):
    """The section of README.md."""
    yield "## Among obstacles that move"
    yield ""
    seen = asked(rows)
    found = [r for r in seen if r["certified"]]
    if not found:
        yield "Not run."
        return
    ratios = [r["duration"] / r["alone"] for r in found]
    cpus = [1e3 * r["cpu"] for r in found]
    near = sum(ratio <= LONGER for ratio in ratios)
    spread = [cell(float(v)) for v in np.quantile(ratios, (0.5, 0.8, 1.0))]
    middle = float(np.median(cpus))
    low, high = median_interval(cpus, ["flyers"] * len(cpus))
    unsaid = [r for r in seen if not r["certified"] and r["status"] != "failed"]
    errors = sum("error" in r for r in rows)
    yield (f"{len(seen)} rooms of four boxes, seeds from {SEED}: the robot is a box "
           "of side 0.8, one to three of side 0.9 fly from place to place and rest "
           "in between; limits 1, 2 and 10 of velocity, acceleration and jerk of "
           f"each axis. Not counted: {len(rows) - len(seen) - errors} rooms in which "
           "a flyer begins on the robot or comes to rest on its goal, or in which "
           f"there is no way without flyers. Refused or thrown: {errors}.")
    yield ""
    yield f"- Found, each of them certified: {_share(len(found), len(seen))}."
    yield (f"- Of the others {len(seen) - len(found) - len(unsaid)} say that no "
           f"motion was found, and {len(unsaid)} anything else.")
    yield (f"- Samples at which boxes overlap, {SAMPLES:,} a motion, by their sides "
           f"alone: {sum(r['hits'] for r in found)}.")
    yield (f"- At most {LONGER:g} times the time without flyers: "
           f"{_share(near, len(found))}; 80 % were asked of those that need not "
           "wait, and whether one must is not known, so that these are all. Median, "
           f"80 % and most: {', '.join(spread)} times.")
    yield (f"- Processor time, {cell(middle)} ms in the median ({cell(low)} to "
           f"{cell(high)}); {MOST:g} were asked{verdict(middle <= MOST).rstrip()}")
    yield ""
    yield "Each motion: [moving.csv](moving.csv)."
