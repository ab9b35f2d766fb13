# SPDX-License-Identifier: GPL-3.0-or-later
"""One motion of PhongPD, measured: a row of trajectories.jsonl."""
import time

import numpy as np
import trajectories_judge as judge
from trajectories_bounds import least_duration
from trajectories_instances import ends_of, world_of

NOT_AT_ALL = 1e-6  # seconds for a faster curve: there is one before


def cpu_of(call):
    """What it returns, and processor seconds of all threads."""
    begin = time.process_time()
    result = call()
    return result, time.process_time() - begin


def measure(instance, samples=judge.SAMPLES):
    """Processor time, of all threads: of the plan alone, until the first
    certified curve, and until the refined one; each a call from the beginning,
    the contact space being there."""
    world = world_of(instance.scene)
    row = {"key": instance.key, "scene": instance.scene, "pair": instance.pair,
           "by": "norm" if instance.by_norm else "axis",
           "limits": list(instance.limits)}
    _, row["cpu_build"] = cpu_of(world.contact_spaces)  # nothing from the second on
    start, goal = ends_of(instance)
    plan, row["cpu_plan"] = cpu_of(lambda: world.plan(start, goal))
    row["plan"] = plan.status
    wishes = {"limits": instance.limits, "by_norm": instance.by_norm}
    first, row["cpu_first"] = cpu_of(lambda: world.optimize(
        start, goal, max_seconds=NOT_AT_ALL, **wishes))
    motion, row["cpu_refined"] = cpu_of(lambda: world.optimize(
        start, goal, **wishes))
    row |= {"status": motion.status, "reason": motion.reason,
            "certified": motion.certified, "first_certified": first.certified,
            "pieces": len(motion.durations), "duration": motion.duration,
            "first_duration": first.duration,
            "least_duration": least_duration(start, goal, instance.limits,
                                             instance.by_norm)}
    if len(motion.durations):
        row |= _looked_at(world, motion, samples)
    return row


def _looked_at(world, motion, samples):
    points = motion.at(np.linspace(0.0, motion.duration, samples))
    hits = judge.fcl_hits(world, points)
    used = motion.row["limits_used"]
    return {"stops_duration": motion.row["stops_duration"],
            "clearance": motion.clearance, "D": world.length,
            "verified": motion.row["verified"],
            "most_used": max(used.values()), "samples": samples,
            "exact_hits": judge.exact_hits(world, points),
            "fcl_hits": None if hits is None else len(hits),
            "sampled_use": _sampled_use(motion),
            "wall": {k: v for k, v in motion.row["seconds"].items()
                     if k in ("plan", "first", "curve")}}


def _sampled_use(motion, samples=2_000):
    """Largest share of a limit at samples: never above most_used."""
    limits, most = motion.row["limits"], 0.0
    times = np.linspace(0.0, motion.duration, samples)
    for order, name in enumerate(("velocity", "acceleration", "jerk"), 1):
        values = np.abs(motion.at(times, order))
        if limits["by"] == "norm":
            values = np.linalg.norm(values, axis=1, keepdims=True)
        most = max(most, float((values / np.array(limits[name])).max()))
    return most
