#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""viewer_browser_test.py PHONGPD FOLDER [--renew|--served]: pages in a real browser.

Makes pages by the program, opens them in headless Chromium with a software
renderer, and works their controls by mouse and keys through the browser's
debugging pipe.  Fails on any console message, on a blank canvas and on a
control that does not do what it says, and where a reference view is not the
picture that it was (viewer_references.py; --renew draws those anew and tests
nothing).  --served: the pages that view --serve serves, and no others.
Screenshots stay in FOLDER.  Exits with 77, "skipped", without the
browser (scripts/setup.sh chromium).
"""
import os
import pathlib
import shutil
import subprocess
import sys

import viewer_references
from browser import Browser, Checks
from viewer_controls import work_controls, work_iterations, work_overlays
from viewer_metrics import (probe_like_the_program, work_probe, work_section,
                            work_surface)
from viewer_served import work_kinds
from viewer_solver import work_solver
from viewer_task import (chart_of_a_motion, labels_beside_the_panel,
                         page_in_a_page, work_phone, work_served, work_task)

# Seconds that are played between two pictures 0.4 s apart, and a minute: the page's
# own step, by times that are given to it, not by the clock of a busy machine.
PLAYED = """new Promise(done => {
  const real = window.requestAnimationFrame;
  let step;
  window.requestAnimationFrame = f => { step = f; };
  real(() => {
    const {state, pace, last} = viewer;
    state.time = 0;
    state.playing = true;
    step(last + 400);
    const slow = state.time * pace.duration;
    step(last + 60400);
    state.playing = false;
    viewer.last = performance.now();
    window.requestAnimationFrame = real;
    real(step);
    done([slow, state.time * pace.duration - slow]);
  });
})"""


def runner(program, folder):
    """Runs the program in the folder."""
    def run(*arguments, fails=False):
        done = subprocess.run(
            [program, *arguments], cwd=folder, capture_output=True, text=True,
            env={**os.environ, "PHONGPD_CACHE_DIR": str(folder / "cache")},
            check=False)
        if done.returncode > 1 and not fails:
            sys.exit(f"phongpd {' '.join(arguments)}: {done.stderr}")
        return done.stderr
    return run


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
    # A page shows what lies behind a run where its own command writes it.
    run("plan", "u_axis", "--output", "routes.jsonl", "--html", "routes.html")
    run("plan", "tunnel:delta=0.05", "--planner", "retraction-forest",
        "--output", "tree.jsonl", "--html", "tree.html")
    run("plan", "hole:delta=0.1", "--planner", "prm", "--time", "0.5",
        "--output", "roadmap.jsonl", "--html", "roadmap.html")
    run("optimize", "u_axis", "--polish", "always", "--output",
        "corridor.jsonl", "--html", "corridor.html")
    examples = pathlib.Path(__file__).resolve().parents[2] / "examples"
    run("optimize", str(examples / "gantry.json"), "--html", "pace.html")
    run("optimize", str(examples / "robots.json"), "--html", "robots.html")
    run("plan", str(examples / "turning.json"), "--html", "turning.html")
    run("plan", "tunnel:delta=0.001,bends=3,twin=1", "--output", "proof.jsonl",
        "--html", "proof.html")
    (folder / "none.jsonl").write_text(
        '{"scene": "none", "planner": "prm", "seed": 1, "status": "timeout",'
        ' "solved": false, "path": []}\n')
    run("view", "none.jsonl", "--html", "none.html")
    return {name: folder / f"{name}.html"
            for name in ("trap", "tunnel", "contact", "motion", "depth", "routes",
                         "tree", "roadmap", "corridor", "pace", "robots", "turning",
                         "proof", "none")}


def robots_together(browser, checks, page):
    """Each where its own motion is at that time, whichever is followed."""
    browser.open(page)
    checks.holds("viewer.stage.crew.robots.length === 3 &&"
                 "!viewer.stage.robot.visible", "three robots of their own")
    checks.holds("(() => { viewer.state.time = 0.5; viewer.draw();"
                 "const {crew, center} = viewer.stage, {scale} = viewer.data;"
                 "return crew.robots.every(({way, group}) => {"
                 "const p = way.raw[(way.raw.length - 1) / 2];"
                 "return p.every((x, k) => Math.abs(center.getComponent(k) +"
                 "scale * group.position.getComponent(k) - x) < 1e-6 * scale);"
                 "}); })()", "all of them at one time")
    checks.holds("(() => { const at = crew => crew.robots.map("
                 "r => r.group.position.toArray().join()).join();"
                 "const before = at(viewer.stage.crew); viewer.follow(2);"
                 "viewer.draw(); return viewer.state.way === 2 &&"
                 "before === at(viewer.stage.crew); })()",
                 "following another one moves none")
    checks.holds("(() => { const {crew, labels} = viewer.stage;"
                 "return crew.robots.every(({group}, i) => labels.some(l => "
                 "l.way === i && crew.placeOf(l.way) === group.position)); })()",
                 "each robot has its name where it is")
    checks.holds("[...document.querySelectorAll('button.way span')].map("
                 "e => e.textContent).join() === 'left,right,feeder'",
                 "their names in the legend")


def a_proof(browser, checks, page):
    """That there is no way is said first, and seen through the solids."""
    browser.open(page)
    checks.holds("document.getElementById('facts').textContent.endsWith("
                 "'proved: there is no way') && viewer.state.xray",
                 "no way, proved")


def a_robot_that_turns(browser, checks, page):
    """As its path says, at both ends and between them."""
    browser.open(page)
    checks.holds("[0, 1].every(t => { viewer.state.time = t; viewer.draw();"
                 "const {turns} = viewer.stage.ways[0];"
                 "return viewer.stage.robot.quaternion.angleTo("
                 "turns[t * (turns.length - 1)]) < 1e-6; })",
                 "as it is turned at its ends")
    checks.holds("(() => { const seen = new Set();"
                 "for (let t = 0; t <= 1; t += 0.05) { viewer.state.time = t;"
                 "viewer.draw(); seen.add(viewer.stage.robot.quaternion.toArray()"
                 ".map(x => x.toFixed(2)).join()); } return seen.size; })() > 5",
                 "it turns on its way")


def see_served(browser, checks, run, program, folder):
    """1 where a served page does not do what it says; 77 where none is served."""
    try:
        if "libcpp-httplib-dev" in run("view", "u_axis", "--serve", "--port", "1",
                                       "--html", "x.html", fails=True):
            print("Skipped: pages that are served, which this build does not")
            return 77
        work_served(browser, checks, program, folder)
        work_kinds(browser, checks, program, folder)
    finally:
        browser.close()
    print(f"{len(checks.failures)} failures; screenshots in {folder}")
    return 1 if checks.failures else 0


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    chromium = next(filter(None, map(shutil.which, (
        "chromium", "chromium-browser", "google-chrome"))), None)
    if chromium is None:
        print("Skipped: no browser; install it by scripts/setup.sh chromium")
        return 77
    folder.mkdir(parents=True, exist_ok=True)
    run = runner(program, folder)
    if "--served" in sys.argv[3:]:
        browser = Browser(chromium)
        return see_served(browser, Checks(browser), run, program, folder)
    pages = make_pages(run, folder)
    browser = Browser(chromium)
    checks = Checks(browser)
    if "--renew" in sys.argv[3:]:
        viewer_references.renew(browser, folder)
        browser.close()
        return 0
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
            checks.drawn(name)
            checks.tidy(name)
            browser.shoot(folder / f"{name}-light.png")
            browser.open(page, theme="dark")
            checks.holds("viewer.state.theme === 'dark'",
                         f"{name}: dark where the reader prefers it")
            checks.drawn(name + ", dark")
            browser.shoot(folder / f"{name}-dark.png")
            # A slider that is there can be taken, whatever the width.
            for width in (320, 400, 759, 761, 800, 850, 900, 1000, 1101, 1280):
                browser.resize(width)
                checks.holds("[...document.querySelectorAll('#scrub, "
                             "#scrub-iterate')].every(e => !e.offsetParent || "
                             "e.getBoundingClientRect().width >= 100)",
                             f"{name}: sliders have room at {width}")
            browser.open(page, width=390, height=800)
            checks.holds("document.documentElement.scrollWidth <= 390 && "
                         "[...document.querySelectorAll('header, #tools, "
                         "#player, #scalebar')].every(e => "
                         "e.getBoundingClientRect().right <= 390 && "
                         "e.getBoundingClientRect().left >= 0)",
                         f"{name}: fits a phone")
            checks.drawn(name + ", narrow")
            checks.tidy(name + ", narrow")
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
        browser.open(pages["pace"])
        checks.holds("(() => { viewer.state.time = 0; viewer.state.playing = true;"
                     "viewer.advance(0.25 * viewer.pace.duration);"
                     "viewer.state.playing = false;"
                     "return Math.abs(viewer.state.time - 0.25) < 1e-9; })()",
                     "a motion plays in its own time")
        checks.holds("document.getElementById('where').textContent"
                     ".includes('room')", "and says what it asks and has")
        slow, hidden = browser.run(PLAYED)
        checks.expect(abs(slow - 0.4) < 1e-9 and abs(hidden - 0.5) < 1e-9,
                      f"a slow picture plays {slow} s, a hidden page {hidden} s")
        # Not at the place where it rests.
        browser.run("viewer.set(() => { const {velocity} = viewer.pace;"
                    "viewer.state.time = velocity.indexOf(Math.max(...velocity)) /"
                    "velocity.length; })")
        checks.changes(lambda: browser.press("ArrowRight"), "a step of it")
        robots_together(browser, checks, pages["robots"])
        a_robot_that_turns(browser, checks, pages["turning"])
        a_proof(browser, checks, pages["proof"])
        for name in ("turning", "trap"):
            browser.open(pages[name])
            checks.holds("![...document.querySelectorAll('button.way small, "
                         "#where')].some(e => e.textContent.includes('NaN'))",
                         f"{name}: lengths are numbers")
        browser.open(pages["motion"])
        checks.holds("document.querySelectorAll('#labels .pane').length === 3",
                     "a motion has a pane for each metric")
        checks.changes(lambda: browser.press("ArrowLeft"), "a frame of motion")
        chart_of_a_motion(browser, checks, pages["motion"])
        labels_beside_the_panel(browser, checks, pages["trap"])
        work_task(browser, checks, pages["trap"])
        work_solver(browser, checks, program, folder, pages)
        browser.open(pages["motion"])
        if browser.run("viewer.data.probe !== null"):
            work_phone(browser, checks, pages["trap"], folder)
            browser.open(pages["motion"])
            probe_like_the_program(browser, checks, run, folder)
            browser.shoot(folder / "probe-light.png")
            work_probe(browser, checks, pages["motion"])
            work_section(browser, checks, pages["contact"])
            work_surface(browser, checks, pages["contact"])
            viewer_references.compare(browser, checks, folder)
        else:
            # The reference of the cut's colours needs it, too.
            print("Skipped: the live probe, which this build is without, and "
                  "the reference views", flush=True)
        work_overlays(browser, checks, pages)
        work_iterations(browser, checks, pages["corridor"])
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
        checks.expect("no WebGL" in text and "PhongPD, ℓ = 0.2" in text,
                      "without WebGL the page tells in words: " + text)
    finally:
        bare.close()
    checks.failures += page_in_a_page(chromium, Checks, pages["trap"], folder)
    print(f"{len(checks.failures)} failures; screenshots in {folder}")
    return 1 if checks.failures else 0


if __name__ == "__main__":
    sys.exit(main())
