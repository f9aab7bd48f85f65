#!/usr/bin/env python3
"""Offsets by libraries without arcs: GEOS (through shapely) and Clipper2 (through pyclipr).

    chords.py LIBRARY SAGITTA SMALL FILE D RUNS BATCHES

FILE contains one closed contour: little-endian doubles, x y bulge for each vertex. The arcs of the contour become chords with
a sagitta of at most SAGITTA mm before the measurement starts; the libraries make such chords of the arcs of the offset. The
program prints for every batch the nanoseconds of processor time of one run, then the result of the last run and the rise of
peak memory in the first run. Before that it offsets the contour of SMALL a hundred times, so that the code and the memory
that the library keeps are allocated. LIBRARY is geos or clipper2; `chords.py versions` prints the installed versions.
"""
import math
import sys
import time

import numpy as np


def chorded(vertices, sagitta):
    """The contour with its arcs as chords whose ends lie on the arcs."""
    at, bulge = vertices[:, :2], vertices[:, 2]
    to = np.roll(at, -1, 0)
    chord = np.hypot(*(to - at).T)
    sweep = 4 * np.arctan(bulge)
    curved = bulge != 0
    radius = np.full(len(at), np.inf)
    radius[curved] = chord[curved] * (1 + bulge[curved] ** 2) / (4 * np.abs(bulge[curved]))
    counts = np.ones(len(at), dtype=np.int64)
    counts[curved] = np.maximum(1, np.ceil(np.abs(sweep[curved]) / step(radius[curved], sagitta)))
    which = np.repeat(np.arange(len(at)), counts)
    part = np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts)
    turned = sweep[which] * part / counts[which]
    # The point of the arc after the angle `turned`, as a multiple of the chord rotated by an angle.
    whole = np.where(curved, sweep, 1.0)[which]
    share = np.where(curved[which], np.sin(turned / 2) / np.sin(whole / 2), 0.0)
    angle = np.where(curved[which], (turned - whole) / 2, 0.0)
    along = (to - at)[which]
    cos, sin = np.cos(angle) * share, np.sin(angle) * share
    return at[which] + np.stack([along[:, 0] * cos - along[:, 1] * sin, along[:, 0] * sin + along[:, 1] * cos], 1)


def step(radius, sagitta):
    """The angle that a chord with this sagitta subtends at the centre of an arc."""
    return 2 * np.arccos(np.maximum(0.0, 1 - sagitta / radius))


def geos(points, distance, sagitta):
    import shapely

    quadrant = max(1, math.ceil(math.pi / 2 / float(step(abs(distance), sagitta))))
    source = shapely.Polygon(points)

    def measures(result):
        pieces = [p for p in shapely.get_parts(result) if not p.is_empty]
        loops = sum(1 + len(p.interiors) for p in pieces)
        return result.area, result.length, loops, int(shapely.get_num_coordinates(result)) - loops

    return lambda: source.buffer(distance, quad_segs=quadrant), measures


def clipper2(points, distance, sagitta):
    import pyclipr

    # Clipper2 computes with whole numbers: here nanometres.
    offsetter = pyclipr.ClipperOffset()
    offsetter.scaleFactor = 1_000_000
    offsetter.arcTolerance = sagitta * offsetter.scaleFactor
    offsetter.addPath(points, pyclipr.JoinType.Round, pyclipr.EndType.Polygon)

    def measures(result):
        area = length = 0.0
        for path in result:
            x, y = (path - path[0]).T
            area += 0.5 * float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))
            length += float(np.sum(np.hypot(np.roll(x, -1) - x, np.roll(y, -1) - y)))
        return area, length, len(result), sum(len(path) for path in result)

    return lambda: offsetter.execute(distance), measures


def memory(line):
    """The kilobytes in a line of /proc/self/status."""
    with open("/proc/self/status", encoding="ascii") as status:
        return next((int(l.split()[1]) for l in status if l.startswith(line + ":")), 0)


def forget_peak():
    with open("/proc/self/clear_refs", "w", encoding="ascii") as peak:
        peak.write("5")
    return memory("VmHWM")


def versions():
    import pyclipr
    import shapely

    print(f"GEOS {shapely.geos_version_string} (shapely {shapely.__version__})")
    print(f"Clipper2 {pyclipr.clipperVersion} (pyclipr)")


def main():
    if sys.argv[1:] == ["versions"]:
        return versions()
    library, sagitta, small, file, distance, runs, batches = sys.argv[1:]
    library, sagitta, distance = {"geos": geos, "clipper2": clipper2}[library], float(sagitta), float(distance)

    def task(file):
        return library(chorded(np.fromfile(file, dtype="<f8").reshape(-1, 3), sagitta), distance, sagitta)

    begin, _ = task(small)
    for _ in range(100):
        begin()
    offset, measures = task(file)

    before = forget_peak()
    begin = time.process_time_ns()
    result = offset()
    first = time.process_time_ns() - begin
    used = memory("VmHWM") - before
    if int(batches) == 0:
        print("run", first)
    for _ in range(int(batches)):
        begin = time.process_time_ns()
        for _ in range(int(runs)):
            result = offset()
        print("run", (time.process_time_ns() - begin) // int(runs))
    area, length, loops, vertices = measures(result)
    print(f"area {area!r}\nlength {length!r}\nloops {loops}\nopen 0\nvertices {vertices}\nmemory {used * 1024}")


if __name__ == "__main__":
    main()
