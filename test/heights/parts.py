"""Random parts for `collisions.py`, each with a description of its setup for `heights.py`, and
altered files of G-code.

A part has a stock or none, up to three clamps, one or two tools with bodies, and up to three
operations. Most parts are compiled; those that partc refuses for the path are to be left out by the
caller.
"""

import json
import math
import re

TOLERANCE = 0.01
# The resolution of iso6983.
PULSE = 0.001
# Half of the angle of a drill's point.
POINT = math.radians(59)
START = (0, 0, 30)
FEED = 300


def point(p):
    """A point in a program."""
    return "(" + ", ".join(f"{c:g}" for c in p) + ")"


def rounded(rng, least, most, step=0.5):
    """A random number in steps."""
    return round(rng.uniform(least, most) / step) * step


def rectangle(a, b):
    """A rectangle: its text in a program, and its shape."""
    corners = [[a[0], a[1]], [b[0], a[1]], [b[0], b[1]], [a[0], b[1]]]
    return f"rectangle({point(a)}, {point(b)})", {"points": corners, "grow": 0}


def circle(centre, radius):
    """A circle."""
    return f"circle({point(centre)}, {radius:g})", {"points": [list(centre)], "grow": radius}


def rounded_rectangle(a, b, radius):
    """A rectangle with round corners."""
    _, shape = rectangle([c + radius for c in a], [c - radius for c in b])
    shape["grow"] = radius
    return f"rounded({point(a)}, {point(b)}, {radius:g})", shape


def slot(a, b, width):
    """A slot."""
    return f"slot({point(a)}, {point(b)}, {width:g})", {"points": [list(a), list(b)], "grow": width / 2}


def polygon(corners):
    """A polygon."""
    text = ", ".join(point(p) for p in corners)
    return f"polygon([{text}])", {"points": [list(p) for p in corners], "grow": 0}


class Tool:
    """A random tool: its text in a program, and its description."""

    def __init__(self, rng, kind, depth):
        self.radius = rng.choice([2, 2.5, 3, 4, 5] if kind == "mill" else [1.5, 2, 2.5, 3, 4])
        sizes, flutes, holder = [f"diameter {2 * self.radius:g}"], None, []
        if rng.random() < 0.7:
            flutes = rounded(rng, depth * 0.4 + 2, depth * 1.2 + 3)
            sizes.append(f"flutes {flutes:g}")
        if rng.random() < 0.75:
            above = rounded(rng, depth * 0.5 + 2, depth * 1.5 + 6)
            above = max(above, flutes or 0)
            sizes.append(f"stickout {above:g}")
            for k in range(rng.randint(0, 2)):
                # The last cylinder may have no height.
                wide, high = rng.choice([8, 12, 20, 32, 50]), rng.choice([5, 12, 25])
                sizes.append(f"holder {wide} height {high}")
                holder.append([wide / 2, above])
                above += high
            if holder and rng.random() < 0.7:
                sizes[-1] = sizes[-1].partition(" height")[0]
        slope = 1 / math.tan(POINT) if kind == "drill" else 0
        self.text = f"{kind}({', '.join(sizes)})"
        self.setup = {"radius": self.radius, "slope": slope, "flutes": flutes, "holder": holder}


class Part:
    """A random part: `text`, the program, and `setup`, the description for `heights.py`."""

    def __init__(self, rng, name):
        self.rng = rng
        self.width, self.height = rng.randint(35, 80), rng.randint(30, 60)
        self.depth = rounded(rng, 4, 14)
        self.lines, self.metal, self.avoided, self.tools = [], [], [], {}
        self.is_milled = False
        kinds = self._kinds()
        first = Tool(rng, kinds[0][0], self.depth)
        self.clearance = rounded(rng, 2, 6)
        self.lines += [
            f"part {name}",
            "machine iso6983",
            f"tool 1 {first.text}",
            f"feed {FEED} mm/min",
            f"tolerance {TOLERANCE:g}",
            f"clearance {self.clearance:g}",
            f"from {point(START)}",
        ]
        self.tools["1"] = first.setup
        self.stock = self._stock() if rng.random() < 0.8 else None
        for _ in range(rng.choice([0, 1, 1, 2, 3])):
            self._clamp()
        self.lines.append("spindle cw 8000 rpm")
        tool, tool_kind = first, kinds[0][0]
        for kind, operation in kinds:
            if kind != tool_kind or rng.random() < 0.15:
                tool, tool_kind = self._change(kind), kind
            tool = operation(tool) or tool
            if rng.random() < 0.15:
                self._travel()
        if rng.random() < 0.6:
            self.lines.append(f"rapid {point(START)}")
        self.text = "\n".join(self.lines) + "\n"
        self.setup = {
            # Without milling, partc has no tolerance.
            "tolerance": TOLERANCE if self.is_milled else 0,
            "pulse": PULSE,
            "start": START,
            "first": 1,
            "tools": self.tools,
            "stock": self.stock,
            "metal": self.metal,
            "avoided": self.avoided,
        }

    def _kinds(self):
        """The operations, each with the kind of its tool. Those with one tool follow one another."""
        all_kinds = [
            ("mill", self._pocket), ("mill", self._outside), ("mill", self._groove),
            ("drill", self._holes), ("mill", self._holes),
        ]
        chosen = [self.rng.choice(all_kinds) for _ in range(self.rng.choice([1, 2, 2, 3]))]
        return sorted(chosen, key=lambda pair: pair[0], reverse=self.rng.random() < 0.7)

    def _change(self, kind):
        tool, number = Tool(self.rng, kind, self.depth), len(self.tools) + 1
        at = f" at {point(START)}" if self.rng.random() < 0.3 else ""
        self.tools[str(number)] = tool.setup
        self.lines += [f"change {number} {tool.text}{at}", "spindle cw 5000 rpm"]
        return tool

    def _place(self, margin):
        """A random place in the part."""
        rng = self.rng
        return (
            rounded(rng, margin, self.width - margin), rounded(rng, margin, self.height - margin)
        )

    def _stock(self):
        rng, rim = self.rng, self.rng.choice([0, 2, 5, 9])
        right, high = self.width + rim, self.height + rim
        text, shape = rectangle((-rim, -rim), (right, high))
        if rng.random() < 0.4:
            cut = [rng.randint(3, 20) for _ in range(2)]
            text, shape = polygon([
                (-rim, -rim), (right, -rim), (right, high - cut[0]), (right - cut[1], high), (-rim, high)
            ])
        holes = []
        if rng.random() < 0.3:
            hole, hole_shape = circle(self._place(6), rng.randint(2, 9))
            text, holes = f"difference({text}, {hole})", [hole_shape]
        # The operations end above the lower end of the stock, at it or below it.
        bottom, top = -self.depth - rng.choice([-1, 0, 0, 2, 6]), rng.choice([0, 0, 0, 1, 1.5])
        self.lines.append(f"stock {text} from {bottom:g} to {top:g}")
        return {"shapes": [shape], "holes": holes, "bottom": bottom, "top": top}

    def _clamp(self):
        rng = self.rng
        x, y = rng.choice([
            (rng.choice([-8, self.width + 8]), rng.randint(0, self.height)),
            (rng.randint(0, self.width), rng.choice([-8, self.height + 8])),
            self._place(0),
        ])
        wide, high = rng.randint(6, 20), rng.randint(6, 20)
        text, shape = rng.choice([
            rectangle((x - wide / 2, y - high / 2), (x + wide / 2, y + high / 2)),
            circle((x, y), wide / 2),
            polygon([(x - wide / 2, y), (x + wide / 2, y - high / 3), (x + 2, y + high / 2)]),
        ])
        top = rounded(rng, -2, 20)
        self.lines.append(f"avoid {text} from {min(-self.depth, top - 1):g} to {top:g}")
        self.avoided.append({"shapes": [shape], "top": top, "line": len(self.lines)})

    def _depth(self):
        """Depth of an operation, often in steps."""
        rng = self.rng
        depth = self.depth if rng.random() < 0.4 else rounded(rng, 1, self.depth)
        step = f" step {max(1, depth / rng.choice([1, 2, 3])):.3g}" if rng.random() < 0.7 else ""
        return depth, f"depth {depth:g}{step} plunge {rng.choice([60, 100])}"

    def _pocket(self, tool):
        rng, least = self.rng, 2 * tool.radius + 1
        a = self._place(3)
        b = (a[0] + rounded(rng, least, 30), a[1] + rounded(rng, least, 25))
        text, shape = rng.choice([
            rectangle(a, b),
            rounded_rectangle(a, b, tool.radius + 0.25),
            slot(a, (a[0] + rng.randint(4, 25), a[1] + rng.choice([0, 0, 10])), least + rng.randint(0, 6)),
        ])
        depth, words = self._depth()
        self.metal.append(shape)
        self.is_milled = True
        step = tool.radius * rng.choice([0.8, 1, 1.4])
        self.lines.append(f"pocket {text} step {step:g} {{ {words} rest allowed }}")

    def _outside(self, tool):
        rng = self.rng
        a = rng.choice([(0, 0), (0, 0), self._place(8)])
        b = (self.width, self.height)
        if a != (0, 0):
            b = (a[0] + rng.randint(8, 25), a[1] + rng.randint(8, 25))
        text, _ = rng.choice([rectangle(a, b), rounded_rectangle(a, b, rng.choice([3, 6]))])
        depth, words = self._depth()
        if rng.random() < 0.4:
            words += f" allowance {tool.radius * 1.5:g}, 0"
        middle = (a[1] + b[1]) / 2

        def from_outside(radius):
            away = point((a[0] - radius - 8, middle))
            return f" start near {point((a[0], middle))} approach {away} rapid retract {away} rapid"

        if rng.random() < 0.7:
            words += from_outside(tool.radius)
            if rng.random() < 0.6:
                words += f" lead in arc {rng.choice([2, 4])} lead out arc {rng.choice([2, 4])}"
        self.is_milled = True
        self.lines.append(f"mill {text} outside {{ {words} }}")
        if rng.random() < 0.7:
            return None
        # Another tool comes where stock is gone already.
        tool = self._change("mill")
        self.lines.append(f"mill {text} outside {{ depth {depth:g}{from_outside(tool.radius)} }}")
        return tool

    def _groove(self, _):
        _, words = self._depth()
        a, b = self._place(2), self._place(-3)
        name = f"groove{len(self.lines)}"
        self.is_milled = True
        self.lines += [f"contour {name} open {{ {point(a)} {point(b)} }}", f"mill {name} on {{ {words} }}"]

    def _holes(self, tool):
        rng = self.rng
        holes = [self._place(4) for _ in range(rng.randint(1, 5))]
        depth = self.depth if rng.random() < 0.5 else rounded(rng, 2, self.depth + 2)
        peck = f" {{ peck {rng.choice([2, 3, 4, 5])} }}" if rng.random() < 0.6 else ""
        self.metal += [circle(p, tool.radius)[1] for p in holes]
        text = ", ".join(point(p) for p in holes)
        self.lines.append(f"drill at [{text}] depth {depth:g}{peck}")

    def _travel(self):
        rng = self.rng
        # A move without a feed is one of the program, and stays as it is.
        high = rounded(rng, 1, 10)
        if rng.random() < 0.5:
            self.lines.append(f"rapid {point(self._place(-5) + (high,))}")
        else:
            low = rounded(rng, -self.depth, 2)
            self.lines += [
                f"rapid {point(self._place(-5) + (high,))}",
                f"move {point(self._place(-5) + (low,))} feed 200",
                f"rapid {point(self._place(-5) + (30,))}",
            ]

    def described(self):
        """The description of the setup as JSON."""
        return json.dumps(self.setup, indent=1)


class Block:
    """A line of a file: its motion code or None, its words along the axes and to the centre, its
    feed, and its commands."""

    def __init__(self, line, feed):
        words = re.findall(r"([A-Z])(-?[0-9.]+)", line)
        codes = [int(value) for letter, value in words if letter == "G"]
        self.code = codes[0] if len(codes) == 1 and codes[0] < 4 else None
        self.words = {letter: float(value) for letter, value in words if letter in "XYZIJ"}
        feeds = [int(value) for letter, value in words if letter == "F"]
        self.feed = feeds[0] if feeds else feed
        self.commands = " ".join(letter + value for letter, value in words if letter in "STM")
        self.text = line


def blocks_of(text):
    """The lines of a file. Each cut has its feed."""
    blocks, feed = [], None
    for line in text.splitlines():
        blocks.append(Block(line, feed))
        feed = blocks[-1].feed
    return blocks


def written(blocks):
    """The text of a file as iso6983 writes it: no word repeats what is in force, and the first
    motion has all its axes."""
    place, feed, lines = {}, None, []
    for block in blocks:
        if block.code is None:
            lines.append(block.text)
            continue
        words = []
        for k, axis in enumerate("XYZ"):
            value = block.words.get(axis, place.get(axis, START[k]))
            if place.get(axis) != value:
                words.append(f"{axis}{value:.3f}")
            place[axis] = value
        if words:
            words = [f"G{block.code}"] + words
            words += [f"{letter}{block.words[letter]:.3f}" for letter in "IJ" if letter in block.words]
            if block.code > 0 and feed != (block.feed or FEED):
                feed = block.feed or FEED
                words.append(f"F{feed}")
        if block.commands:
            words.append(block.commands)
        if words:
            lines.append(" ".join(words))
    return "\n".join(lines) + "\n"


def lengthened(blocks):
    """Adds rapid moves upwards at the end of a file, so that it differs from that of the program in
    many lines. Then partc reports all its findings, not only the first one of a single change."""
    last = max(k for k, block in enumerate(blocks) if block.code is not None)
    blocks[last + 1 : last + 1] = [Block(f"G0 Z{z}.000", None) for z in range(200, 206)]


def altered(rng, text, is_long, share=1):
    """A file with one alteration: what was altered, and the text. With `is_long` it is lengthened. A
    place is shifted by `share` of a random distance only. Lines with commands keep their order,
    because partc finds the tool by it."""
    while True:
        blocks = blocks_of(text)
        moves = [k for k, block in enumerate(blocks) if block.code is not None]
        what = rng.choice(ALTERATIONS)(rng, blocks, moves, share=share)
        if what:
            if is_long:
                lengthened(blocks)
            return what, written(blocks)


def shifted(rng, blocks, moves, axes, by):
    """A straight move to another place."""
    words = [(k, axis) for k in moves for axis in axes if blocks[k].code < 2 and axis in blocks[k].words]
    if not words:
        return None
    k, axis = rng.choice(words)
    blocks[k].words[axis] += by
    return f"{axis} by {by:.3f} in: {blocks[k].text}"


def another_pace(rng, blocks, moves, before, after):
    """A rapid move at a feed, or a straight cut in rapid."""
    chosen = [k for k in moves if blocks[k].code == before]
    if not chosen:
        return None
    k = rng.choice(chosen)
    blocks[k].code = after
    return f"G{after} in: {blocks[k].text}"


def exchanged(rng, blocks, moves):
    """Two moves in the other order."""
    plain = [k for k in moves if not blocks[k].commands]
    if len(plain) < 2:
        return None
    first = rng.randrange(len(plain) - 1)
    a, b = plain[first], plain[min(len(plain) - 1, first + rng.choice([1, 1, 2, 5]))]
    blocks[a], blocks[b] = blocks[b], blocks[a]
    return f"exchanged: {blocks[b].text} with: {blocks[a].text}"


def dropped(rng, blocks, moves, is_retract):
    """A move that is missing."""
    chosen = [
        k for k in moves
        if not blocks[k].commands
        and (not is_retract or blocks[k].code == 0 and set(blocks[k].words) == {"Z"})
    ]
    if not chosen:
        return None
    k = rng.choice(chosen)
    what = f"dropped: {blocks[k].text}"
    del blocks[k]
    return what


ALTERATIONS = 2 * [
    lambda rng, *of, share: shifted(rng, *of, "Z", -share * rounded(rng, 0.5, 16)),
    lambda rng, *of, share: shifted(rng, *of, "XY", rng.choice([-share, share]) * rounded(rng, 0.5, 25)),
] + [
    lambda rng, *of, share: shifted(rng, *of, "Z", share * rng.choice([-0.1, 0.3, -0.6, 2, 5])),
    lambda rng, *of, share: shifted(rng, *of, "XY", share * rng.choice([-0.3, -0.02, 0.02, 0.1, 0.5])),
    lambda rng, *of, share: another_pace(rng, *of, 1, 0),
    lambda rng, *of, share: another_pace(rng, *of, 0, 1),
    lambda rng, *of, share: exchanged(rng, *of),
    lambda rng, *of, share: dropped(rng, *of, True),
    lambda rng, *of, share: dropped(rng, *of, False),
]
