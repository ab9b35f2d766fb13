# SPDX-License-Identifier: GPL-3.0-or-later
# A scheduler and workers in processes of their own, killed and cut off in
# mid-run.  Truth: the rows of the same jobs, one after the other in this
# process, and of the command line.
import json
import subprocess
import sys
import threading
import time

import phongpd
import pytest
from cluster_processes import Processes, Wire, rows_in, wait_for
from distributed import Client, LocalCluster
from phongpd import cluster
from phongpd.cluster import _run, _sweeps, _work
from phongpd.cluster._jobs import Batch
from phongpd.cluster._work import run_batch

SEEDS = range(1, 9)
METRICS = ["euclidean", "phong@0.2"]


def sweep(client, output, seeds=SEEDS, **more):
    return cluster.convergence(["u_axis"], seeds=seeds, metrics=METRICS,
                               output=output, client=client, **more)


def timeless(path):
    return [json.dumps(cluster.without_timing(row)) for row in rows_in(path)]


@pytest.fixture(scope="module")
def jobs():
    """Those of sweep(), and what they share."""
    taken = {}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(_sweeps, "run", lambda jobs, subjects, *_: taken.update(
            jobs=jobs, subjects=subjects))
        sweep(None, None)
    return taken["jobs"], taken["subjects"]


@pytest.fixture(scope="module")
def truth(jobs):
    rows = [run_batch(Batch((job,)), jobs[1][job.subject])[0][1]
            for job in jobs[0]]
    return [json.dumps(cluster.without_timing(json.loads(row))) for row in rows]


def test_rows_are_those_of_one_process_and_tasks_have_names(
        client, truth, tmp_path):
    done = sweep(client, tmp_path / "rows.jsonl")
    assert (done.rows, done.kept, done.repeated) == (16, 0, 0)
    assert timeless(done.output) == truth
    assert [row["seed"] for row in done.read()] == sorted(list(SEEDS) * 2)
    prefixes = client.run_on_scheduler(
        lambda dask_scheduler: list(dask_scheduler.task_prefixes))
    assert "phongpd-convergence" in prefixes


def test_batches_and_one_worker_of_threads_give_the_same(truth, tmp_path):
    with LocalCluster(n_workers=1, threads_per_worker=3, processes=False,
                      dashboard_address=None) as local, Client(local) as client:
        done = sweep(client, tmp_path / "rows.jsonl", batch=5)
    assert timeless(done.output) == truth


def test_tasks_use_the_threads_of_their_worker(monkeypatch, tmp_path):
    asked = []

    class Limit:
        def __init__(self, threads):
            asked.append(threads)

        def release(self):
            asked.append("released")

    monkeypatch.setattr(_work._native, "ThreadLimit", Limit)
    with LocalCluster(n_workers=1, threads_per_worker=3, processes=False,
                      dashboard_address=None) as local, Client(local) as client:
        cluster.convergence(["u_axis"], seeds=[1], metrics=["euclidean"],
                            output=tmp_path / "rows.jsonl", client=client)
    assert asked == [3, "released"]
    # Elsewhere nothing is limited.
    run_batch(Batch(()), {})
    assert len(asked) == 2


def test_a_limit_holds_until_it_is_released():
    code = """
import os
import phongpd
from phongpd import _native
def threads():
    return len(os.listdir("/proc/self/task"))
def build():
    world = phongpd.World.load("ball_wrench")
    phongpd.ContactSpace.build(world.robot, world.obstacles[0], cache=False)
    return threads()
limit = _native.ThreadLimit(1)
before = threads()
assert build() == before
limit.release()
assert os.cpu_count() == 1 or build() > before
"""
    subprocess.run([sys.executable, "-c", code], check=True)


def test_rows_are_those_of_the_command_line(truth, program, tmp_path):
    subprocess.run(
        [program, "compare", "u_axis", "--metrics",
         *METRICS, "--protocols", "straight-adaptive", "--runs",
         str(len(SEEDS)), "--shard", "0/2", "--output", tmp_path],
        check=True, capture_output=True)
    ours = {(row["seed"], row["method"]): row for row in map(json.loads, truth)}
    theirs = rows_in(tmp_path / "rows.jsonl")
    assert len(theirs) == 8
    for row in theirs:
        assert row.pop("part")[:2] == [0, 2]  # of the shards
        mine = ours[row["seed"], row["method"]]
        assert {k: v for k, v in mine.items() if k not in ("key", "outcome")} \
            == cluster.without_timing(row)


def test_a_sweep_that_is_stopped_goes_on(client, truth, tmp_path):
    output = tmp_path / "rows.jsonl"
    program = f"""
from distributed import Client
from phongpd import cluster
with Client({client.scheduler.address!r}) as client:
    cluster.convergence(["u_axis"], seeds=range(1, 9), metrics={METRICS!r},
                        output={str(output)!r}, client=client)
"""
    process = subprocess.Popen([sys.executable, "-c", program])
    partial = tmp_path / "rows.jsonl.partial"
    wait_for("five rows", lambda: len(rows_in(partial)) >= 5)
    with pytest.raises(phongpd.InputError, match="another process"):
        sweep(client, output)
    process.kill()
    process.wait()
    before = partial.read_bytes()
    kept = len(rows_in(partial))
    assert 5 <= kept < 16
    with open(partial, "ab") as file:
        file.write(before[:20])  # torn
    done = sweep(client, output)
    assert (done.rows, done.kept) == (16, kept)
    assert timeless(output) == truth
    old = set(before.splitlines())
    assert len(old & set(output.read_bytes().splitlines())) == kept
    # Once more is nothing, and more seeds are only those.
    bytes_then = output.read_bytes()
    assert sweep(client, output).kept == 16
    assert output.read_bytes() == bytes_then
    assert sweep(client, output, range(1, 10)).kept == 16
    assert output.read_bytes().startswith(bytes_then)


def test_tasks_that_overlap_give_each_row_once(client, jobs, truth, tmp_path):
    some = jobs[0][:8]
    order = {job.key: i for i, job in enumerate(some)}
    with _run.RowStore(tmp_path / "rows.jsonl", order) as store:
        driver = _run.Driver(jobs[1], store)
        driver.run(client, [Batch(tuple(some[:6])), Batch(tuple(some[2:])),
                            Batch(tuple(some[:6])[::-1])])
        store.finish()
    assert driver.repeated == 10
    assert timeless(tmp_path / "rows.jsonl") == truth[:8]


def test_two_clients_that_ask_for_the_same_both_get_it(
        client, processes, truth, tmp_path):
    def other():
        with Client(processes.address, set_as_default=False) as second:
            sweep(second, tmp_path / "other.jsonl")

    thread = threading.Thread(target=other)
    thread.start()
    sweep(client, tmp_path / "rows.jsonl")
    thread.join()
    assert timeless(tmp_path / "rows.jsonl") == truth
    assert timeless(tmp_path / "other.jsonl") == truth


def in_background(call):
    """A thread, and what the call gave or raised."""
    result = []

    def work():
        try:
            result.append(call())
        except BaseException as error:  # noqa: B036
            result.append(error)

    thread = threading.Thread(target=work)
    thread.start()
    return thread, result


def test_a_killed_worker_costs_no_row(client, processes, truth, tmp_path):
    others = set(client.nthreads())
    victim = processes.start_worker()
    client.wait_for_workers(3, timeout=60)
    name, = set(client.nthreads()) - others
    output = tmp_path / "rows.jsonl"
    thread, result = in_background(lambda: sweep(client, output))
    wait_for("a row", lambda: rows_in(tmp_path / "rows.jsonl.partial"))
    assert client.processing()[name]
    processes.kill(victim)
    thread.join()
    assert result[0].rows == 16
    assert timeless(output) == truth


def test_a_cut_wire_to_the_scheduler_costs_no_row(processes, truth, tmp_path):
    with Wire(processes.port) as wire:
        client = Client(wire.address, set_as_default=False, timeout=60)
        output = tmp_path / "rows.jsonl"
        thread, result = in_background(lambda: sweep(client, output))
        partial = tmp_path / "rows.jsonl.partial"
        for least in (2, 8):
            wait_for("rows", lambda: len(rows_in(partial)) >= least)
            wire.cut()
            time.sleep(0.3)
            wire.restore()
        thread.join()
        assert result[0].rows == 16
        assert result[0].reconnections >= 2
        assert timeless(output) == truth
        client.close()


def test_a_scheduler_that_dies_and_comes_back_costs_no_row(truth, tmp_path):
    with Processes(tmp_path) as mortal:
        mortal.start_scheduler()
        mortal.start_worker()
        output = tmp_path / "rows.jsonl"
        client = Client(mortal.address, set_as_default=False, timeout=60)
        thread, result = in_background(lambda: sweep(client, output))
        partial = tmp_path / "rows.jsonl.partial"
        wait_for("a row", lambda: rows_in(partial))
        mortal.kill(mortal.scheduler)
        mortal.start_scheduler()
        mortal.start_worker()
        thread.join()
        assert result[0].rows == 16
        assert result[0].reconnections >= 1
        assert timeless(output) == truth
        # And one that does not come back is said, and nothing is lost.
        client.close()
        client = Client(mortal.address, set_as_default=False, timeout=2)
        thread, result = in_background(
            lambda: sweep(client, output, range(1, 60)))
        wait_for("a row", lambda: rows_in(partial))
        mortal.kill(mortal.scheduler)
        thread.join()
        assert isinstance(result[0], cluster.SweepError)
        assert "the scheduler is gone" in str(result[0])
        assert f"{len(rows_in(partial)) + 16} rows are in" in str(result[0])
        assert timeless(output) == truth
        client.close()
