// Paths: the moves of the program and the frames of a machine in one form, as flat arrays.

import { boxes, unite } from './geometry.js';

/** Kinds of moves and frames, by their numbers. */
export const RAPID = 0;
export const LINK = 1;
export const CUT = 2;
export const COMMANDS = 3;

/** Names of the kinds. */
export const KIND_NAMES = ['rapid move', 'linking move', 'cut', 'commands'];

/**
 * Path of flat arrays: `seg` has nine numbers for each part (a segment and the heights at its ends,
 * in mm), `info` five (kind, tool, file, line and a mark).
 */
function makePath(seg, info, feed, feedStride) {
  const count = Math.floor(seg.length / 9);
  return {
    seg, info, feed, feedStride, count, stride: 9, box: boxes(seg, 9), byLine: null, top: null,
  };
}

/** Path of the program's moves in a drawing, lengths in mm. */
export function movePath(drawing) {
  const { move, moveInfo, moveFeed } = drawing.arrays;
  return makePath(move, moveInfo, moveFeed, 1);
}

/** Path of the frames of a run, lengths in mm. */
export function framePath(run) {
  const { frame, frameInfo, frameFeed } = run.arrays;
  return makePath(frame, frameInfo, frameFeed, 2);
}

/** Indices of the parts of a path that come from a line of a file. */
export function partsOfLine(path, file, line) {
  if (!path.byLine) {
    path.byLine = new Map();
    for (let i = 0; i < path.count; i++) {
      const key = path.info[5 * i + 2] * 1e7 + path.info[5 * i + 3];
      const list = path.byLine.get(key);
      if (list) list.push(i);
      else path.byLine.set(key, [i]);
    }
  }
  return path.byLine.get(file * 1e7 + line) ?? [];
}

/** Box x0 y0 x1 y1 in mm around everything that a drawing and paths show, or null. */
export function extentsOf(drawing, ...paths) {
  const lists = paths.filter(Boolean).map((path) => path.box);
  if (drawing) {
    lists.push(boxes(drawing.arrays.contour, 7), holeBoxes(drawing.arrays.hole));
  }
  const box = unite(...lists);
  if (box && drawing?.header.turned) {
    const reach = Math.max(Math.abs(box[1]), Math.abs(box[3]));
    box[1] = -reach;
    box[3] = reach;
  }
  return box;
}

function holeBoxes(hole) {
  const out = new Float64Array(hole.length);
  for (let o = 0; o + 3 < hole.length; o += 4) {
    out[o] = hole[o] - hole[o + 2];
    out[o + 1] = hole[o + 1] - hole[o + 2];
    out[o + 2] = hole[o] + hole[o + 2];
    out[o + 3] = hole[o + 1] + hole[o + 2];
  }
  return out;
}

/** Range [low, high] of the heights of a path's cuts in mm, or null. */
export function depthRange(path) {
  return range(path, (i) => Math.min(path.seg[9 * i + 7], path.seg[9 * i + 8]));
}

/**
 * Whether the cutter sweeps the part in this move: in a cut, and in a lead or a ramp, whose lower
 * end is not above the highest cut.
 */
export function sweeps(path, i) {
  const kind = path.info[5 * i];
  if (kind !== LINK) return kind === CUT;
  path.top ??= (depthRange(path) ?? [0, -Infinity])[1];
  return Math.min(path.seg[9 * i + 7], path.seg[9 * i + 8]) <= path.top;
}

/** Range [low, high] of the known feeds of a path's cuts in mm/min, or null. */
export function feedRange(path) {
  return range(path, (i) => path.feed[i * path.feedStride] || NaN);
}

function range(path, value) {
  let low = Infinity;
  let high = -Infinity;
  for (let i = 0; i < path.count; i++) {
    if (path.info[5 * i] !== CUT) continue;
    const v = value(i); // NaN is neither less nor greater
    if (v < low) low = v;
    if (v > high) high = v;
  }
  return low <= high ? [low, high] : null;
}
