// Measuring between two points of the plan view.

import { length, unitName } from './format.js';
import { snapPoint } from './geometry.js';
import { shownPath } from './plan.js';
import { kindShown } from './planpath.js';
import { boxes } from './geometry.js';

const REACH = 10; // CSS pixels

/** Point in mm at a place in mm, snapped if something is near; `pixel` is the size of a pixel. */
export function snapAt(store, x, y, pixel) {
  const { drawing, layers } = store.state;
  if (!drawing) return { x, y, kind: '', radius: 0 };
  const { contour, hole } = drawing.arrays;
  drawing.contourBox ??= boxes(contour, 7);
  const lists = [{ a: contour, stride: 7, box: drawing.contourBox }];
  const path = shownPath(store.state);
  if (path) {
    lists.push({ a: path.seg, stride: 9, box: path.box,
      accept: (i) => kindShown(layers, path.info[5 * i]) });
  }
  const named = layers.points ? drawing.header.points : [];
  const point = snapPoint(lists, hole, named, x, y, REACH * pixel);
  return point ?? { x, y, kind: '', radius: 0 };
}

/** Takes a click in measuring mode: the first or the second point. */
export function click(plan, point) {
  const { measure } = plan;
  if (!measure?.first || measure.second) plan.measure = { first: point, second: null, hover: null };
  else plan.measure = { ...measure, second: point };
}

/** Text of a measure in the program's unit. */
export function measureText(measure, unit) {
  if (!measure?.first) return 'Choose the first point.';
  const a = measure.first;
  const name = unitName(unit);
  const value = (mm) => `${length(mm, unit)} ${name}`;
  if (!measure.second) {
    return `First point at (${length(a.x, unit)}, ${length(a.y, unit)})${about(a, value)}. `
      + 'Choose the second point.';
  }
  const b = measure.second;
  const distance = Math.hypot(b.x - a.x, b.y - a.y);
  return `Distance ${value(distance)}, Δx ${value(b.x - a.x)}, Δy ${value(b.y - a.y)}`
    + `${about(a, value, 'first')}${about(b, value, 'second')}`;
}

function about(point, value, which = '') {
  if (!point.kind) return '';
  const names = { node: 'node', centre: 'centre of an arc', middle: 'middle', hole: 'hole' };
  const radius = point.radius ? `, radius ${value(point.radius)}` : '';
  return `${which ? `; ${which}:` : ','} ${names[point.kind] ?? `point ${point.kind}`}${radius}`;
}
