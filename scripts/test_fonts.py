#!/usr/bin/env python3
"""Makes the fonts of test/data/fonts, in which the tests write texts.

Run it as `python3 -B scripts/test_fonts.py`. It needs fontTools, the Debian package
python3-fonttools. The letters are drawn here; they come from no other font. Every
letter is one case of what an outline can be:

  H  lines
  I  a contour that is only one point, and one that is only a line, beside a stem
  O  a hole; all points of its contours lie beside the curve
  A  a hole of lines; A and V are kerned
  V  lines
  C  curves and lines
  +  two bars that cross and run in the same sense
  @  an island within a hole
  N  a contour within another one of the same sense
  X  two contours that cross and run in opposite senses
  8  a contour that crosses itself
  Ф  a letter that is not Latin

`quadratic.ttf` has quadratic curves, and a table OS/2 without the height of the
capitals. `cubic.otf` has cubic curves, and states the height; some of its curves
begin or end with a control point at their end.
"""

import os

from fontTools.fontBuilder import FontBuilder
from fontTools.misc.timeTools import epoch_diff
from fontTools.pens.t2CharStringPen import T2CharStringPen
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.ttLib import newTable
from fontTools.ttLib.tables._k_e_r_n import KernTable_format_0

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "test/data/fonts")
CAPITALS = 700
CHARACTERS = {
    " ": "space",
    "H": "H",
    "I": "I",
    "O": "O",
    "A": "A",
    "V": "V",
    "C": "C",
    "+": "plus",
    "@": "at",
    "N": "N",
    "X": "X",
    "8": "eight",
    "Ф": "uni0424",
}
ADVANCES = {"space": 350, "I": 220, "plus": 560, "at": 960}
KERNS = {("A", "V"): -90, ("V", "A"): -80, ("H", "O"): 15}


def polygon(*points):
    """A contour of lines, clockwise as it is written."""
    return [("line", p) for p in points]


def box(x, y, w, h):
    """A rectangle, clockwise."""
    return polygon((x, y), (x, y + h), (x + w, y + h), (x + w, y))


def back(contour):
    """A contour of lines in the opposite sense."""
    return contour[::-1]


def ring(x, y, rx, ry, sense):
    """A contour about a middle, all points of which are control points: for quadratic curves
    eight, whose curves meet between them; for cubic ones an ellipse."""
    return [("ring", (x, y, rx, ry, sense))]


LETTERS = {
    "space": [],
    "H": [
        polygon((60, 0), (60, 700), (160, 700), (160, 400), (440, 400), (440, 700), (540, 700),
                (540, 0), (440, 0), (440, 300), (160, 300), (160, 0))
    ],
    "I": [box(60, 0, 100, 700), [("line", (300, 900))], polygon((10, 10), (10, 50))],
    "O": [ring(320, 350, 270, 360, 1), ring(320, 350, 170, 257, -1)],
    "A": [
        polygon((20, 0), (260, 700), (360, 700), (600, 0), (490, 0), (430, 180), (190, 180),
                (130, 0)),
        back(polygon((225, 281), (310, 540), (395, 281))),
    ],
    "V": [polygon((20, 700), (130, 700), (310, 130), (490, 700), (600, 700), (360, 0), (260, 0))],
    "C": [
        [
            ("line", (540, 650)),
            ("line", (540, 480)),
            ("curve", ((400, 610), (150, 610), (150, 350))),
            ("curve", ((150, 90), (400, 90), (540, 220))),
            ("line", (540, 50)),
            ("curve", ((400, -30), (40, -30), (40, 350))),
            ("curve", ((40, 730), (400, 730), (540, 650))),
        ]
    ],
    "plus": [box(60, 300, 440, 100), box(230, 130, 100, 440)],
    "at": [
        ring(480, 350, 440, 350, 1),
        ring(480, 350, 340, 250, -1),
        ring(480, 350, 150, 131, 1),
    ],
    "N": [box(60, 0, 480, 700), box(160, 100, 280, 300), back(box(200, 450, 200, 200))],
    "X": [box(60, 0, 300, 700), back(box(240, 100, 300, 500))],
    "eight": [polygon((60, 0), (540, 700), (60, 700), (540, 0))],
    "uni0424": [
        box(270, -50, 100, 800),
        ring(320, 350, 280, 210, 1),
        ring(170, 350, 60, 110, -1),
        ring(470, 350, 60, 110, -1),
    ],
}


def draw(pen, contour, cubic):
    if contour[0][0] == "ring":
        draw_ring(pen, contour[0][1], cubic)
        return
    pen.moveTo(contour[0][1])
    for kind, value in contour[1:]:
        if kind == "line":
            pen.lineTo(value)
        else:
            if cubic:
                pen.curveTo(*value)
            else:
                # Two quadratic curves, which meet between the two control points.
                pen.qCurveTo(*value)
    pen.closePath()


def draw_ring(pen, ring_, cubic):
    x, y, rx, ry, sense = ring_
    if not cubic:
        # The corners of an octagon around an ellipse: clockwise for the sense 1.
        k = 0.41
        around = [(k, 1), (1, k), (1, -k), (k, -1), (-k, -1), (-1, -k), (-1, k), (-k, 1)][::sense]
        pen.qCurveTo(*[(round(x + a * rx), round(y + b * ry)) for a, b in around], None)
        pen.closePath()
        return
    k = 0.55
    quarters = [
        ((0, 1), (k, 1), (1, k), (1, 0)),
        ((1, 0), (1, -k), (k, -1), (0, -1)),
        ((0, -1), (-k, -1), (-1, -k), (-1, 0)),
        ((-1, 0), (-1, k), (-k, 1), (0, 1)),
    ]
    if sense < 0:
        quarters = [q[::-1] for q in quarters[::-1]]
    place = lambda p: (round(x + p[0] * rx), round(y + p[1] * ry))
    pen.moveTo(place(quarters[0][0]))
    for q in quarters:
        pen.curveTo(*[place(p) for p in q[1:]])
    pen.closePath()


def advance(name):
    return ADVANCES.get(name, 640 if name in ("O", "uni0424") else 600)


def builder(is_cubic):
    names = [".notdef"] + list(CHARACTERS.values())
    fb = FontBuilder(1000, isTTF=not is_cubic)
    fb.setupGlyphOrder(names)
    fb.setupCharacterMap({ord(c): n for c, n in CHARACTERS.items()})
    return fb, names


def finished(fb, bearings, family, os2, file):
    fb.setupHorizontalMetrics({n: (advance(n), b) for n, b in bearings.items()})
    fb.setupHorizontalHeader(ascent=800, descent=-200)
    fb.setupNameTable({"familyName": family, "styleName": "Regular"})
    fb.setupOS2(**os2)
    fb.setupPost()
    kern = newTable("kern")
    kern.version = 0
    table = KernTable_format_0(False)
    table.coverage, table.tupleIndex, table.kernTable = 1, None, dict(KERNS)
    kern.kernTables = [table]
    fb.font["kern"] = kern
    # The same bytes at every run.
    fb.font["head"].created = fb.font["head"].modified = -epoch_diff
    fb.font.recalcTimestamp = False
    fb.font.save(os.path.join(FOLDER, file))


def main():
    os.makedirs(FOLDER, exist_ok=True)
    fb, names = builder(False)
    glyphs = {}
    for name in names:
        pen = TTGlyphPen(None)
        for contour in LETTERS.get(name, []):
            draw(pen, contour, False)
        glyphs[name] = pen.glyph()
    fb.setupGlyf(glyphs)
    # TrueType moves a glyph so that it begins at its bearing: V moves by 7.
    bearings = {n: getattr(g, "xMin", 0) + (7 if n == "V" else 0) for n, g in glyphs.items()}
    finished(fb, bearings, "Quadratic", {"version": 1, "sTypoAscender": 800}, "quadratic.ttf")

    fb, names = builder(True)
    strings = {}
    for name in names:
        pen = T2CharStringPen(advance(name), None)
        for contour in LETTERS.get(name, []):
            draw(pen, contour, True)
        if name == "I":
            # A curve with a control point at each end, and one that is a line.
            pen.moveTo((60, 710))
            pen.curveTo((60, 710), (110, 800), (160, 710))
            pen.curveTo((130, 710), (90, 710), (60, 710))
            pen.closePath()
        strings[name] = pen.getCharString()
    fb.setupCFF("Cubic", {"FullName": "Cubic"}, strings, {})
    os2 = {"version": 4, "sTypoAscender": 800, "sCapHeight": CAPITALS}
    finished(fb, dict.fromkeys(names, 0), "Cubic", os2, "cubic.otf")


if __name__ == "__main__":
    main()
