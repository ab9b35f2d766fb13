# SPDX-License-Identifier: GPL-3.0-or-later
"""The judges' motions, judged by hpp-core, by ipctk and by phongpd.RigidJudge, each
from its wheel and asked from Python (rigid_peers_judges.py); see `--help`.  A wheel
that is missing is a row with an error."""
import json
import os
import signal
import subprocess
import time
import traceback
from pathlib import Path
from typing import NamedTuple

import kept_rows as rows
import phongpd
from rigid_benchmark import JUDGED
from rigid_peers_judges import METHODS

MOTIONS = 20
SECONDS = 10.0  # of the processor, a motion; then it is stopped: undecided
# Python is asked for each point of each pair: of small meshes, and few motions.
SMALL, FEW = ["window:4", "peg:0.1", "ell:2.2", "rod_trap:0.1"], 6


class Asked(NamedTuple):
    scene: str
    method: str
    motions: int
    pair: int = 1  # the seed

    @property
    def key(self):
        return f"{self.scene} {self.method} {self.motions} {self.pair}"


def answers(judge, motions):
    """(free or None, processor seconds) of each.  They are asked in a child, which
    the system ends when a motion takes too long; another goes on after it."""
    found = []
    while len(found) < len(motions):
        found += ask_child(judge, motions[len(found):])
        if len(found) < len(motions):
            found.append((None, SECONDS))
    return found


def ask_child(judge, motions):
    """As many as were answered in time."""
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            answer(judge, motions, writer)
        except Exception:
            traceback.print_exc()
        finally:
            os._exit(0)
    os.close(writer)
    with open(reader, encoding="utf-8") as pipe:
        found = [json.loads(line) for line in pipe]
    _, status = os.waitpid(child, 0)
    was_stopped = os.WIFSIGNALED(status) and os.WTERMSIG(status) == signal.SIGPROF
    if len(found) < len(motions) and not was_stopped:
        raise RuntimeError(f"a motion was not judged: status {status}")
    return found


def answer(judge, motions, writer):
    """The first is asked twice: what a new process pays is no judge's."""
    with open(writer, "w", encoding="utf-8") as pipe:
        for i, one in enumerate([motions[0], *motions]):
            signal.setitimer(signal.ITIMER_PROF, SECONDS)
            begin = time.thread_time()
            free = bool(judge.is_free(one["start"], one["end"]))
            if i > 0:
                pipe.write(json.dumps((free, time.thread_time() - begin)) + "\n")
                pipe.flush()


def row_of(kind, method, motions, found):
    proved = [one["free"] for one in motions]
    said = [free for free, _ in found]
    return {"kind": kind, "method": method, "motions": len(motions),
            "free": proved.count(True), "colliding": proved.count(False),
            "ms": 1e3 * sum(s for _, s in found) / max(1, len(found)),
            "undecided": said.count(None),
            "misses": sum(s is True and p is False for s, p in zip(said, proved)),
            "contradictions": sum(s is False and p is True
                                  for s, p in zip(said, proved))}


def measure_with(build):
    def measure(one):
        judge = METHODS[one.method](phongpd.RigidWorld.load(one.scene))
        done = subprocess.run(
            [build / "rigid_judge_benchmark", one.scene, "--ends", "--motions",
             str(one.motions), "--seed", str(one.pair)],
            capture_output=True, text=True, check=True)
        sets = map(json.loads, done.stdout.splitlines())
        return {"key": one.key, "scene": one.scene, "rows": [
            {"scene": one.scene, **row_of(of["kind"], one.method, of["motions"],
                                          answers(judge, of["motions"]))}
            for of in sets]}
    return measure


def wanted():
    """The ones that take long last; of few motions the others too, to compare."""
    for scene in JUDGED:
        for method in METHODS:
            if not method.startswith("ipctk"):
                yield Asked(scene, method, MOTIONS)
    for scene in SMALL:
        for method in METHODS:
            yield Asked(scene, method, FEW)


def main():
    parser = rows.parser_for(__doc__, "rigid_peers.py", ["peers"])
    parser.add_argument("--build", type=Path, default=Path("build"),
                        help="folder of rigid_judge_benchmark")
    arguments = parser.parse_args()
    rows.run_part(arguments, "peers", wanted(), measure_with(arguments.build),
                  rows.deadline_of(arguments), "runs of judges of others")


if __name__ == "__main__":
    main()
