# SPDX-License-Identifier: GPL-3.0-or-later
# Sphinx: scripts/docs.sh runs it on what Doxygen made of the headers.
import pathlib
import re
import sys

here = pathlib.Path(__file__).parent
sys.path.insert(0, str(here.parent / "python"))

project = "PhongPD"
author = "the authors of PhongPD"
copyright = "GPL-3.0-or-later"
release = re.search(r"\n  VERSION ([0-9.]+)",
                    (here.parent / "CMakeLists.txt").read_text()).group(1)

extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
exclude_patterns = ["promises.md"]  # shown by its own page's include
myst_enable_extensions = ["deflist"]
myst_heading_anchors = 3
# Pages of the repository are shown whole; what they link to beside them is on
# the page "in the repository".
suppress_warnings = ["myst.header"]
nitpicky = False

breathe_projects = {"phongpd": str(here.parent / "build/site/xml")}
breathe_default_project = "phongpd"
breathe_default_members = ("members",)

# The compiled half is not needed to read docstrings.
autodoc_mock_imports = ["phongpd._native", "casadi", "cyipopt", "ompl"]
autodoc_typehints = "none"  # shapes are in the docstrings
autoclass_content = "both"
autodoc_member_order = "bysource"

html_theme = "furo"
html_title = "PhongPD"
html_static_path = []
