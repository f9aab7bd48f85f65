#!/usr/bin/env python3
"""Judges pairs of tapes: the tape that the compiler makes, and another one for the same part. Reads only the tapes.

    wrong_tapes.py FOLDER     one line for each pair, then a table; status 1 if a pair is not confirmed

With PARTC_WRITE_TAPES=FOLDER the tests write such pairs (docs/laws.md). A pair has three files: NAME.own.tape,
NAME.other.tape, and NAME.json with what is on no tape: the machine, the cutters, the position before the first frame,
and the deviation that the part allows. The pair is confirmed if the other tape is wrong, for the first of these
reasons that holds:

    feed        it has the same path at other speeds
    material    it removes other material
    order       it removes the same material in another order, or at other speeds
    cut path    it removes the same material in the same order, but its path is another one below the top of the part
    air path    the same, and the paths differ only above the top of the part

A path is another one if its Fréchet distance from the first is more than two right tapes can have.

The part is a raster of cells in x and y, in layers between the heights at which the tapes cut. The cutter is a
cylinder. A stroke, the motion of one frame, removes the cells that the cutter covers. A coarse raster of the whole part
is compared first, then fine ones of patches where strokes differ. If a tape never changes its height, each stroke
counts as a cut, because nothing says where the material is. So it does for a turning tool, where x and y are the plane
of the section, and for a blade, whose height is its swivel. If the control compensates the cutter, the tape contains
the edge of the part, and the edge is taken for the path.
"""
import collections
import glob
import itertools
import json
import math
import os
import re
import sys

# Tapes ----------------------------------------------------------------------------------------------------------

CODE_8421 = {n: n for n in range(10)}
CODE_5121 = {0: 0, 1: 1, 5: 2, 6: 3, 7: 4, 8: 5, 9: 6, 10: 7, 11: 8, 15: 9}
LEADER = 25
LETTERS = "НЕДТКПШСВЯ"

# The motion of one frame: both ends and the centre (none for a line) in pulses, the sense of an arc (1 is
# counter-clockwise), the speed as it is written, and the radius of the cutter in mm.
Stroke = collections.namedtuple("Stroke", "frame start end centre sense speed radius")

# A frame as it is written: increments, centre from the beginning, sense (0 for a line), speed.
Frame = collections.namedtuple("Frame", "increment centre sense speed")
STILL = Frame((0, 0, 0), (0, 0), 0, None)


def number(rows, code):
    """The number of some rows of digits. A hole in track 5 of the first is a minus."""
    value = 0
    for row in rows:
        value = 10 * value + code[row & 15]
    return -value if rows[0] & 16 else value


def read_lkp(rows):
    frames, at = [], LEADER
    while at < len(rows) - LEADER:
        at += 0 if len(frames) % 2 == 0 else 2
        x, y, z = (number(rows[at + k : at + k + n], CODE_5121) for k, n in ((0, 4), (4, 4), (8, 3)))
        frames.append(Frame((x, y, z), (0, 0), 0, CODE_5121[rows[at + 11] & 15]))
        at += 15
    return frames


def read_lki(rows, code, width, ordinal, feed):
    """A tape of frames with fixed fields. `ordinal` and `feed` are the digits of the frame number and of the feed."""
    frames, at = [], LEADER
    while at < len(rows):
        if rows[at] == 0:
            at += 1
            continue
        at += 1 + ordinal
        kind = code[rows[at] & 15]
        fields = [number(rows[at + 1 + k * width : at + 1 + (k + 1) * width], code) for k in range(5)]
        at += 1 + 5 * width
        speed = abs(number(rows[at : at + feed], code))
        is_braking = rows[at] & 16 != 0
        sense = {1: 0, 2: -1, 3: 1}[kind]
        frames.append(Frame(tuple(fields[:3]), tuple(fields[3:]), sense, (speed, is_braking)))
        at += feed + (code is CODE_5121 or ordinal > 0)
    return frames


def read_kontur(rows):
    frames, at = [], LEADER
    while at < len(rows) - LEADER:
        end = at + 1
        while rows[end] != 16:
            end += 1
        text = "".join(LETTERS[r & 15] if r & 16 else str(r & 15) for r in rows[at + 1 : end])
        words = dict(re.findall(r"(\D)(\d+)", text))
        increment = tuple(
            int(words[a][1:]) * (1 if words[a][0] in "51" else -1) if a in words else 0 for a in "ЕДТ"
        )
        frames.append(Frame(increment, (0, 0), 0, words.get("П")))
        at = end + 4
    return frames


SENSES = {0: 0, 1: 0, 2: -1, 3: 1}


def read_n55(rows):
    text = "".join(chr(r & 127) for r in rows if r not in (0, 255))
    frames, feed = [], None
    for line in text.split("\n")[1:-1]:
        words = {a: int(n) for a, n in re.findall(r"([A-Z])([+-]?\d+)", line)}
        feed = words.get("F", feed)
        if "G" not in words:
            frames.append(STILL)
            continue
        if any(words.get(a, 0) for a in "AB"):
            sys.exit(f"wrong_tapes.py: frame {len(frames) + 1} turns a rotary axis, which the raster does not know.")
        increment = tuple(words.get(a, 0) for a in "XYZ")
        centre = (words.get("I", 0), words.get("J", 0))
        frames.append(Frame(increment, centre, SENSES[words["G"]], feed if words["G"] else "rapid"))
    return frames


def read_iso(rows, start):
    """A text with positions in thousandths of a millimetre. `start` is the position before the first frame."""
    frames, feed, at = [], None, list(start)
    for line in rows.decode("ascii").split("\n")[2:]:
        if line in ("", "%"):
            continue
        words = [(w[0], float(w[1:])) for w in line.split(" ")]
        motions = [v for a, v in words if a == "G" and v in SENSES]
        pulses = {a: round(1000 * v) for a, v in words}
        feed = pulses.get("F", feed)
        if not motions:
            frames.append(STILL)
            continue
        end = [pulses.get(a, p) for a, p in zip("XYZ", at)]
        centre = (pulses.get("I", 0), pulses.get("J", 0))
        increment = tuple(e - p for e, p in zip(end, at))
        frames.append(Frame(increment, centre, SENSES[motions[0]], feed if motions[0] else "rapid"))
        at = end
    return frames


READERS = {
    "lkp-01f": lambda rows, start: read_lkp(rows),
    "lki-fm": lambda rows, start: read_lki(rows, CODE_8421, 5, 0, 2),
    "lki-u": lambda rows, start: read_lki(rows, CODE_5121, 6, 0, 2),
    "lki-un": lambda rows, start: read_lki(rows, CODE_8421, 6, 3, 3),
    "kontur-2p": lambda rows, start: read_kontur(rows),
    "kontur-3p": lambda rows, start: read_kontur(rows),
    "n55": lambda rows, start: read_n55(rows),
    "iso6983": read_iso,
}


def strokes(card, rows, cutters):
    """The strokes of a tape. `cutters` has the first frames of the cutters, with their radii."""
    signs = [-1 if axis in card["reversed"] else 1 for axis in "XYZ"]
    mirror = signs[0] * signs[1]
    if card["machine"] not in READERS:
        sys.exit(f"wrong_tapes.py: READERS has no reader for the machine {card['machine']}.")
    at, out = tuple(card["start"]), []
    for n, f in enumerate(READERS[card["machine"]](rows, card["start"]), 1):
        if f == STILL or not (any(f.increment) or f.sense):
            continue
        end = tuple(p + s * d for p, s, d in zip(at, signs, f.increment))
        centre = tuple(p + s * d for p, s, d in zip(at, signs, f.centre)) if f.sense else None
        radius = [r for first, r in cutters if first <= n][-1]
        out.append(Stroke(n, at, end, centre, mirror * f.sense, f.speed, radius))
        at = end
    return out


# Paths ----------------------------------------------------------------------------------------------------------


def line_points(stroke, pulse, sagitta):
    """The points of a stroke in mm. Chords of an arc are no further from it than `sagitta`.

    The radii at both ends of an arc may differ, and controls disagree on the path between. One of the possible paths
    is taken: with the radius of the beginning, and straight to the end from there.
    """
    a, b = (tuple(p * u for p, u in zip(q, pulse)) for q in (stroke.start, stroke.end))
    if not stroke.sense or stroke.centre in (stroke.start[:2], stroke.end[:2]):
        return [a, b]
    x, y = (p * u for p, u in zip(stroke.centre, pulse))
    r = math.dist(a[:2], (x, y))
    begin = math.atan2(a[1] - y, a[0] - x)
    sweep = stroke.sense * (math.atan2(b[1] - y, b[0] - x) - begin) % (2 * math.pi)
    if sweep < 1e-9:
        sweep = 2 * math.pi
    step = 2 * math.acos(max(0.0, 1 - sagitta / r))
    count = max(2, math.ceil(sweep / max(step, 1e-3)))
    points = []
    for k in range(1, count + 1):
        t = k / count
        angle = begin + stroke.sense * t * sweep
        points.append((x + r * math.cos(angle), y + r * math.sin(angle), a[2] + t * (b[2] - a[2])))
    return [a] + points + [b]


def polyline(tape, pulse, sagitta):
    points = []
    for s in tape:
        points += line_points(s, pulse, sagitta)[1 if points else 0 :]
    return points


def free(p, q, r, reach):
    """The part of the line from q to r within the distance `reach` of p, as an interval of [0, 1], or none."""
    d, e = [b - a for a, b in zip(q, r)], [a - b for a, b in zip(q, p)]
    a, b, c = sum(u * u for u in d), sum(u * v for u, v in zip(d, e)), sum(u * u for u in e) - reach * reach
    if a == 0:
        return (0.0, 1.0) if c <= 0 else None
    root = b * b - a * c
    if root < 0:
        return None
    root = math.sqrt(root)
    low, high = max(0.0, (-b - root) / a), min(1.0, (-b + root) / a)
    return (low, high) if low <= high else None


def is_matched(one, two, reach):
    """Test that two points can go along both polylines, never back, and stay within the distance `reach`.

    This is the decision procedure of Alt and Godau for the Fréchet distance. `left` has, for each segment of
    `two`, the part that can be reached while the first point is at the beginning of the present segment of `one`.
    """
    if math.dist(one[0], two[0]) > reach or math.dist(one[-1], two[-1]) > reach:
        return False
    segments, left, is_low = len(two) - 1, {}, True
    for j in range(segments):
        interval = free(one[0], two[j], two[j + 1], reach)
        if interval is None or interval[0] > 0:
            break
        left[j] = interval
        if interval[1] < 1:
            break
    for a, b in zip(one, one[1:]):
        right, waiting = {}, sorted(left, reverse=True)
        bottom = free(two[0], a, b, reach) if is_low else None
        if bottom and bottom[0] > 0:
            bottom = None
        is_low = bottom is not None and bottom[1] >= 1
        j = 0 if bottom else waiting[-1] if waiting else segments
        while j < segments:
            while waiting and waiting[-1] <= j:
                waiting.pop()
            beside = left.get(j)
            if beside is None and bottom is None:
                j = waiting[-1] if waiting else segments
                continue
            interval = free(b, two[j], two[j + 1], reach)
            if interval and bottom is None:
                low = max(interval[0], beside[0])
                interval = (low, interval[1]) if low <= interval[1] else None
            if interval:
                right[j] = interval
            above = free(two[j + 1], a, b, reach)
            if above and beside is None:
                low = max(above[0], bottom[0])
                above = (low, above[1]) if low <= above[1] else None
            bottom = above
            j += 1
        if not right and not is_low:
            return False
        left = right
    return segments - 1 in left and left[segments - 1][1] >= 1


def is_near(tapes, pulse, allowance):
    """Test that the paths of two tapes are as near to each other as those of two right tapes."""
    # Heights of right tapes differ by two pulses at most.
    steep = allowance / pulse[2]
    return are_within(tapes, pulse, 2 * allowance, steep)


def are_within(tapes, pulse, reach, steep):
    """Test that the Fréchet distance of two paths is at most `reach`, where heights count `steep` times.

    The chords of either path may be off by a twentieth of it.
    """
    one, two = ([(x, y, steep * z) for x, y, z in polyline(t, pulse, reach / 20)] for t in tapes)
    return is_matched(one, two, 1.1 * reach)


def distance(tapes, pulse, allowance):
    """A length in mm that the Fréchet distance of two paths exceeds; the allowance if none is found."""
    reach = allowance
    while reach < 100 and not are_within(tapes, pulse, 2 * reach, 1):
        reach *= 2
    return reach


# Material -------------------------------------------------------------------------------------------------------


def levels(card, tapes):
    """The heights in pulses at which two tapes cut, lowest first, and the top of the part."""
    own, other = ({p[2] for s in tape for p in (s.start, s.end)} for tape in tapes)
    if card["kind"] != "mill":
        return [math.inf]
    if len(own) == 1:
        return sorted(h for h in own | other if h <= max(own))
    return sorted({0} | {h for h in own | other if h < 0})


def pairs_of_floors(heights, pulse):
    """Two floors in mm for each layer below some heights in pulses, lowest first.

    Heights on right tapes differ by two pulses at most. So if one tape cuts below the lower floor of a layer, and the
    other one not even below the upper floor, they differ by more.
    """
    layers = []
    for h in heights:
        if not layers or h > layers[-1] + 3:
            layers.append(h)
    return [((h + 0.5) * pulse, (h + 3) * pulse) for h in layers]


def below(points, floor):
    """The lines of a stroke, as far as they are not above `floor`."""
    for p, q in zip(points, points[1:]):
        if max(p[2], q[2]) <= floor:
            yield p, q
        elif min(p[2], q[2]) <= floor:
            t = (floor - p[2]) / (q[2] - p[2])
            m = tuple(a + t * (b - a) for a, b in zip(p, q))
            yield (p, m) if p[2] <= floor else (m, q)


def smeared(cells, count):
    """A row of cells, with the `count` cells on both sides of each."""
    width, done = 2 * count + 1, 1
    while done < width:
        step = min(done, width - done)
        cells |= cells << step
        done += step
    return cells >> count


class Raster:
    """A rectangle of the part as cells: rows of bits on both floors of each layer.

    `low` and `high` are its corners in mm. Of the cells nearer than `rim` to its edges, nothing is said.
    """

    def __init__(self, low, high, cell, floors, pulse, allowance):
        self.cell, self.pulse = cell, pulse
        self.floors = [f for pair in floors for f in pair]
        # The material that only one of two right tapes removes is nowhere further from what the other removes.
        self.reach = math.ceil(2 * allowance / cell - 1e-6) + 1
        # So it contains no square of this many cells, even where two edges of the material are near each other.
        self.square = math.floor(4 * allowance / cell + 1e-6) + 2
        rim = self.reach + 1
        self.origin = [v - rim * cell for v in low]
        self.width, self.height = (math.ceil((h - o) / cell) + rim for h, o in zip(high, self.origin))
        self.inner = ((1 << (self.width - 2 * rim)) - 1) << rim
        self.inner_rows = range(rim, self.height - rim)
        self.memory = {}

    def sweep(self, p, q, radius, rows):
        """Adds to `rows` the cells whose centres a disc covers on its way from p to q. Positions are in cells."""
        (px, py), (qx, qy) = p, q
        length = math.dist(p, q)
        nx, ny = (radius * (qy - py) / length, radius * (px - qx) / length) if length else (0, 0)
        edges = [(px + nx, py + ny, qx + nx, qy + ny), (px - nx, py - ny, qx - nx, qy - ny)]
        first_row = max(0, math.ceil(min(py, qy) - radius))
        for row in range(first_row, min(self.height, math.floor(max(py, qy) + radius) + 1)):
            low, high = math.inf, -math.inf
            for x, y in (p, q):
                square = radius * radius - (row - y) * (row - y)
                if square >= 0:
                    half = math.sqrt(square)
                    low, high = min(low, x - half), max(high, x + half)
            for ax, ay, bx, by in edges:
                if ay != by and min(ay, by) <= row <= max(ay, by):
                    x = ax + (bx - ax) * (row - ay) / (by - ay)
                    low, high = min(low, x), max(high, x)
            if low > high or high < 0 or low > self.width:
                continue
            first, last = max(0, math.ceil(low)), min(self.width - 1, math.floor(high))
            if first <= last:
                rows[row] = rows.get(row, 0) | ((1 << (last - first + 1)) - 1) << first

    def covering(self, stroke):
        """The cells that a stroke covers below each floor."""
        key = shape(stroke) + (stroke.radius,)
        if key not in self.memory:
            # A pointed tool has no width. It then counts as wide as the smallest thing that is seen.
            radius = max(stroke.radius / self.cell, self.reach + self.square)
            points = [
                ((x - self.origin[0]) / self.cell, (y - self.origin[1]) / self.cell, z)
                for x, y, z in line_points(stroke, self.pulse, self.cell / 10)
            ]
            floors, before, rows = {}, None, {}
            if self.is_reached(points, radius):
                for k, floor in enumerate(self.floors):
                    lines = list(below(points, floor))
                    if lines != before:
                        rows = {}
                        for p, q in lines:
                            self.sweep(p[:2], q[:2], radius, rows)
                    if rows:
                        floors[k] = rows
                    before = lines
            self.memory[key] = floors
        return self.memory[key]

    def is_reached(self, points, radius):
        low, high = ([most(p[k] for p in points) for k in (0, 1)] for most in (min, max))
        return all(h + radius >= 0 and l - radius <= w for l, h, w in zip(low, high, (self.width, self.height)))

    def machined(self, tape):
        """The cells that a tape removes below each floor, and for each row of each upper floor the cells that each
        stroke removes there: (number of the stroke, cells)."""
        gone, fresh = {}, collections.defaultdict(list)
        for n, s in enumerate(tape):
            for floor, rows in self.covering(s).items():
                for row, cells in rows.items():
                    old = gone.get((floor, row), 0)
                    new = cells & ~old
                    if new:
                        gone[floor, row] = old | cells
                        if floor % 2 == 1:
                            fresh[floor, row].append((n, new))
        return gone, fresh

    def far(self, one, two):
        """The position of a cell of `one`, below the lower floor of a layer, that is further from all cells of `two`
        below the upper floor than on right tapes."""
        spread = [math.floor(math.sqrt(self.reach**2 - d * d)) for d in range(self.reach + 1)]
        for (floor, row), cells in one.items():
            cells &= ~two.get((floor + 1, row), 0) & self.inner
            if floor % 2 or not cells or row not in self.inner_rows:
                continue
            for d in range(-self.reach, self.reach + 1):
                cells &= ~smeared(two.get((floor + 1, row + d), 0), spread[abs(d)])
            if cells:
                x = self.origin[0] + self.cell * (cells.bit_length() - 1)
                return f"({x:.2f}, {self.origin[1] + self.cell * row:.2f}, {self.floors[floor]:.2f})"
        return None

    def has_square(self, cells):
        """Test that cells, given by floor and row, contain a square that right tapes have not."""
        narrow = {}
        for key, row in cells.items():
            for _ in range(self.square - 1):
                row &= row >> 1
            if row:
                narrow[key] = row
        for floor, row in narrow:
            common = narrow[floor, row]
            for k in range(1, self.square):
                common &= narrow.get((floor, row + k), 0)
            if common:
                return True
        return False

    def difference(self, tapes):
        """The class of the first difference of two tapes in this rectangle, and what it is; or none."""
        (gone, fresh), (other_gone, other_fresh) = (self.machined(tape) for tape in tapes)
        for who, one, two in (("not removed", gone, other_gone), ("removed", other_gone, gone)):
            where = self.far(one, two)
            if where:
                return "material", f"{who} at {where}"
        for speed in sorted({s.speed for tape in tapes for s in tape}, key=str):
            one, two = (by_speed(tape, f, speed) for tape, f in zip(tapes, (fresh, other_fresh)))
            for a, b, removed in ((one, two, other_gone), (two, one, gone)):
                common = {key: cells & removed.get(key, 0) & ~b.get(key, 0) for key, cells in a.items()}
                if self.has_square(common):
                    return "order", f"removed at another speed than {speed}"
        if self.has_opposite_order(fresh, other_fresh):
            return "order", "removed in the opposite order"
        return None

    def has_opposite_order(self, one, two):
        """Test that the tapes remove some cells in the opposite order.

        The cells that stroke i of one tape and stroke j of the other remove are the pair (i, j). In the same order,
        j never falls when i rises. Only pairs that contain a square count.
        """
        pairs = collections.defaultdict(dict)
        for key in one.keys() & two.keys():
            if [cells for _, cells in one[key]] == [cells for _, cells in two[key]]:
                for (i, cells), (j, _) in zip(one[key], two[key]):
                    pairs[i, j][key] = cells
                continue
            for i, cells in one[key]:
                for j, others in two[key]:
                    if cells & others:
                        pairs[i, j][key] = cells & others
        suspects = out_of_order(sorted(pairs))
        return bool(out_of_order([ij for ij in suspects if self.has_square(pairs[ij])]))


def by_speed(tape, fresh, speed):
    """The cells that a tape removes at one speed."""
    return {key: sum(cells for n, cells in events if tape[n].speed == speed) for key, events in fresh.items()}


def out_of_order(pairs):
    """The pairs (i, j), in their order, that have a pair with a smaller i and a larger j, or the other way round."""
    found = set()
    for step, bound in ((1, -math.inf), (-1, math.inf)):
        for _, group in itertools.groupby(pairs[::step], key=lambda ij: ij[0]):
            group = list(group)
            found.update(ij for ij in group if step * (ij[1] - bound) < 0)
            bound = (max if step > 0 else min)([bound] + [j for _, j in group])
    return sorted(found)


# Verdicts -------------------------------------------------------------------------------------------------------


def shape(stroke):
    return (stroke.start, stroke.end, stroke.centre, stroke.sense)


def changed_strokes(tapes):
    """The strokes that only one of the tapes has."""
    counts = [collections.Counter(shape(s) for s in tape) for tape in tapes]
    changed = (counts[0] - counts[1]) + (counts[1] - counts[0])
    return [s for tape in tapes for s in tape if shape(s) in changed]


def box(points, margin):
    """The lower and the upper corner of a rectangle around points in the plane."""
    return [[pick(p[k] for p in points) + sign * margin for k in (0, 1)] for pick, sign in ((min, -1), (max, 1))]


def contacts(changed, pulse, side):
    """Some positions on the edge of the cutter beside changed strokes, no two of them in one square of this side.

    There are at most 40, so that a pair takes seconds.
    """
    found = {}
    for s in changed:
        points = line_points(s, pulse, 0.1)
        for p, q in list(zip(points, points[1:]))[:: max(1, len(points) // 4)]:
            length = math.dist(p[:2], q[:2])
            nx, ny = ((q[1] - p[1]) / length, (p[0] - q[0]) / length) if length else (1, 0)
            for edge in (s.radius, -s.radius):
                x, y = (p[0] + q[0]) / 2 + edge * nx, (p[1] + q[1]) / 2 + edge * ny
                found.setdefault((x // side, y // side), (x, y))
    return list(found.values())[:: max(1, len(found) // 20)]


def rasters(card, tapes, changed, allowance):
    """The whole part in coarse cells, then patches in fine cells, on the edge of the cutter in changed strokes."""
    pulse = card["pulse"]
    floors = pairs_of_floors(levels(card, tapes), pulse[2])
    radius = max(s.radius for tape in tapes for s in tape)
    low, high = box([p for tape in tapes for p in polyline(tape, pulse, 0.1)], radius + 1)
    # A small part has cells of 0.1 mm, a larger one 1500 of them on its longer side, but none above 0.25 mm.
    cell = min(0.25, max(0.1, max(high[0] - low[0], high[1] - low[1]) / 1500))
    yield Raster(low, high, cell, floors, pulse, allowance)
    # Two right tapes differ by at most eight of these cells, or less if the smallest cell is larger.
    cell = max(0.01, allowance / 4)
    for place in contacts(changed, pulse, 200 * cell):
        yield Raster(*box([place], 100 * cell), cell, floors, pulse, allowance)


def kind_of_path(card, tapes, changed):
    """The class of a pair whose tapes remove the same material on different paths."""
    top = max(levels(card, tapes))
    is_cut = not changed or any(min(s.start[2], s.end[2]) <= top for s in changed)
    return "cut path" if is_cut else "air path"


def verdict(card, tapes):
    """The class of a pair, and what was found; no class if the other tape is right as far as one can see."""
    if [shape(s) for s in tapes[0]] == [shape(s) for s in tapes[1]]:
        changed = [a.frame for a, b in zip(*tapes) if a.speed != b.speed]
        return ("feed", f"frames {changed[:5]}") if changed else (None, "the same path and speeds")
    pulse = card["pulse"]
    allowance = card["tolerance"] + max(pulse[:2])
    changed = changed_strokes(tapes)
    for raster in rasters(card, tapes, changed, allowance):
        found = raster.difference(tapes)
        if found:
            return found[0], f"{found[1]}, cells of {raster.cell:.2f} mm"
    if not is_near(tapes, pulse, allowance):
        apart = distance(tapes, pulse, allowance)
        return kind_of_path(card, tapes, changed), f"{apart:.3g} mm apart" if apart > allowance else "in height only"
    return None, f"within {2 * allowance:.3g} mm"


CLASSES = ["feed", "material", "order", "cut path", "air path", "NOT CONFIRMED"]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    table = collections.defaultdict(collections.Counter)
    for path in sorted(glob.glob(os.path.join(sys.argv[1], "*.json"))):
        name = path[: -len(".json")]
        with open(path, encoding="utf-8") as stream:
            card = json.load(stream)
        tapes = []
        for which in ("own", "other"):
            with open(f"{name}.{which}.tape", "rb") as stream:
                tapes.append(strokes(card, stream.read(), card["cutters"][which]))
        found, detail = verdict(card, tapes)
        found = found or "NOT CONFIRMED"
        table[card["damage"]][found] += 1
        print(f"{os.path.basename(name)}  {found:13}  {card['damage']}, {card['machine']}: {detail}", flush=True)
    width = max(map(len, table), default=0)
    print("\n" + " ".join(["damage".ljust(width)] + [c.rjust(13) for c in CLASSES]))
    total = sum(table.values(), collections.Counter())
    for damage, counts in sorted(table.items()) + [("all", total)]:
        print(" ".join([damage.ljust(width)] + [str(counts[c]).rjust(13) for c in CLASSES]))
    sys.exit(1 if total["NOT CONFIRMED"] else 0)


if __name__ == "__main__":
    main()
