# SPDX-License-Identifier: GPL-3.0-or-later
"""results/extremes/degradation.md: what aspect, scale, offset and size do to the
rows of the optimiser and to its answers, from degradation_benchmark's rows."""

from python_report import Table, parse_folder, read_dicts, read_measured, \
    tables_and_figures

AXES = ("aspect", "scale", "offset", "size")
TOLD = {"aspect": "longest over shortest side of the robot",
        "scale": "factor on all coordinates",
        "offset": "of the obstacle from the origin, in L, its own D",
        "size": "triangles of both operands, the same shapes"}


def error_of(row):
    """None where nothing was answered, or nothing is there to compare with."""
    is_known = row["axis"] != "aspect" or row["subject"] == "rows"
    if int(row["answers"]) == 0 or row["axis"] == "plain" and \
            row["subject"] == "optimize" or not is_known:
        return "–"
    return f"{float(row['worst error / L']):.2g} L"


def table_of(rows, axis):
    chosen = [row for row in rows if row["axis"] in ("plain", axis)]
    return Table(
        "degradation.csv", axis.capitalize(), TOLD[axis].capitalize() + ".",
        ["value", "subject", "asked", "answers", "refusals", "wrong", "worst error",
         "CPU s"],
        [[row["axis"] if row["axis"] == "plain" else row["value"], row["subject"],
          row["cases"], row["answers"], row["refusals"], row["wrong"], error_of(row),
          row["CPU s"]] for row in chosen])


def refusals_of(rows):
    """Each sentence once."""
    return list(dict.fromkeys(row["first refusal"] for row in rows
                              if row["first refusal"]))


def main():
    folder = parse_folder(__doc__)
    rows = read_dicts(folder / "degradation.csv")
    count = {key: sum(int(row[key]) for row in rows)
             for key in ("cases", "answers", "refusals", "wrong")}
    text = (
        "# What extremes cost\n\nA box between the robot, a box too, and its goal, both "
        "turned off all axes, so that the distance is a closed form. `rows`: 400 "
        "positions asked of the optimiser's rows with the default metric; the error is "
        "that of the distance outside, and inside what the depth is less than the "
        "Euclidean one; wrong is a wrong side. `optimize`: a path around by default; "
        "the error is that of its length beside the plain setting's, wrong is what the "
        "original solids refute. A refusal is no answer, and counted apart.\n\n"
        f"Of {count['cases']} cases {count['answers']} were answered, "
        f"{count['refusals']} refused by name, {count['wrong']} wrong. Offsets cost "
        "what doubles lose: an error of about 1e-16 of the offset.\n\nRefusals:\n\n" +
        "\n".join(f"- {sentence}" for sentence in refusals_of(rows)) + "\n\n" +
        tables_and_figures([table_of(rows, axis) for axis in AXES]) + "\n" +
        read_measured(folder, "degradation_measured.txt") + "\n")
    (folder / "degradation.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
