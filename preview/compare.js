// Comparison of two texts or of two machines.

import { boxes, segDistance, segPoint } from './geometry.js';
import { CUT, framePath } from './paths.js';
import { makeChunks } from './chunks.js';

const MOST_SAMPLED = 10000; // frames up to which the distance of two paths is found

function keyOf(a, o, size) {
  let key = '';
  for (let k = 0; k < size; k++) key += `${Math.round(a[o + k] * 1e4)},`;
  return key;
}

/** Indices of the parts of each of two arrays that the other array lacks (to 0.0001 mm). */
export function difference(a, b, size) {
  const missing = (from, of) => {
    const known = new Set();
    for (let o = 0; o < of.length; o += size) known.add(keyOf(of, o, size));
    const out = [];
    for (let i = 0; i * size < from.length; i++) {
      if (!known.has(keyOf(from, i * size, size))) out.push(i);
    }
    return Int32Array.from(out);
  };
  return { gone: missing(a, b), fresh: missing(b, a) };
}

// Moves and parts of the contour with the given indices, as one path.
function pick(drawing, moves, contourParts) {
  const { move, moveInfo, contour } = drawing.arrays;
  const count = moves.length + contourParts.length;
  const seg = new Float64Array(9 * count);
  const info = new Int32Array(5 * count);
  moves.forEach((i, k) => {
    seg.set(move.subarray(9 * i, 9 * i + 9), 9 * k);
    info.set(moveInfo.subarray(5 * i, 5 * i + 5), 5 * k);
  });
  contourParts.forEach((i, n) => {
    const k = moves.length + n;
    seg.set(contour.subarray(7 * i, 7 * i + 7), 9 * k);
    info[5 * k] = CUT;
  });
  const path = { seg, info, count, box: boxes(seg, 9) };
  return { path, chunks: makeChunks(path, () => 0) };
}

/** Comparison of a drawing with the one before the last change. */
export function compareTexts(before, drawing) {
  const moves = difference(before.arrays.move, drawing.arrays.move, 9);
  const contour = difference(before.arrays.contour, drawing.arrays.contour, 7);
  return {
    kind: 'before',
    gone: pick(before, moves.gone, contour.gone),
    fresh: pick(drawing, moves.fresh, contour.fresh),
    counts: { gone: moves.gone.length, fresh: moves.fresh.length,
      contourGone: contour.gone.length, contourFresh: contour.fresh.length },
  };
}

/** Comparison of the frames of a machine with those of a second one. */
export function compareMachines(frames, run) {
  const path = framePath(run);
  return {
    kind: 'machine',
    title: run.header.title || run.header.machine,
    path,
    chunks: makeChunks(path, (i) => path.info[5 * i]),
    seconds: lastEnd(run),
    frames: path.count,
    fault: path.count === 0 ? run.header.reports[0]?.text ?? 'there is no tape' : '',
    apart: frames ? largestDistance(frames, path) : null,
  };
}

function lastEnd(run) {
  const { frameTick } = run.arrays;
  return frameTick.length > 0 ? frameTick[frameTick.length - 2] / run.header.clock : 0;
}

/**
 * Largest distance in mm, in plan, of points of the cuts of one path from the cuts of the other;
 * null when there are too many of them.
 * @returns {?{distance: number, x: number, y: number}}
 */
export function largestDistance(a, b) {
  if (Math.max(a.count, b.count) > MOST_SAMPLED) return null;
  const one = farthest(a, b);
  const two = farthest(b, a);
  if (!one || !two) return null;
  return one.distance > two.distance ? one : two;
}

function farthest(from, to) {
  const grid = makeGrid(to);
  if (!grid) return null;
  const out = { distance: 0, x: 0, y: 0 };
  const p = [0, 0];
  for (let i = 0; i < from.count; i++) {
    if (from.info[5 * i] !== CUT) continue;
    for (const t of [0, 0.25, 0.5, 0.75, 1]) {
      segPoint(from.seg, 9 * i, t, p);
      const d = grid.distance(p[0], p[1]);
      if (d > out.distance) Object.assign(out, { distance: d, x: p[0], y: p[1] });
    }
  }
  return out;
}

// A grid of cells with the indices of the cuts whose boxes meet them.
function makeGrid(path) {
  const cuts = [];
  let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
  for (let i = 0; i < path.count; i++) {
    if (path.info[5 * i] !== CUT) continue;
    cuts.push(i);
    x0 = Math.min(x0, path.box[4 * i]);
    y0 = Math.min(y0, path.box[4 * i + 1]);
    x1 = Math.max(x1, path.box[4 * i + 2]);
    y1 = Math.max(y1, path.box[4 * i + 3]);
  }
  if (cuts.length === 0) return null;
  const cells = Math.max(4, Math.min(160, Math.ceil(Math.sqrt(cuts.length))));
  const size = Math.max(x1 - x0, y1 - y0, 1e-6) / cells;
  const lists = new Map();
  const column = (x) => Math.floor((x - x0) / size);
  const row = (y) => Math.floor((y - y0) / size);
  for (const i of cuts) {
    for (let c = column(path.box[4 * i]); c <= column(path.box[4 * i + 2]); c++) {
      for (let r = row(path.box[4 * i + 1]); r <= row(path.box[4 * i + 3]); r++) {
        const key = c * 4096 + r;
        if (lists.has(key)) lists.get(key).push(i);
        else lists.set(key, [i]);
      }
    }
  }
  const distance = (x, y) => ringDistance(path, lists, column(x), row(y), size, x, y, cells);
  return { distance };
}

function ringDistance(path, lists, column, row, size, x, y, cells) {
  let best = Infinity;
  for (let ring = 0; ring <= 3 * cells; ring++) {
    if (best <= (ring - 1) * size) break;
    for (let c = column - ring; c <= column + ring; c++) {
      const edge = Math.abs(c - column) === ring;
      for (let r = row - ring; r <= row + ring; r += edge || ring === 0 ? 1 : 2 * ring) {
        for (const i of lists.get(c * 4096 + r) ?? []) {
          best = Math.min(best, segDistance(path.seg, 9 * i, x, y));
        }
      }
    }
  }
  return best;
}

