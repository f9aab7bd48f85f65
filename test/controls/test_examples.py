"""Tests of examples.py, with a false `partc` that writes given files and reports.

    python3 -B -m unittest discover -s test/controls
"""

import io
import os
import sys
import tempfile
import unittest
from contextlib import redirect_stdout
from unittest import mock

import examples

PART = """-- A plate, tool 9 mill
tool 2 mill(diameter 6 mm)   -- tool 8
spindle cw 3000 rpm
change  5 drill(diameter 3 mm) at (0, 0)
change 2 mill(diameter 6 mm)
"""
GRBL = "G21 G17 G90 G94\nG54\nG0 Z30\nS900 M3\nG4 P3\nG0 X1 Y1\nG0 Z5\nG1 Z-1 F100\nG0 Z30\nM5\nM2\n"
MARLIN = "G21\nG17\nG90\nG54\nG0 Z30 F900\nM3 S900\nG0 X1 F900\nG1 Z-1 F100\nG0 Z30 F900\nM5\n"
LINUXCNC = "G21 G17 G90 G94 G40\nG54\nG61\nG53 G0 Z0\nT2 M6\nG43 H2\nM3 S9\nG0 X1\nG1 Z-1 F9\nM2\n"
# A false partc: writes what its folder has for a control, and says what the folder has for it.
FALSE_PARTC = """#!/bin/sh
here=$(dirname "$0")
while [ "$1" != -t ]; do command=${command:-$1}; shift; done
control=$2
if [ "$command" = verify ]; then
  cat "$here/verified"
  exit 0
fi
cat "$here/$control.reports" >&2 2>/dev/null
[ -e "$here/$control.text" ] || exit 1
cp "$here/$control.text" "$4/plate.$control.nc"
"""
VERIFIED = "frames read back    12\nmisses its end by   x 0\nverdict             proven\n"


class Pieces(unittest.TestCase):
    """Functions that read programs, reports and names."""

    def test_tools(self):
        self.assertEqual(examples.turns_of(PART), [2, 5, 2])
        self.assertEqual(examples.turns_of("tool mill(diameter 3 mm)\n"), [])
        self.assertEqual(examples.tool_table([2, 1, 2]), "T1 P1 Z1.25 D0.1\nT2 P2 Z1.5 D0.1\n")

    def test_by_hand(self):
        self.assertFalse(examples.is_by_hand(PART + "-- spindle manual\n"))
        self.assertTrue(examples.is_by_hand(PART + "spindle   manual  -- a router\n"))

    def test_codes(self):
        text = "a.part:3:1: error: one [E0516]\na.part:4:1: warning: two [W0403]\n"
        self.assertEqual(examples.codes_of(text + text), ["E0516"])

    def test_frames(self):
        self.assertEqual(examples.frames_of(VERIFIED), 12)
        self.assertIsNone(examples.frames_of(VERIFIED.replace("proven", "WRONG")))

    def test_order(self):
        run = ["a.grbl.T1.nc", "a.grbl.T2.nc", "a.grbl.T1-2.nc", "a.grbl.T10.nc"]
        self.assertEqual(examples.in_order(sorted(run), [1, 2, 1, 10]), run)


class Whole(unittest.TestCase):
    """Runs of the script in a folder with two equal parts and a false partc."""

    maxDiff = None

    def run_in(self, files, parts=2, record=False):
        """Status and lines of a run. `files` maps names in the folder of partc to texts."""
        with tempfile.TemporaryDirectory() as folder:
            known = {"linuxcnc-mill.text": LINUXCNC, "grbl.text": GRBL, "marlin.text": MARLIN,
                     "verified": VERIFIED, "haas.reports": "a.part:1:1: error: no [E0516]\n",
                     "fanuc.text": "%\n", "partc": FALSE_PARTC}
            known.update({f"p{n}.part": PART for n in range(parts)})
            known.update(files)
            for name, text in known.items():
                if text is not None:
                    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                        file.write(text)
            partc = os.path.join(folder, "partc")
            os.chmod(partc, 0o755)
            out, arguments = io.StringIO(), ["examples.py", "--parts", folder, partc]
            with mock.patch.object(sys, "argv", arguments), redirect_stdout(out), \
                    mock.patch.object(examples, "LEAST", 2):
                with mock.patch.dict(os.environ, {"PARTC_RECORD": "1"} if record else {}):
                    if not record:
                        os.environ.pop("PARTC_RECORD", None)
                    with self.assertRaises(SystemExit) as end:
                        examples.main()
        lines = [line.replace(folder + "/", "") for line in out.getvalue().splitlines()]
        return end.exception.code, [line for line in lines if not line.startswith("rs274 is")]

    table = ["part  linuxcnc-mill  grbl  marlin  haas   fanuc"]
    table += [f"p{n}    12             12    12      E0516  12" for n in range(2)]
    expected = {"expected.txt": "\n".join(table) + "\n"}

    def complains(self, files, *mistakes, parts=2):
        """Compares the lines below the table."""
        status, lines = self.run_in({**self.expected, **files}, parts)
        self.assertEqual(lines[parts + 1:], list(mistakes))
        self.assertEqual(status, 1)

    def test_right(self):
        self.assertEqual(self.run_in(self.expected), (0, self.table))
        self.assertEqual(self.run_in({}, record=True), (0, self.table))

    def test_table(self):
        self.complains(
            {"expected.txt": self.expected["expected.txt"].replace("p1    12", "p1    13")},
            f"expected.txt has the line: {self.table[2].replace('p1    12', 'p1    13')}",
            f"expected.txt lacks the line: {self.table[2]}",
        )
        self.complains({"expected.txt": None},
                       "expected.txt is missing; PARTC_RECORD=1 writes it")

    def test_checker(self):
        text = ": a cut, but no M3 or M4 with S above 0 is in effect"
        grbl = GRBL.replace("S900 M3\n", "")
        self.complains({"grbl.text": grbl},
                       *(f"p{n} for grbl: plate.grbl.nc:7{text}" for n in range(2)))
        marlin = MARLIN.replace("M3 S900\n", "")
        self.complains({"marlin.text": marlin},
                       *(f"p{n} for marlin: plate.marlin.nc:7{text}" for n in range(2)))

    @unittest.skipUnless(examples.shutil.which("rs274"), "rs274 is not installed")
    def test_linuxcnc(self):
        self.complains(
            {"linuxcnc-mill.text": LINUXCNC.replace("M3 S9\n", "")},
            *(f"p{n} for linuxcnc-mill: plate.linuxcnc-mill.nc: call 43: a cut, but the spindle "
              "does not turn" for n in range(2)),
        )

    def test_proof(self):
        status, lines = self.run_in({"verified": VERIFIED.replace("proven", "WRONG")})
        self.assertEqual(status, 1)
        self.assertIn("p0 for fanuc: not proven: no report", lines)

    def test_main_control(self):
        warning = "a.part:1:1: warning: beware [W0403]"
        self.complains({"linuxcnc-mill.reports": warning + "\n"},
                       *(f"p{n} for linuxcnc-mill: {warning}" for n in range(2)))

    def test_count(self):
        status, lines = self.run_in({}, parts=1, record=True)
        self.assertEqual(status, 1)
        self.assertEqual(lines[2:], [f"{c}: 1 parts are compiled, not 2"
                                      for c in ("linuxcnc-mill", "grbl", "marlin")])


if __name__ == "__main__":
    unittest.main()
