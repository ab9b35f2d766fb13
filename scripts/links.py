#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""links.py FOLDER...: are the pages in these folders whole?

Every link of every *.html to a file must lead to one, with the place after # in
it, and no page may load anything from elsewhere (scripts, styles, pictures,
fonts, frames); links to other sites are only counted.  One line for each
failure; exit code 1 if there is any, 2 for a folder without pages.
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
    sys.exit(main())
