#!/usr/bin/env python3
"""Computes points of the pieces of test/programs/cipher/good/change-*.part, and of the paths of a
cutter beside them. Needs numpy.

    changes.py > test/changes/expected.txt

This shares nothing with partc. A curve is a list of smooth branches, each of them two Chebyshev
series, for x and for y, over the parameter of the spline, which is the sum of the chords. A branch
counts in an interval, but its series hold a little beyond it. The branches of a spline are its
spans. Where a distance begins or ends to change, a branch is divided, and each part keeps the
formula of its distance beyond the division.

A shift moves the branches one by one. Two neighbours that still touch with one direction stay as
they are; otherwise both end where they intersect. A path of a cutter is a shift by its radius, but
on the outer side of a break the branches keep their ends, because the cutter goes round the vertex.

A line of the result has the name of a program, the word piece, left or right (the side on which the
cutter's path lies), and x and y in mm.
"""

import numpy as np
from numpy.polynomial import chebyshev

X, Y, MU, H, T = range(5)
RIB = np.array(
    [
        [0, 40, 2.0, 18, 1.0],
        [30, 47, 2.2, 17, 1.4],
        [60, 52.5, 2.6, 16, 1.9],
        [90, 56, 3.0, 15, 1.6],
        [120, 58, 3.4, 14, 1.2],
    ]
)
BEYOND = 2.0  # mm of parameter by which the series of a branch hold beyond its interval
DEGREE = 30

A, B = (40, 49.5), (85, 55)
# The ciphers of each program, the side of the piece as the sign of a left normal, and the radius of
# the cutter. A cipher is its digit and its values, which may be columns of the table. In "1" the
# two points at the end bound the change.
PROGRAMS = {
    "change-after-2-before-4": ([("2", 2), ("1", 0, 1.5, A, B), ("4", MU, H)], 1, 5),
    "change-first": ([("1", 1, 3, A, B), ("2", 2, MU), ("6", T)], -1, 5),
    "change-after-6-before-2": ([("6", T), ("1", 2, 0.5, A, B), ("2", 3)], 1, 8),
    "change-between-changes": (
        [("4", MU, H), ("1", 0, 2, A, B), ("6", T, MU), ("1", 0.5, 0, (60, 52), (100, 56))],
        -1,
        3,
    ),
}


def nodes(low, high):
    return (low + high) / 2 + (high - low) / 2 * np.cos(np.pi * (np.arange(DEGREE + 1) + 0.5) / (DEGREE + 1))


def fitted(low, high, values):
    series = chebyshev.Chebyshev.fit(nodes(low, high), values, DEGREE, domain=[low, high])
    return series


class Branch:
    def __init__(self, low, high, x, y, span):
        self.low, self.high, self.x, self.y, self.span = low, high, x, y, span
        self.dx, self.dy = x.deriv(), y.deriv()

    def at(self, u):
        return np.array([self.x(u), self.y(u)])

    def velocity(self, u):
        return np.array([self.dx(u), self.dy(u)])

    def normal(self, u):
        v = self.velocity(u)
        return np.array([-v[1], v[0]]) / np.hypot(v[0], v[1])

    def domain(self):
        return self.x.domain

    def run(self):
        """The arc length from the beginning of the interval, as a series."""
        low, high = self.domain()
        v = self.velocity(nodes(low, high))
        return fitted(low, high, np.hypot(v[0], v[1])).integ(lbnd=self.low)

    def divided(self, u):
        return [
            Branch(self.low, u, self.x, self.y, self.span),
            Branch(u, self.high, self.x, self.y, self.span),
        ]


def splines():
    """The rows of the table as cubic polynomials for each span, over the sum of the chords."""
    points = RIB[:, :2]
    chords = np.hypot(*np.diff(points, axis=0).T)
    at = np.concatenate([[0], np.cumsum(chords)])
    n = len(at)
    matrix, right = np.zeros((n, n)), np.zeros((n, RIB.shape[1]))
    matrix[0, 0] = matrix[-1, -1] = 1
    for i in range(1, n - 1):
        a, b = chords[i - 1], chords[i]
        matrix[i, i - 1 : i + 2] = [a, 2 * (a + b), b]
        right[i] = 6 * ((RIB[i + 1] - RIB[i]) / b - (RIB[i] - RIB[i - 1]) / a)
    second = np.linalg.solve(matrix, right)

    def value(span, column, u):
        h, a, b = chords[span], at[span + 1] - u, u - at[span]
        m, v = second[:, column], RIB[:, column]
        return (
            (m[span] * a**3 + m[span + 1] * b**3) / (6 * h)
            + (v[span] / h - m[span] * h / 6) * a
            + (v[span + 1] / h - m[span + 1] * h / 6) * b
        )

    return at, value


AT, COLUMN = splines()


def spline():
    branches = []
    for span in range(len(AT) - 1):
        low, high = AT[span] - BEYOND, AT[span + 1] + BEYOND
        u = nodes(low, high)
        x, y = (fitted(low, high, COLUMN(span, c, u)) for c in (X, Y))
        branches.append(Branch(AT[span], AT[span + 1], x, y, span))
    return branches


def nearest(curve, point):
    """The branch and the parameter of the point of a curve that is nearest to a point."""
    best = None
    for i, b in enumerate(curve):
        for u in np.linspace(b.low, b.high, 200):
            d = np.hypot(*(b.at(u) - point))
            if best is None or d < best[0]:
                best = (d, i, u)
    _, i, u = best
    b = curve[i]
    for _ in range(50):
        v = b.velocity(u)
        u = min(b.high, max(b.low, u + np.dot(v, point - b.at(u)) / np.dot(v, v)))
    return i, u


def divided(curve, point):
    i, u = nearest(curve, point)
    return curve[:i] + curve[i].divided(u) + curve[i + 1 :]


def lengths(curve):
    """The arc lengths at the beginnings of the branches."""
    return np.concatenate([[0], np.cumsum([b.run()(b.high) for b in curve])])


def recalculated(curve, cipher, side):
    digit, *values = cipher
    slanted = None
    if digit == "1":
        h1, h2, a, b = values
        u1, u2 = nearest(curve, a), nearest(curve, b)
        begin = lengths(curve)[u1[0]] + curve[u1[0]].run()(u1[1])
        end = lengths(curve)[u2[0]] + curve[u2[0]].run()(u2[1])
        curve = divided(divided(curve, a), b)
        starts = lengths(curve)

        def distance(i, u):
            if starts[i] < begin - 1e-6:
                return h1 + 0 * u
            if starts[i] > end - 1e-6:
                return h2 + 0 * u
            return h1 + (h2 - h1) * (starts[i] + curve[i].run()(u) - begin) / (end - begin)

    else:
        column = lambda i, c, u: COLUMN(curve[i].span, c, u)
        if digit == "2":
            distance = lambda i, u: values[0] + 0 * u
            slanted = values[1] if len(values) > 1 else None
        elif digit == "4":
            distance = lambda i, u: column(i, H, u) * np.tan(np.radians(column(i, MU, u)))
        else:
            distance = lambda i, u: column(i, values[0], u)
            slanted = values[1] if len(values) > 1 else None
    moved = []
    for i, b in enumerate(curve):
        low, high = b.domain()
        u = nodes(low, high)
        d = distance(i, u)
        if slanted is not None:
            d = d / np.cos(np.radians(COLUMN(b.span, slanted, u)))
        p = b.at(u) + side * d * b.normal(u)
        moved.append(Branch(b.low, b.high, fitted(low, high, p[0]), fitted(low, high, p[1]), b.span))
    return joined(curve, moved, lambda k: True)


def turn(b, c, u, w):
    p, q = b.velocity(u), c.velocity(w)
    return np.arctan2(p[0] * q[1] - p[1] * q[0], np.dot(p, q))


def joined(below, branches, intersects):
    """The branches, of which neighbours at a break end where they intersect."""
    for k in range(len(branches) - 1):
        b, c = branches[k], branches[k + 1]
        if abs(turn(below[k], below[k + 1], below[k].high, below[k + 1].low)) < 1e-7 or not intersects(k):
            continue
        u, w = b.high, c.low
        for _ in range(30):
            gap = c.at(w) - b.at(u)
            step = np.linalg.solve(np.array([b.velocity(u), -c.velocity(w)]).T, gap)
            u, w = u + step[0], w + step[1]
        assert np.hypot(*(c.at(w) - b.at(u))) < 1e-9, "no intersection"
        b.high, c.low = u, w
    return branches


def path(piece, side, radius):
    """The path of a cutter beside a piece; side is the sign of a left normal."""
    moved = []
    for b in piece:
        low, high = b.domain()
        u = nodes(low, high)
        p = b.at(u) + side * radius * b.normal(u)
        moved.append(Branch(b.low, b.high, fitted(low, high, p[0]), fitted(low, high, p[1]), b.span))
    isInner = lambda k: side * turn(piece[k], piece[k + 1], piece[k].high, piece[k + 1].low) > 0
    return joined(piece, moved, isInner)


def main():
    for name, (ciphers, side, radius) in PROGRAMS.items():
        curve = spline()
        for cipher in ciphers:
            curve = recalculated(curve, cipher, side)
        for what, branches in [
            ("piece", curve),
            ("left", path(curve, 1, radius)),
            ("right", path(curve, -1, radius)),
        ]:
            for b in branches:
                for share in (0, 0.1, 0.3, 0.5, 0.7, 0.9, 1):
                    x, y = b.at(b.low + share * (b.high - b.low))
                    print(f"{name} {what} {x:.6f} {y:.6f}")


main()
