#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""doc_blocks.py cpp FILE DOCUMENT...     writes the C++ blocks as one program
doc_blocks.py run PROGRAMS DOCUMENT...  runs blocks as they stand: of the shell,
of Python if PROGRAMS/python is there, and the program of the C++ ones.
doc_blocks.py walk PROGRAMS DOCUMENT...  runs shell blocks alone, each document in
a fresh folder where nothing is given, with an own cache and home, and prints its
seconds by the clock and of processors; <!-- file: NAME --> before a block of any language writes that file, when its
turn comes.  Files of README are complete, and a walk-through must have the same.

Blocks are fenced as cpp, python, sh, json or js, or indented by four columns
(shell).  What cannot be run has <!-- not run: REASON --> before it.  What a reader has
already (a path, meshes, scene.json) comes from here; a comment "no answer" in or
above a command allows it exit code 1.  Shell blocks of one document are one
session, README's in the root of the tree, the others' in a folder of their own, where
fenced json is scene.json, and js, JSON with comments, a scene to optimize, or members
of one that stand in place of others of the scene before."""
import json
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
CPP_CONTEXT = """#include <phongpd/planners/world/world.h>

#include <iostream>
#include <vector>

using namespace phongpd;

// What a reader has before the first line.
const Solid robot = ReadSolid("robot.off"), obstacle = ReadSolid("wrench.stl"),
            wrench = obstacle;
const Eigen::Vector3d start(0.3, -1.2, 0.1), goal(0.3, 1.2, 0.1);
const std::vector<Eigen::Vector3d> path = {start, {0.3, -0.1, 0.1}, goal};
const BoundingBox bounds = {Eigen::Vector3d::Constant(-4.0),
                            Eigen::Vector3d::Constant(4.0)};
int used = 0;
template <typename... T>
void use(const T&...) {
  ++used;
}
"""
PYTHON_CONTEXT = """import numpy as np
import phongpd
points = np.array([[0.3, 0, 0.1], [0.3, 0, -0.1]])
start, goal = (0.3, -1.2, 0.1), (0.3, 1.2, 0.1)
tool, part = phongpd.Solid.read("tool.stl"), phongpd.Solid.read("part.stl")
"""
# Of a block that is given one.
PYTHON_CLIENT = """from dask.distributed import Client
from phongpd import cluster
client = Client(processes=False, dashboard_address=None)
"""
RUN = ("cpp", "python", "sh", "json", "js")
# What "robots" of a scene stand in place of.
OF_ONE_ROBOT = ("robot", "start", "goal", "via")
WALKS = ("docs/walk-cpp.md", "docs/walk-gantry.md", "docs/walk-research.md")
SCENE = """{"robot": {"mesh": "robot.off"},
 "obstacles": [{"id": "wrench", "mesh": "obstacle.off"}],
 "start": [0.3, -1.2, 0.1], "goal": [0.3, 1.2, 0.1]}
"""


class Block:
    def __init__(self, document, line, language):
        self.document, self.line, self.language = document, line, language
        self.lines, self.is_run, self.file = [], True, None

    def __str__(self):
        return f"{self.document}:{self.line}"

    @property
    def text(self):
        return "\n".join(self.lines) + "\n"


def blocks_of(document):
    """All blocks, in order."""
    found, fence, is_run, in_list, before = [], None, True, False, ""
    text = (ROOT / document).read_text(encoding="utf-8")
    indented, file = None, None
    for number, line in enumerate(text.splitlines(), 1):
        if fence is not None:
            if line.startswith("```"):
                fence = None
            else:
                fence.lines.append(line)
            continue
        if line.startswith("```"):
            fence = Block(document, number + 1, line[3:].strip())
            fence.is_run, fence.file = is_run, file
            found.append(fence)
            indented, is_run, file = None, True, None
        elif re.match(r"<!-- not run: .+ -->$", line):
            is_run = False
        elif re.match(r"<!-- file: \S+ -->$", line):
            file = line.split()[2]
        elif line.startswith("    ") and line.strip() and not in_list:
            if indented is None and (before == "" or number == 1):
                indented = Block(document, number, "sh")
                indented.is_run = is_run
                found.append(indented)
                is_run = True
            if indented is not None:
                indented.lines.append(line[4:])
        elif line.strip():
            indented = None
            in_list = bool(re.match(r"([-*]|\d+\.) ", line)) or (
                in_list and line.startswith(" "))
        elif indented is not None:
            indented.lines.append("")
        before = line.strip()
    assert fence is None, f"{document}: a fence is not closed"
    for block in found:
        if block.language.startswith("{"):  # of the pages: a picture, contents
            block.is_run = False
        assert not block.is_run or block.file or block.language in RUN, (
            f"{block}: expected a language of {RUN}, found '{block.language}'; run "
            "it here, or say <!-- not run: why --> before it")
    return found


def scenes_of(blocks):
    """The js blocks as (block, whole scene)."""
    scene = {}
    for block in blocks:
        if block.language != "js":
            continue
        text = re.sub(r"//.*", "", block.text).strip()
        is_whole = text.startswith("{")
        members = json.loads(text if is_whole else "{" + text + "}")
        before = {} if is_whole else dict(scene)
        for key in OF_ONE_ROBOT if "robots" in members else ():
            before.pop(key, None)
        yield block, {**before, **members}
        if is_whole:
            scene = members


def require_walked():
    """Files of README's are those of a walk-through, which builds and runs them."""
    walked = {(b.file, b.text) for d in WALKS for b in blocks_of(d)}
    for block in blocks_of("README.md"):
        assert not block.file or (block.file, block.text) in walked, (
            f"{block}: expected the same {block.file} in a docs/walk-*.md, found none")


def is_part(block):
    """Of the one C++ program; a file is a program by itself."""
    return block.language == "cpp" and block.is_run and not block.file


def cpp_program(blocks):
    """One function a block; its #includes stand before all of them."""
    includes, functions, calls = [], [], []
    for index, block in enumerate(blocks):
        body = []
        for line in block.lines:
            (includes if line.startswith("#include") else body).append(line)
        functions += [f"void Block{index}() {{",
                      f'#line {block.line} "{block.document}"',
                      *body, "}"]
        calls.append(f'  std::cout << "{block}" << std::endl; Block{index}();')
    return "\n".join([*dict.fromkeys(includes), CPP_CONTEXT, *functions,
                      "int main() {", *calls, "  return used > 0 ? 0 : 1;", "}",
                      ""])


def commands_of(block):
    """Each with its continued lines and whether it may find no answer."""
    command, may_fail, first = [], False, block.line
    for number, line in enumerate(block.lines, block.line):
        may_fail = may_fail or "no answer" in line
        if line.startswith("#") or not line.strip():
            continue
        if not command:
            first = number
        command.append(line)
        if line.endswith("\\"):
            continue
        yield first, "\n".join(command), may_fail
        command, may_fail = [], False
    assert not command, f"{block}: the last line goes on"


def shell_session(document, blocks):
    lines, count = ["set -o pipefail"], 0
    whole = {block: scene for block, scene in scenes_of(blocks)}
    for block in blocks:
        if block.file and document != "README.md":
            lines += [f"cat >{block.file} <<'END'", *block.lines, "END"]
            continue
        if block in whole:
            count += 1
            name = f"scene-{block.line}"
            lines += [f"cat >{name}.json <<'END'", json.dumps(whole[block]), "END",
                      f"phongpd optimize {name}.json --output {name}.out.json || {{",
                      f"  echo \"{block}: exit code $?\"; exit 1", "}"]
        if block.language == "json" and document != "README.md":
            lines += ["cat >scene.json <<'END'", *block.lines, "END"]
        if block.language != "sh":
            continue
        for number, command, may_fail in commands_of(block):
            count += 1
            lines += [command, f"code=$?; if ((code > {int(may_fail)})); then",
                      f"  echo \"{document}:{number}: exit code $code\"; exit 1",
                      "fi"]
    return "\n".join(lines) + "\n", count


def run(name, command, folder, environment):
    done = subprocess.run(command, cwd=folder, env=environment, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, timeout=1200, check=False)
    if done.returncode != 0:
        print(f"readme: {name} ended with {done.returncode}:\n"
              + "\n".join(done.stdout.splitlines()[-15:]), file=sys.stderr)
        sys.exit(1)


def write_stl(source, target):
    """An OFF file of triangles as text STL."""
    words = source.read_text().split()
    vertices, triangles = int(words[1]), int(words[2])
    corner = [words[4 + 3 * i:7 + 3 * i] for i in range(vertices)]
    rest = words[4 + 3 * vertices:]
    lines = ["solid s"]
    for i in range(triangles):
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex " + " ".join(corner[int(v)])
                  for v in rest[4 * i + 1:4 * i + 4]]
        lines += ["endloop", "endfacet"]
    target.write_text("\n".join([*lines, "endsolid s", ""]))


def run_python(document, blocks, work, python, environment):
    """A document's blocks in one program; scripts with a main part alone."""
    groups, rest = [], []
    for block in blocks:
        if block.language != "python" or block.file:
            continue
        if "__main__" in block.text:
            groups.append([block])
        else:
            rest.append(block)
    for group in [*groups, *([rest] if rest else [])]:
        text = "".join(f"# {block}\n{block.text}" for block in group)
        given = "client=client" in text and "Client(" not in text
        own = work / f"{document.replace('/', '_')}_{group[0].line}"
        shutil.copytree(work / "data", own)
        (own / "block.py").write_text(
            PYTHON_CONTEXT + (PYTHON_CLIENT if given else "") + text)
        run(f"Python of {group[0]}", [str(python), "block.py"], own, environment)
    return len(rest) + len(groups)


def run_all(programs, documents):
    require_walked()
    programs = pathlib.Path(programs).resolve()
    work = programs / "check" / "blocks"
    shutil.rmtree(work, ignore_errors=True)
    data = work / "data"
    data.mkdir(parents=True)
    environment = dict(os.environ, PATH=f"{programs}:{os.environ['PATH']}",
                       PYTHONPATH=str(programs / "python"))
    run("scenes write", ["phongpd", "scenes", "write", "ball_wrench",
                         "--meshes", "."], data, environment)
    for name, source in (("wrench", "obstacle"), ("part", "obstacle"),
                         ("tool", "robot")):
        write_stl(data / f"{source}.off", data / f"{name}.stl")
    shutil.copy(data / "obstacle.off", data / "wall.off")
    shutil.copy(data / "robot.off", data / "gripper.off")
    (data / "scene.json").write_text(SCENE)
    blocks = {d: [b for b in blocks_of(d) if b.is_run] for d in documents}
    counts = {"cpp": 0, "python": 0, "commands": 0}
    run("a C++ block", [str(programs / "documented_cpp")], data, environment)
    counts["cpp"] = sum(is_part(b) for d in documents for b in blocks[d])
    python = programs / "venv" / "bin" / "python"
    has_python = (programs / "python" / "phongpd").is_dir() and python.exists()
    for document in documents:
        session, count = shell_session(document, blocks[document])
        folder = ROOT
        if document != "README.md":
            folder = work / pathlib.Path(document).with_suffix("")
            shutil.copytree(data, folder)
        run(document, ["bash", "-c", session], folder, environment)
        counts["commands"] += count
        counts["python"] += run_python(document, blocks[document], work,
                                       python, environment) if has_python else 0
    print(f"readme: {counts['commands']} commands ran, {counts['cpp']} blocks "
          f"of C++, {counts['python']} of Python"
          + ("" if has_python else " (for want of build/venv)"))


def processors():
    """Seconds of all that has run and ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def walk(programs, document):
    """One document from nothing; its commands, seconds, those of processors."""
    programs = pathlib.Path(programs).resolve()
    folder = programs / "check" / "walk" / pathlib.Path(document).stem
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    blocks = [block for block in blocks_of(document) if block.is_run]
    session, count = shell_session(document, blocks)
    assert count > 0, f"{document}: expected commands, found none"
    # Python with what it needs, where scripts/python.sh made one.
    environment = dict(os.environ, HOME=str(folder), PATH=":".join(
                           [str(programs), str(programs / "venv" / "bin"),
                            os.environ["PATH"]]),
                       PHONGPD=str(ROOT), PYTHONPATH=str(programs / "python"),
                       PHONGPD_CACHE_DIR=str(folder / "cache"))
    begin, before = time.monotonic(), processors()
    run(document, ["bash", "-c", session], folder, environment)
    return count, time.monotonic() - begin, processors() - before


def main(what, target, *documents):
    if what == "cpp":
        all_blocks = [b for d in documents for b in blocks_of(d)
                      if is_part(b)]
        pathlib.Path(target).write_text(cpp_program(all_blocks))
    elif what == "walk":
        require_walked()
        for document in documents:
            name = document if document.endswith(".md") else document + ".md"
            count, clock, used = walk(target, name)
            print(f"walk: {name}: {count} commands, {clock:.1f} s, {used:.1f} s of "
                  "processors", flush=True)
    else:
        run_all(target, documents)


if __name__ == "__main__":
    main(*sys.argv[1:])
