// The plan view: a stack of canvases, each of which is drawn again only when it must be.

import { attachGestures } from './pointer.js';
import { colours, painter } from './theme.js';
import { Growing } from './growing.js';
import { Viewport } from './viewport.js';
import { drawGrid, drawNodes, drawPart, makeShapes, markContour } from './planbase.js';
import { MANY, drawLines, drawSwept, makePathChunks, markParts, perScale, sweptPainters,
  tracePainters } from './planpath.js';
import { drawCompared } from './comparedraw.js';
import { drawOver } from './planover.js';
import { extentsOf, partsOfLine } from './paths.js';

const NAMES = ['base', 'swept', 'path', 'trace', 'mark', 'over'];
const HEAVY = 6000; // parts of a path from which a gesture moves the picture before it is redrawn
const HEAD = 28; // CSS pixels of the legend above the picture
const PAUSE = 200; // ms without a gesture until such a picture is redrawn

/**
 * Makes the plan view. `now()` gives the cutter's place at the present tick, `wake()` asks for
 * a picture, and `on` has tap, hover (both with x, y and the size of a pixel, in mm), leave and
 * moved.
 */
export function createPlan(element, store, clock, now, wake, on) {
  const v = new Viewport();
  const canvases = {};
  const context = {};
  for (const name of NAMES) {
    canvases[name] = element.querySelector(`#plan-${name}`);
    context[name] = canvases[name].getContext('2d');
  }
  const plan = {
    viewport: v, element, dirty: new Set(NAMES), fitted: false, touched: false, shapes: null,
    chunks: null, gesture: 0, drawn: null, hover: null, measure: null,
  };
  const get = () => ({ frames: store.state.frames, tools: store.state.drawing.header.tools,
    c: colours(), paint: plan.framePaint, layers: store.state.layers });
  const swept = new Growing(canvases.swept, ...sweptPainters(v, get));
  const trace = new Growing(canvases.trace, ...tracePainters(v, get));
  const parts = { plan, v, canvases, context, store, clock, now, swept, trace };
  addMethods(parts, wake, on);
  gestures(parts, on);
  new ResizeObserver(plan.resize).observe(element);
  return plan;
}

function addMethods(parts, wake, on) {
  const { plan, v, store } = parts;
  Object.assign(plan, {
    /** Marks canvases to be drawn again; all of them when none is named. */
    touch(...names) {
      for (const name of names.length > 0 ? names : NAMES) plan.dirty.add(name);
      wake();
    },
    draw: () => draw(parts, wake),
    resize: () => resize(parts),
    rebuild: () => rebuild(parts),
    fit() {
      const { drawing, moves, frames } = store.state;
      const box = extentsOf(drawing, moves, frames);
      const r = Math.max(0, ...(drawing?.header.tools ?? []).map((tool) => tool.radius));
      if (box) v.fit([box[0] - r, box[1] - r, box[2] + r, box[3] + r], HEAD);
      plan.fitted = Boolean(box);
      plan.touch();
      on.moved();
    },
    moved() {
      plan.gesture = performance.now();
      plan.touched = true;
      plan.touch();
      on.moved();
    },
    zoomBy(factor) {
      v.zoom(v.width / 2, v.height / 2, factor);
      plan.moved();
    },
    panBy(dx, dy) {
      v.pan(dx, dy);
      plan.moved();
    },
  });
}

function gestures({ plan, v }, on) {
  attachGestures(plan.element, {
    drag: (dx, dy) => plan.panBy(dx, dy),
    zoom: (x, y, factor) => {
      v.zoom(x, y, factor);
      plan.moved();
    },
    tap: (x, y) => on.tap(v.wx(x), v.wy(y), 1 / v.scale),
    hover: (x, y) => on.hover(v.wx(x), v.wy(y), 1 / v.scale),
    leave: () => on.leave(),
  });
}

function resize({ plan, v, canvases, store }) {
  const { clientWidth: width, clientHeight: height } = plan.element;
  const ratio = Math.min(3, window.devicePixelRatio || 1);
  if (width === 0 || height === 0) return;
  if (v.width === width && v.height === height && v.ratio === ratio) return;
  Object.assign(v, { width, height, ratio });
  for (const name of NAMES) {
    canvases[name].width = Math.round(width * ratio);
    canvases[name].height = Math.round(height * ratio);
  }
  plan.drawn = null;
  if (!plan.touched && store.state.drawing) plan.fit();
  else plan.touch();
}

// Makes the shapes and chunks of the present data again.
function rebuild({ plan, store }) {
  const s = store.state;
  if (!s.drawing) return;
  const { drawing } = s;
  const isLarge = drawing.arrays.contour.length / 7 >= MANY;
  plan.shapes = perScale(isLarge, (pixel) => makeShapes(drawing, 0.25 * pixel));
  const { tools } = s.drawing.header;
  const path = shownPath(s);
  plan.chunks = path
    ? makePathChunks(path, painter(path, s.colour, s.drawing.header), tools) : null;
  plan.framePaint = s.frames ? painter(s.frames, s.colour, s.drawing.header) : null;
  plan.heavy = (path?.count ?? 0) > HEAVY || (s.frames?.count ?? 0) > HEAVY;
  if (!plan.fitted && plan.viewport.width > 1) plan.fit();
  plan.touch();
}

/** Path that the picture shows: that of the program, or that of the machine. */
export function shownPath(state) {
  if (state.source === 'frame' && state.frames) return state.frames;
  return state.moves && state.moves.count > 0 ? state.moves : state.frames ?? state.moves;
}

function draw(parts, wake) {
  const { plan, v, context } = parts;
  if (v.width <= 1) return;
  if (plan.heavy && plan.drawn && shift(parts)) {
    wake(PAUSE);
    drawTop(parts);
    return;
  }
  const dirty = plan.dirty;
  plan.unfinished = false;
  if (dirty.has('base')) {
    clear(context.base);
    base(parts);
  }
  if (dirty.has('path')) {
    clear(context.path);
    paths(parts);
  }
  grow(parts);
  if (dirty.has('mark')) {
    clear(context.mark);
    marks(parts);
  }
  drawTop(parts);
  dirty.clear();
  settle(parts);
  if (plan.unfinished) wake();
}

// During a gesture with much to draw: moves the canvases as they are. Tells whether it did.
function shift({ plan, v, canvases }) {
  const since = performance.now() - plan.gesture;
  const d = plan.drawn;
  const same = d.x === v.x && d.y === v.y && d.scale === v.scale;
  if (since > PAUSE || same) return false;
  const k = v.scale / d.scale;
  const x = (d.x - v.x) * v.scale + (v.width / 2) * (1 - k);
  const y = (v.y - d.y) * v.scale + (v.height / 2) * (1 - k);
  for (const name of NAMES.slice(0, 5)) {
    canvases[name].style.transform = `translate(${x}px, ${y}px) scale(${k})`;
  }
  return true;
}

function settle({ plan, v, canvases }) {
  plan.drawn = v.copy();
  for (const name of NAMES) {
    if (canvases[name].style.transform) canvases[name].style.transform = '';
  }
}

function clear(context) {
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.clearRect(0, 0, context.canvas.width, context.canvas.height);
}

function base({ plan, v, context, store }) {
  const { drawing, layers } = store.state;
  if (!drawing?.header.drawn) return;
  const c = colours();
  if (layers.grid) drawGrid(context.base, v, c, drawing.header);
  if (plan.shapes) drawPart(context.base, v, c, drawing, plan.shapes(v.scale), layers);
}

function paths({ plan, v, context, store }) {
  const s = store.state;
  const c = colours();
  if (plan.chunks) drawLines(context.path, v, plan.chunks, s.layers);
  if (s.layers.frames && s.frames) {
    drawNodes(context.path, v, c, s.frames.seg, 9, (i) => s.frames.info[5 * i] !== 3);
  }
}

// The swept area and the trace: whole while the playback is unused, else as far as it is.
function grow({ plan, v, context, store, clock, now, swept, trace }) {
  const s = store.state;
  const used = Boolean(clock.started && s.frames);
  plan.element.classList.toggle('playing-used', used);
  if (used !== plan.used) plan.dirty.add('swept').add('trace');
  plan.used = used;
  if (plan.dirty.has('swept')) swept.reset();
  if (plan.dirty.has('trace')) trace.reset();
  if (!used) {
    if (plan.dirty.has('swept') && s.layers.swept && plan.chunks) {
      drawSwept(context.swept, v, plan.chunks, colours());
    }
    return;
  }
  const { frame, part } = now();
  const index = Math.max(0, frame);
  const fraction = frame < 0 ? 0 : part;
  const all = !s.layers.swept || swept.advance(index, fraction, clock.tick);
  if (!trace.advance(index, fraction, clock.tick) || !all) plan.unfinished = true;
}

function marks({ v, context, store }) {
  const s = store.state;
  if (!s.drawing) return;
  const c = colours();
  if (s.other) drawCompared(context.mark, v, c, s.other, s.layers);
  const { file, line, frame } = s.selection;
  if (file >= 0) {
    markContour(context.mark, v, c, s.drawing, file, line);
    for (const path of new Set([shownPath(s), s.frames])) {
      if (path && frame < 0) {
        markParts(context.mark, v, c, path, partsOfLine(path, file, line));
      }
    }
  }
  if (frame >= 0 && s.frames && frame < s.frames.count) {
    markParts(context.mark, v, c, s.frames, [frame]);
  }
}

function drawTop({ plan, v, context, store, clock, now }) {
  clear(context.over);
  drawOver(context.over, v, colours(), { plan, state: store.state, clock, now: now() });
}
