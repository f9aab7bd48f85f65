#!/usr/bin/env python3
"""Checks G-code files by the rules of GRBL 1.1, and prints one line for each mistake.

    grbl.py [--program [--spindle-by-hand]] FILE...

The status is 1 if there is a mistake, else 0. The checker knows nothing of the compiler that made
the files.

The rules are those of the published sources of GRBL 1.1 (github.com/gnea/grbl) in its default
build. Each rule names the file that states it; "step 3.13" is the part of `gc_execute_line` in
grbl/gcode.c that its comments number so. A control that finds an error in a block does nothing of
the block, and so does the checker. It is stricter where GRBL would do something else than the file
says:

- digits that GRBL drops, and numbers that its single precision changes (grbl/nuts_bolts.c,
  `read_float`);
- a dwell that is too long for its counter (grbl/nuts_bolts.c, `delay_sec`);
- an unclosed comment, which hides the rest of its line (grbl/protocol.c);
- an arc of radius 0, whose count of chords is undefined, and one so short that it becomes a full
  circle (grbl/motion_control.c, `mc_arc`);
- an arc in absolute coordinates from a position that no line has set.

Lengths of arcs are compared in double precision; GRBL computes them in single precision, which
differs from it by less than 0.0001 mm within 500 mm of the zero.

With --program, the demands of `common.Program` hold too. GRBL starts with G0, G17, G21, G90, G94,
G54, M5, F0 and S0 (doc/markdown/commands.md, the table of modal groups), but a program can follow
another one without a reset, so they do not count as written.
"""

import math
import re
import struct
import sys

from common import BY_HAND, PROGRAM, Mistake, Motion, Program, arguments, lines_of, report

# Lines --------------------------------------------------------------------------------------------

# grbl/protocol.c: `line` has LINE_BUFFER_SIZE bytes, 80 (grbl/config.h, the remark at this name),
# one of them for the end. Spaces and comments are left out before they are counted.
LONGEST_LINE = 79
# grbl/config.h: CMD_RESET, CMD_STATUS_REPORT, CMD_CYCLE_START, CMD_FEED_HOLD. grbl/serial.c: the
# interrupt takes them, and every byte above 0x7F, out of the stream before anything else sees them,
# so they act in comments too.
REAL_TIME = {
    0x18: "a reset",
    ord("?"): "a status report",
    ord("~"): "a cycle start",
    ord("!"): "a feed hold",
}


def acting(raw):
    """Mistakes of the bytes of a line that act in real time, each byte once."""
    found = dict.fromkeys(byte for byte in raw if byte in REAL_TIME or byte > 0x7F)
    for byte in found:
        shown = chr(byte) if 0x20 < byte < 0x7F else f"0x{byte:02X}"
        yield f"{shown} acts in real time: {REAL_TIME.get(byte, 'an override, or it is lost')}"


def stripped(raw):
    """The text that GRBL's parser sees, and if its comment is closed (grbl/protocol.c,
    `protocol_main_loop`).

    A comment in round brackets ends at the first closing one: comments do not nest. One after a
    semicolon ends with the line. Spaces, control characters and the stroke of a block delete are
    passed over; a percent sign is not.
    """
    kept, comment = [], ""
    for byte in raw:
        if byte in REAL_TIME or byte > 0x7F:
            continue
        sign = chr(byte)
        if comment:
            if comment == "(" and sign == ")":
                comment = ""
        elif sign in "(;":
            comment = sign
        elif byte > 0x20 and sign != "/":
            kept.append(sign.upper())
    return "".join(kept), comment != "("


# Words --------------------------------------------------------------------------------------------

NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)")
# grbl/nuts_bolts.c: MAX_INT_DIGITS. Zeros in front count.
DIGITS = 8
# grbl/gcode.c: MAX_LINE_NUMBER, MAX_TOOL_NUMBER.
HIGHEST_LINE, HIGHEST_TOOL = 10_000_000, 255
# grbl/nuts_bolts.c, `delay_sec`: 65535 steps of DWELL_TIME_STEP, 50 ms; in s.
LONGEST_DWELL = 3276.75
INCH = 25.4


def words_of(text):
    """The words of a line, pairs of a letter and a number as text. grbl/gcode.c, step 2; a number
    has no exponent."""
    place = 0
    while place < len(text):
        letter = text[place]
        if not "A" <= letter <= "Z":
            raise Mistake(f"{letter} stands where a word begins with a letter")
        number = NUMBER.match(text, place + 1)
        if not number:
            raise Mistake(f"{letter} has no number")
        yield letter, number.group()
        place = number.end()


def value_of(letter, number):
    """The value of a number, which GRBL must not change on reading."""
    if sum(sign.isdigit() for sign in number) > DIGITS:
        raise Mistake(f"{letter}{number} has more than {DIGITS} digits, and GRBL drops the others")
    value = float(number)
    single = struct.unpack("f", struct.pack("f", value))[0]
    decimals = len(number.partition(".")[2])
    if abs(single - value) > 0.5 * 10**-decimals:
        raise Mistake(f"{letter}{number} is {single:.{decimals}f} in single precision")
    return value


# grbl/gcode.c, step 2: the commands and their modal groups. A command is its whole number, and 100
# times its decimals.
GROUPS = {
    **{(number, 0): "motion" for number in (0, 1, 2, 3, 80)},
    **{(38, decimals): "motion" for decimals in (20, 30, 40, 50)},
    **{(number, 0): "plane" for number in (17, 18, 19)},
    **{(number, 0): "distance mode" for number in (90, 91)},
    (91, 10): "arc mode",
    **{(number, 0): "feed mode" for number in (93, 94)},
    **{(number, 0): "unit" for number in (20, 21)},
    (40, 0): "cutter compensation",
    **{(43, 10): "tool length", (49, 0): "tool length"},
    **{(number, 0): "work offset" for number in range(54, 60)},
    (61, 0): "path mode",
    **{(number, 0): "single action" for number in (4, 10, 28, 30, 53, 92)},
    **{(number, 10): "single action" for number in (28, 30, 92)},
}
# grbl/gcode.c, step 2: of the commands that use the words of axes, a block has at most one.
AXIS_USERS = {
    **{(number, 0): "motion" for number in (0, 1, 2, 3)},
    **{(38, decimals): "motion" for decimals in (20, 30, 40, 50)},
    **{(number, 0): "single action" for number in (10, 28, 30, 92)},
    **{(43, 10): "tool length", (49, 0): "tool length"},
}
M_GROUPS = {
    **dict.fromkeys((0, 1, 2, 30), "stop"),
    **dict.fromkeys((3, 4, 5), "spindle"),
    **dict.fromkeys((8, 9), "coolant"),
}
# grbl/config.h: not defined in the default build.
M_BUILD = {7: "ENABLE_M7", 56: "ENABLE_PARKING_OVERRIDE_CONTROL"}
VALUE_LETTERS = set("FIJKLNPRSTXYZ")
NOT_NEGATIVE = set("FNPST")


class Block:
    """The commands and values of a line.

    commands      maps a modal group to its command
    values        maps a letter to its value, in the units of the file
    user          the group of the command that uses the words of axes, or None
    feed          the feed in effect, 0 if undefined
    """

    def __init__(self):
        self.commands, self.values = {}, {}
        self.user, self.feed = None, 0.0

    def axes(self):
        """The letters of the axes that have a word, as a text in the order X Y Z."""
        return "".join(letter for letter in "XYZ" if letter in self.values)

    def command(self, group):
        """The number of the command of a group, or None."""
        return self.commands[group][0] if group in self.commands else None


def read_block(text):
    """The block of a line. grbl/gcode.c, step 2."""
    block = Block()
    for letter, number in words_of(text):
        if letter == "G":
            add_command(block, number)
        elif letter == "M":
            add_miscellaneous(block, number)
        else:
            add_value(block, letter, number)
    return block


def add_command(block, number):
    """Adds a word G. Decimals count to the second one only."""
    value = float(number)
    whole = math.trunc(value)
    command = (whole, math.floor(100 * (value - whole) + 0.5))
    if command not in GROUPS:
        raise Mistake(f"G{number} is no command of GRBL")
    user = AXIS_USERS.get(command)
    if user:
        if block.user:
            raise Mistake(f"G{number} and another command of the line both use words of axes")
        block.user = user
    add_to_group(block, GROUPS[command], command, f"G{number}")


def add_miscellaneous(block, number):
    """Adds a word M."""
    value = float(number)
    whole = math.trunc(value)
    if math.floor(100 * (value - whole) + 0.5) > 0:
        raise Mistake(f"M{number} is not a whole number")
    if whole in M_BUILD:
        raise Mistake(f"M{number} is no command of GRBL without {M_BUILD[whole]}")
    if value < 0 or whole not in M_GROUPS:
        raise Mistake(f"M{number} is no command of GRBL")
    add_to_group(block, M_GROUPS[whole], (whole, 0), f"M{number}")


def add_to_group(block, group, command, word):
    """Adds a command, of which a group has at most one in a line."""
    if group in block.commands:
        raise Mistake(f"{word} is the second word of its group ({group}) in the line")
    block.commands[group] = command


def add_value(block, letter, number):
    """Adds a value. A letter has at most one."""
    if letter not in VALUE_LETTERS:
        raise Mistake(f"{letter} is no word of GRBL")
    value = value_of(letter, number)
    if letter == "T" and value > HIGHEST_TOOL:
        raise Mistake(f"T{number} is above {HIGHEST_TOOL}")
    if letter in block.values:
        raise Mistake(f"{letter} stands twice in the line")
    if letter in NOT_NEGATIVE and value < 0:
        raise Mistake(f"{letter}{number} is negative")
    block.values[letter] = value


# Blocks -------------------------------------------------------------------------------------------


class State:
    """The state of the control between lines, as it is at power on (grbl/gcode.c, `gc_init`).

    position      x, y and z in work coordinates, in mm; None as long as no line has set it
    """

    def __init__(self):
        self.motion, self.plane, self.distance, self.feed_mode, self.units = (0, 0), 17, 90, 94, 21
        self.offset, self.spindle, self.speed, self.feed = 54, 5, 0.0, 0.0
        self.position = {"X": None, "Y": None, "Z": None}

    def after(self, block):
        """The modes that hold in a block: motion, plane, distance mode, feed mode, units."""
        names = ("plane", "distance mode", "feed mode", "unit")
        old = (self.plane, self.distance, self.feed_mode, self.units)
        modes = [block.command(name) or mode for name, mode in zip(names, old)]
        return (block.commands.get("motion", self.motion), *modes)


# grbl/gcode.c, step 3.11: the first axis, the second axis, and the offset words of both.
PLANES = {17: ("X", "Y", "I", "J"), 18: ("Z", "X", "K", "I"), 19: ("Y", "Z", "J", "K")}


def check_block(block, state):
    """The letters of a block that are used. grbl/gcode.c, step 3, in the order of its parts."""
    motion, plane, distance, feed_mode, units = state.after(block)
    if block.axes() and not block.user:
        block.user = "motion"
    if math.trunc(block.values.get("N", 0)) > HIGHEST_LINE:
        raise Mistake(f"N is above {HIGHEST_LINE}")
    check_feed(block, state, motion, feed_mode)
    used = set("NFST")
    single = block.commands.get("single action")
    if single == (4, 0):
        if "P" not in block.values:
            raise Mistake("G4 has no P")
        if block.values["P"] > LONGEST_DWELL:
            raise Mistake(f"G4 waits for more than {LONGEST_DWELL} s")
        used.add("P")
    if block.commands.get("tool length") == (43, 10) and block.axes() != "Z":
        raise Mistake("G43.1 needs the word Z, and no other axis")
    used |= check_single(block, single, motion)
    if motion == (80, 0):
        if block.axes():
            raise Mistake("words of axes stand in a line where G80 holds")
    elif block.user == "motion":
        used |= check_motion(block, state, (motion, plane, distance, units))
    if block.user:
        used |= set("XYZ")
    unused = [letter for letter in block.values if letter not in used]
    if unused:
        raise Mistake(f"no command of the line uses {', '.join(unused)}")


def check_feed(block, state, motion, feed_mode):
    """Sets the feed of a block. Parts 3.2 and 3.3: from G93 to G94 the feed becomes undefined."""
    given = block.values.get("F")
    if feed_mode == 93:
        if block.user == "motion" and motion not in ((80, 0), (0, 0)) and given is None:
            raise Mistake("a line in G93 needs its own F")
        block.feed = given or 0.0
    else:
        block.feed = given if given is not None else state.feed if state.feed_mode == 94 else 0.0


def check_single(block, single, motion):
    """The letters that G10, G92 or G53 use. Part 3.19."""
    if single in ((10, 0), (92, 0)) and not block.axes():
        raise Mistake(f"G{single[0]} has no word of an axis")
    if single == (10, 0):
        if "P" not in block.values and "L" not in block.values:
            raise Mistake("G10 has no P and no L")
        if math.trunc(block.values.get("P", 0)) > 6:
            raise Mistake("G10 has a P above 6")
        way = math.trunc(block.values.get("L", 0))
        if way not in (2, 20) or (way == 2 and "R" in block.values):
            raise Mistake("G10 needs L2 without R, or L20")
        return set("LP")
    if single == (53, 0) and motion not in ((0, 0), (1, 0)):
        raise Mistake("G53 holds for G0 and G1 only")
    return set()


def check_motion(block, state, modes):
    """The letters that a motion uses, besides those of axes. Part 3.20."""
    motion, plane, distance, units = modes
    if motion == (0, 0):
        return set()
    if block.feed == 0:
        raise Mistake("the feed is undefined: no F")
    if motion == (1, 0):
        return set()
    if not block.axes():
        raise Mistake(f"G{motion[0]} has no word of an axis")
    steps = {letter: step(block, state, letter, distance, units) for letter in "XYZ"}
    if motion[0] == 38:
        if all(size == 0 for size in steps.values()):
            raise Mistake("G38 ends where it begins")
        return set()
    first, second = PLANES[plane][:2]
    if first not in block.values and second not in block.values:
        raise Mistake(f"G{motion[0]} has no word of an axis of its plane")
    scale = INCH if units == 20 else 1.0
    if "R" in block.values:
        check_radius(block.values["R"] * scale, steps, (first, second))
        return {"R"}
    check_centre(block, PLANES[plane], steps, scale)
    return set("IJK")


def step(block, state, letter, distance, units):
    """The way that a motion goes along an axis, in mm; None if it is not known."""
    if letter not in block.values:
        return 0.0
    value = block.values[letter] * (INCH if units == 20 else 1.0)
    if distance == 91:
        return value
    return None if state.position[letter] is None else value - state.position[letter]


def known(steps, axes):
    """The ways along both axes of the plane, which the geometry of an arc depends on."""
    for axis in axes:
        if steps[axis] is None:
            raise Mistake(f"the arc begins at a position that no line has set ({axis})")
    return steps[axes[0]], steps[axes[1]]


# grbl/config.h: ARC_ANGULAR_TRAVEL_EPSILON, in radians.
LEAST_SWEEP = 5e-7


def check_sweep(centre, steps):
    """Makes sure that a short arc stays one: up to `LEAST_SWEEP` it becomes a full circle
    (grbl/motion_control.c, `mc_arc`)."""
    (i, j), (x, y) = centre, steps
    if (x, y) == (0, 0):
        return
    sweep = abs(math.atan2(-i * (y - j) + j * (x - i), -i * (x - i) - j * (y - j)))
    if sweep <= LEAST_SWEEP:
        raise Mistake(f"the arc of {math.hypot(x, y):.4f} mm is so short that it is a full circle")


def check_radius(radius, steps, axes):
    """An arc with R. Part 3.20, radius mode; all lengths in mm."""
    x, y = known(steps, axes)
    if x == 0 and y == 0:
        raise Mistake("an arc with R ends where it begins, in its plane")
    if 4 * radius * radius - x * x - y * y < 0:
        raise Mistake(f"R is less than half the chord of {math.hypot(x, y):.4f} mm")
    # The centre lies on the perpendicular of the chord. Its side does not change the angle.
    height = math.sqrt(radius * radius - (x * x + y * y) / 4) / math.hypot(x, y)
    check_sweep((x / 2 - y * height, y / 2 + x * height), (x, y))


def check_centre(block, plane, steps, scale):
    """An arc with offsets of its centre. Part 3.20, centre format; all lengths in mm. A full circle
    is allowed, with the word of an axis of the plane."""
    first, second, *letters = plane
    if not any(letter in block.values for letter in letters):
        raise Mistake(f"the arc has no R, and no {letters[0]} or {letters[1]} of its plane")
    i, j = (block.values.get(letter, 0.0) * scale for letter in letters)
    x, y = known(steps, (first, second))
    begin, end = math.hypot(i, j), math.hypot(x - i, y - j)
    error = abs(end - begin)
    if error > 0.005 and (error > 0.5 or error > 0.001 * begin):
        raise Mistake(f"the radii at the ends of the arc differ by {error:.4f} mm")
    if begin == 0:
        raise Mistake("the radius of the arc is 0")
    check_sweep((i, j), (x, y))


def execute(block, state):
    """The state after a block. grbl/gcode.c, step 4."""
    motion, plane, distance, feed_mode, units = state.after(block)
    move_position(block, state, distance, units)
    offset = block.command("work offset") or state.offset
    if offset != state.offset:
        forget(state, "XYZ")
    state.motion, state.plane, state.distance = motion, plane, distance
    state.feed_mode, state.units, state.feed, state.offset = feed_mode, units, block.feed, offset
    state.speed = block.values.get("S", state.speed)
    state.spindle = block.command("spindle") or state.spindle
    if block.command("stop") in (2, 30):
        # Part 4.21: the units, the length of the tool and the values of F and S stay.
        if state.offset != 54:
            forget(state, "XYZ")
        state.motion, state.plane, state.distance, state.feed_mode = (1, 0), 17, 90, 94
        state.offset, state.spindle = 54, 5


def forget(state, axes):
    """Makes the work coordinates of axes unknown."""
    for axis in axes:
        state.position[axis] = None


def move_position(block, state, distance, units):
    """Moves the position, or its zero."""
    scale = INCH if units == 20 else 1.0
    single = block.commands.get("single action")
    values = {axis: block.values[axis] * scale for axis in block.axes()}
    if single in ((28, 0), (30, 0)):
        forget(state, block.axes() or "XYZ")
    elif single == (92, 0):
        state.position.update(values)
    elif single in ((92, 10), (10, 0)):
        forget(state, "XYZ")
    if block.user == "tool length":
        forget(state, "Z")
    if block.user != "motion":
        return
    if single == (53, 0) or block.commands.get("motion", state.motion)[0] == 38:
        forget(state, values)
        return
    for axis, value in values.items():
        if distance == 90:
            state.position[axis] = value
        elif state.position[axis] is not None:
            state.position[axis] += value


# Files --------------------------------------------------------------------------------------------

MODES = {"plane": "G17", "distance mode": "G90", "unit": "G21", "feed mode": "G94"}


def motion_of(block, state):
    """The motion of a block for `common.Program`, or None. `state` is the state before it."""
    motion, _, distance, _, units = state.after(block)
    single = block.commands.get("single action")
    z = block.values["Z"] * (INCH if units == 20 else 1.0) if "Z" in block.values else None
    system = None if distance == 91 else f"G{block.command('work offset') or state.offset}"
    if single in ((28, 0), (30, 0)):
        # The axes go to a stored place. In G91, Z0 leaves out the way to another place before.
        return Motion(block.axes() or "XYZ", True, None if distance == 91 and z == 0 else z, system)
    if block.user != "motion" or not block.axes():
        return None
    if single == (53, 0):
        system = "G53"
    return Motion(block.axes(), motion == (0, 0), z, system)


def check(path, program):
    """The mistakes of a file, pairs of a line and a text."""
    state, mistakes = State(), []
    with open(path, "rb") as file:
        lines = lines_of(file.read())
    for number, raw in lines:
        mistakes += [(number, text) for text in acting(raw)]
        try:
            check_line(raw, state, program, number)
        except Mistake as mistake:
            mistakes.append((number, str(mistake)))
    return mistakes + (program.end() if program else [])


def check_line(raw, state, program, number):
    """Checks a line, and executes it."""
    text, closed = stripped(raw)
    if not closed:
        raise Mistake("the comment is not closed, and the rest of the line belongs to it")
    if len(text) > LONGEST_LINE:
        length = f"{len(text)} characters without spaces and comments"
        raise Mistake(f"the line has {length}, more than {LONGEST_LINE}")
    if text.startswith("$"):
        raise Mistake("a system command ($) is no part of a program")
    block = read_block(text)
    check_block(block, state)
    if program:
        demand(block, state, program, number)
    execute(block, state)


def demand(block, state, program, number):
    """Tells the demands on the whole program what a line does. `state` is the state before it."""
    program.writes(block.commands)
    motion = motion_of(block, state)
    if not motion:
        return
    program.moves(number, motion)
    if not motion.rapid:
        # grbl/gcode.c, step 4: the speed and the spindle come before the motion of their line.
        spindle = block.command("spindle") or state.spindle
        program.cuts(number, spindle in (3, 4) and block.values.get("S", state.speed) > 0)


def main():
    options = arguments("Checks G-code files by the rules of GRBL 1.1.", PROGRAM, BY_HAND)
    wrong = False
    for path in options.files:
        program = Program(MODES, options.spindle_by_hand) if options.program else None
        wrong |= report(path, check(path, program))
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
