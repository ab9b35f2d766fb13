# SPDX-License-Identifier: GPL-3.0-or-later
"""Methods against each other on the same scenes and seeds."""

from dataclasses import dataclass, field

from python_report import rounded
from report_statistics import (holm, median_interval, paired_difference,
                               sign_test)

LEVEL = 0.05
COLUMNS = ["solved alone", "points", "p of that", "solved", "fewer iterations",
           "ratio", "p", "iterations"]
NOTE = (
    "Solved alone: seeds that one of the two alone solved, and the difference of "
    "the solved shares in points with its 95 % interval. Fewer iterations: seeds "
    "on which either took fewer (a run that is not solved took more than any), and "
    "the median of own over the rival's where both solved, with its 95 % interval. "
    "p: two-sided sign test after Holm's correction over all tests of the table; "
    "win or loss below 0.05, else tie.")


def _verdict(wins, losses, p):
    return "tie" if p >= LEVEL else "win" if wins > losses else "**loss**"


def _interval(middle, low, high):
    return f"{rounded(middle)} ({rounded(low)} … {rounded(high)})"


@dataclass
class Duel:
    """What two methods did on the same problems."""
    problems: int = 0
    only_own: int = 0  # solved by it alone
    only_rival: int = 0
    # Iterations, where at least one solved it; one that did not took more than any.
    fewer: int = 0
    more: int = 0
    ratios: list = field(default_factory=list)  # own over rival's, both solved
    p_solved: float = 1.0
    p_iterations: float = 1.0

    def add(self, own, rival):
        """Both (solved, iterations)."""
        self.problems += 1
        self.only_own += own[0] and not rival[0]
        self.only_rival += rival[0] and not own[0]
        if own[0] and rival[0]:
            self.fewer += own[1] < rival[1]
            self.more += own[1] > rival[1]
            self.ratios.append(own[1] / max(1.0, rival[1]))
        else:
            self.fewer += own[0]
            self.more += rival[0]

    def test(self):
        self.p_solved = sign_test(self.only_own, self.only_rival)
        self.p_iterations = sign_test(self.fewer, self.more)
        return self

    def alone(self):
        return f"{self.only_own} : {self.only_rival}"

    def quicker(self):
        return f"{self.fewer} : {self.more}"

    def solved_verdict(self):
        return _verdict(self.only_own, self.only_rival, self.p_solved)

    def iterations_verdict(self):
        return _verdict(self.fewer, self.more, self.p_iterations)

    def solved_effect(self):
        """In points."""
        return _interval(*(100 * x for x in paired_difference(
            self.only_own, self.only_rival, self.problems)))

    def iterations_effect(self):
        return _interval(*median_interval(self.ratios)) if self.ratios else "–"

    def cells(self):
        """Of COLUMNS."""
        return [self.alone(), self.solved_effect(), rounded(self.p_solved, 2),
                self.solved_verdict(), self.quicker(), self.iterations_effect(),
                rounded(self.p_iterations, 2), self.iterations_verdict()]


class Arena:
    """The runs of every method by problem; rows of rows.csv."""

    def __init__(self, rows):
        self._runs = {}  # protocol and scene; seed; method
        for row in rows:
            seeds = self._runs.setdefault((row["protocol"], row["scene"]), {})
            seeds.setdefault(row["seed"], {})[row["method"]] = (
                row["solved"] == "true", float(row["iterations"]))

    def fight(self, protocol, own, rival, scenes):
        """Over the problems of the protocol on those scenes that both ran."""
        duel = Duel()
        for scene in scenes:
            for methods in self._runs.get((protocol, scene), {}).values():
                if own in methods and rival in methods:
                    duel.add(methods[own], methods[rival])
        return duel.test()


def correct(duels):
    """Both p values of all duels as one family of tests."""
    duels = list(duels)
    p = holm([p for duel in duels for p in (duel.p_solved, duel.p_iterations)])
    for i, duel in enumerate(duels):
        duel.p_solved, duel.p_iterations = p[2 * i], p[2 * i + 1]
