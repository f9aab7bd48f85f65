#!/usr/bin/env python3
"""Compares what partc says about collisions with the field of heights of `heights.py`.

    collisions.py PARTC [--parts N] [--altered N] [--seed S] [--cell MM] [--jobs N]
                        [--keep FOLDER]

Random parts (`parts.py`) are compiled without a proof. Each file, and altered forms of it, are
given to `partc verify`, and their reports E0743, E0744 and E0745 are judged:

- A contact that is certain on the field has to be reported: with its code, for its avoided solid,
  and for the same line or an earlier one. Otherwise it is *missed*.
- A contact that is reported has to be *real*: possible at the point, or to the depth, that the
  report names. Contacts that are possible only by one of the over-estimates of partc (see
  `heights.py`) are counted apart. A contact that is not even possible by all of them is *false*.

Other reports do not matter. The table has the counts of certain contacts, and of reports by their
verdicts. The status is 1 if a contact is missed, or if more than one report in 1000 is false or
names a depth that is not reached.
"""

import argparse
import collections
import json
import math
import multiprocessing
import os
import random
import re
import subprocess
import sys
import tempfile

import numpy

import heights
import parts

CODES = ("E0743", "E0744", "E0745")
# Rows of the table in which there has to be 0.
BAD_ROWS = (
    "parts that were not compiled", "files on which partc fails",
    "files accepted with a certain contact", "contacts missed in refused files",
    "contacts reported too late",
)
# The other rows that are always there.
ROWS = (
    "parts", "files", "files that no control runs", "files that partc cannot read",
    "files accepted", "files refused", "files refused for collisions only",
    "files refused for over-estimates only", "files with a certain contact",
    "contacts behind the first report",
)
# Verdicts about reports that are faults of partc.
WRONG = ("false", "with a wrong depth")
# Halvings of a shift.
BISECTIONS = 9
# Most attempts for one part.
ATTEMPTS = 40


def run(partc, *arguments):
    """Status and reports of partc."""
    done = subprocess.run(
        [partc, *arguments, "-q", "--format", "json"],
        stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", check=False,
    )
    reports = [json.loads(line) for line in done.stderr.splitlines() if line.startswith("{")]
    return done.returncode, [r for r in reports if r["severity"] == "error"]


class Report:
    """One of the three reports about a file.

    kind   as that of a contact of `heights`
    line   number of the line in the file
    text   title and message
    """

    def __init__(self, report, name, avoided):
        related = report["related"]
        self.line = next(r["start"]["line"] for r in related if r["file"].endswith(name))
        lines = [r["start"]["line"] for r in related if not r["file"].endswith(name)]
        solids = [k for k, solid in enumerate(avoided) if solid["line"] in lines]
        self.kind = (report["code"], solids[0] if report["code"] == "E0743" else 0)
        self.text = " ".join([report["title"]] + report["message"])

    def verdict(self, setup, motions):
        """"real", the name of an over-estimate, "by several" of them, or one of WRONG."""
        if self.kind[0] == "E0743":
            return self._avoided(setup, motions)
        match = re.search(r"At \((-?[\d.]+), (-?[\d.]+)\)", self.text)
        place = (float(match.group(1)), float(match.group(2)))
        choices = [("real", ())]
        choices += [(name, (name,)) for name in heights.OVERESTIMATES]
        choices.append(("by several", heights.OVERESTIMATES))
        for name, over in choices:
            if self.kind[0] in heights.possible(setup, motions, self.line, place, over):
                return name
        return "false"

    def _avoided(self, setup, motions):
        solid = setup["avoided"][self.kind[1]]
        stated = float(re.search(r", by (-?[\d.]+) mm", self.text).group(1))
        depths = [
            max(
                (depth_in(solid, motion, part) for motion in motions if motion.line == self.line
                 for part in tool_parts(setup["tools"][str(motion.tool)], self.text, is_pointed)),
                default=-math.inf,
            )
            for is_pointed in (True, False)
        ]
        if stated > depths[1] + 0.02:
            return "with a wrong depth"
        least = setup["tolerance"] + setup["pulse"] - heights.HAIR
        return "real" if depths[0] > least else "point" if depths[1] > least else "false"


def tool_parts(tool, text, is_pointed):
    """The parts of a tool that a text may mean: radius, height above the tip, and slope."""
    if text.startswith("the holder"):
        return [(radius, above, 0) for radius, above in tool["holder"]]
    return [(tool["radius"], 0, tool["slope"] if is_pointed else 0)]


def depth_in(solid, motion, part):
    """Depth to which a part of a tool enters a solid, at sample points 0.01 mm apart."""
    radius, above, slope = part
    shares = numpy.linspace(0, 1, 2 + math.ceil(motion.length() / 0.01))
    x, y = numpy.array([motion.at(k) for k in shares]).T
    free = solid["top"] - above - (motion.z[0] + shares * (motion.z[1] - motion.z[0]))
    if motion.length() == 0:
        free = numpy.full(x.shape, solid["top"] - above - min(motion.z))
    radii = numpy.minimum(radius, free / slope) if slope else radius
    depths = radii - heights.from_shapes(solid["shapes"], x, y)
    return float(numpy.where(free > 0, depths, -numpy.inf).max())


class Trial:
    """The trial of one part. `counts` has the numbers of the table, `faults` what is wrong."""

    def __init__(self, partc, folder, keep, cell, altered, seed):
        self.partc, self.folder, self.keep = partc, folder, keep
        self.seed = seed
        self.counts, self.faults = collections.Counter(), []
        rng = random.Random(seed)
        self.name = f"p{seed}"
        self.program, self.tape = (os.path.join(folder, self.name + end) for end in (".part", ".nc"))
        text = self._compiled(rng, cell)
        if text is None:
            self.counts["parts that were not compiled"] += 1
            return
        self.counts["parts"] += 1
        self._judge("as compiled", text)
        for n in range(altered):
            self._judge(*self._altered(text, n))

    def _compiled(self, rng, cell):
        """The file of a random part. In most files nothing is hit, so that what an alteration hits
        is the first contact."""
        is_free = rng.random() < 0.8
        for _ in range(ATTEMPTS):
            self.part = parts.Part(rng, self.name)
            with open(self.program, "w", encoding="utf-8") as file:
                file.write(self.part.text)
            status, _ = run(self.partc, "compile", self.program, "-o", self.tape, "--no-verify")
            if status != 0:
                continue
            with open(self.tape, encoding="utf-8") as file:
                text = file.read()
            motions = heights.motions_of(text, self.part.setup)
            self.field = heights.grid(self.part.setup, motions, cell)
            if not (is_free and heights.certain(self.field, motions)):
                return text
        return None

    def _altered(self, text, n):
        """The altered file with the number n. If a shift of a place makes contacts, two of three files
        have the least share of this shift that makes one of these."""

        def made(share):
            return parts.altered(random.Random(f"{self.seed} {n}"), text, n % 4 > 0, share)

        def hits(share):
            motions = heights.motions_of(made(share)[1], self.part.setup)
            return {contact.kind for contact in heights.certain(self.field, motions)}

        try:
            if n % 3 and made(1) != made(0.5) and hits(1) - hits(0):
                kind = random.Random(n).choice(sorted(hits(1) - hits(0)))
                clear, hit = 0, 1
                for _ in range(BISECTIONS):
                    middle = (clear + hit) / 2
                    clear, hit = (clear, middle) if kind in hits(middle) else (middle, hit)
                return made(hit)
        except heights.NotRun:
            pass
        return made(1)

    def _judge(self, what, text):
        """Judges one file."""
        setup = self.part.setup
        try:
            motions = heights.motions_of(text, setup)
        except heights.NotRun:
            self.counts["files that no control runs"] += 1
            return
        with open(self.tape, "w", encoding="utf-8") as file:
            file.write(text)
        status, errors = run(self.partc, "verify", self.program, self.tape)
        self.counts["files"] += 1
        self.counts["files refused" if status else "files accepted"] += 1
        codes = {error["code"] for error in errors}
        if bool(status) != bool(codes):
            self._fault("files on which partc fails", what, text, f"status {status}")
        self.counts["files that partc cannot read"] += "E0601" in codes
        found = [Report(e, self.name + ".nc", setup["avoided"]) for e in errors if e["code"] in CODES]
        reports = {report.kind: report for report in found}
        self._compare(what, text, motions, errors, reports)
        verdicts = set()
        for report in reports.values():
            verdict = report.verdict(setup, motions)
            verdicts.add(verdict)
            row = f"{report.kind[0]} {verdict}"
            if what == "as compiled":
                self.counts[f"as compiled: {row}"] += 1
            if verdict in WRONG:
                self._fault(row, what, text, f"line {report.line}: {report.text}")
            else:
                self.counts[row] += 1
        if codes and codes <= set(CODES):
            self.counts["files refused for collisions only"] += 1
            self.counts["files refused for over-estimates only"] += "real" not in verdicts

    def _compare(self, what, text, motions, errors, reports):
        """Compares the certain contacts of a file with its reports, by their kinds."""
        # Of a change in a few lines, partc shows the first finding only.
        is_shortened = any("of this change" in line for e in errors for line in e["message"])
        first = {}
        for contact in heights.certain(self.field, motions):
            first.setdefault(contact.kind, contact)
        self.counts["files with a certain contact"] += bool(first)
        for kind, contact in first.items():
            self.counts[f"{kind[0]} certain"] += 1
            if not errors:
                self._fault("files accepted with a certain contact", what, text, str(contact))
            elif kind not in reports and is_shortened:
                self.counts["contacts behind the first report"] += 1
            elif kind not in reports:
                self._fault("contacts missed in refused files", what, text, str(contact))
            elif reports[kind].line > contact.line:
                late = f"{contact}; partc: {reports[kind].text}"
                self._fault("contacts reported too late", what, text, late)

    def _fault(self, row, what, text, fact):
        self.counts[row] += 1
        count = len(self.faults)
        self.faults.append(f"{self.name}-{count}: {row}: {what}: {fact}")
        if self.keep:
            base = os.path.join(self.keep, f"{self.name}-{count}")
            for end, content in (
                (".part", self.part.text), (".nc", text), (".json", self.part.described())
            ):
                with open(base + end, "w", encoding="utf-8") as file:
                    file.write(content)


def trial(arguments):
    """Counts and faults of one part, in a process of its own."""
    partc, *others = arguments
    with tempfile.TemporaryDirectory() as folder:
        done = Trial(partc, folder, *others)
    return done.counts, done.faults


def main():
    parser = argparse.ArgumentParser(description="Compares collisions with a field of heights.")
    parser.add_argument("partc", metavar="PARTC")
    parser.add_argument("--parts", type=int, default=10)
    parser.add_argument("--altered", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cell", type=float, default=0.25, help="size of a cell, in mm")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--keep", metavar="FOLDER", help="where files with faults are kept")
    given = parser.parse_args()
    if given.keep:
        os.makedirs(given.keep, exist_ok=True)
    tasks = [
        (given.partc, given.keep, given.cell, given.altered, seed)
        for seed in range(given.seed, given.seed + given.parts)
    ]
    counts = collections.Counter()
    with multiprocessing.Pool(given.jobs) as pool:
        for some, faults in pool.imap(trial, tasks):
            counts += some
            for fault in faults:
                print(fault, flush=True)
    for row in ROWS + BAD_ROWS + tuple(sorted(set(counts) - set(ROWS + BAD_ROWS))):
        print(f"{row:40} {counts[row]:7}")
    reported = sum(
        count for row, count in counts.items() if row[:5] in CODES and not row.endswith(" certain")
    )
    wrong = sum(counts[f"{code} {verdict}"] for code in CODES for verdict in WRONG)
    is_bad = any(counts[row] for row in BAD_ROWS) or 1000 * wrong > reported
    return 1 if is_bad or not counts["files"] else 0


if __name__ == "__main__":
    sys.exit(main())
