# SPDX-License-Identifier: GPL-3.0-or-later
# The package's modules stand on each other in one direction.  Truth: each as the
# first one of its interpreter, and Python's own sorting of what sources name.
import ast
import graphlib
import importlib.util
import pathlib
import subprocess
import sys

import phongpd
import pytest

FOLDER = pathlib.Path(phongpd.__file__).parent
MODULES = {".".join(("phongpd", *path.relative_to(FOLDER).with_suffix("").parts)
                    ).removesuffix(".__init__"): path
           for suffix in ("*.py", "*.pyi") for path in FOLDER.rglob(suffix)}
TOWER = [f"phongpd.{name}" for name in (
    "_native", "_arguments", "_room", "_answers", "_motion", "_world", "_fleet")]
# Each in a process that has numpy, which is slow to come, and nothing of ours:
# the package is there without its __init__, which would import the others first.
EACH_ALONE = """
import importlib, importlib.util, os, sys
import numpy
failed = []
for name in sys.argv[1:]:
    child = os.fork()
    if child == 0:
        if name != "phongpd":
            sys.modules["phongpd"] = importlib.util.module_from_spec(
                importlib.util.find_spec("phongpd"))
        try:
            importlib.import_module(name)
        except ModuleNotFoundError as error:
            if error.name.startswith("phongpd"):
                raise  # others are what an adapter is for
        os._exit(0)
    if os.waitpid(child, 0)[1]:
        failed.append(name)
sys.exit(", ".join(failed) or 0)
"""


def imports_of(name):
    """The modules of the package that its source names anywhere: at the top, in
    functions and for types alone."""
    package = name if MODULES[name].name == "__init__.py" else \
        name.rpartition(".")[0]
    found = set()
    for node in ast.walk(ast.parse(MODULES[name].read_text("utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            of = importlib.util.resolve_name(
                "." * node.level + (node.module or ""), package)
            for alias in node.names:
                inner = f"{of}.{alias.name}"
                found.add(inner if inner in MODULES else of)
    return found & set(MODULES)


GRAPH = {name: imports_of(name) for name in MODULES}


def test_imports_go_one_way():
    order = list(graphlib.TopologicalSorter(GRAPH).static_order())
    assert set(order) == set(MODULES) and len(MODULES) > 40
    assert [name for name in order if name in TOWER] == TOWER
    assert {"phongpd._room", "phongpd._answers"} <= GRAPH["phongpd._roadmap"]
    assert {"phongpd._motion", "phongpd._roadmap"} <= GRAPH["phongpd._world"]


def test_a_circle_would_be_found():
    below = GRAPH["phongpd._room"]
    with pytest.raises(graphlib.CycleError):
        list(graphlib.TopologicalSorter(
            {**GRAPH, "phongpd._room": {*below, "phongpd._world"}}
        ).static_order())


def test_every_module_can_be_the_first():
    done = subprocess.run([sys.executable, "-c", EACH_ALONE, *sorted(MODULES)],
                          text=True, stderr=subprocess.PIPE, check=False)
    assert done.returncode == 0, done.stderr
