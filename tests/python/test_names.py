# SPDX-License-Identifier: GPL-3.0-or-later
# What a user finds by help() and an editor: examples that run, types of every
# public name.  Truth: doctest; the running objects beside the stubs.
import ast
import doctest
import inspect
import pathlib
import re

import phongpd
import pytest
from phongpd import _native


def members_of(thing):
    """Public ones, defined in the package, by name."""
    for name, value in inspect.getmembers(thing):
        if name == "__init__" or not name.startswith("_"):
            value = inspect.unwrap(getattr(value, "fget", value) or value)
            if inspect.isfunction(value) or inspect.ismethod(value):
                if value.__module__.startswith("phongpd"):
                    yield name, value


def functions():
    for name in phongpd.__all__:
        value = getattr(phongpd, name)
        if inspect.isfunction(value):
            yield name, value
        elif inspect.isclass(value) and value.__module__ != "phongpd._native":
            for member, function in members_of(value):
                yield f"{name}.{member}", function


def test_every_public_name_is_there_once_in_order():
    assert phongpd.__all__ == sorted(set(phongpd.__all__))
    for name in phongpd.__all__:
        assert hasattr(phongpd, name), name
    public = {name for name, value in vars(phongpd).items()
              if not name.startswith("_") and not inspect.ismodule(value)}
    assert public <= set(phongpd.__all__)


@pytest.mark.parametrize("name, function", list(functions()),
                         ids=lambda x: x if isinstance(x, str) else "")
def test_every_public_function_is_typed(name, function):
    signature = inspect.signature(function)
    for key, parameter in signature.parameters.items():
        if key not in ("self", "cls"):
            assert parameter.annotation is not parameter.empty, key
    assert signature.return_annotation is not signature.empty


def test_the_stub_has_the_native_names_and_no_others():
    tree = ast.parse((pathlib.Path(phongpd.__file__).parent / "_native.pyi"
                      ).read_text("utf-8"))

    def told(body):
        found = {}
        for node in body:
            if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
                found[node.name] = node
            elif isinstance(node, ast.AnnAssign):
                found[node.target.id] = node
        return {name: node for name, node in found.items()
                if name in ("__init__", "__version__") or name[0] != "_"}

    stub = told(tree.body)
    real = {name for name in dir(_native)
            if name[0] != "_" or name == "__version__"}
    assert real == set(stub)
    for name, node in stub.items():
        if not isinstance(node, ast.ClassDef) or issubclass(
                getattr(_native, name), Exception):
            continue
        members = {key for key in vars(getattr(_native, name))
                   if key[0] != "_"}
        assert members == set(told(node.body)) - {"__init__"}, name


def test_help_begins_with_three_examples_that_run():
    examples = doctest.DocTestParser().get_examples(phongpd.__doc__)
    assert examples[0].source == "import phongpd\n"
    blocks = re.findall(r"(?:^>>> .*\n(?:.+\n)*)", phongpd.__doc__, re.M)
    assert len(blocks) == 3
    failed, tried = doctest.testmod(phongpd)
    assert failed == 0 and tried == len(examples) >= 9
