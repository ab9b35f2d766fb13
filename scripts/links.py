#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""links.py FOLDER...: are the pages in these folders whole?
links.py --markdown FOLDER: the same of the links between its *.md

Every link of every *.html to a file must lead to one, with the place after # in
it, and no page may load anything from elsewhere (scripts, styles, pictures,
fonts, frames); links to other sites are only counted.  One line for each
failure; exit code 1 if there is any, 2 for a folder without pages.

Of *.md, which must lead to files and to headings (as GitHub calls their places:
small letters, - for blanks), those in folders named build* or .* are left out.
There README.md is one page, and those in results are read: LONGEST.
"""
import html.parser
import pathlib
import re
import sys
import urllib.parse

# What a browser fetches by itself, by element and attribute.
LOADS = {("script", "src"), ("img", "src"), ("iframe", "src"),
         ("source", "src"), ("video", "src"), ("audio", "src"),
         ("embed", "src"), ("object", "data"), ("input", "src")}
# Words of a page, tables, comments and blocks of code left out, and its lines.
LONGEST = {"README.md": (1200, 120), "results": (1500, None)}
STYLES = re.compile(r"""(?:url\(\s*["']?|@import\s+["'])([^"')]+)""")


class Page(html.parser.HTMLParser):
    """Targets and places of one page."""

    def __init__(self, path):
        super().__init__(convert_charrefs=True)
        self.links, self.loads, self.places = [], [], set()
        self.is_style = False
        self.feed(path.read_text(encoding="utf-8", errors="replace"))

    def handle_starttag(self, tag, attrs):
        self.is_style = tag == "style"
        given = {name: value or "" for name, value in attrs}
        self.places.update(given[key] for key in ("id", "name") if key in given)
        if tag == "link":
            is_load = not re.search(
                r"canonical|index|search|next|prev|author|alternate|copyright",
                given.get("rel", ""))
            (self.loads if is_load else self.links).append(
                given.get("href", ""))
        elif "href" in given:
            self.links.append(given["href"])
        self.loads += [given[name] for of, name in LOADS
                       if of == tag and given.get(name)]
        self.loads += STYLES.findall(given.get("style", ""))

    def handle_data(self, data):
        if self.is_style:
            self.loads += STYLES.findall(data)
            self.is_style = False


def is_elsewhere(target):
    return bool(re.match(r"(?:[a-z][a-z0-9+.-]*:)?//", target, re.I))


def is_inside(target):
    """Of the page itself, or nothing to follow."""
    return not target or re.match(r"(data|mailto|javascript|about|blob):",
                                  target, re.I)


class Check:
    def __init__(self):
        self.pages, self.failures, self.others = {}, [], 0

    def page(self, path):
        path = path.resolve()
        if path not in self.pages:
            self.pages[path] = Page(path)
        return self.pages[path]

    def follow(self, path, target):
        name, _, place = target.partition("#")
        name = urllib.parse.unquote(name.partition("?")[0])
        place = urllib.parse.unquote(place)
        end = path.parent / name if name else path
        if end.is_dir():
            end = end / "index.html"
        if not end.is_file():
            self.failures.append(f"{path}: {target}: there is no such file")
        # The viewer's pages keep their state there.
        elif (place and end.suffix == ".html" and "=" not in place
              and place not in self.page(end).places):
            self.failures.append(f"{path}: {target}: no such place in it")

    def run(self, path):
        page = self.page(path)
        for target in page.links + page.loads:
            if is_inside(target):
                continue
            if not is_elsewhere(target):
                self.follow(path, target)
            elif target in page.loads:
                self.failures.append(f"{path}: {target}: loaded from elsewhere")
            else:
                self.others += 1

    def style(self, path):
        for target in STYLES.findall(path.read_text(errors="replace")):
            if is_elsewhere(target):
                self.failures.append(f"{path}: {target}: loaded from elsewhere")
            elif not is_inside(target) and not target.startswith("#"):
                self.follow(path, target)


def without_code(text):
    text = re.sub(r"^ *```.*?^ *```", "", text, flags=re.S | re.M)
    return re.sub(r"`[^`\n]*`", lambda code: "x" * len(code.group()), text)


def places(text):
    """Of headings, a second of the same name with -1, and of <a id="">."""
    found, seen = set(re.findall(r"""<a (?:id|name)=["']([^"']+)""", text)), {}
    text = re.sub(r"^ *```.*?^ *```", "", text, flags=re.S | re.M)
    for heading in re.findall(r"^#{1,6} +(.*?) *#*$", text, re.M):
        heading = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading)
        name = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
        count = seen.get(name, 0)
        seen[name] = count + 1
        found.add(f"{name}-{count}" if count else name)
    return found


def check_markdown(root):
    """One line a dead link, and how many pages there are."""
    pages = [path for path in sorted(root.rglob("*.md"))
             if not any(part.startswith((".", "build", "node_modules"))
                        for part in path.relative_to(root).parts)]
    failures = []
    for path in pages:
        text = without_code(path.read_text(encoding="utf-8"))
        for target in re.findall(r"\]\(<?([^)\s>]+)>?(?: \"[^\"]*\")?\)", text):
            if is_inside(target) or is_elsewhere(target):
                continue
            name, _, place = target.partition("#")
            end = path.parent / urllib.parse.unquote(name) if name else path
            if not end.exists():
                failures.append(f"{path}: {target}: there is no such file")
            elif (place and end.suffix == ".md" and urllib.parse.unquote(place)
                  not in places(end.read_text(encoding="utf-8"))):
                failures.append(f"{path}: {target}: no such place in it")
    return pages, failures


def words_of(text):
    """How many there are outside of tables, comments and blocks of code."""
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    text = re.sub(r"^ *```.*?^ *```", "", text, flags=re.S | re.M)
    return sum(len(line.split()) for line in text.splitlines()
               if not line.lstrip().startswith("|"))


def check_lengths(root, pages):
    """One line a page that is too long."""
    failures = []
    for path in pages:
        most, lines = LONGEST.get(path.relative_to(root).parts[0], (None, None))
        text = path.read_text(encoding="utf-8")
        words, count = words_of(text), len(text.splitlines())
        if most and words > most:
            failures.append(f"{path}: expected at most {most} words outside of "
                            f"tables, found {words}")
        if lines and count > lines:
            failures.append(f"{path}: expected at most {lines} lines, found "
                            f"{count}")
    return failures


def main_markdown(folder):
    pages, failures = check_markdown(pathlib.Path(folder))
    failures += check_lengths(pathlib.Path(folder), pages)
    if not pages:
        print(f"links: {folder}: expected *.md, found none", file=sys.stderr)
        return 2
    for failure in failures:
        print(failure)
    print(f"links: {len(pages)} pages, {len(failures)} failures")
    return 1 if failures else 0


def main():
    check, count = Check(), 0
    for folder in map(pathlib.Path, sys.argv[1:]):
        pages = sorted(folder.rglob("*.html"))
        if not pages:
            print(f"links: {folder}: expected pages, found none",
                  file=sys.stderr)
            return 2
        count += len(pages)
        for path in pages:
            check.run(path)
        for path in sorted(folder.rglob("*.css")):
            check.style(path)
    for failure in sorted(set(check.failures)):
        print(failure)
    print(f"links: {count} pages, {len(set(check.failures))} failures, "
          f"{check.others} links to other sites (not followed)")
    return 1 if check.failures else 0


if __name__ == "__main__":
    sys.exit(main_markdown(sys.argv[2]) if sys.argv[1:2] == ["--markdown"]
             else main())
