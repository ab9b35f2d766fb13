#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""viewer_browser_test.py PHONGPD FOLDER: pages in a real browser.

Makes pages by the program, opens them in headless Chromium with a software
renderer, and works their controls by mouse and keys through the browser's
debugging pipe.  Fails on any console message, on a blank canvas and on a
control that does not do what it says.  Screenshots stay in FOLDER.  Exits with
77, "skipped", without the browser (scripts/setup.sh chromium).
"""
import base64
import csv
import json
import math
import os
import pathlib
import select
import shutil
import subprocess
import sys
import tempfile
import time

PATIENCE = 60.0  # seconds; machines that test are busy


class Browser:
    """Chromium, by its debugging protocol over pipes 3 and 4."""

    def __init__(self, program, *more):
        self.profile = tempfile.mkdtemp(prefix="phongpd-browser-")
        (self.inbox, to_us), (to_it, self.outbox) = os.pipe(), os.pipe()

        def wire():
            # Above the fixed numbers first: either may be one of them.
            to, of = os.dup2(to_it, 20), os.dup2(to_us, 21)
            os.dup2(to, 3)
            os.dup2(of, 4)

        root = ["--no-sandbox"] if os.geteuid() == 0 else []
        self.process = subprocess.Popen(
            [program, "--headless=new", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", "--remote-debugging-pipe",
             "--no-first-run", "--disable-extensions",
             "--disable-dev-shm-usage", "--user-data-dir=" + self.profile]
            + root + list(more) + ["about:blank"],
            preexec_fn=wire, close_fds=False, stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_us)
        os.close(to_it)
        self.buffer, self.count, self.session = b"", 0, None
        self.messages = []
        target = self.call("Target.createTarget", url="about:blank")
        self.session = self.call("Target.attachToTarget", flatten=True,
                                 targetId=target["targetId"])["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.call(domain + ".enable")

    def close(self):
        self.process.terminate()
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        shutil.rmtree(self.profile, ignore_errors=True)

    def receive(self, deadline):
        while b"\0" not in self.buffer:
            left = deadline - time.monotonic()
            if left <= 0 or not select.select([self.inbox], [], [], left)[0]:
                raise TimeoutError("the browser does not answer")
            piece = os.read(self.inbox, 1 << 20)
            if not piece:
                raise EOFError("the browser has ended")
            self.buffer += piece
        message, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(message)

    def call(self, method, **parameters):
        self.count += 1
        request = {"id": self.count, "method": method, "params": parameters}
        if self.session:
            request["sessionId"] = self.session
        os.write(self.outbox, json.dumps(request).encode() + b"\0")
        deadline = time.monotonic() + PATIENCE
        while True:
            message = self.receive(deadline)
            if message.get("id") == self.count:
                if "error" in message:
                    raise RuntimeError(f"{method}: {message['error']}")
                return message["result"]
            self.note(message)

    def note(self, message):
        what, of = message.get("method"), message.get("params", {})
        if what == "Runtime.consoleAPICalled":
            self.messages.append(
                " ".join(str(a.get("value", a.get("description")))
                         for a in of["args"]))
        elif what == "Runtime.exceptionThrown":
            details = of["exceptionDetails"]
            self.messages.append(details.get("exception", {}).get(
                "description", details["text"]))
        elif what == "Log.entryAdded":
            self.messages.append(of["entry"]["text"])

    def run(self, script):
        """The value of an expression in the page."""
        result = self.call("Runtime.evaluate", expression=script,
                           returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise RuntimeError(script + ": " + str(result["exceptionDetails"]))
        return result["result"].get("value")

    def wait(self, script):
        deadline = time.monotonic() + PATIENCE
        while not self.run(script):
            if time.monotonic() > deadline:
                raise TimeoutError("never true: " + script)
            time.sleep(0.05)

    def open(self, path, link="", width=1280, height=800, theme="light"):
        self.call("Emulation.setDeviceMetricsOverride", width=width,
                  height=height, deviceScaleFactor=1, mobile=False)
        self.call("Emulation.setEmulatedMedia", features=[
            {"name": "prefers-color-scheme", "value": theme}])
        self.call("Page.navigate", url="about:blank")
        self.call("Page.navigate", url=f"file://{path}{link}")
        self.wait("(document.documentElement && "
                  "document.documentElement.dataset.ready === '1') || "
                  "(document.readyState === 'complete' && "
                  "!!document.querySelector('.instead'))")

    def shoot(self, path):
        shot = self.call("Page.captureScreenshot", format="png")
        pathlib.Path(path).write_bytes(base64.b64decode(shot["data"]))

    def mouse(self, kind, x, y, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def click(self, selector):
        x, y = self.run(
            "(() => { const e = document.querySelector('" + selector + "');"
            "e.scrollIntoView({block: 'nearest'});"
            "const b = e.getBoundingClientRect();"
            "return [b.left + b.width / 2, b.top + b.height / 2]; })()")
        for kind in ("mousePressed", "mouseReleased"):
            self.mouse(kind, x, y, button="left", clickCount=1)

    def press(self, key):
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key)


# How the canvas looks, in 128 by 80 fields: only what is drawn, without ground.
LOOK = """(() => {
  viewer.draw();
  const small = document.createElement('canvas');
  [small.width, small.height] = [128, 80];
  const g = small.getContext('2d', {willReadFrequently: true});
  g.drawImage(document.getElementById('canvas'), 0, 0, 128, 80);
  return [...g.getImageData(0, 0, 128, 80).data];
})()"""


class Checks:
    def __init__(self, browser):
        self.browser, self.failures = browser, []

    def expect(self, is_true, claim):
        if not is_true:
            self.failures.append(claim)
            print("FAILED:", claim, flush=True)

    def holds(self, script, claim):
        self.expect(self.browser.run(script), f"{claim} ({script})")

    def quiet(self, name):
        for message in self.browser.messages:
            self.expect(False, f"{name}: the console says {message}")
        self.browser.messages.clear()

    def changes(self, act, claim):
        before = self.browser.run(LOOK)
        act()
        after = self.browser.run(LOOK)
        difference = sum(abs(a - b) for a, b in zip(before, after))
        self.expect(difference > 400, f"{claim} changes the picture")

    def drawn(self, name):
        look = self.browser.run(LOOK)
        fields = {tuple(look[i:i + 4]) for i in range(0, len(look), 4)}
        self.expect(len(fields) > 20, f"{name}: the canvas is not blank")


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
    changes(lambda: browser.click("#xray"), "seeing through solids")
    browser.press("o")
    holds("!viewer.state.xray", "O ends it")
    changes(lambda: browser.click("#bend"), "colour by curvature")
    holds("!document.getElementById('bend-key').hidden", "its key is shown")
    browser.click("#bend")

    changes(lambda: browser.click("#clip-on"), "cutting")
    changes(lambda: browser.click("#clip-flip"), "the other side of the cut")
    changes(lambda: browser.run(
        "(() => { const e = document.getElementById('clip-at'); e.value = 250;"
        "e.dispatchEvent(new Event('input')); })()"), "moving the plane")
    changes(lambda: browser.run(
        "(() => { const e = document.getElementById('clip-axis');"
        "e.value = 'x'; e.dispatchEvent(new Event('change')); })()"),
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

    browser.run("(() => { const e = document.getElementById('scrub');"
                "e.value = 10000; e.dispatchEvent(new Event('input')); })()")
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
    browser.run("(() => { const e = document.getElementById('speed');"
                "e.value = '4'; e.dispatchEvent(new Event('change')); })()")
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


def runner(program, folder):
    """Runs the program in the folder."""
    def run(*arguments):
        done = subprocess.run(
            [program, *arguments], cwd=folder, capture_output=True, text=True,
            env={**os.environ, "PHONGPD_CACHE_DIR": str(folder / "cache")},
            check=False)
        if done.returncode > 1:
            sys.exit(f"phongpd {' '.join(arguments)}: {done.stderr}")
    return run


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
    browser.run("(() => { const e = document.getElementById('probe-x');"
                "e.value = '0.25'; e.dispatchEvent(new Event('change')); })()")
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


def make_pages(run, folder):
    """Pages of everything the program makes, by name."""
    run("optimize", "u_axis", "--output", "phong.jsonl")
    run("optimize", "u_axis", "--metric", "euclidean", "--start", "straight",
        "--mu-strategy", "monotone", "--polish", "never", "--output",
        "euclid.jsonl")
    run("view", "phong.jsonl", "euclid.jsonl", "--build", "--html", "trap.html")
    run("plan", "tunnel:delta=0.001,bends=3", "--output", "plan.jsonl",
        "--html", "tunnel.html")
    run("scenes", "write", "ball_wrench", "--meshes", ".")
    run("contact-space", "--robot", "robot.off", "--obstacle", "obstacle.off",
        "--output", "contact.off")
    run("view", "contact.off", "--html", "contact.html")
    run("motion", "--robot", "robot.off", "--obstacle", "obstacle.off",
        "--from", "0.3", "-1.2", "0.1", "--to", "0.3", "1.2", "0.05",
        "--frames", "200", "--smoothing-length", "0.1", "--output",
        "motion.csv", "--html", "motion.html")
    run("depth", "robot.off", "obstacle.off", "--at", "0.3", "0.1", "0.1",
        "--json", "--output", "depth.json")
    run("view", "depth.json", "obstacle.off", "--robot", "robot.off", "--html",
        "depth.html")
    (folder / "none.jsonl").write_text(
        '{"scene": "none", "planner": "prm", "seed": 1, "status": "timeout",'
        ' "solved": false, "path": []}\n')
    run("view", "none.jsonl", "--html", "none.html")
    return {name: folder / f"{name}.html"
            for name in ("trap", "tunnel", "contact", "motion", "depth", "none")}


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    chromium = next(filter(None, map(shutil.which, (
        "chromium", "chromium-browser", "google-chrome"))), None)
    if chromium is None:
        print("Skipped: no browser; install it by scripts/setup.sh chromium")
        return 77
    folder.mkdir(parents=True, exist_ok=True)
    run = runner(program, folder)
    pages = make_pages(run, folder)
    browser = Browser(chromium)
    checks = Checks(browser)
    try:
        for name, page in pages.items():
            browser.open(page)
            first = browser.run("document.documentElement.dataset.firstPicture")
            print(f"{name}: first picture after {first} ms", flush=True)
            checks.quiet(name)
            if name == "none":
                checks.holds("document.getElementById('message').textContent"
                             ".startsWith('There is nothing to show')",
                             "an empty page says so")
                continue
            # 2000 on a machine of one's own; tests share theirs.
            checks.expect(int(first) < 10000, f"{name}: late: {first} ms")
            checks.drawn(name)
            browser.shoot(folder / f"{name}-light.png")
            browser.open(page, theme="dark")
            checks.holds("viewer.state.theme === 'dark'",
                         f"{name}: dark where the reader prefers it")
            checks.drawn(name + ", dark")
            browser.shoot(folder / f"{name}-dark.png")
            browser.open(page, width=400, height=800)
            checks.holds("document.documentElement.scrollWidth <= 400 && "
                         "[...document.querySelectorAll('header, #tools, "
                         "#player, #scalebar')].every(e => "
                         "e.getBoundingClientRect().right <= 400 && "
                         "e.getBoundingClientRect().left >= 0)",
                         f"{name}: fits a phone")
            checks.drawn(name + ", narrow")
            browser.shoot(folder / f"{name}-narrow.png")
            checks.quiet(name)
        browser.open(pages["trap"])
        work_controls(browser, checks, pages["trap"])
        browser.open(pages["trap"], "#%E0%A4%A&t=nan")
        browser.open(pages["trap"], "#eye=1,2,x&t=7&way=99&cut=w,3&theme=red")
        checks.holds("viewer.orbit.yaw === viewer.orbit.home.yaw && "
                     "viewer.state.way === 0 && !viewer.state.clip.on && "
                     "viewer.state.theme === 'light'",
                     "what a link has that means nothing is left out")
        browser.open(pages["motion"])
        checks.holds("document.querySelectorAll('#labels .pane').length === 3",
                     "a motion has a pane for each metric")
        checks.changes(lambda: browser.press("ArrowLeft"), "a frame of motion")
        if browser.run("viewer.data.probe !== null"):
            probe_like_the_program(browser, checks, run, folder)
            browser.shoot(folder / "probe-light.png")
            work_probe(browser, checks, pages["motion"])
        else:
            print("Skipped: built without the live probe", flush=True)
        browser.open(pages["depth"])
        checks.holds("document.querySelector('button.way small').textContent"
                     ".startsWith('penetrating, depth ')", "the depth is told")
        checks.quiet("the end")
    finally:
        browser.close()
    bare = Browser(chromium, "--disable-3d-apis")
    try:
        bare.open(pages["trap"])
        text = bare.run("document.getElementById('message').textContent")
        checks.expect("no WebGL" in text and "phong@0.2" in text,
                      "without WebGL the page tells in words: " + text)
    finally:
        bare.close()
    print(f"{len(checks.failures)} failures; screenshots in {folder}")
    return 1 if checks.failures else 0


if __name__ == "__main__":
    sys.exit(main())
