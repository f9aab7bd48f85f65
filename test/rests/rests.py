#!/usr/bin/env python3
"""Judges rest machining and facing by the G-code alone: rests.py PARTC [COUNT] [SEED]

Makes random pockets with islands, roughed by one cutter and finished by a smaller one, and faced
regions, compiles them with partc, reads the files and compares random points:

- the centre of each cutter keeps its radius from all walls, in a pocket;
- a point that the smaller cutter alone could cover is covered by one of the two;
- a point of a faced region is covered;
- no move is below the depth.

It shares nothing with partc: the walls are lines and circles of its own, and whether a cutter can
cover a point is decided by trying positions around the point.
"""

import math
import random
import re
import subprocess
import sys
import tempfile

TOLERANCE = 0.01
# The pulse of the file, and what counts as no rest.
SLACK = 0.004 + 0.01
DEPTH = 2


def ring(points):
    """The sides of a polygon."""
    return [("line", a, b) for a, b in zip(points, points[1:] + points[:1])]


def away(wall, p):
    """The distance of a point from a wall."""
    if wall[0] == "circle":
        return abs(math.dist(wall[1], p) - wall[2])
    _, a, b = wall
    dx, dy = b[0] - a[0], b[1] - a[1]
    t = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy)
    t = max(0, min(1, t))
    return math.dist((a[0] + t * dx, a[1] + t * dy), p)


class Shape:
    """A polygon or a circle."""

    def __init__(self, points=None, centre=None, radius=None):
        self.points, self.centre, self.radius = points, centre, radius
        self.walls = [("circle", centre, radius)] if centre else ring(points)

    def text(self):
        if self.centre:
            return f"ccw circle(({self.centre[0]:g}, {self.centre[1]:g}), {self.radius:g})"
        return " ".join(f"({x:g}, {y:g})" for x, y in self.points)

    def holds(self, p):
        if self.centre:
            return math.dist(self.centre, p) < self.radius
        inside = False
        for (ax, ay), (bx, by) in zip(self.points, self.points[1:] + self.points[:1]):
            if (ay > p[1]) != (by > p[1]) and p[0] < ax + (bx - ax) * (p[1] - ay) / (by - ay):
                inside = not inside
        return inside

    def gap(self, other):
        """About the distance of two shapes: the least one of points on the one from the other."""
        return min(away(w, p) for w in other.walls for p in self.border())

    def border(self):
        if self.centre:
            return [
                (
                    self.centre[0] + self.radius * math.cos(k * math.pi / 36),
                    self.centre[1] + self.radius * math.sin(k * math.pi / 36),
                )
                for k in range(72)
            ]
        return [
            (a[0] + (b[0] - a[0]) * k / 40, a[1] + (b[1] - a[1]) * k / 40)
            for _, a, b in self.walls
            for k in range(40)
        ]


def pocket(rng):
    """A random outline with islands."""
    w, h = rng.randint(30, 60), rng.randint(25, 45)
    points = [(0, 0), (w, 0), (w, h), (w * rng.uniform(0.3, 0.7), h + rng.randint(-6, 8)), (0, h)]
    outline = Shape([(round(x, 2), round(y, 2)) for x, y in points])
    islands = []
    for _ in range(rng.randint(0, 4)):
        c = (round(rng.uniform(4, w - 4), 1), round(rng.uniform(4, h - 4), 1))
        r = rng.randint(2, 6)
        new = Shape(centre=c, radius=r)
        if rng.random() < 0.5:
            new = Shape([(c[0] - r, c[1] - r), (c[0] + r, c[1] - r), (c[0], c[1] + r)])
        if (
            all(outline.holds(p) for p in new.border())
            and new.gap(outline) > 1
            and all(
                new.gap(o) > 1 and not new.holds(o.border()[0]) and not o.holds(new.border()[0])
                for o in islands
            )
        ):
            islands.append(new)
    return outline, islands


def head(name, diameter):
    return [
        f"part {name}",
        "machine linuxcnc-mill",
        f"tool 1 mill(diameter {diameter:g})",
        "feed 300",
        f"tolerance {TOLERANCE}",
        "clearance 5",
        "from (-40, -40, 5)",
        "spindle manual",
    ]


def motions(text):
    """The level motions of a file by tool: polylines of points; and the lowest height."""
    tool, at, mode, lowest = 1, [-40.0, -40.0, 5.0], 0, 5.0
    found = {}
    for line in text.splitlines():
        line = re.sub(r"\([^)]*\)|;.*", "", line)
        words = re.findall(r"([A-Z])\s*(-?[\d.]+)", line)
        values = dict(words)
        if any(l == "G" and float(n) not in (0, 1, 2, 3) for l, n in words) and "X" not in values:
            if any(l == "G" and float(n) in (53, 28, 43, 49) for l, n in words):
                continue
        if "T" in values:
            tool = int(float(values["T"]))
        for l, n in words:
            if l == "G" and float(n) in (0, 1, 2, 3):
                mode = int(float(n))
        if not any(k in values for k in "XYZ"):
            continue
        new = [float(values.get(k, v)) for k, v in zip("XYZ", at)]
        lowest = min(lowest, new[2])
        path = [tuple(at[:2]), tuple(new[:2])]
        if mode in (2, 3):
            c = (at[0] + float(values.get("I", 0)), at[1] + float(values.get("J", 0)))
            a = math.atan2(at[1] - c[1], at[0] - c[0])
            b = math.atan2(new[1] - c[1], new[0] - c[0])
            r = math.dist(c, at[:2])
            turn = (b - a) % (2 * math.pi) if mode == 3 else -((a - b) % (2 * math.pi))
            if abs(turn) < 1e-9:
                turn = 2 * math.pi if mode == 3 else -2 * math.pi
            # So many chords that they deviate by less than 0.001 mm.
            n = max(2, math.ceil(abs(turn) / (2 * math.sqrt(0.002 / max(r, 0.01)))))
            path = [
                (c[0] + r * math.cos(a + turn * k / n), c[1] + r * math.sin(a + turn * k / n))
                for k in range(n + 1)
            ]
        if at[2] == new[2]:
            found.setdefault(tool, []).append((new[2], mode, path))
        at = new
    return found, lowest


def covered(moves, radius, p):
    return any(
        away(("line", a, b), p) <= radius if a != b else math.dist(a, p) <= radius
        for z, mode, path in moves
        if mode and abs(z + DEPTH) < 0.0005
        for a, b in zip(path, path[1:])
        if min(a[0], b[0]) - radius <= p[0] <= max(a[0], b[0]) + radius
    )


def compiled(partc, program):
    with tempfile.TemporaryDirectory() as folder:
        with open(f"{folder}/p.part", "w", encoding="utf-8") as f:
            f.write("\n".join(program) + "\n")
        done = subprocess.run(
            [partc, "-q", "compile", "p.part", "-o", "p.ngc"],
            cwd=folder, capture_output=True, text=True, check=False,
        )
        if done.returncode:
            return None, done.stderr
        with open(f"{folder}/p.ngc", encoding="utf-8") as f:
            return f.read(), ""


def judge_rest(partc, rng):
    outline, islands = pocket(rng)
    walls = outline.walls + [w for i in islands for w in i.walls]
    large = rng.choice([6, 8, 10, 12, 16])
    small = large * rng.uniform(0.2, 0.8)
    small = round(small, 1)
    left = rng.choice([0, 0, 0.3, 1])
    program = head("rest", large) + [f"contour c closed {{ {outline.text()} }}"]
    program += [f"contour i{k} closed {{ {i.text()} }}" for k, i in enumerate(islands)]
    names = "islands " + ", ".join(f"i{k}" for k in range(len(islands))) if islands else ""
    program += [
        f"pocket c step {large * 0.6:g} as rough {{ {names}  depth {DEPTH}  allowance {left}  rest allowed }}",
        f"change 2 mill(diameter {small:g})",
        f"rest of rough step {small * rng.choice([0.4, 0.5, 0.9]):g} {{ rest allowed }}",
    ]
    text, why = compiled(partc, program)
    if text is None:
        return None if "E0420" in why else (program, why)
    found, lowest = motions(text)
    if lowest < -DEPTH - 0.0005:
        return program, f"down to {lowest}"
    for tool, radius in [(1, large / 2), (2, small / 2)]:
        for z, _, path in found.get(tool, []):
            if z < 0:
                for p in path:
                    near = min(away(w, p) for w in walls)
                    if near < radius - TOLERANCE - 0.002:
                        return program, f"tool {tool} at {p} is {near} away from a wall"
    r = small / 2
    for _ in range(250):
        p = rng.uniform(0, 60), rng.uniform(-6, 55)
        if not outline.holds(p) or any(i.holds(p) for i in islands):
            continue
        tries = [p] + [
            (p[0] + d * math.cos(a), p[1] + d * math.sin(a))
            for d in (0.3 * r, 0.6 * r, 0.9 * r, 0.999 * r)
            for a in [k * math.pi / 18 for k in range(36)]
        ]
        reachable = any(
            outline.holds(c)
            and not any(i.holds(c) for i in islands)
            and min(away(w, c) for w in walls) >= r + 0.0005
            for c in tries
        )
        if reachable and not any(
            covered(found.get(t, []), radius + TOLERANCE + SLACK, p)
            for t, radius in [(1, large / 2), (2, r)]
        ):
            return program, f"{p} is left"
    return True


def judge_face(partc, rng):
    outline, islands = pocket(rng)
    large = rng.choice([10, 16, 25])
    sense = rng.choice(["", "climb", "conventional"])
    program = head("face", large) + [f"contour c closed {{ {outline.text()} }}"]
    program += [f"contour i{k} closed {{ {i.text()} }}" for k, i in enumerate(islands)]
    region = "c"
    for k in range(len(islands)):
        region = f"difference({region}, i{k})"
    program += [
        f"face {region} step {large * rng.uniform(0.3, 1):g} "
        f"{{ depth {DEPTH} step 1  angle {rng.randint(0, 180)}  {sense} }}"
    ]
    text, why = compiled(partc, program)
    if text is None:
        return program, why
    found, lowest = motions(text)
    if lowest < -DEPTH - 0.0005:
        return program, f"down to {lowest}"
    for _ in range(200):
        p = rng.uniform(0, 60), rng.uniform(-6, 55)
        if outline.holds(p) and not any(i.holds(p) for i in islands):
            if not covered(found.get(1, []), large / 2 + 0.002, p):
                return program, f"{p} is left"
    return True


def main():
    partc = sys.argv[1]
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else random.randrange(10**6)
    print("seed", seed)
    rng = random.Random(seed)
    passed = left_out = 0
    for k in range(count):
        answer = (judge_face if k % 3 == 2 else judge_rest)(partc, rng)
        if answer is None:
            left_out += 1
        elif answer is True:
            passed += 1
        else:
            print("\n".join(answer[0]), answer[1], sep="\n\n")
            print(f"{passed} passed, 1 failed, {left_out} skipped")
            sys.exit(1)
    print(f"{passed} passed, 0 failed, {left_out} skipped")


if __name__ == "__main__":
    main()
