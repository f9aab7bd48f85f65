"""Compares the outlines of a text with those of fontTools.

    judge.py PARTC OUTLINES

OUTLINES is a JSON file: the path of a font, a text, the height of the capitals in
mm, the part of the width before x = 0, and the outlines that partc gives. Each has
the index of its character and its parts, which are lists of control points in mm.
PARTC is not used.

fontTools draws the glyphs, moved by the advance widths of the table hmtx and the
pairs of the table kern. Contours that enclose nothing, parts without a length, and
curves that are lines are treated as docs/drawing-files.md says. Every point has to
be within 1e-9 mm.
"""

import json
import sys

from fontTools.pens.recordingPen import DecomposingRecordingPen
from fontTools.pens.basePen import decomposeQuadraticSegment
from fontTools.ttLib import TTFont

NEAR = 1e-9  # mm


def capitals(font, glyphs, cmap):
    os2 = font["OS/2"]
    if os2.version >= 2 and os2.sCapHeight > 0:
        return os2.sCapHeight
    pen = DecomposingRecordingPen(glyphs)
    glyphs[cmap[ord("H")]].draw(pen)
    return max(p[1] for _, points in pen.value for p in points if p)


def kerning(font, left, right):
    if "kern" not in font:
        return 0
    for table in font["kern"].kernTables:
        if table.format == 0 and (left, right) in table.kernTable:
            return table.kernTable[left, right]
    return 0


def contours(glyphs, name):
    """The closed contours of a glyph: lists of control points of their parts."""
    pen = DecomposingRecordingPen(glyphs)
    glyphs[name].draw(pen)
    found, now, first, parts = [], None, None, []
    for word, points in pen.value:
        if word == "moveTo":
            now = first = points[0]
            parts = []
        elif word == "lineTo":
            parts.append([now, points[0]])
            now = points[0]
        elif word == "curveTo":
            parts.append([now, *points])
            now = points[-1]
        elif word == "qCurveTo":
            if points[-1] is None:
                # All points are beside the curve; it begins between the last and the first one.
                parts = []
                off = list(points[:-1])
                first = now = tuple((a + b) / 2 for a, b in zip(off[-1], off[0]))
                points = (*off, now)
            for c, q in decomposeQuadraticSegment(points):
                parts.append([now, c, q])
                now = q
        elif word in ("closePath", "endPath"):
            if now != first:
                parts.append([now, first])
            found.append(parts)
    return found


def cross(o, a, b):
    return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])


def simplified(parts):
    """The parts without those of no length, and with curves that are lines as lines; none if the
    contour encloses nothing."""
    points = [p for part in parts for p in part]
    if not points or all(cross(points[0], a, b) == 0 for a in points for b in points):
        return []
    result = []
    for part in parts:
        p, q = part[0], part[-1]
        if all(c == p for c in part):
            continue
        between = lambda c: cross(p, q, c) == 0 and (
            (c[0] - p[0]) * (q[0] - c[0]) + (c[1] - p[1]) * (q[1] - c[1]) >= 0
        )
        result.append([p, q] if all(between(c) for c in part[1:-1]) else part)
    return result


def is_near(a, b):
    return len(a) == len(b) and all(
        len(p) == len(q)
        and all(abs(x - u) <= NEAR and abs(y - v) <= NEAR for (x, y), (u, v) in zip(p, q))
        for p, q in zip(a, b)
    )


def is_same(a, b):
    """True if two closed contours have the same parts, from any beginning."""
    return any(is_near(a[k:] + a[:k], b) for k in range(len(a)))


def main():
    with open(sys.argv[2]) as file:
        given = json.load(file)
    font = TTFont(given["font"])
    glyphs, cmap = font.getGlyphSet(), font.getBestCmap()
    scale = given["height"] / capitals(font, glyphs, cmap)
    names = [cmap[ord(c)] for c in given["text"]]
    widths = [
        font["hmtx"][n][0] + (kerning(font, n, names[k + 1]) if k + 1 < len(names) else 0)
        for k, n in enumerate(names)
    ]
    faults, count, x = [], 0, -given["share"] * sum(widths)
    for k, name in enumerate(names):
        own = [o["parts"] for o in given["outlines"] if o["character"] == k]
        expected = [c for c in map(simplified, contours(glyphs, name)) if c]
        placed = [[[((x + px) * scale, py * scale) for px, py in p] for p in c] for c in expected]
        if len(own) != len(placed):
            faults.append(f"{name}: {len(own)} outlines instead of {len(placed)}")
        for a, b in zip(own, placed):
            count += len(a)
            if not is_same([[tuple(q) for q in p] for p in a], b):
                faults.append(f"{name}: an outline differs")
        x += widths[k]
    if count == 0:
        faults.append("nothing was compared")
    print("\n".join(faults))
    sys.exit(1 if faults else 0)


main()
