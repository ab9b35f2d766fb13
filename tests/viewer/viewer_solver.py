# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages that plan by themselves; what they find is judged by the program, in rational
numbers, on the meshes that the page planned with."""
import base64
import struct
import subprocess

from viewer_controls import entered
from viewer_task import SAYS, solve

SOLVES = "viewer.task.solver !== null"


def write_off(path, entry):
    """The doubles of the page, bit for bit."""
    numbers = base64.b64decode(entry["positions"])
    corners = base64.b64decode(entry["indices"])
    vertices = list(struct.iter_unpack("<3d", numbers))
    triangles = list(struct.iter_unpack("<3i", corners))
    lines = ["OFF", f"{len(vertices)} {len(triangles)} 0"]
    lines += [" ".join(map(repr, v)) for v in vertices]
    lines += ["3 " + " ".join(map(str, t)) for t in triangles]
    path.write_text("\n".join(lines) + "\n")


def judge(browser, checks, program, folder, name):
    """All motions of the way that is shown."""
    obstacles = browser.run("viewer.data.solver.obstacles")
    files = [f"page-{name}-robot.off"]
    write_off(folder / files[0], browser.run("viewer.data.solver.robot"))
    for i, entry in enumerate(obstacles):
        files.append(f"page-{name}-{i}.off")
        write_off(folder / files[-1], entry)
    points, turns = browser.run("(() => { const {points, turns} = "
                                "viewer.data.paths[viewer.state.way];"
                                "return [points, turns]; })()")
    turns = turns or [[1, 0, 0, 0]] * len(points)
    poses = [",".join(map(repr, [*p, *w])) for p, w in zip(points, turns)]
    checks.expect(len(poses) >= 3, f"{name}: {len(poses)} poses")
    for a, b in zip(poses, poses[1:]):
        said = subprocess.run(
            [program, "sweep", *files, "--from", a, "--to", b, "--exact"], cwd=folder,
            capture_output=True, text=True, check=False)
        checks.expect(said.returncode == 0,
                      f"{name}: from {a} to {b}: {said.stdout}{said.stderr}")


def plans_a_translation(browser, checks, program, folder, page):
    """Around the U; why there is none; what it does not do by itself."""
    browser.open(page)
    browser.run(entered("goal-x", 0.3))
    ways = browser.run("viewer.stage.ways.length")
    solve(browser, "plan")
    checks.holds(f"{SAYS}.startsWith('solved: ') && {SAYS}.includes(' room ')",
                 "a path, found in the page")
    checks.holds(f"viewer.stage.ways.length === {ways} + 1 && "
                 f"viewer.state.way === {ways}", "beside those that there are")
    checks.holds(f"(() => {{ const {{raw}} = viewer.stage.ways[{ways}];"
                 "return raw[0].join() === viewer.data.start.join() && "
                 "raw[raw.length - 1].join() === viewer.data.goal.join(); })()",
                 "from the start to the goal that was typed, bit for bit")
    judge(browser, checks, program, folder, "translates")
    browser.shoot(folder / "solver-translates.png")
    solve(browser, "plan")
    checks.holds(f"viewer.stage.ways.length === {ways} + 1 && "
                 f"!{SAYS}.includes('less than')", "in place of the first")
    browser.run("(viewer.data.task.clearance = 10, 0)")
    solve(browser, "plan")
    checks.holds(f"{SAYS}.includes('less than the 10') && {SAYS}.includes('--serve')",
                 "that it has less room than the scene asks for")
    browser.run(entered("start-y", 0.9))
    solve(browser, "plan")
    checks.holds(f"{SAYS}.startsWith('start in collision: the start is not free')",
                 "why there is none")
    solve(browser, "optimize")
    checks.holds(f"{SAYS}.includes('finds paths') && {SAYS}.includes('--serve')",
                 "what it does not do")
    checks.quiet("a page that plans a translation")


def to_this_side(browser):
    """A goal before the wall, turned: found within a second, wherever the machine's
    time goes."""
    browser.run(entered("goal-x", -100))
    browser.run(entered("goal-turn-z", 120))


def plans_a_turn(browser, checks, program, folder, page):
    browser.open(page)
    to_this_side(browser)
    solve(browser, "plan")
    checks.holds(f"{SAYS}.startsWith('solved: ')", "a path with turns")
    checks.holds("(() => { const {raw} = viewer.stage.ways[viewer.state.way];"
                 "const {turns} = viewer.data.paths[viewer.state.way];"
                 "return Math.abs(turns[turns.length - 1][3] - "
                 "Math.sin(Math.PI / 3)) < 1e-12 && "
                 "turns.length === raw.length; })()", "as the goal is turned")
    judge(browser, checks, program, folder, "turns")
    browser.shoot(folder / "solver-turns.png")
    checks.quiet("a page that plans a turn")


def is_cancelled(browser, checks, page):
    """Within these bounds there is no way, which takes all its time."""
    browser.open(page)
    browser.run("(viewer.data.bounds = {min: [-250, -50, -30], max: [250, -30, 0]}, "
                "0)")
    done = browser.run("viewer.task.done")
    browser.click("#solve")
    browser.wait("!document.getElementById('cancel').hidden")
    browser.click("#cancel")
    browser.wait(f"viewer.task.done > {done}")
    checks.holds(f"{SAYS} === 'cancelled' && document.getElementById('cancel')"
                 ".hidden", "it is told")
    to_this_side(browser)
    solve(browser, "plan")
    checks.holds(f"{SAYS}.startsWith('solved: ')", "and it can be asked again")
    checks.quiet("a page that is cancelled")


def work_solver(browser, checks, program, folder, pages):
    browser.open(pages["trap"])
    if not browser.run(SOLVES):
        print("Skipped: pages that plan, which this build does not", flush=True)
        return
    plans_a_translation(browser, checks, program, folder, pages["trap"])
    plans_a_turn(browser, checks, program, folder, pages["turning"])
    is_cancelled(browser, checks, pages["turning"])
    browser.open(pages["robots"])
    checks.holds("viewer.task.solver === null", "several robots it does not plan")
