"""Tests editors/kakoune/part.kak in a real Kakoune.

Run by scripts/editors-try.sh in the folder of the sources. PARTC_TRY_FOLDER is a folder that it may
write to. Kakoune's interface `json` says which colours it shows. If kak-lsp is installed, the
diagnostics of the language server are compared with `partc check`.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import threading
import time

FOLDER = pathlib.Path(os.environ["PARTC_TRY_FOLDER"])
# Colours by which the test tells the faces apart
FACES = {"keyword": "red", "comment": "blue", "string": "green", "value": "yellow",
         "type": "magenta", "builtin": "cyan"}


def fail(text):
    sys.exit("kakoune: " + text)


def equal(what, expected, found):
    if expected != found:
        fail(f"{what}: expected {expected!r}, found {found!r}")


class Kakoune:
    """A Kakoune with one open file."""

    def __init__(self, file, *commands):
        faces = [f"set-face global {face} {colour}" for face, colour in FACES.items()]
        begin = ["source editors/kakoune/part.kak", *faces, *commands, f"edit '{file}'"]
        self.process = subprocess.Popen(["kak", "-ui", "json", "-e", "; ".join(begin)],
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.screen = []
        self.status = ""
        threading.Thread(target=self.read, daemon=True).start()
        wait("the start of Kakoune", lambda: self.screen)
        self.send("resize", 200, 200)

    def read(self):
        for line in self.process.stdout:
            message = json.loads(line)
            if message["method"] == "draw":
                self.screen = message["params"][0]
            if message["method"] == "draw_status":
                self.status = "".join(atom["contents"] for atom in message["params"][0])

    def send(self, method, *params):
        text = json.dumps({"jsonrpc": "2.0", "method": method, "params": params})
        self.process.stdin.write(text.encode() + b"\n")
        self.process.stdin.flush()

    def keys(self, *keys):
        self.send("keys", *keys)

    def command(self, text):
        self.keys("<esc>", ":", *(key(letter) for letter in text), "<ret>")

    def expand(self, text):
        """The value of a text with expansions, such as %opt{filetype}."""
        answer = FOLDER / "answer"
        answer.unlink(missing_ok=True)
        self.command(f"echo -to-file '{answer}' -- {text} .")
        wait(f"the answer to {text}", lambda: answer.exists() and answer.read_text().endswith(" ."))
        return answer.read_text()[:-2]

    def colour(self, line, word):
        """The colour of a word in the first line of the screen that begins with a text and then has the word."""
        for atoms in self.screen:
            text = "".join(atom["contents"] for atom in atoms)
            if text.startswith(line) and word in text[len(line):]:
                at = text.index(word, len(line))
                for atom in atoms:
                    if at < len(atom["contents"]):
                        return atom["face"]["fg"]
                    at -= len(atom["contents"])
        fail(f"the screen has no {word} after {line}")

    def quit(self):
        self.command("quit!")
        try:
            equal("status of Kakoune", 0, self.process.wait(10))
        except subprocess.TimeoutExpired:
            self.process.kill()
            fail(f"Kakoune does not end ({self.status})")


def key(letter):
    """The key that types a letter."""
    return {"\n": "<ret>", "<": "<lt>", " ": "<space>", "-": "<minus>"}.get(letter, letter)


def wait(what, condition):
    end = time.time() + 20
    while not condition():
        if time.time() > end:
            fail(what + " did not happen")
        time.sleep(0.05)


def colours():
    file = FOLDER / "рычаг.part"
    shutil.copy("examples/рычаг.part", file)
    kakoune = Kakoune(file)
    equal("file type", "part", kakoune.expand("%opt{filetype}"))
    wait("the drawing of the program", lambda: len(kakoune.screen) > 40)
    for line, word, face in [
        ("", "Рычаг: две", "comment"),
        ("part рычаг ", '"Рычаг', "string"),
        ("", "tolerance", "keyword"),
        ("machine", "lkp", "value"),
        ("feed", "60", "value"),
        ("feed      60 ", "mm/min", "type"),
        ("let палец", "polar", "builtin"),
        ("    depth    8 ", "step", "keyword"),
        ("  lead in    ", "arc", "keyword"),
        ("  cw ступица ", "fillet", "keyword"),
        ("let ", "ось", None),
    ]:
        equal(f"colour of {word}", FACES.get(face, "default"), kakoune.colour(line, word))
    kakoune.quit()


def typing():
    file = FOLDER / "typed.part"
    kakoune = Kakoune(file)
    kakoune.keys("i", *(key(letter) for letter in
                        "contour a closed {  -- c\nfor p in [p, q] {\np\n}\n}"))
    kakoune.command("write")
    wait("the typed text", file.exists)
    kakoune.expand("x")
    equal("typed text", "contour a closed {  -- c\n  for p in [p, q] {\n    p\n  }\n}\n", file.read_text())
    kakoune.keys("<esc>", "g", "g")
    kakoune.command("comment-line")
    kakoune.command("write")
    kakoune.expand("x")
    equal("comment", "-- contour", file.read_text()[:10])
    kakoune.quit()


def diagnostics():
    file = FOLDER / "деталь.part"
    shutil.copy("test/programs/names/bad/beside-wide-letters.part", file)
    checked = subprocess.run(["partc", "check", "--format", "json", file], capture_output=True, text=True)
    reports = [json.loads(line) for line in checked.stderr.splitlines()]
    kakoune = Kakoune(file, "eval %sh{kak-lsp}", "lsp-enable")
    wait("a diagnostic", lambda: kakoune.expand("%opt{lsp_diagnostic_error_count}") == str(len(reports)))
    shown = kakoune.expand("%opt{lsp_inline_diagnostics}").split()
    # Kakoune counts bytes, from 1, and its ranges include the last byte.
    lines = file.read_text().splitlines()

    def at(place, back):
        text = lines[place["line"] - 1][: place["column"] - 1]
        return f"{place['line']}.{len(text.encode()) + 1 - back}"

    equal("diagnostics", sorted(f"{at(r['start'], 0)},{at(r['end'], 1)}|DiagnosticError" for r in reports),
          sorted(word for word in shown if "|" in word))
    kakoune.command("lsp-exit")
    kakoune.quit()


colours()
typing()
if shutil.which("kak-lsp"):
    diagnostics()
print("kakoune: " + ("with kak-lsp" if shutil.which("kak-lsp") else "kak-lsp is not installed"))
