# SPDX-License-Identifier: GPL-3.0-or-later
# Truth: JSON written by hand, files as they lie, another process.
import json
import os
import subprocess
import sys

import phongpd
import pytest

from phongpd import cluster
from phongpd.cluster._jobs import Job, batches, indices
from phongpd.cluster._rows import RowStore

ORDER = {key: i for i, key in enumerate("abcd")}


def line(key, **more):
    return json.dumps({"key": key, **more})


@pytest.fixture
def output(tmp_path):
    return tmp_path / "rows.jsonl"


def partial(output):
    return output.with_name("rows.jsonl.partial")


def test_rows_come_in_any_order_and_end_in_that_of_the_sweep(output):
    with RowStore(output, ORDER) as store:
        for key in "cadb":
            assert store.add(key, line(key))
            assert partial(output).read_text().endswith(line(key) + "\n")
        assert not output.exists()
        store.finish()
    assert output.read_text() == "".join(line(key) + "\n" for key in "abcd")
    assert os.listdir(output.parent) == ["rows.jsonl"]


def test_a_row_that_comes_twice_is_there_once(output):
    with RowStore(output, ORDER) as store:
        assert store.add("a", line("a", n=1))
        assert not store.add("a", line("a", n=2))
        store.finish()
    assert output.read_text() == line("a", n=1) + "\n"


@pytest.mark.parametrize("torn", ["", '{"key', line("b")])
def test_a_torn_last_row_is_done_again(output, torn):
    partial(output).write_text(line("a") + "\n" + torn)
    with RowStore(output, ORDER) as store:
        assert "a" in store and "b" not in store
        store.add("b", line("b", again=1))
        store.finish()
    assert output.read_text() == line("a") + "\n" + line("b", again=1) + "\n"


def test_a_finished_output_is_taken_up_and_grows(output):
    output.write_text(line("d") + "\n" + line("b") + "\n")
    with RowStore(output, ORDER) as store:
        store.add("c", line("c"))
        store.add("a", line("a"))
        store.finish()
    assert output.read_text() == "".join(line(key) + "\n" for key in "abcd")


@pytest.mark.parametrize("content, found", [
    ("no json\n", "line 1: expected a row with a key"),
    (line("a") + "\n[1]\n", "line 2: expected a row with a key"),
    (line("z") + "\n", "line 1: expected a row of this sweep"),
])
@pytest.mark.parametrize("is_partial", [False, True])
def test_files_of_others_are_refused_and_stay(output, content, found, is_partial):
    file = partial(output) if is_partial else output
    file.write_text(content)
    with pytest.raises(phongpd.InputError, match=found) as error:
        RowStore(output, ORDER)
    assert "\n" not in str(error.value)
    assert file.read_text() == content


def test_two_processes_on_one_output_are_refused(output):
    code = ("import sys; from pathlib import Path\n"
            "from phongpd.cluster._rows import RowStore\n"
            "RowStore(Path(sys.argv[1]), {})")
    with RowStore(output, ORDER):
        other = subprocess.run([sys.executable, "-c", code, str(output)],
                               capture_output=True, text=True)
    assert "expected to be alone, found another process" in other.stderr
    assert RowStore(output, ORDER).close() is None
    assert os.listdir(output.parent) == []


def test_links_and_folders_are_not_followed(output, tmp_path):
    (tmp_path / "other").write_text("precious")
    partial(output).symlink_to(tmp_path / "other")
    with pytest.raises(phongpd.InputError, match="expected a file to write"):
        RowStore(output, ORDER)
    assert (tmp_path / "other").read_text() == "precious"
    with pytest.raises(phongpd.InputError, match="expected a file to write"):
        RowStore(tmp_path / "none" / "rows.jsonl", ORDER)


def test_keys_change_with_everything_a_row_depends_on():
    jobs = [Job.of("a", "s", {"seed": 1}), Job.of("a", "s", {"seed": 2}),
            Job.of("b", "s", {"seed": 1}), Job.of("a", "t", {"seed": 1})]
    assert len(indices(jobs)) == 4
    assert Job.of("a", "s", {"seed": 1}).key == jobs[0].key
    with pytest.raises(phongpd.InputError, match="found rows 1 and 5 the same"):
        indices(jobs + jobs[:1])


def test_batches_are_of_one_subject():
    jobs = [Job.of("a", subject, {"seed": i})
            for i, subject in enumerate("ssssstt")]
    sizes = [len(batch.jobs) for batch in batches(jobs, 3)]
    assert sizes == [3, 2, 2]
    assert len({batch.name for batch in batches(jobs, 3)}) == 3


def test_timing_is_left_out_at_any_depth():
    row = {"seconds": {"total": 1}, "a": [{"peak_mib": 3, "b": 1}], "c": 2.5}
    assert cluster.without_timing(row) == {"a": [{"b": 1}], "c": 2.5}
