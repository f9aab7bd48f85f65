#!/usr/bin/env python3
"""Chooses texts of the project at random. A reader who is new to the project then says which are clear.

    sample.py SEED [comments|definitions|passages|homes]

Without a kind it prints 60 comments, 40 exported definitions and 20 passages of the documents, marked
by ">", each below the head of its module or its headings ("|") and between the lines around it. With
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
    """The code after a comment: the signature and the first line of the definition, or the whole type."""
    code = []
    is_type = number < len(lines) and re.match(r"(data|newtype) ", lines[number])
    for line in lines[number : number + (16 if is_type else 8)]:
        if not line.strip():
            break
        code.append(line)
        if is_type:
            continue
        if re.search(r"[=|]( |$)", line) and not line.startswith(" ") and "::" not in line:
            break
    return code


def module_header(lines):
    """The comment at the head of a module, and the line with its name: what a reader of the file has read."""
    header = []
    for line in lines:
        if line.startswith("{-#"):
            continue
        if line.startswith("--"):
            header.append(line)
        elif line.startswith("module "):
            return header + [line.replace(" where", "").rstrip(" (")]
        elif line.strip():
            header = []
    return header


def definition_around(lines, begin):
    """The definition that an indented comment belongs to: its comment and first lines, then the lines just before."""
    head = begin
    while head > 0 and (not lines[head].strip() or lines[head][0] in " )"):
        head -= 1
    top = head
    while top > 0 and lines[top - 1].strip() and not lines[top - 1].startswith((" ", "import")):
        top -= 1
    around = lines[top : min(head + 4, begin)]
    just_before = max(head + 4, begin - 3)
    if just_before < begin:
        around += (["..."] if just_before > head + 4 else []) + lines[just_before:begin]
    return around


def comments():
    """All comments, each with the code that follows it, and with the definition around it."""
    found = []
    for path in sources():
        lines = read(path).split("\n")
        header = module_header(lines)
        number = 0
        while number < len(lines):
            if not COMMENT.match(lines[number]) or lines[number].rstrip().endswith("-----"):
                number += 1
                continue
            begin = number
            while number < len(lines) and re.match(r"^ *--( |$)", lines[number]):
                number += 1
            around = definition_around(lines, begin) if lines[begin].startswith(" ") else []
            marked = ["> " + line for line in lines[begin:number]]
            found.append((path, begin + 1, header, around + marked + code_after(lines, number)))
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
                lines = text.split("\n")
                marked = ["> " + row for row in rows]
                found.append((path, line, module_header(lines), marked + code_after(lines, line - 1 + len(rows))))
    return found


def passages():
    """The paragraphs and list items of the documents, each below its headings and what stands right before it."""
    found = []
    for path in [os.path.join(TOP, "README.md"), os.path.join(TOP, "CONTRIBUTING.md")] + sorted(
        glob.glob(os.path.join(TOP, "docs", "*.md"))
    ):
        whole = read(path)
        text = re.sub(r"^```.*?^```", lambda m: "\n" * m[0].count("\n"), whole, flags=re.S | re.M)
        for match in re.finditer(r"(?:^(?!\n)[^\n]+\n?)+", text, re.M):
            body = match[0].strip()
            if len(body.split()) > 8 and not re.match(r"[|#<!]|    ", match[0]):
                before = text[: match.start()]
                headings = re.findall(r"^#+ .*", before, re.M)
                line = before.count("\n")
                rows = whole.split("\n")[max(0, line - 5) : line]
                marked = ["> " + row for row in body.split("\n")]
                found.append((path, line + 1, headings[:1] + headings[1:][-1:], rows + marked))
    return found


def show(title, drawn):
    print("== " + title)
    for count, (path, line, context, body) in enumerate(drawn, 1):
        print("\n%d. %s:%d" % (count, os.path.relpath(path, TOP), line))
        print("\n".join("   | " + row for row in context))
        print("\n".join("   " + row for row in body[:40]))
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
        for count, (path, _, _, body) in enumerate(draw.sample(definitions(), 20), 1):
            if kind == "answers":
                print("%d. %s" % (count, os.path.relpath(path, TOP)))
            else:
                print("%d.\n%s\n" % (count, "\n".join("   " + row for row in body[:26])))


if __name__ == "__main__":
    main()
