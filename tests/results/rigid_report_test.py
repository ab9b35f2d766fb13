# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables of results/rigid: counts and medians of rows written by hand, and
runs that were interrupted."""
import contextlib
import io
import json
import math
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "results" / "bench"))

import rigid_benchmark  # noqa: E402
import rigid_ompl_app as app  # noqa: E402
import rigid_peers_report as others  # noqa: E402
import rigid_report  # noqa: E402
from python_report import read_dicts  # noqa: E402


def run(seed, solved, seconds, wrong=0, check="proof"):
    return {"key": f"s RRTConnect {check} default 3 {seed}", "scene": "s",
            "planner": "RRTConnect", "check": check, "tuning": "default",
            "limit": 3.0, "seed": seed, "solved": solved, "seconds": seconds,
            "answer_seconds": 3.0 * seconds, "poses": 2, "length": 7.0 + seed,
            "wrong": wrong, "undecided": 0}


def judged(method, ms, misses=0):
    return {"scene": "s", "robot_triangles": 12, "world_triangles": 12,
            "kind": "contact", "method": method, "motions": 10, "free": 4,
            "colliding": 6, "ms": ms, "undecided": 0, "misses": misses,
            "contradictions": 0, "seed": 1}


def peer(method, ms, misses=0):
    return {"scene": "s", "kind": "contact", "method": method, "motions": 50,
            "free": 20, "colliding": 30, "ms": ms, "undecided": 0, "misses": misses,
            "contradictions": 2}


def of_the_app(seed, status, seconds, certified="yes"):
    return {"problem": "alpha", "seed": str(seed), "status": status,
            "certified": certified, "seconds": str(seconds)}


class OmplApp(unittest.TestCase):
    def test_runs_without_a_proved_path_are_not_solved(self):
        found = [of_the_app(1, "solved", 2.0), of_the_app(2, "solved", 4.0),
                 of_the_app(3, "time_limit", 60.0, "no"),
                 of_the_app(4, "failed", 9.0, "no"),
                 of_the_app(5, "time_limit", 60.0, "no")]
        # Wilson's 95 % interval of 2 of 5: 0.1176 to 0.7693.
        self.assertEqual(list(app.lines(found))[2],
                         "| alpha | 5 | 2 (12 – 77 %) | 3 | 4 | failed, time_limit |")

    def test_two_threads_stand_beside_one(self):
        found = [dict(of_the_app(1, "solved", 2.0), wall_seconds="1.5"),
                 dict(of_the_app(2, "solved", 4.0), wall_seconds="2.5"),
                 dict(of_the_app(3, "time_limit", 60.0, "no"), wall_seconds="")]
        heading, rule, line = app.lines(found)
        self.assertEqual(heading.count("|"), rule.count("|"))
        self.assertEqual(heading.count("|"), line.count("|"))
        self.assertTrue(line.endswith("| time_limit | 2 | 2 | 2.5 |"), line)
        self.assertIn("On two threads", app.page(found, "how"))

    def test_the_page_is_that_of_the_rows(self):
        folder = SOURCE / "results" / "rigid"
        text = (folder / "ompl_app.md").read_text(encoding="utf-8")
        how = text.rstrip("\n").split("\n\n")[-1]
        found = read_dicts(folder / "ompl_app.csv")
        self.assertEqual(text, app.page(found, how))
        self.assertEqual(len({(r["problem"], r["seed"]) for r in found}),
                         len(found))


class Tables(unittest.TestCase):
    def test_runs_without_a_path_are_longer_than_the_limit(self):
        found = [run(1, True, 1.0, wrong=2), run(2, True, 2.0),
                 run(3, False, 3.0)]
        self.assertEqual(
            rigid_report.sums(found),
            [["s", "RRTConnect", "proof", "default", 3.0, 3, 2, 1, 0, 2.0, 6.0,
              8.5]])
        found[1] = run(2, False, 3.0)
        self.assertEqual(rigid_report.sums(found)[0][-3:], ["more", "more", 8.0])

    def test_an_error_is_a_run_without_a_path(self):
        found = [run(1, True, 1.0), {
            "key": "s RRTConnect proof default 3 2", "scene": "s", "pair": 2,
            "error": "RuntimeError: exit code 3"}]
        self.assertEqual(
            rigid_report.sums(found),
            [["s", "RRTConnect", "proof", "default", 3.0, 2, 1, 0, 1, "more",
              "more", 8.0]])
        self.assertTrue(math.isinf(rigid_report.seconds(found[1])))

    def test_a_median_of_an_even_number_lies_between_the_two_in_the_middle(self):
        for values, expected in (([4.0, 1.0, 2.0, 8.0], 3.0), ([1.0, 2.0, 8.0], 2.0),
                                 ([1.0, math.inf, 2.0, math.inf], "more"),
                                 ([1.0, math.inf, 2.0], 2.0)):
            self.assertEqual(rigid_report.median(values), expected)

    def test_methods_are_compared_motion_set_by_motion_set(self):
        table = rigid_report.judge_table([{"rows": [
            judged("certified", 2.0), judged("FCL at 1 %", 1.0, misses=3)]}])
        self.assertEqual(list(rigid_report.judged_by_method(table)),
                         [["certified", 10, 6, 0, 0, 0, 2.0, 1.0],
                          ["FCL at 1 %", 10, 6, 3, 0, 0, 1.0, 0.5]])

    def test_motions_are_told_apart_by_the_size_of_the_meshes(self):
        small = [judged("certified", 2.0), judged("FCL at 1 %", 1.0, misses=3)]
        large = [dict(row, robot_triangles=2990, ms=4 * row["ms"]) for row in small]
        huge = [dict(row, robot_triangles=29_989) for row in small]
        table = rigid_report.judge_table([{"rows": small + large + huge}])
        self.assertEqual([r[8] for r in rigid_report.of_size(table, 0, 3000)],
                         [2.0, 1.0])
        self.assertEqual([r[8] for r in rigid_report.of_size(table, 3000, 30_000)],
                         [8.0, 4.0])
        said = list(rigid_report._size_findings(table, 0, 3000))
        self.assertEqual(len(said), 1)
        self.assertIn("2 ms a motion in the median, 2 at most", said[0].replace(
            " ms at most", " at most"))
        self.assertIn("leaves 0 of 10 undecided", said[0])
        self.assertIn("misses 3 of 6", said[0])

    def test_ours_stands_beside_the_same_proof(self):
        found = [run(1, True, 3.0)]
        found[0]["planner"] = "phongpd"
        found.append(dict(run(1, True, 2.0), tuning="tuned"))
        table = rigid_report.sums(found)
        self.assertEqual(rigid_report.proved(table, "s", "phongpd")[9], 3.0)
        said = list(rigid_report._beside_proof(table))
        self.assertEqual(len(said), 1)
        self.assertIn("s 1.5 and 4.5 (1)", said[0])

    def test_no_planner_is_the_best_where_none_has_a_right_path(self):
        ours = dict(run(1, True, 1.0), planner="phongpd")
        others_found = [run(1, False, 3.0), run(2, True, 1.0, wrong=1)]
        said, = rigid_report._ours(rigid_report.sums([ours, *others_found]))
        self.assertIn("OMPL's planners 0 of 2 runs right", said)
        others_found.append(run(3, True, 2.0))
        said, = rigid_report._ours(rigid_report.sums([ours, *others_found]))
        self.assertIn("best of OMPL 1 of 3 right", said)

    def test_others_are_compared_with_ours_on_the_same_motions(self):
        table = others.peers_table([
            {"rows": [peer("PhongPD", 0.5), peer("hpp-core", 2.0, misses=1)]},
            {"rows": [dict(peer("PhongPD", 1.0), motions=10),
                      dict(peer("ipctk", 3.0), motions=10)]},
            {"key": "s gone 50 1", "error": "ImportError: none"}])
        self.assertEqual(list(others.by_method(table)),
                         [["PhongPD", 1, 50, 30, 0, 2, 0, 0.5, 0.5, 1.0],
                          ["hpp-core", 1, 50, 30, 1, 2, 0, 2.0, 2.0, 4.0],
                          ["PhongPD", 1, 10, 30, 0, 2, 0, 1.0, 1.0, 1.0],
                          ["ipctk", 1, 10, 30, 0, 2, 0, 3.0, 3.0, 3.0]])
        self.assertEqual(
            list(others.peers_findings(table))[0],
            "- hpp-core: PhongPD is cheaper in 1 of 1 sets of motions. Misses and "
            "contradictions: 3 contact.")

    def test_newer_ompl_stands_beside_the_older(self):
        found = [{"scene": "s", "planner": "RRTConnect", "limit": 60, "solved": True,
                  "wrong": wrong, "seconds": 2.0, "in_python": 1.5, "checked": 7,
                  "seed": seed}
                 for seed, wrong in ((1, 0), (2, 2))] + [
                     {"key": "k", "error": "E: no wheel"}]
        self.assertEqual(others.newer_table(found),
                         [["s", "RRTConnect", 60, 2, 2, 1, 7, 0.75]])
        older = [run(2, False, 3.0, check="0.01"), run(2, True, 1.0)]
        self.assertEqual(
            list(others.newer_findings(found, older)),
            ["- RRTConnect, same scenes and seeds: OMPL 2.0 1 of 1 with a path, 1 "
             "wrong, within 60 s; OMPL 1.5 0 of 1 with a path, 0 wrong, within 3 s."])
        self.assertEqual(list(others.failures([], found)),
                         ["- Did not run: 1 as k: E: no wheel."])

    def test_ours_is_told_where_ompl_was_not_asked(self):
        table = rigid_report.sums([dict(run(1, True, 2.0), planner="phongpd")])
        self.assertEqual(list(rigid_report._ours(table)),
                         ["- s, 3 s: PhongPD 1 of 1 right, 2 s (the whole answer 6 s, "
                          "length 8); OMPL was not asked for so long."])

    def test_the_page_says_who_wins(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            rigid_report.write_report(
                folder, "how", "abc",
                [{"rows": [judged(m, 1.0) for m in
                           ("certified", "FCL at 1 %", "FCL at 0.1 %",
                            "FCL continuous")]}],
                [run(1, True, 2.0), run(1, True, 1.0, wrong=1, check="0.01")])
            page = " ".join((folder / "README.md").read_text(
                encoding="utf-8").split())
        self.assertIn("1 wins, 0 losses, 0 ties. Losses: none.", page)
        self.assertIn("1 of 1 runs end with a path, 1 of these are proved to "
                      "collide", page)


class Runs(unittest.TestCase):
    def test_an_interrupted_campaign_goes_on_where_it_was(self):
        asked = []

        def ask(program, *arguments):
            asked.append((program.name, *arguments))
            return [{"scene": "s"}]

        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder)
            argv = ["rigid_benchmark.py", "--output", str(path / "out"),
                    "--rows", str(path), "--part", "plan"]
            with mock.patch.object(rigid_benchmark, "ask", ask), \
                    mock.patch.object(sys, "argv", argv), \
                    contextlib.redirect_stdout(io.StringIO()):
                rigid_benchmark.main()
                first = len(asked)
                rigid_benchmark.main()
                lines = (path / "plan.jsonl").read_text().splitlines()
        self.assertEqual(len(asked), first)
        self.assertEqual(len(lines), first)
        keys = {json.loads(line)["key"] for line in lines}
        self.assertEqual(len(keys), first)
        self.assertEqual(len(set(asked)), first)

    def test_runs_have_keys_of_their_own(self):
        wanted = list(rigid_benchmark.plans(rigid_benchmark.WHOLE, [60, 600], 10))
        self.assertEqual(len({one.key for one in wanted}), len(wanted))


if __name__ == "__main__":
    unittest.main()
