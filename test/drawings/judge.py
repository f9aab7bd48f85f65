#!/usr/bin/env python3
"""Reads the drawings of programs with ezdxf and svgpathtools, and compares them with the parts and
the toolpaths.

    judge.py PARTC EXPECTED.json FOLDER

EXPECTED.json is a list of programs with what their drawings have to show, in mm. partc writes both
drawings of each program into the folder. There is a fault where

- ezdxf finds an error in the file or mends something, or the unit is another one,
- an end of a line or of an arc is more than 1e-9 mm from its place, or the middle of an arc, or
  a height,
- a length or an area differs by more than 1e-9 of its size,
- a curve is further than 3e-5 mm from the nodes of the arcs that replace it in the contour, or its
  length or the area differs by more than such a distance allows,
- a rising arc is further than 1e-5 mm from its helix,
- or an object is missing, stands on another layer, or has no name.

The status is 1 if there is a fault.
"""

import json
import math
import os
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import ezdxf
from ezdxf import recover
import svgpathtools

SLACK = 1e-9
CURVE = 3e-5
HELIX = 1e-5
INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"
SVG = "{http://www.w3.org/2000/svg}"


class Fault(Exception):
    pass


def need(condition, words):
    if not condition:
        raise Fault(words)


def apart(p, q):
    return math.dist(p, q)


def near(p, q, slack=SLACK):
    return apart(p, q) <= slack


# Segments -----------------------------------------------------------------------------------------


def ends(s):
    return (s[0], s[1]), (s[2], s[3])


def at(s, t):
    """The point of a segment at a share of its length."""
    if len(s) == 4:
        return s[0] + t * (s[2] - s[0]), s[1] + t * (s[3] - s[1])
    if t == 0.5 and abs(s[6]) < 3:
        # The centre of a flat arc is far away; the chord gives the middle with more digits.
        k = math.tan(s[6] / 4) / 2
        return (
            (s[0] + s[2]) / 2 + k * (s[3] - s[1]),
            (s[1] + s[3]) / 2 - k * (s[2] - s[0]),
        )
    x, y = s[0] - s[4], s[1] - s[5]
    a = t * s[6]
    return (
        s[4] + x * math.cos(a) - y * math.sin(a),
        s[5] + x * math.sin(a) + y * math.cos(a),
    )


def length_of(s):
    if len(s) == 4:
        return apart(*ends(s))
    return math.hypot(s[0] - s[4], s[1] - s[5]) * abs(s[6])


def area_of(s):
    """The area to the left of a segment, up to the origin."""
    (x0, y0), (x1, y1) = ends(s)
    chord = (x0 * y1 - x1 * y0) / 2
    if len(s) == 4:
        return chord
    r = math.hypot(s[0] - s[4], s[1] - s[5])
    return chord + r * r * (s[6] - math.sin(s[6])) / 2


def bulged(p, q, bulge):
    """The segment of a polyline between two vertices."""
    if bulge == 0:
        return [*p, *q]
    k = (1 - bulge * bulge) / (4 * bulge)
    x, y = q[0] - p[0], q[1] - p[1]
    centre = (p[0] + q[0]) / 2 - k * y, (p[1] + q[1]) / 2 + k * x
    return [*p, *q, *centre, 4 * math.atan(bulge)]


def cubic(p, t):
    u = 1 - t
    w = (u * u * u, 3 * u * u * t, 3 * u * t * t, t * t * t)
    return tuple(sum(c * point[i] for c, point in zip(w, p)) for i in range(len(p[0])))


# Weights and places of Gauss's formula with five points on (0, 1).
GAUSS = [
    (0.5 + 0.5 * x, 0.5 * w)
    for x, w in [
        (0.0, 128 / 225),
        (math.sqrt(5 - 2 * math.sqrt(10 / 7)) / 3, (322 + 13 * math.sqrt(70)) / 900),
        (-math.sqrt(5 - 2 * math.sqrt(10 / 7)) / 3, (322 + 13 * math.sqrt(70)) / 900),
        (math.sqrt(5 + 2 * math.sqrt(10 / 7)) / 3, (322 - 13 * math.sqrt(70)) / 900),
        (-math.sqrt(5 + 2 * math.sqrt(10 / 7)) / 3, (322 - 13 * math.sqrt(70)) / 900),
    ]
]


def cubic_measures(p):
    """Length and area to the left of a cubic curve."""
    length = area = 0.0
    for k in range(8):
        for t, w in GAUSS:
            t, w = (k + t) / 8, w / 8
            x, y = cubic(p, t)
            u = 1 - t
            d = [
                3
                * (
                    u * u * (p[1][i] - p[0][i])
                    + 2 * u * t * (p[2][i] - p[1][i])
                    + t * t * (p[3][i] - p[2][i])
                )
                for i in (0, 1)
            ]
            length += w * math.hypot(*d)
            area += w * (x * d[1] - y * d[0]) / 2
    return length, area


def distance_to_cubics(point, cubics):
    """The distance of a point from curves, by samples and a golden section."""
    best = math.inf
    for p in cubics:
        boxed = all(
            min(q[i] for q in p) - 1 <= point[i] <= max(q[i] for q in p) + 1 for i in (0, 1)
        )
        if not boxed:
            continue
        samples = [apart(point, cubic(p, k / 16)) for k in range(17)]
        k = samples.index(min(samples))
        low, high = max(0, k - 1) / 16, min(16, k + 1) / 16
        for _ in range(40):
            a, b = low + 0.382 * (high - low), low + 0.618 * (high - low)
            if apart(point, cubic(p, a)) < apart(point, cubic(p, b)):
                high = b
            else:
                low = a
        best = min(best, apart(point, cubic(p, (low + high) / 2)), samples[0], samples[16])
    return best


# DXF ----------------------------------------------------------------------------------------------


def spline_cubics(e, unit):
    """The cubic curves of a spline whose inner knots count three times."""
    points = [tuple(c * unit for c in p) for p in e.control_points]
    knots = list(e.knots)
    count = (len(points) - 1) // 3
    need(e.dxf.degree == 3 and len(points) == 3 * count + 1, "a spline of another form")
    wanted = [0.0] + [float(k) for k in range(count + 1) for _ in range(3)] + [float(count)]
    need(knots == wanted, f"knots {knots[:8]}")
    # A sample of the curve as the library evaluates it has to lie on these cubics.
    tool = e.construction_tool()
    for k in (0, count // 2, count - 1):
        mine = cubic(points[3 * k : 3 * k + 4], 0.3)
        theirs = [c * unit for c in tool.point(k + 0.3)]
        need(apart(mine, theirs) <= 1e-9 * (1 + max(map(abs, mine))), "a spline differs")
    return [points[3 * k : 3 * k + 4] for k in range(count)]


def polyline_segments(e, unit):
    rows = [(x * unit, y * unit, b) for x, y, b in e.get_points("xyb")]
    pairs = list(zip(rows, rows[1:] + rows[:1] if e.closed else rows[1:]))
    return [bulged(p[:2], q[:2], p[2]) for p, q in pairs]


def circle_segment(e, unit):
    x, y, _ = e.dxf.center
    r = e.dxf.radius
    return [c * unit for c in (x + r, y, x + r, y, x, y)] + [2 * math.pi]


def outline_pieces(entities, unit):
    """The segments and the curves of an outline in order."""
    pieces = []
    for e in entities:
        if e.dxftype() == "CIRCLE":
            pieces.append(("circle", circle_segment(e, unit)))
        elif e.dxftype() == "LWPOLYLINE":
            pieces += [("segment", s) for s in polyline_segments(e, unit)]
        elif e.dxftype() == "SPLINE":
            pieces += [("cubic", [q[:2] for q in p]) for p in spline_cubics(e, unit)]
        else:
            raise Fault(f"{e.dxftype()} in an outline")
    return pieces


def compare_outline(wanted, pieces):
    """Compares the pieces of an outline with a contour."""
    name = wanted["name"]
    segments = wanted["segments"]
    length = area = 0.0
    cubics = [p for kind, p in pieces if kind == "cubic"]
    for kind, p in pieces:
        if kind == "cubic":
            l, a = cubic_measures(p)
            length, area = length + l, area + a
        else:
            length, area = length + length_of(p), area + area_of(p)
    allowed = CURVE * (1 + wanted["length"]) if cubics else 0
    need(
        abs(length - wanted["length"]) <= SLACK * (1 + wanted["length"]) + allowed,
        f"{name}: length {length!r}, not {wanted['length']!r}",
    )
    if wanted["closed"]:
        area = math.copysign(area, wanted["area"]) if pieces[0][0] == "circle" else area
        need(
            abs(area - wanted["area"]) <= SLACK * (1 + abs(wanted["area"])) + allowed,
            f"{name}: area {area!r}, not {wanted['area']!r}",
        )
    if pieces[0][0] == "circle":
        c = pieces[0][1]
        r = c[0] - c[4]
        for s in segments:
            for p in [*ends(s), at(s, 0.5)]:
                need(abs(apart(p, c[4:6]) - r) <= SLACK, f"{name}: not on the circle")
        return
    begin = (lambda kind, p: p[0] if kind == "cubic" else ends(p)[0])
    final = (lambda kind, p: p[3] if kind == "cubic" else ends(p)[1])
    for (k, p), (m, q) in zip(pieces, pieces[1:] + (pieces[:1] if wanted["closed"] else [])):
        need(near(final(k, p), begin(m, q)), f"{name}: a gap of {apart(final(k, p), begin(m, q))}")
    # Every segment that is none of a curve has to be there, with its ends and its middle.
    drawn = [p for kind, p in pieces if kind == "segment"]
    vertices = [v for s in drawn for v in ends(s)]
    for s, of_curve in zip(segments, wanted["ofCurve"]):
        p, q = ends(s)
        whole = any(near(p, ends(d)[0]) and near(at(s, 0.5), at(d, 0.5)) for d in drawn)
        if of_curve and cubics and not whole:
            for point in (p, at(s, 0.5), q):
                d = min([distance_to_cubics(point, cubics)] + [apart(point, v) for v in vertices])
                need(d <= CURVE, f"{name}: a curve is {d} mm from a node")
        else:
            need(any(near(p, v) for v in vertices), f"{name}: no vertex at {p}")
            need(any(near(q, v) for v in vertices), f"{name}: no vertex at {q}")
            need(
                any(near(at(s, 0.5), at(d, t)) for d in drawn for t in (0.5, 0, 1)),
                f"{name}: no line or arc through {at(s, 0.5)}",
            )


def compare_motion(wanted, e, unit):
    """Compares an entity with a move."""
    s = wanted["segment"]
    (p, q), (low, high) = ends(s), wanted["heights"]
    kind = e.dxftype()
    three = lambda v: tuple(c * unit for c in v)
    if kind == "LINE":
        need(length_of(s) == 0 or len(s) == 4, "a line instead of an arc")
        need(near(three(e.dxf.start), (*p, low)) and near(three(e.dxf.end), (*q, high)), "a line")
    elif kind == "ARC":
        need(low == high and near([e.dxf.center.z * unit], [low]), "the height of an arc")
        first, final = three(e.start_point)[:2], three(e.end_point)[:2]
        if s[6] < 0:
            first, final = final, first
        need(near(first, p) and near(final, q), f"an end of an arc: {apart(first, p)}")
        turn = math.radians((e.dxf.end_angle - e.dxf.start_angle) % 360)
        need(abs(turn - abs(s[6])) <= 1e-9, "the sweep of an arc")
        middle = math.radians(e.dxf.start_angle) + turn / 2
        r = e.dxf.radius
        there = e.dxf.center.x + r * math.cos(middle), e.dxf.center.y + r * math.sin(middle)
        need(near(three(there), at(s, 0.5)), "the middle of an arc")
    elif kind == "CIRCLE":
        need(abs(abs(s[6]) - 2 * math.pi) <= 1e-9 and low == high, "a circle instead of an arc")
        need(near(three(e.dxf.center), (s[4], s[5], low)), "the centre of a circle")
        need(abs(e.dxf.radius * unit - apart(p, s[4:6])) <= SLACK, "the radius of a circle")
    elif kind == "LWPOLYLINE":
        need(low == high and near([e.dxf.elevation * unit], [low]), "the height of a polyline")
        drawn = polyline_segments(e, unit)
        need(near(ends(drawn[0])[0], p) and near(ends(drawn[-1])[1], q), "an end of a flat arc")
        need(any(near(at(s, 0.5), at(d, t)) for d in drawn for t in (0.5, 1)), "a flat arc")
    elif kind == "SPLINE":
        need(low != high, "a spline instead of an arc")
        cubics = spline_cubics(e, unit)
        need(near(cubics[0][0], (*p, low)) and near(cubics[-1][3], (*q, high)), "an end of a helix")
        for k, c in enumerate(cubics):
            for i in range(9):
                x, y, z = cubic(c, i / 8)
                t = (k + i / 8) / len(cubics)
                r = apart((x, y), s[4:6])
                need(abs(r - apart(p, s[4:6])) <= HELIX, "the radius of a helix")
                angle = math.atan2(y - s[5], x - s[4]) - math.atan2(p[1] - s[5], p[0] - s[4])
                turned = t * s[6]
                turned += (angle - turned + math.pi) % (2 * math.pi) - math.pi
                need(abs(low + (high - low) * turned / s[6] - z) <= HELIX, "the height of a helix")
    else:
        raise Fault(f"{kind} in the path")


def judge_dxf(wanted, path):
    doc, auditor = recover.readfile(path)
    again = ezdxf.readfile(path).audit()
    for a in (auditor, again):
        messages = [e.message for e in a.errors + a.fixes]
        need(not messages, f"ezdxf: {messages[:3]}")
    unit = wanted["unit"]
    need(doc.dxfversion == "AC1015", "another version")
    need(doc.header["$INSUNITS"] == (4 if unit == 1 else 1), "another unit")
    need(doc.header["$MEASUREMENT"] == (1 if unit == 1 else 0), "another system of units")
    layers = {}
    for e in doc.modelspace():
        layers.setdefault(e.dxf.layer, []).append(e)
    # The library keeps the entities of a group in no order; the handles have that of the file.
    groups = {
        name: sorted(group, key=lambda e: int(e.dxf.handle, 16)) for name, group in doc.groups
    }
    names = set()
    for c in wanted["contours"]:
        title, k = c["name"], 2
        while title.casefold() in names:
            title, k = f"{c['name']}-{k}", k + 1
        names.add(title.casefold())
        need(title in groups, f"no group {title}")
        need(all(e.dxf.layer == "PART" for e in groups[title]), f"{title}: another layer")
        compare_outline(c, outline_pieces(groups[title], unit))
    need(len(groups) == len(wanted["contours"]), "more groups than contours")
    need(sum(map(len, groups.values())) == len(layers.get("PART", [])), "more than the groups")
    for layer, solids in (("STOCK", wanted["stock"]), ("CLAMPS", wanted["clamps"])):
        drawn = layers.get(layer, [])
        need(len(drawn) == len(solids), f"{layer}: {len(drawn)} outlines")
        for e, solid in zip(drawn, solids):
            compare_outline(solid["outline"], outline_pieces([e], unit))
            low, high = solid["heights"]
            z = e.dxf.elevation if e.dxftype() == "LWPOLYLINE" else e.dxf.center.z
            need(near([z * unit], [low]), f"{layer}: height {z}")
            need(near([(z + e.dxf.get("thickness", 0)) * unit], [high]), f"{layer}: thickness")
    moves = [
        m
        for m in wanted["moves"]
        if length_of(m["segment"]) > 0 or m["heights"][0] != m["heights"][1]
    ]
    drawn = [e for e in doc.modelspace() if e.dxf.layer.startswith("PATH_")]
    need(len(drawn) == len(moves), f"{len(drawn)} entities for {len(moves)} moves")
    for m, e in zip(moves, drawn):
        need((e.dxf.layer == "PATH_RAPIDS") == m["rapid"], f"a move on {e.dxf.layer}")
        compare_motion(m, e, unit)
    holes = sorted(set(map(tuple, wanted["holes"])))
    circles = [e for e in layers.get("HOLES", []) if e.dxftype() == "CIRCLE"]
    bottoms = [e for e in layers.get("HOLES", []) if e.dxftype() == "POINT"]
    found = sorted(
        (c.dxf.center.x * unit, c.dxf.center.y * unit, c.dxf.radius * unit, b.dxf.location.z * unit)
        for c, b in zip(circles, bottoms)
    )
    need(len(found) == len(holes), f"{len(found)} holes")
    need(all(near(a, b) for a, b in zip(found, holes)), "a hole")
    vertices = {
        tuple(round(c, 6) for c in p)
        for m in wanted["moves"]
        for p in zip(ends(m["segment"]), m["heights"])
        for p in [(*p[0], p[1])]
    }
    for e in layers.get("NODES", []):
        if e.dxftype() == "POINT":
            x, y, z = (c * unit for c in e.dxf.location)
            need(tuple(round(c + 0.0, 6) for c in (x, y, z)) in vertices, "a node beside the path")
    return len(drawn), len(wanted["contours"])


# SVG ----------------------------------------------------------------------------------------------


def identity(name):
    """A name as XML allows it for an id: letters, digits, - _ and ., and no digit at the beginning."""
    allowed = "".join(c if c.isalnum() or c in "-_." else "_" for c in name)
    return allowed if allowed[:1].isalpha() or allowed[:1] == "_" else "_" + allowed


def svg_pieces(element):
    """The pieces of an outline, with y upwards."""
    if element.tag == SVG + "circle":
        x, y, r = (float(element.get(k)) for k in ("cx", "cy", "r"))
        return [("circle", [x + r, -y, x + r, -y, x, -y, 2 * math.pi])]
    pieces = []
    for s in svgpathtools.parse_path(element.get("d")):
        p, q = (s.start.real, -s.start.imag), (s.end.real, -s.end.imag)
        if isinstance(s, svgpathtools.Line):
            # The closing of a path that ends where it began.
            if not near(p, q, 0):
                pieces.append(("segment", [*p, *q]))
        elif isinstance(s, svgpathtools.Arc):
            need(s.radius.real == s.radius.imag, "an arc of an ellipse")
            need(not s.large_arc, "an arc of more than a half circle")
            sweep = (-2 if s.sweep else 2) * math.asin(min(1, apart(p, q) / 2 / s.radius.real))
            pieces.append(("segment", [*p, *q, s.center.real, -s.center.imag, sweep]))
        else:
            points = (s.start, s.control1, s.control2, s.end)
            pieces.append(("cubic", [(c.real, -c.imag) for c in points]))
    return pieces


def split(s):
    """The parts of at most 120° that an arc has in an SVG file."""
    if len(s) == 4:
        return [s]
    count = max(1, math.ceil(abs(s[6]) / (2 * math.pi / 3) - 1e-9))
    points = [ends(s)[0]] + [at(s, k / count) for k in range(1, count)] + [ends(s)[1]]
    return [[*p, *q, *s[4:6], s[6] / count] for p, q in zip(points, points[1:])]


def divided(wanted):
    """A contour whose arcs are divided as in an SVG file."""
    parts = [(p, c) for s, c in zip(wanted["segments"], wanted["ofCurve"]) for p in split(s)]
    return {**wanted, "segments": [p for p, _ in parts], "ofCurve": [c for _, c in parts]}


def judge_svg(wanted, path):
    root = ElementTree.parse(path).getroot()
    unit, word = wanted["unit"], "mm" if wanted["unit"] == 1 else "in"
    left, top, across, down = map(float, root.get("viewBox").split())
    for key, size in (("width", across), ("height", down)):
        text = root.get(key)
        need(text.endswith(word), f"{key} {text}")
        need(abs(float(text[:-2]) * unit - size) <= SLACK, f"{key} {text} for {size}")
    layers = {}
    for g in root.findall(SVG + "g"):
        need(g.get(INKSCAPE + "groupmode") == "layer", "a group that is no layer")
        layers[g.get(INKSCAPE + "label")] = list(g)
    identities = [e.get("id") for e in root.iter() if e.get("id")]
    need(len(set(identities)) == len(identities), "an identity that occurs twice")
    drawn = layers.get("PART", [])
    need(len(drawn) == len(wanted["contours"]), f"{len(drawn)} contours")
    for c, e in zip(wanted["contours"], drawn):
        need(e.get("id").startswith(identity(c["name"])), f"the identity {e.get('id')}")
        compare_outline(divided(c), svg_pieces(e))
        for _, p in svg_pieces(e):
            for x, y in p[:4] if isinstance(p[0], tuple) else ends(p):
                inside = left <= x <= left + across and top <= -y <= top + down
                need(inside, f"a contour outside of the page: {x}, {y}")
    for layer, solids in (("STOCK", wanted["stock"]), ("CLAMPS", wanted["clamps"])):
        need(len(layers.get(layer, [])) == len(solids), f"{layer} in SVG")
        for e, solid in zip(layers.get(layer, []), solids):
            compare_outline(divided(solid["outline"]), svg_pieces(e))
    for names, rapid in ((["PATH_RAPIDS"], True), (["PATH_CUTS", "PATH_LINKS"], False)):
        moves = {tuple(m["segment"]) for m in wanted["moves"] if m["rapid"] == rapid}
        parts = [p for s in moves if length_of(s) > 0 for p in split(list(s))]
        drawn = [p for n in names for e in layers.get(n, []) for _, p in svg_pieces(e)]
        known = {tuple(round(c, 6) + 0.0 for c in (*p[:4], *at(p, 0.5))): p for p in drawn}
        for p in parts:
            key = tuple(round(c, 6) + 0.0 for c in (*p[:4], *at(p, 0.5)))
            if key in known:
                found = known[key]
            else:
                middle = at(p, 0.5)
                found = min(drawn, key=lambda d: apart(p[:4], d[:4]) + apart(middle, at(d, 0.5)))
            need(near(p[:4], found[:4]), f"a move from {p[:2]} to {p[2:4]} in SVG")
            need(near(at(p, 0.5), at(found, 0.5)), f"the middle of a move at {at(p, 0.5)} in SVG")
    circles = [e for e in layers.get("HOLES", [])]
    need(len(circles) == len({tuple(h) for h in wanted["holes"]}), "holes in SVG")


def main():
    partc, expected, folder = sys.argv[1:4]
    with open(expected, encoding="utf-8") as file:
        programs = json.load(file)
    faults = 0
    entities = contours = 0
    for wanted in programs:
        for ending, judge in ((".dxf", judge_dxf), (".svg", judge_svg)):
            path = os.path.join(folder, "drawing" + ending)
            done = subprocess.run(
                [partc, "export", "-q", wanted["file"], "-o", path],
                capture_output=True,
                text=True,
                check=False,
            )
            try:
                need(done.returncode == 0, done.stderr)
                counted = judge(wanted, path)
                if counted:
                    entities, contours = entities + counted[0], contours + counted[1]
            except Fault as fault:
                faults += 1
                print(f"{wanted['file']}, {ending[1:]}: {fault}")
    print(f"{len(programs)} programs, {contours} contours, {entities} moves, {faults} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
