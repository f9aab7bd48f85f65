#!/usr/bin/env python3
"""The offsets of many small contours by GEOS, with many short chords for each arc.

    judge.py FILE

FILE contains one record for each contour, of little-endian numbers of eight bytes: the number of vertices (an integer), the
offset D in mm, then x y bulge for each vertex. D > 0 is outwards. The program prints a line for each contour: the area of
its offset, the length, the number of loops, and 0 open polyarcs. The chords of the offset lie inside its arcs, with a sagitta
of less than 1e-7 of D.
"""
import sys

import numpy as np
import shapely
from chords import chorded

# The number of chords for a quarter of a turn.
CHORDS = 4096
# The sagitta of the chords of the contour's own arcs, in mm.
SAGITTA = 1e-8


def records(data):
    place = 0
    while place < len(data):
        count = int(np.frombuffer(data, "<u8", 1, place)[0])
        distance = float(np.frombuffer(data, "<f8", 1, place + 8)[0])
        yield distance, np.frombuffer(data, "<f8", 3 * count, place + 16).reshape(-1, 3)
        place += 16 + 24 * count


def main():
    with open(sys.argv[1], "rb") as file:
        data = file.read()
    for distance, vertices in records(data):
        result = shapely.Polygon(chorded(vertices, SAGITTA)).buffer(distance, quad_segs=CHORDS)
        pieces = [p for p in shapely.get_parts(result) if not p.is_empty]
        print(repr(result.area), repr(result.length), sum(1 + len(p.interiors) for p in pieces), 0)


if __name__ == "__main__":
    main()
