#!/usr/bin/env python3
"""Runs the files of random parts with all operations, and compares what is left with what has to
be.

    removal.py PARTC [--parts N] [--altered N] [--seed S] [--cell MM] [--machine NAME] [--milling]
                     [--keep FOLDER]

For each random part (`works.py`) partc compiles a program. Its files are run on a cloud of points
(`operations.py`), with helices and cycles. There is a fault where

- material is cut that has to stand,
- material stands that has to be cut,
- tabs are missing, or are not as wide or as high as they have to be, or lie elsewhere,
- a rapid move goes through material,
- or partc does not prove its own file.

Then a file is altered: a height, the depth of a helix, a line of a ramp, a peck. An altered file
that cuts what has to stand, or leaves what has to be cut, has to be refused by `partc verify`.

With `--milling` there are no works on holes but `drill`. The status is 1 if there is a fault.
"""

import argparse
import collections
import math
import os
import random
import re
import sys
import tempfile

import numpy
from shapely.geometry import LineString, Point
from shapely.ops import substring, unary_union

import collisions
import heights
import operations
import shapes
import works

MACHINES = ("linuxcnc-mill", "grbl", "iso6983", "haas", "fanuc", "marlin")
# Distance between points beside the edges that matter, and along a path with tabs.
EDGE_STEP, TAB_STEP = 0.3, 0.05
# What partc permits on a floor, and a distance from a wall that does not belong to the floor alone.
FLOOR, WALL = 0.03, 0.1
# Most points for which cusps are looked for: more of them are no cusps.
MOST_CUSPS = 100
# Parts of the height of a tab at which its sides are compared.
LEVELS = (0, 0.15, 0.5, 0.85, 1)
BAD_ROWS = (
    "parts that were not compiled", "own files that are not proven", "files that cannot be run",
    "cut that should stand", "stands that should be cut", "tabs that are wrong",
    "rapid moves through material", "wrong altered files that are accepted",
)
ROWS = (
    "parts", "refused programs", "altered files", "altered files refused", "altered files accepted",
    "altered files that are wrong",
)
ATTEMPTS = 40


def edges_of(area):
    """Points along the edges of an area."""
    found = []
    for part in getattr(area, "geoms", [area]):
        if part.is_empty or part.geom_type != "Polygon":
            continue
        for ring in [part.exterior, *part.interiors]:
            count = max(8, math.ceil(ring.length / EDGE_STEP))
            line = LineString(ring.coords)
            found += [line.interpolate(k / count, True).coords[0] for k in range(count)]
    return found


def half_of(path, place, wide):
    """Half of the stretch about a place of a closed path whose ends are so far from each other."""
    if wide == 0:
        return 0.0
    least, most = wide / 2, min(wide, path.length / 2)

    def end(s):
        return path.interpolate(s % path.length)

    for _ in range(40):
        half = (least + most) / 2
        is_short = end(place - half).distance(end(place + half)) < wide
        least, most = (half, most) if is_short else (least, half)
    return least


def without(path, places, wide, more):
    """The pieces of a closed path outside of the stretches about places on it that are `wide`,
    measured straight, and the length `more` at both ends."""
    length = path.length
    places = sorted(places)
    halves = [half_of(path, place, wide) + more for place in places]
    found = []
    for k, (a, b) in enumerate(zip(places, places[1:] + [places[0] + length])):
        first, last = a + halves[k], b - halves[(k + 1) % len(places)]
        if last <= first:
            continue
        first, last = first % length, first % length + last - first
        found.append(substring(path, first, min(last, length)))
        if last > length:
            found.append(substring(path, 0, last - length))
    return unary_union(found)


def covered(line, radius):
    """What a disc covers along a line."""
    return line.buffer(radius, shapes.SEGMENTS)


class Judged:
    """The run of a part's files, compared with the part's claims: `faults`, each with its row in
    the table and a text, and `hits`, those of rapid moves."""

    def __init__(self, part, motions, cell, cloud=None):
        self.part, self.faults = part, []
        self.cloud = cloud or cloud_of(part, cell)
        cloud = self.cloud
        self.floor = numpy.full(cloud.x.shape, float(part.top))
        if part.blank:
            self.floor[:] = -numpy.inf
            self.floor[cloud.inside(part.blank)] = part.top
        self.least = numpy.full(cloud.x.shape, numpy.inf)
        self.run = operations.Run(cloud, motions, part.tools, self.floor, works.MARGIN)
        self.whose = numpy.full(cloud.x.shape, -1)
        for k, claim in enumerate(part.claims):
            self.index = k
            getattr(self, "_" + claim.kind)(claim)
        # Where there is no stock, nothing has to stand.
        here = numpy.isfinite(self.run.left)
        left = numpy.where(here, self.run.left, 0)
        self._compare("cut that should stand", numpy.where(here, self.floor, -numpy.inf) - left)
        stands = numpy.where(here, left - self.least, -numpy.inf)
        self._compare("stands that should be cut", self._without_cusps(stands, motions))
        self.hits = [
            f"line {line} at ({x:.3f}, {y:.3f}), {deep:.3f} deep"
            for line, (x, y), deep in self.run.hits
        ]

    def _without_cusps(self, stands, motions):
        """What stands on floors, without what a cutter that is a little larger would cut. Between
        two passes of a pocket, a floor may have a cusp that is narrower than `FLOOR`."""
        for k in numpy.flatnonzero(stands > works.HAIR)[:MOST_CUSPS]:
            claim, x, y = self.part.claims[self.whose[k]], self.cloud.x[k], self.cloud.y[k]
            if claim.kind != "must" or claim.area.boundary.distance(Point(x, y)) < WALL:
                return stands
            x, y = numpy.array([x]), numpy.array([y])
            left = min(
                operations.lowest(m, x, y, self.part.tools[m.tool]["radius"] + FLOOR, 0.0)[0]
                for m in motions if self.part.tools[m.tool]["slope"] == 0
            )
            stands[k] = min(stands[k], left - self.least[k])
        return stands

    def _may_to(self, area, z):
        at = self.cloud.inside(shapes.grown(area, works.MARGIN))
        self.floor[at] = numpy.minimum(self.floor[at], z)

    def _must_to(self, area, z):
        at = self.cloud.inside(shapes.grown(area, -works.MARGIN))
        self.whose[at[self.least[at] > z]] = self.index
        self.least[at] = numpy.minimum(self.least[at], z)

    def _may(self, claim):
        self._may_to(claim.area, claim.z)

    def _must(self, claim):
        self._must_to(claim.area, claim.z)

    def _hole(self, claim):
        (x, y), radius, cloud = claim.area, claim.others["radius"], self.cloud
        reach = radius + 1
        at = cloud.within(x - reach, y - reach, x + reach, y + reach)
        away = numpy.hypot(cloud.x[at] - x, cloud.y[at] - y)
        may, must = away <= radius + works.MARGIN, away < radius - works.MARGIN
        z = claim.z + claim.slope * numpy.maximum(0, away - works.MARGIN)
        self.floor[at[may]] = numpy.minimum(self.floor[at], z)[may]
        z = claim.z + claim.slope * (away + works.MARGIN)
        self.whose[at[must]] = self.index
        self.least[at[must]] = numpy.minimum(self.least[at], z)[must]

    def _tabs(self, claim):
        """Compares tabs, at places that are known or found."""
        path, r, places = claim.others["path"], claim.others["r"], claim.others["places"]
        height = claim.others["height"]
        slack = works.MARGIN
        if places is None:
            places, slack = self._found(claim), 2 * TAB_STEP + 0.03
            if len(places) != claim.others["count"]:
                text = f"{claim.what}: {len(places)} tabs, not {claim.others['count']}"
                self.faults.append(("tabs that are wrong", text))
                self._may_to(claim.area, claim.z)
                return
            self._shares(claim, places)
        top = claim.z + height
        self._may_to(claim.area, top)
        self._must_to(claim.area, top)
        bases = [
            without(
                path, places, claim.others["width"] + 2 * r,
                (1 - share) * height / math.tan(math.radians(claim.others["angle"])),
            )
            for share in LEVELS
        ]
        for share, base in zip(LEVELS, bases):
            self._must_to(covered(base, r - slack), claim.z + share * height)
        for share, base in zip(LEVELS, bases[1:]):
            low = covered(base, r + slack).intersection(claim.area)
            self._may_to(low, claim.z + share * height)

    def _found(self, claim):
        """The middles of the stretches of a path on which material stands above the floor."""
        path = claim.others["path"]
        count = math.ceil(path.length / TAB_STEP)
        first = claim.others["first"]
        stands = self.run.left[first : first + count] > claim.z + 0.3 * claim.others["height"]
        if stands.all() or not stands.any():
            return []
        shift = int(numpy.argmin(stands))
        turned = numpy.roll(stands, -shift).astype(int)
        ups = numpy.flatnonzero(numpy.diff(turned) == 1) + 1
        downs = numpy.flatnonzero(numpy.diff(numpy.append(turned, 0)) == -1)
        step = path.length / count
        return [((a + b) / 2 + shift) * step % path.length for a, b in zip(ups, downs)]

    def _shares(self, claim, places):
        """Each tab lies in its own share of the path."""
        path, count = claim.others["path"], claim.others["count"]
        start = path.project(Point(claim.others["start"]))
        shares = sorted(int((s - start) % path.length / path.length * count) for s in places)
        if shares != list(range(count)):
            at = ", ".join(f"{(s - start) % path.length / path.length:.3f}" for s in sorted(places))
            self.faults.append(("tabs that are wrong", f"{claim.what}: tabs at the shares {at}"))

    def _compare(self, row, wrong):
        """Adds a fault for the deepest wrong point, if there is one."""
        at = int(numpy.argmax(wrong))
        if wrong[at] <= works.HAIR:
            return
        count = int((wrong > works.HAIR).sum())
        what = self.part.claims[self.whose[at]].what if self.whose[at] >= 0 else ""
        x, y = self.cloud.x[at], self.cloud.y[at]
        text = f"by {wrong[at]:.3f} at ({x:.3f}, {y:.3f}), {count} points {what}"
        self.faults.append((row, text))


def cloud_of(part, cell):
    """The points at which a part is compared."""
    found, near = [], works.MARGIN + 0.004
    for claim in part.claims:
        area, signs = claim.area, {"may": (1,), "must": (-1,)}.get(claim.kind, (1, -1))
        if claim.kind == "hole":
            area = shapes.grown(Point(area), claim.others["radius"])
            found.append(claim.area)
        for sign in signs:
            found += edges_of(shapes.grown(area, sign * near))
    for claim in part.claims:
        if claim.kind == "tabs":
            path = claim.others["path"]
            count = math.ceil(path.length / TAB_STEP)
            claim.others["from"] = len(found)
            found += [path.interpolate(k / count, True).coords[0] for k in range(count)]
    left, low = -8 - cell / 3, -8 - cell / 7
    right, high = (c + 8 for c in part.size)
    cloud = operations.Cloud((left, low, right, high), cell, numpy.array(found))
    for claim in part.claims:
        if claim.kind == "tabs":
            claim.others["first"] = cloud.count + claim.others["from"]
    return cloud


def motions_of(part, texts):
    """The motions of a part's files."""
    order = part.order[:1]
    if len(texts) > 1:
        # Each file names its tool. One in which nothing is cut has no file.
        order = [int(re.search(r"tool (\d+):", text).group(1)) for text in texts]
    start = (-20, -20, part.clearance)
    return operations.motions_of(list(zip(texts, order)), start)


def altered(rng, texts):
    """The files with one alteration, and what was altered."""
    texts = list(texts)
    k = rng.randrange(len(texts))
    lines = texts[k].splitlines()
    moves = [
        n for n, line in enumerate(lines)
        if re.match(r"(N\d+ )?(G(0|1|2|3|33\.1|73|8[1-5]) )?[XYZ]", line)
        or re.match(r"(N\d+ )?G(0|1|2|3|33\.1|73|8[1-5])\b.*[XYZ]", line)
        or re.match(r"(N\d+ )?G9[89] G", line)
    ]
    deep = [n for n in moves if re.search(r"Z-", lines[n])]
    what = rng.choice(
        3 * ["Z"] + 2 * ["drop", "drop deep", "ramp", "rest of Z"] + ["XY", "IJ", "swap", "cycle"]
    )
    n = rng.choice(moves)
    if what in ("Z", "drop deep", "rest of Z") and deep:
        n = rng.choice(deep)
    line = lines[n]
    if what == "ramp":
        slopes = [k for k in moves if "Z" in lines[k] and re.search("[XY]", lines[k])]
        if not slopes:
            return altered(rng, texts)
        n = last = rng.choice(slopes)
        line = lines[n]
        while last + 1 in slopes:
            last += 1
        del lines[n : last + 1]
    elif what.startswith("drop"):
        del lines[n]
    elif what == "swap":
        m = min(len(lines) - 1, n + 1)
        lines[n], lines[m] = lines[m], lines[n]
    else:
        letters = {"Z": "Z", "rest of Z": "Z", "XY": "XY", "IJ": "IJ", "cycle": "RQ"}[what]
        by = rng.choice([-1, 1]) * rng.choice([0.03, 0.1, 0.3, 0.7, 1.5])
        found = [m for m in re.finditer(r"([A-Z])(-?[0-9.]+)", line) if m.group(1) in letters]
        if not found:
            return altered(rng, texts)
        if what == "rest of Z":
            # The same height in all lines, as that of the tabs or of a pass.
            height = rng.choice(found).group(2)
            new = f"{float(height) + by:.3f}"
            lines = [re.sub(rf"Z{re.escape(height)}(?![0-9])", f"Z{new}", each) for each in lines]
        else:
            m = rng.choice(found)
            new = f"{m.group(1)}{float(m.group(2)) + by:.3f}"
            lines[n] = line[: m.start()] + new + line[m.end() :]
            if what == "IJ" and rng.random() < 0.5:
                return altered(rng, texts)
    texts[k] = "\n".join(lines) + "\n"
    return f"{what} at line {n + 1} of file {k + 1}: {line}", texts


class Trial:
    """The trial of one part."""

    def __init__(self, given, folder, seed, machine):
        self.given, self.folder, self.seed = given, folder, seed
        self.counts, self.faults = collections.Counter(), []
        self.name = f"q{seed}"
        rng = random.Random(seed)
        self.program = os.path.join(folder, self.name + ".part")
        texts = self._compiled(rng, machine)
        if texts is None:
            return
        self.counts["parts"] += 1
        for claim in self.part.claims:
            self.counts["claims: " + claim.what.split(" with")[0].split(",")[0]] += 1
        cycles = r"^(?:N\d+ )?(?:G9[89] )?(G(?:73|8[1-5]|33\.1))\b"
        for code in re.findall(cycles, "\n".join(texts), re.M):
            self.counts["cycles: " + code] += 1
        judged = self._judged(texts)
        if judged is None:
            return
        self.cloud = judged.cloud
        for row, text in judged.faults:
            self._fault(row, text, texts)
        for hit in judged.hits[:1]:
            self._fault("rapid moves through material", hit, texts)
        for n in range(given.altered):
            self._alter(random.Random(f"{seed} {n}"), texts, n)

    def _compiled(self, rng, machine):
        """The files of a random part."""
        for _ in range(ATTEMPTS):
            self.part = works.Part(rng, self.name, machine, not self.given.milling)
            if not self.part.order:
                continue
            with open(self.program, "w", encoding="utf-8") as file:
                file.write(self.part.text)
            out = tempfile.mkdtemp(dir=self.folder)
            status, errors = collisions.run(
                self.given.partc, "compile", self.program, "-o", out + "/", "--no-verify"
            )
            if status != 0:
                self.counts["refused programs"] += 1
                for error in errors[:1]:
                    self.counts["refused: " + error["code"]] += 1
                    if self.given.refused:
                        print(f"refused {self.name}: {error['code']} {error['title']}"
                              f" {error['message'][:3]}", flush=True)
                        self._write(f"refused-{error['code']}", [])
                continue
            texts = []
            for name in os.listdir(out):
                with open(os.path.join(out, name), encoding="utf-8") as file:
                    texts.append((name, file.read()))
            texts.sort(key=lambda t: int((re.search(r"file: (\d+) of", t[1]) or [0, 0])[1]))
            self.files = [os.path.join(out, name) for name, _ in texts]
            texts = [text for _, text in texts]
            status, errors = collisions.run(self.given.partc, "verify", self.program, *self.files)
            if status != 0:
                text = "; ".join(f"{e['code']} {e['title']} {e['message'][:2]}" for e in errors[:3])
                self._fault("own files that are not proven", text, texts)
            return texts
        self.counts["parts that were not compiled"] += 1
        return None

    def _judged(self, texts, cloud=None):
        try:
            motions = motions_of(self.part, texts)
        except heights.NotRun as reason:
            if cloud is None:
                self._fault("files that cannot be run", str(reason), texts)
            return None
        return Judged(self.part, motions, self.given.cell, cloud)

    def _alter(self, rng, texts, n):
        what, made = altered(rng, texts)
        if made == texts:
            return
        for path, text in zip(self.files, made):
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        status, _ = collisions.run(self.given.partc, "verify", self.program, *self.files)
        self.counts["altered files"] += 1
        self.counts["altered files refused" if status else "altered files accepted"] += 1
        if status and n % 4:
            return
        # Those refused are run only now and then, to know that some of them are wrong.
        judged = self._judged(made, self.cloud)
        if judged and judged.faults:
            self.counts["altered files that are wrong"] += 1
            if not status:
                text = f"{what}: {judged.faults[0]}"
                self._fault("wrong altered files that are accepted", text, made)

    def _fault(self, row, text, texts):
        self.counts[row] += 1
        self.faults.append(f"{self.name} {self.part.machine}: {row}: {text}")
        self._write(f"{len(self.faults)}", texts)

    def _write(self, end, texts):
        if self.given.keep:
            base = os.path.join(self.given.keep, f"{self.name}-{end}")
            contents = [(".part", self.part.text)] + [(f".{k}.nc", t) for k, t in enumerate(texts)]
            for ending, content in contents:
                with open(base + ending, "w", encoding="utf-8") as file:
                    file.write(content)


def main():
    parser = argparse.ArgumentParser(description="Compares what files of random parts leave.")
    parser.add_argument("partc", metavar="PARTC")
    parser.add_argument("--parts", type=int, default=10)
    parser.add_argument("--altered", type=int, default=10)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cell", type=float, default=0.2, help="distance of points, in mm")
    parser.add_argument("--machine", choices=MACHINES, help="one machine for all parts")
    parser.add_argument("--milling", action="store_true", help="no works on holes but drill")
    parser.add_argument("--refused", action="store_true", help="print why programs are refused")
    parser.add_argument("--keep", metavar="FOLDER", help="where parts with faults are kept")
    given = parser.parse_args()
    if given.keep:
        os.makedirs(given.keep, exist_ok=True)
    counts = collections.Counter()
    for seed in range(given.seed, given.seed + given.parts):
        machine = given.machine or MACHINES[seed % len(MACHINES)]
        with tempfile.TemporaryDirectory() as folder:
            trial = Trial(given, folder, seed, machine)
        counts += trial.counts
        for fault in trial.faults:
            print(fault, flush=True)
    for row in ROWS + BAD_ROWS + tuple(sorted(set(counts) - set(ROWS + BAD_ROWS))):
        print(f"{row:40} {counts[row]:7}")
    return 1 if any(counts[row] for row in BAD_ROWS) or not counts["parts"] else 0


if __name__ == "__main__":
    sys.exit(main())
