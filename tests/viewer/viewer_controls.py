# SPDX-License-Identifier: GPL-3.0-or-later
"""Controls of the viewer's pages, worked by mouse and keys."""
from browser import LOOK


def entered(element, value, event="change"):
    """JavaScript that gives an element a value as if somebody had."""
    return (f"(() => {{ const e = document.getElementById('{element}');"
            f"e.value = '{value}'; e.dispatchEvent(new Event('{event}')); }})()")


def work_controls(browser, checks, page):
    """Every control of a page with two runs."""
    holds, changes = checks.holds, checks.changes
    changes(lambda: browser.click("#show-contact"), "hiding the contact space")
    holds("!viewer.stage.groups.contact.visible", "the box hides it")
    browser.press("k")
    holds("viewer.stage.groups.contact.visible", "K shows it again")
    changes(lambda: browser.click("#show-obstacle"), "hiding the obstacle")
    browser.click("#show-obstacle")
    changes(lambda: browser.click("#show-robot"), "hiding the robot")
    browser.click("#show-robot")
    changes(lambda: browser.click("#show-marks"), "hiding start and goal")
    browser.click("#show-marks")
    changes(lambda: browser.press("g"), "the robot at stages")
    browser.press("g")
    # A path that solids hide is seen through them from the beginning.
    changes(lambda: browser.click("#xray"), "seeing through solids")
    browser.press("o")
    holds("viewer.state.xray === viewer.isHidden", "O takes it back")
    changes(lambda: browser.run(entered("surface", "bend")),
            "colour by curvature")
    holds("!document.getElementById('bend-key').hidden", "its key is shown")
    browser.run(entered("surface", ""))

    changes(lambda: browser.click("#clip-on"), "cutting")
    changes(lambda: browser.click("#clip-flip"), "the other side of the cut")
    changes(lambda: browser.run(entered("clip-at", "250", "input")),
            "moving the plane")
    changes(lambda: browser.run(entered("clip-axis", "x")),
            "another axis of the plane")
    browser.press("c")
    holds("!viewer.state.clip.on", "C ends the cut")

    yaw = browser.run("viewer.orbit.yaw")
    browser.mouse("mousePressed", 400, 400, button="left", clickCount=1)
    browser.mouse("mouseMoved", 490, 400, button="left", buttons=1)
    browser.mouse("mouseReleased", 490, 400, button="left", clickCount=1)
    turned = browser.run("viewer.orbit.yaw") - yaw
    checks.expect(abs(turned + 0.5) < 1e-6, f"90 pixels turn by 0.5: {turned}")
    browser.mouse("mousePressed", 400, 400, button="right", clickCount=1)
    browser.mouse("mouseMoved", 430, 420, button="right", buttons=2)
    browser.mouse("mouseReleased", 430, 420, button="right", clickCount=1)
    holds("Math.hypot(...viewer.orbit.target.toArray().map("
          "(x, k) => x - viewer.orbit.home.target[k])) > 0.01",
          "the right button moves the view")
    browser.mouse("mouseWheel", 400, 400, deltaX=0, deltaY=200)
    browser.wait("viewer.orbit.distance > viewer.orbit.home.distance")
    browser.click("#reset")
    holds("viewer.orbit.distance === viewer.orbit.home.distance && "
          "viewer.orbit.yaw === viewer.orbit.home.yaw", "reset brings it back")
    browser.press("+")
    holds("viewer.orbit.distance < viewer.orbit.home.distance", "+ is nearer")
    browser.press("r")
    changes(lambda: browser.press("z"), "looking from above")
    holds("viewer.orbit.pitch > 1.5", "Z looks from above")
    browser.press("r")

    browser.run(entered("scrub", "10000", "input"))
    holds("(viewer.draw(), viewer.stage.robot.position.distanceTo("
          "viewer.stage.at(viewer.data.goal)) < 1e-6)", "the end is the goal")
    browser.press("ArrowLeft")
    holds("Math.abs(viewer.state.time - 0.99) < 1e-9", "the left key steps")
    browser.run("viewer.set(() => { viewer.state.time = 0; })")
    browser.click("#play")
    browser.wait("viewer.state.time > 0.01")
    holds("viewer.state.playing", "it plays")
    browser.press(" ")
    holds("!viewer.state.playing", "space pauses")
    browser.run(entered("speed", "4"))
    holds("viewer.state.speed === 4", "speed")
    browser.click('button.way[data-way="1"]')
    holds("viewer.state.way === 1", "a click on a path follows it")
    browser.press("1")
    holds("viewer.state.way === 0", "1 follows the first")

    changes(lambda: browser.click("#theme"), "the theme")
    holds("document.documentElement.dataset.theme === 'dark'", "it is dark")
    browser.click("#ask")
    holds("!document.getElementById('help').hidden", "? shows the keys")
    browser.press("Escape")
    holds("document.getElementById('help').hidden", "Esc hides them")
    browser.click("#menu")
    holds("getComputedStyle(document.getElementById('panel')).display === "
          "'none'", "the menu hides the panel")
    browser.click("#menu")
    holds("viewer.picture().toDataURL('image/png').length > 10000",
          "the picture to save is there")

    # A link brings the same view.
    browser.run("viewer.set(() => { Object.assign(viewer.state.clip, {on: true,"
                "axis: 'y', at: 0.25}); viewer.state.time = 0.5;"
                "viewer.orbit.turn(0.3, 0.1); })")
    browser.click("#link")
    link, look = browser.run("location.hash"), browser.run(LOOK)
    checks.quiet("controls")
    browser.open(page, link)
    again = browser.run(LOOK)
    difference = sum(abs(a - b) for a, b in zip(look, again))
    checks.expect(difference < 20000, f"a link keeps the view ({difference})")
    holds("viewer.state.clip.axis === 'y' && viewer.state.clip.on && "
          "viewer.state.time === 0.5 && viewer.state.speed === 4 && "
          "viewer.state.theme === 'dark'", "a link keeps the state")


def work_iterations(browser, checks, page):
    """Iterations of the optimiser, beside time, on the page of a run."""
    holds, changes = checks.holds, checks.changes
    browser.open(page)
    holds("viewer.state.iterate === null && "
          "document.getElementById('which-iterate').textContent"
          ".startsWith('the answer')", "the answer is shown at first")
    changes(lambda: browser.run(entered("scrub-iterate", "0", "input")),
            "the first iteration")
    holds("document.getElementById('which-iterate').textContent"
          ".startsWith('0 of ')", "it is told which")
    # By another route: the energy of what is drawn is the row's, and that of
    # the answer is less than that of the first iterate.
    holds("""(() => {
      const {iterates} = viewer.stage, way = viewer.stage.ways[0];
      const energy = p => {
        let sum = 0;
        for (let i = 1; i < p.length; ++i) {
          sum += p[i].reduce((s, x, k) => s + (x - p[i - 1][k]) ** 2, 0);
        }
        const line = p[0].reduce(
            (s, x, k) => s + (x - p[p.length - 1][k]) ** 2, 0);
        return (p.length - 1) * sum / line;
      };
      return way.iterates.kept.length > 5 &&
          way.iterates.kept.every((kept, i) => Math.abs(
              energy(iterates.at(way, i).raw) / kept.objective - 1) < 1e-4);
    })()""", "every iterate has its energy")
    holds("viewer.data.iterates[0].kept.some(kept => !kept.free) && "
          "viewer.data.iterates[0].kept.some(kept => kept.free)",
          "some collide, some are free")
    browser.press(".")
    holds("viewer.state.iterate === 1", ". is the next")
    browser.press(",")
    holds("viewer.state.iterate === 0", ", is the one before")
    browser.run(entered("scrub", "0", "input"))
    holds("(viewer.draw(), viewer.stage.robot.position.distanceTo("
          "viewer.stage.at(viewer.data.start)) < 1e-5)",
          "the robot follows the iterate")
    browser.open_link(page)
    holds("viewer.state.iterate === 0 && viewer.stage.iterates.shown !== null",
          "a link keeps the iteration")
    browser.run("viewer.set(() => { viewer.state.speed = 4; })")
    browser.click("#play-iterate")
    browser.wait("viewer.state.iterate > 0")
    browser.wait("viewer.state.running === 0 && viewer.state.iterate === null")
    holds("viewer.stage.iterates.shown === null", "they end at the answer")
    browser.run(entered("scrub-iterate", "1", "input"))
    browser.press("r")
    holds("viewer.state.iterate === null", "reset shows the answer")
    checks.quiet("iterations")


def work_overlays(browser, checks, pages):
    """What lies behind an answer: in the legend, and drawn where it is on."""
    for name, kind, is_on in (("tree", "graphs", True),
                              ("roadmap", "graphs", True),
                              ("corridor", "planes", False),
                              ("depth", "windows", True)):
        browser.open(pages[name])
        checks.holds(f"viewer.state.show.{kind} === {str(is_on).lower()} && "
                     f"document.getElementById('show-{kind}').checked === "
                     f"{str(is_on).lower()}", f"{name}: {kind} as at first")
        checks.changes(lambda kind=kind: browser.click(f"#show-{kind}"),
                       f"{name}: switching {kind}")
        checks.holds(f"viewer.state.show.{kind} === {str(not is_on).lower()} "
                     f"&& viewer.stage.overlays.parts.filter(p => p.kind === "
                     f"'{kind}').every(p => p.object.visible === "
                     f"{str(not is_on).lower()})", f"{name}: the box switches")
        checks.quiet(name)
    browser.open(pages["tree"])
    checks.holds("document.getElementById('show-graphs').parentNode"
                 ".textContent === 'retraction trees'", "the tree has its name")
    # A tree's motions are free: none enters an obstacle's inside.
    checks.holds("viewer.data.graphs.length === 1 && "
                 "viewer.data.graphs[0].edges >= viewer.data.graphs[0].points "
                 "- 2 && viewer.data.graphs[0].points > 10",
                 "the run's tree is in the page")
    browser.open(pages["trap"])
    checks.holds("['graphs', 'planes', 'windows'].every(kind => "
                 "!document.getElementById('show-' + kind)) && "
                 "!document.getElementById('iterations')",
                 "what a run has not is not offered")
    checks.quiet("overlays")
