# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the notebooks of docs/notebooks from beginning to end: an error or a
warning of any cell fails.  What they show, executed notebook and pictures, stays
in the folder that PHONGPD_NOTEBOOKS names."""
import base64
import os
import pathlib

import nbclient
import nbformat
import pytest

FOLDER = pathlib.Path(__file__).parents[2] / "docs/notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))


def outputs_of(notebook):
    return [output for cell in notebook.cells if cell.cell_type == "code"
            for output in cell.outputs]


def keep(notebook, name):
    folder = pathlib.Path(os.environ["PHONGPD_NOTEBOOKS"])
    folder.mkdir(parents=True, exist_ok=True)
    nbformat.write(notebook, folder / f"{name}.ipynb")
    data = [output.get("data", {}) for output in outputs_of(notebook)]
    for k, picture in enumerate(d["image/png"] for d in data if "image/png" in d):
        (folder / f"{name}-{k}.png").write_bytes(base64.b64decode(picture))
    for k, page in enumerate(d["text/html"] for d in data
                             if "<iframe" in d.get("text/html", "")):
        (folder / f"{name}-{k}.html").write_text(page, "utf-8")


def test_there_are_five():
    assert len(NOTEBOOKS) == 5


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_is_committed_small_and_without_outputs(path):
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    assert path.stat().st_size < 20_000
    assert not outputs_of(notebook)
    assert all(cell.get("execution_count") is None for cell in notebook.cells)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_runs_and_shows_plots_and_scenes(path):
    notebook = nbformat.read(path, as_version=4)
    client = nbclient.NotebookClient(
        notebook, timeout=240, kernel_name="python3",
        resources={"metadata": {"path": str(FOLDER)}})
    try:
        client.execute()
    finally:
        if "PHONGPD_NOTEBOOKS" in os.environ:
            keep(notebook, path.stem)
    outputs = outputs_of(notebook)
    said = [o.text for o in outputs if o.get("name") == "stderr"]
    assert not said, said
    shown = [o.get("data", {}) for o in outputs]
    assert sum("image/png" in data for data in shown) >= 2
    assert sum("<iframe" in data.get("text/html", "") for data in shown) >= 2
