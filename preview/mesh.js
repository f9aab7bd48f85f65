// Meshes of the three-dimensional view: lines and triangles in mm.

import { COMMANDS, CUT } from './paths.js';
import { kindShown } from './planpath.js';
import { parse } from './theme.js';
import { pieces, segPoint } from './geometry.js';

const DEVIATION = 0.05; // mm by which straight pieces may leave an arc

/** Collector of lines: their ends in mm, and their colours. */
export function lineCollector() {
  let places = new Float32Array(6 * 256);
  let colours = new Uint8Array(4 * 256);
  let count = 0;
  return {
    count: () => count,
    /** Adds a line with a colour as red, green, blue (0 to 255). */
    add(x0, y0, z0, x1, y1, z1, colour, dashed = false) {
      if (6 * count === places.length) {
        places = grown(places);
        colours = grown(colours);
      }
      places.set([x0, y0, z0, x1, y1, z1], 6 * count);
      colours.set([colour[0], colour[1], colour[2], dashed ? 0 : 255], 4 * count);
      count += 1;
    },
    /** Ends and colours of all lines. */
    data() {
      return { places: places.subarray(0, 6 * count), colours: colours.subarray(0, 4 * count) };
    },
  };
}

function grown(array) {
  const out = new array.constructor(2 * array.length);
  out.set(array);
  return out;
}

const p = [0, 0];

/** Adds a segment with heights z0 and z1 in mm to lines, up to its fraction t. */
export function addSegment(lines, a, o, z0, z1, colour, dashed, t = 1) {
  const count = pieces(a, o, DEVIATION);
  let [x, y, z] = [a[o], a[o + 1], z0];
  for (let k = 1; k <= count; k++) {
    const part = (k / count) * t;
    segPoint(a, o, part, p);
    const next = z0 + part * (z1 - z0);
    lines.add(x, y, z, p[0], p[1], next, colour, dashed);
    [x, y, z] = [p[0], p[1], next];
  }
}

/**
 * Lines of a path in the colours of a painter. `first` gives for each part the index of its first
 * line, and `part` for each line the index of its part.
 */
export function pathLines(path, paint, layers) {
  const lines = lineCollector();
  const first = new Int32Array(path.count + 1);
  const known = new Map();
  const colourOf = (bin) => {
    if (!known.has(bin)) known.set(bin, parse(paint.colour(bin)));
    return known.get(bin);
  };
  for (let i = 0; i < path.count; i++) {
    first[i] = lines.count();
    const kind = path.info[5 * i];
    if (kind === COMMANDS || !kindShown(layers, kind)) continue;
    const bin = paint.bin(i);
    addSegment(lines, path.seg, 9 * i, path.seg[9 * i + 7], path.seg[9 * i + 8], colourOf(bin),
      paint.dashed(bin));
  }
  first[path.count] = lines.count();
  return { ...lines.data(), first };
}

/** Height in mm of the deepest cut of a path, or 0. */
export function deepest(path) {
  let low = 0;
  for (let i = 0; path && i < path.count; i++) {
    if (path.info[5 * i] === CUT) low = Math.min(low, path.seg[9 * i + 7], path.seg[9 * i + 8]);
  }
  return low;
}

/** Lines of the contours at z = 0, and at the height of the bottom in mm. */
export function contourLines(drawing, colour, soft) {
  const lines = lineCollector();
  const { contour, hole } = drawing.arrays;
  for (const { from, count, depth } of drawing.header.contours) {
    for (let o = 7 * from; o < 7 * (from + count); o += 7) {
      addSegment(lines, contour, o, 0, 0, colour, false);
      if (depth < 0) addSegment(lines, contour, o, depth, depth, soft, false);
    }
  }
  for (let o = 0; o + 3 < hole.length; o += 4) {
    const circle = [hole[o] + hole[o + 2], hole[o + 1], hole[o] + hole[o + 2], hole[o + 1],
      hole[o], hole[o + 1], 2 * Math.PI];
    addSegment(lines, circle, 0, 0, 0, colour, false);
    addSegment(lines, circle, 0, hole[o + 3], hole[o + 3], soft, false);
  }
  return lines.data();
}

/** Triangles of walls from z = 0 down to the depth of each contour in mm. */
export function walls(drawing) {
  const out = [];
  const { contour, hole } = drawing.arrays;
  for (const { from, count, depth } of drawing.header.contours) {
    if (!(depth < 0)) continue;
    for (let o = 7 * from; o < 7 * (from + count); o += 7) addWall(out, contour, o, depth);
  }
  for (let o = 0; o + 3 < hole.length; o += 4) {
    const circle = [hole[o] + hole[o + 2], hole[o + 1], hole[o] + hole[o + 2], hole[o + 1],
      hole[o], hole[o + 1], 2 * Math.PI];
    addWall(out, circle, 0, hole[o + 3]);
  }
  return Float32Array.from(out);
}

function addWall(out, a, o, bottom) {
  const count = pieces(a, o, DEVIATION);
  let [x, y] = [a[o], a[o + 1]];
  for (let k = 1; k <= count; k++) {
    segPoint(a, o, k / count, p);
    const long = Math.hypot(p[0] - x, p[1] - y) || 1;
    const n = [(p[1] - y) / long, (x - p[0]) / long, 0];
    quad(out, [x, y, 0], [p[0], p[1], 0], [p[0], p[1], bottom], [x, y, bottom], n, n);
    [x, y] = p;
  }
}

function quad(out, a, b, c, d, n, m) {
  out.push(...a, ...n, ...b, ...m, ...c, ...m, ...a, ...n, ...c, ...m, ...d, ...n);
}

/** Triangles of the surface that the contours make when they turn around the x axis. */
export function turnedSurface(drawing) {
  const out = [];
  const { contour } = drawing.arrays;
  const steps = 48;
  for (let o = 0; o < contour.length; o += 7) {
    const count = pieces(contour, o, DEVIATION);
    let [x, r] = [contour[o], contour[o + 1]];
    for (let k = 1; k <= count; k++) {
      segPoint(contour, o, k / count, p);
      addRing(out, x, r, p[0], p[1], steps);
      [x, r] = p;
    }
  }
  return Float32Array.from(out);
}

// A ring around the x axis between the places x0 and x1 with the radii r0 and r1.
function addRing(out, x0, r0, x1, r1, steps) {
  const long = Math.hypot(x1 - x0, r1 - r0) || 1;
  const [along, outward] = [(r0 - r1) / long, (x1 - x0) / long];
  for (let k = 0; k < steps; k++) {
    const [a, b] = [k, k + 1].map((i) => [
      Math.cos((2 * Math.PI * i) / steps), Math.sin((2 * Math.PI * i) / steps)]);
    quad(out, [x0, r0 * a[0], r0 * a[1]], [x0, r0 * b[0], r0 * b[1]],
      [x1, r1 * b[0], r1 * b[1]], [x1, r1 * a[0], r1 * a[1]],
      [along, outward * a[0], outward * a[1]], [along, outward * b[0], outward * b[1]]);
  }
}

/** Triangles of a cutter with its tip at the origin, by its kind and its radius in mm. */
export function cutterMesh(tool, large) {
  const r = Math.max(tool.radius, large / 200);
  if (tool.kind === 'turning') return insert(r, large);
  const long = Math.max(6 * r, large / 6);
  const profile = [[0, 0]];
  if (tool.kind === 'ball') {
    for (let k = 1; k <= 8; k++) {
      const angle = (k / 8) * (Math.PI / 2);
      profile.push([r - r * Math.cos(angle), r * Math.sin(angle)]);
    }
  } else if (tool.kind === 'drill') profile.push([0.6 * r, r]);
  else profile.push([0, r]);
  profile.push([long, r], [long, 0]);
  const turned = [];
  for (let k = 1; k < profile.length; k++) {
    addRing(turned, profile[k - 1][0], profile[k - 1][1], profile[k][0], profile[k][1], 28);
  }
  // The rings turn around x; the cutter stands along z.
  const out = new Float32Array(turned.length);
  for (let i = 0; i < turned.length; i += 3) {
    out[i] = turned[i + 1];
    out[i + 1] = turned[i + 2];
    out[i + 2] = turned[i];
  }
  return out;
}

// The insert of a turning tool: a flat diamond in the plane of the contour, away from the axis.
function insert(r, large) {
  const size = Math.max(5 * r, large / 14);
  const out = [];
  const corners = [[-r, -r], [size * 0.9, size * 0.25], [size * 1.15, size * 1.3],
    [size * 0.2, size]];
  const thick = size * 0.12;
  for (let k = 0; k < 4; k++) {
    const [a, b] = [corners[k], corners[(k + 1) % 4]];
    const long = Math.hypot(b[0] - a[0], b[1] - a[1]);
    const n = [(b[1] - a[1]) / long, (a[0] - b[0]) / long, 0];
    quad(out, [...a, thick], [...b, thick], [...b, -thick], [...a, -thick], n, n);
  }
  for (const z of [thick, -thick]) {
    const n = [0, 0, Math.sign(z)];
    quad(out, ...corners.map((corner) => [...corner, z]), n, n);
  }
  return Float32Array.from(out);
}

/** Lines of the edges of a box [[x, x], [y, y], [z, z]] in mm. */
export function boxLines(box, colour) {
  const lines = lineCollector();
  for (let axis = 0; axis < 3; axis++) {
    for (let k = 0; k < 4; k++) {
      const a = [0, 0, 0];
      a[(axis + 1) % 3] = k & 1;
      a[(axis + 2) % 3] = k >> 1;
      const b = [...a];
      b[axis] = 1;
      const at = (corner) => corner.map((end, i) => box[i][end]);
      lines.add(...at(a), ...at(b), colour, true);
    }
  }
  return lines.data();
}
