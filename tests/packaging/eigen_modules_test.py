# SPDX-License-Identifier: GPL-3.0-or-later
"""eigen_modules_test.py SOURCE: who uses a function of Eigen includes its module.

Some members of matrices are declared by <Eigen/Core> and defined elsewhere: without
that module a source compiles, and links only where another one in the program has
the same function of the same types.
"""
import pathlib
import re
import sys

MEMBERS = {"Geometry": "cross|cross3|eulerAngles|hnormalized|homogeneous|unitOrthogonal",
           "LU": "determinant|fullPivLu|lu|partialPivLu",
           "Cholesky": "ldlt|llt",
           "QR": "colPivHouseholderQr|fullPivHouseholderQr|householderQr",
           "SVD": "bdcSvd|jacobiSvd",
           "Eigenvalues": "eigenvalues"}
FOLDERS = ("core", "constraints", "planners", "problems", "viewer", "python", "tests",
           "results", "examples")


def missing(text, header=""):
    """Modules that a source needs, and neither it nor its header includes."""
    for module, members in MEMBERS.items():
        if (re.search(rf"[.>]({members})\(", text)
                and not re.search(rf"<Eigen/({module}|Dense)>", text + header)):
            yield module


def main(source):
    assert list(missing("a.cross(b)")) == ["Geometry"]
    assert not list(missing("a.cross(b)", "#include <Eigen/Geometry>"))
    failures, users = [], 0
    for folder in FOLDERS:
        for path in sorted((source / folder).rglob("*.cc")) + sorted(
                (source / folder).rglob("*.h")):
            header = path.with_suffix(".h")
            text = path.read_text()
            users += "#include <Eigen/" in text
            failures += [f"{path.relative_to(source)} uses what <Eigen/{module}> "
                         "defines, and includes it by chance only"
                         for module in missing(text, header.read_text()
                                               if header.exists() else "")]
    print(f"{users} sources and headers include a module of Eigen")
    if not users:
        failures.append("none found: are they elsewhere?")
    if failures:
        sys.exit("\n".join(failures))


main(pathlib.Path(sys.argv[1]))
