# SPDX-License-Identifier: GPL-3.0-or-later
"""What FCL's continuous collision answers about motions whose answer is known;
PhongPD is not asked, as it answers for translations alone.

Robot and obstacle are made here, and so is the truth, without any geometry
kernel: a crossing motion takes the robot's centre through the obstacle's inside,
a passing one keeps the robot's bounding ball off the obstacle's bounding box.
"""

import fcl
import numpy as np
from python_report import machine, markdown, parser_of, versions, write_csv

SEED, MOTIONS = 1, 100
HEADER = ["obstacle", "given as", "motion", "solver", "crossing",
          "crossing called free", "passing", "passing called meeting"]
SOLVERS = [("conservative advancement", "CCDC_CONSERVATIVE_ADVANCEMENT"),
           ("naive, 10 samples", "CCDC_NAIVE"),
           ("naive, 1,000 samples", "CCDC_NAIVE")]
SIDE = 0.2  # of the robot, a cube
BOX = [(0, 1, 2, 3), (7, 6, 5, 4), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3),
       (3, 7, 4, 0)]


def box(size):
    """Vertices and triangles, outward, of a box about the origin."""
    x, y, z = np.array(size) / 2
    corners = np.array([(-x, -y, -z), (-x, y, -z), (x, y, -z), (x, -y, -z),
                        (-x, -y, z), (-x, y, z), (x, y, z), (x, -y, z)])
    triangles = [t for a, b, c, d in BOX for t in ((a, b, c), (a, c, d))]
    return corners, np.array(triangles)


def mesh(size):
    vertices, triangles = box(size)
    model = fcl.BVHModel()
    model.beginModel(len(vertices), len(triangles))
    model.addSubModel(vertices, triangles)
    model.endModel()
    return model


def rotation(random):
    q, r = np.linalg.qr(random.normal(size=(3, 3)))
    q *= np.sign(np.diag(r))
    q[:, 0] *= np.linalg.det(q)
    return q


def motions(size, crosses, turns, random):
    """Poses of the robot's begin and end."""
    half, reach = np.array(size) / 2, SIDE * np.sqrt(3) / 2
    outside = np.linalg.norm(half) + 2 * reach
    found = []
    while len(found) < MOTIONS:
        direction = random.normal(size=3)
        direction /= np.linalg.norm(direction)
        # The centre is here half way: inside by a tenth at least, or off.
        middle = random.uniform(-0.8, 0.8, 3) * half
        if not crosses:
            side = np.cross(direction, random.normal(size=3))
            middle = side / np.linalg.norm(side) * (outside + random.uniform())
        begin, end = (middle + s * 2 * outside * direction for s in (-1, 1))
        turn = rotation(random)
        found.append((fcl.Transform(turn, begin),
                      fcl.Transform(rotation(random) if turns else turn, end)))
    return found


def meets(make, size, begin, end, turns, solver, samples):
    # Made anew each time: some solvers move the vertices of what they are given.
    robot, obstacle = make((SIDE,) * 3), make(size)
    request = fcl.ContinuousCollisionRequest(
        num_max_iterations=samples,
        ccd_motion_type=fcl.CCDMotionType.CCDM_LINEAR if turns
        else fcl.CCDMotionType.CCDM_TRANS, ccd_solver_type=solver)
    result = fcl.ContinuousCollisionResult()
    still = fcl.Transform()
    fcl.continuousCollide(fcl.CollisionObject(robot, begin), end,
                          fcl.CollisionObject(obstacle, still), still, request,
                          result)
    return result.is_collide


def run():
    rows, failures = [], []
    for name, size in (("cube", (1, 1, 1)), ("plate", (2, 2, 0.2)),
                       ("thin plate", (2, 2, 0.02)), ("bar", (0.1, 0.1, 2))):
        for given, make in (("meshes", mesh), ("boxes", lambda s: fcl.Box(*s))):
            for turns in (False, True):
                for label, kind in SOLVERS:
                    solver = getattr(fcl.CCDSolverType, kind)
                    samples = 1000 if "1,000" in label else 10
                    random = np.random.default_rng(SEED)
                    try:
                        hits = [sum(meets(make, size, *m, turns, solver, samples)
                                    for m in motions(size, crosses, turns,
                                                     random))
                                for crosses in (True, False)]
                    except Exception as error:
                        failures.append(f"{name}, {given}, {label}: "
                                        + " ".join(str(error).split())[:150])
                        continue
                    rows.append((name, given,
                                 "turns" if turns else "translates", label,
                                 MOTIONS, MOTIONS - hits[0], MOTIONS, hits[1]))
    return rows, failures


def spread(rows, column):
    found = [row[column] for row in rows]
    low, high = min(found), max(found)
    return f"{low}" if low == high else f"{low} to {high}"


def lines(rows):
    """One for each way of asking, wins and losses."""
    for given in ("meshes", "boxes"):
        for motion in ("translates", "turns"):
            for label, _ in SOLVERS:
                mine = [r for r in rows if r[1:4] == (given, motion, label)]
                if mine:
                    yield (f"- {given}, robot {motion}, {label}: of {MOTIONS} "
                           f"crossing motions {spread(mine, 5)} called free, of "
                           f"{MOTIONS} passing ones {spread(mine, 7)} called "
                           "meeting.")


def main():
    arguments = parser_of(__doc__, "peers_motions.py").parse_args()
    rows, failures = run()
    note = ("A cube of side 0.2 and obstacles of four shapes, given as meshes or as "
            "FCL's own boxes. Crossing: the robot's centre is well inside the "
            "obstacle half way. Passing: the robot's ball stays off the obstacle's. "
            "A solver that never errs has 0 in both columns. What turns goes by "
            "FCL's `CCDM_LINEAR`, whose turning point FCL 0.7 leaves unset "
            "(`InterpMotion::reference_p` of the constructor that is used): those "
            "rows depend on what memory held, and differ from run to run.")
    text = ["# Continuous collision by FCL", "",
            "For bodies that turn nothing here answers between poses, so this asks "
            "whether FCL does. Coal has no continuous collision at all.", "",
            *lines(rows), "",
            "Conservative advancement is the default of python-fcl's request. On "
            "meshes its answer is worth nothing; sampling a thousand poses was right "
            "about every translation asked here, but it is sampling: thinner solids "
            "than a step it misses. Bodies that turn had best be sampled by oneself, "
            "pose by pose (`fcl.collide`, `depth --pose`).", "",
            *(f"- Did not run: {f}." for f in failures),
            markdown("Motions whose answer is known", note, HEADER, rows,
                     "motions.csv"),
            f"Command: {arguments.how}. Seed: {SEED}. Machine: {machine()}. "
            f"Versions: {versions('numpy', 'python-fcl')}.", ""]
    arguments.output.mkdir(parents=True, exist_ok=True)
    write_csv(arguments.output / "motions.csv", HEADER, rows)
    (arguments.output / "motions.md").write_text("\n".join(text),
                                                 encoding="utf-8")


if __name__ == "__main__":
    main()
