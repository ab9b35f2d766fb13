# SPDX-License-Identifier: GPL-3.0-or-later
"""The benchmark of motions in time (results/bench/trajectories_*.py): its closed
forms, intervals and mazes by another route, and a slice of it from end to end."""
import csv
import math
import pathlib
import subprocess
import sys
import threading
from typing import NamedTuple

import numpy as np
import pytest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BENCH = SOURCE / "results" / "bench"
sys.path.insert(0, str(BENCH))

import trajectories_beside as beside  # noqa: E402
import trajectories_best as best  # noqa: E402
import trajectories_bounds as bounds  # noqa: E402
import trajectories_boxes as boxes  # noqa: E402
import trajectories_growth as growth  # noqa: E402
import trajectories_moving as moving  # noqa: E402
import kept_rows as rows  # noqa: E402
import trajectories_statistics as statistics  # noqa: E402
import trajectories_worlds as worlds  # noqa: E402


def farthest(seconds, v, a, j, steps=40_000):
    """How far a motion from rest to rest comes, by integration: it speeds up
    for half of the time, as hard as it may and still ends without acceleration."""
    step, speed, way, push = 0.5 * seconds / steps, 0.0, 0.0, 0.0
    for k in range(steps):
        left = 0.5 * seconds - (k + 1) * step
        # Speed is gained by push^2 / 2j while the acceleration is taken back.
        wanted = push + j * step
        if wanted > a:
            wanted = a
        if speed + wanted * step + wanted * wanted / (2 * j) > v or wanted > j * left:
            wanted = max(0.0, push - j * step)
        speed += 0.5 * (push + wanted) * step
        way += speed * step
        push = wanted
    return 2 * way


@pytest.mark.parametrize("distance, v, a, j", [
    (0.01, 1.0, 2.0, 8.0),   # jerk alone
    (0.4, 1.0, 2.0, 8.0),    # acceleration, not velocity
    (5.0, 1.0, 2.0, 8.0),    # all three
    (5.0, 0.1, 2.0, 8.0),    # velocity before acceleration
])
def test_closed_form_of_rest_to_rest_is_what_integration_finds(distance, v, a, j):
    seconds = bounds.rest_to_rest(distance, v, a, j)
    assert farthest(seconds, v, a, j) == pytest.approx(distance, rel=2e-3)


def test_closed_form_is_continuous_where_its_cases_meet():
    v, a, j = 1.0, 2.0, 8.0
    for edge in (2 * a ** 3 / j ** 2, v * (v / a + a / j)):
        below, above = (bounds.rest_to_rest(edge * (1 + e), v, a, j)
                        for e in (-1e-12, 1e-12))
        assert below == pytest.approx(above, rel=1e-10)
    assert bounds.rest_to_rest(0.0, v, a, j) == 0.0


def test_bound_is_of_the_slowest_axis_or_of_the_line():
    ends = (0.0, 0.0, 0.0), (3.0, -4.0, 0.0)
    assert bounds.least_duration(*ends, (1, 2, 8), False) == \
        bounds.rest_to_rest(4.0, 1, 2, 8)
    assert bounds.least_duration(*ends, (1, 2, 8), True) == \
        bounds.rest_to_rest(5.0, 1, 2, 8)


def test_intervals_of_shares_are_the_published_ones():
    assert statistics.share_interval(0, 10) == pytest.approx(
        (0.0, 1 - 0.025 ** 0.1))
    assert statistics.share_interval(10, 10) == pytest.approx((0.025 ** 0.1, 1.0))
    assert statistics.share_interval(5, 10) == pytest.approx(
        (0.18709, 0.81291), abs=1e-5)
    # No sum of many terms falls out of range.
    assert statistics.share_interval(600, 600)[0] == pytest.approx(
        0.025 ** (1 / 600))


def test_interval_of_a_median_draws_scenes_not_pairs():
    assert statistics.median_interval([1.0] * 9 + [5.0] * 9,
                                      ["a"] * 9 + ["b"] * 9) == (1.0, 5.0)
    low, high = statistics.median_interval(list(range(101)), ["a"] * 101)
    assert 35 <= low < 50 < high <= 65  # 50 +- 1.96 * 101 / (2 sqrt(101))


def test_maze_lacks_one_wall_for_each_new_cell_and_those_opened():
    n, opened = 12, 7
    walls = worlds.maze_walls(n, opened, 4)
    assert len(set(walls)) == len(walls) == 2 * n * (n - 1) - (n * n - 1) - opened
    shut, reached, todo = {frozenset(w) for w in walls}, {(0, 0)}, [(0, 0)]
    while todo:
        x, y = todo.pop()
        for cell in ((x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)):
            if 0 <= cell[0] < n and 0 <= cell[1] < n and cell not in reached \
                    and frozenset([(x, y), cell]) not in shut:
                reached.add(cell)
                todo.append(cell)
    assert len(reached) == n * n
    world = worlds.maze(n, opened, 4)
    centres = {w: [(w[0][k] + w[1][k]) / 2 + 0.5 for k in (0, 1)] + [0.0]
               for w in walls}
    assert not world.is_free(list(centres.values())).any()
    assert world.is_free([(x + 0.5, y + 0.5, 0.0)
                          for x in range(n) for y in range(n)]).all()
    gates = [((x + 0.5, y + 0.5, 0.0), (u + 0.5, v + 0.5, 0.0))
             for x in range(n) for y in range(n)
             for u, v in ((x + 1, y), (x, y + 1)) if u < n and v < n
             and ((x, y), (u, v)) not in centres]
    assert world.is_motion_free(*map(list, zip(*gates))).all()


class One(NamedTuple):
    key: str
    scene: str = "s"
    pair: int = 1


def inside(known, per_box, seed):
    """Random points and the corners of all boxes, a hair inside."""
    chance = np.random.default_rng(seed)
    corners = np.array([[k >> axis & 1 for axis in range(3)] for k in range(8)])
    shares = np.vstack([corners, chance.random((per_box, 3))])
    shares = 1e-9 + (1 - 2e-9) * shares
    return (known.low[:, None] + shares * (known.high - known.low)[:, None]
            ).reshape(-1, 3)


def reaches(known, start, goal):
    """Can one go from box to box?"""
    found = set(known.containing(start))
    links = known.links()
    for _ in range(len(known.low)):
        more = {b for a, b in links if a in found} | {a for a, b in links
                                                      if b in found}
        if more <= found:
            break
        found |= more
    return bool(found & set(known.containing(goal)))


@pytest.mark.parametrize("seed", range(5))
def test_boxes_of_a_building_are_free_and_lead_to_its_last_room(seed):
    known = boxes.building(seed)
    assert known.world.is_free(inside(known, 20, seed)).all()
    assert reaches(known, *boxes.building_ends())


def test_boxes_of_a_building_have_most_of_its_free_space():
    known = boxes.building(3)
    low, high = known.world.bounds
    points = np.random.default_rng(1).uniform(low, high, (4_000, 3))
    free = points[known.world.is_free(points)]
    covered = [bool(known.containing(q)) for q in free]
    assert len(free) > 2_000 and np.mean(covered) > 0.9


def test_boxes_of_the_maze_are_free_and_lead_through_it():
    known = boxes.maze()
    assert len(known.low) == worlds.CELLS ** 2 - 1 + worlds.OPENED
    points = inside(known, 1, 1)
    assert known.world.is_free(points).all()
    (start, goal), *_ = worlds.maze_pairs(worlds.CELLS, 1, seed=1)
    assert reaches(known, np.array(start), np.array(goal))


def test_rows_go_on_where_they_were_and_errors_are_rows(tmp_path):
    file, asked = tmp_path / "rows.jsonl", []

    def measure(one):
        asked.append(one.key)
        if one.key == "b":
            raise ValueError("two\nlines")
        return {"key": one.key}

    rows.fill(file, [One("a"), One("b")], measure)
    with open(file, "a", encoding="utf-8") as opened:
        opened.write('{"key": "c')  # killed while it wrote
    found = rows.fill(file, [One("a"), One("b"), One("c")], measure)
    assert asked == ["a", "b", "c"]
    assert [row["key"] for row in found] == ["a", "b", "c"]
    assert found[1]["error"] == "ValueError: two lines"
    late = rows.fill(file, [One("d")], measure, deadline=1.0, clock=lambda: 2.0)
    assert len(late) == 3


def test_rows_of_runs_at_the_same_time_are_all_there_in_the_order_wanted(tmp_path):
    file, met = tmp_path / "rows.jsonl", threading.Barrier(2, timeout=60)

    def measure(one):
        met.wait()  # ends only if two run at the same time
        return {"key": one.key}

    wanted = [One(f"{i}") for i in range(40)]
    rows.fill(file, wanted[::-1], measure, jobs=2)
    assert sorted(row["key"] for row in rows.read(file)) == sorted(
        one.key for one in wanted)
    assert [row["key"] for row in rows.fill(file, wanted[:39], measure)] == [
        *(one.key for one in wanted[:39]), "39"]


def test_best_known_only_improves_by_what_is_free_and_keeps_all_limits(tmp_path):
    def own(seconds, certified=True):
        return [{"key": "k", "certified": certified, "duration": seconds}]

    def peer(name, seconds, free=True, within=True):
        return [{"key": "k", "answers": {name: {
            "duration": seconds, "free": free, "within": within}}}]
    best.improve(tmp_path, own(3.0), [])
    best.improve(tmp_path, own(4.0), [])
    best.improve(tmp_path, own(1.0, certified=False), [])
    best.improve(tmp_path, [], peer("Drake KTO, path", 1.0, free=False))
    best.improve(tmp_path, [], peer("Drake KTO, path", 1.0, within=False))
    best.improve(tmp_path, [], peer("TOPP-RA", 1.0))
    assert best.read(tmp_path) == {"k": (3.0, "PhongPD")}
    best.improve(tmp_path, [], peer("Drake KTO, path", 2.5))
    assert best.read(tmp_path) == {"k": (2.5, "Drake KTO, path")}


def test_flyers_are_where_their_bezier_points_say():
    """De Casteljau, point by point."""
    _, _, flyers = moving.room(2)
    assert len(flyers) == 3
    durations, points = flyers[0]
    for time, piece, s in ((0.0, 0, 0.0), (0.25 * durations[0], 0, 0.25),
                           (durations[0] + 0.7 * durations[1], 1, 0.7),
                           (durations.sum() + 1.0, 2, 1.0)):
        row = list(points[piece])
        while len(row) > 1:
            row = [(1 - s) * a + s * b for a, b in zip(row, row[1:])]
        found = moving.place(flyers[0], np.array([time]))[0]
        assert np.allclose(found, row[0], atol=1e-12)


def test_growth_is_the_exponent_of_a_power_law():
    sizes = np.array([3.0, 10.0, 200.0])
    assert growth.exponent(sizes, 5.0 * sizes ** 1.25) == pytest.approx(1.25)


def test_a_slice_runs_from_end_to_end_and_goes_on(tmp_path):
    command = [sys.executable, "-B", str(BENCH / "trajectories_benchmark.py"),
               "--tiny", "--output", str(tmp_path / "out"), "--rows",
               str(tmp_path / "rows")]
    for _ in range(2):
        subprocess.run(command, check=True, capture_output=True)
    with open(tmp_path / "out" / "own.csv", newline="", encoding="utf-8") as file:
        found = list(csv.DictReader(file))
    assert len(found) == 6
    for row in found:
        assert row["certified"] == "True", row
        assert row["exact hits"] == "0" and row["FCL hits"] in ("0", "")
        assert float(row["limit used, proved"]) <= 1.0
        least, most = float(row["lower bound"]), float(row["stops"])
        assert least <= float(row["duration"]) < most < math.inf
    with open(tmp_path / "out" / "peers.csv", newline="", encoding="utf-8") as file:
        peers = {row["by"]: row for row in csv.DictReader(file)}
    assert peers["PhongPD"]["free"] == "True"
    # Here or not, each peer is told.
    assert {"Ruckig, stops", "TOPP-RA", "OMPL + TOPP-RA", "Drake KTO, line",
            "Drake KTO, path"} <= set(peers)
    with open(tmp_path / "out" / "gcs.csv", newline="", encoding="utf-8") as file:
        graphs = {row["by"]: row for row in csv.DictReader(file)}
    assert graphs["PhongPD"]["free"] == "True"
    assert set(graphs) == {"PhongPD", "PhongPD, tight", "Drake GCS"}
    with open(tmp_path / "out" / "moving.csv", newline="", encoding="utf-8") as file:
        flights = list(csv.DictReader(file))
    assert flights
    for row in flights:
        if row["certified"] == "True":
            assert row["hits at samples"] == "0"
            assert float(row["duration / alone"]) > 0.99
        else:
            assert row["status"] == "failed"
    with open(tmp_path / "out" / "growth.csv", newline="", encoding="utf-8") as file:
        larger = list(csv.DictReader(file))
    assert [row["of"] for row in larger] == ["pieces", "pieces", "triangles"]
    assert {row["certified"] for row in larger} == {"True"}
    for row in larger:
        assert int(row["contact triangles"]) > 100
        assert 0.1 < float(row["judge, CPU us a piece"]) < 1e5
    assert "<svg" in (tmp_path / "out" / "growth.svg").read_text(encoding="utf-8")
    text = (tmp_path / "out" / "README.md").read_text(encoding="utf-8")
    assert "1 buildings of 3" in text
    assert "Certified: 6 of 6 motions" in text
    assert np.isfinite(best.read(tmp_path / "out")["u_axis|1|axis"][0])


def test_a_peer_is_judged_between_its_samples():
    """It flies 0.1 above a cube, and dips into it between two of the samples."""
    phongpd = pytest.importorskip("phongpd")
    interpolate = pytest.importorskip("scipy.interpolate")
    corners = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)],
                       dtype=float)
    triangles = np.array([(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5),
                          (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4),
                          (1, 5, 7), (1, 7, 3)])
    cube = phongpd.Solid(corners, triangles)
    problem = NamedTuple("Problem", [(name, object) for name in (
        "world", "start", "goal", "limits")])(
            phongpd.World(cube, cube), np.array([0, 0, 1.1]),
            np.array([1, 0, 1.1]), (10, 10, 10))
    middle = (1000 + 0.5) / 2000
    dip = np.array([0, middle - 2e-4, middle, middle + 2e-4, 1])
    for low, free in ((1.1, True), (0.9, False)):
        place = interpolate.make_interp_spline(
            dip, [(t, 0, low if t == middle else 1.1) for t in dip], k=1)
        row = beside.beside(problem, lambda _: (
            True, 1.0, place, lambda t: (np.zeros_like(t), None, None), place))
        # Samples joined by segments see nothing of it.
        assert (place(np.linspace(0, 1, 2001))[:, 2] > 1).all()
        assert row["free"] == free and row["within"]
    assert not beside.beside(problem, lambda _: (
        True, 1.0, place, lambda t: (np.zeros_like(t), None, None),
        np.array([(0, 0, 1.1), (0.5, 0, 0.9), (1, 0, 1.1)])))["free"]
