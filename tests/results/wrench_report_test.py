# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables of results/rigid-depth: rows written by hand."""
import math
import pathlib
import sys
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "results" / "bench"))

import wrench_report  # noqa: E402


def rows(pair, metric, changes, motion="turn", exits=(1.0, 1.0)):
    """One a length of steps, from the longest on; all changes alike."""
    return [{"pair": pair, "metric": metric, "motion": motion,
             "steps": str(32 << k), **{name: str(change)
                                       for name in wrench_report.CHANGES},
             "inside": "10", "bounded": "1", "fallbacks": "0", "µs": "5", "ms a space": "4",
             "step": str(0.1 / 2 ** k), "mean exit": str(exits[0]),
             "worst exit": str(exits[1])} for k, change in enumerate(changes)]


class Factors(unittest.TestCase):
    def test_halving_leaves_half_and_a_jump_all(self):
        self.assertAlmostEqual(wrench_report.factor(
            rows("p", "m", (0.8, 0.4, 0.2)), "direction change"), 0.5)
        self.assertAlmostEqual(wrench_report.factor(
            rows("p", "m", (1.9, 2.0, 1.9)), "direction change"), 1.0)

    def test_the_worse_motion_counts(self):
        both = rows("p", "m", (0.8, 0.4)) + rows("p", "m", (1, 1), "turn and move")
        self.assertEqual(wrench_report.factor(both, "torque change"), 1.0)

    def test_no_change_is_none_and_one_that_appears_is_infinite(self):
        self.assertEqual(wrench_report.factor(
            rows("p", "m", (1e-16, 1e-15)), "push change"), 0.0)
        self.assertEqual(wrench_report.factor(
            rows("p", "m", (0, 1)), "push change"), math.inf)


class Pages(unittest.TestCase):
    def test_say_what_is_reached_and_what_is_not(self):
        found = wrench_report.by_metric(
            rows("p", "good", (0.8, 0.4), exits=(1.1, 2.0))
            + rows("q", "good", (0.8, 0.4), exits=(1.3, 4.0))
            + rows("p", "bad", (2, 2)) + rows("q", "bad", (0.8, 0.4)))
        text = " ".join(wrench_report.findings(found).split())
        self.assertIn("good: the change of direction halves on 2 of 2 pairs", text)
        self.assertIn("bad: the change of direction halves on 1 of 2 pairs", text)
        self.assertIn("exits 1.2 times Euclid's in the mean (aim: 1.15) – **not "
                      "reached**; 1.2 in the median of the motions, 4 at worst", text)
        self.assertEqual(text.count("– reached"), 2)
        kept = wrench_report.bound_line(wrench_report.by_metric(
            rows("p", "tracked", (0.21, 0.05))))
        self.assertIn("held in 1 of 2 rows", " ".join(kept.split()))
        table = list(wrench_report.summary(found))
        self.assertEqual(table[0][:5], ["good", 2, 2, 2, 2])
        self.assertEqual(table[0][11], 10.0)

    def test_work_is_a_share_of_the_stored_energy(self):
        def row(metric, steps, way, t, force, work):
            return {"steps": str(steps), "way": str(way), "t": str(t),
                    "metric": metric, "fx": str(force), "fy": "0", "fz": "0",
                    "work": str(work), "held": str(2 * work), "change": "0.25"}
        peg = [row("euclidean", 8, 1, 0.5, 2.0, 0.0),
               row("euclidean", 8, 1, 1.0, 1.0, 0.5),
               row("euclidean", 8, -1, 1.0, 1.0, -0.5)]
        table = list(wrench_report.peg_table(peg))
        self.assertEqual(table, [["euclidean", 8, 0.25, -0.25, 0.5, -0.5, 0.25]])
        self.assertIn("euclidean: 0.25 at 8 steps", wrench_report.peg_text(table))


if __name__ == "__main__":
    unittest.main()
