#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""docs_dark.py STYLESHEET: lets pages be dark where the reader prefers it.

Debian's build of the theme furo has lost the rules for that: its dark colours
come on a click only.  Says them once more, for the state that a page is opened
in, if they are not there.
"""
import pathlib
import re
import sys

sheet = pathlib.Path(sys.argv[1])
css = sheet.read_text(encoding="utf-8")
if "prefers-color-scheme" not in css:
    rules = re.findall(r'(?:html )?body\[data-theme="?dark"?\][^{}]*\{[^{}]*\}',
                       css)
    if not any("--color-background-primary" in rule for rule in rules):
        sys.exit(f"{sheet}: expected the dark colours of furo, found none; "
                 "see what the theme has become")
    auto = "\n".join(re.sub(r'\[data-theme="?dark"?\]', '[data-theme="auto"]',
                            rule)
                     for rule in rules if "theme-icon" not in rule)
    sheet.write_text(css + "\n@media not print {\n@media (prefers-color-scheme:"
                     " dark) {\n" + auto + "\n}\n}\n", encoding="utf-8")
