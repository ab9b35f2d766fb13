# SPDX-License-Identifier: GPL-3.0-or-later
"""What the viewer's pages compute of metrics: the live probe, and colours of
cuts and surfaces, against the program and by other routes."""
import csv
import json
import math

from viewer_controls import entered


def probe_like_the_program(browser, checks, run, folder):
    """The live probe of the page that is open says what `query` says."""
    points = [[0.3 + 0.1 * math.sin(0.2 * i), -1.2 + 2.4 * i / 150,
               0.1 - 0.05 * i / 150] for i in range(151)]
    (folder / "points.csv").write_text("x,y,z\n" + "".join(
        f"{x!r},{y!r},{z!r}\n" for x, y, z in points))
    browser.press("p")
    browser.wait("viewer.state.probe.on")
    for metric, name in enumerate(("euclidean", "phong", "sliding")):
        more = ["--smoothing-length", "0.1"] if name == "phong" else []
        run("query", "--contact-space", "contact.off", "--points", "points.csv",
            "--output", "answers.csv", "--tracked", "--metric", name, *more)
        with open(folder / "answers.csv", encoding="utf-8") as file:
            expected = list(csv.DictReader(file))
        found = browser.run(
            "(() => { const {probe} = viewer.probe; probe.smooth(0.1);"
            f"probe.forget(); return {json.dumps(points)}.map("
            f"q => probe.answers(q)[{metric}]); }})()")
        checks.expect(
            [a["status"].replace(" ", "_").lower() for a in found] ==
            [row["status"] for row in expected],
            f"{name}: the probe has the program's statuses")
        inside = [(a, row) for a, row in zip(found, expected) if a["inside"]]
        checks.expect(len(inside) > 50, f"{name}: most points are inside")
        worst = max(max(abs(a["distance"] - float(row["signed_distance"])),
                        *(abs(a["contact"][k] - float(row["contact_" + axis]))
                          for k, axis in enumerate("xyz")))
                    for a, row in inside)
        checks.expect(worst < 1e-11, f"{name}: the probe is off by {worst}")


def work_probe(browser, checks, page):
    """The probe's controls, on a page of a motion."""
    holds, changes = checks.holds, checks.changes
    browser.open(page)
    holds("document.getElementById('probe').hidden", "the probe is off")
    browser.click("#probe-on")
    browser.wait("viewer.state.probe.on")
    holds("document.querySelectorAll('#labels .pane').length === 0",
          "the probe has one picture")
    holds("document.getElementById('probe-answer-0').textContent"
          ".includes('deep')", "it tells the depth")
    browser.run("viewer.draw()")
    x, y = browser.run(
        "(() => { const p = viewer.stage.robot.position.clone().project("
        "viewer.camera); const b = document.getElementById('canvas')"
        ".getBoundingClientRect(); return [b.left + (p.x + 1) / 2 * b.width,"
        "b.top + (1 - p.y) / 2 * b.height]; })()")
    before = browser.run("[viewer.state.probe.at, viewer.orbit.yaw]")
    browser.mouse("mousePressed", x, y, button="left", clickCount=1)
    changes(lambda: browser.mouse("mouseMoved", x + 60, y - 30, button="left",
                                  buttons=1), "dragging the robot")
    browser.mouse("mouseReleased", x + 60, y - 30, button="left", clickCount=1)
    holds(f"viewer.orbit.yaw === {before[1]}", "a drag of it turns no view")
    moved = browser.run(
        "(() => { const p = viewer.stage.robot.position.clone().project("
        "viewer.camera); const b = document.getElementById('canvas')"
        ".getBoundingClientRect(); return [b.left + (p.x + 1) / 2 * b.width,"
        "b.top + (1 - p.y) / 2 * b.height]; })()")
    checks.expect(abs(moved[0] - x - 60) < 1 and abs(moved[1] - y + 30) < 1,
                  f"the robot follows the pointer: {moved}")
    holds("viewer.probe.history.length === 2", "each place is asked once")
    at = browser.run("viewer.state.probe.at")
    browser.press("ArrowUp")
    holds(f"Math.abs(Math.hypot(...viewer.state.probe.at.map((x, k) => x - "
          f"{at}[k])) / viewer.data.scale - 0.01) < 1e-9", "a key moves it")
    browser.run(entered("probe-x", "0.25"))
    holds("viewer.state.probe.at[0] === 0.25", "a number places it")
    browser.click('[data-probe="0"]')
    holds("viewer.state.probe.metric === 0 && viewer.stage.probeArrows[0]"
          ".group.visible", "a click shows where a metric sends it")
    browser.run("(() => { const e = document.getElementById("
                "'probe-smoothing'); e.value = '0'; e.dispatchEvent("
                "new Event('change')); })()")
    holds("viewer.probe.probe.smoothing === 0 && "
          "viewer.probe.history.length === 1",
          "another smoothing length begins anew")
    browser.click("#link")
    link = browser.run("location.hash")
    at = browser.run("viewer.state.probe.at")
    browser.open(page, link)
    browser.wait("viewer.state.probe.on")
    holds(f"JSON.stringify(viewer.state.probe.at) === '{json.dumps(at)}'"
          ".replace(/ /g, '') && viewer.state.probe.metric === 0",
          "a link keeps the probe")
    browser.press("p")
    holds("!viewer.state.probe.on && document.querySelectorAll("
          "'#labels .pane').length === 3", "P ends it")
    checks.quiet("probe")
    # What is no contact space is refused in words.
    browser.open(page)
    browser.run("(() => { const s = viewer.data.probe.spaces[0];"
                "s.indices = s.indices.slice(0, 16 * 20); })()")
    browser.press("p")
    browser.wait("document.getElementById('message').textContent"
                 ".includes('closed, edge-manifold')")
    holds("!viewer.state.probe.on", "and the page goes on without")
    checks.quiet("broken probe")


def work_section(browser, checks, page):
    """The cut through a contact space, coloured by what the metrics say."""
    holds, changes = checks.holds, checks.changes
    browser.open(page)
    holds("document.getElementById('map').value === '' && "
          "document.getElementById('map-key').hidden", "no colours at first")
    for kind in ("euclidean", "phong", "ratio", "angle"):
        browser.run("viewer.map.cells = 0")
        changes(lambda kind=kind: (
            browser.run(entered("map", kind)),
            browser.wait("viewer.map.cells === kMapCells")),
            f"colours of the cut by {kind}")
        holds("viewer.state.clip.on", "colours want a cut")
        holds("!document.getElementById('map-key').hidden && "
              "document.getElementById('map-high').textContent !== ''",
              f"{kind}: the key tells the range")
    # By the other route: the deepest point of the plane, by the probe's own
    # queries, a step of the grid apart at most.
    browser.run(entered("map", "euclidean"))
    browser.wait("viewer.map.cells === kMapCells && "
                 "viewer.map.key.startsWith('euclidean')")
    holds("""(() => {
      const {min, max} = viewer.map.box, {probe} = viewer.probe;
      const z = viewer.stage.clipLevel(viewer.state.clip);
      const n = 60, scale = viewer.data.scale;
      let most = 0;
      for (let i = 0; i <= n; ++i) for (let j = 0; j <= n; ++j) {
        const p = [min.x + i / n * (max.x - min.x),
                   min.y + j / n * (max.y - min.y), z];
        const q = p.map((x, k) => x * scale + viewer.data.center[k]);
        most = Math.max(most, -probe.answers(q)[0].distance);
      }
      const step = scale * Math.max(max.x - min.x, max.y - min.y) / n;
      return Math.abs(viewer.map.range.high - most) < step;
    })()""", "the key's end is the greatest depth of the plane")
    browser.open_link(page)
    browser.wait("viewer.map.cells === kMapCells")
    holds("viewer.state.map === 'euclidean'", "a link keeps the colours")
    browser.press("c")
    holds("!viewer.map.mesh.visible && "
          "document.getElementById('map-key').hidden",
          "without a cut there are no colours")
    checks.quiet("section")


def work_surface(browser, checks, page):
    """The contact surface, coloured by what the metrics say below it."""
    holds, changes = checks.holds, checks.changes
    browser.open(page)
    holds("document.getElementById('surface').value === '' && "
          "document.getElementById('surface-key').hidden && "
          "!viewer.surface.mesh.visible", "no colours at first")
    done = "viewer.surface.range && viewer.surface.left === null"
    for kind in ("lean", "angle", "ratio", "phong", "euclidean"):
        changes(lambda kind=kind: (
            browser.run(entered("surface", kind)), browser.wait(done)),
            f"colours of the surface by {kind}")
        holds("!document.getElementById('surface-key').hidden && "
              "document.getElementById('surface-high').textContent !== ''",
              f"{kind}: the key tells the range")
    # By another route: below a facet by h the nearest way out is h long, or
    # shorter; in the middle of large facets that is it.
    holds("""(() => {
      const {values, samples} = viewer.surface;
      const h = 0.05 * viewer.data.probe.length;
      const inside = values.filter(Number.isFinite);
      return inside.length > 0.9 * samples.length &&
          inside.every(v => v > 0 && v < h * (1 + 1e-9)) &&
          Math.max(...inside) > h * (1 - 1e-9) &&
          document.getElementById('surface-high').textContent
              .includes(viewer.text(Math.max(...inside)));
    })()""", "no depth is more than that of the place, and some are it")
    changes(lambda: (browser.run(entered("below", "0.2")),
                     browser.wait(done)), "another depth of the question")
    browser.open_link(page)
    browser.wait(done)
    holds("viewer.state.surface === 'euclidean' && viewer.state.below === 0.2",
          "a link keeps the colours")
    browser.run(entered("surface", "bend"))
    holds("!viewer.surface.mesh.visible && viewer.stage.isBend && "
          "viewer.stage.solids[0].faces[0].visible && "
          "document.getElementById('surface-below').hidden && "
          "document.getElementById('surface-key').hidden",
          "curvature takes their place")
    browser.open_link(page)
    holds("viewer.state.surface === 'bend' && viewer.stage.isBend",
          "a link keeps curvature")
    checks.quiet("surface")
