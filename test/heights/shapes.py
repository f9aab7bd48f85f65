"""Shapes in the words of a program, and their areas in Shapely, for `works.py`."""

import math

from shapely.geometry import LineString, Point, Polygon, box

SEGMENTS = 64


def grown(area, by):
    """An area, grown by a distance with round corners."""
    return area.buffer(by, SEGMENTS)


def opened(area, radius, less=0.0):
    """What a disc covers that stays in an area. The area counts as smaller by `less`."""
    return grown(grown(area, -radius - less), radius)


def rounded(rng, least, most, step=0.5):
    """A random number in steps."""
    return round(round(rng.uniform(least, most) / step) * step, 4)


def point(p):
    """A point in a program."""
    return "(" + ", ".join(f"{c:g}" for c in p) + ")"


class Shape:
    """A closed shape: its text, its area, its straight sides, and the radius of its narrowest
    corner, seen from inside."""

    def __init__(self, text, area, sides, radius):
        self.text, self.area, self.sides, self.radius = text, area, sides, radius


def polygon_shape(corners, text=None):
    """A polygon, counter-clockwise."""
    sides = list(zip(corners, corners[1:] + corners[:1]))
    text = text or "polygon([" + ", ".join(point(p) for p in corners) + "])"
    return Shape(text, Polygon(corners), sides, 0)


def rectangle(x, y, w, h):
    """A rectangle about a centre."""
    a, b = (x - w / 2, y - h / 2), (x + w / 2, y + h / 2)
    text = f"rectangle({point(a)}, {point(b)})"
    return polygon_shape([a, (b[0], a[1]), b, (a[0], b[1])], text)


def rounded_rectangle(x, y, w, h, r):
    """A rectangle with round corners about a centre."""
    a, b = (x - w / 2, y - h / 2), (x + w / 2, y + h / 2)
    area = grown(box(a[0] + r, a[1] + r, b[0] - r, b[1] - r), r)
    sides = [
        ((a[0] + r, a[1]), (b[0] - r, a[1])), ((b[0], a[1] + r), (b[0], b[1] - r)),
        ((b[0] - r, b[1]), (a[0] + r, b[1])), ((a[0], b[1] - r), (a[0], a[1] + r)),
    ]
    return Shape(f"rounded({point(a)}, {point(b)}, {r:g})", area, sides, r)


def slot(x, y, length, width, angle=0):
    """A slot about a centre, at an angle in degrees."""
    u, v = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    half, r = length / 2, width / 2
    a, b = [tuple(round(c + k * half * t, 3) for c, t in ((x, u), (y, v))) for k in (-1, 1)]
    sides = [
        ((p[0] + k * r * v, p[1] - k * r * u), (q[0] + k * r * v, q[1] - k * r * u))
        for k, p, q in ((1, a, b), (-1, b, a))
    ]
    area = grown(LineString([a, b]), r)
    return Shape(f"slot({point(a)}, {point(b)}, {width:g})", area, sides, r)


def regular(x, y, r, count, angle):
    """A regular polygon whose first corner is at an angle in degrees."""
    corners = [
        (x + r * math.cos(math.radians(angle + 360 * k / count)),
         y + r * math.sin(math.radians(angle + 360 * k / count)))
        for k in range(count)
    ]
    text = f"polygon(circle({point((x, y))}, {r:g}), {count}, {angle} deg)"
    return polygon_shape(corners, text)


def circle(x, y, r):
    """A circle."""
    return Shape(f"ccw circle({point((x, y))}, {r:g})", grown(Point(x, y), r), [], r)


def bracket(x, y, w, h, cut):
    """A rectangle without its upper right corner."""
    a, b = (x - w / 2, y - h / 2), (x + w / 2, y + h / 2)
    return polygon_shape([
        a, (b[0], a[1]), (b[0], b[1] - cut), (b[0] - cut, b[1] - cut), (b[0] - cut, b[1]),
        (a[0], b[1]),
    ])


def pointed(x, y, w, h, cut):
    """A rectangle with two corners cut off."""
    a, b = (x - w / 2, y - h / 2), (x + w / 2, y + h / 2)
    return polygon_shape([
        (a[0] + cut, a[1]), (b[0], a[1]), (b[0], b[1] - cut), (b[0] - cut, b[1]), (a[0], b[1]),
        (a[0], a[1] + cut),
    ])
