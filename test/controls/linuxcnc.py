#!/usr/bin/env python3
"""Runs a G-code file by the interpreter of LinuxCNC, `rs274`, and judges its canonical calls.

    linuxcnc.py [--spindle-by-hand] [--start Z] [--work Z] FILE TABLE mill|lathe

TABLE is a tool table. Each mistake is one line. The status is 1 if there is a mistake, 2 if `rs274`
is missing (Debian package linuxcnc-uspace), else 0.

The file is run twice. First as it is: `rs274 -g -t TABLE FILE` must end with status 0, and print
nothing on standard error but lines "executing". Then with lines before it, since `rs274` itself
starts at 0 with all offsets 0, where a wrong motion to 0 would be no motion. They put the zero of
all work offsets at the z of --work, far below the machine's zero, as it is on a machine; and the
machine at x -107, y -108 and the z of --start. Both are in machine coordinates, in mm; -10000 and
-25 if left out. A file that first goes up in work coordinates needs a start below that height, such
as --start -10050. Of the second run:

- the first motion is a rapid that changes z alone, upwards; on a lathe, x alone, outwards, will do;
- no rapid goes down before the length of the tool is in use;
- before each cut the spindle turns with a speed above 0, the length of the tool is in use, the
  plane (x y on a mill, z x on a lathe) and the path mode are set. A path mode without a bound, G64
  without P, does not count.

The coordinates of the calls are those of the program: the work offset, the offset of G92 and that
of the tool are taken off (tried with `rs274` 2.9.0). After `G43` of a tool of length L, `G53 G0 Z0`
prints z -L, and `G0 Z20` prints 20. They are in the unit in effect at the call, x is a radius in G7
too. `SET_G5X_OFFSET`, `SET_G92_OFFSET` and `USE_TOOL_LENGTH_OFFSET` give the offsets in the same
unit, so that the sum is the place in machine coordinates. Of the tool table `rs274` takes the
lengths for inches, with `-t` alone and with `-i` as well: Z10 is a length of 254 mm. `G49` and a
tool without a length give the same call; so every tool of TABLE needs a length other than 0. A
new tool (M6) is not in use with its length until the next call of `USE_TOOL_LENGTH_OFFSET`, though
LinuxCNC keeps the length of the tool before.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile

START = (-107.0, -108.0)
MM = {"CANON_UNITS_MM": 1.0, "CANON_UNITS_INCHES": 25.4, "CANON_UNITS_CM": 10.0}
# The first and the second axis of ARC_FEED, and the axis at right angles to the plane.
ARC_AXES = {
    "CANON_PLANE_XY": (0, 1, 2),
    "CANON_PLANE_XZ": (2, 0, 1),
    "CANON_PLANE_YZ": (1, 2, 0),
}
# Lengths below this are rounding: calls have four decimals, of inches too. In mm.
ROUNDING = 0.01


class Refused(Exception):
    """The complaint of `rs274`."""


def interpret(path, table):
    """What `rs274` prints for a file."""
    with tempfile.TemporaryDirectory() as home:
        run = subprocess.run(
            ["rs274", "-g", "-t", os.path.abspath(table), os.path.abspath(path)],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            encoding="utf-8",
            errors="replace",
            cwd=home,
            env={**os.environ, "HOME": home},
            check=False,
        )
    complaints = [line for line in run.stderr.splitlines() if line.strip() != "executing"]
    if complaints or run.returncode != 0:
        raise Refused("; ".join(complaints) or f"the status is {run.returncode}")
    return run.stdout


def interpret_from(path, table, start, work):
    """What `rs274` prints for a file, after a motion to the start. A percent sign stays in front.

    start   the height of the start
    work    the height of the zero of all work offsets; both in machine coordinates, in mm
    """
    with open(path, encoding="utf-8", errors="replace") as file:
        lines = file.read().split("\n")
    begin = next((at for at, line in enumerate(lines) if line.strip()), 0)
    at = begin + 1 if lines[begin].strip().startswith("%") else begin
    offsets = [f"G21 G10 L2 P{system} Z{work}" for system in range(1, 10)]
    lines[at:at] = [*offsets, f"G53 G0 X{START[0]} Y{START[1]} Z{start}"]
    with tempfile.TemporaryDirectory() as folder:
        copy = os.path.join(folder, "program.ngc")
        with open(copy, "w", encoding="utf-8") as file:
            file.write("\n".join(lines))
        return interpret(copy, table)


CALL = re.compile(r"\s*(\d+)\s+N\S*\s+([A-Z0-9_]+)\((.*)\)\s*$")


def calls_of(text):
    """The canonical calls of an output: a number, a name and its arguments."""
    for line in text.splitlines():
        match = CALL.match(line)
        if match:
            number, name, inner = match.groups()
            yield int(number), name, re.split(r"[,\s]+", inner.strip()) if inner.strip() else []


class Machine:
    """The state of the machine between calls.

    place     x, y and z of the control point in machine coordinates, in mm
    offsets   the offsets by their calls, each x, y and z in mm
    chosen    the plane that a call has selected, or None
    length    the length of the tool is in use
    path      what the path mode lacks, or None
    started   the motion to the start has been made
    moved     the first motion of the file has been made
    turned    the turned coordinates have been told
    told      what the cuts before lacked, which has been told
    """

    def __init__(self, kind, by_hand):
        self.lathe, self.by_hand = kind == "lathe", by_hand
        self.scale, self.plane, self.chosen = 1.0, "CANON_PLANE_XY", None
        self.offsets = {}
        self.place = [0.0, 0.0, 0.0]
        self.length, self.turning, self.speed = False, False, 0.0
        self.path = "the path mode is not set"
        self.started, self.moved, self.turned, self.told = False, False, False, set()

    def in_machine(self, values):
        """The place in machine coordinates of program coordinates, a list of x, y and z."""
        sums = [sum(offset[axis] for offset in self.offsets.values()) for axis in range(3)]
        return [value * self.scale + sums[axis] for axis, value in enumerate(values)]

    def target(self, name, arguments):
        """The end of a motion in machine coordinates, in mm."""
        values = [float(argument) for argument in arguments]
        if name != "ARC_FEED":
            return self.in_machine(values[:3])
        first, second, third = ARC_AXES[self.plane]
        end = [0.0, 0.0, 0.0]
        end[first], end[second], end[third] = values[0], values[1], values[5]
        return self.in_machine(end)


def set_state(machine, name, arguments):
    """Follows a call that is no motion. A mistake, or None."""
    if name == "USE_LENGTH_UNITS":
        machine.scale = MM[arguments[0]]
    elif name == "SELECT_PLANE":
        machine.plane = machine.chosen = arguments[0]
    elif name in ("SET_G5X_OFFSET", "SET_G92_OFFSET", "USE_TOOL_LENGTH_OFFSET"):
        values = arguments[1:4] if name == "SET_G5X_OFFSET" else arguments[:3]
        machine.offsets[name] = [float(value) * machine.scale for value in values]
        if name == "USE_TOOL_LENGTH_OFFSET":
            machine.length = any(machine.offsets[name])
    elif name == "CHANGE_TOOL":
        machine.length = False
    elif name == "SET_SPINDLE_SPEED":
        machine.speed = float(arguments[1])
    elif name in ("START_SPINDLE_CLOCKWISE", "START_SPINDLE_COUNTERCLOCKWISE"):
        machine.turning = True
    elif name == "STOP_SPINDLE_TURNING":
        machine.turning = False
    elif name == "SET_MOTION_CONTROL_MODE":
        unbounded = arguments[0] == "CANON_CONTINUOUS" and float(arguments[1]) == 0
        machine.path = "the path mode has no bound" if unbounded else None
    elif name == "SET_XY_ROTATION" and float(arguments[0]) != 0 and not machine.turned:
        machine.turned = True
        return "the coordinates are turned, which this check does not follow"
    return None


def judge_start(machine, name, way):
    """Mistakes of the first motion; `way` is its length along each axis, in mm."""
    changed = [axis for axis, size in enumerate(way) if abs(size) > ROUNDING]
    if name != "STRAIGHT_TRAVERSE":
        yield "the first motion is no rapid"
    elif changed not in ([[2], [0]] if machine.lathe else [[2]]):
        yield f"the first motion does not change z alone{', or x alone' if machine.lathe else ''}"
    elif way[changed[0]] < 0:
        yield f"the first motion goes {-way[changed[0]]:.3f} mm down, not upwards"


def judge_cut(machine):
    """What a cut lacks."""
    if not machine.by_hand and not (machine.turning and machine.speed > 0):
        yield "the spindle does not turn"
    if not machine.length:
        yield "the length of the tool is not in use"
    wanted = "CANON_PLANE_XZ" if machine.lathe else "CANON_PLANE_XY"
    if machine.chosen != wanted:
        yield f"the plane {wanted} is not selected"
    if machine.path:
        yield machine.path


CUTS = ("STRAIGHT_FEED", "ARC_FEED", "STRAIGHT_PROBE", "RIGID_TAP")


def judge(text, kind, by_hand):
    """The mistakes of the calls, pairs of a call's number and a text. What a cut lacks is told once
    for a run of cuts that lack it."""
    machine = Machine(kind, by_hand)
    for number, name, arguments in calls_of(text):
        if name not in CUTS and name != "STRAIGHT_TRAVERSE":
            mistake = set_state(machine, name, arguments)
            if mistake:
                yield number, mistake
            continue
        target = machine.target(name, arguments)
        way = [end - begin for begin, end in zip(machine.place, target)]
        machine.place = target
        if not machine.started:
            # The motion to the start, which is no part of the file.
            machine.started = True
            continue
        yield from ((number, mistake) for mistake in judge_motion(machine, name, way))


def judge_motion(machine, name, way):
    """Mistakes of a motion."""
    if name == "STRAIGHT_TRAVERSE" and all(abs(size) <= ROUNDING for size in way):
        # G28 gives such a call for the place on its way, in G91 with Z0.
        return
    if not machine.moved:
        machine.moved = True
        yield from judge_start(machine, name, way)
    if name == "STRAIGHT_TRAVERSE":
        if way[2] < -ROUNDING and not machine.length:
            yield f"a rapid goes {-way[2]:.3f} mm down before the length of the tool is in use"
        return
    lacking = set(judge_cut(machine))
    yield from (f"a cut, but {text}" for text in sorted(lacking - machine.told))
    machine.told = lacking


def options_of():
    """The command line."""
    parser = argparse.ArgumentParser(description="Judges a G-code file by LinuxCNC's rs274.")
    parser.add_argument("file", metavar="FILE")
    parser.add_argument("table", metavar="TABLE")
    parser.add_argument("kind", choices=("mill", "lathe"))
    parser.add_argument("--spindle-by-hand", action="store_true", help="allow cuts without M3, M4")
    parser.add_argument("--start", type=float, default=-25.0, metavar="Z", help="of the start")
    parser.add_argument("--work", type=float, default=-10000.0, metavar="Z", help="of the zero")
    return parser.parse_args()


def main():
    options = options_of()
    if not shutil.which("rs274"):
        print("linuxcnc.py: rs274 is missing (package linuxcnc-uspace)", file=sys.stderr)
        sys.exit(2)
    try:
        interpret(options.file, options.table)
        text = interpret_from(options.file, options.table, options.start, options.work)
    except Refused as complaint:
        print(f"{options.file}: rs274: {complaint}")
        sys.exit(1)
    mistakes = list(judge(text, options.kind, options.spindle_by_hand))
    for number, what in mistakes:
        print(f"{options.file}: call {number}: {what}")
    sys.exit(1 if mistakes else 0)


if __name__ == "__main__":
    main()
