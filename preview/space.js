// The three-dimensional view, drawn with WebGL 2.

import { Camera, SIDES } from './camera.js';
import { addSegment, boxLines, contourLines, cutterMesh, deepest, lineCollector, pathLines,
  turnedSurface, walls } from './mesh.js';
import { attachGestures } from './pointer.js';
import { colours, painter, parse } from './theme.js';
import { createRenderer } from './gl.js';
import { kindShown } from './planpath.js';
import { length, unitName } from './format.js';
import { partsOfLine } from './paths.js';
import { shownPath } from './plan.js';

/**
 * Makes the three-dimensional view. `tap({path, index, x, y})` is called for a click on a part of a
 * path at a place in mm, and with null for a click beside it.
 */
export function createSpace(element, store, clock, now, wake, tap) {
  const space = { camera: new Camera(), element, canvas: element.querySelector('canvas'),
    renderer: null, stale: true, fitted: false, touched: false, labels: new Map(), meshes: {},
    cutters: new Map(), marked: null, size: [1, 1], ratio: 1 };
  const parts = { space, store, clock, now, camera: space.camera };
  addMethods(parts, wake);
  attachGestures(element, {
    drag: (dx, dy, second) => space.panBy(dx, dy, second),
    zoom: (x, y, factor) => space.zoomAt(x, y, factor),
    tap: (x, y) => tap(pick(space, x, y)),
    hover: () => {},
    leave: () => {},
  });
  new ResizeObserver(space.resize).observe(element);
  return space;
}

function addMethods(parts, wake) {
  const { space, store, camera } = parts;
  Object.assign(space, {
    touch: () => wake(),
    draw: () => draw(parts),
    rebuild() {
      space.stale = true;
      wake();
    },
    resize() {
      resize(space);
      if (!space.touched) space.fitted = false;
      wake();
    },
    fit() {
      camera.fit(extents(store.state));
      space.fitted = true;
      wake();
    },
    side(name) {
      [camera.yaw, camera.height] = SIDES[name];
      space.fit();
    },
    zoomAt(x, y, factor) {
      space.touched = true;
      camera.zoom(x, y, factor);
      wake();
    },
    zoomBy: (factor) => space.zoomAt(camera.width / 2, camera.heightPixels / 2, factor),
    panBy(dx, dy, move) {
      space.touched = true;
      if (move) camera.pan(dx, dy);
      else camera.orbit(dx, dy);
      wake();
    },
  });
}

function resize(space) {
  const { element, canvas, camera } = space;
  const { clientWidth: width, clientHeight: height } = element;
  if (width === 0 || height === 0) return;
  const ratio = Math.min(2, window.devicePixelRatio || 1);
  camera.width = width;
  camera.heightPixels = height;
  space.ratio = ratio;
  const size = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== size[0] || canvas.height !== size[1]) {
    [canvas.width, canvas.height] = size;
  }
  space.size = size;
}

// Extents [[x, x], [y, y], [z, z]] in mm; for a turned part all around the axis of the spindle.
function extents(state) {
  const { drawing, frames } = state;
  let box = drawing?.header.extents?.map((span) => [...span]);
  if (!box && frames?.count) box = pathExtents(frames);
  box ??= [[0, 100], [0, 100], [0, 10]];
  if (drawing?.header.turned) {
    const r = Math.max(Math.abs(box[1][0]), Math.abs(box[1][1]));
    box[1] = [-r, r];
    box[2] = [-r, r];
  }
  return box;
}

function pathExtents(path) {
  const box = [[Infinity, -Infinity], [Infinity, -Infinity], [Infinity, -Infinity]];
  const take = (axis, value) => {
    box[axis][0] = Math.min(box[axis][0], value);
    box[axis][1] = Math.max(box[axis][1], value);
  };
  for (let i = 0; i < path.count; i++) {
    for (const k of [0, 2]) take(0, path.box[4 * i + k]);
    for (const k of [1, 3]) take(1, path.box[4 * i + k]);
    for (const k of [7, 8]) take(2, path.seg[9 * i + k]);
  }
  return box;
}

function start(space) {
  if (space.renderer || space.failed) return;
  try {
    space.renderer = createRenderer(space.canvas);
  } catch { /* As without WebGL. */ }
  space.failed = !space.renderer;
  space.element.querySelector('#space-fault').hidden = !space.failed;
  space.canvas.addEventListener('webglcontextlost', (event) => {
    event.preventDefault();
    space.renderer = null;
  });
  space.canvas.addEventListener('webglcontextrestored', () => {
    space.meshes = {};
    space.cutters.clear();
    space.marked = null;
    space.rebuild();
  });
}

function replace(space, name, kind, data) {
  space.renderer.free(space.meshes[name]);
  space.meshes[name] = data ? space.renderer[kind](data) : null;
}

// Makes all meshes that depend on the data, the layers and the colours.
function build({ space, store }) {
  const s = store.state;
  const { drawing, layers } = s;
  const c = colours();
  const { header } = drawing;
  const shown = shownPath(s);
  const bottom = header.turned ? 0 : deepest(shown);
  const turned = header.turned && layers.contours;
  const used = s.frames ?? shown;
  replace(space, 'contours', 'makeLines', layers.contours
    ? contourLines(drawing, parse(c.contour), parse(c.soft)) : null);
  replace(space, 'walls', 'makeFaces', layers.material && bottom < 0
    ? walls(drawing) : null);
  replace(space, 'surface', 'makeFaces', turned ? turnedSurface(drawing) : null);
  replace(space, 'box', 'makeLines', layers.grid ? boxLines(extents(s), parse(c.edge)) : null);
  space.shown = shown ? pathLines(shown, painter(shown, s.colour, header), layers) : null;
  space.shown &&= { ...space.shown, path: shown };
  replace(space, 'shown', 'makeLines', space.shown);
  replace(space, 'other', 'makeLines', otherLines(s, c));
  space.used = used === shown ? space.shown
    : used && { ...pathLines(used, painter(used, s.colour, header), layers), path: used };
  replace(space, 'used', 'makeLines', space.used);
  for (const mesh of space.cutters.values()) space.renderer.free(mesh);
  space.cutters.clear();
  space.marked = null;
  space.large = Math.max(...extents(s).map(([low, high]) => high - low));
  space.stale = false;
}

// What is compared: the path of a second machine, or what is gone and what is new.
function otherLines({ other, layers }, c) {
  if (!other || other.kind === 'none') return null;
  const lines = lineCollector();
  const add = (path, colour, dashed) => {
    for (let i = 0; i < path.count; i++) {
      const kind = path.info[5 * i];
      if (kind === 3 || !kindShown(layers, kind)) continue;
      addSegment(lines, path.seg, 9 * i, path.seg[9 * i + 7], path.seg[9 * i + 8], parse(colour),
        dashed);
    }
  };
  if (other.kind === 'machine') add(other.path, c.other, true);
  else {
    add(other.gone.path, c.gone, true);
    add(other.fresh.path, c.new, false);
  }
  return lines.data();
}

function draw(parts) {
  const { space, store, camera } = parts;
  start(space);
  if (!space.renderer || !store.state.drawing || camera.width <= 1) return;
  if (space.stale) build(parts);
  if (!space.fitted) space.fit();
  const c = colours();
  const { renderer, meshes, size, ratio } = space;
  const matrix = camera.matrix();
  const { back, up, right } = camera.directions();
  const light = back.map((v, k) => 0.75 * v + 0.55 * up[k] - 0.35 * right[k]);
  const base = { matrix, size, light };
  renderer.begin(...size, parse(c.paper));
  renderer.drawLines(meshes.box, { ...base, width: ratio });
  renderer.drawLines(meshes.contours, { ...base, width: 2 * ratio, near: 1e-4 });
  drawPath(parts, base);
  renderer.drawLines(meshes.other, { ...base, width: 2.5 * ratio, near: 2e-4 });
  drawMarks(parts, base, c);
  drawTripod(parts, base, c);
  drawCutter(parts, base, c);
  renderer.drawFaces(meshes.walls, { ...base, tint: parse(c.soft), opacity: 0.16 });
  renderer.drawFaces(meshes.surface, { ...base, tint: parse(c.soft), opacity: 0.4 });
  drawLabels(parts, matrix);
}

// Before the playback the path as it is; then the frames that are done, and faintly all others.
function drawPath({ space, store, clock, now }, base) {
  const { renderer, meshes, ratio, used } = space;
  const at = clock.started && used ? now() : null;
  if (!at) {
    renderer.drawLines(meshes.shown, { ...base, width: 1.5 * ratio });
    return;
  }
  const done = at.frame < 0 ? 0 : used.first[at.part >= 1 ? at.frame + 1 : at.frame];
  renderer.drawLines(meshes.used, { ...base, width: 1.8 * ratio, done, rest: 0.22 });
  if (at.frame < 0 || at.part >= 1 || at.part <= 0) return;
  const { frames } = store.state;
  if (frames.info[5 * at.frame] === 3) return;
  const lines = lineCollector();
  const o = 9 * at.frame;
  const paint = painterOf(store.state);
  addSegment(lines, frames.seg, o, frames.seg[o + 7], frames.seg[o + 8],
    parse(paint.colour(paint.bin(at.frame))), false, at.part);
  once(renderer, lines, { ...base, width: 2.2 * ratio });
}

const painters = new WeakMap();

function painterOf(state) {
  const key = state.frames;
  const known = painters.get(key);
  const mark = `${state.colour} ${state.scheme}`;
  if (known?.mark === mark) return known.paint;
  const paint = painter(key, state.colour, state.drawing.header);
  painters.set(key, { mark, paint });
  return paint;
}

function once(renderer, lines, options) {
  const mesh = renderer.makeLines(lines.data());
  renderer.drawLines(mesh, options);
  renderer.free(mesh);
}

function drawMarks({ space, store }, base, c) {
  const s = store.state;
  if (space.marked !== s.selection) {
    const lines = lineCollector();
    const add = (path, i) => addSegment(lines, path.seg, 9 * i, path.seg[9 * i + 7],
      path.seg[9 * i + 8], parse(c.mark), false);
    const { file, line, frame } = s.selection;
    if (frame >= 0 && s.frames && frame < s.frames.count) add(s.frames, frame);
    else if (file >= 0) {
      const path = shownPath(s);
      for (const i of path ? partsOfLine(path, file, line) : []) {
        if (path.info[5 * i] !== 3) add(path, i);
      }
      const { contour, contourPlace } = s.drawing.arrays;
      for (let i = 0; i < contour.length / 7; i++) {
        if (contourPlace[2 * i] === file && contourPlace[2 * i + 1] === line) {
          addSegment(lines, contour, 7 * i, 0, 0, parse(c.mark), false);
        }
      }
    }
    replace(space, 'marks', 'makeLines', lines.count() > 0 ? lines.data() : null);
    space.marked = s.selection;
  }
  space.renderer.drawLines(space.meshes.marks, { ...base, width: 4 * space.ratio, near: 3e-4 });
}

function drawTripod({ space, store, camera }, base, c) {
  if (!store.state.layers.grid) return;
  const long = 56 / camera.scale;
  const lines = lineCollector();
  const shades = [c.rapid, c.link, c.cut].map(parse);
  for (let k = 0; k < 3; k++) {
    const end = [0, 0, 0];
    end[k] = long;
    lines.add(0, 0, 0, ...end, shades[k], false);
  }
  once(space.renderer, lines, { ...base, width: 2.5 * space.ratio, near: 5e-4 });
}

function drawCutter({ space, store, clock, now }, base, c) {
  const at = clock.started ? now() : null;
  if (!at) return;
  const tool = store.state.drawing.header.tools[at.tool] ?? { kind: 'mill', radius: 0 };
  if (!space.cutters.has(at.tool)) {
    space.cutters.set(at.tool, space.renderer.makeFaces(cutterMesh(tool, space.large)));
  }
  space.renderer.drawFaces(space.cutters.get(at.tool), { ...base, tint: parse(c.other),
    shift: [at.x, at.y, at.z] });
}

function label(space, key, text, at) {
  let span = space.labels.get(key);
  if (!span) {
    span = document.createElement('span');
    space.element.querySelector('#space-labels').append(span);
    space.labels.set(key, span);
  }
  if (span.textContent !== text) span.textContent = text;
  span.hidden = !at;
  if (at) span.style.transform = `translate(${at[0]}px, ${at[1]}px) translate(-50%, -50%)`;
}

function drawLabels({ space, store, camera }, matrix) {
  const s = store.state;
  const { unit } = s.drawing.header;
  const box = extents(s);
  const { back } = camera.directions();
  const shown = s.layers.grid;
  const long = 68 / camera.scale;
  ['x', 'y', 'z'].forEach((name, k) => {
    const end = [0, 0, 0];
    end[k] = long;
    const visible = shown && Math.abs(back[k]) < 0.98;
    label(space, name, name, visible ? camera.project(matrix, ...end, [0, 0]) : null);
    // The edge of the box that is in front, with its length.
    const at = [0, 1, 2].map((i) => box[i][back[i] > 0 ? 1 : 0]);
    if (k !== 2) at[2] = box[2][0];
    else at[1] = box[1][back[0] > 0 ? 0 : 1];
    at[k] = (box[k][0] + box[k][1]) / 2;
    const size = box[k][1] - box[k][0];
    label(space, `size ${name}`, `${name} ${length(size, unit)} ${unitName(unit)}`,
      visible && size > 0 ? camera.project(matrix, ...at, [0, 0]) : null);
  });
}

// Part of the path that is drawn within 8 pixels of a place in CSS pixels, or null.
function pick(space, x, y) {
  const { shown, camera } = space;
  if (!shown) return null;
  const matrix = camera.matrix();
  const [a, b] = [[0, 0], [0, 0]];
  let best = -1;
  let distance = 8;
  for (let i = 0; i < shown.places.length; i += 6) {
    const q = shown.places;
    camera.project(matrix, q[i], q[i + 1], q[i + 2], a);
    camera.project(matrix, q[i + 3], q[i + 4], q[i + 5], b);
    const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    const square = dx * dx + dy * dy;
    const along = (x - a[0]) * dx + (y - a[1]) * dy;
    const t = square > 0 ? Math.max(0, Math.min(1, along / square)) : 0;
    const d = Math.hypot(a[0] + t * dx - x, a[1] + t * dy - y);
    if (d < distance) {
      distance = d;
      best = i / 6;
    }
  }
  if (best < 0) return null;
  let [low, high] = [0, shown.path.count];
  while (low < high) {
    const middle = (low + high + 1) >>> 1;
    if (shown.first[middle] <= best) low = middle;
    else high = middle - 1;
  }
  const q = 6 * best;
  return { path: shown.path, index: low, x: shown.places[q], y: shown.places[q + 1] };
}
