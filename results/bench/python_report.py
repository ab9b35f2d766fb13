# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables and pages of all reports: CSV, Markdown, README.md with its tables and
figures, the circumstances of a measurement."""

import argparse
import csv
import importlib.metadata
import os
import platform
import re
import sys
from pathlib import Path
from typing import NamedTuple

MOST_TABLE_LINES = 80  # a README with more leaves them to tables.md


class Table(NamedTuple):
    """A table of a report, and the CSV file of its rows."""
    file: str
    title: str
    note: str
    header: list
    rows: list


class Figure(NamedTuple):
    file: str
    caption: str
    svg: str
    linked: bool = False  # by its name, below those that are shown


def rounded(value, digits=3):
    return f"{value:.{digits}g}"


def verdict(met):
    return " – met.\n" if met else " – **missed**.\n"


def line(aim, found, met):
    return f"- {aim}: {found}{verdict(met)}"


def cell(value):
    if isinstance(value, bool) or value is None:
        return {True: "yes", False: "no", None: "-"}[value]
    return f"{value:.3g}" if isinstance(value, float) else str(value)


def markdown(title, note, header, rows, file):
    lines = [f"### {title}", "", *([note, ""] if note else []), "| " + " | ".join(header) + " |",
             "|---|" + "---:|" * (len(header) - 1)]
    lines += ["| " + " | ".join(cell(value) for value in row) + " |"
              for row in rows]
    return "\n".join([*lines, "", f"Rows: [{file}]({file})", ""])


def write_csv(path, header, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows([f"{v:.6g}" if isinstance(v, float) else v
                          for v in row] for row in rows)


def write_tables(folder, title, tables):
    """tables.md beside README.md, and the rows of each table, which is (file,
    title, header, rows, note).  Returns the line of README.md that leads there.
    """
    text = [f"# {title}: tables", "", "What they say: [README.md](README.md).", ""]
    for file, name, header, rows, note in tables:
        write_csv(folder / file, header, rows)
        text.append(markdown(name, note, header, rows, file))
    (folder / "tables.md").write_text("\n".join(text), encoding="utf-8")
    return "All tables: [tables.md](tables.md)."


def read_csv(path):
    """Rows without the header; what can be a number is one."""
    with open(path, newline="", encoding="utf-8") as file:
        return [[_value(text) for text in row] for row in csv.reader(file)][1:]


def read_dicts(path):
    """Rows by the names of their columns, as text.  Without rows there is nothing
    to report."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    if not rows:
        sys.exit(f"{path}: expected rows, found none; measure them first "
                 "(scripts/bench.sh)")
    return rows


def read_table(folder, file, title, note):
    """One that is published as it was measured."""
    with open(folder / file, newline="", encoding="utf-8") as lines:
        header, *rows = csv.reader(lines)
    return Table(file, title, note, header, rows)


def read_measured(folder, file="measured.txt"):
    """The line of circumstances that the measuring program left."""
    return (folder / file).read_text(encoding="utf-8").strip()


def setting(measured, flag, default):
    """What the command was given for it."""
    found = re.search(rf"{flag}[ =](\S+?)[`.]*(?: |$)", measured)
    return found[1] if found else default


def parser_of(doc, program=None):
    """With the folder of rows and pages, and for a program that measures the
    command that its page names."""
    parser = argparse.ArgumentParser(description=doc)
    parser.add_argument("--output", type=Path, required=True,
                        help="folder of the rows, to write into")
    if program:
        parser.add_argument("--how", default=f"results/bench/{program}",
                            help="the command that the page names")
    return parser


def parse_folder(doc):
    """The only argument of a report that reads and writes one folder."""
    return parser_of(doc).parse_args().output


def told(error, most=150):
    """What went wrong, in one line."""
    return f"{type(error).__name__}: " + " ".join(str(error).split())[:most]


def tables_and_figures(tables, figures=()):
    """All tables with links to their rows, and all figures."""
    text = "## Tables\n\n" + "".join(
        markdown(t.title, t.note, t.header, t.rows, t.file) + "\n" for t in tables)
    if figures:
        text += "## Figures\n\n"
    # A caption is written once: in the picture's place there is its name.
    text += "".join(f"**{f.caption}**\n\n![{Path(f.file).stem}]({f.file})\n\n"
                    for f in figures if not f.linked)
    linked = ", ".join(f"[{f.file}]({f.file})" for f in figures if f.linked)
    return text + (f"More: {linked}.\n\n" if linked else "")


def split(text):
    """README and tables.md: a README is to be read at once, and its section "##
    Tables", where that is long, goes to a page of its own."""
    heading = "## Tables\n\n"
    before, found, rest = text.partition(heading)
    tables, figures, after = rest.partition("## Figures\n")
    if not found or (heading + tables).count("\n") <= MOST_TABLE_LINES:
        return text, None
    title = text.partition("\n")[0]
    return (f"{before}All tables: [tables.md](tables.md).\n"
            + (f"\n{figures}{after}" if figures else ""),
            f"{title}: tables\n\nWhat they say: [README.md](README.md).\n\n{tables}")


def write_report(folder, text, tables, figures=()):
    """README.md, tables.md where it is long, figures, rows of the tables."""
    for table in tables:
        write_csv(folder / table.file, table.header, table.rows)
    for figure in figures:
        (folder / figure.file).write_text(figure.svg, encoding="utf-8")
    readme, pages = split(text)
    (folder / "README.md").write_text(readme, encoding="utf-8")
    if pages is not None:
        (folder / "tables.md").write_text(pages, encoding="utf-8")


def _value(text):
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text


def _field(file, key):
    with open(file, encoding="utf-8") as lines:
        for line in lines:
            if line.startswith(key):
                return line.partition(":")[2].strip()
    return "unknown"


def machine():
    memory = int(_field("/proc/meminfo", "MemTotal").split()[0]) / 2 ** 20
    return (f"{_field('/proc/cpuinfo', 'model name')}, {os.cpu_count()} cores, "
            f"{memory:.3g} GiB memory")


def versions(*packages):
    found = [f"{name} {importlib.metadata.version(name)}" for name in packages]
    return ", ".join([f"Python {platform.python_version()}", *found])
