# SPDX-License-Identifier: GPL-3.0-or-later
"""What an installed package is tried with: depth of two boxes, a trajectory and
a plan around one of them; every answer is known in closed form."""
import phongpd

CORNERS = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
FACES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
         (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]

box = phongpd.Solid(CORNERS, FACES)
answer = phongpd.depth(box, box, at=(1.5, 0, 0))
print(answer)
assert answer.depth == 0.5 and answer.certified
assert answer.direction.tolist() == [1, 0, 0]

# C_obj is the box of side 4: from one side to the other there is a way around
# it, and none within bounds that it fills across.
start, goal = (-3, 0.1, 0), (3, 0, 0.1)
world = phongpd.World(box, {"box": box}, bounds=((-4, -4, -4), (4, 4, 4)))
run = world.optimize(start, goal)
assert run.free, run.status
assert world.is_motion_free(run.path[:-1], run.path[1:]).all()
print("trajectory:", run.status)
assert world.plan(start, goal).solved
wall = phongpd.World(box, {"box": box}, bounds=((-4, -1.9, -1.9), (4, 1.9, 1.9)))
proof = wall.plan(start, goal)
assert proof.infeasible, proof.status
print("plan:", proof.status, "with phongpd", phongpd.__version__)
