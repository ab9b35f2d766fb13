# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of the Python benchmarks, as results/bench/report.cc has them."""

import csv
import importlib.metadata
import os
import platform


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
