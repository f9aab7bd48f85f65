"""Parts that the checkers of GRBL and Marlin share: the lines of a file, the command line, and the
demands on a whole program.

The demands (`Program`) are those of a safe start, which no control checks:

- the first motion is a rapid along z alone, upwards;
- the words that set the modes stand in the file before the first motion, since a control keeps the
  modes of the program before;
- the spindle turns, with a speed above 0, at every cut.

Nothing in a file says where the machine stands when it starts. A rapid in absolute coordinates
counts as upwards if no later motion in the same coordinate system goes higher: then it goes upwards
from every height at which the program itself can have left the machine. A rapid in incremental
coordinates counts as upwards if its z is above 0.
"""

import argparse
import re


class Mistake(Exception):
    """What the control refuses, or passes over, in a line."""


def lines_of(data):
    """Numbers from 1 on, with the lines of a file. A carriage return ends a line too."""
    return list(enumerate(re.split(rb"\r\n|\n|\r", data), 1))


def arguments(description, *flags):
    """Arguments of the command line: the files, and flags as pairs of a name and its help."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("files", metavar="FILE", nargs="+")
    for name, text in flags:
        parser.add_argument(name, action="store_true", help=text)
    return parser.parse_args()


PROGRAM = ("--program", "demand a safe start, and a turning spindle at every cut")
BY_HAND = ("--spindle-by-hand", "the spindle is switched by hand: allow cuts without M3 and M4")


def report(path, mistakes):
    """Prints mistakes, pairs of a line and a text, in the order of lines. True if there is any."""
    for line, text in sorted(mistakes, key=lambda mistake: mistake[0]):
        print(f"{path}:{line}: {text}")
    return bool(mistakes)


class Motion:
    """One motion of a program.

    axes      the letters of the axes that have a word
    rapid     a rapid motion, not a cut
    z         the height that the word Z states, in mm, or None
    system    the coordinate system of z: a text, or None if z is incremental
    """

    def __init__(self, axes, rapid, z, system):
        self.axes, self.rapid, self.z, self.system = axes, rapid, z, system


class Program:
    """The demands on a whole program.

    modes     maps each mode that must be written to an example of its words
    by_hand   the spindle is switched by hand
    """

    def __init__(self, modes, by_hand):
        self.modes, self.by_hand = modes, by_hand
        self.written, self.mistakes = set(), []
        self.first = None
        self.heights = {}
        self.silent = False

    def writes(self, modes):
        """Modes that a line sets."""
        self.written.update(modes)

    def moves(self, line, motion):
        """A motion, after the modes of its line."""
        if self.first is None:
            self.first = (line, motion)
            self._start(line, motion)
        if motion.z is not None and motion.system is not None:
            highest = self.heights.get(motion.system)
            if highest is None or motion.z > highest[0]:
                self.heights[motion.system] = (motion.z, line)

    def _start(self, line, motion):
        if not motion.rapid:
            self.mistakes.append((line, "the first motion is no rapid"))
        if set(motion.axes) != {"Z"}:
            self.mistakes.append((line, "the first motion is not along z alone"))
        elif motion.system is None and motion.z is not None and motion.z <= 0:
            self.mistakes.append((line, f"the first motion goes to z {motion.z:g}, not upwards"))
        for mode, example in self.modes.items():
            if mode not in self.written:
                text = f"the first motion comes before the {mode} is written ({example})"
                self.mistakes.append((line, text))

    def cuts(self, line, turning):
        """A cut; `turning` says if the spindle turns. One report stands for a run of cuts."""
        if not turning and not self.by_hand and not self.silent:
            self.mistakes.append((line, "a cut, but no M3 or M4 with S above 0 is in effect"))
        self.silent = not turning

    def end(self):
        """All mistakes, after the last line."""
        if self.first is None:
            return self.mistakes
        line, motion = self.first
        highest = self.heights.get(motion.system)
        if motion.axes == "Z" and highest and highest[0] > motion.z:
            text = f"the first motion goes to z {motion.z:g}, and line {highest[1]} goes higher"
            self.mistakes.append((line, text))
        return self.mistakes
