# SPDX-License-Identifier: GPL-3.0-or-later
"""README and tables of results/queries, from queries.csv and extras.csv
(query_benchmark) and instructions.csv (scripts/count_queries.sh) in the folder."""

from python_report import (parse_folder, read_dicts, read_measured, read_table,
                           rounded, tables_and_figures, write_report)
from report_statistics import median

RANDOM, COHERENT = "random", "step 0.001"


def line(aim, found, reached):
    return (f"- {aim}: {found}"
            + (" – reached.\n" if reached else " – **not reached**.\n"))


def warm_lines(rows):
    """Warm queries at 10³ and at 10⁶ triangles."""
    small, large = ([float(row["µs"]) for row in rows
                     if (row["contact space"], row["triangles"], row["sequence"],
                         row["query"]) == ("torus", size, COHERENT, "warm@0")]
                    for size in ("1024", "1000000"))
    if small:
        yield line("warm ≤ 0.3 µs at 10³ triangles", f"{rounded(small[0])} µs "
                   "(torus, ℓ = 0, steps of 0.001)", small[0] <= 0.3)
    if small and large:
        ratio = large[0] / small[0]
        yield line("warm at 10⁶ ≤ 2 × that at 10³", f"{rounded(ratio)} × "
                   f"({rounded(large[0])} µs)", ratio <= 2)


def cgal_lines(rows):
    """Beside CGAL at 10⁴, on each of the two spaces of that size."""
    cgal = {(row["contact space"], row["triangles"], row["sequence"]):
            float(row["µs"]) for row in rows if row["query"] == "CGAL"}
    for query, sequence, aim in (("warm@0", COHERENT, 20), ("warm@0.2", COHERENT, 20),
                                 ("cold@0", RANDOM, 2), ("cold@0.2", RANDOM, 2)):
        ratios = {row["contact space"]:
                  cgal[row["contact space"], row["triangles"], sequence]
                  / float(row["µs"]) for row in rows
                  if (row["sequence"], row["query"]) == (sequence, query)
                  and 8000 <= int(row["triangles"]) <= 12500}
        if ratios:
            yield line(f"{query} ≥ {aim} × faster than CGAL's AABB tree at 10⁴, "
                       f"{sequence}", ", ".join(
                           f"{rounded(ratio)} × ({space})"
                           for space, ratio in ratios.items()),
                       min(ratios.values()) >= aim)


def cold(rows):
    return [row for row in rows
            if row["query"].startswith("cold") and row["sequence"] == RANDOM]


def euclid_line(rows):
    """Cold beside our own Euclid, everywhere."""
    ratios = [float(row["over euclidean"]) for row in cold(rows)]
    above = "".join(
        f"; {row['contact space']}, {row['query']}: {row['over euclidean']}"
        for row in cold(rows) if float(row["over euclidean"]) > 2)
    return line("cold ≤ 2 × our own Euclid at every size, ℓ = 0 and 0.2",
                f"{rounded(min(ratios))} to {rounded(max(ratios))} ×, median "
                f"{rounded(median(ratios))}{above}", not above)


def extra_lines(extras):
    value = {row["what"]: float(row["value"]) for row in extras}
    space = {row["what"]: row["contact space"] for row in extras}
    yield line("`QueryBatch` on 2 threads ≥ 1.8 ×", f"{rounded(value['batch'])} × "
               f"({space['batch']})", value["batch"] >= 1.8)
    yield line("`phongpd query` of 10⁴ points on a saved space of 10⁴ triangles ≤ "
               "0.15 s, the whole process", f"{rounded(value['process'])} s "
               f"({space['process']})", value["process"] <= 0.15)
    yield line("indexes ≤ 1 KiB a triangle", f"{rounded(value['bytes'])} bytes, "
               "meshes included, of a contact space and a metric, ℓ = 0 "
               f"({space['bytes']}, the largest)", value["bytes"] <= 1024)


def wins_and_losses(rows):
    """Who is quicker, and where not."""
    rivals = {"over CGAL": "CGAL's closest point",
              "over euclidean": "our own Euclid"}
    wins, lost = dict.fromkeys(rivals, 0), ""
    for row in cold(rows):
        for column, rival in rivals.items():
            if float(row[column]) < 1:
                wins[column] += 1
            else:
                lost += (f"- {row['contact space']}, {row['triangles']} triangles: "
                         f"{row['query']} takes {row[column]} times {rival}.\n")
    return (
        "A cold query, the least depth over all projections with its side decided "
        "exactly, is quicker than CGAL's closest point, which decides no side, on "
        f"{wins['over CGAL']} of {len(cold(rows))} spaces and fields, and quicker "
        f"than our own Euclidean query on {wins['over euclidean']}. It loses:\n\n"
        + (lost or "- nowhere in this run.\n"))


def main():
    folder = parse_folder(__doc__)
    rows = read_dicts(folder / "queries.csv")
    tables = [
        read_table(
            folder, "queries.csv", "Time of a query",
            "Random: points inside that have nothing to do with each other. Step: "
            "straight motions inside, by that share of D from frame to frame. "
            "cold@ℓ and warm@ℓ: PhongPD without and with the branch of the frame "
            "before; euclidean: our own, side included; CGAL: closest point of its "
            "AABB tree over doubles, with its accelerator; segment: does the segment "
            "to the next point meet the surface, exactly. CPU time, median of the "
            "repetitions, in random order."),
        read_table(
            folder, "instructions.csv", "Instructions of a query",
            "Counted by callgrind on motions of 0.001 D a frame "
            "(`scripts/count_queries.sh`); `scripts/compare_queries.sh A B` sets "
            "those of two commits beside each other.")]
    found = "".join([*warm_lines(rows), *cgal_lines(rows), euclid_line(rows),
                     *extra_lines(read_dicts(folder / "extras.csv"))])
    write_report(
        folder, "# Queries\n\nHow long one takes, by size of the contact space, "
        "beside CGAL's AABB tree and our own Euclidean query. What each metric does "
        "along a motion, jumps and depths, and the tracker's own numbers: "
        "[tracker.md](tracker.md); what any rule could do, and of which kind each "
        "jump is: [continuity.md](continuity.md). Queries are measured by the CPU, "
        "batch and process by the clock, which suffers from whatever else the "
        f"machine does.\n\n## Aimed at and found\n\n{found}\n## Wins and losses\n\n"
        f"{wins_and_losses(rows)}\n{tables_and_figures(tables)}\n"
        f"{read_measured(folder)}\n", tables)
    print(found, end="")


if __name__ == "__main__":
    main()
