#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""view_serve_kinds_test.py PHONGPD FOLDER: `view --serve` of robots that turn and
of several robots, and the end of a question by Cancel.

Boxes against boxes, so that what is right is known without the library.  Exits
with 77, "skipped", where the program was built without what serves.
"""
import json
import math
import pathlib
import sys
import threading
import time
import unittest

from serving import Served, run_in, run_tests

PROGRAM, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"
QUARTER = [math.sqrt(0.5), 0, 0, math.sqrt(0.5)]  # about z
# A bar of length 4 in x before a wall 1 thick, by which it can go.
BAR = {"name": "bar",
       "robot": {"turns": True, "shape": {"type": "box", "size": [4, 1, 1]}},
       "obstacles": [{"id": "wall",
                      "shape": {"type": "box", "size": [1, 6, 6]}}],
       "start": [-4, 0, 0], "goal": [4, 0, 0], "planning": {"time_limit": 30}}
# Nothing is known of it within hours.
KNOT = {"type": "knot", "size": 1.0, "tube": 0.2, "around": 96, "across": 24}
KNOTS = {"name": "knots", "robot": {"shape": KNOT},
         "obstacles": [{"id": "knot", "shape": KNOT}],
         "start": [-20, 0, 0], "goal": [20, 0, 0],
         "planning": {"model": "full"}}


def run(*arguments):
    return run_in(PROGRAM, FOLDER, *arguments)


def written(scene):
    path = FOLDER / f"{scene['name']}.json"
    path.write_text(json.dumps(scene))
    return str(path)


class Turning(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.served = Served(PROGRAM, FOLDER, written(BAR))

    @classmethod
    def tearDownClass(cls):
        cls.served.stop()

    def question(self, **more):
        return {"what": "plan", "start": BAR["start"], "goal": BAR["goal"], **more}

    def test_its_page_knows_that_it_turns(self):
        text = self.served.ask("GET", self.served.path)[2]
        data = json.loads(text.split('id="view-data">')[1].split("</script>")[0])
        self.assertEqual(data["task"]["kind"], "turns")
        self.assertTrue(data["task"]["served"])

    def test_a_plan_is_the_row_of_the_command(self):
        status, reply = self.served.solve(self.question())
        self.assertEqual(status, 200, reply)
        row = json.loads(run("plan", written(BAR), "--json").stdout)
        self.assertEqual(list(reply["row"]), list(row), "the same keys")
        self.assertEqual(reply["row"]["path"], row["path"])
        self.assertTrue(reply["row"]["solved"])
        path = reply["paths"][0]
        self.assertEqual(len(path["points"]), len(path["turns"]))
        self.assertEqual(path["points"][0], BAR["start"])
        self.assertEqual(path["points"][-1], BAR["goal"])

    def test_it_is_turned_at_its_ends_as_asked(self):
        status, reply = self.served.solve(self.question(
            start=[-1.2, 0, 0], start_turn=QUARTER, goal_turn=QUARTER))
        self.assertEqual(status, 200, reply)
        row = reply["row"]
        self.assertTrue(row["solved"], row["reason"])
        self.assertEqual(row["path"][0], [-1.2, 0, 0, *QUARTER])
        self.assertEqual(row["path"][-1], [*BAR["goal"], *QUARTER])
        # The wall ends at 3: the bar has passed it with 0.5 to its middle.
        self.assertTrue(any(max(abs(p[1]), abs(p[2])) > 3.4 for p in row["path"]))

    def test_a_shorter_path_is_no_longer_than_the_plan(self):
        plan = self.served.solve(self.question())[1]["row"]
        status, reply = self.served.solve(self.question(what="optimize"))
        self.assertEqual(status, 200, reply)
        self.assertTrue(reply["row"]["solved"])
        self.assertLessEqual(reply["row"]["path_length"],
                             plan["path_length"] * (1 + 1e-9))

    def test_an_end_in_the_wall_names_triangles_and_depth(self):
        # From x = −0.5 to 3.5: one deep in the wall, which ends at 0.5.
        status, reply = self.served.solve(self.question(start=[1.5, 0, 0]))
        self.assertEqual(status, 200, reply)
        row = reply["row"]
        self.assertFalse(row["solved"])
        self.assertEqual(row["status"], "start_in_collision")
        self.assertRegex(row["reason"], r"^the start is not free: triangle \d+ of "
                         r"the robot meets triangle \d+ of the obstacles, 1 deep$")
        self.assertAlmostEqual(row["depth"], 1.0, 9)
        # Turned by a quarter it is from 1 to 2, and free.
        status, reply = self.served.solve(
            self.question(start=[1.5, 0, 0], start_turn=QUARTER))
        self.assertTrue(reply["row"]["solved"], reply["row"]["reason"])

    def test_a_depth_is_of_the_pose(self):
        for turn, deep, apart in (([1, 0, 0, 0], 1.0, 0.0), (QUARTER, 0.0, 0.5)):
            status, reply = self.served.solve(
                {"what": "depth", "start": [1.5, 0, 0], "start_turn": turn})
            self.assertEqual(status, 200, reply)
            self.assertEqual(reply["rows"][0]["obstacle"], "wall")
            answer = reply["answers"][0]
            self.assertAlmostEqual(answer["depth"], deep, 9)
            self.assertAlmostEqual(answer["clearance"], apart, 9)
            self.assertEqual(answer["orientation"], turn)


def overlap(a, b, sizes):
    """Of two boxes, by the distance of their middles and half the sizes."""
    return all(abs(p - q) < s for p, q, s in zip(a, b, sizes))


class Fleet(unittest.TestCase):
    """Carriages of examples/robots.json: two of 80 x 80 x 60 and a prism of
    radius 35, past a column of 60 x 60 x 100 at (400, 300, 50)."""
    @classmethod
    def setUpClass(cls):
        cls.served = Served(PROGRAM, FOLDER, str(EXAMPLES / "robots.json"))

    @classmethod
    def tearDownClass(cls):
        cls.served.stop()

    def moved(self, *robots):
        return self.served.solve({"what": "optimize", "robots": [
            {"id": name, "start": start, "goal": goal}
            for name, start, goal in robots]})

    def test_its_page_knows_all_ends(self):
        text = self.served.ask("GET", self.served.path)[2]
        data = json.loads(text.split('id="view-data">')[1].split("</script>")[0])
        self.assertEqual(data["task"]["kind"], "robots")
        self.assertEqual([(e["robot"], e["start"], e["goal"]) for e in data["ends"]],
                         [("left", [60, 200, 30], [740, 200, 30]),
                          ("right", [740, 200, 30], [60, 200, 30]),
                          ("feeder", [400, 60, 30], [400, 540, 30])])

    def test_motions_of_all_keep_apart(self):
        goal = [640, 480, 30]
        status, reply = self.moved(("left", [60, 120, 30], goal))
        self.assertEqual(status, 200, reply)
        row = reply["row"]
        self.assertTrue(row["certified"], row["reason"])
        self.assertEqual([robot["id"] for robot in row["robots"]],
                         ["left", "right", "feeder"])
        paths = reply["paths"]
        self.assertEqual([path["name"] for path in paths],
                         ["left", "right", "feeder"])
        for path in paths:
            self.assertAlmostEqual(path["pace"]["duration"], row["duration"], 9)
        for x, y in zip(paths[0]["points"][0], [60, 120, 30]):
            self.assertAlmostEqual(x, y, 6)
        for x, y in zip(paths[0]["points"][-1], goal):
            self.assertAlmostEqual(x, y, 6)
        for left, right in zip(paths[0]["points"], paths[1]["points"]):
            self.assertFalse(overlap(left, right, (80, 80, 60)))
            for carriage in (left, right):
                self.assertFalse(overlap(carriage, (400, 300, 50), (70, 70, 80)))
        self.assertRegex(reply["closest"], r"^\w+ and \w+, \S+ mm at t = \S+ s$")

    def test_ends_that_touch_are_told_in_one_line(self):
        status, reply = self.moved(("left", [700, 200, 30], [740, 200, 30]))
        self.assertEqual(status, 400, reply)
        self.assertIn('"left" at (700', reply["error"])
        self.assertIn('"right" at (740', reply["error"])
        self.assertNotIn("\n", reply["error"])

    def test_a_start_in_the_column_names_triangles_and_depth(self):
        status, reply = self.moved(("left", [400, 300, 30], [60, 400, 30]))
        self.assertEqual(status, 200, reply)
        self.assertFalse(reply["row"]["solved"])
        self.assertIn("deep in column", reply["row"]["reason"])
        self.assertRegex(reply["collision"], r"^left: triangle \d+ of the robot "
                         r"meets triangle \d+ of column$")

    def test_a_depth_is_of_the_robot_that_is_named(self):
        # Shortest downwards: half of 100 and 60, less 20 between the middles.
        status, reply = self.served.solve(
            {"what": "depth", "robot": "left", "start": [400, 300, 30]})
        self.assertEqual(status, 200, reply)
        self.assertAlmostEqual(reply["rows"][0]["depth"], 60.0, 6)
        # The prism of height 60 has the same height.
        reply = self.served.solve(
            {"what": "depth", "robot": "feeder", "start": [400, 300, 30]})[1]
        self.assertAlmostEqual(reply["rows"][0]["depth"], 60.0, 6)

    def test_what_it_does_not_have_is_told(self):
        for question, words in (
                ({"what": "plan", "robots": []}, "/what"),
                ({"what": "optimize"}, "/robots"),
                ({"what": "depth", "robot": "up", "start": [0, 0, 0]}, "/robot"),
                ({"what": "optimize", "robots": [],
                  "options": {"planner": "prm"}}, "/options/planner")):
            status, reply = self.served.solve(question)
            self.assertEqual(status, 400, reply)
            self.assertIn(words, reply["error"])

    def test_obstacles_that_move_come_along(self):
        box = {"shape": {"type": "box", "size": [10, 10, 10]}}
        scene = {"name": "crossing", "unit": "mm", "robot": box,
                 "obstacles": [{"id": "far", "position": [0, 200, 0], **box}],
                 "moving": [{"id": "cart", **box, "motion": [
                     {"duration": 4, "points": [[0, -60, 0], [0, 60, 0]]}]}],
                 "start": [-80, 0, 0], "goal": [80, 0, 0],
                 "limits": {"velocity": 100, "acceleration": 400, "jerk": 4000}}
        with Served(PROGRAM, FOLDER, written(scene)) as served:
            status, reply = served.solve({"what": "optimize", "start": [-80, 0, 0],
                                          "goal": [90, 0, 0]})
        self.assertEqual(status, 200, reply)
        self.assertTrue(reply["row"]["certified"], reply["row"])
        path, mover = reply["paths"][0], reply["movers"][0]
        self.assertEqual(mover["name"], "cart")
        last = len(path["points"]) - 1
        self.assertEqual(len(mover["points"]), last + 1)
        for i, (q, p) in enumerate(zip(path["points"], mover["points"])):
            t = path["pace"]["duration"] * i / last
            self.assertAlmostEqual(p[1], -60 + 30 * min(t, 4), 6)
            self.assertFalse(overlap(q, p, (10, 10, 10)))


def closed(seconds):
    """The file of a tunnel that no sampler finds through, however long."""
    path = FOLDER / f"closed{seconds}.json"
    run("scenes", "write", "tunnel", "--set", "delta=0.001", "--set",
        "bends=3", "--set", "twin=1", "--output", str(path))
    scene = json.loads(path.read_text())
    scene.setdefault("planning", {})["time_limit"] = seconds
    path.write_text(json.dumps(scene))
    return str(path)


def sampled(path):
    scene = json.loads(pathlib.Path(path).read_text())
    return {"what": "plan", "start": scene["start"], "goal": scene["goal"],
            "options": {"planner": "rrt-connect"}}


def shut_in(seconds):
    """The bar in a box that is closed on all sides; the goal is outside."""
    walls = [{"id": f"wall {axis} {side}",
              "position": [6 * side * (k == axis) for k in range(3)],
              "shape": {"type": "box",
                        "size": [1 if k == axis else 14 for k in range(3)]}}
             for axis in range(3) for side in (-1, 1)]
    return {**BAR, "name": f"shut{seconds}", "obstacles": walls,
            "start": [0, 0, 0], "goal": [20, 0, 0],
            "planning": {"time_limit": seconds}}


class Cancel(unittest.TestCase):
    def cancel(self, served):
        status, _, text = served.ask(
            "POST", served.path + "cancel",
            {"Content-Type": "application/json", "Content-Length": "2"}, b"{}")
        self.assertEqual(status, 200, text)
        return json.loads(text)["cancelled"]

    def ends(self, scene, question):
        """Asks, cancels once it is worked at, and asks something else."""
        with Served(PROGRAM, FOLDER, scene, "--no-cache", "--time",
                    "36000") as served:
            self.assertFalse(self.cancel(served), "there is nothing to cancel")
            found = []

            def ask():
                reply = served.solve(question)
                while reply[0] == 503:  # by a question of the loop below
                    reply = served.solve(question)
                found.append(reply)

            thread = threading.Thread(target=ask)
            thread.start()
            while served.solve({**question, "what": "draw"})[0] != 503:
                time.sleep(0.05)
            time.sleep(1.0)
            self.assertTrue(self.cancel(served))
            thread.join()
            status, reply = found[0]
            self.assertEqual(status, 409, reply)
            self.assertEqual(reply, {"error": "cancelled"})
            # The worker is free, and answers.
            status, reply = served.solve({**question, "what": "draw"})
            self.assertEqual(status, 400, reply)

    def test_contact_surface_while_it_builds(self):
        self.ends(written(KNOTS), {"what": "plan", "start": KNOTS["start"],
                                   "goal": KNOTS["goal"],
                                   "options": {"planner": "contact-surface"}})

    def test_a_depth(self):
        self.ends(written(KNOTS), {"what": "depth", "start": [0, 0, 0]})

    def test_a_trajectory_while_it_builds(self):
        self.ends(written({**KNOTS, "trajectory": {"model": "full"}}),
                  {"what": "optimize", "start": KNOTS["start"],
                   "goal": KNOTS["goal"]})

    def test_a_sampler_that_finds_nothing(self):
        scene = closed(36000)
        self.ends(scene, sampled(scene))

    def test_a_robot_that_turns_and_finds_nothing(self):
        shut = shut_in(36000)
        self.ends(written(shut), {"what": "plan", "start": shut["start"],
                                  "goal": shut["goal"]})


class Limit(unittest.TestCase):
    """What a search within --time has to say is said, not only that it is over."""
    def says(self, scene, question):
        with Served(PROGRAM, FOLDER, scene, "--time", "3") as served:
            # The first builds what all need.
            for _ in range(2):
                status, reply = served.solve(question)
            self.assertEqual(status, 200, reply)
            return reply["row"]

    def test_a_sampler_that_finds_nothing(self):
        scene = closed(5)
        row = self.says(scene, sampled(scene))
        self.assertEqual(row["status"], "time_limit", row)
        self.assertFalse(row["solved"])

    def test_a_robot_that_turns_and_finds_nothing(self):
        shut = shut_in(60)
        row = self.says(written(shut), {"what": "plan", "start": shut["start"],
                                        "goal": shut["goal"]})
        self.assertEqual(row["status"], "time_limit", row)
        self.assertRegex(row["reason"], r"within 2\.7 s")


if __name__ == "__main__":
    sys.exit(run_tests(PROGRAM, FOLDER))
