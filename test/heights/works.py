"""Random parts with all operations of a mill for `removal.py`, each with what has to stand and what
has to be gone. Needs numpy and Shapely.

A part is a plate with an outline and a few places inside it, and an operation in each place. What
an operation does is worked out from its shapes here, with Shapely, and not from a path of partc: a
cut along a contour is what a disc covers along the offset contour, a pocket is the opening of its
region by the disc of the mill, a hole is a circle. Each operation makes *claims*:

    may     in this area material may be gone down to a height, and nowhere else
    must    in this area material has to be gone down to a height
    hole    as both for a round hole, whose bottom is a cone or flat
    tabs    along this path there are tabs
"""

import math

from shapely.geometry import LineString, MultiPoint, MultiPolygon, Point, Polygon, box
from shapely.ops import unary_union

from shapes import (
    bracket, circle, grown, opened, point, pointed, rectangle, regular, rounded,
    rounded_rectangle, slot
)

# Distance in mm from an edge within which nothing is certain: a tolerance, a pulse, and the chords
# of Shapely.
MARGIN = 0.022
# The same for heights.
HAIR = 0.004
CELL = 24
POINT = 118


class Claim:
    """A claim about an area down to a height z, by the operation `what`."""

    def __init__(self, kind, what, area, z, slope=0.0, **others):
        self.kind, self.what, self.area, self.z, self.slope = kind, what, area, z, slope
        self.others = others


class Part:
    """A random part for a machine: `text`, `claims`, `tools` by number, `order` of the numbers as
    the tools come, `top` and `blank`, the area of the stock or None."""

    def __init__(self, rng, name, machine, has_holes=True):
        self.rng, self.machine, self.has_holes = rng, machine, has_holes
        self.claims, self.tools, self.numbers, self.order = [], {}, {}, []
        self.body, self.known = [], 0
        self.tolerance = rng.choice([0.01, 0.01, 0.005])
        # Above the stock: its top is at most at 1.5.
        self.clearance = rounded(rng, 2, 5)
        columns, rows = rng.choice([(1, 1), (2, 1), (2, 1), (2, 2), (3, 1)])
        self.size = (columns * CELL + 8, rows * CELL + 8)
        self.depth = rounded(rng, 3, 9)
        self.top, self.blank = 0, None
        stock = self._stock()
        works = [self._outline] + [
            lambda at=(4 + CELL * (i + 0.5), 4 + CELL * (j + 0.5)): self._place(at)
            for i in range(columns) for j in range(rows)
        ]
        if rng.random() < 0.3:
            works.append(works.pop(0))
        if self.top:
            self._face()
        self.feature = 0
        for work in works:
            work()
        head = [
            f"part {name}", f"machine {machine}", f"tool {self.order[0]} {self.first}", "feed 300",
            f"tolerance {self.tolerance:g}", f"clearance {self.clearance:g}", "safe 40",
            "program 7", "work 54", f"from (-20, -20, {self.clearance:g})",
        ]
        tail = [f"rapid (-20, -20, {self.clearance:g})"]
        self.text = "\n".join(head + stock + self.body + tail) + "\n"

    # What all operations need

    def _name(self):
        self.known += 1
        return f"c{self.known}"

    def _tool(self, text, radius, slope=0.0, sense="cw", speed=6000):
        """Takes a tool."""
        if text not in self.numbers:
            self.numbers[text] = len(self.numbers) + 1
            self.tools[self.numbers[text]] = {"radius": radius, "slope": slope}
        number = self.numbers[text]
        if not self.order:
            self.first = text
        elif self.order[-1] == number and self.sense == sense:
            return
        elif self.order[-1] != number:
            self.body.append(f"change {number} {text}")
        if not self.order or self.order[-1] != number:
            self.order.append(number)
        self.sense = sense
        self.body.append(f"spindle {sense} {speed} rpm")

    def _mill(self, most=4.0):
        radius = self.rng.choice([r for r in (1, 1.5, 2, 2.5, 3, 4) if r <= most])
        self._tool(f"mill(diameter {2 * radius:g})", radius)
        return radius

    def _contour(self, shape, is_closed=True):
        name = self._name()
        self.body.append(f"contour {name} {'closed' if is_closed else 'open'} {{ {shape} }}")
        return name

    def _may(self, what, area, z):
        self.claims.append(Claim("may", what, area, z))

    def _must(self, what, area, z):
        self.claims.append(Claim("must", what, area, z))

    def _depth(self, most):
        """A depth, and its words."""
        rng = self.rng
        depth = most if rng.random() < 0.4 else rounded(rng, 1, most)
        step = f" step {depth / rng.choice([1, 2, 3, 1.7]):.3g}" if rng.random() < 0.7 else ""
        return depth, f"depth {depth:g}{step} plunge {rng.choice([60, 100])}"

    # The plate

    def _stock(self):
        rng = self.rng
        if rng.random() < 0.6:
            return []
        rim = rng.choice([1, 3, 12])
        self.top = rng.choice([0, 0.5, 1.5])
        a, b = (-rim, -rim), (self.size[0] + rim, self.size[1] + rim)
        self.blank = box(*a, *b)
        text = f"rectangle({point(a)}, {point(b)})"
        return [f"let blank = {text}", f"stock blank from -25 to {self.top:g}"]

    def _face(self):
        rng, r = self.rng, self._mill()
        words = f"depth 0 step {rng.choice([0.4, 1, 2])} plunge 200"
        angle = f" angle {rng.choice([0, 30, 90])} deg"
        words += rng.choice(["", "", angle, " climb", " conventional"])
        self.body.append(f"face blank step {2 * r * rng.choice([0.5, 0.8, 1]):.4g} {{ {words} }}")
        self._must("face", grown(self.blank, 2 * MARGIN), 0)
        self._may("face", grown(self.blank, 2.2 * r), 0)

    def _outline(self):
        rng, (w, h) = self.rng, self.size
        x, y = w / 2, h / 2
        shape = rng.choice([
            rectangle(x, y, w, h), rounded_rectangle(x, y, w, h, rng.choice([2, 4])),
            pointed(x, y, w, h, 5), circle(x, y, math.hypot(w, h) / 2),
        ])
        r = self._mill()
        self._along(shape, "outside", r, self.depth, rng.random() < 0.75)

    # Cuts along contours

    def _along(self, shape, side, r, most, has_tabs):
        """Mills a closed shape."""
        rng, what = self.rng, f"mill {side}"
        by = {"outside": r, "inside": -r, "on": 0}[side]
        centre = grown(shape.area, by)
        if side == "inside" and shape.radius < r:
            what += ", rest allowed"
        if centre.is_empty or isinstance(centre, MultiPolygon):
            # A hole instead, so that no tool is taken for nothing.
            x, y = shape.area.centroid.coords[0]
            self.body.append(f"drill at {point((x, y))} depth 1")
            self._hole("drill", [(x, y)], r, 1)
            return
        name = self._contour(shape.text)
        path = LineString(centre.exterior.coords)
        depth, words = self._depth(most)
        cut = grown(path, r)
        start = self._start(shape, centre)
        words += f" start near {point(start)}"
        words += rng.choice(["", " climb", " conventional"] if side != "on" else [""])
        if side == "inside":
            words += " rest allowed"
        way = rng.choice(["", "ramp", "ramp", "spiral", "helix", "lead"])
        if way == "spiral" and "step" not in words:
            way = "ramp"
        may, near = cut, Polygon()
        if way == "ramp":
            words += f" ramp {rng.choice([2, 5, 12, 30])} deg"
        elif way == "spiral":
            words += " spiral"
        elif way in ("helix", "lead") and side != "on":
            words, near = self._coming(words, way, shape, side, start, r)
            may = unary_union([cut, near])
        if side == "outside" and rng.random() < 0.2 and way == "":
            more = rounded(rng, 0.3, r)
            words += f" allowance {more:g}, 0"
            further = grown(LineString(grown(shape.area, r + more).exterior.coords), r)
            cut, may = unary_union([cut, further]), unary_union([may, further])
        # Tabs that stand in the air are none.
        is_solid = self.blank is None or self.blank.contains(cut)
        if has_tabs and is_solid and depth >= 2 and "allowance" not in words:
            words += self._tabs(what, shape, path, start, r, depth)
            # The tabs stand in the cut itself, away from its beginning.
            may = near
        else:
            self._must(what, cut, -depth)
        self._may(what, may, -depth)
        self.body.append(f"mill {name} {side} {{ {words} }}")

    def _start(self, shape, centre):
        """A point of the shape at which a cut begins: away from its corners."""
        if not shape.sides:
            x, y, _, _ = shape.area.bounds
            return (round(x, 3), round(shape.area.centroid.y, 3))
        (a, b) = self.rng.choice(shape.sides)
        return (round((a[0] + b[0]) / 2, 3), round((a[1] + b[1]) / 2, 3))

    def _coming(self, words, way, shape, side, start, r):
        """An approach beside a straight side, and a helix or leads: the words, and the area of
        these."""
        rng = self.rng
        middle = shape.area.centroid
        sides = [s for s in shape.sides if Point(start).distance(LineString(s)) < 0.01]
        if not sides:
            return words, Polygon()
        (a, b) = sides[0]
        length = math.dist(a, b)
        normal = ((b[1] - a[1]) / length, (a[0] - b[0]) / length)
        # Away from the wall, out of the shape or into it.
        sign, reach = -1, 1.4 * r + 0.5
        if side == "outside":
            sign, reach = 1, rounded(rng, 2 * r, 3 * r, 0.25)
        at = tuple(round(c + sign * reach * n, 3) for c, n in zip(start, normal))
        words += f" approach {point(at)} rapid"
        near = [grown(LineString([at, start]), r)]
        if way == "helix":
            words += f" helix pitch {rng.choice([0.4, 1, 2.5])}"
            if rng.random() < 0.5:
                wide = rounded(rng, 0.3 * r, 1.8 * r, 0.1)
                words += f" diameter {wide:g}"
                near.append(grown(Point(at), wide / 2 + r))
            else:
                near.append(grown(Point(at), 1.9 * r))
        if way == "lead" or rng.random() < 0.4:
            lead = rounded(rng, 0.5, 1.5 * r, 0.25)
            words += f" lead {rng.choice(['in', 'out'])} {rng.choice(['line', 'arc'])} {lead:g}"
            along, out = (-normal[1], normal[0]), tuple(sign * n for n in normal)
            ends = [at] + [
                tuple(c + lead * u * t + (lead * v + r) * n for c, t, n in zip(start, along, out))
                for u in (-1, 1) for v in (0, 1)
            ]
            near.append(grown(MultiPoint(ends).convex_hull, r))
        # No approach may cut what lies on the other side of the contour.
        if side == "outside":
            return words, unary_union(near).difference(shape.area)
        return words, unary_union(near).intersection(shape.area)

    def _tabs(self, what, shape, path, start, r, depth):
        """Tabs along a path. Those at points are known; others are to be found."""
        rng = self.rng
        width, height = rounded(rng, 1, 4), rounded(rng, 0.5, min(3, depth - 0.5), 0.25)
        angle = rng.choice([45, 45, 30, 60, 80])
        sides = f" angle {angle} deg" if angle != 45 or rng.random() < 0.3 else ""
        size = f"width {width:g} height {height:g}{sides}"
        room = width + 2 * r + 2 * height / math.tan(math.radians(angle)) + 2 * r + 1
        chosen = [
            tuple(round(a + (b - a) * 0.5, 3) for a, b in zip(*s)) for s in shape.sides
            if math.dist(*s) > room and Point(start).distance(LineString(s)) > 0.01
        ]
        others = {
            "path": path, "r": r, "width": width, "height": height, "angle": angle, "start": start,
            "count": None, "places": None,
        }
        if chosen and rng.random() < 0.5:
            others["places"] = [path.project(Point(p)) for p in chosen]
            text = f" tab at {', '.join(point(p) for p in chosen)} {size}"
        else:
            others["count"] = rng.choice([1, 2, 3, 4])
            text = f" tabs {others['count']} {size}"
        self.claims.append(Claim("tabs", what + " with tabs", grown(path, r), -depth, **others))
        return text

    # Places inside the plate

    def _place(self, at):
        rng = self.rng
        milled = [self._pocket, self._pocket, self._pocket, self._rest, self._inside, self._on,
                  self._groove, self._boss, self._drill]
        bored = [self._spot, self._ream, self._bore, self._counterbore, self._countersink,
                 self._tap, self._thread]
        rng.choice(milled + (bored if self.has_holes else []))(at)

    def _shape(self, at, least):
        """A shape in a place, with sides of at least a length."""
        rng, (x, y) = self.rng, at
        w, h = rounded(rng, max(least, 8), 20), rounded(rng, max(least, 8), 20)
        return rng.choice([
            rectangle(x, y, w, h), rounded_rectangle(x, y, w, h, rounded(rng, 1, 3.5)),
            circle(x, y, w / 2),
            slot(
                x, y, rounded(rng, 3, 8), max(least, rounded(rng, 5, 11)),
                rng.choice([0, 20, 77, 140]),
            ),
            regular(x, y, max(least, rounded(rng, 7, 10)), rng.randint(3, 8), rng.randint(0, 90)),
            bracket(x, y, w, h, min(w, h) / 2 - 0.5), pointed(x, y, w, h, 3),
        ])

    def _island(self, at, shape, r):
        """An island in a shape, if there is room for it, and its text."""
        rng, (x, y) = self.rng, at
        size = rounded(rng, 1, 5)
        island = rng.choice([circle(x, y, size / 2), rectangle(x, y, size, size)])
        room = -grown(shape.area, -0.5).exterior.distance(island.area) + 2 * r
        if room > 0 or not shape.area.contains(island.area) or rng.random() < 0.5:
            return None
        return island

    def _clearing(self, what, at, name):
        """A pocket: its region, the radius of its mill, its depth and its words."""
        rng = self.rng
        r = self._mill(3)
        shape = self._shape(at, 2 * r + 1)
        island = self._island(at, shape, r)
        words, region = "", shape.area
        edge = self._contour(shape.text)
        if island:
            region = region.difference(island.area)
            words = f"islands {self._contour(island.text)} "
        depth, more = self._depth(self.depth)
        words += more + " rest allowed"
        way = rng.choice(["", "", "ramp", "helix", "at"])
        if way == "ramp":
            words += f" ramp {rng.choice([2, 5, 12, 30])} deg"
        if way == "helix":
            words += f" helix pitch {rng.choice([0.4, 1, 2.5])}"
            words += f" diameter {rounded(rng, 0.1, 1.2 * r, 0.1):g}" if rng.random() < 0.5 else ""
        inner = grown(region, -1.9 * r - 0.1)
        if way in ("helix", "at") and not inner.is_empty and rng.random() < 0.7:
            p = inner.representative_point()
            words += f" approach {point((round(p.x, 2), round(p.y, 2)))} rapid"
        words += rng.choice(["", " climb", " conventional"])
        left = 0
        if rng.random() < 0.25:
            left = rounded(rng, 0.2, 0.6, 0.1)
            if what != "rest":
                words += f" allowance {left:g}, 0"
                left = 0
            else:
                words += f" allowance {left:g}"
        step = 2 * r * rng.choice([0.3, 0.5, 0.7, 0.95, 1])
        self.body.append(f"pocket {edge} step {step:.4g}{name} {{ {words} }}")
        reach = grown(region, -left)
        self._must("pocket", opened(reach, r, MARGIN), -depth)
        self._may("pocket", opened(reach, r, -MARGIN).intersection(reach), -depth)
        return region, r, depth

    def _pocket(self, at):
        self._clearing("pocket", at, "")

    def _rest(self, at):
        rng, name = self.rng, f"rough{self._name()}"
        region, r, depth = self._clearing("rest", at, f" as {name}")
        smaller = [s for s in (0.5, 0.75, 1, 1.5, 2) if s < r]
        if not smaller:
            return
        s = rng.choice(smaller)
        self._tool(f"mill(diameter {2 * s:g})", s)
        words = "plunge 80 rest allowed"
        if rng.random() < 0.3:
            depth = rounded(rng, 0.5, depth)
            words += f" depth {depth:g} step {max(depth / 2, 0.5):g}"
        words += rng.choice(["", " climb", " conventional"])
        self.body.append(f"rest of {name} step {2 * s * rng.choice([0.3, 0.5]):.4g} {{ {words} }}")
        self._must("rest", opened(region, s, MARGIN), -depth)
        self._may("rest", opened(region, s, -MARGIN).intersection(region), -depth)

    def _inside(self, at):
        r = self._mill(2.5)
        shape = self._shape(at, 4 * r + 1)
        self._along(shape, "inside", r, self.depth, self.rng.random() < 0.3)

    def _on(self, at):
        r = self._mill(2)
        self._along(self._shape(at, 8), "on", r, self.depth, self.rng.random() < 0.3)

    def _boss(self, at):
        rng, (x, y), r = self.rng, at, self._mill(2)
        size = rounded(rng, 4, 19 - 4 * r)
        shape = rng.choice([
            rectangle(x, y, size, size), rounded_rectangle(x, y, size, size, 1),
            circle(x, y, size / 2),
        ])
        self._along(shape, "outside", r, self.depth, rng.random() < 0.3)

    def _groove(self, at):
        """An open contour, milled on it or beside it."""
        rng, (x, y), r = self.rng, at, self._mill(2)
        ends = [(x - 8, y - rng.randint(0, 6)), (x + rng.randint(-2, 2), y + rng.randint(0, 6))]
        if rng.random() < 0.6:
            ends.append((x + 8, y - rng.randint(0, 6)))
        name = self._contour(" ".join(point(p) for p in ends), False)
        depth, words = self._depth(self.depth)
        words += f" ramp {rng.choice([2, 5, 12, 30])} deg" if rng.random() < 0.6 else ""
        self.body.append(f"mill {name} on {{ {words} }}")
        cut = grown(LineString(ends), r)
        self._must("groove", cut, -depth)
        self._may("groove", cut, -depth)

    # Holes

    def _holes(self, at, radius):
        """Places of holes with room for a radius, and their text."""
        rng, (x, y) = self.rng, at
        most = int(min(4, (20 / (2 * radius + 1)) ** 2))
        if most < 2 or rng.random() < 0.3:
            return [at], f"at {point(at)}"
        far = min(10 - radius, radius + 2.5)
        found = [(x - far, y - far), (x + far, y - far), (x + far, y + far), (x - far, y + far)]
        found = rng.sample(found, rng.randint(1, 4))
        return found, f"at [{', '.join(point(p) for p in found)}]"

    def _hole(self, what, places, radius, depth, slope=0.0):
        for p in places:
            self.claims.append(Claim("hole", what, p, -depth, slope, radius=radius))

    def _words(self, *choices):
        """Some of the settings, in braces."""
        chosen = [c for c in choices if self.rng.random() < 0.5]
        return f" {{ {' '.join(chosen)} }}" if chosen else ""

    def _dwell(self):
        return [] if self.machine == "iso6983" else ["dwell 0.5 s"]

    def _drill(self, at):
        rng = self.rng
        radius, angle = rng.choice([0.75, 1, 1.5, 2, 3, 4]), rng.choice([POINT, POINT, 90, 140])
        if not self.has_holes:
            angle = POINT
        slope = 1 / math.tan(math.radians(angle / 2))
        text = f"drill(diameter {2 * radius:g}{'' if angle == POINT else f', angle {angle} deg'})"
        if rng.random() < 0.2:
            text, slope = f"mill(diameter {2 * radius:g})", 0.0
        self._tool(text, radius, slope)
        places, where = self._holes(at, radius)
        depth = rounded(rng, 1, self.depth + 2, 0.25)
        # LinuxCNC has cycles for pecks longer than the clearance, and breaks chips by 0.254.
        is_linuxcnc = self.machine == "linuxcnc-mill"
        lengths = [3, 4, 6] if is_linuxcnc else [0.7, 1.5, 2, 3, 6]
        peck = [f"peck {rng.choice(lengths):g}"] if rng.random() < 0.7 else []
        if peck and self.has_holes and rng.random() < 0.5:
            peck[0] += f" chip break {0.254 if is_linuxcnc else rng.choice([0.254, 0.5, 0.3])}"
        more = peck + (self._dwell() if self.has_holes and rng.random() < 0.3 else [])
        more += [w for w in ("shortest", "plunge 90") if rng.random() < 0.4]
        tail = f" {{ {' '.join(more)} }}" if more else ""
        self.body.append(f"drill {where} depth {depth:g}{tail}")
        self._hole("drill", places, radius, depth, slope)

    def _pointed_drill(self, radii, angles):
        """A pointed drill: its radius, its angle in degrees, and the rise of its point."""
        radius, angle = self.rng.choice(radii), self.rng.choice(angles)
        slope = 1 / math.tan(math.radians(angle / 2))
        self._tool(f"drill(diameter {2 * radius:g}, angle {angle} deg)", radius, slope)
        return radius, angle, slope

    def _spot(self, at):
        rng = self.rng
        radius, _, slope = self._pointed_drill([2, 3, 4], [90, 118, 120])
        places, where = self._holes(at, radius)
        if rng.random() < 0.5:
            depth = rounded(rng, 0.5, 3, 0.25)
            text = f"depth {depth:g}"
        else:
            wide = rounded(rng, 1, 2 * radius, 0.25)
            depth, text = wide / 2 * slope, f"diameter {wide:g}"
        tail = self._words("shortest", "plunge 90", *self._dwell())
        self.body.append(f"spot {where} {text}{tail}")
        self._hole("spot", places, radius, depth, slope)

    def _countersink(self, at):
        rng = self.rng
        radius, angle, slope = self._pointed_drill([3, 4, 5], [82, 90, 120])
        places, where = self._holes(at, radius)
        wide = rounded(rng, 1, 2 * radius, 0.25)
        tail = self._words("shortest", "plunge 90", *self._dwell())
        self.body.append(f"countersink {where} angle {angle} deg diameter {wide:g}{tail}")
        self._hole("countersink", places, radius, wide / 2 * slope, slope)

    def _ream(self, at):
        radius = self.rng.choice([1.5, 2, 3])
        slope = 1 / math.tan(math.radians(POINT / 2))
        # The hole comes first, and its full width is deeper than the reamer goes.
        self._tool(f"drill(diameter {2 * radius - 0.2:g})", radius - 0.1, slope)
        places, where = self._holes(at, radius)
        deep = rounded(self.rng, 3, self.depth + 2)
        self.body.append(f"drill {where} depth {deep + 2:g}")
        self._hole("drill before ream", places, radius - 0.1, deep + 2, slope)
        self._tool(f"drill(diameter {2 * radius:g}, angle 180 deg)", radius)
        self.body.append(f"ream {where} depth {deep:g}{self._words('shortest', 'plunge 70')}")
        self._hole("ream", places, radius, deep)

    def _bore(self, at):
        rng, r = self.rng, self._mill(3)
        wide = rounded(rng, 2 * r + 0.5, min(20, 7 * r), 0.25)
        places, where = self._holes(at, wide / 2)
        depth = rounded(rng, 0.5, self.depth + 1)
        tail = self._words("shortest", "plunge 90", rng.choice(["climb", "conventional"]))
        pitch = rng.choice([0.3, 1, 2])
        self.body.append(f"bore {where} diameter {wide:g} depth {depth:g} pitch {pitch:g}{tail}")
        for p in places:
            cut = grown(Point(p), wide / 2)
            if wide > 4 * r + 0.01:
                cut = cut.difference(grown(Point(p), wide / 2 - 2 * r))
            self._must("bore", cut, -depth)
            self._may("bore", cut, -depth)

    def _counterbore(self, at):
        rng, r = self.rng, self._mill(3)
        wide = rounded(rng, 2 * r, min(20, 9 * r), 0.25)
        places, where = self._holes(at, wide / 2)
        depth = rounded(rng, 0.5, self.depth + 1)
        tail = self._words(
            "shortest", "plunge 90", rng.choice(["climb", "conventional"]),
            f"pitch {rng.choice([0.3, 1, 2])}",
        )
        self.body.append(f"counterbore {where} diameter {wide:g} depth {depth:g}{tail}")
        self._hole("counterbore", places, wide / 2, depth)

    def _tap(self, at):
        rng = self.rng
        is_left = self.machine == "linuxcnc-mill" and rng.random() < 0.4
        if self.machine not in ("linuxcnc-mill", "fanuc", "haas"):
            self._drill(at)
            return
        radius, pitch = rng.choice([(1.5, 0.5), (2.5, 1), (3, 1), (4, 1.25)])
        depth = rounded(rng, 2, self.depth)
        slope = 1 / math.tan(math.radians(POINT / 2))
        places, where = self._holes(at, radius)
        bore = radius - pitch * 0.54
        self._tool(f"drill(diameter {2 * bore:.4g})", bore, slope)
        self.body.append(f"drill {where} depth {depth + 4:g}")
        self._hole("drill before tap", places, bore, depth + 4, slope)
        self._tool(f"tap(diameter {2 * radius:g})", radius, 0.0, "ccw" if is_left else "cw", 400)
        more = ["hand left"] if is_left else []
        more += ["shortest"] if rng.random() < 0.3 else []
        more += ["floating"] if rng.random() < 0.3 and not is_left else []
        tail = f" {{ {' '.join(more)} }}" if more else ""
        self.body.append(f"tap {where} pitch {pitch:g} depth {depth:g}{tail}")
        self._hole("tap", places, radius, depth)

    def _thread(self, at):
        rng, pitch = self.rng, self.rng.choice([0.75, 1, 1.5])
        is_inside = rng.random() < 0.7
        wide, depth = rounded(rng, 6, 14 if is_inside else 10, 1), rounded(rng, 2, self.depth)
        if is_inside:
            bore = wide / 2 - 0.541 * pitch
            r = rounded(rng, 1, bore * 0.75, 0.25)
            self._tool("mill(diameter 3)", 1.5)
            clear = round(2 * bore, 2)
            self.body.append(f"counterbore at {point(at)} diameter {clear:g} depth {depth + 1:g}")
            self._hole("hole before thread", [at], clear / 2, depth + 1)
            cut = grown(Point(at), wide / 2)
            may, must = cut, cut
        else:
            r, root = rng.choice([1, 1.5]), wide / 2 - 0.61345 * pitch
            shape = circle(at[0], at[1], wide / 2)
            self._tool("mill(diameter 6)", 3)
            stud = self._contour(shape.text)
            self.body.append(f"mill {stud} outside {{ depth {depth + 1:g} step 3 }}")
            ring = grown(Point(at), wide / 2 + 6).difference(shape.area)
            self._may("stud", ring, -depth - 1)
            self._must("stud", ring, -depth - 1)
            core = grown(Point(at), root)
            must = grown(Point(at), root + 2 * r).difference(core)
            may = grown(Point(at), root + 8 * r).difference(core)
        self._tool(f"threadmill(diameter {2 * r:g}, pitch {pitch:g})", r)
        side = "inside" if is_inside else "outside"
        tail = self._words(
            "shortest", "plunge 90", rng.choice(["climb", "conventional"]),
            rng.choice(["hand left", "hand right"]),
        )
        self.body.append(
            f"thread at {point(at)} diameter {wide:g} pitch {pitch:g} depth {depth:g} {side}{tail}"
        )
        self._may("thread", may, -depth)
        self._must("thread", must, -depth + 1.5 * pitch)
