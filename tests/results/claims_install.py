# SPDX-License-Identifier: GPL-3.0-or-later
"""What docs/install.md says of seconds, from what scripts/install_times.sh wrote."""
from claims_tables import cell, table

TIMES = "python/install.csv"
WHEEL = ("environment", "install", "first depth")


def seconds(column, steps):
    return sum(float(cell(TIMES, column, step=step)) for step in steps)


def row(what, steps):
    """Of processors and by the clock, and on what machine."""
    first, = {(one["load before"], one["cores"]) for one in table(TIMES)
              if one["step"] in steps}
    return ("docs/install.md", what + " | {:.3g} s | {:.3g} s, at a load of {:.0f} on "
            "{} cores |", (seconds("processor seconds", steps),
                           seconds("seconds", steps), float(first[0]), first[1]))


CLAIMS = [row("an environment, NumPy and the wheel in it, a first depth", WHEEL),
          row("the core, compiled", ("core",)),
          row("all lines of [research](walk-research.md), run", ("walk research",)),
          row("all lines of [a gantry](walk-gantry.md), run", ("walk gantry",)),
          row("all lines of [from C++](walk-cpp.md), run, core and all",
              ("walk cpp",))]
