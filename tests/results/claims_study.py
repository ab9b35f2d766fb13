# SPDX-License-Identifier: GPL-3.0-or-later
"""Claims of claims.py that rest on the page of results/study, which study_test.py
makes anew from its rows."""
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = (ROOT / "results/study/README.md").read_text()
# (hypothesis, protocol, converged, p, word, iterations)
FOUND = [tuple(cell.strip() for cell in line.strip("|").split("|"))
         for line in PAGE.splitlines() if re.match(r"\| H\d: ", line)]
STARTS = ("straight-monotone", "straight-adaptive")


def verdicts(word):
    return sum(one[4].strip("*") == word for one in FOUND)


def converged(method):
    row = next(line for line in PAGE.splitlines()
               if line.startswith(f"| `{method}` | ") and " / " in line)
    return [int(x) for x in re.findall(r"\| (\d+) / ", row)[:2]]


def free(method):
    """Of straight-adaptive."""
    row = next(line for line in PAGE.splitlines()
               if line.startswith(f"| `{method}` | ") and " / " in line)
    return int(re.findall(r"/ (\d+) of", row)[1])


def ratios(name):
    """With their intervals, of the straight starts."""
    return [[float(x) for x in re.findall(r"[\d.]+", one[5].replace("…", " "))]
            for protocol in STARTS for one in FOUND
            if one[0].startswith(name + ":") and one[1] == protocol]


PROBLEMS, SCENES = (int(x) for x in re.search(
    r"(\d+) problems: (\d+) scenes", PAGE).groups())
assert verdicts("win") == verdicts("loss") == 0
# "with intervals below one"
assert all(high < 1.0 for _, _, high in ratios("H1"))
# "it is the side that the smoothed one takes that saves them"
assert all(high < 1.0 for _, _, high in ratios("H5"))
STUDY_CLAIMS = [
    ("docs/choosing.md", "{} problems of {} scenes, with at most 3,000 iterations",
     (PROBLEMS, SCENES)),
    ("docs/choosing.md", "of {} comparisons none is a win or a loss, {} are ties within "
     "±3 points, {} stay open", (len(FOUND), verdicts("tie"), verdicts("open"))),
    ("docs/choosing.md", "Euclidean PD converges from colliding starts in {} "
     "(monotone mu) and {} (adaptive) of {}, PhongPD in {} and {}, the smoothed "
     "direction in {} and {}", (*converged("euclidean"), PROBLEMS,
                                *converged("phong@0.2"), *converged("smoothed@0.2"))),
    ("docs/choosing.md", "Exactly free in the end are, with adaptive mu, {}, {} and {}",
     tuple(free(m) for m in ("euclidean", "phong@0.2", "smoothed@0.2"))),
    ("docs/choosing.md", "direction takes fewer iterations: {:.2f} and {:.2f} times "
     "Euclid's",
     tuple(x[0] for x in ratios("H1"))),
    ("docs/choosing.md", "by lot, converges in {} and {}, with {:.2f} and {:.2f} times "
     "the iterations of Euclid's",
     (*converged("placebo@0.2"), *(x[0] for x in ratios("H4")))),
]
