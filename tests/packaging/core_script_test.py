#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""core_script_test.py SOURCE: scripts/core.sh is the first command of a clone, where
there is no build/ yet, and keeps its log when the compiler fails.

With a cmake that does nothing, or fails, in the place of the real one."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop())


class CoreScript(unittest.TestCase):
    def run_with(self, cmake):
        """In a tree that holds the script alone; (its answer, the log)."""
        with tempfile.TemporaryDirectory() as name:
            tree = pathlib.Path(name)
            (tree / "scripts").mkdir()
            shutil.copy(SOURCE / "scripts/core.sh", tree / "scripts")
            (tree / "bin").mkdir()
            stand_in = tree / "bin/cmake"
            stand_in.write_text("#!/bin/sh\n" + cmake)
            stand_in.chmod(0o755)
            (tree / "installed").mkdir()
            answer = subprocess.run(
                [tree / "scripts/core.sh", tree / "installed"], text=True, timeout=60,
                capture_output=True, check=False,
                env={**os.environ, "PATH": f"{tree / 'bin'}:{os.environ['PATH']}"})
            return answer, (tree / "build/core-only.log").read_text()

    def test_runs_where_nothing_was_built(self):
        answer, log = self.run_with("echo compiled\n")
        self.assertEqual(answer.returncode, 0, answer.stderr)
        self.assertRegex(answer.stdout, r"^core: \d+ s on \d+ cores, \d+ s of "
                                        r"processors, \d+ KiB in ")
        self.assertEqual(log, "compiled\ncompiled\n")

    def test_shows_why_the_compiler_failed(self):
        answer, log = self.run_with("echo no such header >&2\nexit 1\n")
        self.assertEqual(answer.returncode, 1)
        self.assertIn("no such header", answer.stdout + answer.stderr)
        self.assertEqual(log, "no such header\n")


if __name__ == "__main__":
    unittest.main()
