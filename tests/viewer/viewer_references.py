# SPDX-License-Identifier: GPL-3.0-or-later
"""Three reference views, compared pixel by pixel.

The canvas alone is compared, so that fonts do not matter.  A pixel differs
where one of its colours is off by more than CHANNEL of 255; a picture is the
reference where at most SHARE of its pixels differ.  Other versions of the
software renderer place edges and their smoothing differently: without any
smoothing of edges, which is more than they differ, the share is below SHARE (a
test, too), and what a person would call another picture is above it.

    scripts/build.sh phongpd && python3 tests/viewer/\\
    viewer_browser_test.py build/phongpd build/tests/viewer --renew

draws the references anew; look at them before you commit them.
"""
import base64
import json
import pathlib

CHANNEL = 48
SHARE = 0.0045
FOLDER = pathlib.Path(__file__).resolve().parent / "references"

# By name: the page, its link, size and theme.
VIEWS = {
    "plan": ("routes", "#eye=-0.9,0.55,0.26,0,0,0&t=0.6&way=0&xray=0",
             400, 300, "light"),
    "section": ("contact", "#eye=-0.9,0.9,0.95,0,0,0&cut=z,0.5,0&map=phong",
                400, 300, "light"),
    "depth": ("depth", "#eye=-0.6,0.4,1.05,0,0,0&t=0&way=0&xray=1",
              300, 400, "dark"),
}

# What makes another picture of each; every one must be noticed.
CHANGES = {
    "plan": {
        "no obstacles": "viewer.stage.groups.obstacle.visible = false",
        "obstacles of another colour": "viewer.stage.solids.forEach(s => "
        "s.entry.role === 'obstacle' && "
        "s.faces[0].material.color.set(0xd0a080))",
        "no path": "viewer.stage.groups.paths.visible = false",
        "turned by three degrees": "viewer.orbit.yaw += 0.052",
    },
    "section": {
        "no colours of the cut": "viewer.map.mesh.visible = false",
        "colours of another value": "kMapColors.reverse(), "
        "viewer.map.paint(viewer.map.cells)",
        "no contact space": "viewer.stage.groups.contact.visible = false",
    },
    "depth": {
        "no obstacle": "viewer.stage.groups.mesh.visible = false",
        "no windows": "viewer.state.show.windows = false",
        "the light theme": "viewer.toggleTheme()",
    },
}

PICTURE = ("(() => { viewer.draw(); "
           "return document.getElementById('canvas').toDataURL(); })()")

# The share of pixels in which the canvas differs from the picture.
DIFFERENCE = """(async () => {
  const image = new Image();
  image.src = %s;
  await image.decode();
  viewer.draw();
  const canvas = document.getElementById('canvas');
  if (image.width !== canvas.width || image.height !== canvas.height) return 1;
  const pixels = source => {
    const flat = document.createElement('canvas');
    [flat.width, flat.height] = [image.width, image.height];
    const g = flat.getContext('2d', {willReadFrequently: true});
    g.drawImage(source, 0, 0);
    return g.getImageData(0, 0, flat.width, flat.height).data;
  };
  const a = pixels(canvas), b = pixels(image);
  let count = 0;
  for (let i = 0; i < a.length; i += 4) {
    if ([0, 1, 2].some(k => Math.abs(a[i + k] - b[i + k]) > %d)) ++count;
  }
  return 4 * count / a.length;
})()"""


def difference(browser, png):
    """Share of the canvas's pixels that are not the picture's."""
    url = "data:image/png;base64," + base64.b64encode(png).decode()
    return browser.run(DIFFERENCE % (json.dumps(url), CHANNEL))


def open_view(browser, folder, name, smooth=True):
    page, link, width, height, theme = VIEWS[name]
    # No smoothing of edges: as far off as another renderer is.
    script = "" if smooth else """
        const get = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function(kind, more) {
          return get.call(this, kind, {...more, antialias: false});
        };"""
    added = browser.call("Page.addScriptToEvaluateOnNewDocument",
                         source=script)["identifier"]
    browser.open(folder / f"{page}.html", link, width, height, theme)
    browser.call("Page.removeScriptToEvaluateOnNewDocument", identifier=added)
    if "map=" in link:
        browser.wait("viewer.map.cells === kMapCells")


def canvas(browser):
    return base64.b64decode(browser.run(PICTURE).split(",", 1)[1])


def renew(browser, folder):
    """Draws the references anew."""
    FOLDER.mkdir(exist_ok=True)
    for name in VIEWS:
        open_view(browser, folder, name)
        (FOLDER / f"{name}.png").write_bytes(canvas(browser))
        print(f"{FOLDER / name}.png: drawn anew", flush=True)


def compare(browser, checks, folder):
    """Each view is its reference, and no longer when it is changed."""
    for name, changes in CHANGES.items():
        reference = (FOLDER / f"{name}.png").read_bytes()
        for smooth in (True, False):
            open_view(browser, folder, name, smooth)
            share = difference(browser, reference)
            print(f"{name}, {'' if smooth else 'not '}smooth: {share:.2%} of "
                  "the pixels differ", flush=True)
            if share > SHARE:
                (folder / f"{name}-differs.png").write_bytes(canvas(browser))
            checks.expect(
                share <= SHARE, f"{name}: {share:.2%} of the pixels differ "
                f"from references/{name}.png, expected at most {SHARE:.2%}; "
                f"see {name}-differs.png")
        for what, change in changes.items():
            open_view(browser, folder, name)
            browser.run(f"({change}, 0)")
            share = difference(browser, reference)
            print(f"{name}, {what}: {share:.2%}", flush=True)
            checks.expect(share > SHARE,
                          f"{name}: the comparison notices {what} ({share})")
        checks.quiet(name)
