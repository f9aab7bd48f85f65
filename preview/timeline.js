// The slider of the time, and the chart of the feed over it.

import { colours } from './theme.js';
import { frameCount } from './position.js';
import { feed, time } from './format.js';

// Parts of the whole time by which keys move the slider.
const STEPS = { ArrowLeft: -0.01, ArrowDown: -0.01, ArrowRight: 0.01, ArrowUp: 0.01,
  PageDown: -0.1, PageUp: 0.1, Home: -1, End: 1 };

/** Makes the timeline. `seek(tick)` goes to a tick. */
export function createTimeline(slider, canvas, store, clock, seek) {
  const still = document.createElement('canvas');
  const view = { dirty: true, tick: -1 };
  const at = (event) => {
    const box = canvas.getBoundingClientRect();
    return ((event.clientX - box.left) / box.width) * clock.end;
  };
  slider.addEventListener('input', () => seek(Number(slider.value)));
  slider.addEventListener('keydown', (event) => {
    const part = STEPS[event.key];
    if (!part || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    seek(clock.tick + part * clock.end);
  });
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    seek(at(event));
  });
  canvas.addEventListener('pointermove', (event) => {
    if (event.buttons & 1) seek(at(event));
  });
  view.touch = () => { view.dirty = true; };
  view.draw = () => {
    const { run } = store.state;
    if (!run || canvas.clientWidth === 0) return;
    if (slider.max !== String(clock.end)) slider.max = String(clock.end);
    if (view.tick !== clock.tick) {
      slider.value = String(clock.tick);
      slider.setAttribute('aria-valuetext', `${time(clock.tick / clock.rate)} minutes`);
    }
    if (resize(canvas, still)) view.dirty = true;
    if (!view.dirty && view.tick === clock.tick) return;
    if (view.dirty) drawChart(still, store.state, clock);
    drawNow(canvas, still, clock);
    view.dirty = false;
    view.tick = clock.tick;
  };
  return view;
}

function resize(canvas, still) {
  const ratio = window.devicePixelRatio || 1;
  const width = Math.round(canvas.clientWidth * ratio);
  const height = Math.round(canvas.clientHeight * ratio);
  if (canvas.width === width && canvas.height === height) return false;
  Object.assign(canvas, { width, height });
  Object.assign(still, { width, height });
  return true;
}

function drawNow(canvas, still, clock) {
  const context = canvas.getContext('2d');
  const c = colours();
  context.clearRect(0, 0, canvas.width, canvas.height);
  context.drawImage(still, 0, 0);
  const x = Math.round((clock.tick / Math.max(1e-9, clock.end)) * (canvas.width - 2));
  context.fillStyle = c.mark;
  context.fillRect(x, 0, 2, canvas.height);
}

function drawChart(still, state, clock) {
  const context = still.getContext('2d');
  const { width, height } = still;
  const c = colours();
  context.fillStyle = c.paper;
  context.fillRect(0, 0, width, height);
  const columns = new Float64Array(width);
  const waits = new Uint8Array(width);
  if (state.pulses?.samples?.[0]) bySamples(columns, state.pulses, clock.end);
  else byFrames(columns, state.run, clock.end);
  markWaits(waits, state.run, clock.end);
  const most = columns.reduce((a, b) => Math.max(a, b), 0) || 1;
  context.fillStyle = c.cut;
  context.globalAlpha = 0.55;
  for (let x = 0; x < width; x++) {
    const high = (columns[x] / most) * (height - 6);
    context.fillRect(x, height - 4 - high, 1, high);
  }
  context.globalAlpha = 1;
  context.fillStyle = c.rapid;
  for (let x = 0; x < width; x++) if (waits[x]) context.fillRect(x, height - 4, 1, 4);
  const ratio = window.devicePixelRatio || 1;
  context.fillStyle = c.soft;
  context.font = `${11 * ratio}px system-ui, sans-serif`;
  const unit = state.drawing?.header.unit ?? 'mm';
  context.fillText(`feed, up to ${feed(most, unit)}`, 6 * ratio, 13 * ratio);
}

function put(columns, from, to, end, value) {
  const scale = columns.length / Math.max(1e-9, end);
  const last = Math.min(columns.length - 1, Math.floor(to * scale));
  for (let x = Math.max(0, Math.floor(from * scale)); x <= last; x++) {
    if (value > columns[x]) columns[x] = value;
  }
}

function byFrames(columns, run, end) {
  const { frameTick, frameFeed } = run.arrays;
  for (let i = 0; i < frameCount(run); i++) {
    put(columns, frameTick[3 * i], frameTick[3 * i + 1], end, frameFeed[2 * i + 1]);
  }
}

function bySamples(columns, pulses, end) {
  const { sample } = pulses.arrays;
  for (const i of pulses.samples[0]) {
    put(columns, sample[4 * i + 1], sample[4 * i + 2], end, sample[4 * i + 3]);
  }
}

function markWaits(waits, run, end) {
  const { frameTick } = run.arrays;
  for (let i = 0; i < frameCount(run); i++) {
    const wait = frameTick[3 * i + 2];
    if (wait > 0) put(waits, frameTick[3 * i] - wait, frameTick[3 * i], end, 1);
  }
}
