"""Reads whole files of G-code, with helices and cycles for holes, and runs them on a cloud of
points. Needs numpy.

`heights.py` has the motions and the arcs. This module adds what only whole files have: comments,
numbers of lines, retract positions of the machine, full circles, arcs that rise, and the cycles
G73, G81, G82, G83, G84, G85 and G33.1. A cycle is expanded as the manuals of the controls say.

A cloud holds points of the plane: those of a grid, and points beside the edges that matter. For
each of them, the height up to which material is left is known. A motion lowers it to the lowest
height of the tool over the point. This height is exact: over a point, the centre of the tool is
within its radius on one stretch of a straight motion, and on at most three of an arc, and a height
that changes evenly is lowest at an end of a stretch. So neither the cells nor pieces of motions make
an error.
"""

import math
import re

import numpy

import heights

# Height in mm of the retract positions of a machine, whose place in the work is not known.
AWAY = 500.0
# Rise of LinuxCNC after a peck, in mm, and distance at which a peck begins again.
BACK = 0.254
# Words that do not move a tool along an axis.
SILENT = {
    "4", "8", "17", "21", "40", "43", "49", "54", "55", "56", "57", "58", "59", "61", "64", "80",
    "90", "90.1", "91", "91.1", "94", "98", "99",
}
CYCLES = ("73", "81", "82", "83", "84", "85")


def words_of(line):
    """The words of a line as pairs of a letter and a number, without comments."""
    plain = re.sub(r"\([^)]*\)", "", line).split(";")[0].replace("%", "")
    return re.findall(r"([A-Z])\s*(-?[0-9.]+)", plain)


def code_of(value):
    """The number of a G word as a text without zeros that do not matter."""
    return f"{float(value):g}"


class Reader:
    """The state of a control that reads a file. `found` has the motions."""

    def __init__(self, place, tool):
        self.place, self.tool, self.chosen = list(place), tool, tool
        self.found, self.dwells = [], []
        self.motion, self.absolute, self.to_plane = None, True, False
        self.cycle = {}

    def read(self, text):
        for number, line in enumerate(text.splitlines(), 1):
            self.line = number
            if not re.match(r"\s*O\d", line):
                self._block(words_of(line))

    def _block(self, words):
        codes = [code_of(value) for letter, value in words if letter == "G"]
        values = {letter: float(value) for letter, value in words if letter not in "GN"}
        self.chosen = int(values.get("T", self.chosen))
        if values.get("M") == 6:
            self.tool = self.chosen
        if "90" in codes or "91" in codes:
            self.absolute = "90" in codes
        if "98" in codes or "99" in codes:
            self.to_plane = "99" in codes
        if "28" in codes or "53" in codes:
            self._away(codes, values)
            return
        if "4" in codes:
            self.dwells.append(self.line)
            return
        for code in codes:
            if code in ("0", "1", "2", "3", "33.1") + CYCLES:
                if code in CYCLES and self.motion not in CYCLES:
                    self.cycle, self.initial = {}, self.place[2]
                self.motion = code
            elif code == "80":
                self.motion = None
            elif code not in SILENT:
                raise heights.NotRun(f"line {self.line}: G{code}")
        if any(letter in values for letter in "XYZ"):
            self._move(values)

    def _away(self, codes, values):
        """A move to a position of the machine: only that of z is known to be used."""
        if set(values) - {"Z", "H"} or ("28" in codes and (self.absolute or values.get("Z") != 0)):
            raise heights.NotRun(f"line {self.line}: a position of the machine")
        self._to(True, (self.place[0], self.place[1], AWAY))

    def _move(self, values):
        if self.motion is None:
            raise heights.NotRun(f"line {self.line}: no motion")
        if not self.absolute:
            raise heights.NotRun(f"line {self.line}: increments")
        if self.motion in CYCLES:
            self._hole(values)
            return
        end = [values.get(letter, self.place[k]) for k, letter in enumerate("XYZ")]
        if self.motion == "33.1":
            start = tuple(self.place)
            self._to(False, end)
            self._to(False, start)
        elif self.motion in "01":
            self._to(self.motion == "0", end)
        else:
            offsets = (values.get("I", 0), values.get("J", 0))
            a, b = tuple(self.place[:2]), tuple(end[:2])
            arc = heights.arc_from(a, b, offsets, self.motion == "2")
            self._add(False, (a, b) + arc, end)

    def _to(self, is_rapid, end):
        self._add(is_rapid, (tuple(self.place[:2]), tuple(end[:2])), end)

    def _add(self, is_rapid, path, end):
        heights_of = (self.place[2], end[2])
        self.found.append(heights.Motion(self.line, self.tool, is_rapid, path, heights_of))
        self.place = list(end)

    def _hole(self, values):
        """One hole of a cycle. Its words stay in force until the cycle ends."""
        self.cycle.update({k: v for k, v in values.items() if k in "ZRQP"})
        if "Z" not in self.cycle or "R" not in self.cycle:
            raise heights.NotRun(f"line {self.line}: a cycle without Z or R")
        bottom, plane = self.cycle["Z"], self.cycle["R"]
        if bottom > plane:
            raise heights.NotRun(f"line {self.line}: a cycle that does not go down")
        x, y = (values.get(letter, self.place[k]) for k, letter in enumerate("XY"))
        initial = self.initial
        if self.place[2] < plane:
            self._to(True, (self.place[0], self.place[1], plane))
            initial = max(initial, plane)
        self._to(True, (x, y, self.place[2]))
        self._to(True, (x, y, plane))
        if self.motion in ("73", "83"):
            self._pecks(x, y, plane, bottom)
        else:
            self._to(False, (x, y, bottom))
        if self.motion == "82":
            self.dwells.append(self.line)
        if self.motion in ("84", "85"):
            self._to(False, (x, y, plane))
        self._to(True, (x, y, plane if self.to_plane else max(initial, plane)))

    def _pecks(self, x, y, plane, bottom):
        step = self.cycle.get("Q", 0)
        if step <= 0:
            raise heights.NotRun(f"line {self.line}: pecks without Q")
        depth = plane
        while depth > bottom:
            if depth < plane and self.motion == "83":
                self._to(True, (x, y, plane))
                self._to(True, (x, y, min(plane, depth + BACK)))
            elif depth < plane:
                self._to(True, (x, y, depth + BACK))
            depth = max(bottom, depth - step)
            self._to(False, (x, y, depth))


def motions_of(files, start):
    """The motions of files that are run one after the other. Each is a text and the number of the
    tool at its beginning."""
    found, place = [], list(start)
    for text, tool in files:
        reader = Reader((place[0], place[1], AWAY), tool)
        reader.read(text)
        found += reader.found
        place = reader.place
    return found


def lowest_on_line(motion, x, y, radius):
    """Lowest heights of a flat tool over points, on a straight motion; infinite beside it."""
    (a, b), (from_z, to_z) = motion.path[:2], motion.z
    length = motion.length()
    if length == 0:
        return numpy.where(numpy.hypot(x - a[0], y - a[1]) <= radius, min(motion.z), numpy.inf)
    u, v = (b[0] - a[0]) / length, (b[1] - a[1]) / length
    along, across = (x - a[0]) * u + (y - a[1]) * v, (y - a[1]) * u - (x - a[0]) * v
    half = numpy.sqrt(numpy.maximum(0, radius * radius - across * across))
    first, last = numpy.maximum(0, along - half), numpy.minimum(length, along + half)
    low = numpy.where(to_z > from_z, first, last)
    z = from_z + (to_z - from_z) * low / length
    return numpy.where((numpy.abs(across) <= radius) & (first <= last), z, numpy.inf)


def lowest_on_arc(motion, x, y, radius):
    """Lowest heights of a flat tool over points, on an arc that may rise; infinite beside it."""
    a, _, centre, sweep = motion.path
    from_z, to_z = motion.z
    size = math.hypot(a[0] - centre[0], a[1] - centre[1])
    away = numpy.maximum(1e-12, numpy.hypot(x - centre[0], y - centre[1]))
    turned = numpy.arctan2(y - centre[1], x - centre[0])
    turned = turned - math.atan2(a[1] - centre[1], a[0] - centre[0])
    turned = numpy.mod(turned if sweep > 0 else -turned, 2 * math.pi)
    cosine = (size * size + away * away - radius * radius) / (2 * size * away)
    half = numpy.arccos(numpy.clip(cosine, -1, 1))
    best = numpy.full(x.shape, numpy.inf)
    for k in (-1, 0, 1):
        first = numpy.maximum(0, turned - half + 2 * math.pi * k)
        last = numpy.minimum(abs(sweep), turned + half + 2 * math.pi * k)
        low = numpy.where(to_z > from_z, first, last)
        z = from_z + (to_z - from_z) * low / abs(sweep)
        best = numpy.minimum(best, numpy.where((cosine <= 1) & (first <= last), z, numpy.inf))
    return best


def lowest(motion, x, y, radius, slope):
    """Lowest heights of a tool over points. A tool with a point that moves across is divided into
    pieces."""
    if slope == 0:
        how = lowest_on_arc if len(motion.path) == 4 else lowest_on_line
        return how(motion, x, y, radius)
    best = numpy.full(x.shape, numpy.inf)
    for path, low, _ in motion.pieces():
        away = (heights.to_arc if len(path) == 4 else heights.to_segment)(x, y, *path)
        best = numpy.minimum(best, numpy.where(away <= radius, low + slope * away, numpy.inf))
    return best


class Cloud:
    """Points of the plane: those of a grid, row by row, and then further ones."""

    def __init__(self, box, cell, further):
        left, low, right, high = box
        self.columns = numpy.arange(left + cell / 2, right, cell)
        self.rows = numpy.arange(low + cell / 2, high, cell)
        x, y = numpy.meshgrid(self.columns, self.rows)
        order = numpy.argsort(further[:, 0])
        self.count, self.order = x.size, order
        self.further_x = further[order, 0]
        self.x = numpy.concatenate([x.ravel(), further[:, 0]])
        self.y = numpy.concatenate([y.ravel(), further[:, 1]])

    def within(self, left, low, right, high):
        """Indices of the points in a box."""
        i = numpy.arange(*numpy.searchsorted(self.columns, [left, right]))
        j = numpy.arange(*numpy.searchsorted(self.rows, [low, high]))
        ranks = slice(*numpy.searchsorted(self.further_x, [left, right]))
        some = self.count + self.order[ranks]
        some = some[(self.y[some] >= low) & (self.y[some] <= high)]
        return numpy.concatenate([(j[:, None] * len(self.columns) + i).ravel(), some])

    def inside(self, area):
        """Indices of the points in an area of Shapely."""
        if area.is_empty:
            return numpy.zeros(0, int)
        rings = [
            numpy.array(ring.coords)
            for part in getattr(area, "geoms", [area]) if part.geom_type == "Polygon"
            for ring in [part.exterior, *part.interiors]
        ]
        if not rings:
            return numpy.zeros(0, int)
        a = numpy.concatenate([ring[:-1] for ring in rings])
        b = numpy.concatenate([ring[1:] for ring in rings])
        at = self.within(*area.bounds)
        by_row, found = {}, []
        on_grid = at[at < self.count]
        if on_grid.size:
            rows = numpy.unique(on_grid // len(self.columns))
            by_row = {row: (row * len(self.columns), self.columns, self.rows[row]) for row in rows}
        for base, columns, y in by_row.values():
            crossings = numpy.sort(crossed(a, b, y))
            odd = numpy.searchsorted(crossings, columns) % 2 == 1
            found.append(base + numpy.flatnonzero(odd))
        found.append(self._further_inside(a, b, at[at >= self.count]))
        return numpy.concatenate(found) if found else numpy.zeros(0, int)

    def _further_inside(self, a, b, some):
        """Those of some further points that are inside edges."""
        some = some[numpy.argsort(self.y[some])]
        x, y = self.x[some], self.y[some]
        is_in = numpy.zeros(some.shape, bool)
        firsts = numpy.searchsorted(y, numpy.minimum(a[:, 1], b[:, 1]), "right")
        lasts = numpy.searchsorted(y, numpy.maximum(a[:, 1], b[:, 1]), "right")
        for k in numpy.flatnonzero(firsts < lasts):
            there = slice(firsts[k], lasts[k])
            slope = (b[k, 0] - a[k, 0]) / (b[k, 1] - a[k, 1])
            is_in[there] ^= x[there] < a[k, 0] + (y[there] - a[k, 1]) * slope
        return some[is_in]


def crossed(a, b, y):
    """Places at which a line along x crosses edges."""
    k = (a[:, 1] >= y) != (b[:, 1] >= y)
    a, b = a[k], b[k]
    return a[:, 0] + (y - a[:, 1]) * (b[:, 0] - a[:, 0]) / (b[:, 1] - a[:, 1])


class Run:
    """What motions leave at the points of a cloud: `left`, the heights, and `hits`, the rapid moves
    through material, each as its line, a place and how deep it is."""

    def __init__(self, cloud, motions, tools, top, margin):
        self.cloud, self.tools, self.margin = cloud, tools, margin
        self.left = top.copy()
        self.hits = []
        highest = top.max()
        for motion in motions:
            if min(motion.z) < highest:
                self._move(motion)

    def _move(self, motion):
        tool = self.tools[motion.tool]
        radius, (a, b) = tool["radius"], motion.path[:2]
        if len(motion.path) == 4:
            centre = motion.path[2]
            reach = math.hypot(a[0] - centre[0], a[1] - centre[1])
            a, b = [c - reach for c in centre], [c + reach for c in centre]
        at = self.cloud.within(
            min(a[0], b[0]) - radius, min(a[1], b[1]) - radius,
            max(a[0], b[0]) + radius, max(a[1], b[1]) + radius,
        )
        x, y = self.cloud.x[at], self.cloud.y[at]
        if motion.rapid and at.size:
            over = lowest(motion, x, y, radius - self.margin, tool["slope"])
            deep = self.left[at] - over
            worst = int(numpy.argmax(deep))
            if deep[worst] > self.margin:
                self.hits.append((motion.line, (x[worst], y[worst]), float(deep[worst])))
        self.left[at] = numpy.minimum(self.left[at], lowest(motion, x, y, radius, tool["slope"]))
