# SPDX-License-Identifier: GPL-3.0-or-later
# Files of the library's own with other contents and a valid checksum, as
# somebody may make them: refused by name in one line, or used.  In a process of
# its own, as what else they could do (crash, hang) ends that.
import os
import random
import struct
import subprocess
import sys

import phongpd
import pytest
from conftest import make_box, make_torus

CASES = 400
POINTS = [[0.1, 0.2, 0.3], [1, 0, 0], [40, 0, 0], [-0.5, 0.25, 0]]
LIMITS = [struct.pack("<q", n) for n in (0, 1, -1, 2, 255, 2**31, 2**40, 2**62,
                                         2**63 - 1, -2**63)]
LIMITS += [struct.pack("<i", n) for n in (3, 7, 2**20, 2**31 - 1, -2**31)]
LIMITS += [struct.pack("<d", x) for x in (-1.0, 0.5, 1e-300, 1e300,
                                          float("inf"), float("nan"))]


def checksum(content):
    """MurmurHash3 x64 128, seed 0, but that its last block is mixed alike."""
    mask = 2**64 - 1

    def rotated(x, bits):
        return (x << bits | x >> (64 - bits)) & mask

    def mixed(h, block, one, two, bits):
        k = int.from_bytes(block, "little") * one & mask
        return h ^ rotated(k, bits) * two & mask

    def finished(h):
        h = (h ^ h >> 33) * 0xff51afd7ed558ccd & mask
        h = (h ^ h >> 33) * 0xc4ceb9fe1a85ec53 & mask
        return h ^ h >> 33

    one, two = 0x87c37b91114253d5, 0x4cf5ad432745937f
    h1 = h2 = 0
    whole = len(content) // 16 * 16
    for at in range(0, whole, 16):
        h1 = mixed(h1, content[at:at + 8], one, two, 31)
        h1 = ((rotated(h1, 27) + h2) * 5 + 0x52dce729) & mask
        h2 = mixed(h2, content[at + 8:at + 16], two, one, 33)
        h2 = ((rotated(h2, 31) + h1) * 5 + 0x38495ab5) & mask
    h2 = mixed(h2, content[whole + 8:], two, one, 33) ^ len(content)
    h1 = mixed(h1, content[whole:whole + 8], one, two, 31) ^ len(content)
    h1 = (h1 + h2) & mask
    h2 = (h2 + h1) & mask
    h1, h2 = finished(h1), finished(h2)
    h1 = (h1 + h2) & mask
    return struct.pack("<QQ", h1, (h2 + h1) & mask)


def parts(file):
    """Before the seal (a line, machine and version), and the content."""
    start = file.index(b"\n") + 1 + 8 + 4
    return file[:start], file[start + 24:]


def sealed(start, content):
    return start + struct.pack("<Q", len(content)) + checksum(content) + content


def mutated(content, rng):
    """A few changes: bits, fields, neighbours of numbers, parts doubled, moved
    onto others, or gone."""
    content = bytearray(content)
    for _ in range(rng.randint(1, 3)):
        at, other = rng.randrange(len(content)), rng.randrange(len(content))
        part = content[other:other + rng.randint(1, 64)]
        kind = rng.randrange(6)
        if kind == 0:
            content[at] ^= 1 << rng.randrange(8)
        elif kind == 1:
            limit = rng.choice(LIMITS)
            content[at:at + len(limit)] = limit
        elif kind == 2:
            content[at] = (content[at] + rng.choice((-1, 1))) % 256
        elif kind == 3:
            content[at:at + len(part)] = part
        elif kind == 4:
            content[at:at] = part
        elif rng.randrange(4):
            del content[at:at + len(part)]
        else:
            del content[at:]
        if not content:
            break
    return bytes(content)


def use(space, path):
    """All that reads what was read."""
    assert len(space.triangles) > 0
    for metric in (phongpd.EuclideanMetric(space),
                   phongpd.PhongMetric(space, smoothing_length=0.1)):
        metric.query(POINTS)
        metric.query(POINTS, tracked=True)
    phongpd.PenetrationTracker(space).follow(POINTS)
    assert space.to_row() and repr(space) and space._facts()
    space.write(path)
    again = phongpd.ContactSpace.read(path)
    assert again.vertices.tobytes() == space.vertices.tobytes()


def attack(kind, folder):
    """Prints what came of the mutations of pieces or contact spaces."""
    rng = random.Random(kind)
    torus = make_torus(1, 0.4, 8, 6)
    pairs = [(make_box((0, 0, 0), (1, 1, 1)), make_box((1, 0, 0), (3, 1, 2))),
             (torus, make_box((-1, -2, 0), (1, 2, 1))), (torus, torus)]
    builds = []
    for pair in pairs:
        for count in ((1, 2) if kind == "piece" else (1,)):
            files = [os.path.join(folder, f"{len(builds)}-{i}.{kind}")
                     for i in range(count)]
            for i, file in enumerate(files):
                (phongpd.ContactSpacePiece.build(*pair, i, count)
                 if kind == "piece" else
                 phongpd.ContactSpace.build(*pair)).write(file)
            builds.append(files)
    originals = {}
    for file in sum(builds, []):
        with open(file, "rb") as stream:
            originals[file] = stream.read()
        assert sealed(*parts(originals[file])) == originals[file]
    counts = {"refused": 0, "used": 0}
    for case in range(CASES):
        print("case", case, flush=True)
        files = rng.choice(builds)
        changed = rng.choice(files)
        start, content = parts(originals[changed])
        with open(changed, "wb") as stream:
            stream.write(sealed(start, mutated(content, rng)))
        try:
            space = (phongpd.ContactSpace.join(files) if kind == "piece" else
                     phongpd.ContactSpace.read(changed))
        except ValueError as error:
            text = str(error)
            assert isinstance(error, phongpd.InputError), repr(error)
            assert text and "\n" not in text and len(text) < 500, text
            assert kind == "piece" or text.startswith(changed), text
            counts["refused"] += 1
        else:
            use(space, os.path.join(folder, "used.pcs"))
            counts["used"] += 1
        with open(changed, "wb") as stream:
            stream.write(originals[changed])
    print(counts["refused"], counts["used"])


@pytest.mark.parametrize("kind", ["piece", "pcs"])
def test_they_are_refused_or_used(kind, tmp_path):
    done = subprocess.run([sys.executable, __file__, kind, str(tmp_path)],
                          capture_output=True, text=True, timeout=300)
    *cases, last = done.stdout.splitlines() or [""]
    assert done.returncode == 0, (last, done.returncode, done.stderr)
    refused, used = map(int, last.split())
    assert refused + used == CASES == len(cases)
    assert refused > CASES / 4 and used > 0


if __name__ == "__main__":
    attack(*sys.argv[1:])
