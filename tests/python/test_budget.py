# SPDX-License-Identifier: GPL-3.0-or-later
"""A budget picks by the published table; what is named wins over it."""
import csv
import pathlib

import pytest

import phongpd

TABLE = (pathlib.Path(__file__).resolve().parents[2]
         / "results/trade/budget_flags.csv")


def published(use, seconds):
    """Flags of the smallest size."""
    with open(TABLE, newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["use"] == use
                and float(row["seconds"]) == seconds]
    words = min(rows, key=lambda row: int(row["triangles"]))["flags"].split()
    return dict(zip(words[::2], words[1::2]))


def test_plan_takes_the_planner_of_the_table():
    world = phongpd.World.load("u_axis")
    for seconds in (0.1, 1.0):
        flags = published("plan", seconds)
        row = world.plan(budget=seconds).row
        assert row["planner"] == flags.get("--planner", "contact-surface")
    assert world.plan(budget=0.1, planner="contact-surface").row["planner"] == \
        "contact-surface"
    assert world.plan().row["planner"] == "contact-surface"


def test_optimize_takes_the_preset_of_the_table():
    world = phongpd.World.load("u_axis")
    found = world.optimize(limits="none", budget=0.1)
    assert found.row["preset"] == published("optimize", 0.1)["--preset"]
    assert found.free
    assert world.optimize(limits="none", budget=0.1,
                          preset="tight").row["preset"] == "tight"


def test_nonsense_is_refused():
    world = phongpd.World.load("u_axis")
    for bad in (0.0, -1.0, float("nan")):
        with pytest.raises(phongpd.InputError, match="budget"):
            world.plan(budget=bad)
    with pytest.raises(phongpd.InputError, match="motion in time"):
        world.optimize(limits=(1, 2, 10), budget=1.0)
