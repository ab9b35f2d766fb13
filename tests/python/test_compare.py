# SPDX-License-Identifier: GPL-3.0-or-later
# Metrics beside each other.  Truth: the program's rows, pandas, shares counted by
# hand, and the styles as the sources of the other figures have them.
import json
import pathlib
import re
import subprocess
import sys

import phongpd
import pytest
from phongpd import _colours

SOURCE = pathlib.Path(__file__).resolve().parents[2]
# They differ from run to run.
TIMES = ("seconds", "stages", "part")


def row(scene, seed, method, solved, iterations, protocol="p"):
    return {"scene": scene, "seed": seed, "method": method, "solved": solved,
            "iterations": iterations, "protocol": protocol,
            "seconds": {"total": 2.0 * iterations}}


BY_HAND = phongpd.Comparison([
    row("a", 1, "euclidean", True, 10), row("a", 1, "phong@0.2", True, 20),
    row("a", 2, "euclidean", False, 5), row("a", 2, "phong@0.2", True, 30),
    row("b", 1, "euclidean", True, 40), row("b", 1, "phong@0.2", False, 50),
    row("b", 2, "euclidean", True, 90), row("b", 2, "phong@0.2", True, 30)])


def test_a_profile_counts_what_was_solved_within_a_factor():
    # Least: 10, 30, 40, 30.  Euclid: 1, never, 1, 3.  Phong: 2, 1, never, 1.
    assert BY_HAND.profile("p") == {
        "euclidean": [(1.0, 0.25), (1.0, 0.5), (3.0, 0.75)],
        "phong@0.2": [(1.0, 0.25), (1.0, 0.5), (2.0, 0.75)]}
    assert BY_HAND.profile("p", "seconds.total") == BY_HAND.profile("p")
    assert str(BY_HAND) == ("p, euclidean: 3 of 4 solved, median of 40 iterations\n"
                            "p, phong@0.2: 3 of 4 solved, median of 30 iterations")
    # Who was asked less has a share of that.
    less = phongpd.Comparison(BY_HAND.rows[:3]).profile("p")
    assert less["phong@0.2"] == [(2.0, 1.0)]
    for call in (lambda: BY_HAND.profile("q"), lambda: BY_HAND.plot("minutes"),
                 lambda: BY_HAND.profile("p", "minutes")):
        with pytest.raises(phongpd.InputError, match="expected one of"):
            call()


def test_rows_are_those_of_the_program(program, tmp_path):
    made = phongpd.compare("u_axis", seeds=[1, 2], metrics=["euclidean", "phong@0.2"],
                           protocols=["straight-adaptive"])
    written = subprocess.run(
        [program, "compare", "u_axis", "--runs", "2", "--metrics", "euclidean",
         "phong@0.2", "--protocols", "straight-adaptive", "--json", "--no-cache"],
        check=True, capture_output=True, text=True).stdout
    truth = [json.loads(line) for line in written.splitlines()]
    truth = [one for one in truth if "method" in one]
    assert len(made.rows) == len(truth) == 4
    for mine, other in zip(made.rows, truth):
        for name in set(mine) - set(TIMES):
            assert mine[name] == other[name], name
    (tmp_path / "rows.jsonl").write_text(written)
    read = phongpd.Comparison.read(tmp_path / "rows.jsonl")
    assert read.profile("straight-adaptive") == made.profile("straight-adaptive")
    (tmp_path / "none.jsonl").write_text('{"scene": "a"}\n')
    with pytest.raises(phongpd.InputError, match="expected rows of a comparison"):
        phongpd.Comparison.read(tmp_path / "none.jsonl")


def test_a_frame_has_a_line_a_run_and_nested_columns(monkeypatch):
    pandas = pytest.importorskip("pandas")
    frame = BY_HAND.frame()
    assert isinstance(frame, pandas.DataFrame) and frame.shape == (8, 7)
    assert frame["seconds.total"].tolist() == [
        one["seconds"]["total"] for one in BY_HAND.rows]
    assert frame.groupby("method")["solved"].sum().to_dict() == {
        "euclidean": 3, "phong@0.2": 3}
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError) as error:
        BY_HAND.frame()
    assert str(error.value).startswith("frame: expected the package pandas, found "
                                       "none; pip install pandas")


def test_a_figure_has_the_colours_and_steps_of_the_study():
    pytest.importorskip("matplotlib").use("agg")
    from matplotlib import pyplot
    one, = BY_HAND.plot()
    lines = {line.get_label(): line for line in one.get_lines()}
    assert lines["euclidean"].get_color() == _colours.BASELINE.colour
    assert lines["phong@0.2"].get_color() == _colours.MAIN.colour
    x, y = lines["euclidean"].get_data()
    assert list(x) == [1, 1, 1, 3, 100] and list(y) == [0, 0.25, 0.5, 0.75, 0.75]
    pyplot.close("all")


def test_one_table_gives_colours_to_all_figures():
    sys.path.insert(0, str(SOURCE / "results/bench"))
    try:
        import step_figure
    finally:
        sys.path.pop(0)
    main, baseline = _colours.MAIN.colour, _colours.BASELINE.colour
    assert step_figure.STYLES == {
        "main": f"lc rgb '{main}' lw 4",
        "baseline": f"lc rgb '{baseline}' lw 2 dt (10,4)"}
    assert step_figure.LINE_COLOURS == _colours.LINE_COLOURS
    # The program's own figures.
    text = "".join(path.read_text() for path in sorted(
        (SOURCE / "problems/output").glob("*_*.*")) if path.stem in (
            "metric_color", "step_figure"))
    assert _colours.BASELINE.colour in text and _colours.MAIN.colour in text
    others = re.search(r"kCurveColors = \{(.*?)\}", text, re.S)[1]
    assert tuple(re.findall(r"#[0-9A-F]{6}", others)) == _colours.OTHER_COLOURS
    roles = (SOURCE / "problems/studies/performance_profile.cc").read_text()
    assert '"euclidean") return StepCurve::Role::kBaseline' in roles
    assert set(_colours.ROLES) == {
        "euclidean", f"phong@{phongpd._native.default_smoothing_length:g}"}
    lines = _colours.lines_of(["a", "euclidean", "b", "phong@0.2", "a", *"cdefghi"])
    assert len(lines) == 11 and lines["b"] == _colours.other(1)
    assert len({(one.colour, one.dash) for one in lines.values()}) == 11


@pytest.mark.parametrize("wanted, arguments", [
    ("scenes: expected at least one", dict(scenes=[])),
    ("scenes: expected different ones", dict(scenes=["u_axis", "u_axis"])),
    ("scenes: expected a list", dict(scenes=5)),
    ("metrics: expected a list", dict(metrics="euclidean")),
    ("metrics", dict(metrics=["phong@x"])),
    ("straight-adaptive", dict(protocols=["straight-adaptiv"])),
    ("seeds: expected whole numbers", dict(seeds=3)),
    ("seeds: expected a whole number", dict(seeds=[0])),
    ("cache: expected True or False", dict(cache="yes"))])
def test_wrong_arguments_are_said_before_anything_runs(wanted, arguments):
    with pytest.raises(phongpd.InputError, match=wanted) as error:
        phongpd.compare(**{"scenes": ["u_axis"], **arguments})
    assert "\n" not in str(error.value)
