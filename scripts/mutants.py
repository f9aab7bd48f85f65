#!/usr/bin/env python3
"""Reads test/mutants/*.mutant and puts their bugs into the sources.

    mutants.py check [NAME...]     every mutant applies: its expression occurs exactly once in its definition,
                                   and its law is a test
    mutants.py law NAME            prints the law that has to fail
    mutants.py file NAME           prints the file that the mutant changes
    mutants.py apply NAME ROOT     puts the bug into the file below ROOT

A mutant is a text:

    law: the name of the test that has to fail
    bug: what is wrong with it
    module: Geometry.Curve.PointSearch        (or  file: docs/language.md)
    definition: merged                        (a top-level name; none for a file)
    --- instead of
    the expression as it is
    --- put
    the expression with the bug

Expressions are compared token by token: line breaks and comments make no difference.
"""
import glob
import os
import re
import sys

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

TOKEN = re.compile(
    r"""(?P<skip>\s+|--+(?![!#$%&*+./<=>?@\\^|~:])[^\n]*|\{-.*?-\})
      |(?P<token>"(?:[^"\\]|\\.)*"|'(?:[^'\\\n]|\\[^\n]{1,6}?)'
        |\d[\w.]*|(?:[A-Z][\w']*\.)*[\w'#]+|[!#$%&*+./<=>?@\\^|~:-]+|.)""",
    re.S | re.X,
)


def tokens(text):
    """The tokens of a text with their offsets: (token, begin, end)."""
    return [(m["token"], m.start(), m.end()) for m in TOKEN.finditer(text) if m["token"] is not None]


class Unfit(Exception):
    """The reason why a mutant does not apply to the sources."""


def parse(name):
    """A mutant's fields, its expression and the expression with the bug."""
    with open(os.path.join(TOP, "test", "mutants", name + ".mutant"), encoding="utf-8") as stream:
        text = stream.read()
    match = re.fullmatch(r"(.*?)--- instead of\n(.*)\n--- put\n(.*?)\n?", text, re.S)
    if not match:
        raise Unfit("is not written as a mutant")
    fields = dict(re.findall(r"^(\w+): (.*)$", match[1], re.M))
    return fields, match[2], match[3]


def path_of(fields):
    """The file that a mutant changes, from the root of the project."""
    if "file" in fields:
        return fields["file"]
    return os.path.join("src", *fields["module"].split(".")) + ".hs"


def extent(source, definition):
    """The offsets at which a top-level definition begins and ends, without its signature."""
    starts = [m for m in re.finditer(r"^(?=\S)(?!--|\{-)", source, re.M)]
    blocks = []
    for here, following in zip(starts, starts[1:] + [None]):
        end = following.start() if following else len(source)
        head = re.match(r"\(?([\w'$!#%&*+./<=>?@\\^|~:-]+)\)?", source[here.start() : end])
        words = source[here.start() : end].split(None, 2)
        names = {head[1]} if head else set()
        if words and words[0] in ("data", "newtype", "type", "instance") and len(words) > 1:
            names = {words[1]}
        is_signature = re.match(r"\(?[^\s()]+\)?(\s*,\s*[^\s()]+)*\s*::", source[here.start() : end])
        if definition in names and not is_signature:
            blocks.append((here.start(), end))
    if not blocks:
        raise Unfit("there is no definition " + definition)
    return blocks[0][0], blocks[-1][1]


def place(source, fields, old, new):
    """The offsets of what changes in the source, and the new text for it. Tokens that both expressions have
    at their beginning or at their end stay as they are in the source, with their line breaks. All lines of
    the new text get the indentation of the expression's first line."""
    if "file" in fields:
        at = source.find(old)
        if at < 0 or source.find(old, at + 1) >= 0:
            raise Unfit("its text does not occur exactly once")
        return at, at + len(old), new
    begin, end = extent(source, fields["definition"])
    wanted = [token for token, _, _ in tokens(old)]
    found = tokens(source[begin:end])
    names = [token for token, _, _ in found]
    hits = [i for i in range(len(names) - len(wanted) + 1) if names[i : i + len(wanted)] == wanted]
    if len(hits) != 1:
        raise Unfit("its expression occurs %d times in %s" % (len(hits), fields["definition"]))
    put = tokens(new)
    head = shared(wanted, [token for token, _, _ in put])
    tail = shared(wanted[head:][::-1], [token for token, _, _ in put[head:]][::-1])
    changed = found[hits[0] + head : hits[0] + len(wanted) - tail]
    put = put[head : len(put) - tail]
    text = new[put[0][1] : put[-1][2]] if put else ""
    first = begin + found[hits[0]][1]
    column = first - (source.rfind("\n", 0, first) + 1)
    text = text.replace("\n", "\n" + " " * column)
    if changed:
        return begin + changed[0][1], begin + changed[-1][2], text
    at = begin + found[hits[0] + head - 1][2] if head else begin + found[hits[0]][1]
    return at, at, " " + text + " "


def shared(some, others):
    """How many elements two lists share from their beginning."""
    count = 0
    while count < min(len(some), len(others)) and some[count] == others[count]:
        count += 1
    return count


def mutated(source, fields, old, new):
    """The source with the bug."""
    begin, end, text = place(source, fields, old, new)
    return source[:begin] + text + source[end:]


def apply(name, root):
    fields, old, new = parse(name)
    path = os.path.join(root, path_of(fields))
    if not os.path.exists(path):
        raise Unfit("there is no file " + path_of(fields))
    with open(path, encoding="utf-8") as stream:
        source = stream.read()
    return path, mutated(source, fields, old, new)


def descriptions():
    """The texts of the tests, with the gaps of long literals closed, and the wrong programs with their names."""
    paths = glob.glob(os.path.join(TOP, "test", "**", "*.hs"), recursive=True)
    paths += glob.glob(os.path.join(TOP, "test", "data", "wrong", "*.txt"))
    texts = []
    for path in paths:
        with open(path, encoding="utf-8") as stream:
            texts.append(re.sub(r"\\\s*\n\s*\\", "", stream.read()))
    return "\n".join(texts)


def is_file(name):
    """True of a file that a test is named after: its path from the root of the project, or its name alone."""
    below = os.path.join(TOP, "test", "**", glob.escape(name))
    return os.path.exists(os.path.join(TOP, name)) or bool(glob.glob(below, recursive=True))


def is_tested(law, texts):
    """True of a law that is the description of a test, or is put together from two: a group and, after a
    slash, a test or a file of it, or a name and the words after it."""
    if law in texts:
        return True
    group, _, member = law.partition("/")
    if member and group in texts and (member in texts or is_file(member)):
        return True
    gaps = [i for i, letter in enumerate(law) if letter == " "]
    return any('"' + law[:i] + '"' in texts and '"' + law[i:] in texts for i in gaps)


def names_of(arguments):
    if arguments:
        return arguments
    paths = sorted(glob.glob(os.path.join(TOP, "test", "mutants", "*.mutant")))
    return [os.path.splitext(os.path.basename(path))[0] for path in paths]


def main():
    command, arguments = sys.argv[1], sys.argv[2:]
    if command == "check":
        unfit = 0
        texts = descriptions()
        for name in names_of(arguments):
            try:
                apply(name, TOP)
                law = parse(name)[0]["law"]
                if not is_tested(law, texts):
                    raise Unfit("no test is called " + law)
            except Unfit as reason:
                print("%s: %s" % (name, reason))
                unfit += 1
        return 1 if unfit else 0
    if command == "apply":
        path, text = apply(arguments[0], arguments[1])
        with open(path, "w", encoding="utf-8") as stream:
            stream.write(text)
        return 0
    fields, _, _ = parse(arguments[0])
    print(fields["law"] if command == "law" else path_of(fields))
    return 0


if __name__ == "__main__":
    sys.exit(main())
