# SPDX-License-Identifier: GPL-3.0-or-later
"""What the campaign at the extremes found: gathers the rows that the test
programs printed, the motion checks and the fuzzing into README.md.  Exit code 1
where anything failed."""

import argparse
import json
import subprocess
import sys
from pathlib import Path

from python_report import machine, markdown

HEADER = ["item", "subject", "cases", "failures", "worst", "bound", "seed",
          "program"]

# Of open.md, so that nobody reads the zeros alone.
BESIDE = """- What aspect, scale, offset and size cost, refusals counted apart:
  [degradation.md](degradation.md).
- Beside these zeros: of 280 pairs of solids turned alike and moved by 10⁶ L 2 differ by
  more than 10⁻⁹ L, not in topology; the campaign holds them to 10⁵ L.
"""


class Log:
    """Of one test program: lines "CAMPAIGN {...}" anywhere, and last "END <exit
    code> <seconds>"."""

    def __init__(self, path):
        self.program, self.rows = path.stem, []
        self.exit_code, self.seconds = -1, 0.0  # -1: the log has no end
        for line in path.read_text(encoding="utf-8").splitlines():
            kind, _, rest = line.partition(" ")
            if kind == "CAMPAIGN":
                self.rows.append({**json.loads(rest), "program": path.stem})
            elif kind == "END":
                code, seconds = rest.split()
                self.exit_code, self.seconds = int(code), float(seconds)

    def is_well(self):
        return self.exit_code == 0 and not any(
            row["failures"] or is_above_bound(row) for row in self.rows)


def is_above_bound(row):
    return row["bound"] > 0 and not row["worst"] <= row["bound"]


def with_unit(row, key):
    if row[key] == 0 and row["bound"] == 0:
        return "–"
    return f"{row[key]:.3g} {row['unit']}"


def campaign(rows):
    cells = [[with_unit(row, key) if key in ("worst", "bound") else row[key]
              for key in HEADER] for row in rows]
    return markdown(
        "Campaign", "`worst` is the largest error seen, `bound` what it may be; "
        "without a bound the failures are all that counts.", HEADER,
        sorted(cells, key=lambda row: row[0]), "rows.jsonl")


def findings(logs, motions, fuzzing):
    """Sentences, and whether all is well."""
    rows = [row for log in logs for row in log.rows]
    broken = [log.program + (f" (exit code {log.exit_code})"
                             if log.exit_code else "")
              for log in logs if not log.is_well()]
    text = (f"- {sum(row['cases'] for row in rows)} cases in {len(rows)} rows: "
            f"**{sum(row['failures'] for row in rows)} failures**"
            + (f"; not well: {', '.join(broken)}" if broken else "") + ".\n")
    wrong = crashes = 0
    if motions:
        ours = [row for row in motions if row[1] == "ours"]
        wrong = sum(int(row[4]) + int(row[5]) for row in ours)
        text += (f"- Motion checks: {wrong} of "
                 f"{sum(int(row[2]) for row in ours)} "
                 "segments judged wrongly by ours; the others below.\n")
    if fuzzing:
        crashes = sum(int(row[4]) for row in fuzzing)
        text += (f"- Fuzzing: {sum(int(row[1]) for row in fuzzing)} runs, "
                 f"{crashes} crashes.\n")
    return text, bool(rows) and not (broken or wrong or crashes)


def table(folder, file, title, note):
    """Its rows and the Markdown of it; none of either without such a file."""
    path = folder / file
    if not path.exists():
        return [], ""
    with open(path, encoding="utf-8") as lines:
        header, *cells = [line.rstrip("\n").split(",") for line in lines]
    if any(len(row) != len(header) for row in cells):
        sys.exit(f"{path}: expected {len(header)} columns in every row")
    return cells, ended(markdown(title, note, header, cells, file))


def ended(text):
    return text.rstrip("\n") + ".\n\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--logs", type=Path, required=True,
                        help="folder of NAME.log")
    parser.add_argument("--output", type=Path, required=True,
                        help="folder to write into; motion_set.csv and "
                        "fuzzing.csv are read from it where they are")
    parser.add_argument("--program", required=True, help="phongpd, for versions")
    parser.add_argument("--how", required=True, help="command to quote")
    args = parser.parse_args()
    logs = [Log(path) for path in sorted(args.logs.glob("*.log"))]
    if not logs:
        sys.exit(f"{args.logs}: expected logs of test programs, found none")
    motions, motions_text = table(
        args.output, "motion_set.csv", "Motion checks", "Each class apart: "
        "`blocked wrongly` are false alarms, `freed wrongly` collisions that "
        "were missed. [What the set is](motion_set.md).")
    fuzzing, fuzzing_text = table(args.output, "fuzzing.csv", "Fuzzing", "")
    rows = [row for log in logs for row in log.rows]
    found, all_well = findings(logs, motions, fuzzing)
    versions = subprocess.run([args.program, "--version"], check=True, text=True,
                              capture_output=True).stdout.split("\n")
    minutes = sum(log.seconds for log in logs) / 60
    (args.output / "rows.jsonl").write_text("".join(
        json.dumps(row, ensure_ascii=False, separators=(",", ":")) + "\n"
        for row in rows), encoding="utf-8")
    (args.output / "README.md").write_text(
        "# Stability at the extremes\n\nLong forms of the tests named "
        f"`*Campaign*`; each has a short one in the suite.\n\n{found}- What is "
        f"open, written by hand: [open.md](open.md).\n{BESIDE}\n{ended(campaign(rows))}"
        f"{motions_text}{fuzzing_text}Command: {args.how}, {minutes:.3g} minutes "
        f"of tests. Machine: {machine()}. Versions: "
        f"{', '.join(filter(None, versions))}.\n", encoding="utf-8")
    print(found, end="")
    return 0 if all_well else 1


if __name__ == "__main__":
    sys.exit(main())
