# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes of a plane as SVG, in colours that are readable on light and on dark."""
import numpy as np

# Of the metrics, in the hues that they have everywhere (metric_colors_test.py).
EUCLID, PHONG = "#e0662a", "#2f7fd0"
CONTACT, MOVES, OBSTACLE, FREE, TEXT = (
    "#2f93d0", "#9a6bc4", "#8a94a0", "#1f9e77", "#76808c")


class Drawing:
    """Shapes of a plane whose y points up, `scale` pixels a unit."""

    def __init__(self, width, height, scale=60.0):
        self.size = (width, height)
        self.scale = scale
        self.parts = []

    def at(self, p):
        return (self.scale * p[0], self.scale * (self.size[1] - p[1]))

    def _points(self, points):
        return " ".join("{:.1f},{:.1f}".format(*self.at(p)) for p in points)

    def area(self, points, fill="none", stroke="none", width=1.5, opacity=0.25,
             dash=""):
        self.parts.append(
            f'<polygon points="{self._points(points)}" fill="{fill}" '
            f'fill-opacity="{opacity}" stroke="{stroke}" stroke-width="{width}" '
            f'stroke-dasharray="{dash}"/>')

    def line(self, points, stroke, width=1.5, dash=""):
        self.parts.append(
            f'<polyline points="{self._points(points)}" fill="none" '
            f'stroke="{stroke}" stroke-width="{width}" stroke-linecap="round" '
            f'stroke-dasharray="{dash}"/>')

    def arrow(self, a, b, stroke, width=1.8):
        a, b = np.array(a, float), np.array(b, float)
        along = (b - a) / max(1e-9, np.linalg.norm(b - a))
        across = np.array([-along[1], along[0]])
        head = 8.0 / self.scale
        self.line([a, b - 0.7 * head * along], stroke, width)
        self.area([b, b - head * along + 0.4 * head * across,
                   b - head * along - 0.4 * head * across], stroke, opacity=1)

    def dot(self, p, fill, radius=4.0):
        x, y = self.at(p)
        self.parts.append(
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" fill="{fill}"/>')

    def circle(self, p, radius, stroke, dash=""):
        x, y = self.at(p)
        self.parts.append(
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius * self.scale:.1f}" '
            f'fill="none" stroke="{stroke}" stroke-width="1.5" '
            f'stroke-dasharray="{dash}"/>')

    def text(self, p, words, fill=TEXT, anchor="start", size=15):
        x, y = self.at(p)
        self.parts.append(
            f'<text x="{x:.1f}" y="{y:.1f}" fill="{fill}" '
            f'text-anchor="{anchor}" font-size="{size}" '
            f'font-family="system-ui, sans-serif">{words}</text>')

    def svg(self):
        w, h = (self.scale * s for s in self.size)
        return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{w:.0f}" '
                f'height="{h:.0f}" viewBox="0 0 {w:.0f} {h:.0f}">\n'
                + "\n".join(self.parts) + "\n</svg>\n")
