// The picture of a comparison: what is gone (dashed, with minus signs), what is new (solid, with
// plus signs), and the path of a second machine (dotted).

import { meets } from './chunks.js';
import { kindShown } from './planpath.js';
import { segPoint } from './geometry.js';

const MOST_SIGNS = 300;

/** Draws a comparison into the plan view. */
export function drawCompared(context, v, c, other, layers) {
  if (other.kind === 'none') return;
  if (other.kind === 'before') {
    drawPart(context, v, c.gone, other.gone, [7, 4], '\u2212');
    drawPart(context, v, c.new, other.fresh, [], '+');
    return;
  }
  v.toMm(context);
  const pixel = 1 / v.scale;
  const window = v.window();
  context.strokeStyle = c.other;
  context.lineWidth = 2 * pixel;
  context.lineCap = 'round';
  context.setLineDash([0.1 * pixel, 4 * pixel]);
  for (const chunk of other.chunks) {
    if (kindShown(layers, chunk.bin) && meets(chunk.box, 4 * pixel, window)) {
      context.stroke(chunk.path);
    }
  }
  context.setLineDash([]);
  context.lineCap = 'butt';
  if (other.apart && other.apart.distance > 0) drawApart(context, v, c, other.apart);
}

function drawPart(context, v, colour, { path, chunks }, dash, sign) {
  v.toMm(context);
  const pixel = 1 / v.scale;
  context.strokeStyle = colour;
  context.lineWidth = 2.5 * pixel;
  context.setLineDash(dash.map((d) => d * pixel));
  const window = v.window();
  for (const chunk of chunks) {
    if (meets(chunk.box, 4 * pixel, window)) context.stroke(chunk.path);
  }
  context.setLineDash([]);
  drawSigns(context, v, colour, path, sign);
}

function drawSigns(context, v, colour, path, sign) {
  v.toPixels(context);
  context.fillStyle = colour;
  context.font = 'bold 15px system-ui, sans-serif';
  const p = [0, 0];
  const every = Math.max(1, Math.ceil(path.count / MOST_SIGNS));
  for (let i = 0; i < path.count; i += every) {
    segPoint(path.seg, 9 * i, 0.5, p);
    context.fillText(sign, v.sx(p[0]) + 4, v.sy(p[1]) - 4);
  }
}

function drawApart(context, v, c, apart) {
  v.toPixels(context);
  context.strokeStyle = c.mark;
  context.lineWidth = 2;
  context.beginPath();
  context.arc(v.sx(apart.x), v.sy(apart.y), 9, 0, 2 * Math.PI);
  context.stroke();
}
