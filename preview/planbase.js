// What stands still in the plan view: grid, axes, part, contours, holes, rest material and nodes.

import { doubleArea, segAngle, segLength, segPoint } from './geometry.js';
import { follows, penTrace, trace } from './chunks.js';
import { Pen } from './simplify.js';
import { unitSize } from './format.js';

/** Shapes of a drawing as Path2D in mm, with lines simplified within a tolerance in mm. */
export function makeShapes(drawing, tolerance) {
  const { contour, hole, rest } = drawing.arrays;
  const shapes = { lines: new Path2D(), body: new Path2D(), hasBody: false,
    rest: new Path2D(), sides: [] };
  const lines = new Pen(shapes.lines, tolerance);
  const body = new Pen(shapes.body, tolerance);
  for (const item of drawing.header.contours) {
    const end = item.from + item.count;
    for (let i = item.from; i < end; i++) {
      penTrace(lines, contour, 7 * i, i > item.from && follows(contour, 7 * i, 7));
    }
    lines.flush();
    if (!item.closed || item.side === 'unknown') continue;
    for (let i = item.from; i < end; i++) penTrace(body, contour, 7 * i, i > item.from);
    body.flush();
    shapes.body.closePath();
    shapes.hasBody = true;
    const left = (doubleArea(contour, item.from, item.count) > 0) === (item.side === 'inside');
    shapes.sides.push({ from: item.from, end, sign: left ? 1 : -1 });
  }
  for (let o = 0; o + 3 < hole.length; o += 4) {
    shapes.body.moveTo(hole[o] + hole[o + 2], hole[o + 1]);
    shapes.body.arc(hole[o], hole[o + 1], hole[o + 2], 0, 2 * Math.PI);
  }
  for (let o = 0; o + 6 < rest.length; o += 7) {
    trace(shapes.rest, rest, o, follows(rest, o, 7));
  }
  return shapes;
}

/** Distance in mm between the lines of the grid: 1, 2 or 5 times a power of ten of the unit. */
export function gridStep(scale, unit, pixels) {
  const size = unitSize(unit);
  const want = pixels / (scale * size);
  const power = 10 ** Math.floor(Math.log10(want));
  const step = [1, 2, 5, 10].find((k) => k * power >= want) * power;
  return step * size;
}

/** Draws the grid and the axes; for a turned part the axis of the spindle. */
export function drawGrid(context, v, c, header) {
  v.toPixels(context);
  context.lineWidth = 1;
  const step = gridStep(v.scale, header.unit, 18);
  const strong = gridStep(v.scale, header.unit, 90);
  for (const [distance, colour] of [[step, c.grid], [strong, c['grid-strong']]]) {
    const [x0, y0, x1, y1] = v.window();
    context.strokeStyle = colour;
    context.beginPath();
    for (let k = Math.ceil(x0 / distance); k * distance <= x1; k++) {
      const x = Math.round(v.sx(k * distance)) + 0.5;
      context.moveTo(x, 0);
      context.lineTo(x, v.height);
    }
    for (let k = Math.ceil(y0 / distance); k * distance <= y1; k++) {
      const y = Math.round(v.sy(k * distance)) + 0.5;
      context.moveTo(0, y);
      context.lineTo(v.width, y);
    }
    context.stroke();
  }
  drawAxes(context, v, c, header.turned);
}

function drawAxes(context, v, c, turned) {
  const x = Math.round(v.sx(0)) + 0.5;
  const y = Math.round(v.sy(0)) + 0.5;
  context.strokeStyle = c.soft;
  context.fillStyle = c.soft;
  context.globalAlpha = 0.65;
  line(context, x, 0, x, v.height);
  if (turned) context.setLineDash([18, 4, 3, 4]);
  line(context, 0, y, v.width, y);
  context.setLineDash([]);
  context.globalAlpha = 1;
  context.font = '12px system-ui, sans-serif';
  const inside = (value, size) => Math.min(size - 14, Math.max(14, value));
  context.fillText('x', v.width - 14, inside(y - 6, v.height));
  context.fillText(turned ? 'radius' : 'y', inside(x + 6, v.width - 40), 42);
}

function line(context, x0, y0, x1, y1) {
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}

/** Draws the part: its body, material side, contours, holes, rest material and nodes. */
export function drawPart(context, v, c, drawing, shapes, layers) {
  const { header, arrays } = drawing;
  v.toMm(context);
  const pixel = 1 / v.scale;
  if (layers.material && shapes.hasBody) {
    context.fillStyle = c.part;
    context.fill(shapes.body, 'evenodd');
  }
  if (layers.rest && arrays.rest.length > 0) drawRest(context, c, shapes, pixel);
  if (layers.contours) {
    context.strokeStyle = c.contour;
    context.lineWidth = 2 * pixel;
    context.lineJoin = 'round';
    context.stroke(shapes.lines);
    if (header.turned) drawMirrored(context, v, shapes);
  }
  if (layers.material) drawSides(context, v, c, arrays.contour, shapes.sides);
  if (layers.holes) drawHoles(context, v, c, arrays.hole);
  if (layers.nodes) drawNodes(context, v, c, arrays.contour, 7);
  if (layers.points) drawPoints(context, v, c, header.points);
}

// Crosses with the names of points. A name that would cover the one before is left out.
function drawPoints(context, v, c, points) {
  v.toPixels(context);
  context.strokeStyle = c.soft;
  context.fillStyle = c.soft;
  context.lineWidth = 1;
  context.font = '11px system-ui, sans-serif';
  let last = null;
  for (const point of points) {
    const x = Math.round(v.sx(point.x)) + 0.5;
    const y = Math.round(v.sy(point.y)) + 0.5;
    if (x < 0 || y < 0 || x > v.width || y > v.height) continue;
    line(context, x - 4, y, x + 4, y);
    line(context, x, y - 4, x, y + 4);
    if (last && Math.hypot(x - last[0], y - last[1]) < 24) continue;
    context.fillText(point.name, x + 6, y - 5);
    last = [x, y];
  }
}

function drawMirrored(context, v, shapes) {
  context.save();
  context.scale(1, -1);
  context.globalAlpha = 0.45;
  context.setLineDash([5 / v.scale, 3 / v.scale]);
  context.stroke(shapes.lines);
  context.restore();
}

function drawRest(context, c, shapes, pixel) {
  context.fillStyle = c.rest;
  context.globalAlpha = 0.3;
  context.fill(shapes.rest, 'evenodd');
  context.globalAlpha = 1;
  context.strokeStyle = c.rest;
  context.lineWidth = 1.5 * pixel;
  context.setLineDash([3 * pixel, 3 * pixel]);
  context.stroke(shapes.rest);
  context.setLineDash([]);
}

// Short strokes on the side of the material, 9 pixels apart.
function drawSides(context, v, c, contour, sides) {
  const segments = sides.reduce((sum, side) => sum + side.end - side.from, 0);
  if (segments > 5000) return;
  v.toPixels(context);
  context.strokeStyle = c.soft;
  context.lineWidth = 1;
  context.beginPath();
  const p = [0, 0];
  for (const { from, end, sign } of sides) {
    let rest = 4.5;
    for (let i = from; i < end; i++) {
      const o = 7 * i;
      const pixels = segLength(contour, o) * v.scale;
      if (pixels > 40000) continue;
      for (; rest < pixels; rest += 9) {
        const t = rest / pixels;
        segPoint(contour, o, t, p);
        const x = v.sx(p[0]);
        const y = v.sy(p[1]);
        if (x < -10 || y < -10 || x > v.width + 10 || y > v.height + 10) continue;
        const angle = direction(contour, o, t) + sign * (Math.PI / 4);
        context.moveTo(x, y);
        context.lineTo(x + 7 * Math.cos(angle), y - 7 * Math.sin(angle));
      }
      rest -= pixels;
    }
  }
  context.stroke();
}

function direction(a, o, t) {
  const phi = a[o + 6];
  if (phi === 0) return Math.atan2(a[o + 3] - a[o + 1], a[o + 2] - a[o]);
  return segAngle(a, o) + t * phi + Math.sign(phi) * (Math.PI / 2);
}

function drawHoles(context, v, c, hole) {
  v.toPixels(context);
  context.strokeStyle = c.contour;
  for (let o = 0; o + 3 < hole.length; o += 4) {
    const x = v.sx(hole[o]);
    const y = v.sy(hole[o + 1]);
    const r = Math.max(1.5, hole[o + 2] * v.scale);
    if (x + r < 0 || y + r < 0 || x - r > v.width || y - r > v.height) continue;
    context.lineWidth = 1.5;
    context.beginPath();
    context.arc(x, y, r, 0, 2 * Math.PI);
    context.stroke();
    context.lineWidth = 0.75;
    line(context, x - r - 4, y, x + r + 4, y);
    line(context, x, y - r - 4, x, y + r + 4);
  }
}

/** Draws small squares at the ends of segments, each `stride` numbers long. */
export function drawNodes(context, v, c, a, stride, accept = () => true) {
  v.toPixels(context);
  context.fillStyle = c.contour;
  let many = 0;
  for (let i = 0, o = 0; o < a.length; i++, o += stride) {
    if (!accept(i)) continue;
    for (const k of [0, 2]) {
      const x = v.sx(a[o + k]);
      const y = v.sy(a[o + k + 1]);
      if (x < 0 || y < 0 || x > v.width || y > v.height || many > 40000) continue;
      context.fillRect(x - 2, y - 2, 4, 4);
      many += 1;
    }
  }
}

/** Draws the parts of a contour that come from a line, emphasised. */
export function markContour(context, v, c, drawing, file, line0) {
  const { contour, contourPlace } = drawing.arrays;
  v.toMm(context);
  context.beginPath();
  let some = false;
  for (let i = 0; i < contour.length / 7; i++) {
    if (contourPlace[2 * i] !== file || contourPlace[2 * i + 1] !== line0) continue;
    trace(context, contour, 7 * i, false);
    some = true;
  }
  if (!some) return;
  context.strokeStyle = c.mark;
  context.lineWidth = 4 / v.scale;
  context.stroke();
}
