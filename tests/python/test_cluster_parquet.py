# SPDX-License-Identifier: GPL-3.0-or-later
# Truth: the rows as JSON has them; pandas, which reads what pyarrow wrote.
import json
import os
import subprocess
import sys

import pandas
import phongpd
import pyarrow.parquet
import pytest
from conftest import make_box
from distributed import Client, LocalCluster
from phongpd import cluster
from phongpd.cluster import _parquet


def write(path, rows, end=""):
    path.write_text("".join(json.dumps(row) + "\n" for row in rows) + end)
    return path


def read(path):
    return pyarrow.parquet.read_table(path).to_pylist()


ROWS = [
    {"key": "a", "n": 1, "x": 1, "ok": True, "seconds": {"total": 0.5, "n": 3},
     "p": [1, 2.5, 3], "path": [[0, 0, 0], [1, 2, 3]], "what": "text", "e": {},
     "none": None, "big": 2 ** 64, "words": ["a"], "seed": 2 ** 53 + 1},
    {"key": "b", "n": 2, "x": 2.5, "ok": None, "seconds": {"total": 1},
     "p": [], "path": [], "what": 5, "more": -1},
    {"key": "c"},
]


def test_columns_are_the_fields_and_rows_the_rows(tmp_path):
    source = write(tmp_path / "rows.jsonl", ROWS)
    assert cluster.write_parquet(source, tmp_path / "rows.parquet") == 3
    one, two, three = read(tmp_path / "rows.parquet")
    assert one == {
        "key": "a", "n": 1, "x": 1.0, "ok": True, "seconds.total": 0.5,
        "seconds.n": 3, "p": [1, 2.5, 3], "path": [[0, 0, 0], [1, 2, 3]],
        "what": '"text"', "e": "{}", "none": None, "big": str(2 ** 64),
        "words": '["a"]', "seed": 2 ** 53 + 1, "more": None}
    assert (two["seconds.total"], two["seconds.n"], two["p"], two["what"],
            two["more"], two["ok"], two["path"]) == (
                1.0, None, [], "5", -1, None, [])
    assert {name for name, value in three.items() if value is not None} == {
        "key"}
    frame = pandas.read_parquet(tmp_path / "rows.parquet")
    assert frame["x"].tolist()[:2] == [1.0, 2.5]
    assert frame["key"].tolist() == ["a", "b", "c"]
    assert sorted(os.listdir(tmp_path)) == ["rows.jsonl", "rows.parquet"]


def test_paths_are_lists_of_points(tmp_path):
    rows = [{"path": [[0, 0.5, 0], [1, 2, 3]]}, {"path": [[], [1, 1, 1]]}, {},
            {"path": []}]
    source = write(tmp_path / "rows.jsonl", rows)
    cluster.write_parquet(source, tmp_path / "p")
    assert [row["path"] for row in read(tmp_path / "p")] == [
        [[0, 0.5, 0], [1, 2, 3]], [[], [1, 1, 1]], None, []]


def test_many_rows_are_written_in_groups_and_the_bytes_are_the_same(tmp_path):
    rows = [{"key": str(i), "x": i * 0.1} for i in range(25001)]
    source = write(tmp_path / "rows.jsonl", rows)
    for name in "ab":
        assert cluster.write_parquet(source, tmp_path / name) == 25001
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()
    file = pyarrow.parquet.ParquetFile(tmp_path / "a")
    assert file.num_row_groups == 3
    assert file.read().to_pylist() == rows


def test_rows_of_a_sweep_also_while_it_runs(tmp_path):
    robot = make_box((0, 0, 0), (1, 1, 1))
    obstacle = make_box((0.8, 0, 0), (2, 1, 1))
    with LocalCluster(n_workers=1, processes=False, dashboard_address=None) \
            as local, Client(local) as client:
        done = cluster.depth(robot, obstacle, [[0, 0, 0], [5, 0, 0]],
                             output=tmp_path / "rows.jsonl", client=client)
    assert done.write_parquet(tmp_path / "all.parquet") == 2
    found = read(tmp_path / "all.parquet")
    assert [row["depth"] for row in found] == [
        row["depth"] for row in done.read()]
    assert found[0]["depth"] == pytest.approx(0.2)
    assert found[0]["position"] == [0, 0, 0]
    partial = tmp_path / "rows.jsonl.partial"
    partial.write_bytes(done.output.read_bytes()[:-7])
    assert cluster.write_parquet(partial, tmp_path / "some.parquet") == 1
    assert read(tmp_path / "some.parquet") == found[:1]
    partial.write_bytes(b"")
    assert cluster.write_parquet(partial, tmp_path / "no.parquet") == 0
    assert read(tmp_path / "no.parquet") == []


@pytest.mark.parametrize("content, found", [
    ("no json\n", "line 1: expected a JSON object, found b'no json"),
    ('{"a": 1}\n[1]\n', "line 2: expected a JSON object"),
    ('{"a.b": 1, "a": {"b": 2}}\n', "'a.b' twice"),
])
def test_what_is_no_row_is_named_and_nothing_is_written(tmp_path, content, found):
    source = tmp_path / "rows.jsonl"
    source.write_text(content)
    with pytest.raises(phongpd.InputError, match=found) as error:
        cluster.write_parquet(source, tmp_path / "rows.parquet")
    assert str(source) in str(error.value) and "\n" not in str(error.value)
    assert os.listdir(tmp_path) == ["rows.jsonl"]


def test_files_that_cannot_be_are_named(tmp_path):
    with pytest.raises(phongpd.InputError, match="none: expected a file of rows"):
        cluster.write_parquet(tmp_path / "none", tmp_path / "p")
    source = write(tmp_path / "rows.jsonl", ROWS)
    with pytest.raises(phongpd.InputError, match="p: expected a file to write"):
        cluster.write_parquet(source, tmp_path / "none" / "p")
    assert os.listdir(tmp_path) == ["rows.jsonl"]


def test_without_pyarrow_it_says_what_to_install(tmp_path):
    source = write(tmp_path / "rows.jsonl", ROWS)
    program = ("import sys; sys.modules['pyarrow'] = None\n"
               "from phongpd import cluster\n"
               f"cluster.write_parquet({str(source)!r}, 'p')")
    said = subprocess.run([sys.executable, "-c", program], cwd=tmp_path,
                          capture_output=True, text=True).stderr
    assert "pip install 'phongpd[parquet]'" in said
    assert os.listdir(tmp_path) == ["rows.jsonl"]


def test_the_number_of_rows_of_a_group_is_no_part_of_the_rows(tmp_path,
                                                              monkeypatch):
    source = write(tmp_path / "rows.jsonl", ROWS)
    cluster.write_parquet(source, tmp_path / "a")
    monkeypatch.setattr(_parquet, "ROWS_OF_GROUP", 1)
    cluster.write_parquet(source, tmp_path / "b")
    assert read(tmp_path / "a") == read(tmp_path / "b")
