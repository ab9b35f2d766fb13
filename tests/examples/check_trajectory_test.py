# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves of the program, whole and spoilt, before examples/check_trajectory.py.

    python3 check_trajectory_test.py PROGRAM CHECKER FOLDER
"""
import copy
import json
import pathlib
import subprocess
import sys

CERTIFIED = "certified: free and within the limits for all t\n"


def points_of(off):
    words = off.read_text().split()
    numbers = [float(word) for word in words[4:4 + 3 * int(words[1])]]
    return list(zip(numbers[::3], numbers[1::3], numbers[2::3]))


class Scene:
    def __init__(self, program, checker, folder, name):
        self.checker, self.folder = checker, folder
        folder.mkdir(parents=True, exist_ok=True)
        subprocess.run([program, "scenes", "write", name, "--meshes", "."],
                       cwd=folder, check=True, stdout=subprocess.DEVNULL)
        subprocess.run([program, "optimize", name, "--limits", "1,2,10",
                        "--preset", "fast", "--output", "t.json"],
                       cwd=folder, check=True, stdout=subprocess.DEVNULL)
        self.row = json.loads((folder / "t.json").read_text())
        self.meshes = [folder / "robot.off", folder / "obstacle.off"]

    def check(self, row, meshes=None):
        (self.folder / "spoilt.json").write_text(json.dumps(row))
        done = subprocess.run(
            [sys.executable, self.checker, self.folder / "spoilt.json"] +
            (meshes or self.meshes), capture_output=True, text=True)
        return done.returncode, done.stdout, done.stderr

    def expect(self, what, row, code, text, meshes=None):
        found, out, err = self.check(row, meshes)
        if found != code or text not in out + err:
            sys.exit(f"{self.folder.name}, {what}: expected {code} and "
                     f"'{text}', found {found}: {out}{err}")

    def moved(self, by):
        row = copy.deepcopy(self.row)
        for piece in row["pieces"]:
            piece["points"] = [[x + d for x, d in zip(p, by)]
                               for p in piece["points"]]
        return row

    def run(self):
        self.expect("as it is", self.row, 0, CERTIFIED)
        pieces = self.row["pieces"]
        # A corner of the robot on one of the obstacle, in the middle of a
        # piece or at its end.
        robot, obstacle = map(points_of, self.meshes)
        for number in (0, len(pieces) // 2):
            for share in (0.5, 1.0):
                points = pieces[number]["points"]
                while len(points) > 1:
                    points = [[a + share * (b - a) for a, b in zip(p, q)]
                              for p, q in zip(points, points[1:])]
                by = [o - r - q for o, r, q in
                      zip(obstacle[number % len(obstacle)], robot[0], points[0])]
                self.expect("moved into the obstacle", self.moved(by), 1,
                            "collides at ")
        # In the middle of the solid no surfaces meet.
        inside = self.moved([0.0, 0.0, 0.0])
        inside["pieces"] = [{"duration": 1.0, "points": [[0.0] * 3] * 6}]
        big = self.folder / "big.off"
        big.write_text("OFF\n4 4 0\n-99 -99 -99\n99 0 0\n0 99 0\n0 0 99\n"
                       "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n")
        self.expect("inside", inside, 1, "collides at 0.0 s",
                    [self.meshes[0], big])
        self.expect("around", inside, 1, "collides at 0.0 s",
                    [big, self.meshes[0]])
        # Limits: lower than what is used, and time that runs faster.
        for name in ("velocity", "acceleration", "jerk"):
            row = copy.deepcopy(self.row)
            used = self.row["limits_used"][name]
            if used < 0.5:
                continue  # not what bounds this motion
            row["limits"][name] = [0.98 * used * x for x in row["limits"][name]]
            self.expect("a lower limit", row, 1, f"limit broken: {name}")
        # Of the norm, which is 1 to 3^1/2 times the largest coordinate.
        row = copy.deepcopy(self.row)
        row["limits"]["by"] = "norm"
        for name in ("velocity", "acceleration", "jerk"):
            row["limits"][name] = [1.74 * x for x in row["limits"][name]]
        self.expect("of the norm", row, 0, CERTIFIED)
        used = self.row["limits_used"]["velocity"]
        row["limits"]["velocity"] = [
            0.9 * used * x for x in self.row["limits"]["velocity"]]
        self.expect("less of the norm", row, 1, "limit broken: velocity")
        row = copy.deepcopy(self.row)
        for piece in row["pieces"]:
            piece["duration"] *= 0.97
        self.expect("faster", row, 1, "limit broken: ")
        row = copy.deepcopy(self.row)
        row["pieces"][len(pieces) // 2]["duration"] *= 1.5
        self.expect("not in step", row, 1, "jumps where piece ")
        # What is no trajectory, no solid, or not there.
        row = copy.deepcopy(self.row)
        row["pieces"][1]["points"][0][0] += 1e-12
        self.expect("apart", row, 2, "expected pieces that take time, and join")
        row["pieces"] = []
        self.expect("empty", row, 2, "expected pieces")
        lines = self.meshes[1].read_text().split("\n")
        lines = [line for line in lines if line.strip()]
        open_mesh = self.folder / "open.off"
        open_mesh.write_text("\n".join(lines[:-1] + [lines[-2]]))
        self.expect("open", self.row, 2, "expected a closed surface",
                    [self.meshes[0], open_mesh])
        self.expect("no obstacle", self.row, 2, "Checks", self.meshes[:1])


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    program, checker, folder = [pathlib.Path(word).resolve()
                                for word in sys.argv[1:]]
    if len(checker.read_text().splitlines()) > 200:
        sys.exit(f"{checker}: expected 200 lines at most, to be read by people")
    for name in ("u_axis", "plate_hole", "keyhole"):
        Scene(program, checker, folder / name, name).run()


if __name__ == "__main__":
    main()
