# SPDX-License-Identifier: GPL-3.0-or-later
"""`phongpd view --serve` while a test asks it."""
import http.client
import json
import os
import signal
import subprocess
import sys
import unittest
import urllib.parse


def run_in(program, folder, *arguments):
    """What it did that answered and ended."""
    return subprocess.run(
        [program, *arguments], cwd=folder, capture_output=True, text=True,
        env={**os.environ, "PHONGPD_CACHE_DIR": str(folder / "cache")},
        check=False)


def run_tests(program, folder):
    """Those of the script that asks; 77 if the program serves nothing."""
    folder.mkdir(parents=True, exist_ok=True)
    probe = run_in(program, folder, "view", "no-such-scene", "--serve")
    if "libcpp-httplib-dev" in probe.stderr:
        print("Skipped: the program was built without libcpp-httplib-dev")
        return 77
    result = unittest.main(argv=sys.argv[:1], exit=False, verbosity=2).result
    return 0 if result.wasSuccessful() else 1


class Served:
    """The program, serving; `with` ends it by Ctrl-C."""

    def __init__(self, program, folder, *arguments):
        self.process = subprocess.Popen(
            [program, "view", *arguments, "--serve"], cwd=folder, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            # A shell's background job ignores Ctrl-C, and so would its child.
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
            env={**{k: v for k, v in os.environ.items()
                    if k not in ("DISPLAY", "WAYLAND_DISPLAY")},
                 "PHONGPD_CACHE_DIR": str(folder / "cache"),
                 "PHONGPD_PROGRESS": "never"})
        self.address = self.process.stdout.readline().strip()
        parts = urllib.parse.urlsplit(self.address)
        if parts.hostname is None:
            raise RuntimeError(self.process.communicate()[1])
        self.host, self.port, self.path = parts.hostname, parts.port, parts.path

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self.stop()

    def stop(self):
        """The code it ends with, of a signal −number."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        code = self.process.wait(10)
        self.process.stdout.close()
        self.process.stderr.close()
        return code

    def ask(self, method, path, headers=None, body=None, host=None):
        """Status, headers and text.  `path` is sent as it stands."""
        connection = http.client.HTTPConnection(self.host, self.port, timeout=60)
        try:
            connection.putrequest(method, path, skip_host=True,
                                  skip_accept_encoding=True)
            connection.putheader("Host", host or f"{self.host}:{self.port}")
            for name, value in (headers or {}).items():
                connection.putheader(name, value)
            connection.endheaders(body)
            reply = connection.getresponse()
            return (reply.status, {k.lower(): v for k, v in reply.getheaders()},
                    reply.read().decode())
        finally:
            connection.close()

    def solve(self, question):
        """Status and the object of JSON; a str is sent as it stands."""
        text = question if isinstance(question, str) else json.dumps(question)
        body = text.encode()
        status, _, reply = self.ask(
            "POST", self.path + "solve",
            {"Content-Type": "application/json",
             "Content-Length": str(len(body))}, body)
        return status, json.loads(reply)
