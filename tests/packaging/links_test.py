#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""links_test.py LINKS: the check of links finds what is dead, and only that."""
import pathlib
import subprocess
import sys
import tempfile


def failures(pages, *how):
    """What links.py says of these pages, and its exit code."""
    with tempfile.TemporaryDirectory() as name:
        for page, text in pages.items():
            (pathlib.Path(name) / page).write_text(text)
        done = subprocess.run([sys.executable, sys.argv[1], *how, name],
                              capture_output=True, text=True, check=False)
        lines = [line[len(str(pathlib.Path(name).resolve())) + 1:]
                 for line in done.stdout.splitlines()[:-1]]
        return done.returncode, lines


def main():
    whole = {"a.html": '<a href="b.html#p">b</a><a href="#me" id="me">me</a>'
                       '<a href="b.html#eye=1,2&t=3">a view</a>'
                       '<a href="https://o.example/x">elsewhere</a>'
                       '<img src="data:image/png;base64,AA=="><img src="c%20.svg">'
                       '<link rel="stylesheet" href="s.css">',
             "b.html": '<p id="p">', "c .svg": "<svg/>",
             "s.css": 'a{background:url("c%20.svg")}'}
    assert failures(whole) == (0, []), failures(whole)
    for page, text, expected in (
            ("a.html", '<a href="no.html">', "no such file"),
            ("a.html", '<a href="b.html#no">', "no such place"),
            ("a.html", '<iframe src="no.html"></iframe>', "no such file"),
            ("a.html", '<script src="//o.example/a.js"></script>',
             "loaded from elsewhere"),
            ("a.html", '<link rel="stylesheet" href="https://o.example/a.css">',
             "loaded from elsewhere"),
            ("a.html", '<style>@import "https://o.example/a.css";</style>',
             "loaded from elsewhere"),
            ("s.css", "@font-face{src:url(https://o.example/f.woff2)}",
             "loaded from elsewhere"),
            ("s.css", "a{background:url(no.png)}", "no such file")):
        code, lines = failures({**whole, page: text})
        assert code == 1 and len(lines) == 1, (text, lines)
        assert lines[0].startswith(page) and expected in lines[0], lines
    assert failures({"only.txt": ""})[0] == 2
    markdown = {"a.md": "# Of `x` & [y](b.md): z\n[b](b.md#what-helps-1) "
                        "[me](#of-x--y-z) [c](c%20.csv)\n[i](https://o.example#n)\n"
                        "`[no](no.md)`\n```\n[no](no.md)\n# No\n```\n",
                "b.md": "## What helps\n## What helps\n", "c .csv": ""}
    assert failures(markdown, "--markdown") == (0, []), failures(
        markdown, "--markdown")
    for text, expected in (("[b](no.md)", "no such file"),
                           ("[b](b.md#what-help)", "no such place"),
                           ("[b](b.md#what-helps-2)", "no such place"),
                           ("[b](#no)", "no such place")):
        code, lines = failures({**markdown, "a.md": text}, "--markdown")
        assert code == 1 and len(lines) == 1, (text, lines)
        assert lines[0].startswith("a.md") and expected in lines[0], lines
    assert failures({"only.txt": ""}, "--markdown")[0] == 2
    long = "# T\n" + "word " * 1201 + "\n"
    for page, text, expected in (
            ("README.md", long, "at most 1200 words outside of tables, found 1203"),
            ("README.md", "# T\n" * 121, "at most 120 lines, found 121")):
        code, lines = failures({page: text}, "--markdown")
        assert code == 1 and len(lines) == 1 and expected in lines[0], lines
    free = "# T\n| " + "word " * 2000 + "|\n```\n" + "word " * 2000 + "\n```\n"
    assert failures({"README.md": free, "other.md": 2 * long}, "--markdown") == (
        0, [])
    print("links.py tells dead links from live ones")


if __name__ == "__main__":
    main()
