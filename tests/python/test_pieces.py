# SPDX-License-Identifier: GPL-3.0-or-later
# Contact spaces by pieces.  Truth: the whole build; the command line.
import itertools
import os
import subprocess

import phongpd
import pytest
from conftest import make_box, make_torus
from phongpd import ContactSpace, ContactSpacePiece


@pytest.fixture(scope="module")
def pair():
    torus = make_torus(1, 0.4, 40, 24, "robot")
    turned = phongpd.Solid(torus.vertices[:, [2, 0, 1]] * 1.7, torus.triangles,
                           "obstacle")
    return torus, turned


@pytest.fixture(scope="module")
def whole(pair):
    return ContactSpace.build(*pair)


def pieces_of(pair, count, **options):
    return [ContactSpacePiece.build(*pair, i, count, **options)
            for i in range(count)]


def are_same(one, other):
    return (one.vertices.tobytes() == other.vertices.tobytes()
            and one.triangles.tobytes() == other.triangles.tobytes())


def without_time(report):
    """Nor what is of the way there: a piece counts what its boxes share."""
    return {key: report[key] for key in (
        "triangles", "vertices", "closed", "manifold", "components", "genus",
        "cavities", "volume", "method", "grid_step", "approximation",
        "warnings")}


@pytest.mark.parametrize("count", [1, 2, 5])
def test_joined_they_are_the_whole_to_the_bit(pair, whole, count, tmp_path):
    pieces = pieces_of(pair, count)
    assert [(piece.index, piece.count) for piece in pieces] == [
        (i, count) for i in range(count)]
    assert sum(piece.boxes for piece in pieces) > 3
    assert f"0/{count}" in repr(pieces[0])
    joined = ContactSpace.join(pieces[::-1])
    assert are_same(joined, whole)
    assert without_time(joined.report) == without_time(whole.report)
    for space, name in ((joined, "joined.off"), (whole, "whole.off")):
        space.write(tmp_path / name)
    assert ((tmp_path / "joined.off").read_bytes()
            == (tmp_path / "whole.off").read_bytes())


def test_halves_stand_for_their_whole(pair, whole):
    halves = [ContactSpacePiece.build(*pair, i, 4) for i in (2, 3)]
    assert are_same(ContactSpace.join(
        [*halves, ContactSpacePiece.build(*pair, 0, 2)]), whole)


def test_options_are_those_of_a_build(pair):
    for options in ({"robot_hull": True}, {"outer_shell_only": True},
                    {"target_faces": 60}):
        assert are_same(ContactSpace.join(pieces_of(pair, 2, **options)),
                        ContactSpace.build(*pair, **options))


def test_files_are_read_by_the_program_and_written_by_it(pair, whole, program,
                                                         tmp_path):
    for solid in pair:
        solid.write(tmp_path / f"{solid.name}.off")
    files = [tmp_path / f"{i}.piece" for i in range(2)]
    read = [phongpd.Solid.read(tmp_path / f"{solid.name}.off")
            for solid in pair]
    ContactSpacePiece.build(*read, 0, 2).write(files[0])
    subprocess.run([program, "contact-space", "--robot", "robot.off",
                    "--obstacle", "obstacle.off", "--piece", "1/2", "--output",
                    files[1]], check=True, cwd=tmp_path, capture_output=True)
    subprocess.run([program, "join", *files, "--output", "joined.pcs"],
                   check=True, cwd=tmp_path, capture_output=True)
    assert are_same(ContactSpace.join(files), whole)
    assert are_same(ContactSpace.read(tmp_path / "joined.pcs"), whole)


def test_contact_space_files_keep_every_bit(whole, tmp_path):
    whole.write(tmp_path / "whole.pcs")
    again = ContactSpace.read(tmp_path / "whole.pcs")
    assert are_same(again, whole)
    assert again.report == {**whole.report, "from_cache":
                            again.report["from_cache"]}
    again.write(tmp_path / "again.pcs")
    assert ((tmp_path / "again.pcs").read_bytes()
            == (tmp_path / "whole.pcs").read_bytes())
    with pytest.raises(phongpd.InputError, match="none.pcs"):
        ContactSpace.read(tmp_path / "none.pcs")


def refused(call, *words):
    with pytest.raises(phongpd.InputError) as error:
        call()
    assert "\n" not in str(error.value)
    for word in words:
        assert word in str(error.value)


def test_lost_repeated_foreign_and_cut_ones_are_named(pair, tmp_path):
    good = pieces_of(pair, 3)
    refused(lambda: ContactSpace.join([]), "expected pieces, found none")
    refused(lambda: ContactSpace.join(good[:2]), "without 2/3")
    refused(lambda: ContactSpace.join(good[:1]), "without 1/3, 2/3")
    refused(lambda: ContactSpace.join(good + good[1:2]), "piece 1/3", "once")
    files = [tmp_path / f"{i}.piece" for i in range(3)]
    for piece, file in zip(good, files):
        piece.write(file)
    whole = files[1].read_bytes()
    ContactSpacePiece.build(*pair[::-1], 1, 3).write(files[1])
    refused(lambda: ContactSpace.join(files), "1.piece", "of the build that")
    for content in (whole[:-1], whole[:20], whole + b"x", b"",
                    whole[:900] + b"?" + whole[901:]):
        files[1].write_bytes(content)
        refused(lambda: ContactSpace.join(files), "1.piece: ")
    files[1].unlink()
    refused(lambda: ContactSpace.join(files), "1.piece: ")
    files[1].mkdir()
    refused(lambda: ContactSpace.join(files), "1.piece: ")


def test_wrong_arguments_are_said_in_one_line(pair, tmp_path):
    for index, count in itertools.product((-1, 2, 0.5, "0", True), (2,)):
        refused(lambda: ContactSpacePiece.build(*pair, index, count), "index")
    for count in (0, -1, 1.5, None):
        refused(lambda: ContactSpacePiece.build(*pair, 0, count), "count")
    refused(lambda: ContactSpacePiece.build(1, pair[1], 0, 2), "robot")
    refused(lambda: ContactSpace.join(5), "pieces: expected a list")
    refused(lambda: ContactSpace.join([5]), "pieces: expected a Contact")
    one = ContactSpacePiece.build(make_box((0, 0, 0), (1, 1, 1)), pair[1], 0, 1)
    refused(lambda: one.write(tmp_path / "none" / "p"), "none/p: expected a file")
    assert os.listdir(tmp_path) == []


def test_a_piece_that_takes_too_long_is_refused(pair):
    with pytest.raises(phongpd.BuildRefusal, match="max_seconds"):
        ContactSpacePiece.build(*pair, 0, 2, max_seconds=1e-9)
