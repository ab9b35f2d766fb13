# SPDX-License-Identifier: GPL-3.0-or-later
"""Preloaded by workers of the benchmark: rows that take a given time without
computing, as long as a row of a convergence sweep is in bytes."""

import json
import time

from phongpd.cluster import _work


def pause(job, subject):
    del subject
    time.sleep(job.arguments["pause"])
    return json.dumps({**job.arguments, "text": "." * 1500})


_work.WORK["pause"] = pause
