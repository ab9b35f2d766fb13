# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of results/paper.  A trace is, by its label, the PD of every frame."""

import math

from step_figure import METRIC_COLOURS, quoted, render

# As `phongpd motion --svg` draws them (problems/studies/motion.cc): Euclidean PD
# and two of PhongPD, the second paler, told apart by width and dash without any
# colour; thin lines on top of wide ones.
LINES = [f"lc rgb '{METRIC_COLOURS['euclidean']}' lw 5",
         f"lc rgb '{METRIC_COLOURS['phong']}' lw 3 dt (9,5)",
         "lc rgb '#4886BB' lw 1.3"]


def motion_page(traces, title):
    """x, y, z and magnitude of every metric over the frames."""
    script = ""
    for k, pd in enumerate(traces.values()):
        script += f"$trace{k} << EOD\n" + "".join(
            f"{i} {x!r} {y!r} {z!r} {math.hypot(x, y, z)!r}\n"
            for i, (x, y, z) in enumerate(pd)) + "EOD\n"
    script += (
        f"set multiplot layout 4,1 title {quoted(title)} noenhanced font ',16' "
        "margins 0.11,0.97,0.07,0.89 spacing 0,0.025\nset grid lc rgb '#DDDDDD'\n"
        "set offsets 0,0,graph 0.08,graph 0.08\nset xzeroaxis lc rgb '#888888'\n"
        "set format x ''\n")
    for panel, name in enumerate(("x of PD", "y of PD", "z of PD", "|PD|")):
        script += f"set ylabel '{name} [length]' offset 1,0\n"
        script += ("set key at screen 0.54,0.93 center center horizontal samplen 5 "
                   "width 2 noenhanced\n" if panel == 0 else "unset key\n")
        if panel == 3:
            script += "set format x '%g'\nset xlabel 'frame'\n"
        script += "plot " + ", ".join(
            f"$trace{k} using 1:{panel + 2} with lines {LINES[k]} title "
            f"{quoted(label)}" for k, label in enumerate(traces)) + "\n"
    return render(script + "unset multiplot\n", 900, 1000)


def moment_figure(cut, traces):
    """Fig. 8's moment: for every metric one panel with the cut of obstacle, contact
    space and robot by a plane x = const, the robot's positions, and the PD vector
    at each.  `cut` has segments, and the robot's way as the segment `way`."""
    parts = {}
    for row in cut:
        parts.setdefault(row["part"], []).append(
            tuple(float(row[key]) for key in ("y1", "z1", "y2", "z2")))
    y1, z1, y2, z2 = parts["way"][0]
    script = "".join(
        f"${part} << EOD\n" + "".join(f"{a!r} {b!r}\n{c!r} {d!r}\n\n"
                                      for a, b, c, d in parts[part]) + "EOD\n"
        for part in ("obstacle", "contact", "first", "last"))
    for k, pd in enumerate(traces.values()):
        script += f"$pd{k} << EOD\n" + "".join(
            f"{y1 + t * (y2 - y1)!r} {z1 + t * (z2 - z1)!r} {y!r} {z!r}\n"
            for t, (_, y, z) in zip((i / (len(pd) - 1) for i in range(len(pd))), pd)
        ) + "EOD\n"
    script += (
        f"set multiplot layout 1,{len(traces)} title 'Pushed over the handle of the "
        "wrench: PD at consecutive frames (cut x = "
        f"{float(cut[0]['x']):g})' font ',16'\nset size ratio -1\n"
        "set xrange [-1.13:1.13]\nset yrange [-1.13:1.13]\nset xlabel 'y [length]'\n"
        "set ylabel 'z [length]'\nset key bottom center outside horizontal maxcols 2 "
        "samplen 3\n")
    for k, label in enumerate(traces):
        colour = METRIC_COLOURS["euclidean" if label.startswith("Euclidean") else
                                "phong"]
        script += (
            f"set title '{label}' noenhanced\n"
            "plot $obstacle w l lc rgb '#404040' lw 3 t 'obstacle', "
            "$contact w l lc rgb '#909090' lw 2 dt (7,4) t 'contact space', "
            "$first w l lc rgb '#B8D0E8' lw 1.5 t 'robot, first', "
            "$last w l lc rgb '#E8C8A0' lw 1.5 t 'robot, last', "
            f"$pd{k} u 1:2:3:4 w vectors head filled size 0.05,20 lw 1.3 lc rgb "
            f"'{colour}' t 'PD', $pd{k} u 1:2 w p pt 7 ps 0.35 lc rgb '#000000' t "
            "'robot centre'\n")
    return render(script + "unset multiplot\n", 1250, 520)
