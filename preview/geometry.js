// Segments in flat arrays: x0 y0 x1 y1 cx cy phi, beginning at an index o. Lengths are in mm,
// angles in radians. phi = 0 is a straight line.

const TURN = 2 * Math.PI;

/** Length of a segment in mm. */
export function segLength(a, o) {
  const phi = a[o + 6];
  if (phi === 0) return Math.hypot(a[o + 2] - a[o], a[o + 3] - a[o + 1]);
  return Math.abs(phi) * segRadius(a, o);
}

/** Radius of an arc in mm. */
export function segRadius(a, o) {
  return Math.hypot(a[o] - a[o + 4], a[o + 1] - a[o + 5]);
}

/** Angle in radians at which an arc begins, seen from its centre. */
export function segAngle(a, o) {
  return Math.atan2(a[o + 1] - a[o + 5], a[o] - a[o + 4]);
}

/** Writes the point at the part t (0 to 1) of a segment into out, in mm. */
export function segPoint(a, o, t, out) {
  const phi = a[o + 6];
  if (t <= 0 || t >= 1) {
    out[0] = a[t <= 0 ? o : o + 2];
    out[1] = a[t <= 0 ? o + 1 : o + 3];
  } else if (phi === 0) {
    out[0] = a[o] + t * (a[o + 2] - a[o]);
    out[1] = a[o + 1] + t * (a[o + 3] - a[o + 1]);
  } else {
    const r = segRadius(a, o);
    const angle = segAngle(a, o) + t * phi;
    out[0] = a[o + 4] + r * Math.cos(angle);
    out[1] = a[o + 5] + r * Math.sin(angle);
  }
  return out;
}

/** Part (0 to 1) of a segment at which it is nearest to a point in mm. */
export function segNearest(a, o, x, y) {
  const phi = a[o + 6];
  if (phi === 0) {
    const dx = a[o + 2] - a[o];
    const dy = a[o + 3] - a[o + 1];
    const square = dx * dx + dy * dy;
    if (square === 0) return 0;
    return Math.min(1, Math.max(0, ((x - a[o]) * dx + (y - a[o + 1]) * dy) / square));
  }
  if (x === a[o + 4] && y === a[o + 5]) return 0;
  let turn = (Math.atan2(y - a[o + 5], x - a[o + 4]) - segAngle(a, o)) * Math.sign(phi);
  turn -= Math.floor(turn / TURN) * TURN;
  const span = Math.abs(phi);
  if (turn <= span) return turn / span;
  // Outside of the arc: the nearer of its ends.
  const first = Math.hypot(x - a[o], y - a[o + 1]);
  const last = Math.hypot(x - a[o + 2], y - a[o + 3]);
  return first <= last ? 0 : 1;
}

const scratch = [0, 0];

/** Distance in mm of a point in mm from a segment. */
export function segDistance(a, o, x, y) {
  segPoint(a, o, segNearest(a, o, x, y), scratch);
  return Math.hypot(scratch[0] - x, scratch[1] - y);
}

/** Writes the bounding box x0 y0 x1 y1 of a segment in mm into box, beginning at index b. */
export function segBox(a, o, box, b) {
  let x0 = Math.min(a[o], a[o + 2]);
  let x1 = Math.max(a[o], a[o + 2]);
  let y0 = Math.min(a[o + 1], a[o + 3]);
  let y1 = Math.max(a[o + 1], a[o + 3]);
  const phi = a[o + 6];
  if (phi !== 0) {
    const r = segRadius(a, o);
    const begin = segAngle(a, o);
    const low = phi > 0 ? begin : begin + phi;
    const high = phi > 0 ? begin + phi : begin;
    // All multiples of a quarter turn between the two angles are extreme points.
    for (let q = Math.ceil(low / (TURN / 4)); q <= Math.floor(high / (TURN / 4)); q++) {
      const side = ((q % 4) + 4) % 4;
      if (side === 0) x1 = Math.max(x1, a[o + 4] + r);
      if (side === 1) y1 = Math.max(y1, a[o + 5] + r);
      if (side === 2) x0 = Math.min(x0, a[o + 4] - r);
      if (side === 3) y0 = Math.min(y0, a[o + 5] - r);
    }
  }
  box[b] = x0;
  box[b + 1] = y0;
  box[b + 2] = x1;
  box[b + 3] = y1;
  return box;
}

/** Bounding boxes of all segments of an array, four numbers in mm for each. */
export function boxes(a, stride) {
  const count = Math.floor(a.length / stride);
  const all = new Float64Array(4 * count);
  for (let i = 0; i < count; i++) segBox(a, i * stride, all, 4 * i);
  return all;
}

/** Smallest box x0 y0 x1 y1 in mm around boxes, or null when there are none. */
export function unite(...lists) {
  const out = [Infinity, Infinity, -Infinity, -Infinity];
  for (const list of lists) {
    for (let b = 0; b < list.length; b += 4) {
      if (list[b] < out[0]) out[0] = list[b];
      if (list[b + 1] < out[1]) out[1] = list[b + 1];
      if (list[b + 2] > out[2]) out[2] = list[b + 2];
      if (list[b + 3] > out[3]) out[3] = list[b + 3];
    }
  }
  return out[0] <= out[2] ? out : null;
}

/**
 * Index and distance in mm of the segment nearest to a point, or null when none is within reach.
 * @param accept tells of an index whether the segment may be taken
 */
export function nearest(a, stride, box, x, y, reach, accept = () => true) {
  let best = -1;
  let distance = reach;
  for (let i = 0, b = 0; b < box.length; i++, b += 4) {
    if (x < box[b] - distance || x > box[b + 2] + distance) continue;
    if (y < box[b + 1] - distance || y > box[b + 3] + distance) continue;
    if (!accept(i)) continue;
    const d = segDistance(a, i * stride, x, y);
    if (d < distance || (d === distance && best < 0)) {
      best = i;
      distance = d;
    }
  }
  return best < 0 ? null : { index: best, distance };
}

/** Twice the area in mm² that segments enclose; positive when they run counter-clockwise. */
export function doubleArea(a, from, count) {
  let sum = 0;
  for (let i = from; i < from + count; i++) {
    const o = 7 * i;
    sum += a[o] * a[o + 3] - a[o + 2] * a[o + 1];
    const phi = a[o + 6];
    if (phi !== 0) sum += segRadius(a, o) ** 2 * (phi - Math.sin(phi));
  }
  return sum;
}

/** Number of straight pieces that stay within a deviation in mm of a segment. */
export function pieces(a, o, deviation) {
  const phi = Math.abs(a[o + 6]);
  if (phi === 0) return 1;
  const r = segRadius(a, o);
  if (r <= deviation) return 4;
  const step = 2 * Math.acos(1 - deviation / r);
  return Math.max(2, Math.min(720, Math.ceil(phi / step)));
}

/**
 * Snap point nearest to a point, or null when none is within reach (all in mm): ends, middles and
 * centres of segments, holes, and points with names.
 * @returns {?{x: number, y: number, kind: string, radius: number}} radius of the arc, or 0
 */
export function snapPoint(lists, holes, points, x, y, reach) {
  let best = null;
  let distance = reach;
  const offer = (px, py, kind, radius, handicap) => {
    const d = Math.hypot(px - x, py - y) + handicap;
    if (d > distance) return;
    distance = d;
    best = { x: px, y: py, kind, radius };
  };
  const middle = [0, 0];
  for (const { a, stride, box, accept } of lists) {
    for (let i = 0, o = 0, b = 0; b < box.length; i++, o += stride, b += 4) {
      if (accept && !accept(i)) continue;
      const arc = a[o + 6] !== 0;
      if (arc) offer(a[o + 4], a[o + 5], 'centre', segRadius(a, o), 0.02 * reach);
      if (x < box[b] - reach || x > box[b + 2] + reach) continue;
      if (y < box[b + 1] - reach || y > box[b + 3] + reach) continue;
      offer(a[o], a[o + 1], 'node', 0, 0);
      offer(a[o + 2], a[o + 3], 'node', 0, 0);
      segPoint(a, o, 0.5, middle);
      offer(middle[0], middle[1], 'middle', arc ? segRadius(a, o) : 0, 0.1 * reach);
    }
  }
  for (let o = 0; o + 3 < holes.length; o += 4) {
    offer(holes[o], holes[o + 1], 'hole', holes[o + 2], 0);
  }
  for (const point of points) offer(point.x, point.y, point.name, 0, 0.05 * reach);
  return best;
}
