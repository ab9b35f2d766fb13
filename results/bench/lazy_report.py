# SPDX-License-Identifier: GPL-3.0-or-later
"""README, tables and figure of results/lazy, from the rows that lazy_benchmark
wrote into the folder; and culling.md and window_path.md, where the rows of
culling_benchmark and window_path_benchmark are."""

from python_report import (Figure, parse_folder, read_dicts, read_measured,
                           read_table, rounded, setting, tables_and_figures,
                           write_report)
from report_statistics import median
from step_figure import quoted, render
from window_path_report import write_page

LEVELS = {"free space": "Free space", "window": "The window"}
# Told apart by colour-blind readers, none of them yellow.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#444444",
           "#A0522D"]


def tables_of(folder, limit):
    size = read_dicts(folder / "large_scene_size.csv")[0]
    return [read_table(folder, *said) for said in (
        ("depth.csv", "Depth of at most 5 % of the diagonal",
         "CPU time of the process: that of a full build (wall time beside it) and of "
         "making the query from two meshes, medians of five, and of one answer "
         "(median and 95 %; wall time beside it); of an answer at a turned pose, "
         "which makes a new operand."),
        ("phong.csv", "PhongPD (ℓ = 0) of at most 5 % of the diagonal",
         "CPU time of the process: of the whole contact space and its metric, and of "
         "one answer from two meshes with nothing kept from others. What no window "
         "certifies takes the whole in the end, and costs more than it: faces as "
         "large as bodies."),
        ("free_space.csv", "Free space from the convolution alone",
         "CPU time of a full build, and until a `ConvolutionModel` can be asked, "
         "medians of five; the first motion check, right through the box of C_cont; "
         "random segments, of whose answers none may differ, the first time, when "
         "they model what they need of the convolution, and once more; and the "
         "clearance of the first thousand."),
        ("large_scene.csv", "Where the whole contact space is too much",
         f"Two scanned knots of {size['robot']} and {size['obstacle']} triangles, a "
         f"convolution of {size['facets']} facets: a motion from one side to the "
         "other, planned and optimised with model window from the two meshes on, "
         "judged again on the original solids; and what a full build that is limited "
         f"to {limit} s of wall time says. Each in a process of its own. Modelled "
         "are facets of the convolution, or, by contact-surface, the faces of what "
         "it arranged."),
        ("guard_verdict.csv", "The guard",
         "Share of the pairs whose prediction is within a factor of what was found, "
         "both at least 0.05 s and 16 MiB; and builds that came beyond 1.5 times a "
         "limit of half of what they need."),
        ("guard_boxes.csv", "By boxes",
         "Built by boxes over built in one, one thread: processor time and growth of "
         "the process, median and the largest; and how far the memory predicted for "
         "it is off, worst factor."))]


def volume_sentences(rows):
    for level, name in LEVELS.items():
        losses = [f"{row['pair']} ({row['cost, share']})" for row in rows
                  if row["level"] == level and float(row["volume, share"]) >= 1
                  and float(row["cost, share"]) > 1]
        yield f"{name} " + (
            f"loses to the whole where it is asked for all of the box: "
            f"{', '.join(losses)}." if losses else
            "costs less than the whole even for all of the box, in every pair.")


def phong_sentence(rows):
    losses = [f"{row['pair']} ({row['median / whole']})" for row in rows
              if float(row["median / whole"]) > 1]
    return "An answer of PhongPD from windows, in the median, costs " + (
        f"more than the whole in {', '.join(losses)}." if losses
        else "less than the whole in every pair.")


def volume_figure(rows):
    pairs = list(dict.fromkeys(row["pair"] for row in rows))
    script, plots = "", []
    for at, level in enumerate(LEVELS):
        plots.append("")
        for p, pair in enumerate(pairs):
            script += f"$d{at}{p} << EOD\n" + "".join(
                f"{row['volume, share']} {row['cost, share']}\n" for row in rows
                if (row["pair"], row["level"]) == (pair, level)) + "EOD\n"
            plots[-1] += (f"$d{at}{p} w lp pt {p + 4} ps 0.6 lw 2 lc rgb "
                          f"'{COLOURS[p % len(COLOURS)]}' t {quoted(pair)}, ")
    script += (
        "set termoption noenhanced\nset multiplot layout 1,2\nset logscale xy\n"
        "set grid lc rgb '#DDDDDD'\nset xrange [8e-5:1.2]\nset yrange [5e-3:5]\n"
        "set xlabel 'volume touched, share of the box of C_cont'\n"
        "set ylabel 'CPU time / full build'\nset format '%g'\n")
    # The names stand beside both.
    margins = ("unset key\nset lmargin at screen 0.07\nset rmargin at screen 0.36\n",
               "set key at screen 0.995,0.85 right top samplen 1.5\n"
               "set lmargin at screen 0.44\nset rmargin at screen 0.73\n")
    for level, plot, margin in zip(LEVELS, plots, margins):
        script += (f"{margin}set title '{level}'\nplot {plot}1 w l dt 2 lw 1.5 lc "
                   "rgb '#888888' t 'the whole'\n")
    return Figure(
        "volume.svg", "Cost against the volume that is touched: free space costs "
        "hundredths of the whole until most of it is asked for, a window grows with "
        "what is in it", render(script + "unset multiplot\n", 1000, 400))


def culling_page(folder):
    rows = read_dicts(folder / "culling.csv")
    faster = sum(float(row["with / without"]) < 1 for row in rows)
    shares = [float(row["by default / without"]) for row in rows]
    chosen = [share for row, share in zip(rows, shares)
              if row["culls by default"] == "yes"]
    table = read_table(
        folder, "culling.csv", "Culling facets that are occupied all over",
        "CPU seconds of a build without culling, with it, and as the library decides "
        "(median); the same surface in each, to the last bit, or else the row says "
        "so.")
    (folder / "culling.md").write_text(
        f"# What culling buys\n\nOf {len(rows)} pairs culling makes {faster} faster; "
        f"it is used by default on {len(chosen)} (median {rounded(median(chosen))} of "
        f"the time without), and by default {sum(s > 1.05 for s in shares)} take more "
        f"than 1.05 of the time without (worst {rounded(max(shares))}).\n\n"
        f"{tables_and_figures([table])}\n"
        f"{read_measured(folder, 'culling_measured.txt')}\n", encoding="utf-8")


def main():
    folder = parse_folder(__doc__)
    if (folder / "culling.csv").exists():
        culling_page(folder)
    if (folder / "window_path.csv").exists():
        write_page(folder)
    measured = read_measured(folder)
    volumes = read_dicts(folder / "volume.csv")
    found = " ".join([*volume_sentences(volumes),
                      phong_sentence(read_dicts(folder / "phong.csv"))])
    tables = tables_of(folder, rounded(float(setting(measured, "--max-seconds",
                                                     "60"))))
    figures = [volume_figure(volumes)]
    write_report(
        folder, "# Answers without the whole contact space\n\n`DepthQuery` beside "
        "`BuildContactSpace` and `EuclideanMetric`: random configurations below "
        "random points of C_cont, at most 5 % of its diagonal deep. Every answer is "
        "compared with the whole contact space's, and so is PhongPD's from windows. "
        f"`ConvolutionModel` tells free space without either.\n\n{found}\n\n"
        f"{tables_and_figures(tables, figures)}\nAll boxes: [volume.csv](volume.csv)"
        f". All pairs of the guard: [guard.csv](guard.csv). Paths optimised with a "
        f"metric from windows, and what windows lose: [window_path.md]"
        f"(window_path.md).\n\n{measured}\n",
        tables, figures)


if __name__ == "__main__":
    main()
