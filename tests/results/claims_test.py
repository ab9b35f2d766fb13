# SPDX-License-Identifier: GPL-3.0-or-later
"""Do the pages say what the published tables say?

    claims_test.py [PHONGPD]       the claims of claims.py, the documented motion by
                                   the program, figures nobody claims, this check
    claims_test.py --list PAGE...  figures of those pages without a claim
"""
import csv
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import claims
import claims_install
import claims_planning
from claims_tables import SOURCE

CLAIMS = claims.CLAIMS + claims_install.CLAIMS + claims_planning.CLAIMS

# Every figure of these is claimed or known to be no measurement.
WHOLE = ("README.md", "docs/choosing.md", "docs/command-line.md",
         "docs/from-cpp.md", "docs/limits.md")
# Figures that are settings, versions, names or definitions; each must be there.
NO_MEASUREMENT = {
    "README.md": ["Debian 12"],
    "docs/choosing.md": [
        "ℓ = 0.2", "FCL 0.7", "2026-11-23", "60 to 1,008 triangles",
        "at 100 random overlapping poses", "within 1 % of", "PhongPD 0.1.0",
        "Coal 3.0.3", "python-fcl 0.7.0.11", "MuJoCo 4.0.0", "Ipopt up to 3.13"],
    "docs/command-line.md": [
        "ℓ = 0.1", "ℓ is 0.2 D", "0 is the paper's field", "0700", "0600",
        "Exit code 0", "1: ran", "2: bad input", "3: a fault", "128 + n", "3MF",
        "seed 22 does 22 to 104", "the rows of 5 to 21",
        "above 0.1 has to say which", "(exit code 1)"],
    "docs/limits.md": ["ℓ = 0.1", "3MF"]}
FIGURE = re.compile(r"(?<![\w.,@#-])\d+(?:[.,]\d+)*(?:e-?\d+)?")


def plain(text):
    """In one line of words: no code blocks, comments, headings, code, targets of
    links."""
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    text = re.sub(r"^```.*?^```$", "", text, flags=re.S | re.M)
    text = re.sub(r"^( {4}|#).*$", "", text, flags=re.M)
    return " ".join(text.split())


def prose(text):
    """What is left to read for figures."""
    text = re.sub(r"\]\([^)]*\)", "]", text)
    return re.sub(r"`[^`]*`", "", text)


def said_otherwise(text, sentence):
    """The page's own words where only the figures are others, or ""."""
    pattern = "".join(
        "([^ ]+?)" if part.startswith("{") else re.escape(part)
        for part in re.split(r"({[^}]*})", sentence) if part)
    found = re.search(pattern, text)
    return found.group(0) if found else ""


def check(text, page, sentence, figures):
    """One line if the page does not say it, and what it says."""
    wanted = sentence.format(*figures)
    if wanted in text:
        return "", wanted
    other = said_otherwise(text, sentence)
    return (f"{page}: the tables say \"{wanted}\", the page says "
            + (f"\"{other}\"" if other else "no such sentence")
            + "; change the page, or tests/results/claims.py"), other


def unclaimed(text, covered):
    """Figures outside of all covered stretches, with words around them."""
    for stretch in sorted(covered, key=len, reverse=True):
        text = text.replace(stretch, re.sub(r"\d", "·", stretch))
    text = prose(text)
    return [text[max(0, m.start() - 30):m.end() + 20]
            for m in FIGURE.finditer(text)]


def motion(program):
    """What docs/command-line.md says of its own `motion`, by its own commands."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        here = {key: str(folder / key) for key in
                ("robot.off", "obstacle.off", "contact.off", "motion.csv")}
        for line in (["scenes", "write", "ball_wrench", "--meshes", name],
                     ["contact-space", "--robot", here["robot.off"], "--obstacle",
                      here["obstacle.off"], "--output", here["contact.off"]],
                     ["motion", "--contact-space", here["contact.off"], "--from",
                      "0.3", "-1.2", "0.1", "--to", "0.3", "1.2", "0.05", "--frames",
                      "400", "--smoothing-length", "0", "0.1", "--output",
                      here["motion.csv"]]):
            subprocess.run([program, *line], check=True, capture_output=True,
                           env={**os.environ, "PHONGPD_CACHE_DIR": name})
        with open(here["motion.csv"], newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
    changes = {}
    for metric in ("euclidean", "phong@0.1", "sliding"):
        places = [[float(row[f"pd_{k}"]) for k in "xyz"] for row in rows
                  if row["metric"] == metric]
        changes[metric] = sorted(map(math.dist, places, places[1:]), reverse=True)
    twice = changes["euclidean"]
    assert twice[1] > 0.8 > 0.1 > twice[2], twice[:3]
    return ("of {} frames, Euclidean depth jumps twice, by {:.2f}; PhongPD (ℓ = 0.1) "
            "changes by at most {:.3f} a frame, the sliding contact by {:.3f}",
            (len(places), twice[0], changes["phong@0.1"][0], changes["sliding"][0]))


def self_check():
    """The check finds a wrong figure, a sentence that is gone, a figure that
    nobody claims, and nothing else."""
    text = plain("Solves 3 of\n10, in `x=4`.\n\n    code 5\n\n# 6\n[a](b7.md) 8 <!-- 9 -->\n")
    assert check(text, "p", "{} of {},", (3, 10))[0] == ""
    wrong, other = check(text, "p", "Solves {} of {},", (4, 10))
    assert "Solves 4 of 10," in wrong and other == "Solves 3 of 10,"
    assert "no such sentence" in check(text, "p", "Loses {}", (3,))[0]
    assert len(unclaimed(text, ["Solves 3 of 10"])) == 1
    assert len(unclaimed(text, [])) == 3


def main(arguments):
    pages = {page: plain((SOURCE / page).read_text(encoding="utf-8"))
             for page in {c[0] for c in CLAIMS} | set(WHOLE)
             | set(arguments[1:] if arguments[:1] == ["--list"] else ())}
    said, failures = {page: [] for page in pages}, []
    said_all = list(CLAIMS)
    is_list = arguments[:1] == ["--list"]
    if arguments and not is_list:
        said_all.append(("docs/command-line.md", *motion(arguments[0])))
    for page, sentence, figures in said_all:
        failure, words = check(pages[page], page, sentence, figures)
        failures += [failure] if failure else []
        said[page] += [words] if words else []
    for page in arguments[1:] if is_list else WHOLE:
        known = NO_MEASUREMENT.get(page, [])
        failures += [f"{page}: expected \"{phrase}\" of NO_MEASUREMENT, found it "
                     "nowhere; take it from the list"
                     for phrase in known if phrase not in pages[page]]
        if not arguments:  # the motion's figures are not looked at
            known = [*known, "of 400 frames", "by 0.81", "0.092 a frame", "by 0.061"]
        failures += [f"{page}: \"…{words}…\": no claim has this figure; say in "
                     "tests/results/claims.py which table it is from"
                     for words in unclaimed(pages[page], said[page] + known)]
    self_check()
    for failure in failures:
        print(failure)
    print(f"{len(said_all)} sentences with figures in {len(pages)} pages, "
          f"{len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
