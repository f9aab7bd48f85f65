"""Compares areas of unions, intersections and differences with those of GEOS.

Reads one case in each line of standard input, as JSON: two regions, each a list of closed loops
of vertices (x, y, tan(sweep/4) of the segment that begins there), and the three areas in mm². An
area of -1 means that there is no result. Prints the cases that differ by more than the error of the
chords by which arcs are replaced here, and fails if there is one.
"""

import json
import math
import sys

from shapely.geometry import Polygon
from shapely.validation import make_valid

CHORDS = 64  # of one arc


def chords(loop):
    """Points of a loop, and the area between its arcs and their chords."""
    points = []
    error = 0.0
    for (x, y, b), (x1, y1, _) in zip(loop, loop[1:] + loop[:1]):
        points.append((x, y))
        if b == 0:
            continue
        sweep = 4 * math.atan(b)
        dx, dy = x1 - x, y1 - y
        chord = math.hypot(dx, dy)
        if chord == 0:
            continue
        radius = chord / (2 * math.sin(abs(sweep) / 2))
        part = abs(sweep) / CHORDS
        error += CHORDS * radius * radius * (part - math.sin(part)) / 2
        for k in range(1, CHORDS):
            # The chord from the start to the point is 2 r sin(k part / 2) long.
            length = math.sin(k * part / 2) / math.sin(abs(sweep) / 2)
            turn = (k / CHORDS - 1) * sweep / 2
            c, s = math.cos(turn), math.sin(turn)
            points.append((x + length * (dx * c - dy * s), y + length * (dx * s + dy * c)))
    return points, error


def without_spikes(points):
    """Points without those that the loop visits on the way to a point and back."""
    kept = []
    for p in points:
        if kept and kept[-1] == p:
            continue
        if len(kept) > 1 and kept[-2] == p:
            kept.pop()
        else:
            kept.append(p)
    while len(kept) > 2 and (kept[0] == kept[-1] or kept[1] == kept[-1]):
        kept = kept[:-1] if kept[0] == kept[-1] else kept[1:]
    return kept


def region(loops):
    """The region of loops by the even-odd rule, and the error of its area."""
    shape = Polygon()
    error = 0.0
    for loop in loops:
        points, own = chords(loop)
        error += own
        # The repair of GEOS would fill an area that spikes enclose.
        points = without_spikes(points)
        if len(points) >= 3:
            shape = shape.symmetric_difference(make_valid(Polygon(points)).buffer(0))
    return shape, error


def main():
    worst = 0
    for line in sys.stdin:
        case = json.loads(line)
        (a, error_a), (b, error_b) = map(region, case["regions"])
        theirs = [a.union(b).area, a.intersection(b).area, a.difference(b).area]
        allowed = error_a + error_b + 1e-6
        for name, own, other in zip(["union", "intersection", "difference"], case["areas"], theirs):
            if own >= 0 and abs(own - other) > allowed:
                print(name, own, other, allowed, line.strip())
                worst = 1
    sys.exit(worst)


main()
