// What lies over the plan view and changes with each picture: the cutter and the measure.

/** Draws the cutter, the snap point under the pointer and the measured distance. */
export function drawOver(context, v, c, { plan, state, clock, now }) {
  v.toPixels(context);
  if (clock.started && state.frames && now) drawCutter(context, v, c, state, now);
  if (state.mode === 'measure') {
    drawMeasure(context, v, c, plan.measure);
    if (plan.hover) drawSnap(context, v, c, plan.hover);
    if (plan.cross) drawCross(context, c, plan.cross);
  }
}

function drawCutter(context, v, c, state, now) {
  const tool = state.drawing.header.tools[now.tool];
  const x = v.sx(now.x);
  const y = v.sy(now.y);
  const r = Math.max(3, (tool?.radius ?? 0) * v.scale);
  context.strokeStyle = c.cutter;
  context.fillStyle = c.cutter;
  context.lineWidth = 2;
  context.globalAlpha = 0.12;
  context.beginPath();
  context.arc(x, y, r, 0, 2 * Math.PI);
  context.fill();
  context.globalAlpha = 1;
  context.stroke();
  context.lineWidth = 1;
  if (tool?.kind === 'turning') diamond(context, x, y, r);
  if (tool?.kind === 'drill') cross(context, x, y, r * Math.SQRT1_2, true);
  else cross(context, x, y, Math.min(r, 9), false);
  context.beginPath();
  context.arc(x, y, 2.2, 0, 2 * Math.PI);
  context.fillStyle = c.mark;
  context.fill();
}

// A turning tool: a slender diamond that touches its nose circle, pointing to the spindle's axis.
function diamond(context, x, y, r) {
  const size = Math.max(22, 3 * r);
  context.beginPath();
  context.moveTo(x - r, y + r * 0.4);
  context.lineTo(x + size * 0.1, y - size);
  context.lineTo(x + size * 0.9, y - size * 1.3);
  context.lineTo(x + r * 0.9, y + r * 0.5);
  context.stroke();
}

function cross(context, x, y, size, slanted) {
  context.beginPath();
  if (slanted) {
    context.moveTo(x - size, y - size);
    context.lineTo(x + size, y + size);
    context.moveTo(x - size, y + size);
    context.lineTo(x + size, y - size);
  } else {
    context.moveTo(x - size, y);
    context.lineTo(x + size, y);
    context.moveTo(x, y - size);
    context.lineTo(x, y + size);
  }
  context.stroke();
}

// The cross with which the keyboard measures.
function drawCross(context, c, [x, y]) {
  context.strokeStyle = c.mark;
  context.lineWidth = 1;
  cross(context, x, y, 14, false);
}

function drawSnap(context, v, c, point) {
  if (!point.kind) return;
  const x = v.sx(point.x);
  const y = v.sy(point.y);
  context.strokeStyle = c.mark;
  context.lineWidth = 2;
  context.beginPath();
  if (point.kind === 'node') context.rect(x - 5, y - 5, 10, 10);
  else if (point.kind === 'middle') {
    context.moveTo(x - 6, y + 5);
    context.lineTo(x + 6, y + 5);
    context.lineTo(x, y - 6);
    context.closePath();
  } else context.arc(x, y, 6, 0, 2 * Math.PI);
  context.stroke();
}

function drawMeasure(context, v, c, measure) {
  if (!measure?.first) return;
  const a = measure.first;
  const b = measure.second ?? measure.hover;
  drawSnap(context, v, c, { ...a, kind: a.kind || 'node' });
  if (!b) return;
  drawSnap(context, v, c, { ...b, kind: b.kind || 'node' });
  const [x0, y0, x1, y1] = [v.sx(a.x), v.sy(a.y), v.sx(b.x), v.sy(b.y)];
  context.strokeStyle = c.mark;
  context.lineWidth = 2;
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
  context.lineWidth = 1;
  context.setLineDash([4, 3]);
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y0);
  context.lineTo(x1, y1);
  context.stroke();
  context.setLineDash([]);
}
