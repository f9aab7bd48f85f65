#!/usr/bin/env python3
"""Compiles every part of examples/cnc for every control, and judges the files that come out.

    examples.py [--parts FOLDER] PARTC

Each written file goes through the checker of its control: linuxcnc.py, grbl.py --program or
marlin.py --program. There is none for haas and fanuc. `partc verify PART FILES` has to say that the
files are proven. A table shows, for each part and control, the frames that were read back and the
count of files, or the codes of the refusal. It is compared with the table in FOLDER/expected.txt;
with PARTC_RECORD=1 in the environment, that file is written instead.

The status is 1 if

- a checker or `partc verify` finds a mistake in a file;
- a part is not compiled, or gives a warning, for linuxcnc-mill;
- fewer than LEAST parts are compiled for linuxcnc-mill, for grbl or for marlin;
- the table is another one than the recorded one.

Without `rs274`, the files for LinuxCNC are not checked, and a line says so.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
CONTROLS = ("linuxcnc-mill", "grbl", "marlin", "haas", "fanuc")
# The control for the parts that name it.
LATHE = "linuxcnc-lathe"
# The control for which every part is compiled, without a warning.
MAIN = "linuxcnc-mill"
# The controls for which at least LEAST parts are compiled.
COUNTED = ("linuxcnc-mill", "grbl", "marlin")
LEAST = 10


def run(*command):
    """Status, standard output and standard error of a command."""
    done = subprocess.run(
        command, stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", check=False
    )
    return done.returncode, done.stdout, done.stderr


def statements(text):
    """The lines of a program without comments."""
    return [line.partition("--")[0].strip() for line in text.splitlines()]


def turns_of(text):
    """The numbers of the tools of a program, in the order in which they are in the spindle."""
    matches = [re.match(r"(?:tool|change)\s+(\d+)\s", line) for line in statements(text)]
    return [int(match.group(1)) for match in matches if match]


def is_by_hand(text):
    """True if the operator switches the spindle."""
    return any(re.match(r"spindle\s+manual\b", line) for line in statements(text))


def settings(text, control):
    """The options with which a part is compiled: threads are milled where the control cannot tap."""
    mills = control in ("grbl", "marlin") and re.search(r"^param\s+milled\b", text, re.MULTILINE)
    return ["--set", "milled=true"] if mills else []


def tool_table(numbers):
    """A tool table of LinuxCNC, in which every tool has a length of its own."""
    return "".join(f"T{n} P{n} Z{1 + n / 4} D0.1\n" for n in sorted(set(numbers)))


def lathe_table(text):
    """A tool table of LinuxCNC for a turned part: offsets along X and Z, the diameter of the nose in
    inches and the orientation of each tool, as the part has them."""
    rows = {}
    for line in statements(text):
        match = re.match(
            r"(?:tool|change)\s+(\d+)\s+turn\(nose\s+([\d.]+)(?:\s*/\s*(\d+))?(?:\s*mm)?,\s*tip\s+(\d)\)", line
        )
        if match:
            number, nose, parts, tip = match.groups()
            inches = float(nose) / float(parts) if parts else float(nose) / 25.4
            rows[int(number)] = (inches, tip)
    return "".join(
        f"T{n} P{n} X{0.5 + n / 8} Z{1 + n / 4} D{2 * radius:.6f} Q{tip}\n"
        for n, (radius, tip) in sorted(rows.items())
    )


def is_turned(text):
    """True if a part names the lathe."""
    return any(re.match(rf"machine\s+{LATHE}\b", line) for line in statements(text))


def codes_of(reports):
    """The codes of the errors among reports of the form `short`, each once."""
    return sorted(set(re.findall(r"^\S+ error: .*\[(E\d+)\]$", reports, re.MULTILINE)))


def frames_of(table):
    """The count of frames in what `partc verify` prints; None if the files are not proven."""
    if not re.search(r"^verdict\s+proven$", table, re.MULTILINE):
        return None
    match = re.search(r"^frames read back\s+(\d+)$", table, re.MULTILINE)
    return int(match.group(1)) if match else None


def in_order(files, turns):
    """Files in the order in which they are run. Those of a tool that comes again end in T1-2."""
    names = [f"T{n}" + (f"-{turns[:at].count(n) + 1}" if n in turns[:at] else "")
             for at, n in enumerate(turns)]
    place = {name: at for at, name in enumerate(names)}
    return sorted(files, key=lambda file: (place.get(file.split(".")[-2], len(names)), file))


class Trial:
    """Trials of parts.

    partc      the program partc
    has_rs274  the interpreter of LinuxCNC is installed
    mistakes   what is wrong, one line for each
    cells      for each part and control, the text in the table
    compiled   for each control, the count of compiled parts
    """

    def __init__(self, partc):
        self.partc = partc
        self.has_rs274 = shutil.which("rs274") is not None
        self.mistakes, self.cells = [], {}
        self.compiled = dict.fromkeys((*CONTROLS, LATHE), 0)

    def try_part(self, path, control):
        """Compiles and judges a part for one control."""
        name = os.path.splitext(os.path.basename(path))[0]
        with open(path, encoding="utf-8") as file:
            options = settings(file.read(), control)
        with tempfile.TemporaryDirectory() as folder:
            status, _, reports = run(
                self.partc, *options, "compile", "--format", "short", "-t", control,
                "-o", folder + "/", path
            )
            files = [os.path.join(folder, name) for name in os.listdir(folder)]
            if status == 0:
                self.compiled[control] += 1
                self.cells[name, control] = self.judge(path, control, files)
            else:
                self.cells[name, control] = " ".join(codes_of(reports)) or f"status {status}"
            if control in (MAIN, LATHE) and (status != 0 or reports):
                said = reports.strip() or f"the status is {status}"
                self.mistakes.append(f"{name} for {control}: {said}")

    def judge(self, path, control, files):
        """The text in the table for a part that is compiled to these files."""
        name = os.path.splitext(os.path.basename(path))[0]
        with open(path, encoding="utf-8") as file:
            text = file.read()
        files = in_order(files, turns_of(text))
        for file in files:
            for complaint in self.complaints(text, control, file):
                self.mistakes.append(f"{name} for {control}: {complaint}")
        _, table, reports = run(
            self.partc, *settings(text, control), "verify", "--format", "short", "-t", control,
            path, *files
        )
        frames = frames_of(table)
        if frames is None or not files:
            said = reports.strip() or ("no report" if files else "no files")
            self.mistakes.append(f"{name} for {control}: not proven: {said}")
            return "not proven"
        return str(frames) if len(files) == 1 else f"{frames} in {len(files)}"

    def complaints(self, text, control, file):
        """What the checker of a control says about a file."""
        by_hand = ["--spindle-by-hand"] if is_by_hand(text) else []
        if control in (MAIN, LATHE):
            if not self.has_rs274:
                return []
            table = file + ".tbl"
            with open(table, "w", encoding="utf-8") as out:
                out.write(tool_table(turns_of(text)) if control == MAIN else lathe_table(text))
            kind = "mill" if control == MAIN else "lathe"
            checker = ["linuxcnc.py", *by_hand, file, table, kind]
        elif control in ("grbl", "marlin"):
            checker = [control + ".py", "--program", *by_hand, file]
        else:
            return []
        status, out, err = run(
            sys.executable, "-B", os.path.join(HERE, checker[0]), *checker[1:]
        )
        said = (out + err).replace(os.path.dirname(file) + "/", "").splitlines()
        return said if said or status == 0 else [f"{checker[0]} ends with status {status}"]

    def count(self):
        """Notes a mistake for each control with too few parts."""
        for control in COUNTED:
            if self.compiled[control] < LEAST:
                self.mistakes.append(
                    f"{control}: {self.compiled[control]} parts are compiled, not {LEAST}"
                )


def table_of(cells):
    """The table of all parts and controls: frames, with the count of files if there are several."""
    parts = sorted({part for part, _ in cells})
    controls = [*CONTROLS, *([LATHE] if any(control == LATHE for _, control in cells) else [])]
    rows = [["part", *controls]]
    rows += [[part, *(cells.get((part, control), "-") for control in controls)] for part in parts]
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    lines = ["  ".join(cell.ljust(w) for cell, w in zip(row, widths)).rstrip() for row in rows]
    return "\n".join(lines) + "\n"


def compare(table, path):
    """Mistakes of a table beside the recorded one; with PARTC_RECORD, records it."""
    if os.environ.get("PARTC_RECORD"):
        with open(path, "w", encoding="utf-8") as file:
            file.write(table)
        return []
    if not os.path.exists(path):
        return [f"{path} is missing; PARTC_RECORD=1 writes it"]
    with open(path, encoding="utf-8") as file:
        recorded = file.read().splitlines()
    now = table.splitlines()
    gone = [f"{path} has the line: {line}" for line in recorded if line not in now]
    new = [f"{path} lacks the line: {line}" for line in now if line not in recorded]
    return gone + new or ([] if now == recorded else [f"{path} has another order of lines"])


def main():
    parser = argparse.ArgumentParser(description="Tries the examples for modern controls.")
    parser.add_argument("partc", metavar="PARTC")
    default = os.path.join(HERE, "..", "..", "examples", "cnc")
    parser.add_argument("--parts", metavar="FOLDER", default=os.path.normpath(default))
    options = parser.parse_args()
    trial = Trial(options.partc)
    if not trial.has_rs274:
        print("rs274 is missing (package linuxcnc-uspace): files for LinuxCNC are not checked")
    for name in sorted(os.listdir(options.parts)):
        if name.endswith(".part"):
            path = os.path.join(options.parts, name)
            with open(path, encoding="utf-8") as file:
                turned = is_turned(file.read())
            for control in (LATHE,) if turned else CONTROLS:
                trial.try_part(path, control)
    trial.count()
    table = table_of(trial.cells)
    print(table, end="")
    mistakes = trial.mistakes + compare(table, os.path.join(options.parts, "expected.txt"))
    for mistake in mistakes:
        print(mistake)
    sys.exit(1 if mistakes else 0)


if __name__ == "__main__":
    main()
