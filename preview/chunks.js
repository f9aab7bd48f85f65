// Paths as chunks of Path2D in mm, so that what lies outside of the window is not drawn.

import { COMMANDS } from './paths.js';
import { Pen } from './simplify.js';
import { segAngle, segPoint, segRadius } from './geometry.js';

const SIZE = 400;

/** Adds a segment (mm) to a path or a context, from the end of the one before if it can. */
export function trace(target, a, o, connected) {
  if (!connected) target.moveTo(a[o], a[o + 1]);
  const phi = a[o + 6];
  if (phi === 0) {
    target.lineTo(a[o + 2], a[o + 3]);
  } else {
    const begin = segAngle(a, o);
    target.arc(a[o + 4], a[o + 5], segRadius(a, o), begin, begin + phi, phi < 0);
  }
}

/** Adds the part of a segment (mm) up to the fraction t (0 to 1). */
export function tracePart(target, a, o, t) {
  const phi = a[o + 6];
  target.moveTo(a[o], a[o + 1]);
  if (phi === 0) {
    const end = segPoint(a, o, t, [0, 0]);
    target.lineTo(end[0], end[1]);
  } else {
    const begin = segAngle(a, o);
    target.arc(a[o + 4], a[o + 5], segRadius(a, o), begin, begin + phi * t, phi < 0);
  }
}

/** Whether a segment begins where the one before it in the array ends. */
export function follows(a, o, stride) {
  return o >= stride && a[o] === a[o - stride + 2] && a[o + 1] === a[o - stride + 3];
}

/** Adds a segment (mm) to a pen, going on from the end of the one before if it can. */
export function penTrace(pen, a, o, connected) {
  if (!connected) pen.move(a[o], a[o + 1]);
  const phi = a[o + 6];
  if (phi === 0) pen.line(a[o + 2], a[o + 3]);
  else {
    pen.arc(a[o + 4], a[o + 5], segRadius(a, o), segAngle(a, o), phi, a[o + 2], a[o + 3]);
  }
}

/**
 * Chunks of a path: `{bin, path, box}` with the box x0 y0 x1 y1 in mm. `bin` gives the number of
 * the group of a part, or −1 for parts to be left out. Lines may be simplified within a tolerance
 * in mm.
 */
export function makeChunks(path, bin, tolerance = 0) {
  const chunks = [];
  for (let from = 0; from < path.count; from += SIZE) {
    const groups = new Map();
    for (let i = from; i < Math.min(path.count, from + SIZE); i++) {
      const k = path.info[5 * i] === COMMANDS ? -1 : bin(i);
      if (k < 0) continue;
      let group = groups.get(k);
      if (!group) {
        const lines = new Path2D();
        group = { bin: k, path: lines, pen: new Pen(lines, tolerance), last: -2,
          box: [Infinity, Infinity, -Infinity, -Infinity] };
        groups.set(k, group);
      }
      const connected = group.last === i - 1 && follows(path.seg, 9 * i, 9);
      penTrace(group.pen, path.seg, 9 * i, connected);
      group.last = i;
      widen(group.box, path.box, 4 * i);
    }
    for (const { bin: k, path: lines, pen, box } of groups.values()) {
      pen.flush();
      chunks.push({ bin: k, path: lines, box });
    }
  }
  return chunks;
}

function widen(out, box, b) {
  if (box[b] < out[0]) out[0] = box[b];
  if (box[b + 1] < out[1]) out[1] = box[b + 1];
  if (box[b + 2] > out[2]) out[2] = box[b + 2];
  if (box[b + 3] > out[3]) out[3] = box[b + 3];
}

/** Whether two boxes in mm meet, the first one widened by a margin in mm. */
export function meets(box, margin, window) {
  return box[0] - margin <= window[2] && box[2] + margin >= window[0]
    && box[1] - margin <= window[3] && box[3] + margin >= window[1];
}
