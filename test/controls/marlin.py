#!/usr/bin/env python3
"""Checks G-code files by the rules of Marlin 2, and prints one line for each mistake.

    marlin.py [--program [--spindle-by-hand]] [--build] FILE...

The status is 1 if there is a mistake, else 0. The checker knows nothing of the compiler that made
the files.

The rules are those of the published sources of Marlin 2.1 (github.com/MarlinFirmware/Marlin, whose
folder Marlin/src is meant by src) and of its documents (marlinfw.org/docs/gcode). Each rule names
the file that states it. Marlin seldom refuses: it echoes a command that it does not know, and
passes over words that a command does not use. Both are mistakes here, because the file then says
something else than Marlin does.

Many commands depend on the build. They are no mistakes; --build lists what the build must have.

With --program, the demands of `common.Program` hold too, and:

- each rapid has its own feed, and so has the first cut after a rapid: G0 and G1 share one feed
  (src/gcode/motion/G0_G1.cpp);
- no command makes motions of its own, homes, or ends the run: G28, G29, G30, G61, M112 and others.

At power on Marlin has mm, absolute coordinates, the plane x y and a feed of 1500 mm/min
(src/module/motion.cpp, `feedrate_mm_s`). A program can follow another one, so they do not count as
written.
"""

import math
import re
import sys

from common import BY_HAND, PROGRAM, Mistake, Motion, Program, arguments, lines_of, report
from marlin_commands import FLAGS, FORBIDDEN, G_BUILD, LETTERS, M_BUILD, SUBCODES, TEXT

INCH = 25.4
# Marlin/Configuration_adv.h: MAX_CMD_SIZE 96, one of them for the end (src/gcode/queue.cpp,
# `process_stream_char`). Comments do not count; what is too long is cut off silently.
LONGEST_COMMAND = 95

# Lines --------------------------------------------------------------------------------------------


def stripped(raw, build):
    """The text of a line that Marlin's parser sees (src/gcode/queue.cpp, `process_stream_char`).

    A semicolon begins a comment. Round brackets do so in a build with PAREN_COMMENTS only; they do
    not nest. A backslash is dropped, and a backspace deletes the character before it.
    """
    kept, bracket = [], False
    for byte in raw:
        sign = chr(byte)
        if bracket:
            bracket = sign != ")"
        elif sign == ";":
            break
        elif sign == "(":
            bracket = True
            build("PAREN_COMMENTS", "comments in round brackets")
        elif not 0x20 <= byte < 0x7F:
            raise Mistake(f"the byte 0x{byte:02X} stands outside a comment")
        elif sign == "\\":
            raise Mistake("a backslash stands outside a comment, and Marlin drops it")
        else:
            kept.append(sign)
    if bracket:
        raise Mistake("the comment is not closed, and the rest of the line belongs to it")
    text = "".join(kept).rstrip(" ")
    if len(text) > LONGEST_COMMAND:
        raise Mistake(f"the command has {len(text)} characters, more than {LONGEST_COMMAND}")
    return text


LINE_NUMBER = re.compile(r"N([+-]?\d+) *(.*)")


def without_number(text, last):
    """The command of a line with a number and a checksum, and the number (src/gcode/queue.cpp,
    `get_serial_commands`). `last` is the number of the line before, or None at the beginning."""
    numbered = LINE_NUMBER.match(text)
    body, star, checksum = text.rpartition("*")
    if not numbered:
        if star:
            raise Mistake("a checksum (*) without a line number")
        return text, last
    if not star:
        raise Mistake("a line number (N) without a checksum (*)")
    computed = 0
    for byte in body.encode():
        computed ^= byte
    if not checksum.strip().isdigit() or int(checksum) != computed:
        raise Mistake(f"the checksum is not {computed}")
    number = int(numbered.group(1))
    command = LINE_NUMBER.match(body).group(2).rstrip(" ")
    if command.startswith("M110"):
        given = re.search(r"N([+-]?\d+)", command)
        return command, int(given.group(1)) if given else number
    if last is not None and number != last + 1:
        raise Mistake(f"the line number is {number}, not {last + 1}")
    return command, number


# Commands -----------------------------------------------------------------------------------------

COMMAND = re.compile(r"([GMT]) *(\d+)(\.\d+)? *")
NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)")


class Command:
    """A command: its letter, its number, its subcode or None, and its words.

    words     pairs of a letter and its number as text, or None if it has none
    message   the rest of the line, from the first sign on that begins no word with a number
    odd       the first sign that is no capital letter and belongs to no word
    """

    def __init__(self, letter, number, subcode, words, message, odd):
        self.letter, self.number, self.subcode = letter, number, subcode
        self.words, self.message, self.odd = words, message, odd

    def name(self):
        """The command as the file writes it."""
        return f"{self.letter}{self.number}" + ("" if self.subcode is None else f".{self.subcode}")

    def value(self, letter):
        """The value of a word, or None."""
        for other, number in self.words:
            if other == letter and number is not None:
                return float(number)
        return None


def read_command(text):
    """The command of a line (src/gcode/parser.cpp, `parse`). Small letters are words only in a
    build with GCODE_CASE_INSENSITIVE, which no file needs."""
    head = COMMAND.match(text)
    if not head:
        raise Mistake(f"the line begins with no command G, M or T: {text.split(' ')[0]}")
    letter, number = head.group(1), int(head.group(2))
    subcode = int(head.group(3)[1:]) if head.group(3) else None
    if letter == "M" and number in TEXT:
        return Command(letter, number, subcode, [], text[head.end() :], "")
    words, message, odd = [], "", ""
    place = head.end()
    while place < len(text):
        sign = text[place]
        capital = "A" <= sign <= "Z"
        value = NUMBER.match(text, place + 1 + spaces(text, place + 1)) if capital else None
        if not value:
            message = message or text[place:]
        if not capital:
            odd = odd or sign
        else:
            words.append((sign, value.group() if value else None))
        place = value.end() if value else place + 1
        place += spaces(text, place)
    return Command(letter, number, subcode, words, message, odd)


def spaces(text, place):
    """The count of spaces at a place."""
    return len(text) - place - len(text[place:].lstrip(" "))


class State:
    """The state between lines.

    position    x, y and z in work coordinates, in mm; None as long as no line has set it
    turning     the spindle turns, with a speed that the file states
    fed         the feed in effect is that of a cut, not of a rapid
    told        the arc before the plane is written has been reported
    """

    def __init__(self):
        self.plane, self.relative, self.scale = 17, False, 1.0
        self.offset, self.turning, self.fed, self.told = "machine", False, False, False
        self.position = {"X": None, "Y": None, "Z": None}

    def forget(self, axes):
        """Makes the coordinates of axes unknown."""
        for axis in axes:
            self.position[axis] = None


def check_words(command):
    """The words of a command. A second command in the line is read as words of the first."""
    name = command.name()
    used = LETTERS.get(name)
    if name in ("M0", "M1") or used is None and command.message:
        return
    letters = [letter for letter, _ in command.words]
    for letter, number in command.words:
        if letter in "GM":
            raise Mistake(f"{letter}{number or ''} is read as a word of {name}, not as a command")
        if used is None:
            continue
        if letter not in used:
            raise Mistake(f"{name} does not use {letter}, and passes over it")
        if letters.count(letter) > 1:
            raise Mistake(f"{letter} stands twice in the line")
        if number is None and (name, letter) not in FLAGS:
            raise Mistake(f"{letter} has no number")
    if used is not None and command.odd:
        raise Mistake(f"{name} passes over {command.odd}")


def check_known(command, build):
    """Makes sure that a command is one of Marlin's (src/gcode/gcode.cpp, `process_parsed_command`).
    `build` is told the option that the command needs."""
    name = command.name()
    if name == "M30":
        raise Mistake("M30 deletes a file, and ends no program")
    if command.subcode is not None:
        if name not in SUBCODES:
            raise Mistake(f"{name} is no command of Marlin")
        build(SUBCODES[name], name)
        return
    table = {"G": G_BUILD, "M": M_BUILD, "T": {}}[command.letter]
    if command.letter == "T":
        return
    if command.number not in table or command.number == 38:
        raise Mistake(f"{name} is no command of Marlin, which echoes it and goes on")
    if table[command.number]:
        build(table[command.number], name)


def check_command(command, state, build):
    """Checks the values of a command."""
    name = command.name()
    if name in ("G0", "G1", "G2", "G3"):
        feed = command.value("F")
        if feed is not None and feed <= 0:
            raise Mistake("F is not above 0, and Marlin passes over it")
        if name in ("G2", "G3"):
            check_arc(command, state, build)
        for axis in sorted({letter for letter, _ in command.words} & set("ABCUVW")):
            build(f"an axis {axis}", name)
    elif name == "G4":
        check_dwell(command)
    elif name in ("M0", "M1"):
        check_stop(command)
    elif name in ("M3", "M4"):
        check_spindle(command, build)


def check_dwell(command):
    """G4: P is in ms, a whole number (src/gcode/parser.h, `value_millis`); S is in s, and wins
    (src/gcode/motion/G4.cpp)."""
    p, s = command.value("P"), command.value("S")
    if (p is None) == (s is None):
        raise Mistake("G4 needs P, in ms, or S, in s")
    if (p if s is None else s) < 0:
        raise Mistake("the time of G4 is negative")
    if p is not None and p != math.floor(p):
        raise Mistake("P of G4 is in ms, and Marlin cuts its decimals off")


def check_stop(command):
    """M0 and M1: P and S bound the time that the control waits, and the parser finds them in the
    message too (src/gcode/lcd/M0_M1.cpp, src/gcode/parser.cpp)."""
    for letter, number in command.words:
        if letter in "PS" and number is not None and letter + number in command.message:
            raise Mistake(f"{command.name()} waits for {letter}{number} only, from its message")


POWER_UNITS = {"PERCENT": 100, "SERVO": 180, "PWM255": 255}


def check_spindle(command, build):
    """M3 and M4: S is in the unit CUTTER_POWER_UNIT (Marlin/Configuration_adv.h): PWM255 to 255,
    PERCENT to 100, SERVO to 180, or RPM. Above the range it is cut down to it."""
    speed = command.value("S")
    if speed is None:
        return
    if speed < 0:
        raise Mistake(f"S of {command.name()} is negative")
    units = [unit for unit, most in POWER_UNITS.items() if speed <= most]
    build(f"CUTTER_POWER_UNIT {' or '.join(['RPM', *units])}", f"S{speed:g} of {command.name()}")


# The axes of a plane and the offset words of both (src/gcode/motion/G2_G3.cpp).
PLANES = {17: ("X", "Y", "I", "J"), 18: ("Z", "X", "K", "I"), 19: ("Y", "Z", "J", "K")}


def check_arc(command, state, build):
    """G2 and G3 (src/gcode/motion/G2_G3.cpp; marlinfw.org/docs/gcode/G002-G003.html)."""
    first, second, *letters = PLANES[state.plane]
    offsets = [letter for letter in "IJK" if command.value(letter) is not None]
    radius, circles = command.value("R"), command.value("P")
    if circles is not None:
        build("ARC_P_CIRCLES", f"P of {command.name()}")
        if circles != math.floor(circles) or not 0 <= circles <= 100:
            raise Mistake("P of an arc is no whole number from 0 to 100")
    if radius is not None:
        if offsets:
            raise Mistake(f"an arc has R and {offsets[0]}")
        if state.plane != 17:
            raise Mistake("an arc with R is computed in the plane x y, whatever plane holds")
        check_radius(radius * state.scale, step(command, state, "X"), step(command, state, "Y"))
        return
    for letter in offsets:
        if letter not in letters:
            raise Mistake(f"{letter} is no offset of the plane, and Marlin passes over it")
    i, j = ((command.value(letter) or 0.0) * state.scale for letter in letters)
    if i == 0 and j == 0:
        raise Mistake(f"an arc needs R, or {letters[0]} or {letters[1]} that is not 0")
    x, y = step(command, state, first), step(command, state, second)
    # Marlin does not compare the radii: it ends the arc with a straight line to the given point.
    # The bound is that of GRBL and LinuxCNC.
    begin, end = math.hypot(i, j), math.hypot(x - i, y - j)
    error = abs(end - begin)
    if error > 0.005 and (error > 0.5 or error > 0.001 * begin):
        raise Mistake(f"the radii at the ends of the arc differ by {error:.4f} mm")


def check_radius(radius, x, y):
    """An arc with R in the plane x y; lengths in mm. If R is less than half the chord, Marlin takes
    half the chord for it."""
    if radius == 0 or (x == 0 and y == 0):
        raise Mistake("an arc with R has no radius, or ends where it begins")
    if abs(radius) < math.hypot(x, y) / 2:
        raise Mistake(f"R is less than half the chord of {math.hypot(x, y):.4f} mm")


def step(command, state, axis):
    """The way of a motion along an axis, in mm."""
    value = command.value(axis)
    if value is None:
        return 0.0
    if state.relative:
        return value * state.scale
    if state.position[axis] is None:
        raise Mistake(f"the arc begins at a position that no line has set ({axis})")
    return value * state.scale - state.position[axis]


def axes_of(command):
    """The letters of the axes that have a value: X, Y and Z first."""
    return "".join(axis for axis in "XYZABCUVW" if command.value(axis) is not None)


def execute(command, state, native):
    """The state after a command. `native` says that G53 stands before it in the line."""
    name = command.name()
    if name in ("G17", "G18", "G19"):
        state.plane = command.number
    elif name in ("G20", "G21"):
        state.scale = INCH if name == "G20" else 1.0
    elif name in ("G90", "G91"):
        state.relative = name == "G91"
    elif name in ("M3", "M4"):
        # Without S, the build states the speed: SPEED_POWER_STARTUP (src/gcode/control/M3-M5.cpp).
        state.turning = (command.value("S") or 0) > 0
    elif name == "M5":
        state.turning = False
    elif name == "G92":
        for axis in set(axes_of(command)) & set("XYZ"):
            state.position[axis] = command.value(axis) * state.scale
    elif name in ("G0", "G1", "G2", "G3"):
        execute_motion(command, state, native)
    elif name == "G53" or 54 <= command.number <= 59 and command.letter == "G":
        if name != state.offset:
            state.forget("XYZ")
        state.offset = name
    elif command.letter == "G" and name not in ("G4", "G80"):
        state.forget("XYZ")


def execute_motion(command, state, native):
    """The position after a motion, and the source of the feed."""
    if command.value("F") is not None:
        state.fed = command.number != 0
    for axis in set(axes_of(command)) & set("XYZ"):
        if native:
            state.position[axis] = None
        elif not state.relative:
            state.position[axis] = command.value(axis) * state.scale
        elif state.position[axis] is not None:
            state.position[axis] += command.value(axis) * state.scale


# Programs -----------------------------------------------------------------------------------------

# The plane must be written before the first arc only: a build without CNC_WORKSPACE_PLANES has no
# G17, and always the plane x y.
MODES = {"distance mode": "G90", "unit": "G21"}
MODE_OF = {17: "plane", 18: "plane", 19: "plane", 20: "unit", 21: "unit"}
MODE_OF.update({90: "distance mode", 91: "distance mode"})


def demand(command, state, native, program, number):
    """Tells the demands on the whole program what a command does; `state` is the state before."""
    name = command.name()
    if command.letter == "G" and command.number in MODE_OF:
        program.writes([MODE_OF[command.number]])
    forbidden = "selects an extruder" if command.letter == "T" else FORBIDDEN.get(name)
    if forbidden:
        program.mistakes.append((number, f"{name} {forbidden}, which no part program may do"))
    if name == "G53" and not native:
        program.mistakes.append((number, "G53 alone in a line takes the work offset away for good"))
    axes = axes_of(command)
    if name not in ("G0", "G1", "G2", "G3") or not (axes or name in ("G2", "G3")):
        return
    z = command.value("Z")
    system = None if state.relative else "G53" if native else state.offset
    z = None if z is None else z * state.scale
    program.moves(number, Motion(axes or "XY", name == "G0", z, system))
    if name == "G0":
        if command.value("F") is None:
            program.mistakes.append((number, "the rapid has no F of its own"))
        return
    if command.value("F") is None and not state.fed:
        program.mistakes.append((number, "the cut has no feed but that of a rapid before, or none"))
        state.fed = True
    if name in ("G2", "G3") and "plane" not in program.written and not state.told:
        program.mistakes.append((number, "the first arc comes before the plane is written (G17)"))
        state.told = True
    program.cuts(number, state.turning)


def check_line(text, state, build, program, number):
    """Checks the command of a line, and executes it."""
    command = read_command(text)
    native = False
    if command.name() == "G53" and " " in text:
        # src/gcode/parser.cpp, `chain`: the rest after the first space is a command of its own.
        check_known(command, build)
        command, native = read_command(text.partition(" ")[2].lstrip(" ")), True
        if command.name() not in ("G0", "G1"):
            raise Mistake(f"{command.name()} stands after G53")
    check_words(command)
    check_known(command, build)
    check_command(command, state, build)
    if program:
        demand(command, state, native, program, number)
    execute(command, state, native)


def check(path, program, needs):
    """The mistakes of a file, pairs of a line and a text. Adds to `needs` what the build must
    have: options, each with the first line that needs it and the reason."""
    state, last, mistakes = State(), None, []
    with open(path, "rb") as file:
        lines = lines_of(file.read())
    for number, raw in lines:

        def build(option, reason, number=number):
            needs.setdefault(option, (number, reason))

        try:
            text, last = without_number(stripped(raw, build).lstrip(" "), last)
            if text:
                check_line(text, state, build, program, number)
        except Mistake as mistake:
            mistakes.append((number, str(mistake)))
    return mistakes + (program.end() if program else [])


BUILD = ("--build", "list what the build of Marlin must have for the file")


def main():
    options = arguments("Checks G-code files by the rules of Marlin 2.", PROGRAM, BY_HAND, BUILD)
    wrong = False
    for path in options.files:
        program = Program(MODES, options.spindle_by_hand) if options.program else None
        needs = {}
        wrong |= report(path, check(path, program, needs))
        if options.build:
            for option, (line, reason) in needs.items():
                print(f"{path}: the build must have {option}, for {reason} in line {line}")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
