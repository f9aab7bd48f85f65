#!/usr/bin/env python3
"""Chooses texts of the project at random. A reader who is new to the project then says which are clear.

    sample.py SEED [comments|definitions|passages|homes]

Without a kind it prints 60 comments, 40 exported definitions and 20 passages of the documents. With
`homes` it prints 20 exported definitions without their modules: the reader says in which folder and
module they would look for each. `sample.py SEED answers` prints these modules.
"""
import glob
import os
import random
import re
import sys

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
COMMENT = re.compile(r"^( *)-- (?!-)")


def read(path):
    with open(path, encoding="utf-8") as stream:
        return stream.read()


def sources():
    """The Haskell files of the library and the program."""
    return sorted(
        path for root in ("src", "app") for path in glob.glob(os.path.join(TOP, root, "**", "*.hs"), recursive=True)
    )


def code_after(lines, number):
    """The code after a comment as a reader sees it first: the signature and the first line of the definition."""
    code = []
    for line in lines[number : number + 8]:
        if not line.strip():
            break
        code.append(line)
        if re.search(r"[=|]( |$)", line) and not line.startswith(" ") and "::" not in line:
            break
    return code


def comments():
    """All comments, each with the code that follows it, and with the definition around it."""
    found = []
    for path in sources():
        lines = read(path).split("\n")
        number = 0
        while number < len(lines):
            if not COMMENT.match(lines[number]) or lines[number].rstrip().endswith("-----"):
                number += 1
                continue
            begin = number
            while number < len(lines) and re.match(r"^ *--( |$)", lines[number]):
                number += 1
            around = []
            if lines[begin].startswith(" "):
                heads = [line for line in lines[:begin] if re.match(r"[a-z(]|data |newtype |type ", line)]
                around = heads[-1:]
            found.append((path, begin + 1, around + lines[begin:number] + code_after(lines, number)))
    return found


def definitions():
    """All exported definitions with their comments and signatures."""
    found = []
    for path in sources():
        text = read(path)
        header = re.search(r"^module [\w.]+\s*\((.*?)\)\s*where", re.sub(r"--[^\n]*", "", text), re.S | re.M)
        exported = set(re.findall(r"[\w']+", header[1])) if header else set()
        pattern = re.compile(r"^((?:--[^\n]*\n)+)(?:(?:data|newtype|type) )?([\w']+)([^\n]*(?:\n +[^\n]*)*)", re.M)
        for match in pattern.finditer(text):
            signature = match[0].rstrip()
            is_type = re.search(r"^(data|newtype|type) ", signature, re.M)
            if match[2] in exported and (is_type or "::" in match[3]):
                line = text.count("\n", 0, match.start()) + 1
                rows = match[1].rstrip("\n").split("\n")
                found.append((path, line, rows + code_after(text.split("\n"), line - 1 + len(rows))))
    return found


def passages():
    """The paragraphs and list items of the documents, without tables and blocks of code."""
    found = []
    for path in [os.path.join(TOP, "README.md"), os.path.join(TOP, "CONTRIBUTING.md")] + sorted(
        glob.glob(os.path.join(TOP, "docs", "*.md"))
    ):
        text = re.sub(r"^```.*?^```", lambda m: "\n" * m[0].count("\n"), read(path), flags=re.S | re.M)
        for match in re.finditer(r"(?:^(?!\n)[^\n]+\n?)+", text, re.M):
            body = match[0].strip()
            if len(body.split()) > 8 and not re.match(r"[|#<!]|    ", match[0]):
                found.append((path, text.count("\n", 0, match.start()) + 1, body.split("\n")))
    return found


def show(title, drawn):
    print("== " + title)
    for count, (path, line, body) in enumerate(drawn, 1):
        print("\n%d. %s:%d" % (count, os.path.relpath(path, TOP), line))
        print("\n".join("   " + row for row in body[:26]))
    print()


def main():
    seed = int(sys.argv[1])
    kind = sys.argv[2] if len(sys.argv) > 2 else "all"
    draw = random.Random(seed)
    if kind in ("comments", "all"):
        show("comments", draw.sample(comments(), 60))
    if kind in ("definitions", "all"):
        show("exported definitions", draw.sample(definitions(), 40))
    if kind in ("passages", "all"):
        show("passages", draw.sample(passages(), 20))
    if kind in ("homes", "answers"):
        for count, (path, _, body) in enumerate(draw.sample(definitions(), 20), 1):
            if kind == "answers":
                print("%d. %s" % (count, os.path.relpath(path, TOP)))
            else:
                print("%d.\n%s\n" % (count, "\n".join("   " + row for row in body[:26])))


if __name__ == "__main__":
    main()
