# SPDX-License-Identifier: GPL-3.0-or-later
# Truth: the same answers of the package itself, one by one; a closed form; the
# limits as given.
import json
import os
import subprocess
import sys

import dask
import numpy as np
import phongpd
import pytest
from conftest import make_box
from distributed import Client, LocalCluster
from phongpd import cluster
from phongpd.cluster import _work


@pytest.fixture(scope="module")
def client():
    with LocalCluster(n_workers=2, threads_per_worker=1, processes=False,
                      dashboard_address=None) as local, Client(local) as one:
        yield one


@pytest.fixture
def output(tmp_path):
    return tmp_path / "rows.jsonl"


def test_depth_of_many_poses_is_that_of_each(client, robot, obstacle, output):
    random = np.random.default_rng(1)
    places = random.uniform(-1, 1.5, (40, 3))
    turns = random.normal(size=(40, 4))
    turns /= np.linalg.norm(turns, axis=1)[:, None]
    done = cluster.depth(robot, obstacle, places, turns, output=output,
                         client=client, batch=7)
    query = phongpd.DepthQuery(robot, obstacle)
    rows = list(done.read())
    assert [row["pose"] for row in rows] == list(range(40))
    for row, place, turn in zip(rows, places, turns):
        truth = query.at(place, turn)
        assert row["position"] == place.tolist()
        assert (row["status"], row["depth"], row["clearance"]) \
            == (truth.status, truth.depth, truth.clearance)
        assert row["direction"] == truth.direction.tolist()


def test_equal_poses_are_rows_of_their_own(client, robot, obstacle, output):
    done = cluster.depth(robot, obstacle, np.zeros((3, 3)), output=output,
                         client=client)
    assert [row["depth"] for row in done.read()] == [pytest.approx(0.2)] * 3


def test_plans_are_those_of_the_world(client, output):
    scenes = ["tunnel:delta=0.1", "tunnel:delta=0.1,twin=1"]
    done = cluster.planning(scenes, seeds=[1, 2], output=output, client=client)
    found = [(row["status"], row["verified"]) for row in done.read()]
    truth = []
    for scene in scenes:
        plan = phongpd.World.load(scene).plan()
        truth += [(plan.status, plan.row["verified"])] * 2
    assert found == truth
    assert {status for status, _ in truth} == {"solved", "infeasible_proved"}


def test_contact_spaces_are_rows_and_files(client, robot, obstacle, output,
                                           tmp_path):
    pairs = {"one": (robot, obstacle), "two": (obstacle, robot),
             "far.off": (robot, make_box((5, 5, 5), (6, 6, 6)))}
    done = cluster.contact_spaces(pairs, output=output, folder=tmp_path,
                                  client=client)
    for row in done.read():
        file = phongpd.Solid.read(tmp_path / f"{row['pair']}.off")
        truth = phongpd.ContactSpace.build(*pairs[row["pair"]])
        assert row["outcome"] == "done"
        assert row["volume"] == pytest.approx(truth.report["volume"])
        assert file.volume == pytest.approx(truth.report["volume"])
    assert sorted(os.listdir(tmp_path)) == [
        "far.off.off", "one.off", "rows.jsonl", "two.off"]
    os.unlink(tmp_path / "two.off")
    with pytest.raises(cluster.SweepError, match="two.off: expected the contact"):
        cluster.contact_spaces(pairs, output=output, folder=tmp_path,
                               client=client)


def test_a_refused_build_is_a_row_that_says_so(client, output):
    def rows(**more):
        done = cluster.convergence(["knot"], seeds=[1, 2], output=output,
                                   metrics=["euclidean"], client=client, **more)
        return list(done.read())

    refused = rows(max_mib=1)
    assert [row["outcome"] for row in refused] == ["refused"] * 2
    assert all("max-mib" in row["reason"] or "MiB" in row["reason"]
               for row in refused)
    assert [(row["scene"], row["seed"]) for row in refused] \
        == [("knot", 1), ("knot", 2)]
    # Another limit is another sweep.
    with pytest.raises(phongpd.InputError, match="expected a row of this sweep"):
        rows(max_mib=2)


def test_the_limit_of_a_build_is_the_workers_share(client):
    def limit(given):
        return client.submit(_work._max_mib, {"max_mib": given}).result()

    total = client.cluster.workers[0].memory_manager.memory_limit / 2 ** 20
    assert limit(None) == pytest.approx(0.7 * total)
    assert limit(5) == 5
    assert _work._max_mib({"max_mib": None}) == 0  # not on a worker: no limit


def test_a_solid_that_cannot_be_used_is_a_row(client, robot, output):
    bow = make_box((0, 0, 0), (1, 1, 1))
    done = cluster.depth(robot, bow, [[0, 0, 0]], [[2, 0, 0, 0]], output=output,
                         client=client)
    row, = done.read()
    assert row["outcome"] == "invalid" and "\n" not in row["reason"]


def test_rows_of_a_worker_that_dies_each_time_are_named(robot, obstacle, output,
                                                        tmp_path):
    # A worker that ends itself at pose 3, whoever it is.
    (tmp_path / "poison.py").write_text("""
import os
from phongpd.cluster import _work
def poisoned(job, subject, depth=_work.WORK["depth"]):
    if job.arguments["pose"] == 3:
        os.kill(os.getpid(), 9)
    return depth(job, subject)
_work.WORK["depth"] = poisoned
""")
    with dask.config.set({"distributed.scheduler.allowed-failures": 1}), \
            LocalCluster(n_workers=2, threads_per_worker=1, processes=True,
                         dashboard_address=None, host="127.0.0.1",
                         preload=str(tmp_path / "poison.py")) as local, \
            Client(local) as client:
        with pytest.raises(cluster.SweepError) as error:
            cluster.depth(robot, obstacle, np.zeros((8, 3)), output=output,
                          client=client, batch=1)
        # Dask cannot close a cluster one of whose workers is just starting.
        client.wait_for_workers(2, timeout=60)
    text = str(error.value)
    assert text.startswith("1 rows could not be made")
    assert "'pose': 3" in text and "\n" not in text
    partial = output.with_name("rows.jsonl.partial")
    poses = [json.loads(line)["pose"] for line in partial.open()]
    assert sorted(poses) == [0, 1, 2, 4, 5, 6, 7]


def test_a_scene_that_workers_see_otherwise_is_no_row(client, output):
    subject = {"scene": "u_axis", "digest": "0" * 32, "max_mib": None,
               "cache": False}
    job = cluster._run.Job.of("planning", "s", {
        "seed": 1, "planner": "contact-surface", "retraction": "phong",
        "clearance": "", "max_seconds": 1.0})
    with pytest.raises(cluster.SweepError, match="same contents on all workers"):
        cluster._run.run([job], {"s": subject}, output, client, 1)
    assert not output.exists()


def test_without_a_client_it_runs_on_this_machine(tmp_path):
    (tmp_path / "program.py").write_text("""
import sys
from phongpd import cluster
if __name__ == "__main__":
    print(cluster.convergence(["u_axis"], seeds=[1, 2], output=sys.argv[1]).rows)
""")
    out = subprocess.run(
        [sys.executable, tmp_path / "program.py", tmp_path / "rows.jsonl"],
        capture_output=True, text=True, timeout=120)
    assert out.stdout == "2\n"


@pytest.mark.parametrize("call, found", [
    (lambda o, c: cluster.convergence("u_axis", seeds=[1], output=o), "scenes"),
    (lambda o, c: cluster.convergence([], seeds=[1], output=o), "scenes"),
    (lambda o, c: cluster.convergence(["none"], seeds=[1], output=o), "none"),
    (lambda o, c: cluster.convergence(["u_axis"] * 2, seeds=[1], output=o),
     "different ones"),
    (lambda o, c: cluster.convergence(["u_axis"], seeds=5, output=o), "seeds"),
    (lambda o, c: cluster.convergence(["u_axis"], seeds=[0], output=o), "seeds"),
    (lambda o, c: cluster.convergence(["u_axis"], seeds=[1, 1], output=o),
     "every row once"),
    (lambda o, c: cluster.convergence(["u_axis"], seeds=[1], output=o,
                                      metrics=["other"]), "metric"),
    (lambda o, c: cluster.convergence(["u_axis"], seeds=[1], output=o,
                                      protocols=["other"]), "protocol"),
    (lambda o, c: cluster.convergence(["u_axis"], seeds=[1], output=o,
                                      max_mib=-1), "max_mib"),
    (lambda o, c: cluster.convergence(["u_axis"], seeds=[1], output=o, batch=0),
     "batch"),
    (lambda o, c: cluster.convergence(["u_axis"], seeds=[1], output=o,
                                      client="tcp://here"), "client"),
    (lambda o, c: cluster.convergence(["u_axis"], seeds=[1], client=c,
                                      output=o / "none" / "r"), "none/r.partial"),
    (lambda o, c: cluster.planning(["u_axis"], seeds=[1], output=o,
                                   planners=["other"]), "planners"),
    (lambda o, c: cluster.planning(["u_axis"], seeds=[1], output=o,
                                   retraction="other"), "retraction"),
    (lambda o, c: cluster.planning(["u_axis"], seeds=[1], output=o,
                                   clearance="wide"), "clearance"),
    (lambda o, c: cluster.planning(["u_axis"], seeds=[1], output=o, clearance=.1,
                                   planners=["rrt-connect"]), "clearance"),
    (lambda o, c: cluster.planning(["u_axis"], seeds=[1], output=o,
                                   max_seconds=None), "max_seconds"),
    (lambda o, c: cluster.depth("none.off", "none.off", [[0, 0, 0]], output=o),
     "none.off"),
    (lambda o, c: cluster.depth(BOX, BOX, [[np.nan, 0, 0]], output=o), "finite"),
    (lambda o, c: cluster.depth(BOX, BOX, np.zeros((3, 3)), np.ones((2, 4)),
                                output=o), "expected one or 3"),
    (lambda o, c: cluster.contact_spaces({"a": BOX}, output=o), "pairs: a"),
    (lambda o, c: cluster.contact_spaces({"a/b": (BOX, BOX)}, output=o,
                                         folder=o), "can be files"),
    (lambda o, c: cluster.contact_spaces({"a": (BOX, BOX)}, output=o,
                                         folder=o / "none"), "folder"),
])
def test_wrong_arguments_are_said_in_one_line(client, tmp_path, call, found):
    is_folder = found in ("none/r.partial", "can be files")
    where = tmp_path if is_folder else tmp_path / "r"
    with pytest.raises(phongpd.InputError, match=found) as error:
        call(where, client)
    assert "\n" not in str(error.value)
    assert os.listdir(tmp_path) == []


BOX = make_box((0, 0, 0), (1, 1, 1))
