# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures by gnuplot, and that of curves that rise in steps, each named at its
end: performance profiles, shares of runs solved within a time."""

import importlib.util
import pathlib
import shutil
import subprocess
import sys


def _table():
    """How curves look, everywhere: the Python package's table, alone."""
    path = pathlib.Path(__file__).resolve().parents[2] / "python/phongpd/_colours.py"
    spec = importlib.util.spec_from_file_location("phongpd_colours", path)
    module = sys.modules[spec.name] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def _style(line):
    """As gnuplot has it."""
    dash = ",".join(map(str, line.dash))
    return (f"lc rgb '{line.colour}' lw {line.width:g}"
            + (f" dt ({dash})" if dash else ""))


TABLE = _table()
METRIC_COLOURS = TABLE.METRIC_COLOURS
MAIN, BASELINE = "main", "baseline"
STYLES = {MAIN: _style(TABLE.MAIN), BASELINE: _style(TABLE.BASELINE)}
# Of lines that name no colour.
LINE_COLOURS = TABLE.LINE_COLOURS


def quoted(text):
    """Between single quotes, where gnuplot reads all as it stands."""
    return "'" + text.replace("'", "''") + "'"


def render(script, width, height):
    """The SVG of a script that carries its data as $name << EOD blocks."""
    if shutil.which("gnuplot") is None:
        sys.exit("plots: expected the program gnuplot on PATH, found none; install "
                 "the Debian package gnuplot-nox")
    colours = "".join(f"set linetype {i} lc rgb '{colour}'\n"
                      for i, colour in enumerate(LINE_COLOURS, 1))
    run = subprocess.run(
        ["gnuplot"], text=True, capture_output=True,
        input="set encoding utf8\nset terminal svg size "
        f"{width},{height} dynamic enhanced font 'sans-serif,13' background rgb "
        f"'white'\n{colours}{script}\n")
    if run.returncode or "</svg>" not in run.stdout:
        sys.exit(f"gnuplot failed: {run.stderr.strip()}")
    return run.stdout


class Curve:
    """Rises at points[i][0] to points[i][1], both from small to large."""

    def __init__(self, name, role, points):
        self.name, self.role, self.points = name, role, points

    def height(self, x):
        return max((to for at, to in self.points if at <= x), default=0.0)

    def middle(self):
        """Where half of its steps are done."""
        return self.points[len(self.points) // 2][0] if self.points else 0.0


def _labels(curves, styles, end):
    """Their names beside the ends, evenly apart: the highest on top, of equals
    the first to rise."""
    script = ""
    order = sorted(range(len(curves)), key=lambda i: (-curves[i].height(end),
                                                      curves[i].middle()))
    for i, k in enumerate(order):
        curve, at = curves[k], styles[k].index("#")
        colour, height = styles[k][at:at + 7], 0.96 - 0.062 * i
        script += (
            f"set arrow from {end:g},{curve.height(end):g} to graph 1.025, graph "
            f"{height:g} nohead lc rgb '{colour}' lw 0.7\nset label "
            f"{quoted(curve.name)} at graph 1.03, graph {height:g} left noenhanced "
            f"tc rgb '{colour}'\n")
    return script


def step_figure(curves, title, x, y, least=1.0, most=100.0):
    """x is logarithmic, y from 0 to 1."""
    script, plots, styles, others = "", [], [], 0
    for k, curve in enumerate(curves):
        script += f"$m{k} << EOD\n{least!r} 0\n" + "".join(
            f"{max(at, least)!r} {to:g}\n" for at, to in curve.points if at <= most)
        script += f"{most:g} {curve.height(most):g}\nEOD\n"
        style = STYLES.get(curve.role)
        if style is None:
            line = TABLE.other(others)
            style = _style(line) + ("" if line.dash else " dt 1")
            others += 1
        styles.append(style)
        plots.append(f"$m{k} using 1:2 with steps {style} notitle")
    # Bytes, not letters: so have all published figures their margins.
    longest = max([18, *(len(curve.name.encode()) for curve in curves)])
    script += (
        f"set logscale x\nset xrange [{least:g}:{most:g}]\nset yrange [0:1.03]\n"
        f"set ytics 0,0.2,1\nset rmargin {3 + 4 * longest // 5}\n"
        "set format x '%g'\nset grid lc rgb '#DDDDDD'\n"
        f"set xlabel {quoted(x)} noenhanced\nset ylabel {quoted(y)} noenhanced\n"
        f"set title {quoted(title)} noenhanced\n{_labels(curves, styles, most)}"
        f"plot {', '.join(plots)}\n")
    return render(script, 760, 440)
