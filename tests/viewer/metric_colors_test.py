#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""metric_colors_test.py SOURCE: one colour a metric in pages, still pictures of
the program and figures of results; dark pages have the same hues, lighter."""
import colorsys
import pathlib
import re
import sys
import unittest

SOURCE = pathlib.Path(sys.argv[1])
HEX = "#[0-9a-fA-F]{6}"


def text(path):
    return (SOURCE / path).read_text(encoding="utf-8")


def of_cpp():
    found = re.findall(rf'k(\w+)Color\[\] = "({HEX})"',
                       text("problems/output/metric_color.h"))
    return {name.lower(): color.lower() for name, color in found}


def of_python():
    table = re.search(r"METRIC_COLOURS = \{(.*?)\}",
                      text("python/phongpd/_colours.py"), re.S)[1]
    return {name: color.lower()
            for name, color in re.findall(rf'"(\w+)": "({HEX})"', table)}


def of_page(theme):
    table = re.search(r"kMetricColors = \{(.*?)\n\};", text("viewer/colors.js"),
                      re.S)[1]
    return {name: color.lower() for name, color in re.findall(
        rf"(\w+): '({HEX})'", re.search(rf"{theme}: \{{(.*?)\}}", table)[1])}


def hls(color):
    return colorsys.rgb_to_hls(*(int(color[k:k + 2], 16) / 255
                                 for k in (1, 3, 5)))


class MetricColors(unittest.TestCase):
    def test_are_the_same_everywhere(self):
        self.assertEqual(sorted(of_cpp()), ["euclidean", "phong", "sliding"])
        self.assertEqual(of_cpp(), of_python())
        self.assertEqual(of_cpp(), of_page("light"))

    def test_are_lighter_in_the_dark_and_of_the_same_hue(self):
        dark = of_page("dark")
        self.assertEqual(sorted(dark), sorted(of_cpp()))
        for name, color in of_cpp().items():
            hue, lightness, _ = hls(color)
            dark_hue, dark_lightness, _ = hls(dark[name])
            self.assertGreater(dark_lightness, lightness, name)
            self.assertLess(abs(hue - dark_hue), 0.03, name)

    def test_have_their_hues_in_the_figures_of_the_pages(self):
        found = re.search(rf'EUCLID, PHONG = "({HEX})", "({HEX})"',
                          text("docs/figures/drawing.py"))
        for name, color in zip(("euclidean", "phong"), found.groups()):
            self.assertLess(abs(hls(of_cpp()[name])[0] - hls(color)[0]), 0.06,
                            name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
