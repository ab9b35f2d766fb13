# SPDX-License-Identifier: GPL-3.0-or-later
"""Are the published pages what their reports make of the published rows, byte for
byte?  And do the reports count as one does by hand?  (Statistics beside SciPy's:
statistics_test.py.)"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BENCH = SOURCE / "results/bench"
sys.path.insert(0, str(BENCH))

import convergence_duels  # noqa: E402
import convergence_study  # noqa: E402
import python_report  # noqa: E402
import report_statistics as statistics  # noqa: E402

MOST_WORDS = 1500  # of a page, its tables apart

# Of each report: the folder of its rows, and more arguments.
REPORTS = {"budget_report": ("trade",),
           "contact_space_report": ("contact-space",),
           "convergence_report": ("convergence",),
           "defaults_report": ("trade",),
           "degradation_report": ("extremes",),
           "fleet_report": ("fleets",),
           "lazy_report": ("lazy",),
           "paper_report": ("paper",),
           "passages_report": ("planning",),
           "planning_report": ("planning",),
           "query_report": ("queries",),
           "rigid_optimize_report": ("rigid-optimize",),
           "tracker_report": ("queries",),
           "trade_report": ("trade", "--results", str(SOURCE / "results")),
           "wrench_report": ("rigid-depth",)}


class Pages(unittest.TestCase):

    def test_come_out_of_the_published_rows(self):
        for report, (folder, *more) in REPORTS.items():
            published = SOURCE / "results" / folder
            with self.subTest(report), tempfile.TemporaryDirectory() as name:
                again = pathlib.Path(name) / folder
                shutil.copytree(published, again)
                subprocess.run(
                    [sys.executable, "-B", BENCH / f"{report}.py", "--output",
                     again, *more], check=True, stdout=subprocess.DEVNULL)
                names = [sorted(p.name for p in place.iterdir())
                         for place in (published, again)]
                self.assertEqual(*names)
                for file in names[0]:
                    # How gnuplot draws is its own business.
                    if not file.endswith(".svg"):
                        self.assertEqual((published / file).read_bytes(),
                                         (again / file).read_bytes(), file)

    def test_are_short_outside_their_tables(self):
        pages = sorted((SOURCE / "results").rglob("*.md"))
        self.assertGreater(len(pages), 40)
        for page in pages:
            words = [word for line in page.read_text(encoding="utf-8").splitlines()
                     if not line.lstrip().startswith("|") for word in line.split()]
            with self.subTest(page.relative_to(SOURCE)):
                self.assertLessEqual(len(words), MOST_WORDS)

    def test_keep_columns_of_the_same_name(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "a.csv").write_text('x,with,with\n"1, 2",3,4\n')
            table = python_report.read_table(folder, "a.csv", "A", "")
        self.assertEqual(table.header, ["x", "with", "with"])
        self.assertEqual(table.rows, [["1, 2", "3", "4"]])

    def test_lead_to_tables_where_these_are_long(self):
        table = python_report.Table("a.csv", "A", "", ["x"], [["1"]] * 100)
        text = "# T\n\n" + python_report.tables_and_figures(
            [table], [python_report.Figure("f.svg", "C", ""),
                      python_report.Figure("g.svg", "D", "", True)])
        readme, tables = python_report.split(text)
        self.assertEqual(
            readme, "# T\n\nAll tables: [tables.md](tables.md).\n\n## Figures\n\n"
            "**C**\n\n![f](f.svg)\n\nMore: [g.svg](g.svg).\n\n")
        self.assertTrue(tables.startswith("# T: tables\n"))
        self.assertEqual(tables.count("| 1 |"), 100)
        short = python_report.tables_and_figures([table._replace(rows=[["1"]])])
        self.assertEqual(python_report.split(short), (short, None))


class Counts(unittest.TestCase):

    def test_sign_test_counts_fair_coins(self):
        self.assertEqual(statistics.sign_test(0, 0), 1)
        self.assertEqual(statistics.sign_test(5, 0), 2 / 32)
        self.assertEqual(statistics.sign_test(1, 5), 14 / 64)
        self.assertEqual(statistics.sign_test(3, 3), 1)

    def test_holm_multiplies_by_the_tests_left_and_never_falls(self):
        # 3 · 0.011 is less than what the one before it came to.
        self.assertEqual(statistics.holm([0.04, 0.01, 0.5, 0.011]),
                         [0.08, 0.04, 0.5, 0.04])
        self.assertEqual(statistics.holm([0.9, 0.8]), [1, 1])
        self.assertEqual(statistics.holm([]), [])

    def test_quantiles_lie_between_the_two_nearest(self):
        self.assertEqual(statistics.quantile([], 0.5), 0)
        self.assertEqual(statistics.median([9, 1, 2, 4]), 3)
        self.assertEqual(statistics.median(iter([9, 1, 2])), 2)
        self.assertEqual(statistics.quantile([4, 0], 0.25), 1)

    def test_intervals_are_those_worked_out_on_paper(self):
        # n = 25: ranks 12.5 ∓ 4.9, the eighth from either end.
        self.assertEqual(statistics.median_interval(range(1, 26)), (13, 8, 18))
        # 20 ± 1.96·√(20 − 4)
        self.assertEqual([round(100 * x, 1) for x in
                          statistics.paired_difference(20, 0, 100)],
                         [20, 12.2, 27.8])


def row(method, seed, solved, iterations, scene="a"):
    return {"scene": scene, "protocol": "p", "method": method, "seed": seed,
            "solved": "true" if solved else "false", "iterations": str(iterations)}


class Duels(unittest.TestCase):

    def test_count_pairs_of_the_scenes_asked(self):
        rows = [row(method, seed, True, 10 if method == "own" else 20)
                for seed in range(1, 7) for method in ("own", "rival")]
        rows += [row("own", 7, True, 900), row("rival", 7, False, 1),
                 row("own", 8, False, 1), row("rival", 8, True, 900),
                 row("own", 9, False, 1), row("rival", 9, False, 2),
                 row("own", 10, True, 1),
                 row("rival", 1, True, 5, "b"), row("own", 1, True, 5, "b")]
        arena = convergence_duels.Arena(rows)
        duel = arena.fight("p", "own", "rival", ["a"])
        self.assertEqual((duel.problems, duel.only_own, duel.only_rival), (9, 1, 1))
        # What is not solved took more than any.
        self.assertEqual((duel.fewer, duel.more), (7, 1))
        self.assertEqual(duel.ratios, [0.5] * 6)
        self.assertEqual((duel.p_solved, duel.p_iterations), (1, 2 * 9 / 256))
        both = arena.fight("p", "own", "rival", ["a", "b"])
        self.assertEqual((both.problems, both.fewer + both.more), (10, 8))
        self.assertEqual(arena.fight("q", "own", "rival", ["a"]).problems, 0)
        self.assertEqual(arena.fight("p", "own", "other", ["a"]).problems, 0)

    def test_show_effects_with_their_intervals(self):
        duel = convergence_duels.Duel()
        self.assertEqual(duel.iterations_effect(), "–")
        duel.problems, duel.only_own = 100, 20
        self.assertEqual(duel.solved_effect(), "20 (12.2 … 27.8)")
        duel.ratios = list(range(1, 26))
        self.assertEqual(duel.iterations_effect(), "13 (8 … 18)")

    def test_are_labelled_by_what_all_tests_together_allow(self):
        clear = convergence_duels.Duel(only_own=20, more=9, p_solved=1e-5,
                                       p_iterations=0.004)
        weak = convergence_duels.Duel(only_rival=9, p_solved=0.03)
        convergence_duels.correct([clear, weak])
        self.assertAlmostEqual(clear.p_solved, 4e-5, 12)
        self.assertAlmostEqual(clear.p_iterations, 0.012, 12)
        self.assertAlmostEqual(weak.p_solved, 0.06, 12)
        self.assertEqual([clear.solved_verdict(), clear.iterations_verdict(),
                          weak.solved_verdict()], ["win", "**loss**", "tie"])


class Groups(unittest.TestCase):

    def test_have_every_published_scene_in_one_of_them(self):
        scenes = {row["scene"] for row in python_report.read_dicts(
            SOURCE / "results/convergence/summary.csv")}
        for scene in scenes:
            self.assertEqual(sum(convergence_study.belongs(scene, group)
                                 for group in convergence_study.GROUPS), 1, scene)

    def test_know_a_name_from_one_that_begins_with_it(self):
        for group, (families, scanned) in convergence_study.GROUPS.items():
            knobs = ":edge=0.1" if scanned else ""
            for family in families:
                belongs = [convergence_study.belongs(name + knobs, group)
                           for name in (family, family + "_x", family[:-1])]
                self.assertEqual(belongs, [True, False, False], family)

    def test_refuse_a_summary_of_other_rows(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for file in "rows.csv", "summary.csv":
                shutil.copy(SOURCE / "results/convergence" / file, folder)
            text = (folder / "summary.csv").read_text(encoding="utf-8")
            (folder / "summary.csv").write_text(
                text.replace("euclidean,50,6,", "euclidean,50,7,", 1),
                encoding="utf-8")
            with self.assertRaisesRegex(ValueError, "u_axis, straight-monotone"):
                convergence_study.Study(folder)


if __name__ == "__main__":
    unittest.main()
