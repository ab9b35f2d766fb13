# SPDX-License-Identifier: GPL-3.0-or-later
"""Converged, stalled, certified and without a plan are four things: rows written by
hand, counted by hand."""
import pathlib
import sys
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "results" / "bench"))

import rigid_optimize_report as report  # noqa: E402


def row(method="both", solver="converged", certified=True, planned=0.0, length=1.0,
        refuted=False, scene="slot"):
    return {"scene": scene, "method": method, "seed": 1, "limit": 10.0,
            "status": "", "solver": solver, "certified": certified,
            "refuted": refuted, "planned_length": planned, "length": length,
            "rounds": 1, "iterations": 7, "samples": 3, "cpu_seconds": 0.5}


ROWS = [row(), row(solver="stalled_feasible", planned=2.0),
        row(solver="cancelled", planned=1.0),
        row(solver="iteration_limit", certified=False)]
SAMPLED = [row("samples", certified=False, refuted=True),
           row("samples", "stalled_feasible"), row("samples", "infeasible", False),
           row("samples", "iteration_limit", True)]


class Counts(unittest.TestCase):

    def test_tell_what_converged_from_what_is_proved(self):
        scene, method, runs, converged, stalled, certified, refuted, none, *_ = (
            report.line("slot", "both", ROWS))
        self.assertEqual((scene, method, runs), ("slot", "both", 4))
        self.assertEqual((converged, stalled, certified), (1, 2, 3))
        self.assertEqual((refuted, none), (0, 1))
        *_, ratio, iterations, middle, most = report.line("slot", "both", ROWS)
        self.assertEqual((ratio, iterations), ("0.75 (1)", "7"))
        self.assertEqual((middle, most), ("0.5", "0.5"))

    def test_leave_what_samples_claim_to_the_judge(self):
        _, _, runs, converged, stalled, certified, refuted, none, *_ = (
            report.line("slot", "samples", SAMPLED))
        self.assertEqual((runs, converged, stalled), (4, 1, 1))
        # One that is free was not claimed, one that was claimed is not free.
        self.assertEqual((certified, refuted, none), (2, 1, 0))

    def test_say_where_nine_of_ten_are_reached(self):
        rows = [row() for _ in range(9)] + [row(certified=False, planned=3.0)]
        rows += [row(scene="peg", certified=k < 8, planned=1.0) for k in range(10)]
        said = " ".join(report.findings(rows)[0].split())
        self.assertIn("17 of 20 runs end with a path that is free", said)
        self.assertIn("9 of 10 or more on 1 of 2 scenes that have 10 runs", said)
        # Two of two are not nine of ten.
        few = " ".join(report.findings([row(), row()])[0].split())
        self.assertIn("9 of 10 or more on 0 of 0 scenes", few)
        self.assertIn("no plan in time: 0", said)
        self.assertIn("Of 11 with a plan 0 are longer", said)


if __name__ == "__main__":
    unittest.main()
