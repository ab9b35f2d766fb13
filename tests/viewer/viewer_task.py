# SPDX-License-Identifier: GPL-3.0-or-later
"""Start and goal that are moved, what is asked of them, and pages in pages and on
phones: worked by mouse, fingers and keys."""
import math
import pathlib

from browser import Browser
from serving import Served
from viewer_controls import entered

GANTRY = pathlib.Path(__file__).resolve().parents[2] / "examples/gantry.json"
# Where start or goal is on the screen.
PLACE = """(() => {{
  viewer.draw();
  const p = viewer.stage.ends['{0}'][0].position.clone().project(viewer.camera);
  const box = document.getElementById('canvas').getBoundingClientRect();
  return [box.left + (p.x + 1) / 2 * box.width,
          box.top + (1 - p.y) / 2 * box.height];
}})()"""
SAYS = "document.getElementById('task-says').textContent"


def by_mouse(browser, end, dx, dy, modifiers=0):
    x, y = browser.run(PLACE.format(end))
    browser.mouse("mousePressed", x, y, button="left", clickCount=1,
                  modifiers=modifiers)
    for share in (0.5, 1):
        browser.mouse("mouseMoved", x + share * dx, y + share * dy,
                      button="left", buttons=1, modifiers=modifiers)
    browser.mouse("mouseReleased", x + dx, y + dy, button="left", clickCount=1,
                  modifiers=modifiers)
    return x + dx, y + dy


def by_finger(browser, end, dx, dy):
    x, y = browser.run(PLACE.format(end))
    x, y = x + 20, y  # fingers are wide
    for kind, points in (("touchStart", [{"x": x, "y": y}]),
                         ("touchMove", [{"x": x + dx / 2, "y": y + dy / 2}]),
                         ("touchMove", [{"x": x + dx, "y": y + dy}]),
                         ("touchEnd", [])):
        browser.call("Input.dispatchTouchEvent", type=kind, touchPoints=points)


def choose(browser, what):
    browser.run(entered("task-what", what))


def work_task(browser, checks, page):
    """A page that nobody serves: ends move, depth comes, what is more is told."""
    browser.open(page)
    if browser.run("viewer.task.solver === null"):
        checks.holds("!document.querySelector('#task details').open",
                     "where there is no solver, its fields are folded")
        browser.click("#task summary")
    first = browser.run("viewer.data.goal.slice()")
    yaw = browser.run("viewer.orbit.yaw")
    x, y = by_mouse(browser, "goal", 60, -40)
    there = browser.run(PLACE.format("goal"))
    checks.expect(math.dist(there, (x, y)) < 0.5,
                  f"the goal is where it was dragged to: {there}, {x, y}")
    checks.expect(browser.run("viewer.orbit.yaw") == yaw, "the view stands still")
    checks.holds(f"{SAYS} === 'Moved; press Solve.'", "it is told")
    checks.holds("['x', 'y', 'z'].every((k, i) => Math.abs(document."
                 "getElementById('goal-' + k).value - viewer.data.goal[i]) < "
                 "1e-4)", "the fields follow")
    moved = browser.run("viewer.data.goal.slice()")
    # In the plane across the view: nothing along it.
    checks.holds(f"Math.abs(new THREE.Vector3(...{moved}).sub(new THREE.Vector3("
                 f"...{first})).dot(viewer.camera.getWorldDirection("
                 "new THREE.Vector3()))) < 1e-6", "not to or fro")
    by_mouse(browser, "start", 5, -50, modifiers=2)
    checks.holds("viewer.data.start[0] === 0 && viewer.data.start[1] === -1.5 && "
                 "viewer.data.start[2] > 0.1", "with Ctrl up alone")
    browser.run(entered("task-along", "x"))
    by_mouse(browser, "start", 60, 0)
    checks.holds("viewer.data.start[0] !== 0 && viewer.data.start[1] === -1.5",
                 "along an axis")
    browser.run(entered("task-along", ""))
    for k, value in zip("xyz", (0, 0.9, 0)):
        browser.run(entered("start-" + k, value))
    checks.holds("String(viewer.data.start) === '0,0.9,0'", "typed")
    browser.run(entered("start-x", ""))
    checks.holds("String(viewer.data.start) === '0,0.9,0'", "nothing typed")
    solve(browser, "optimize")
    checks.holds(f"{SAYS}.includes('phongpd view phong.jsonl euclid.jsonl "
                 "--serve')", "what to run")
    if browser.run("viewer.probe !== null"):
        checks.changes(lambda: solve(browser, "depth"), "the depth of the start")
        checks.holds(f"{SAYS}.startsWith('penetrating, depth 0.2 units')",
                     "the depth in the page")
        by_mouse(browser, "start", 0, 30)
        checks.holds("viewer.task.answer === null", "it goes with the start")
    checks.quiet("task")


def solve(browser, what):
    choose(browser, what)
    done = browser.run("viewer.task.done")
    browser.click("#solve")
    browser.wait(f"viewer.task.done > {done}")


def work_served(browser, checks, program, folder):
    """The same page with the program behind it."""
    with Served(program, folder, "u_axis", "--build") as served:
        browser.open(served.address)
        checks.drawn("served")
        checks.holds("viewer.stage.ways.length === 0 && !document."
                     "getElementById('play')", "no path at first")
        solve(browser, "plan")
        checks.holds("viewer.stage.ways.length === 1 && viewer.stage.ways[0].free"
                     " && !!document.getElementById('play')", "it can be played")
        checks.holds(f"{SAYS}.startsWith('solved: ')", "it is told")
        browser.shoot(folder / "served-plan.png")
        by_mouse(browser, "goal", 40, -30)
        goal = browser.run("viewer.data.goal.slice()")
        solve(browser, "optimize")
        checks.holds("viewer.stage.ways.length === 2 && viewer.state.way === 1",
                     "a trajectory beside it")
        checks.holds("new Set([0, 1].map(i => viewer.stage.colorOf('light', i)))"
                     ".size === 2", "in another colour")
        checks.holds("(() => { const {raw} = viewer.stage.ways[1]; return "
                     f"raw[raw.length - 1].every((x, k) => x === {goal}[k]); }})()",
                     "to the goal that was dragged")
        solve(browser, "plan")
        checks.holds("viewer.stage.ways.length === 2 && viewer.state.way === 0 && "
                     "document.querySelectorAll('[data-way]').length === 2",
                     "another plan takes the place of the first")
        browser.press(" ")
        browser.wait("viewer.state.time > 0.01")
        browser.press(" ")
        browser.run(entered("start-y", "0.9"))
        solve(browser, "plan")
        checks.holds("document.getElementById('task-says').classList.contains("
                     f"'error') && {SAYS}.startsWith('start')",
                     "why there is none, in one line")
        solve(browser, "depth")
        checks.holds(f"{SAYS}.startsWith('penetrating, depth 0.2 units')",
                     "how deep")
        browser.shoot(folder / "served-depth.png")
        browser.call("Emulation.setTouchEmulationEnabled", enabled=True)
        browser.open(served.address, width=390, height=800)
        before = browser.run("viewer.data.goal.slice()")
        by_finger(browser, "goal", -40, 30)
        checks.holds(f"String(viewer.data.goal) !== '{before}'"
                     .replace("[", "").replace("]", ""), "a finger moves the goal")
        browser.call("Emulation.setTouchEmulationEnabled", enabled=False)
        checks.quiet("served")
    with Served(program, folder, str(GANTRY)) as served:
        browser.open(served.address)
        solve(browser, "optimize")
        checks.holds("viewer.pace && viewer.pace.duration > 1 && "
                     "!!document.getElementById('chart') && "
                     f"{SAYS}.startsWith('converged: ')",
                     "a motion in time, with what it asks of its limits")
        browser.shoot(folder / "served-gantry.png")
        checks.quiet("served motion")
    solve(browser, "plan")
    checks.holds(f"{SAYS}.startsWith('The server does not answer')",
                 "when it has ended")
    browser.messages.clear()  # the browser tells of that, too


def work_phone(browser, checks, page, folder):
    """On a phone the probe's numbers are below the picture."""
    browser.open(page, width=390, height=800)
    browser.click("#menu")
    checks.holds("document.body.classList.contains('open')", "the panel")
    browser.shoot(folder / "phone-panel.png")
    browser.click("#probe-on")
    browser.wait("viewer.state.probe.on")
    checks.holds("!document.body.classList.contains('open')",
                 "it leaves the picture free")
    checks.holds("[0, 1, 2].every(i => { const e = document.getElementById("
                 "'reading-' + i), b = e.getBoundingClientRect(); return "
                 "e.textContent !== '' && b.width > 0 && b.left >= 0 && "
                 "b.right <= 390 && b.bottom <= 800; })", "three numbers")
    browser.shoot(folder / "phone-probe.png")
    checks.quiet("phone")


def labels_beside_the_panel(browser, checks, page):
    """None is below the panel, wherever the view is turned to."""
    browser.open(page)
    for yaw in range(0, 12):
        browser.run(f"(viewer.orbit.yaw = {yaw} / 2, viewer.orbit.distance = 0.8,"
                    "viewer.draw(), 0)")
        checks.holds("(() => { const p = document.getElementById('panel')"
                     ".getBoundingClientRect(); return [...document."
                     "querySelectorAll('#labels .name')].every(e => { const b = "
                     "e.getBoundingClientRect(); return b.right <= p.left || "
                     "b.bottom <= p.top || b.top >= p.bottom; }); })()",
                     f"labels at yaw {yaw / 2}")
    checks.quiet("labels")


def chart_of_a_motion(browser, checks, page):
    """Size, change and turn of PD, each its own numbers."""
    browser.open(page)
    picture = "document.getElementById('chart').toDataURL()"
    seen = {browser.run(picture)}
    for kind in ("change", "size"):
        browser.run(entered("chart-kind", kind))
        seen.add(browser.run(picture))
    checks.expect(len(seen) == 3, "three charts")
    # By another route: the cosine of the angle between unit vectors.
    checks.holds("""viewer.data.motion.traces.every(({pd}) => {
      const angles = kChartKinds.angle.of(pd);
      const unit = p => { const l = Math.hypot(...p); return p.map(x => x / l); };
      return angles[0] === 0 && pd.every((b, f) => {
        if (f === 0 || !Math.hypot(...b) || !Math.hypot(...pd[f - 1])) return true;
        const u = unit(pd[f - 1]), v = unit(b);
        const cosine = u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
        return Math.abs(Math.cos(angles[f] * Math.PI / 180) - cosine) < 1e-9;
      });
    })""", "the angle is that between them")
    checks.holds("Math.max(...kChartKinds.angle.of(viewer.data.motion.traces[0]"
                 ".pd)) > 45 && Math.max(...kChartKinds.angle.of(viewer.data."
                 "motion.traces[1].pd)) < 45",
                 "Euclidean PD flips, PhongPD does not")
    browser.open_link(page)
    checks.holds("viewer.state.chart === 'size'", "a link keeps it")
    checks.quiet("chart")


def page_in_a_page(chromium, checks_of, page, folder):
    """The wheel scrolls past it until it is clicked."""
    outer = folder / "outer.html"
    outer.write_text("<!doctype html><body style='margin:0'><iframe id='in' "
                     f"style='width:600px;height:400px' src='{page.name}'>"
                     "</iframe><div style='height:4000px'></div>")
    browser = Browser(chromium, "--allow-file-access-from-files")
    checks = checks_of(browser)
    inner = "document.getElementById('in').contentWindow"
    distance = f"{inner}.viewer.orbit.distance"

    def wheel(**more):
        browser.mouse("mouseWheel", 250, 200, deltaX=0, deltaY=120, **more)

    def open_anew():
        browser.call("Page.navigate", url="about:blank")
        browser.call("Page.navigate", url=f"file://{outer}")
        browser.wait(f"document.getElementById('in') && {inner}.viewer && "
                     f"{inner}.document.documentElement.dataset.ready === '1'")
        browser.mouse("mouseMoved", 250, 200)
        return browser.run(distance)

    try:
        first = open_anew()
        wheel()
        checks.holds("scrollY > 0", "the wheel scrolls the page")
        checks.expect(browser.run(distance) == first, "and does not zoom")
        checks.holds(f"{inner}.document.getElementById('message').textContent"
                     ".startsWith('Click the picture')", "a hint is shown")
        first = open_anew()
        wheel(modifiers=2)
        checks.holds(f"{distance} > {first}", "with Ctrl it zooms")
        for kind in ("mousePressed", "mouseReleased"):
            browser.mouse(kind, 250, 200, button="left", clickCount=1)
        now = browser.run(distance)
        wheel()
        checks.holds(f"{distance} > {now}", "after a click it zooms")
        checks.expect(browser.run("scrollY") == 0, "and scrolls nothing")
        checks.quiet("a page in a page")
    finally:
        browser.close()
    return checks.failures
