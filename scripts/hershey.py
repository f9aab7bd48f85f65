#!/usr/bin/env python3
"""Makes fonts/latin.font from the simplex Roman letters of the Hershey fonts.

Run it as `python3 -B scripts/hershey.py > fonts/latin.font`. The letters are in
the Debian package hershey-fonts-data.

A line of the source is one letter, in the order of ASCII from the space on: a
number of five digits, the count of pairs in three digits, and the pairs. A pair
is two characters, each of which stands for its distance from R. The first pair
holds the left and the right edge of the letter. The pair " R" ends a stroke. The
y axis of the source points downwards; 9 is the base line and -12 the top of the
capitals.
"""

SOURCE = "/usr/share/hershey-fonts/rowmans.jhf"
BASE_LINE = 9
# The space, which fonts/cyrillic.font has, an arrow, and signs of double lines.
LEFT_OUT = " ^@[]{}~"
HEAD = """\
-- Latin letters, digits and signs: the simplex Roman letters of the Hershey fonts.
-- scripts/hershey.py makes this file.
--
-- The Hershey Fonts were originally created by Dr. A. V. Hershey while working at the
-- U. S. National Bureau of Standards. The format of the Font data in this distribution was
-- originally created by James Hurt, Cognition, Inc., 900 Technology Park Drive, Billerica,
-- MA 01821 (mit-eddie!ci-dandelion!hurt).
-- README.md describes the format of this file.

height 21
gap 0
"""


def pairs(line):
    """The pairs of a letter; None ends a stroke."""
    text = line.rstrip("\n")[8:]
    return [
        None if text[i : i + 2] == " R" else (ord(text[i]) - ord("R"), ord(text[i + 1]) - ord("R"))
        for i in range(0, len(text), 2)
    ]


def strokes(points):
    """The chains of points between the ends of strokes."""
    chains = [[]]
    for point in points:
        if point is None:
            chains.append([])
        else:
            chains[-1].append(point)
    return [chain for chain in chains if len(chain) > 1]


def name(code):
    """The character of a code; the sign after ~ is that of degrees."""
    return "°" if code == 127 else chr(code)


def main():
    print(HEAD)
    with open(SOURCE, encoding="ascii") as source:
        for code, line in enumerate(source, 32):
            if chr(code) in LEFT_OUT:
                continue
            (left, right), *points = pairs(line)
            print(f"letter {name(code)} width {right - left}")
            for chain in strokes(points):
                print("  " + " ".join(f"{x - left},{BASE_LINE - y}" for x, y in chain))


main()
