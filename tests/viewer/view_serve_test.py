#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""view_serve_test.py PHONGPD FOLDER: who is answered by `view --serve`, and what.

Asks by sockets, as other programs and pages of other sites can.  Exits with 77,
"skipped", where the program was built without what serves.
"""
import json
import os
import pathlib
import socket
import sys
import threading
import time
import unittest

from serving import Served, run_in, run_tests

PROGRAM, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
PLAN = {"what": "plan", "start": [0, -1.5, 0], "goal": [0, 1.5, 0]}
JSON = {"Content-Type": "application/json"}
# What a sampler looks for in vain until its time is over.
CLOSED = "tunnel:delta=0.001,bends=3,twin=1"


def run(*arguments):
    return run_in(PROGRAM, FOLDER, *arguments)


class Guard(unittest.TestCase):
    """Who is refused, with which status."""

    @classmethod
    def setUpClass(cls):
        cls.served = Served(PROGRAM, FOLDER, "u_axis")

    @classmethod
    def tearDownClass(cls):
        cls.served.stop()

    def refused(self, status, method, path, headers=None, body=None, host=None):
        got, headers, text = self.served.ask(method, path, headers, body, host)
        self.assertEqual(got, status, (method, path, headers, host, text))
        if method == "HEAD":
            return
        self.assertEqual(list(json.loads(text)), ["error"])
        self.assertNotIn("\n", json.loads(text)["error"])
        self.assertNotIn(self.served.path.strip("/"), text, "the token is told")

    def test_page_comes_with_its_own_rules(self):
        status, headers, text = self.served.ask("GET", self.served.path)
        self.assertEqual(status, 200)
        self.assertIn('"served":true', text)
        self.assertNotIn("access-control-allow-origin", headers)
        self.assertIn("connect-src 'self'", headers["content-security-policy"])
        self.assertEqual(headers["x-frame-options"], "DENY")
        self.assertEqual(headers["referrer-policy"], "no-referrer")
        self.assertEqual(headers["cache-control"], "no-store")
        self.assertEqual(headers["connection"], "close")

    def test_token_is_long_and_new_each_time(self):
        token = self.served.path.strip("/")
        self.assertRegex(token, "^[0-9a-f]{32}$")
        with Served(PROGRAM, FOLDER, "u_axis") as other:
            self.assertNotEqual(token, other.path.strip("/"))

    def test_without_the_token(self):
        token = self.served.path.strip("/")
        for path in ("/", "/solve", "/favicon.ico", "/" + "0" * 32 + "/",
                     f"/{token[:-1]}/", f"/{token}0/", f"/{token.upper()}x/",
                     f"/?{token}", f"//{token}/"):
            self.refused(403, "GET", path)
        self.refused(403, "POST", "/solve", {**JSON, "Content-Length": "2"}, b"{}")

    def test_by_another_name(self):
        port = self.served.port
        for host in ("evil.example", f"evil.example:{port}", "127.0.0.1",
                     f"127.0.0.1:{port + 1}", f"localhost:{port}.evil.example",
                     f"0.0.0.0:{port}", "localhost"):
            self.refused(421, "GET", self.served.path, host=host)

    def test_its_own_names_are_let_in(self):
        for name in ("127.0.0.1", "localhost", "[::1]"):
            status, _, _ = self.served.ask(
                "GET", self.served.path, host=f"{name}:{self.served.port}")
            self.assertEqual(status, 200, name)

    def test_of_another_origin(self):
        port = self.served.port
        for origin in ("http://evil.example", "null",
                       f"https://127.0.0.1:{port}", f"http://127.0.0.1:{port + 1}",
                       f"http://127.0.0.1:{port}.evil.example"):
            for method, path in (("GET", ""), ("POST", "solve"), ("OPTIONS", "solve")):
                self.refused(403, method, self.served.path + path,
                             {**JSON, "Origin": origin, "Content-Length": "0"})
        for site in ("cross-site", "same-site"):
            self.refused(403, "GET", self.served.path, {"Sec-Fetch-Site": site})

    def test_no_file_is_there(self):
        for rest in ("../../etc/passwd", "../../../../../../etc/passwd",
                     "%2e%2e/%2e%2e/etc/passwd", "..%2f..%2fetc%2fpasswd",
                     "/etc/passwd", "solve/../../etc/passwd", "solve/", "index.html",
                     "..", ".", "%00"):
            self.refused(404, "GET", self.served.path + rest)
        self.refused(404, "GET", self.served.path.rstrip("/"))

    def test_other_methods(self):
        for method in ("POST", "PUT", "DELETE", "PATCH", "OPTIONS", "HEAD"):
            self.refused(405, method, self.served.path, {"Content-Length": "0"})
        for method in ("GET", "PUT", "OPTIONS", "HEAD"):
            self.refused(405, method, self.served.path + "solve",
                         {"Content-Length": "0"})

    def test_bodies(self):
        path = self.served.path + "solve"
        self.refused(411, "POST", path, JSON)
        for length in ("-1", "x", "1e3", "9" * 30):
            self.refused(411, "POST", path, {**JSON, "Content-Length": length})
        for name in ("Transfer-Encoding", "Content-Encoding"):
            self.refused(411, "POST", path, {**JSON, "Content-Length": "2",
                                             name: "gzip"}, b"{}")
        self.refused(413, "POST", path, {**JSON, "Content-Length": "65537"})
        self.refused(413, "POST", path, {**JSON, "Content-Length": "9" * 17})
        for kind in ("text/plain", "application/x-www-form-urlencoded",
                     "multipart/form-data; boundary=x"):
            self.refused(415, "POST", path, {"Content-Type": kind,
                                             "Content-Length": "2"}, b"{}")

    def test_a_head_without_end_is_cut_off(self):
        with socket.create_connection((self.served.host, self.served.port),
                                      timeout=20) as line:
            sent = 0
            try:
                line.sendall(b"GET / HTTP/1.1\r\nX: ")
                while sent < 1 << 24:
                    sent += line.send(b"x" * 4096)
            except OSError:
                pass
            self.assertLess(sent, 1 << 23, "the server reads on and on")
        self.assertEqual(self.served.ask("GET", self.served.path)[0], 200)

    def test_a_slow_head_is_cut_off(self):
        # One byte a tenth of a second, for as long as the line holds.
        with socket.create_connection((self.served.host, self.served.port),
                                      timeout=20) as line:
            line.sendall(b"GET / HTTP/1.1\r\nX: ")
            with self.assertRaises(OSError):
                for _ in range(200):
                    line.sendall(b"x")
                    time.sleep(0.1)

    def test_listens_on_loopback_alone(self):
        ours = f":{self.served.port:04X}"
        found = [row.split()[1] for file in ("/proc/net/tcp", "/proc/net/tcp6")
                 if os.path.exists(file)
                 for row in pathlib.Path(file).read_text().splitlines()[1:]
                 if row.split()[1].endswith(ours) and row.split()[3] == "0A"]
        self.assertEqual(found, ["0100007F" + ours])


class Questions(unittest.TestCase):
    """What is asked, and what the answer is."""

    @classmethod
    def setUpClass(cls):
        cls.served = Served(PROGRAM, FOLDER, "u_axis")

    @classmethod
    def tearDownClass(cls):
        cls.served.stop()

    def test_bad_questions_are_told_in_one_line(self):
        far = [0, 0, 1e300]
        for question, words in (
                ("", "question"), ("{", "question"), ("[" * 200, "question"),
                ("[]", "question"), ("{}", "what"),
                ({**PLAN, "what": "draw"}, "/what"),
                ({**PLAN, "start": [0, 0]}, "/start"),
                ({**PLAN, "start": [0, 0, "0"]}, "/start"),
                ({**PLAN, "start": [0, 0, None]}, "/start"),
                ('{"what": "plan", "start": [0, 0, 1e999], "goal": [0, 0, 0]}',
                 "question"),
                ({**PLAN, "goal": far}, "/goal"),
                ({"what": "plan", "start": [0, 0, 0]}, "/goal"),
                ({**PLAN, "what": "depth"}, "/goal"),
                ({**PLAN, "more": 1}, "more"),
                ({**PLAN, "options": {"output": "x"}}, "output"),
                ({**PLAN, "options": {"planner": "best"}}, "planner"),
                ({**PLAN, "options": {"metric": "phong"}}, "metric"),
                ({**PLAN, "options": {"seed": -1}}, "seed"),
                ({**PLAN, "options": {"seed": 0.5}}, "seed")):
            status, reply = self.served.solve(question)
            self.assertEqual(status, 400, (question, reply))
            self.assertEqual(list(reply), ["error"])
            self.assertIn(words, reply["error"])
            self.assertNotIn("\n", reply["error"])

    def without_times(self, row):
        return {k: v for k, v in row.items() if k not in ("seconds", "versions")}

    def test_a_plan_is_the_row_of_the_command(self):
        status, reply = self.served.solve(PLAN)
        self.assertEqual(status, 200, reply)
        row = json.loads(run("plan", "u_axis", "--json").stdout)
        self.assertEqual(list(reply["row"]), list(row), "the same keys")
        self.assertEqual(self.without_times(reply["row"])["path"], row["path"])
        self.assertEqual(reply["paths"][0]["points"], row["path"])
        self.assertTrue(reply["paths"][0]["free"])

    def test_a_trajectory_is_the_row_of_the_command(self):
        status, reply = self.served.solve(
            {**PLAN, "what": "optimize", "options": {"metric": "euclidean"}})
        self.assertEqual(status, 200, reply)
        row = json.loads(run("optimize", "u_axis", "--metric", "euclidean",
                             "--json").stdout)
        self.assertEqual(list(reply["row"]), list(row), "the same keys")
        self.assertEqual(reply["row"]["metric"], "euclidean")
        self.assertTrue(reply["row"]["solved"])
        self.assertAlmostEqual(reply["row"]["objective"], row["objective"], 2)

    def test_a_motion_in_time_follows_no_metric(self):
        gantry = pathlib.Path(__file__).resolve().parents[2] / "examples/gantry.json"
        question = {"what": "optimize", "start": [100, 300, 80],
                    "goal": [860, 300, 100]}
        with Served(PROGRAM, FOLDER, str(gantry)) as served:
            status, reply = served.solve(
                {**question, "options": {"metric": "phong"}})
            self.assertEqual(status, 400, reply)
            self.assertIn("/options/metric: expected none of a motion in time",
                          reply["error"])
            status, reply = served.solve(question)
            self.assertEqual(status, 200, reply)
            self.assertTrue(reply["row"]["certified"])
            self.assertAlmostEqual(reply["paths"][0]["pace"]["duration"],
                                   reply["row"]["duration"], 12)

    def test_start_and_goal_are_those_that_were_asked_for(self):
        start, goal = [0.1, -1.4, 0.2], [-0.1, 1.3, -0.1]
        _, reply = self.served.solve({**PLAN, "start": start, "goal": goal})
        self.assertEqual(reply["row"]["path"][0], start)
        self.assertEqual(reply["row"]["path"][-1], goal)

    def test_a_depth_is_that_of_the_command(self):
        run("scenes", "write", "u_axis", "--meshes", ".")
        at = [0, 0.9, 0]
        status, reply = self.served.solve({"what": "depth", "start": at})
        self.assertEqual(status, 200, reply)
        row = json.loads(run("depth", "robot.off", "obstacle.off", "--json",
                             "--at", *map(str, at)).stdout)
        found = reply["rows"][0]
        self.assertEqual(set(found) - set(row), {"obstacle"})
        self.assertEqual(found["status"], row["status"])
        self.assertAlmostEqual(found["depth"], row["depth"], 12)
        self.assertTrue(found["certified"])
        self.assertEqual(reply["answers"][0]["depth"], found["depth"])

    def test_an_end_in_an_obstacle_is_an_answer(self):
        status, reply = self.served.solve({**PLAN, "start": [0, 1.0, 0]})
        self.assertEqual(status, 200, reply)
        self.assertFalse(reply["row"]["solved"])

    def test_a_second_client_waits_for_nobody(self):
        with Served(PROGRAM, FOLDER, CLOSED) as served:
            # Where it begins and ends is in the page.
            text = served.ask("GET", served.path)[2]
            data = json.loads(text.split('id="view-data">')[1]
                              .split("</script>")[0])
            question = {"what": "plan", "start": data["start"],
                        "goal": data["goal"],
                        "options": {"planner": "rrt-connect"}}
            first = {}
            thread = threading.Thread(
                target=lambda: first.update(zip("ab", served.solve(question))))
            thread.start()
            time.sleep(1.0)
            status, reply = served.solve(question)
            self.assertEqual(status, 503, reply)
            # Refused while the first one is still at work.
            self.assertTrue(thread.is_alive())
            # The page comes all the same.
            self.assertEqual(served.ask("GET", served.path)[0], 200)
            thread.join()
            self.assertEqual(first["a"], 200)
            self.assertFalse(first["b"]["row"]["solved"])
            self.assertEqual(served.solve({"what": "depth",
                                           "start": data["start"]})[0], 200)

    def test_what_takes_too_long_is_told(self):
        with Served(PROGRAM, FOLDER, "u_axis", "--no-cache", "--time",
                    "0.001") as served:
            status, reply = served.solve({**PLAN, "what": "optimize"})
            # By the desk, or before it by the build, which has the same limit.
            self.assertIn(status, (504, 400), reply)
            self.assertIn("within 0.001 s", reply["error"])


class Program(unittest.TestCase):
    def test_ctrl_c_ends_it(self):
        self.assertEqual(Served(PROGRAM, FOLDER, "u_axis").stop(), -2)

    def test_it_serves_at_the_port_that_is_asked_for(self):
        with Served(PROGRAM, FOLDER, "u_axis") as first:
            taken = run("view", "u_axis", "--serve", "--port", str(first.port))
        self.assertEqual(taken.returncode, 2)
        self.assertIn(f"--port: expected one that can be had on 127.0.0.1, found "
                      f"{first.port}", taken.stderr)
        self.assertEqual(taken.stderr.count("\n"), 1)

    def test_flags_that_mean_nothing(self):
        run("scenes", "write", "u_axis", "--meshes", ".")
        for arguments, words in (
                (["u_axis", "--port", "1"], "--port: expected --serve"),
                (["u_axis", "--time", "1"], "--time: expected --serve"),
                (["u_axis", "--serve", "--html", "x.html"], "without --html"),
                (["u_axis", "--serve", "--json"], "without --json"),
                (["obstacle.off", "--serve"], "--serve: expected a scene"),
                (["u_axis", "--serve", "--port", "70000"], "--port"),
                (["u_axis", "--serve", "--time", "0"], "--time")):
            done = run("view", *arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(words, done.stderr)
            self.assertFalse((FOLDER / "x.html").exists())


if __name__ == "__main__":
    sys.exit(run_tests(PROGRAM, FOLDER))
