# SPDX-License-Identifier: GPL-3.0-or-later
"""Counts what users can set: python3 option_fields_test.py SOURCE

An option field is a member of a struct of an installed header whose name ends
in Options, Settings, Request, Limits, Search or Cache; a struct within a struct
counts as a field, too.  What a run is asked, the keys of a scene file and what
Plan and Optimize are asked (start and goal, what only a user can say, and the
settings of the two studies that they replace), is counted apart.  A field has its place where a published
table shows that turning it helps somebody, or where only the user can say it
(results/retired.md).  Fails above the agreed numbers and where nothing is
found; prints every struct with its fields.
"""
import pathlib
import re
import sys

# 77, the 6 of RowsOptions, which Python took as arguments, what a margin is
# worth, which only the user can say, and whether a clearance is to be kept (the
# table of 94aa227a: 0.29 to 0.80 of it was, now all where there is room).
MOST_OPTIONS = 85
# 43, what is asked of a robot that turns (8, with how many processors it may take,
# which only the user can say), of the optimiser for it (7), and of a part that comes
# out (3).
MOST_OF_A_RUN = 61

NAME = r"\w+(?:Options|Settings|Request|Limits|Search|Cache)"
OF_A_RUN = ("problems/scenes/", "planners/solve/", "planners/rigid/")


def installed_headers(source):
    """Those that the lists named ...HEADERS of the build files hold."""
    headers = []
    for folder in ("files", "core", "constraints", "planners", "problems",
                   "viewer"):
        for lists in sorted((source / folder).rglob("CMakeLists.txt")):
            text = re.sub(r"#.*", "", lists.read_text())
            for words in re.findall(r"HEADERS\s([^()$]*)\)", text):
                headers += [lists.parent / word for word in words.split()
                            if word.endswith(".h")]
    missing = [str(header) for header in headers if not header.exists()]
    if missing:
        sys.exit("installed headers that do not exist: " + ", ".join(missing))
    return headers


def without_comments(text):
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)


def body_at(text, opening):
    """What stands between the brace at `opening` and its partner."""
    depth = 0
    for end in range(opening, len(text)):
        depth += {"{": 1, "}": -1}.get(text[end], 0)
        if depth == 0:
            return text[opening + 1:end]
    sys.exit("a brace without its partner after: " + text[opening - 60:opening])


def fields(body):
    """Names of the data members; not of functions, types and constants."""
    names = []
    # Bodies of functions end their statement, other braces do not.
    while re.search(r"\{[^{}]*\}", body):
        body = re.sub(r"(\)\s*(?:const|noexcept|override|\s)*)\{[^{}]*\}",
                      r"\1;", body)
        body = re.sub(r"(?<![)\s])(\s*)\{[^{}]*\}", r"\1<>", body)
    for statement in body.split(";"):
        statement = " ".join(statement.split())
        if not statement:
            continue
        if re.match(r"(static|enum|struct|class|using|friend|public|private)\b",
                    statement):
            continue
        declared = re.split(r"=|<>", statement)[0].strip()
        # A function's parentheses; those of a std::function are its type's.
        bare = declared
        while re.search(r"<[^<>]*>", bare):
            bare = re.sub(r"<[^<>]*>", "", bare)
        if "(" in bare:
            continue
        names += [name.strip().split()[-1].lstrip("*&")
                  for name in bare.split(",")]
    return names


def check(what, counts, most):
    total = sum(len(names) for names in counts.values())
    print(f"{what}: {total} fields of {len(counts)} structs, at most {most}")
    for struct, names in sorted(counts.items()):
        print(f"  {struct} {len(names)}: {', '.join(names)}")
    return total <= most and total > 0


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    source = pathlib.Path(sys.argv[1]).resolve()
    options, of_a_run = {}, {}
    for header in installed_headers(source):
        text = without_comments(header.read_text())
        for struct in re.finditer(rf"\bstruct ({NAME})\b[^;{{]*\{{", text):
            where = str(header.relative_to(source))
            counts = of_a_run if where.startswith(OF_A_RUN) else options
            counts[f"{where}: {struct[1]}"] = fields(
                body_at(text, struct.end() - 1))
    is_right = check("options", options, MOST_OPTIONS)
    is_right &= check("what a run is asked", of_a_run, MOST_OF_A_RUN)
    if not is_right:
        sys.exit("more fields than agreed, or none found: make it a constant "
                 "beside the code, or publish the table that shows who gains "
                 "by it and raise the number here")


if __name__ == "__main__":
    main()
