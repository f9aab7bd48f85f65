// The tape under the read head: rows of holes with their meanings, or the lines of a text.

import { colours } from './theme.js';
import { createList, span } from './vlist.js';
import { fetchRows } from './data.js';
import { frameOfRow } from './now.js';
import { rowAt } from './position.js';

const HIGH = 18; // CSS pixels of a row
const PITCH = 14; // CSS pixels between tracks
const PAGE = 250; // rows fetched at once
const MOST_PAGES = 40;

/** Makes the view of the tape. `choose(frame)` is called for a click on a line of a text. */
export function createTape(elements, store, clock, choose) {
  const view = { pages: new Map(), lines: [], line: -1, row: -1, elements, rows: [] };
  view.list = createList(elements.text, 'Text that the machine reads',
    (row, i) => fillLine(view, row, i),
    (i) => {
      const frame = frameOfRow(store.state.run, i);
      if (frame >= 0) choose(frame);
    });
  elements.rows.addEventListener('click', (event) => {
    const frame = view.rows.find((at) => at.item.contains(event.target))?.frame;
    if (Number.isInteger(frame)) choose(frame);
  });
  store.on(['run'], (s) => load(view, s.run));
  new ResizeObserver(() => { view.row = -1; }).observe(elements.holes);
  view.touch = () => { view.row = -1; };
  view.catchUp = () => {
    if (view.line >= 0) view.list.reveal(view.line);
  };
  view.draw = (follow) => draw(view, store.state, clock, follow);
  return view;
}

function load(view, run) {
  const { elements } = view;
  const has = Boolean(run) && run.arrays.frame.length > 0;
  view.pages.clear();
  view.row = -1;
  view.line = -1;
  elements.none.hidden = has;
  elements.none.textContent = has ? '' : 'There is no tape. Choose a machine to make one.';
  elements.holes.hidden = !has || run.header.tracks === 0;
  elements.text.hidden = !has || run.header.tracks > 0;
  elements.tab.textContent = has && run.header.tracks === 0 ? 'G-code' : 'Tape';
  view.lines = has && run.header.tracks === 0 ? run.header.text.split('\n') : [];
  view.list.setCount(view.lines.length);
}

function fillLine(view, row, i) {
  row.append(span(String(i + 1), 'num'), span(view.lines[i] || ' '));
  if (i === view.line) row.classList.add('present');
}

function draw(view, state, clock, follow) {
  const { run } = state;
  if (!run || run.arrays.frame.length === 0) return;
  const row = rowAt(run, clock.tick);
  if (run.header.tracks === 0) {
    const line = Math.round(row);
    if (line === view.line || view.elements.text.clientHeight === 0) return;
    view.line = line;
    if (follow) view.list.reveal(line);
    view.list.refresh();
  } else if (row !== view.row && view.elements.holes.clientHeight > 0) {
    view.row = row;
    drawHoles(view, state, row);
  }
}

/** Tracks in order across the tape, the highest one first; null is the row of the sprocket. */
export function trackOrder(tracks) {
  const below = tracks === 5 ? 2 : 3;
  const out = [];
  for (let track = tracks; track > below; track--) out.push(track);
  out.push(null);
  for (let track = below; track >= 1; track--) out.push(track);
  return out;
}

function drawHoles(view, state, row) {
  const { holes, canvas } = view.elements;
  const { run } = state;
  const height = holes.clientHeight;
  const order = trackOrder(run.header.tracks);
  const width = (order.length + 1) * PITCH;
  const ratio = window.devicePixelRatio || 1;
  sizeTo(canvas, width, height, ratio);
  const context = canvas.getContext('2d');
  const c = colours();
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.fillStyle = c['paper-tape'];
  context.fillRect(0, 0, width, height);
  context.fillStyle = c.hole;
  const { tape } = run.arrays;
  const middle = height / 2;
  const first = Math.max(0, Math.floor(row - middle / HIGH));
  const last = Math.min(tape.length - 1, Math.ceil(row + middle / HIGH));
  context.beginPath();
  for (let r = first; r <= last; r++) {
    const y = middle + (r - row) * HIGH;
    order.forEach((track, k) => {
      if (track !== null && !((tape[r] >> (track - 1)) & 1)) return;
      const size = track === null ? 2 : 4.6;
      context.moveTo((k + 1) * PITCH + size, y);
      context.arc((k + 1) * PITCH, y, size, 0, 2 * Math.PI);
    });
  }
  context.fill();
  context.strokeStyle = c.mark;
  context.lineWidth = 2;
  context.strokeRect(1, middle - HIGH / 2, width - 2, HIGH);
  showRows(view, state, first, last, row, middle, width + 20);
}

function sizeTo(canvas, width, height, ratio) {
  if (canvas.width === Math.round(width * ratio) && canvas.height === Math.round(height * ratio)) {
    return;
  }
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  canvas.style.width = `${width}px`;
  canvas.style.height = `${height}px`;
}

function showRows(view, state, first, last, row, middle, left) {
  const { rows } = view;
  const count = last - first + 1;
  while (rows.length < count) {
    const item = document.createElement('li');
    item.append(span('', 'row-number'), document.createTextNode(''));
    view.elements.rows.append(item);
    rows.push({ item, row: -1, meaning: null });
  }
  for (let k = 0; k < rows.length; k++) {
    const at = rows[k];
    const r = first + k;
    at.item.hidden = k >= count;
    if (k >= count) continue;
    const { meaning, frame } = rowOf(view, state, r);
    if (at.row !== r || at.meaning !== meaning) {
      at.item.firstChild.textContent = String(r + 1);
      at.item.lastChild.data = meaning;
      at.item.style.paddingLeft = `${left}px`;
    }
    Object.assign(at, { row: r, meaning, frame });
    at.item.classList.toggle('head', r === Math.round(row));
    at.item.style.transform = `translateY(${middle + (r - row) * HIGH - HIGH / 2}px)`;
  }
}

const UNKNOWN = { meaning: '', frame: null };

function rowOf(view, state, row) {
  const page = Math.floor(row / PAGE);
  const rows = view.pages.get(page);
  if (rows) return rows[row - page * PAGE] ?? UNKNOWN;
  if (rows === undefined) fetchPage(view, state, page);
  return UNKNOWN;
}

async function fetchPage(view, state, page) {
  const { run } = state;
  view.pages.set(page, null);
  const from = page * PAGE;
  try {
    const list = await fetchRows(run.header.version, run.header.machine, from, from + PAGE);
    if (state.run !== run) return;
    const rows = [];
    for (const item of list) rows[item.row - from] = item;
    view.pages.set(page, rows);
    for (const key of view.pages.keys()) {
      if (view.pages.size <= MOST_PAGES) break;
      if (Math.abs(key - page) > 2) view.pages.delete(key);
    }
    view.touch();
    view.arrived?.();
  } catch { /* Without the server the rows have no meanings. */ }
}
