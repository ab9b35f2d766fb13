# SPDX-License-Identifier: GPL-3.0-or-later
"""A headless browser for tests, and what is expected of the pages in it."""
import base64
import json
import os
import pathlib
import select
import shutil
import subprocess
import tempfile
import time

PATIENCE = 60.0  # seconds; machines that test are busy
SOON = 5.0


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

    def set_size(self, width, height):
        self.call("Emulation.setDeviceMetricsOverride", width=width,
                  height=height, deviceScaleFactor=1, mobile=False)

    def resize(self, width, height=800):
        """The open page, until it is laid out anew and drawn."""
        self.set_size(width, height)
        self.wait(f"innerWidth === {width}")
        self.run("new Promise(done => requestAnimationFrame(() => "
                 "requestAnimationFrame(() => done(true))))")

    def open(self, path, link="", width=1280, height=800, theme="light"):
        self.set_size(width, height)
        self.call("Emulation.setEmulatedMedia", features=[
            {"name": "prefers-color-scheme", "value": theme}])
        self.call("Page.navigate", url="about:blank")
        url = str(path) if str(path).startswith("http") else f"file://{path}"
        self.call("Page.navigate", url=url + link)
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

    def open_link(self, page):
        """Of the page as it is now."""
        self.click("#link")
        self.open(page, self.run("location.hash"))

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

# What of the labels is below something, cut off at a side, or above another by
# more than its letters have room for.
BAD_LABELS = """(() => {
  viewer.draw();
  const boxes = e => [...document.querySelectorAll(e)]
      .map(x => [x.textContent, x.getBoundingClientRect()]);
  const meet = (a, b) => a.left < b.right - 2 && b.left < a.right - 2 &&
      a.top < b.bottom - 2 && b.top < a.bottom - 2;
  const labels = boxes('#labels .name');
  const over = boxes('#panel, #tools, #player, #title, #facts, #scalebar')
      .filter(([, b]) => b.width > 0);
  return labels.filter(([, b], i) => b.left < 0 || b.right > innerWidth ||
      over.some(([, o]) => meet(b, o)) ||
      labels.some(([, o], k) => k !== i && meet(b, o))).map(([t]) => t);
})()"""
# What the page lays over the picture and over something else of that, or over the
# window's edge.
BAD_BOXES = """(() => {
  const boxes = [...document.querySelectorAll('#panel, #tools, #player, #reading,'
      + '#title, #facts, #scalebar')]
      .map(e => [e.id, e.getBoundingClientRect()])
      .filter(([, b]) => b.width > 0 && b.height > 0);
  const meet = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom &&
      b.top < a.bottom;
  return boxes.filter(([, b], i) => b.left < 0 || b.right > innerWidth + 1 ||
      b.bottom > innerHeight || boxes.some(([, o], k) => k !== i && meet(b, o)))
      .map(([id]) => id);
})()"""


class Checks:
    def __init__(self, browser):
        self.browser, self.failures = browser, []

    def expect(self, is_true, claim):
        if not is_true:
            self.failures.append(claim)
            print("FAILED:", claim, flush=True)

    def holds(self, script, claim):
        """Now or soon: the page draws what it was told in its next frame."""
        deadline = time.monotonic() + SOON
        while not (is_true := self.browser.run(script)):
            if time.monotonic() > deadline:
                break
            time.sleep(0.05)
        self.expect(is_true, f"{claim} ({script})")

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

    def tidy(self, name):
        """Nothing is above anything else, and names can be read."""
        bad = self.browser.run(BAD_BOXES) + self.browser.run(BAD_LABELS)
        self.expect(not bad, f"{name}: {bad} overlap or are cut off")

    def drawn(self, name):
        look = self.browser.run(LOOK)
        fields = {tuple(look[i:i + 4]) for i in range(0, len(look), 4)}
        self.expect(len(fields) > 20, f"{name}: the canvas is not blank")
