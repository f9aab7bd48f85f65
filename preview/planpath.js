// The toolpath in the plan view: its static layers, and what the playback paints over them.

import { CUT, LINK, RAPID, COMMANDS, sweeps } from './paths.js';
import { Pen } from './simplify.js';
import { follows, makeChunks, meets, penTrace, trace, tracePart } from './chunks.js';

const RUN = 300; // segments in one stroke

/** Parts of a path from which its lines are simplified. */
export const MANY = 4000;

const LEVELS = 3; // scales for which something is kept

/**
 * Keeps what is made for a size of a pixel in mm, for the last few scales: a power of 2 that is at
 * most the size of a pixel, or 0 if nothing has to be simplified.
 */
export function perScale(isSimplified, make) {
  const levels = new Map();
  return (scale) => {
    const level = isSimplified ? Math.ceil(Math.log2(scale)) : 0;
    if (!levels.has(level)) {
      if (levels.size >= LEVELS) levels.delete(levels.keys().next().value);
      levels.set(level, make(isSimplified ? 1 / 2 ** level : 0));
    }
    return levels.get(level);
  };
}

/**
 * Chunks of a path for its lines (coloured by a painter) and for its swept area (by tool). A long
 * path has chunks for each scale, in which lines are simplified to a quarter of a pixel.
 */
export function makePathChunks(path, paint, tools) {
  const radius = (k) => tools[k]?.radius ?? 0;
  const sweptBin = (i) => (sweeps(path, i) && radius(path.info[5 * i + 1]) > 0
    ? path.info[5 * i + 1] : -1);
  const at = perScale(path.count >= MANY, (pixel) => ({
    lines: makeChunks(path, paint.bin, 0.25 * pixel),
    swept: makeChunks(path, sweptBin, 0.5 * pixel),
  }));
  return { at, paint, radius };
}

/** Kind of the moves with a painter's number: numbers from 3 on are colours of cuts. */
function kindOf(bin) {
  return bin >= 3 ? CUT : bin;
}

/** Whether a kind of move is among the layers that are shown. */
export function kindShown(layers, kind) {
  if (kind === CUT) return layers.cuts;
  if (kind === LINK) return layers.links;
  return kind === RAPID && layers.rapids;
}

/** Draws the lines of a path; returns how many chunks were drawn. */
export function drawLines(context, v, chunks, layers, colour = null, width = 1.4) {
  v.toMm(context);
  const window = v.window();
  const pixel = 1 / v.scale;
  context.lineJoin = 'round';
  context.lineCap = 'butt';
  let drawn = 0;
  const { lines } = chunks.at(v.scale);
  for (const bin of new Set(lines.map((chunk) => chunk.bin))) {
    if (!kindShown(layers, kindOf(bin))) continue;
    const dashed = chunks.paint.dashed(bin);
    context.strokeStyle = colour ?? chunks.paint.colour(bin);
    context.lineWidth = (kindOf(bin) === CUT ? width : 1) * pixel;
    context.setLineDash(dashed ? [6 * pixel, 4 * pixel] : []);
    for (const chunk of lines) {
      if (chunk.bin !== bin || !meets(chunk.box, 4 * pixel, window)) continue;
      context.stroke(chunk.path);
      drawn += 1;
    }
  }
  context.setLineDash([]);
  return drawn;
}

/** Draws the whole swept area of a path, opaque; the canvas makes it translucent as one union. */
export function drawSwept(context, v, chunks, c) {
  v.toMm(context);
  const window = v.window();
  context.strokeStyle = c.swept;
  context.lineCap = 'round';
  context.lineJoin = 'round';
  for (const chunk of chunks.at(v.scale).swept) {
    const r = chunks.radius(chunk.bin);
    if (!meets(chunk.box, r, window)) continue;
    context.lineWidth = 2 * r;
    context.stroke(chunk.path);
  }
}

/**
 * Strokes the frames from a up to b without b, lines simplified to a quarter of a pixel. `style(i)`
 * gives a number for a frame's style, or −1 to leave it out; `apply(style)` sets it. `margin` in mm
 * is how far the strokes reach beyond the frames.
 */
export function strokeRange(context, v, path, a, b, margin, style, apply) {
  const window = v.window();
  const { seg, box } = path;
  const pen = new Pen(context, b - a < 64 ? 0 : 0.25 / v.scale);
  let open = -1;
  let count = 0;
  let last = -2;
  const close = () => {
    pen.flush();
    if (open >= 0) context.stroke();
  };
  for (let i = a; i < b; i++) {
    const k = style(i);
    const q = 4 * i;
    if (k < 0 || box[q + 2] + margin < window[0] || box[q] - margin > window[2]
      || box[q + 3] + margin < window[1] || box[q + 1] - margin > window[3]) continue;
    if (k !== open || count >= RUN) {
      close();
      apply(k);
      context.beginPath();
      open = k;
      count = 0;
      last = -2;
    }
    penTrace(pen, seg, 9 * i, last === i - 1 && follows(seg, 9 * i, 9));
    last = i;
    count += 1;
  }
  close();
}

/** Painters of the growing swept area: of whole frames and of a part of one. */
export function sweptPainters(v, get) {
  const style = (frames, tools) => (i) => {
    const tool = frames.info[5 * i + 1];
    return sweeps(frames, i) && (tools[tool]?.radius ?? 0) > 0 ? tool : -1;
  };
  const prepare = (context) => {
    v.toMm(context);
    context.lineCap = 'round';
    context.lineJoin = 'round';
  };
  return [
    (context, a, b) => {
      const { frames, tools, c } = get();
      prepare(context);
      context.strokeStyle = c.swept;
      const widest = tools.reduce((most, tool) => Math.max(most, tool.radius), 0);
      strokeRange(context, v, frames, a, b, widest, style(frames, tools), (tool) => {
        context.lineWidth = 2 * tools[tool].radius;
      });
    },
    (context, i, part) => {
      const { frames, tools, c } = get();
      const tool = style(frames, tools)(i);
      if (tool < 0) return;
      prepare(context);
      context.strokeStyle = c.swept;
      context.lineWidth = 2 * tools[tool].radius;
      context.beginPath();
      tracePart(context, frames.seg, 9 * i, part);
      context.stroke();
    },
  ];
}

/** Painters of the trace of the playback: of whole frames and of a part of one. */
export function tracePainters(v, get) {
  const prepare = (context, paint, bin) => {
    const pixel = 1 / v.scale;
    context.lineJoin = 'round';
    context.strokeStyle = paint.colour(bin);
    context.lineWidth = (kindOf(bin) === CUT ? 2 : 1.2) * pixel;
    context.setLineDash(paint.dashed(bin) ? [6 * pixel, 4 * pixel] : []);
  };
  const style = (frames, paint, layers) => (i) => {
    const kind = frames.info[5 * i];
    return kind === COMMANDS || !kindShown(layers, kind) ? -1 : paint.bin(i);
  };
  return [
    (context, a, b) => {
      const { frames, paint, layers } = get();
      v.toMm(context);
      strokeRange(context, v, frames, a, b, 4 / v.scale, style(frames, paint, layers),
        (bin) => prepare(context, paint, bin));
      context.setLineDash([]);
    },
    (context, i, part) => {
      const { frames, paint, layers } = get();
      const bin = style(frames, paint, layers)(i);
      if (bin < 0) return;
      v.toMm(context);
      prepare(context, paint, bin);
      context.beginPath();
      tracePart(context, frames.seg, 9 * i, part);
      context.stroke();
      context.setLineDash([]);
    },
  ];
}

/** Draws the parts of a path with the given indices, emphasised. */
export function markParts(context, v, c, path, indices) {
  v.toMm(context);
  context.strokeStyle = c.mark;
  context.lineWidth = 4 / v.scale;
  context.lineCap = 'round';
  context.globalAlpha = 0.75;
  context.beginPath();
  let count = 0;
  for (const i of indices) {
    if (path.info[5 * i] === COMMANDS) continue;
    trace(context, path.seg, 9 * i, false);
    count += 1;
    if (count % RUN === 0) {
      context.stroke();
      context.beginPath();
    }
  }
  context.stroke();
  context.globalAlpha = 1;
}
