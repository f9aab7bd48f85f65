#!/usr/bin/env python3
"""Runs a file of G-code on a field of heights, and reports what a tool hits. Needs numpy.

    heights.py [--cell MM] SETUP FILE

This is a judge for E0743, E0744 and E0745 of partc that shares nothing with it. It reads the file,
and SETUP, which `parts.py` writes: a JSON object with

    tolerance, pulse    contacts within their sum do not count
    start               x, y and z of the tip when the file begins
    first               number of the tool at the beginning
    tools               by number: radius; slope, the rise of the tip's cone per mm of radius (0 for
                        a mill); flutes, or null; holder, a list of radius and height above the tip
    stock               shapes, holes in them, bottom and top; or null
    metal               shapes of holes and pockets, for rapid moves without stock
    avoided             for each solid its shapes, its top and the line of its statement

A shape is the points within `grow` of a polygon, of a line of two points or of one point.

The field is a set of points of the plane. For each of them, the lowest tip that has passed at feed
is known: above it there is no stock any more. Distances from points to lines and arcs are exact, so
the size of the cells does not matter for a contact that is found: it is one at the point itself. A
contact that fits between the points is not found. Only a motion that goes down on a slope is
divided into pieces.

A contact of a point of stock with a shank or a holder is one only if this part of the tool comes
first to the point: where the cutter is pushed straight down, its flutes go before.

A drill leaves a cone at the bottom of its hole. Its own point fits there, so for the drill itself no
contact with this cone is certain, not even one of its shank.

The same rules, read strictly or leniently, say if a contact is *certain* or *possible*. Names of
over-estimates in `over` switch to what partc states that it assumes:

    lowest   a motion whose height changes counts by its lowest height
    point    a drill counts as a cylinder; its holes for itself, too; for others above their points
    own      a motion does not remove stock for itself
    bottom   the stock has no lower end
"""

import argparse
import json
import math
import re
import sys

import numpy

OVERESTIMATES = ("lowest", "point", "own", "bottom")
# Distance in mm by which the strict and the lenient reading differ from the exact one. It covers
# the rounding of the points in the reports of partc to 0.001 mm.
HAIR = 0.001
# Most paths of which the nearest points are kept.
MOST_PATHS = 1000
# Longest piece of a motion down a slope, in mm.
PIECE = 0.25


class NotRun(Exception):
    """A line that a control does not run, or that this program does not know."""


def to_segment(x, y, a, b):
    """Distances of points from the line from a to b."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    square = dx * dx + dy * dy
    if square == 0:
        return numpy.hypot(x - a[0], y - a[1])
    k = numpy.clip(((x - a[0]) * dx + (y - a[1]) * dy) / square, 0, 1)
    return numpy.hypot(x - a[0] - k * dx, y - a[1] - k * dy)


def to_arc(x, y, a, b, centre, sweep):
    """Distances of points from the arc from a to b that turns by the angle `sweep`."""
    u, v = x - centre[0], y - centre[1]
    turned = numpy.arctan2(v, u) - math.atan2(a[1] - centre[1], a[0] - centre[0])
    beside = numpy.mod(turned if sweep > 0 else -turned, 2 * math.pi) <= abs(sweep)
    radius = math.hypot(a[0] - centre[0], a[1] - centre[1])
    ends = numpy.minimum(numpy.hypot(x - a[0], y - a[1]), numpy.hypot(x - b[0], y - b[1]))
    return numpy.where(beside, numpy.abs(numpy.hypot(u, v) - radius), ends)


def from_shape(shape, x, y):
    """Signed distances of points from a shape; below 0 inside."""
    points = shape["points"]
    if len(points) < 3:
        return to_segment(x, y, points[0], points[-1]) - shape["grow"]
    nearest, inside = numpy.full(x.shape, numpy.inf), numpy.zeros(x.shape, bool)
    for a, b in zip(points, points[1:] + points[:1]):
        nearest = numpy.minimum(nearest, to_segment(x, y, a, b))
        if a[1] != b[1]:
            crosses = (a[1] > y) != (b[1] > y)
            inside ^= crosses & (x < a[0] + (y - a[1]) * (b[0] - a[0]) / (b[1] - a[1]))
    return numpy.where(inside, -nearest, nearest) - shape["grow"]


def from_shapes(shapes, x, y):
    """Signed distances of points from shapes together. Those inside are exact for one shape."""
    return numpy.minimum.reduce([from_shape(shape, x, y) for shape in shapes])


class Motion:
    """One motion of the tip.

    line    number of the line in the file
    tool    number of the tool
    rapid   a rapid move
    path    start and end in the plane; for an arc also its centre and the angle by which it turns
    z       heights at the start and at the end
    """

    def __init__(self, line, tool, rapid, path, z):
        self.line, self.tool, self.rapid, self.path, self.z = line, tool, rapid, path, z

    def at(self, k):
        """Place in the plane after the share k of the motion."""
        a, b = self.path[:2]
        if len(self.path) == 2:
            return (a[0] + k * (b[0] - a[0]), a[1] + k * (b[1] - a[1]))
        centre, sweep = self.path[2:]
        c, s = math.cos(k * sweep), math.sin(k * sweep)
        u, v = a[0] - centre[0], a[1] - centre[1]
        return (centre[0] + c * u - s * v, centre[1] + s * u + c * v)

    def length(self):
        """Length of the path in the plane."""
        a, b = self.path[:2]
        if len(self.path) == 2:
            return math.hypot(b[0] - a[0], b[1] - a[1])
        centre, sweep = self.path[2:]
        return abs(sweep) * math.hypot(a[0] - centre[0], a[1] - centre[1])

    def pieces(self):
        """Pieces with their lowest and highest heights. A vertical motion is one piece, which is
        the place at its lower end."""
        length, (from_z, to_z) = self.length(), self.z
        if length == 0 or from_z == to_z:
            low = min(self.z)
            return [(self.path, low, low)]
        count = math.ceil(length / PIECE)
        found = []
        for n in range(count):
            ends = [n / count, (n + 1) / count]
            heights = [from_z + k * (to_z - from_z) for k in ends]
            path = (self.at(ends[0]), self.at(ends[1]))
            if len(self.path) == 4:
                path += (self.path[2], self.path[3] / count)
            found.append((path, min(heights), max(heights)))
        return found


def arc_from(a, b, offsets, is_clockwise):
    """Centre of an arc from a to b, and the angle by which it turns."""
    centre = (a[0] + offsets[0], a[1] + offsets[1])
    radii = [math.hypot(p[0] - centre[0], p[1] - centre[1]) for p in (a, b)]
    if min(radii) == 0 or abs(radii[0] - radii[1]) > 0.003:
        raise NotRun(f"the radii of the arc are {radii[0]:.4f} and {radii[1]:.4f}")
    angles = [math.atan2(p[1] - centre[1], p[0] - centre[0]) for p in (a, b)]
    turn = (angles[1] - angles[0]) % (2 * math.pi)
    if is_clockwise:
        turn -= 2 * math.pi
    return centre, turn or 2 * math.pi


def motions_of(text, setup):
    """The motions of a file. Raises NotRun for a line that a control does not run."""
    found, place = [], [float(c) for c in setup["start"]]
    tool = chosen = setup["first"]
    motion, absolute = None, True
    for number, line in enumerate(text.splitlines(), 1):
        words = re.findall(r"([A-Z])(-?[0-9.]+)", line.replace("%", ""))
        values = {letter: float(value) for letter, value in words if letter != "G"}
        for value in (value for letter, value in words if letter == "G"):
            if value in ("0", "1", "2", "3"):
                motion = int(value)
            elif value in ("90", "91"):
                absolute = value == "90"
            elif value not in ("21", "17", "94", "40", "49", "80"):
                raise NotRun(f"line {number}: G{value}")
        chosen = int(values.get("T", chosen))
        if values.get("M") == 6:
            tool = chosen
        if not any(letter in values for letter in "XYZ"):
            continue
        end = [
            values[letter] + (0 if absolute else place[k]) if letter in values else place[k]
            for k, letter in enumerate("XYZ")
        ]
        path = (tuple(place[:2]), tuple(end[:2]))
        if motion in (2, 3):
            offsets = (values.get("I", 0), values.get("J", 0))
            path += arc_from(*path, offsets, motion == 2)
        found.append(Motion(number, tool, motion == 0, path, (place[2], end[2])))
        place = end
    return found


class Contact:
    """A contact.

    kind    E0743 with the number of the avoided solid from 0, or E0744 or E0745 with 0
    line    number of the line in the file
    place   a point of the plane that is hit
    by      how far up the part of the tool would have to go there, in mm
    """

    def __init__(self, kind, line, place, by):
        self.kind, self.line, self.place, self.by = kind, line, place, by

    def __str__(self):
        (code, _), (x, y) = self.kind, self.place
        return f"line {self.line}: {code} at ({x:.3f}, {y:.3f}), by {self.by:.3f} in height"


class Field:
    """Points of the plane, with what stands over them: the heights of stock for rapid moves
    (`metal`), those of stock for shanks and holders (`stock`), and those of the avoided solids.
    They are computed for a reading: `sign` is 1 for certain contacts and -1 for possible ones."""

    def __init__(self, setup, x, y, sign):
        self.setup, self.x, self.y, self.sign = setup, x, y, sign
        self.known = {}
        stock = setup["stock"]
        if stock:
            self.metal = self.stock = self._over(stock["shapes"], stock["top"], stock["holes"])
            self.bottom = stock["bottom"]
        else:
            self.metal = self._over(setup["metal"], 0)
            self.stock = (numpy.full(x.shape, True), 0)
            self.bottom = -numpy.inf
        self.avoided = [self._over(solid["shapes"], solid["top"]) for solid in setup["avoided"]]

    def _over(self, shapes, top, holes=()):
        """The points over which something stands, and its height."""
        if not shapes:
            return numpy.full(self.x.shape, False), -math.inf
        inside = from_shapes(shapes, self.x, self.y) <= -self.sign * HAIR
        for hole in holes:
            inside &= from_shape(hole, self.x, self.y) >= self.sign * HAIR
        return inside, top

    def within(self, path, radius):
        """Indices of the points within a radius of a path, and their distances from it."""
        reach, at, distances = self.known.get(path, (-1, None, None))
        if reach < radius:
            at, distances = self._near(path, radius)
            if len(self.known) >= MOST_PATHS:
                self.known.clear()
            self.known[path] = (radius, at, distances)
        count = numpy.searchsorted(distances, radius)
        return at[:count], distances[:count]

    def _near(self, path, radius):
        a, b = path[:2]
        if len(path) == 4:
            # The box around the whole circle.
            x, y = path[2]
            reach = math.hypot(a[0] - x, a[1] - y)
            a, b = (x - reach, y - reach), (x + reach, y + reach)
        left, right = min(a[0], b[0]) - radius, max(a[0], b[0]) + radius
        low, high = min(a[1], b[1]) - radius, max(a[1], b[1]) + radius
        at = numpy.flatnonzero(
            (self.x >= left) & (self.x <= right) & (self.y >= low) & (self.y <= high)
        )
        distances = (to_arc if len(path) == 4 else to_segment)(self.x[at], self.y[at], *path)
        order = numpy.argsort(distances)
        order = order[: numpy.searchsorted(distances[order], radius)]
        return at[order], distances[order]


class Run:
    """A run of motions on a field. `over` names the over-estimates. `contacts` has the contacts, in
    the order of the file: for each motion the deepest one of each kind."""

    def __init__(self, field, motions, over=()):
        self.field, self.over, self.sign = field, over, field.sign
        setup = field.setup
        self.tools = {int(number): tool for number, tool in setup["tools"].items()}
        self.side = setup["tolerance"] + setup["pulse"]
        # For each tool, the heights up to which stock is left.
        self.left = {number: numpy.full(field.x.shape, numpy.inf) for number in self.tools}
        self.contacts = []
        for motion in motions:
            self._move(motion)

    def _move(self, motion):
        self.deepest = {}
        pieces = motion.pieces()
        falls = motion.length() == 0 and motion.z[1] < motion.z[0]
        if "own" in self.over:
            for step in (self._check, self._remove):
                for piece in pieces:
                    step(motion, *piece)
        else:
            for piece in pieces:
                for step in (self._remove, self._check) if falls else (self._check, self._remove):
                    step(motion, *piece)
        self.contacts += self.deepest.values()

    def _check(self, motion, path, low, high):
        tool, field = self.tools[motion.tool], self.field
        cutter = (tool["radius"], 0, 0 if "point" in self.over else tool["slope"])
        holder = [(radius, above, 0) for radius, above in tool["holder"]]
        shank = [] if tool["flutes"] is None else [(tool["radius"], tool["flutes"], 0)]
        for k, solid in enumerate(field.avoided):
            for part in [cutter] + holder:
                self._meet(("E0743", k), motion, (path, low, high), part, solid, None)
        left = self.left[motion.tool]
        if motion.rapid:
            self._meet(("E0744", 0), motion, (path, low, high), cutter, field.metal, left)
        for part in shank + holder:
            self._meet(("E0745", 0), motion, (path, low, high), part, field.stock, left)

    def _meet(self, kind, motion, piece, part, solid, left):
        """Contact of a part of the tool with a solid, up to what is left of it."""
        (path, low, high), (radius, above, slope), (is_solid, solid_top) = piece, part, solid
        if low + above >= solid_top:
            return
        if "lowest" in self.over:
            low = min(motion.z)
        tip = high if self.sign > 0 else low
        at, distances = self.field.within(path, radius - self.side - self.sign * HAIR)
        if not at.size:
            return
        top = numpy.where(is_solid[at], solid_top, -numpy.inf)
        if left is not None:
            top = numpy.minimum(top, left[at])
            if "bottom" not in self.over:
                top = numpy.where(top > self.field.bottom, top, -numpy.inf)
        margin = self.field.setup["pulse"] + HAIR if self.sign > 0 else -HAIR
        by = top - (tip + above + slope * distances + margin)
        deepest = int(by.argmax())
        if by[deepest] > 0:
            place = (float(self.field.x[at[deepest]]), float(self.field.y[at[deepest]]))
            contact = Contact(kind, motion.line, place, float(by[deepest]))
            if kind not in self.deepest or self.deepest[kind].by < contact.by:
                self.deepest[kind] = contact

    def _remove(self, motion, path, low, high):
        field = self.field
        if motion.rapid or low >= max(field.stock[1], field.metal[1]):
            return
        tool = self.tools[motion.tool]
        at, distances = field.within(path, tool["radius"] + self.sign * HAIR)
        tip = low if self.sign > 0 else high
        cone = tip + tool["slope"] * numpy.maximum(distances - self.sign * HAIR, 0)
        for number, left in self.left.items():
            if number == motion.tool and (self.sign > 0 or "point" in self.over):
                heights = tip
            elif "point" in self.over:
                heights = tip + tool["slope"] * tool["radius"]
            else:
                heights = cone
            left[at] = numpy.minimum(left[at], heights)


def certain(field, motions):
    """The certain contacts on a field."""
    return Run(field, motions).contacts


def possible(setup, motions, line, place, over=()):
    """Test that a motion in a line may touch stock at a place; gives the codes of the contacts."""
    before = [motion for motion in motions if motion.line <= line]
    field = Field(setup, numpy.array([place[0]]), numpy.array([place[1]]), -1)
    return {contact.kind[0] for contact in Run(field, before, over).contacts if contact.line == line}


def grid(setup, motions, cell):
    """A field with a point in each cell of the area in which there is anything."""
    shapes = list(setup["metal"]) + (setup["stock"]["shapes"] if setup["stock"] else [])
    for solid in setup["avoided"]:
        shapes += solid["shapes"]
    places = [p for motion in motions for p in motion.path[:2]]
    places += [p for shape in shapes for p in shape["points"]]
    grown = max([shape["grow"] for shape in shapes] + [10])
    (left, right), (low, high) = [
        (min(p[k] for p in places) - grown, max(p[k] for p in places) + grown) for k in (0, 1)
    ]
    x, y = numpy.meshgrid(
        numpy.arange(left + cell / 2, right, cell), numpy.arange(low + cell / 2, high, cell)
    )
    return Field(setup, x.ravel(), y.ravel(), 1)


def main():
    parser = argparse.ArgumentParser(description="Reports what a tool hits in a file of G-code.")
    parser.add_argument("setup", metavar="SETUP")
    parser.add_argument("file", metavar="FILE")
    parser.add_argument("--cell", type=float, default=0.25, help="size of a cell, in mm")
    given = parser.parse_args()
    with open(given.setup, encoding="utf-8") as file:
        setup = json.load(file)
    with open(given.file, encoding="utf-8") as file:
        motions = motions_of(file.read(), setup)
    contacts = certain(grid(setup, motions, given.cell), motions)
    for contact in contacts:
        print(f"{given.file}: {contact}")
    return 1 if contacts else 0


if __name__ == "__main__":
    sys.exit(main())
