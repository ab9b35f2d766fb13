# SPDX-License-Identifier: GPL-3.0-or-later
# One contact space by tasks, on workers that are processes of their own, some
# of them killed.  Truth: the whole build in this process.
import os
import shutil
import threading

import phongpd
import pytest
from cluster_processes import Processes, wait_for
from conftest import make_box, make_torus
from distributed import Client, LocalCluster
from phongpd import ContactSpace, ContactSpacePiece, cluster
from phongpd.cluster import _work
from phongpd.cluster._jobs import Batch, Job
from phongpd.cluster._piece_files import MOST_HALVINGS, PieceFile


def turned(solid, scale):
    return phongpd.Solid(solid.vertices[:, [2, 0, 1]] * scale, solid.triangles,
                         "obstacle")


@pytest.fixture(scope="module")
def pair():
    torus = make_torus(1, 0.4, 40, 24, "robot")
    return torus, turned(torus, 1.7)


@pytest.fixture(scope="module")
def whole(pair, tmp_path_factory):
    """The bytes of the mesh file."""
    file = tmp_path_factory.mktemp("whole") / "whole.off"
    ContactSpace.build(*pair).write(file)
    return file.read_bytes()


@pytest.fixture
def here():
    """Workers that are threads of this process."""
    with LocalCluster(n_workers=2, threads_per_worker=1, processes=False,
                      dashboard_address=None) as local, Client(local) as one:
        yield one


@pytest.fixture
def folder(tmp_path):
    path = tmp_path / "pieces"
    path.mkdir()
    return path


def names(folder):
    return sorted(os.listdir(folder))


def times(folder):
    return {file.name: file.stat().st_mtime_ns for file in folder.iterdir()}


@pytest.mark.parametrize("pieces", [1, 5])
def test_it_is_one_build_to_the_byte_and_tasks_have_names(
        client, pair, whole, folder, tmp_path, pieces):
    output = tmp_path / "space.off"
    done = cluster.contact_space(*pair, pieces=pieces, folder=folder,
                                 output=output, client=client)
    assert output.read_bytes() == whole
    assert (done.kept, len(done.files)) == (0, pieces)
    assert names(folder) == sorted(file.name for file in done.files)
    truth = ContactSpace.build(*pair)
    assert done.report["volume"] == truth.report["volume"]
    assert done.report["length"] == done.read().length == truth.length
    prefixes = client.run_on_scheduler(
        lambda dask_scheduler: list(dask_scheduler.task_prefixes))
    assert {"phongpd-piece", "phongpd-join"} <= set(prefixes)


def test_one_worker_of_threads_gives_the_same_also_as_pcs(
        here, pair, whole, folder, tmp_path):
    done = cluster.contact_space(*pair, pieces=3, folder=folder, client=here,
                                 output=tmp_path / "space.pcs")
    done.read().write(tmp_path / "space.off")
    assert (tmp_path / "space.off").read_bytes() == whole


def test_what_is_there_is_not_built_again(client, pair, whole, folder, tmp_path):
    def build(output, **more):
        return cluster.contact_space(*pair, folder=folder, client=client,
                                     output=tmp_path / output, **more)

    build("a.off", pieces=4)
    before = times(folder)
    assert build("b.off", pieces=4).kept == 4
    assert times(folder) == before
    lost = sorted(before)[2]
    os.unlink(folder / lost)
    assert build("c.off", pieces=4, max_mib=5000).kept == 3
    assert {name for name in before if times(folder)[name] != before[name]} == {
        lost}
    # Halves are as good as the piece; other options are another build.
    assert build("d.off", pieces=2).kept == 2
    assert build("e.off", pieces=4, outer_shell_only=True).kept == 0
    assert len(names(folder)) == 8
    for name in "abcd":
        assert (tmp_path / f"{name}.off").read_bytes() == whole


def test_a_call_that_is_stopped_goes_on(client, pair, whole, folder, tmp_path,
                                        monkeypatch):
    def stop(*_):
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(cluster._pieces, "_all_of", stop)
        with pytest.raises(KeyboardInterrupt):
            cluster.contact_space(*pair, pieces=3, folder=folder, client=client,
                                  output=tmp_path / "space.off")
    assert names(tmp_path) == ["pieces"]
    done = cluster.contact_space(*pair, pieces=3, folder=folder, client=client,
                                 output=tmp_path / "space.off")
    assert done.kept == 3
    assert (tmp_path / "space.off").read_bytes() == whole


def test_a_killed_worker_costs_nothing(client, processes, folder, tmp_path):
    torus = make_torus(1, 0.4, 60, 36, "robot")
    solids = torus, turned(torus, 1.7)
    ContactSpace.build(*solids).write(tmp_path / "whole.off")
    others = set(client.nthreads())
    victim = processes.start_worker()
    client.wait_for_workers(3, timeout=60)
    name, = set(client.nthreads()) - others
    result = []
    thread = threading.Thread(target=lambda: result.append(
        cluster.contact_space(*solids, pieces=12, folder=folder, client=client,
                              output=tmp_path / "space.off")))
    thread.start()
    wait_for("a piece", lambda: names(folder))
    wait_for("a task of the victim", lambda: client.processing()[name])
    assert len(names(folder)) < 12
    processes.kill(victim)
    thread.join()
    assert len(result[0].files) == 12
    assert ((tmp_path / "space.off").read_bytes()
            == (tmp_path / "whole.off").read_bytes())


def test_a_task_done_twice_at_once_is_done_once(client, pair, whole, folder,
                                                tmp_path):
    def build(output):
        with Client(client.scheduler.address, set_as_default=False) as own:
            cluster.contact_space(*pair, pieces=3, folder=folder, client=own,
                                  output=tmp_path / output)

    thread = threading.Thread(target=build, args=("a.off",))
    thread.start()
    build("b.off")
    thread.join()
    # And under another name, which Dask takes for another task.
    subject = piece_subject(pair, folder)
    batch = Batch((Job.of("piece", "s", {"index": 0, "count": 2}),))
    rows = client.gather([
        client.submit(_work.run_batch, batch, subject, pure=False)
        for _ in range(6)])
    assert all('"outcome": "done"' in line for (_, line), in rows)
    assert [name for name in names(folder) if name.startswith("b-")] == [
        "b-0-of-2.piece"]
    for name in "ab":
        assert (tmp_path / f"{name}.off").read_bytes() == whole


def piece_subject(pair, folder):
    arrays = cluster._solids.pair_of(*pair)[2]
    return {**arrays, "folder": str(folder), "name": "b", "options": {},
            "max_mib": None}


def test_foreign_and_cut_pieces_are_named_and_nothing_is_written(
        client, pair, whole, folder, tmp_path):
    def build():
        return cluster.contact_space(*pair, pieces=3, folder=folder,
                                     client=client, output=tmp_path / "s.off")

    file = build().files[1]
    os.unlink(tmp_path / "s.off")
    content = file.read_bytes()
    other = tmp_path / "other.piece"
    ContactSpacePiece.build(*pair[::-1], 1, 3).write(other)
    for bad in (other.read_bytes(), content[:-5], b"", b"OFF\n"):
        file.write_bytes(bad)
        with pytest.raises(phongpd.InputError) as error:
            build()
        text = str(error.value)
        assert text.startswith(str(file)) and "\n" not in text
        assert "or remove it, and the same call builds it again" in text
        assert names(tmp_path) == ["other.piece", "pieces"]
    # One piece under the name of another.
    shutil.copy(folder / file.name.replace("-1-of", "-2-of"), file)
    with pytest.raises(phongpd.InputError, match="expected every piece once"):
        build()
    os.unlink(file)
    assert build().kept == 2
    assert (tmp_path / "s.off").read_bytes() == whole


def test_a_piece_that_is_lost_meanwhile_is_named(pair, folder, tmp_path):
    job = Job.of("join", "s", {"pieces": 1})
    (_, line), = _work.run_batch(Batch((job,)), {
        "folder": str(folder), "files": ["b-0-of-1.piece"],
        "output": str(tmp_path / "s.off")})
    assert '"outcome": "invalid"' in line and "b-0-of-1.piece" in line
    assert names(tmp_path) == ["pieces"]


def refuse_above(count, monkeypatch):
    """Pieces of fewer than `count` do not fit; a list of those that were tried."""
    build, tried = ContactSpacePiece.build, []

    def limited(robot, obstacle, index, parts, **options):
        tried.append((index, parts))
        if parts < count:
            raise phongpd.BuildRefusal("robot and obstacle: too large")
        return build(robot, obstacle, index, parts)

    monkeypatch.setattr(ContactSpacePiece, "build", limited)
    return tried


def test_a_piece_that_does_not_fit_is_built_in_halves(
        here, pair, whole, folder, tmp_path, monkeypatch):
    tried = refuse_above(8, monkeypatch)
    done = cluster.contact_space(*pair, pieces=2, folder=folder, client=here,
                                 output=tmp_path / "space.off")
    assert [file.name.split("-", 1)[1] for file in done.files] == [
        f"{i}-of-8.piece" for i in range(8)]
    assert (tmp_path / "space.off").read_bytes() == whole
    # Gone on with as they were begun: what was refused is not tried again.
    os.unlink(done.files[3])
    tried.clear()
    again = cluster.contact_space(*pair, pieces=2, folder=folder, client=here,
                                  output=tmp_path / "space.off")
    assert (again.kept, tried) == (1, [(3, 8)])
    assert (tmp_path / "space.off").read_bytes() == whole


def test_what_no_halving_helps_is_refused(here, pair, folder, tmp_path,
                                          monkeypatch):
    tried = refuse_above(1000, monkeypatch)
    with pytest.raises(phongpd.BuildRefusal, match="too large; the pieces that"):
        cluster.contact_space(*pair, pieces=1, folder=folder, client=here,
                              output=tmp_path / "space.off")
    assert tried == [(0, 1 << k) for k in range(MOST_HALVINGS + 1)]
    assert names(tmp_path) == ["pieces"] and names(folder) == []


def test_a_real_limit_of_memory_is_kept(pair, folder, tmp_path):
    # A fresh worker: what was freed before is used again, and is no growth.
    with Processes(tmp_path) as fresh:
        fresh.start_scheduler()
        fresh.start_worker()
        with Client(fresh.address, set_as_default=False) as one:
            with pytest.raises(phongpd.BuildRefusal, match="max_mib"):
                cluster.contact_space(*pair, pieces=1, folder=folder, client=one,
                                      max_mib=1e-3, output=tmp_path / "s.off")
    assert names(folder) == []


def test_a_piece_is_there_whole_or_as_all_of_its_halves(tmp_path):
    part = PieceFile(tmp_path, "x", 1, 3)
    assert part.files() is None and not part.is_begun_in_halves()
    for name in ("x-4-of-12", "x-3-of-6"):
        (tmp_path / f"{name}.piece").touch()
    assert part.files() is None and part.is_begun_in_halves()
    (tmp_path / "x-5-of-12.piece").touch()
    assert [file.name for file in part.files()] == [
        "x-4-of-12.piece", "x-5-of-12.piece", "x-3-of-6.piece"]
    (tmp_path / "x-1-of-3.piece").touch()
    assert part.files() == [part.path]


BOX = make_box((0, 0, 0), (1, 1, 1))


@pytest.mark.parametrize("found, change", [
    ("pieces", {"pieces": 0}), ("pieces", {"pieces": 1.5}),
    ("folder", {"folder": "none"}), ("folder", {"output": "none/space.off"}),
    ("expected a name that ends", {"output": "space.txt"}),
    ("target_faces", {"target_faces": -1}), ("max_mib", {"max_mib": -1}),
    ("client", {"client": "tcp://here"}), ("robot", {"robot": 5}),
])
def test_wrong_arguments_are_said_in_one_line(folder, monkeypatch, found, change):
    monkeypatch.chdir(folder.parent)
    arguments = {"robot": BOX, "obstacle": BOX, "pieces": 2, "folder": folder,
                 "output": "space.off", **change}
    with pytest.raises(phongpd.InputError, match=found) as error:
        cluster.contact_space(**arguments)
    assert "\n" not in str(error.value)
    assert names(folder.parent) == ["pieces"] and names(folder) == []
