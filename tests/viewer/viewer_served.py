# SPDX-License-Identifier: GPL-3.0-or-later
"""Served pages of robots that turn and of several robots, worked by mouse and
keys; and labels and fields at the widths of a desk and of a phone."""
import json
import math
import pathlib

from browser import BAD_LABELS
from serving import Served
from viewer_controls import entered
from viewer_task import SAYS, by_mouse, solve

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"
# On the screen, a point of the ring about an axis, at an angle in radians.
ON_RING = """(() => {{
  viewer.draw();
  const p = viewer.task.rings.pointOf('{0}', {1}).project(viewer.camera);
  const box = document.getElementById('canvas').getBoundingClientRect();
  return [box.left + (p.x + 1) / 2 * box.width,
          box.top + (1 - p.y) / 2 * box.height];
}})()"""


def dragged(browser, of, to):
    browser.mouse("mousePressed", *of, button="left", clickCount=1)
    for share in (0.5, 1):
        browser.mouse("mouseMoved", *(a + share * (b - a) for a, b in zip(of, to)),
                      button="left", buttons=1)
    browser.mouse("mouseReleased", *to, button="left", clickCount=1)


def labels_at_all_widths(browser, checks, address, name, folder):
    """Light and dark, at a desk and on a phone."""
    for width, height in ((1280, 800), (390, 844)):
        for theme in ("light", "dark"):
            browser.open(address, width=width, height=height, theme=theme)
            size = f"{name} {theme} at {width}"
            checks.drawn(size)
            for yaw in range(8):
                browser.run(f"(viewer.orbit.yaw = {yaw} * 0.8, 0)")
                bad = browser.run(BAD_LABELS)
                checks.expect(not bad, f"{size}: labels {bad} at yaw {yaw * 0.8}")
            browser.press("r")
            checks.holds("[...document.querySelectorAll('#labels .name')].every("
                         "e => parseFloat(getComputedStyle(e).fontSize) >= 12)",
                         f"{size}: names can be read")
            browser.shoot(folder / f"served-{name}-{theme}-{width}.png")
            if width < 760:
                browser.click("#menu")
                checks.holds("[...document.querySelectorAll('#task input, #task "
                             "select, #task button')].every(e => !e.offsetParent "
                             "|| (e.getBoundingClientRect().width >= 40 && "
                             "e.getBoundingClientRect().right <= innerWidth))",
                             f"{size}: its fields have room")
                browser.shoot(folder / f"served-{name}-{theme}-panel.png")
            checks.quiet(size)


def wheel_beside_the_picture(browser, checks, address):
    """Over the panel the wheel scrolls that, and zooms nothing."""
    browser.open(address, width=1280, height=400)
    before = browser.run("viewer.orbit.distance")
    x, y = browser.run("(() => { const b = document.getElementById('panel')"
                       ".getBoundingClientRect(); return [b.left + 40, "
                       "b.top + b.height / 2]; })()")
    browser.mouse("mouseWheel", x, y, deltaX=0, deltaY=150)
    checks.holds("document.getElementById('panel').scrollTop > 0",
                 "the wheel scrolls the panel")
    checks.holds(f"viewer.orbit.distance === {before}", "and zooms nothing")


def status_alone(browser, checks, status):
    """The browser itself tells of a status that is an error, and nobody else."""
    browser.run("0")
    checks.expect(all(status in text for text in browser.messages),
                  f"the console: {browser.messages}")
    browser.messages.clear()


def work_turning(browser, checks, program, folder):
    """Rings and fields turn the robot; what is found begins and ends so."""
    with Served(program, folder, str(EXAMPLES / "turning.json")) as served:
        browser.open(served.address)
        checks.holds("!viewer.task.rings.group.visible",
                     "no rings before an end is taken")
        by_mouse(browser, "start", 0, 0)
        checks.holds("viewer.task.rings.group.visible", "rings from then on")
        # From above a quarter around the ring about z is a quarter.
        browser.run("(viewer.orbit.pitch = Math.PI / 2, viewer.orbit.yaw = 0.2, "
                    "0)")
        dragged(browser, browser.run(ON_RING.format("z", 0.5)),
                browser.run(ON_RING.format("z", 0.5 + math.pi / 4)))
        angle = browser.run("vectorOfTurn(viewer.data.start_turn)[2]")
        checks.expect(abs(angle - 45) < 1.0, f"the ring about z: {angle}")
        checks.holds("document.getElementById('start-turn-z').value == Number("
                     "vectorOfTurn(viewer.data.start_turn)[2].toPrecision(6))",
                     "its field follows")
        checks.holds(f"{SAYS} === 'Moved; press Solve.'", "it is told")
        # Seen from aside a ring is pulled along.
        browser.run("(viewer.orbit.pitch = 0, viewer.orbit.yaw = 0.2, 0)")
        x, y = browser.run(ON_RING.format("z", 0.4))
        dragged(browser, (x, y), (x + 30, y))
        checks.holds("vectorOfTurn(viewer.data.start_turn)[2] > "
                     f"{angle} + 5", "a ring that is seen from aside")
        for k, value in zip("xyz", (0, 0, 90)):
            browser.run(entered(f"start-turn-{k}", value))
        checks.holds("Math.hypot(...viewer.data.start_turn.map((x, i) => "
                     "x - [Math.SQRT1_2, 0, 0, Math.SQRT1_2][i])) < 1e-12 && "
                     "viewer.stage.robot.quaternion.angleTo(asTurn("
                     "viewer.data.start_turn)) < 1e-6",
                     "typed: a quarter about z")
        checks.holds("Math.hypot(...vectorOfTurn(turnOfVector([10, -20, 30]))"
                     ".map((x, i) => x - [10, -20, 30][i])) < 1e-9",
                     "degrees there and back")
        browser.run("viewer.reset()")
        by_mouse(browser, "goal", 20, -10)
        checks.holds("viewer.task.rings.key === 'goal' && viewer.task.rings.group"
                     ".position.equals(viewer.stage.ends.goal[0].position)",
                     "the rings go to the end that was taken")
        solve(browser, "plan")
        checks.holds(f"{SAYS}.startsWith('solved: ') && !!viewer.stage.ways[0]"
                     ".turns", "a path of poses: " + str(browser.run(SAYS)))
        checks.holds("[0, 1].every(t => { viewer.state.time = t; viewer.draw();"
                     "return viewer.stage.robot.quaternion.angleTo(asTurn(t ? "
                     "viewer.data.goal_turn : viewer.data.start_turn)) < 1e-6; })",
                     "from the one turn to the other")
        browser.shoot(folder / "served-turning.png")
        for k, value in zip("xyz", (0, -40, -15)):
            browser.run(entered(f"start-{k}", value))
        solve(browser, "plan")
        checks.holds("/triangle \\d+ of the robot meets triangle \\d+ .* deep$/"
                     f".test({SAYS})", "who meets whom, and how deep")
        solve(browser, "depth")
        checks.holds(f"{SAYS}.startsWith('penetrating, depth ') && viewer.stage."
                     "solved.ghost.quaternion.angleTo(asTurn(viewer.data."
                     "start_turn)) < 1e-6", "the way out, turned as it is")
        browser.shoot(folder / "served-turning-depth.png")
        checks.quiet("served, turning")
        labels_at_all_widths(browser, checks, served.address, "turning", folder)
        wheel_beside_the_picture(browser, checks, served.address)


def work_robots(browser, checks, program, folder):
    """Each end is taken by its mark; all motions come and are played at once."""
    with Served(program, folder, str(EXAMPLES / "robots.json")) as served:
        browser.open(served.address)
        checks.holds("Object.keys(viewer.stage.ends).length === 6 && !document."
                     "getElementById('play')", "six ends, and no motion yet")
        # Where one is to come to another begins: it is that which is chosen.
        browser.run(entered("task-robot", 1))
        by_mouse(browser, "start 1", -30, 0)
        checks.holds("viewer.task.robot === 1 && document.getElementById("
                     "'task-robot').value === '1' && viewer.data.ends[1].start[0] "
                     "!== 740 && viewer.stage.crew.robots[1].group.position"
                     ".equals(viewer.stage.ends['start 1'][0].position)",
                     "the robot goes along with its start")
        browser.run(entered("start-x", 740))
        browser.run(entered("start-y", 200))
        browser.run(entered("start-z", 30))
        browser.run(entered("task-robot", 0))
        browser.run(entered("goal-y", 240))
        checks.holds("String(viewer.data.ends[0].goal) === '740,240,30' && "
                     "String(viewer.data.ends[1].start) === '740,200,30'",
                     "typed, of the robot that was chosen")
        solve(browser, "optimize")
        says = browser.run(SAYS)
        checks.holds(f"{SAYS}.startsWith('converged: ') && "
                     f"{SAYS}.includes('closest ')", "it is told: " + says)
        checks.holds("viewer.stage.ways.length === 3 && !!document."
                     "getElementById('play') && (() => { viewer.state.time = 1; "
                     "viewer.draw(); const {crew, ends} = viewer.stage; return "
                     "crew.robots.every(({group}, i) => group.position.distanceTo("
                     "ends['goal ' + i][0].position) < 1e-6); })()",
                     "all come to their goals")
        browser.run("(viewer.state.time = 0.5, viewer.apply(), 0)")
        browser.shoot(folder / "served-robots.png")
        data = json.loads(browser.run("JSON.stringify(viewer.data.ends)"))
        checks.expect(data[0]["goal"] == [740, 240, 30], "ends stay as asked")
        browser.run(entered("start-x", 700))
        solve(browser, "optimize")
        checks.holds("document.getElementById('task-says').classList.contains("
                     f"'error') && {SAYS}.includes('touch at their starts')",
                     "two in one place, in one line")
        status_alone(browser, checks, "400")
        for k, value in zip("xyz", (400, 300, 30)):
            browser.run(entered("start-" + k, value))
        solve(browser, "depth")
        checks.holds(f"{SAYS}.startsWith('penetrating, depth 60 mm')",
                     "how deep it is: " + browser.run(SAYS))
        checks.quiet("served, robots")
        labels_at_all_widths(browser, checks, served.address, "robots", folder)


def work_cancel(browser, checks, program, folder):
    """A question that would take hours ends by its button."""
    knot = {"type": "knot", "size": 1.0, "tube": 0.2, "around": 96, "across": 24}
    scene = folder / "knots.json"
    scene.write_text(json.dumps({
        "name": "knots", "robot": {"shape": knot},
        "obstacles": [{"id": "knot", "shape": knot}], "start": [-20, 0, 0],
        "goal": [20, 0, 0], "planning": {"model": "full"}}))
    with Served(program, folder, str(scene), "--no-cache", "--time",
                "36000") as served:
        browser.open(served.address)
        checks.holds("document.getElementById('cancel').hidden",
                     "nothing to cancel")
        browser.click("#solve")
        checks.holds("!document.getElementById('cancel').hidden",
                     "the button is there while it solves")
        browser.run("new Promise(done => setTimeout(done, 500))")
        browser.click("#cancel")
        browser.wait("viewer.task.done === 1")
        checks.holds(f"{SAYS} === 'cancelled' && document.getElementById('cancel')"
                     ".hidden && !document.getElementById('solve').disabled",
                     "it is over, and told")
    status_alone(browser, checks, "409")


def work_kinds(browser, checks, program, folder):
    work_turning(browser, checks, program, folder)
    work_robots(browser, checks, program, folder)
    work_cancel(browser, checks, program, folder)
