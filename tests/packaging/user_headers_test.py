# SPDX-License-Identifier: GPL-3.0-or-later
"""user_headers_test.py SOURCE: what is installed, and who needs it.

Headers named after HEADERS in the build files are for users to include, those
after SUPPORT for these.  Documents and examples include the former alone.
"""
import pathlib
import re
import sys

MOST_USER_HEADERS = 60
FOLDERS = ("core", "constraints", "planners", "problems", "viewer")
INCLUDE = re.compile(r'# *include [<"](?:phongpd/)?((?:%s)/[\w/]+\.h)[>"]'
                     % "|".join(FOLDERS))

def headers(source):
    """Of all build files the user's headers and the others, by their names."""
    user, support = [], []
    for folder in FOLDERS:
        for lists in sorted((source / folder).rglob("CMakeLists.txt")):
            text = re.sub(r"#.*", "", lists.read_text())
            kind = None
            for word in re.findall(r"[^\s()]+|[()]", text):
                if word in ("HEADERS", "PHONGPD_PUBLIC_HEADERS"):
                    kind = user
                elif word in ("SUPPORT", "PHONGPD_SUPPORT_HEADERS"):
                    kind = support
                elif word in "()":
                    kind = None
                elif kind is not None and word.endswith(".h"):
                    path = lists.parent / word
                    kind.append(path.relative_to(source).as_posix())
    return user, support

def includes(path):
    return INCLUDE.findall(path.read_text())

def main(source):
    user, support = headers(source)
    installed = set(user) | set(support)
    failures = []
    if len(installed) != len(user) + len(support):
        failures.append("a header is named twice")
    if not {"core/contact/depth.h", "planners/solve/plan.h"} <= set(user):
        failures.append("no user headers found: are the lists elsewhere?")
    if len(user) > MOST_USER_HEADERS:
        failures.append(f"{len(user)} headers for users, at most "
                        f"{MOST_USER_HEADERS}")
    needed = set()
    for header in sorted(installed):
        if not (source / header).exists():
            failures.append(f"{header} does not exist")
            continue
        for other in includes(source / header):
            needed.add(other)
            if other not in installed:
                failures.append(f"{header} is installed without {other}")
    for header in support:
        if header not in needed:
            failures.append(f"{header} supports nothing that is installed")
    documents = [source / "README.md", *source.glob("*/README.md"),
                 *source.glob("docs/*.md"), *source.glob("examples/*.cc"),
                 *source.glob("tests/consumer/*.cc")]
    for document in documents:
        for header in includes(document):
            if header not in user:
                failures.append(f"{document.relative_to(source)} includes "
                                f"{header}, which is not for users")
    print(f"{len(user)} headers for users, {len(support)} that these include")
    if failures:
        sys.exit("\n".join(failures))

main(pathlib.Path(sys.argv[1]))
