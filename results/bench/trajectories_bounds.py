# SPDX-License-Identifier: GPL-3.0-or-later
"""How long a motion from rest to rest takes at least, obstacles or not."""
import math

import numpy as np


def rest_to_rest(distance, velocity, acceleration, jerk):
    """Least seconds along a line, in closed form: seven phases at most, of which
    those at the limit of velocity, then of acceleration, vanish for short ways."""
    d, v, a, j = float(distance), velocity, acceleration, jerk
    if d <= 0.0:
        return 0.0
    speeding = 2 * math.sqrt(v / j) if v * j < a * a else v / a + a / j
    if d >= v * speeding:
        return speeding + d / v
    if d >= 2 * a ** 3 / j ** 2:
        r = a / j
        return r + math.sqrt(r * r + 4 * d / a)
    return 4 * (d / (2 * j)) ** (1 / 3)


def least_duration(start, goal, limits, by_norm):
    """By axis: of the axis that takes longest, as if it were alone.  By norm:
    of the projection on the line between the ends, whose speed is at most the
    norm.  No motion is faster; where obstacles are in the way none is as fast."""
    way = np.abs(np.subtract(goal, start))
    if by_norm:
        return rest_to_rest(np.linalg.norm(way), *limits)
    return max(rest_to_rest(d, *limits) for d in way)
