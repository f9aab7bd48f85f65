"""Tests of linuxcnc.py: right and wrong programs, run by rs274. They are skipped if it is missing.

    python3 -B -m unittest discover -s test/controls
"""

import io
import os
import shutil
import sys
import tempfile
import unittest
from contextlib import redirect_stdout

import linuxcnc


@unittest.skipUnless(shutil.which("rs274"), "rs274 is not installed (package linuxcnc-uspace)")
class LinuxCnc(unittest.TestCase):
    """The calls of rs274."""

    maxDiff = None
    head = "G21 G90 G54 G17 G94 G40\nG64 P0.01\nG53 G0 Z0\nT1 M6\nG43 H1\n"

    def judge(self, text, *expected, kind="mill", flags=()):
        """Compares the mistakes of a program, without the numbers of calls."""
        with tempfile.TemporaryDirectory() as folder:
            path, table = os.path.join(folder, "program.ngc"), os.path.join(folder, "tools")
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            with open(table, "w", encoding="utf-8") as file:
                file.write("T1 P1 Z2 D6\nT2 P2 X1 Z1 D0.8 Q3\n")
            out, old = io.StringIO(), sys.argv
            sys.argv = ["linuxcnc.py", *flags, path, table, kind]
            try:
                with redirect_stdout(out), self.assertRaises(SystemExit) as end:
                    linuxcnc.main()
            finally:
                sys.argv = old
        found = [line.partition(": ")[2] for line in out.getvalue().splitlines()]
        found = [line.partition(": ")[2] if line.startswith("call") else line for line in found]
        self.assertEqual(found, list(expected))
        self.assertEqual(end.exception.code, 1 if expected else 0)

    def test_right_mill(self):
        cuts = "M3 S1000\nG0 X1 Y2\nG0 Z5\nG1 Z-1 F100\nG2 X3 I1 J0\nG18 G0 Z5\nG17 G1 Z2\n"
        self.judge(self.head + cuts + "G53 G0 Z0\nM5\nM2\n")
        self.judge("%\n" + self.head + cuts + "M30\n%\n")
        self.judge("%\n" + self.head.replace("G53 G0 Z0", "G91 G28 Z0\nG90") + cuts + "M2\n")
        inches = self.head.replace("G21", "G20").replace("G64 P0.01", "G61.1")
        self.judge(inches + "M4 S9\nG0 X1\nG0 Z.2\nG1 Z-.1 F9\nM2\n")

    def test_right_lathe(self):
        text = ("G21 G90 G18 G7 G94\nG61\nG53 G0 X0\nG53 G0 Z0\nT2 M6\nG43\nM3 S100\nG0 X20\n"
                "G0 Z5\nG1 Z-1 F10\nG2 X24 Z-3 K-2\nG0 X30\nM2\n")
        self.judge(text, kind="lathe")
        self.judge(text, "the first motion does not change z alone",
                   "a cut, but the plane CANON_PLANE_XY is not selected")

    def test_work_coordinates(self):
        text = "G21 G90 G17\nT1 M6\nG43 H1\nG61\nG0 Z30\nM3 S9\nG0 X1\nG1 Z-1 F9\nM2\n"
        self.judge(text, flags=["--start", "-10050"])
        self.judge(text, "the first motion goes 9894.200 mm down, not upwards")
        self.judge(text, "the first motion goes 155.800 mm down, not upwards",
                   flags=["--start", "-10", "--work", "-246.6"])

    def test_refused(self):
        self.judge("G1 X1\n", "rs274: Cannot do g1 with zero feed rate; G1 X1")
        self.judge(self.head + "G0 X1\n",
                   "rs274: File ended with no percent sign or program end; G0 X1")
        self.judge("T9 M6\nM2\n", "rs274: Requested tool 9 not found in the tool table; T9 M6")

    def test_first_motion(self):
        alone = "the first motion does not change z alone"
        end = "M2\n"
        self.judge("G21 G90\nG53 G0 X0 Y0 Z0\n" + end, alone)
        self.judge("G21 G90\nG53 G0 X0\n" + end, alone)
        self.judge("G21 G90 G61\nT1 M6\nG43 H1\nM3 S9\nG17\nG53 G1 Z0 F9\n" + end,
                   "the first motion is no rapid")
        down = "a rapid goes 5.000 mm down before the length of the tool is in use"
        self.judge("G21 G90\nG53 G0 Z-30\n" + end,
                   "the first motion goes 5.000 mm down, not upwards", down)

    def test_length(self):
        short = self.head.replace("G43 H1\n", "")
        down = "a rapid goes {} mm down before the length of the tool is in use"
        self.judge(short + "G0 X1\nG0 Z5\nM2\n", down.format("9995.000"))
        self.judge(short + "M3 S9\nG0 X1\nG1 X2 F9\nM2\n",
                   "a cut, but the length of the tool is not in use")
        cut = "M3 S9\nG0 X1\nG0 Z5\nG1 Z-1 F9\n"
        change = "G53 G0 Z0\nT2 M6\nM3 S9\nG0 X5\nG0 Z5\nM2\n"
        self.judge(self.head + cut + change, down.format("9944.200"))
        self.judge(self.head + cut + change.replace("M6", "M6 G43"))
        self.judge(self.head + "G49\nG0 Z5\nM2\n", down.format("9995.000"))

    def test_turned_coordinates(self):
        self.judge("G53 G0 Z0\nG10 L2 P1 R30\nM2\n",
                   "the coordinates are turned, which this check does not follow")

    def test_cuts(self):
        modes = "G21 G90\nG53 G0 Z0\nT1 M6\nG43 H1\nG0 X1\n"
        self.judge(modes + "G1 X2 F9\nG1 X3\nM2\n",
                   "a cut, but the path mode is not set",
                   "a cut, but the plane CANON_PLANE_XY is not selected",
                   "a cut, but the spindle does not turn")
        self.judge(modes + "G17 G64\nM3 S9\nG1 X2 F9\nM2\n",
                   "a cut, but the path mode has no bound")
        self.judge(self.head + "M3 S0\nG1 X2 F9\nM2\n", "a cut, but the spindle does not turn")
        self.judge(self.head + "M3 S9\nG1 X2 F9\nM5\nG2 X5 I1.5\nM2\n",
                   "a cut, but the spindle does not turn")
        self.judge(self.head + "M3 S9\nG18\nG1 X2 F9\nM2\n",
                   "a cut, but the plane CANON_PLANE_XY is not selected")
        self.judge(self.head + "G1 X2 F9\nM2\n", flags=["--spindle-by-hand"])


if __name__ == "__main__":
    unittest.main()
