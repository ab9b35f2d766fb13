# SPDX-License-Identifier: GPL-3.0-or-later
"""best_known.csv: the least seconds that anybody took for an instance, free and
within all limits, and who.  It only improves."""
import csv

from python_report import write_csv

FILE = "best_known.csv"
HEADER = ["key", "seconds", "by"]
NO_JERK = {"TOPP-RA", "OMPL + TOPP-RA"}  # solve an easier problem


def read(folder):
    path = folder / FILE
    if not path.exists():
        return {}
    with open(path, newline="", encoding="utf-8") as file:
        return {row["key"]: (float(row["seconds"]), row["by"])
                for row in csv.DictReader(file)}


def is_valid(answer):
    return bool(answer.get("free") and answer.get("within"))


def improve(folder, own, peers):
    """Reads, improves by these rows, writes, returns."""
    best = read(folder)

    def offer(key, seconds, by):
        if key not in best or seconds < best[key][0]:
            best[key] = (seconds, by)
    for row in own:
        if row.get("certified"):
            offer(row["key"], row["duration"], "PhongPD")
    for row in peers:
        for name, answer in row.get("answers", {}).items():
            if is_valid(answer) and name not in NO_JERK:
                offer(row["key"], answer["duration"], name)
    with_digits = [(key, f"{best[key][0]:.9g}", best[key][1])
                   for key in sorted(best)]
    folder.mkdir(parents=True, exist_ok=True)
    write_csv(folder / FILE, HEADER, with_digits)
    return best
