"""Tests of the checkers for GRBL and Marlin: small right and wrong programs for every rule.

    python3 -B -m unittest discover -s test/controls
"""

import os
import subprocess
import sys
import tempfile
import unittest

import common
import grbl
import marlin

HERE = os.path.dirname(os.path.abspath(__file__))


def mistakes_of(check, text):
    """The mistakes that a check of a file finds in a text, as lines "LINE: WHAT"."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "program")
        with open(path, "wb") as file:
            file.write(text if isinstance(text, bytes) else text.encode())
        return [f"{line}: {what}" for line, what in sorted(check(path))]


class Case(unittest.TestCase):
    """Programs with the mistakes that a checker must find."""

    maxDiff = None

    def judge(self, text, *expected):
        """Compares the mistakes of a program, whose lines may be separated by "|"."""
        if isinstance(text, str):
            text = text.replace("|", "\n")
        with self.subTest(text):
            self.assertEqual(self.mistakes(text), list(expected))


class Grbl(Case):
    """The rules of GRBL, line by line."""

    def mistakes(self, text):
        return mistakes_of(lambda path: grbl.check(path, None), text)

    def test_lines(self):
        self.judge("G0" + " " * 90 + "Y1")
        self.judge("G1 F100 X1 ; " + "long comment " * 20)
        self.judge("G4 P" + "0" * 7 + "1" + " (" + "x" * 100 + ")")
        self.judge("G0X1\rG0X2\r\n\r\nG9", "4: G9 is no command of GRBL")
        self.judge("$H", "1: a system command ($) is no part of a program")

    def test_longest_line(self):
        line = "G0X100.000Y100.000Z100.000G17G21G90G94G54G40M5M9F1000.00S1000.00T1N1000G61"
        self.assertEqual(len(line), 74)
        longest = line.replace("N1000", "N0001000") + "M0"
        self.judge("(79)" + longest + "//(c)   ")
        self.judge(" ".join(longest) + "; comment")
        self.judge(longest + "0",
                   "1: the line has 80 characters without spaces and comments, more than 79")

    def test_acting_characters(self):
        self.judge("(why?)", "1: ? acts in real time: a status report")
        self.judge("; stop! go~", *(f"1: {text}" for text in (
            "! acts in real time: a feed hold",
            "~ acts in real time: a cycle start",
        )))
        self.judge(b"G0 X1\x18", "1: 0x18 acts in real time: a reset")
        self.judge(
            "(ø)",
            "1: 0xB8 acts in real time: an override, or it is lost",
            "1: 0xC3 acts in real time: an override, or it is lost",
        )
        self.judge("!!!", "1: ! acts in real time: a feed hold")

    def test_comments(self):
        self.judge("(a)G0(b)X1(c ; d)Y2;e (f|; ) (")
        self.judge("G0 (a (b) X1")
        self.judge("G0 (a (b) X1)", "1: ) stands where a word begins with a letter")
        self.judge("G0 X1 (a",
                   "1: the comment is not closed, and the rest of the line belongs to it")
        self.judge("/G0 X1")
        self.judge("%", "1: % stands where a word begins with a letter")

    def test_words(self):
        self.judge("g0x1y-2.5z+.5|N9999999 G0 X1.|N10000000|T255")
        self.judge("G0 X", "1: X has no number")
        self.judge("G0 X.", "1: X has no number")
        self.judge("G0 X1.2.3", "1: . stands where a word begins with a letter")
        self.judge("G0 X1e3", "1: E is no word of GRBL")
        self.judge("G0 X#1", "1: X has no number")
        self.judge("N10000001", "1: N is above 10000000")
        self.judge("T256", "1: T256 is above 255")
        for letter in "FNPST":
            self.judge(f"G4 P1 {letter}-1" if letter != "P" else "G4 P-1",
                       f"1: {letter}-1 is negative")
        for letter in "ABCDEHOQUVW":
            self.judge(f"{letter}1", f"1: {letter} is no word of GRBL")

    def test_numbers(self):
        self.judge("G0 X1234.567|G0 X12345678")
        self.judge("G0 X1.23456789",
                   "1: X1.23456789 has more than 8 digits, and GRBL drops the others")
        self.judge("G0 X16777217", "1: X16777217 is 16777216 in single precision")
        self.judge("G0 X65432.123", "1: X65432.123 is 65432.121 in single precision")

    def test_commands(self):
        self.judge("G17 G21 G40 G49 G54 G61 G80 G90 G91.1 G94|G18|G19|G20|G55|G56|G57|G58|G59")
        self.judge("G28.1|G30.1|G92.1|M0|M1|M3|M4|M5|M8|M9|M2|M30")
        for word in ("G5", "G41", "G42", "G43", "G43.2", "G50", "G59.1", "G61.1", "G64", "G81",
                     "G90.1", "G92.2", "G95", "G96", "G98", "G1.5", "G300", "G-1", "M6", "M48"):
            self.judge(word, f"1: {word} is no command of GRBL")
        self.judge("G43 H1", "1: G43 is no command of GRBL")
        self.judge("M3.5", "1: M3.5 is not a whole number")
        self.judge("M7", "1: M7 is no command of GRBL without ENABLE_M7")
        self.judge("M56", "1: M56 is no command of GRBL without ENABLE_PARKING_OVERRIDE_CONTROL")

    def test_groups(self):
        for first, second, group in (
            ("G17", "G18", "plane"), ("G90", "G91", "distance mode"), ("G20", "G21", "unit"),
            ("G93", "G94", "feed mode"), ("G54", "G55", "work offset"), ("M3", "M5", "spindle"),
            ("M0", "M30", "stop"), ("M8", "M9", "coolant"), ("G4", "G53", "single action"),
            ("G80", "G0", "motion"),
        ):
            self.judge(f"{first} {second}",
                       f"1: {second} is the second word of its group ({group}) in the line")
        self.judge("X1 X2", "1: X stands twice in the line")
        both = "and another command of the line both use words of axes"
        self.judge("G0 G1 X1", f"1: G1 {both}")
        self.judge("G0 G92 X1", f"1: G92 {both}")
        self.judge("G28 G1", f"1: G1 {both}")
        self.judge("G0 G43.1 Z1", f"1: G43.1 {both}")

    def test_unused_words(self):
        self.judge("G0 X1 P1", "1: no command of the line uses P")
        self.judge("G1 X1 F1 I1 R2", "1: no command of the line uses I, R")
        self.judge("G92.1 K1", "1: no command of the line uses K")
        self.judge("G17 L2", "1: no command of the line uses L")
        self.judge("G0 S1 F1 T1 N1")

    def test_feed(self):
        self.judge("G1 F100 X1|X2|G0 X3|G1 X4")
        self.judge("G1 X1", "1: the feed is undefined: no F")
        self.judge("G1", "1: the feed is undefined: no F")
        self.judge("G1 X1 F0", "1: the feed is undefined: no F")
        self.judge("G93 G1 X1 F2|X2 F3|G0 X1")
        self.judge("G93 G1 X1 F2|X2", "2: a line in G93 needs its own F")
        self.judge("F100|G93|G94 G1 X1", "3: the feed is undefined: no F")
        self.judge("F100|G93|G94 G1 X1 F5|X2")
        self.judge("F100|M30|G1 X1")

    def test_arcs(self):
        start = "G17 G90 F100|G0 X0 Y0 Z0|"
        self.judge(start + "G2 X10 I5|G3 X0 I-5 J0|G2 X0 I5|G2 Y0 I5 Z-1|G3 X3 Y3 R3|G2 X0 Y0 R-9")
        self.judge(start + "G2 I5", "3: G2 has no word of an axis")
        self.judge(start + "G2 Z1 I5", "3: G2 has no word of an axis of its plane")
        self.judge(start + "G2 X5", "3: the arc has no R, and no I or J of its plane")
        self.judge(start + "G2 X5 K5", "3: the arc has no R, and no I or J of its plane")
        self.judge(start + "G2 X5 R3 I2", "3: no command of the line uses I")
        self.judge(start + "G2 X0 I0", "3: the radius of the arc is 0")
        self.judge("G91 G2 X2 I1 F9|X1 J1 Y1")
        unset = "the arc begins at a position that no line has set"
        self.judge("G2 X2 I1 F9", f"1: {unset} (X)")
        self.judge("G0 X1|G2 X2 Y1 I1 F9", f"2: {unset} (Y)")
        self.judge(start + "G55|G2 X1 Y1 R5", f"4: {unset} (X)")
        self.judge(start + "G53 G0 X0|G2 X1 Y1 R5", f"4: {unset} (X)")
        self.judge(start + "G92 X5 Y5|G2 X7 I1")

    def test_positions(self):
        start = "F100|G0 X0 Y0 Z0|"
        unset = "the arc begins at a position that no line has set"
        self.judge(start + "G91 X5|G90 G2 X7 I1")
        self.judge("F100|G91 G0 X5|G90 G2 X7 I1", f"3: {unset} (X)")
        self.judge(start + "M30|F9 G2 X2 I1|G54 G2 X0 I-1")
        self.judge("F100|G55|G0 X0 Y0|M30|G2 X2 I1", f"5: {unset} (X)")
        self.judge(start + "G28 Z0|G2 X2 I1")
        for line in ("G28 X0", "G28", "G30", "G92.1", "G10 L2 P1 X0", "G38.2 X9"):
            self.judge(start + line + "|G2 X2 I1", f"4: {unset} (X)")
        for line in ("G43.1 Z5", "G49"):
            self.judge(start + line + "|G18 G2 X2 Z0 I1", f"4: {unset} (Z)")

    def test_radii(self):
        start = "F100|G0 X0 Y0 Z0|"
        self.judge(start + "G2 X10.0049 I5")
        self.judge(start + "G2 X10.006 I5",
                   "3: the radii at the ends of the arc differ by 0.0060 mm")
        self.judge(start + "G2 X200.09 I100")
        self.judge(start + "G2 X200.11 I100",
                   "3: the radii at the ends of the arc differ by 0.1100 mm")
        self.judge(start + "G2 X2000.4 I1000")
        self.judge(start + "G2 X2000.6 I1000",
                   "3: the radii at the ends of the arc differ by 0.6000 mm")
        self.judge("G20 F10|G0 X0 Y0|G2 X.4002 I.2")
        self.judge("G20 F10|G0 X0 Y0|G2 X.4003 I.2",
                   "3: the radii at the ends of the arc differ by 0.0076 mm")
        self.judge(start + "G2 X10 R5|G2 X0 R5")
        self.judge(start + "G2 X10.002 R5", "3: R is less than half the chord of 10.0020 mm")
        self.judge(start + "G2 X0 R5", "3: an arc with R ends where it begins, in its plane")
        self.judge(start + "G2 X0 Z1 R5", "3: an arc with R ends where it begins, in its plane")

    def test_short_arcs(self):
        start = "F100|G0 X0 Y0 Z0|"
        short = "3: the arc of 0.0010 mm is so short that it is a full circle"
        self.judge(start + "G3 Y.001 I-3000", short)
        self.judge(start + "G2 Y.001 R3000", short)
        self.judge(start + "G3 Y.001 I-1000|G2 Y0 R1000")

    def test_planes(self):
        start = "F100|G0 X0 Y0 Z0|"
        self.judge(start + "G18 G2 X10 I5|G19 G2 Y10 J5|G18 G3 X12 Z2 R2")
        self.judge(start + "G18 G2 X10 J5", "3: the arc has no R, and no K or I of its plane")
        self.judge(start + "G19 G2 X10 J5", "3: G2 has no word of an axis of its plane")

    def test_single_actions(self):
        self.judge("G4 P0.5|G10 L2 P1 X0|G10 L20 P0 Z1|G28|G91 G28 Z0|G30 X1|G92 X0 Y0")
        self.judge("G4", "1: G4 has no P")
        self.judge("G4 P3276.75|G4 P3276.8", "2: G4 waits for more than 3276.75 s")
        self.judge("G10 L2 P1", "1: G10 has no word of an axis")
        self.judge("G10 X1", "1: G10 has no P and no L")
        self.judge("G10 L2 P7 X1", "1: G10 has a P above 6")
        self.judge("G10 L1 P1 X1", "1: G10 needs L2 without R, or L20")
        self.judge("G10 L2 P1 X1 R5", "1: G10 needs L2 without R, or L20")
        self.judge("G92", "1: G92 has no word of an axis")
        self.judge("G53 G0 X1|G53 G1 X1 F5|G53 X1")
        self.judge("F1|G0 X0 Y0|G53 G2 X1 I1", "3: G53 holds for G0 and G1 only")
        self.judge("G80|G53", "2: G53 holds for G0 and G1 only")
        self.judge("G80|X1", "2: words of axes stand in a line where G80 holds")
        self.judge("G43.1 Z5|G49")
        self.judge("G43.1 X5", "1: G43.1 needs the word Z, and no other axis")
        self.judge("G43.1", "1: G43.1 needs the word Z, and no other axis")
        self.judge("G38.2 Z-5 F10|G38.5 Z1")
        self.judge("G38.2 Z-5", "1: the feed is undefined: no F")
        self.judge("G38.1 Z-5 F1", "1: G38.1 is no command of GRBL")
        self.judge("G38.2 F1", "1: G38 has no word of an axis")
        self.judge("G0 Z1|G38.3 Z1 F1", "2: G38 ends where it begins")

    def test_a_wrong_line_does_nothing(self):
        self.judge("G0 X0 Y0|G1 X50|G2 X10 I5 F10", "2: the feed is undefined: no F")


class GrblProgram(Case):
    """The demands on a whole program for GRBL."""

    head = "G17 G21 G90 G94|G53 G0 Z0|M3 S1000|G4 P2|"

    def mistakes(self, text):
        return mistakes_of(lambda path: grbl.check(path, common.Program(grbl.MODES, False)), text)

    def test_right(self):
        self.judge(self.head + "G0 X1 Y1|Z5|G1 Z-1 F50|G2 X3 I1|G53 G0 Z0|M5|M30")
        self.judge("G17 G21 G90 G94 G0 Z5|X1|M4 S1|G1 Z-1 F50|G0 Z5|G1 X1 M30")
        self.judge("G17 G20 G91 G94|G28 Z0|G90|G0 X1")
        self.judge("G17 G21 G91 G94|G0 Z1|G90 X1")
        self.judge("; nothing")

    def test_modes(self):
        before = "the first motion comes before the"
        self.judge(
            "G53 G0 Z0|G17 G21 G90 G94|G0 X1",
            f"1: {before} distance mode is written (G90)",
            f"1: {before} feed mode is written (G94)",
            f"1: {before} plane is written (G17)",
            f"1: {before} unit is written (G21)",
        )
        self.judge("G17 G21 G90|G53 G0 Z0", f"2: {before} feed mode is written (G94)")

    def test_start(self):
        modes = "G17 G21 G90 G94|"
        alone = "2: the first motion is not along z alone"
        self.judge(modes + "G0 X1", alone)
        self.judge(modes + "G0 X1 Z5", alone)
        self.judge(modes + "G28", alone)
        self.judge(modes + "G0 Z2|X1|Z5", "2: the first motion goes to z 2, and line 4 goes higher")
        self.judge(modes + "G53 G0 Z-5|X1|G53 Z0",
                   "2: the first motion goes to z -5, and line 4 goes higher")
        self.judge(modes + "G53 G0 Z-5|X1|Z5|G53 Z-5")
        self.judge("G17 G21 G91 G94|G0 Z-1", "2: the first motion goes to z -1, not upwards")
        self.judge("M3 S1|" + modes + "G1 Z5 F10", "3: the first motion is no rapid")

    def test_spindle(self):
        cut = "a cut, but no M3 or M4 with S above 0 is in effect"
        modes = "G17 G21 G90 G94|G53 G0 Z0|"
        self.judge(modes + "G1 Z1 F10|X2", f"3: {cut}")
        self.judge(modes + "M3|G1 Z1 F10", f"4: {cut}")
        self.judge(modes + "M3 S0|G1 Z1 F10|S5|X1|M5|X2", f"4: {cut}", f"8: {cut}")
        self.judge(self.head + "G1 X1 F1 M5", f"5: {cut}")
        self.judge(self.head + "M30|G17|X1 F1|X2", f"7: {cut}")

    def test_by_hand(self):
        text = "G17 G21 G90 G94\nG53 G0 Z0\nG1 Z-1 F10\n"
        found = mistakes_of(lambda path: grbl.check(path, common.Program(grbl.MODES, True)), text)
        self.assertEqual(found, [])


class Marlin(Case):
    """The rules of Marlin, line by line."""

    def mistakes(self, text):
        return mistakes_of(lambda path: marlin.check(path, None, {}), text)

    def test_lines(self):
        self.judge("G0 X1 ; comment é (\n  G0 X1  \n\n; only\n(brackets) G0 X1 (too)")
        longest = "M117 " + "x" * 90
        self.judge(longest + " ; " + "y" * 100)
        self.judge(longest + "x", "1: the command has 96 characters, more than 95")
        self.judge("G0 X1 (a",
                   "1: the comment is not closed, and the rest of the line belongs to it")
        self.judge("G0\tX1", "1: the byte 0x09 stands outside a comment")
        self.judge("M117 é", "1: the byte 0xC3 stands outside a comment")
        self.judge("M117 a\\b", "1: a backslash stands outside a comment, and Marlin drops it")

    def test_line_numbers(self):
        self.judge("N1 G21*27|N2 G90*18|N3 M110 N7*121|N8 G21*18")
        self.judge("N1 G21", "1: a line number (N) without a checksum (*)")
        self.judge("G21 *3", "1: a checksum (*) without a line number")
        self.judge("N1 G21*18", "1: the checksum is not 27")
        self.judge("N1 G21*27|N4 G90*20", "2: the line number is 4, not 2")

    def test_commands(self):
        self.judge("G0 X1|G1 X2 F5|G4 P1|G17|G18|G19|G20|G21|G53|G54|G59.3|G90|G91|G92 X0|G92.1")
        self.judge("M0|M1|M3 S9|M4 S9|M5|M7|M8|M9|M17|M84|M105|M114|M117 hi|M118 hi|M400|T0")
        self.judge("G38.2 Z-1|G28 X|M104 S0 T1|M106 P1 S255|M220 S100")
        for word in ("G40", "G43", "G49", "G64", "G93", "G94", "G98", "G38", "G38.6", "G1.2", "M2",
                     "M6", "M48.1", "M99", "M202"):
            end = "" if "." in word else ", which echoes it and goes on"
            self.judge(word, f"1: {word} is no command of Marlin{end}")
        self.judge("M30", "1: M30 deletes a file, and ends no program")
        self.judge("M117 G1|M118 M30")
        self.judge("M30 part.gco", "1: M30 deletes a file, and ends no program")
        none = "the line begins with no command G, M or T"
        self.judge("X1 Y2", f"1: {none}: X1")
        self.judge("%", f"1: {none}: %")
        self.judge("O1000", f"1: {none}: O1000")
        self.judge("g0 X1", f"1: {none}: g0")
        self.judge("F100", f"1: {none}: F100")

    def test_one_command_a_line(self):
        self.judge("G21 G90", "1: G90 is read as a word of G21, not as a command")
        self.judge("G1 X1 F9 M5", "1: M5 is read as a word of G1, not as a command")
        self.judge("M3 S9 G4 P1", "1: G4 is read as a word of M3, not as a command")
        self.judge("G43.1 G0", "1: G0 is read as a word of G43.1, not as a command")
        self.judge("G53 G0 Z0|G53 G1 X1 F9|G53  G0 X1")
        self.judge("G53G0", "1: G0 is read as a word of G53, not as a command")
        self.judge("G53G0 Z0", "1: the line begins with no command G, M or T: Z0")
        self.judge("G53 G0 G1 X0", "1: G1 is read as a word of G0, not as a command")
        self.judge("G53 G2 X1", "1: G2 stands after G53")

    def test_words(self):
        self.judge("G1 X1Y2 Z 3 A4 E5 F9")
        self.judge("G1 X1 H2", "1: G1 does not use H, and passes over it")
        self.judge("G0 K2", "1: G0 does not use K, and passes over it")
        self.judge("G90 X1", "1: G90 does not use X, and passes over it")
        self.judge("M5 S0", "1: M5 does not use S, and passes over it")
        self.judge("G1 X1 X2", "1: X stands twice in the line")
        self.judge("G1 X", "1: X has no number")
        self.judge("G1 X1 y2", "1: G1 passes over y")
        self.judge("G1 X1-2", "1: G1 passes over -")
        self.judge("M3 I|M5 I")
        self.judge("G1 X1 F0", "1: F is not above 0, and Marlin passes over it")

    def test_dwell_and_stops(self):
        self.judge("G4 P1500|G4 S1.5|M0 P100|M0 S5 Insert the tool|M1 Turn the part (side 2)")
        self.judge("G4", "1: G4 needs P, in ms, or S, in s")
        self.judge("G4 P1 S1", "1: G4 needs P, in ms, or S, in s")
        self.judge("G4 P0.5", "1: P of G4 is in ms, and Marlin cuts its decimals off")
        self.judge("G4 S-1", "1: the time of G4 is negative")
        self.judge("M0 Clamp S3", "1: M0 waits for S3 only, from its message")
        self.judge("M1 side P2", "1: M1 waits for P2 only, from its message")
        self.judge("M3 S-5", "1: S of M3 is negative")

    def test_arcs(self):
        start = "G0 X0 Y0 Z0|"
        self.judge(start + "G2 X10 I5|G3 I-5|G2 X10 Y9 R8|G3 X0 Y0 R-9 F5|G2 Z5 I1 P3")
        self.judge("G91|G2 X2 I1 J0")
        unset = "the arc begins at a position that no line has set"
        self.judge("G2 X2 I1", f"1: {unset} (X)")
        self.judge(start + "G54|G2 X2 I1", f"3: {unset} (X)")
        self.judge(start + "G53 G0 Y5|G2 X2 Y5 I1", f"3: {unset} (Y)")
        self.judge(start + "G92 X5|G2 X7 I1")
        self.judge(start + "G2 X5", "2: an arc needs R, or I or J that is not 0")
        self.judge(start + "G2 X5 I0", "2: an arc needs R, or I or J that is not 0")
        self.judge(start + "G2 X5 R5 I1", "2: an arc has R and I")
        self.judge(start + "G2 X5 I2.5 K1",
                   "2: K is no offset of the plane, and Marlin passes over it")
        self.judge(start + "G2 X5 R0", "2: an arc with R has no radius, or ends where it begins")
        self.judge(start + "G2 X0 R5", "2: an arc with R has no radius, or ends where it begins")
        self.judge(start + "G2 X9 R4", "2: R is less than half the chord of 9.0000 mm")
        self.judge(start + "G2 X10.006 I5",
                   "2: the radii at the ends of the arc differ by 0.0060 mm")
        self.judge(start + "G2 X10.0049 I5")
        circles = "2: P of an arc is no whole number from 0 to 100"
        self.judge(start + "G2 I5 P101", circles)
        self.judge(start + "G2 I5 P1.5", circles)

    def test_positions(self):
        unset = "the arc begins at a position that no line has set"
        self.judge("G0 X0 Y0|G91|G0 X5|G90|G2 X7 I1|G4 S1|G2 X5 I-1")
        self.judge("G91|G0 X5|G90|G2 X7 I1", f"4: {unset} (X)")
        self.judge("G54|G0 X0 Y0|G54|G2 X2 I1")
        self.judge("G54|G0 X0 Y0|G55|G2 X2 I1", f"4: {unset} (X)")
        self.judge("G0 X0 Y0|G28|G2 X2 I1", f"3: {unset} (X)")
        self.judge("G20|G0 X0 Y0|G2 X.4003 I.2",
                   "3: the radii at the ends of the arc differ by 0.0076 mm")

    def test_planes(self):
        start = "G0 X0 Y0 Z0|"
        self.judge(start + "G18|G2 X10 I5|G19|G2 Y10 J5|G3 Z4 K2")
        self.judge(start + "G18|G2 X10 R9",
                   "3: an arc with R is computed in the plane x y, whatever plane holds")
        self.judge(start + "G18|G2 X10 J5",
                   "3: J is no offset of the plane, and Marlin passes over it")

    def test_build(self):
        needs = {}
        text = ("G20\nG17\nG54\nM3 S200\nM7\nG2 X1 I1 J0 P2\nG38.2 Z1\n(a)\nG1 A1 F9\n"
                "M4 S12000\nM0\nG1 X1\nM400\nG59.1\n")
        mistakes_of(lambda path: marlin.check(path, None, needs), "G91\n" + text)
        self.assertEqual(needs, {
            "INCH_MODE_SUPPORT": (2, "G20"),
            "CNC_WORKSPACE_PLANES": (3, "G17"),
            "CNC_COORDINATE_SYSTEMS": (4, "G54"),
            "SPINDLE_FEATURE or LASER_FEATURE": (5, "M3"),
            "CUTTER_POWER_UNIT RPM or PWM255": (5, "S200 of M3"),
            "COOLANT_MIST": (6, "M7"),
            "ARC_SUPPORT": (7, "G2"),
            "ARC_P_CIRCLES": (7, "P of G2"),
            "G38_PROBE_TARGET": (8, "G38.2"),
            "PAREN_COMMENTS": (9, "comments in round brackets"),
            "an axis A": (10, "G1"),
            "CUTTER_POWER_UNIT RPM": (11, "S12000 of M4"),
            "HAS_RESUME_CONTINUE (a display, or EMERGENCY_PARSER)": (12, "M0"),
        })


class MarlinProgram(Case):
    """The demands on a whole program for Marlin."""

    head = "G21|G90|G17|G0 Z20 F600|M3 S12000|G4 S3|G0 X0 Y0 F3000|"

    def mistakes(self, text):
        program = common.Program(marlin.MODES, False)
        return mistakes_of(lambda path: marlin.check(path, program, {}), text)

    def test_right(self):
        self.judge(self.head + "G1 Z-1 F50|G2 X5 I2.5|G1 X1|G0 Z20 F600|M5|M400|M84 X",
                   "14: M84 switches motors or power off, which no part program may do")
        self.judge(self.head + "G1 Z-1 F50|G2 X5 I2.5|G1 X1|G0 Z20 F600|M5|M400")
        self.judge("G20|G91|G0 Z1 F20")
        self.judge("G21|G90|G53 G0 Z100 F600|G54|G0 X1 F600|G0 Z120 F600")

    def test_start(self):
        before = "the first motion comes before the"
        self.judge("G21|G0 Z1 F5", f"2: {before} distance mode is written (G90)")
        self.judge("G90|G0 Z1 F5", f"2: {before} unit is written (G21)")
        alone = "3: the first motion is not along z alone"
        self.judge("G21|G90|G0 X1 F5", alone)
        self.judge("G21|G90|G0 Z5 X1 F5", alone)
        self.judge("G21|G90|G0 Z5 F9|G0 Z6 F9",
                   "3: the first motion goes to z 5, and line 4 goes higher")
        self.judge("G21|G91|G0 Z-5 F9", "3: the first motion goes to z -5, not upwards")
        self.judge("G21|G90|M3 S9|G1 Z5 F9", "4: the first motion is no rapid")

    def test_feeds(self):
        self.judge(self.head + "G0 X1", "8: the rapid has no F of its own")
        none = "the cut has no feed but that of a rapid before, or none"
        self.judge(self.head + "G1 Z-1|G1 X2", f"8: {none}")
        self.judge(self.head + "G1 Z-1 F50|G0 Z5 F600|G1 Z-1", f"10: {none}")
        self.judge("G21|G90|G0 Z5 F9|M3 S9|G1 F50|G1 X1")

    def test_spindle(self):
        cut = "a cut, but no M3 or M4 with S above 0 is in effect"
        start = "G21|G90|G0 Z5 F9|"
        self.judge(start + "G1 X1 F9|G1 X2", f"4: {cut}")
        self.judge(start + "M3|G1 X1 F9", f"5: {cut}")
        self.judge(start + "M3 S0|G1 X1 F9", f"5: {cut}")
        self.judge(start + "M4 S9|G1 X1 F9|M5|G1 X2", f"7: {cut}")

    def test_arcs(self):
        text = "G21|G90|G0 Z5 F9|M3 S9|G0 X0 Y0 F9|"
        self.judge(text + "G2 I1 F9|G2 I1",
                   "6: the first arc comes before the plane is written (G17)")
        self.judge(text + "G17|G2 I1 F9")

    def test_forbidden(self):
        for word, reason in (
            ("G28", "homes"), ("G30", "probes"), ("G61", "goes to a stored position"),
            ("G10", "retracts filament"), ("T1", "selects an extruder"), ("M81",
             "switches motors or power off"), ("M502", "changes the stored settings"),
        ):
            self.judge(word, f"1: {word} {reason}, which no part program may do")
        self.judge("G53", "1: G53 alone in a line takes the work offset away for good")


class Commands(unittest.TestCase):
    """The scripts as commands: their output, their flags and their status."""

    def run_script(self, script, text, *flags, **environment):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "program.ngc")
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            names = [path if flag == "FILE" else flag for flag in flags]
            run = subprocess.run(
                [sys.executable, "-B", os.path.join(HERE, script), *names],
                capture_output=True, encoding="utf-8", check=False,
                env={**os.environ, **environment},
            )
        return run.returncode, run.stdout.replace(path, "FILE"), run.stderr

    def test_grbl(self):
        self.assertEqual(self.run_script("grbl.py", "G0 X1\n", "FILE"), (0, "", ""))
        self.assertEqual(self.run_script("grbl.py", "\nG64\n", "FILE", "FILE"),
                         (1, "FILE:2: G64 is no command of GRBL\n" * 2, ""))
        status, out, _ = self.run_script("grbl.py", "G0 X1\n", "--program", "FILE")
        self.assertEqual((status, out.count("\n")), (1, 5))
        by_hand = ("--program", "--spindle-by-hand", "FILE")
        text = "G17 G21 G90 G94\nG53 G0 Z0\nG1 Z-1 F9\n"
        self.assertEqual(self.run_script("grbl.py", text, *by_hand), (0, "", ""))

    def test_marlin(self):
        self.assertEqual(self.run_script("marlin.py", "G0 X1\n", "FILE"), (0, "", ""))
        self.assertEqual(self.run_script("marlin.py", "M30\n", "FILE"),
                         (1, "FILE:1: M30 deletes a file, and ends no program\n", ""))
        self.assertEqual(self.run_script("marlin.py", "G54\n", "--build", "FILE"), (
            0, "FILE: the build must have CNC_COORDINATE_SYSTEMS, for G54 in line 1\n", ""))
        by_hand = ("--program", "--spindle-by-hand", "FILE")
        text = "G21\nG90\nG0 Z1 F9\nG1 X1 F9\n"
        self.assertEqual(self.run_script("marlin.py", text, *by_hand), (0, "", ""))
        self.assertEqual(self.run_script("marlin.py", text, "--program", "FILE")[0], 1)

    def test_linuxcnc_missing(self):
        status, out, err = self.run_script("linuxcnc.py", "M2\n", "FILE", "FILE", "mill", PATH="")
        self.assertEqual((status, out), (2, ""))
        self.assertIn("rs274 is missing", err)


if __name__ == "__main__":
    unittest.main()
