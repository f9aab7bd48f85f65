// The page: makes the store, the views and the controls, and draws what has changed.

import { LAYERS, createStore, initialState } from './state.js';
import { NOTHING, atPlace, ofFrame, ofPart, ofPictureLine, ofTextLine } from './select.js';
import { attachKeys, attachTabs, fillHelp } from './keys.js';
import { click as measureClick, measureText, snapAt } from './measure.js';
import { compareTexts, drawLegend, drawScale } from './legend.js';
import { Clock } from './clock.js';
import { createFrames } from './frames.js';
import { createJobs } from './jobs.js';
import { createLoader } from './loader.js';
import { createNow, createPlayer } from './player.js';
import { createPlan } from './plan.js';
import { createReadout } from './now.js';
import { countText, createReports } from './reports.js';
import { createSpace } from './space.js';
import { createTape } from './tape.js';
import { createText, filesOf } from './text.js';
import { createTimeline } from './timeline.js';
import { followScheme } from './theme.js';
import { keyTable, MORE_KEYS } from './keytable.js';
import { lastTick, positionAt } from './position.js';
import { length, unitName } from './format.js';
import { showInEditor } from './data.js';

const get = (id) => document.getElementById(id);
const store = createStore({ ...initialState(), selection: NOTHING, fault: '' });
const timings = { last: 0, worst: 0, count: 0, sum: 0 };
let asked = false;
let later = 0;
let before = 0;

/** Asks for a picture: at once, or after a time in ms. */
function wake(ms = 0) {
  if (ms > 0) {
    clearTimeout(later);
    later = setTimeout(() => wake(), ms);
  } else if (!asked) {
    asked = true;
    requestAnimationFrame(picture);
  }
}

const clock = new Clock(() => { before = 0; wake(); }, () => wake());
const now = createNow(store, clock);
followScheme(get('theme'), () => store.set({ scheme: store.state.scheme + 1 }));

const plan = createPlan(get('plan'), store, clock, now, wake, {
  tap: tapped,
  hover: hovered,
  leave: () => {
    plan.hover = null;
    get('pointer').textContent = '';
    plan.touch('over');
  },
  moved: () => scaleBar(),
});
const space = createSpace(get('space'), store, clock, now, wake, (found) => {
  choose(found && ofPart(store.state, found.path, found.index, found.x, found.y));
});
const loader = createLoader(store);
const player = createPlayer(get, store, clock, () => loader.pulses());
const text = createText({ list: get('text-list'), select: get('file'), label: get('file-label') },
  store, (file, line) => select(ofTextLine(store.state, file, line), false));
const frames = createFrames(get('frame-list'), store, (frame, far) => {
  select(ofFrame(store.state, frame), true);
  if (far) goToFrame();
});
const tape = createTape({ holes: get('tape-holes'), canvas: get('tape-canvas'),
  rows: get('tape-rows'), text: get('tape-text'), none: get('tape-none'), tab: get('tab-tape') },
store, clock, (frame) => select(ofFrame(store.state, frame), true));
tape.arrived = () => wake();
const timeline = createTimeline(get('time'), get('feed-chart'), store, clock, player.seek);
const readout = createReadout(get('readout'), store, clock);
const jobs = createJobs(get('jobs-figure'), get('jobs'), get('jobs-span'), store, clock);
const showTab = attachTabs(document.querySelector('[role=tablist]'), () => {
  tape.touch();
  if (clock.direction !== 0 && store.state.follow) catchUp();
  wake();
});
createReports(get('reports'), store, (report) => {
  showTab('tab-text');
  select(ofTextLine(store.state, report.file, report.line), true);
  show(report.file, report.line, report.column);
});

/** Text about the picture for those who do not see it. */
function describe(s) {
  const { header, arrays } = s.drawing;
  const { unit } = header;
  const size = header.extents?.map(([low, high], k) => `${'xyz'[k]} from ${length(low, unit)} to `
    + `${length(high, unit)} ${unitName(unit)}`).join(', ');
  const counts = `${header.contours.length} contours, ${arrays.hole.length / 4} holes, `
    + `${s.moves.count} moves`;
  return `Drawing of ${header.name}: ${counts}${size ? `; ${size}` : ''}.`;
}

/** Chooses something; `scroll` shows its line in the text. */
function select(selection, scroll) {
  store.set({ selection });
  if (scroll && selection.textLine > 0) text.show(selection.textFile, selection.textLine);
  const lines = selection.frame >= 0 ? `Frame ${selection.frame + 1}. ` : '';
  const line = selection.textLine > 0 ? `Line ${selection.textLine}.` : '';
  get('picture-text').textContent = `${describe(store.state)} ${lines}${line}`;
}

function goToFrame() {
  const { selection, run } = store.state;
  if (selection.frame >= 0 && run) player.seek(run.arrays.frameTick[3 * selection.frame]);
}

function tapped(x, y, pixel) {
  if (store.state.mode === 'measure') {
    measureClick(plan, snapAt(store, x, y, pixel));
    showMeasure();
    return;
  }
  choose(atPlace(store.state, x, y, 8 * pixel));
}

function show(file, line, column) {
  if (store.state.drawing?.header.editor) showInEditor(file, line, column);
}

/** Chooses what was found in the picture, or nothing, and shows it in the editor. */
function choose(found) {
  select(found ?? NOTHING, true);
  if (found && found.textLine > 0) show(found.textFile, found.textLine, 1);
}

function hovered(x, y, pixel) {
  const { drawing, mode } = store.state;
  const unit = drawing?.header.unit ?? 'mm';
  get('pointer').textContent = `x ${length(x, unit)}  y ${length(y, unit)} ${unitName(unit)}`;
  if (mode !== 'measure') return;
  plan.hover = snapAt(store, x, y, pixel);
  if (plan.measure?.first && !plan.measure.second) plan.measure.hover = plan.hover;
  plan.touch('over');
}

function showMeasure() {
  get('measure-text').textContent = measureText(plan.measure,
    store.state.drawing?.header.unit ?? 'mm');
  plan.touch('over');
}

function scaleBar() {
  const { drawing } = store.state;
  if (drawing) drawScale(get('scale'), get('scale-text'), plan.viewport, drawing.header.unit);
}

// Draws one picture; the whole of the page's own work for it is timed.
function picture(at) {
  asked = false;
  const start = performance.now();
  if (clock.direction !== 0) {
    const seconds = before > 0 ? Math.min(0.25, (at - before) / 1000) : 0;
    before = at;
    clock.advance(seconds);
  }
  if (clock.direction !== 0) wake();
  drawAll();
  timings.last = performance.now() - start;
  timings.worst = Math.max(timings.worst, timings.last);
  timings.count += 1;
  timings.sum += timings.last;
}

function drawAll() {
  const state = store.state;
  if (state.view === 'plan') plan.draw();
  else space.draw();
  const there = now();
  if (!there) return;
  player.draw();
  timeline.draw();
  readout.draw(there);
  jobs.draw();
  tape.draw(state.follow && clock.started);
  if (!clock.started) return;
  frames.play(there.frame, state.follow);
  const { info } = state.frames;
  const file = there.frame >= 0 ? info[5 * there.frame + 2] : -1;
  const place = file >= 0 ? ofPictureLine(state, file, info[5 * there.frame + 3], -1) : NOTHING;
  text.play(place.textFile, place.textLine, state.follow && clock.direction !== 0);
}

/** Scrolls the lists to what the playback has reached. */
function catchUp() {
  if (!clock.started || !store.state.run) return;
  for (const list of [frames, text, tape]) list.catchUp();
}

function chooseView(view) {
  store.set({ view });
  for (const name of ['plan', 'space']) {
    get(name).hidden = name !== view;
    get(`view-${name}`).setAttribute('aria-pressed', name === view ? 'true' : 'false');
  }
  get('space-views').hidden = view !== 'space';
  get('scale').hidden = view !== 'plan';
  if (view === 'space' && store.state.mode === 'measure') setMeasuring(false);
  if (view === 'plan') plan.resize();
  else space.resize?.();
  activeView().touch();
}

function activeView() {
  return store.state.view === 'plan' ? plan : space;
}

function setMeasuring(on) {
  if (on && store.state.view !== 'plan') chooseView('plan');
  store.set({ mode: on ? 'measure' : 'look' });
  plan.measure = null;
  plan.hover = null;
  plan.cross = null;
  get('plan').classList.toggle('measuring', on);
  get('measure-button').setAttribute('aria-pressed', on ? 'true' : 'false');
  get('measure-text').hidden = !on;
  showMeasure();
}

function toggleLayers(open = get('layers-panel').hidden) {
  get('layers-panel').hidden = !open;
  get('layers-button').setAttribute('aria-expanded', open ? 'true' : 'false');
  if (open) get('layers-panel').querySelector('input').focus();
}

// Opens the list of keys at its top: its title has the focus, not the button at its end.
function showHelp() {
  get('help').showModal();
  get('help').scrollTop = 0;
}

function escape() {
  if (!get('layers-panel').hidden) {
    toggleLayers(false);
    get('layers-button').focus();
  } else if (store.state.mode === 'measure') {
    if (plan.measure?.first) {
      plan.cross = null;
      plan.measure = null;
      showMeasure();
    } else setMeasuring(false);
  } else select(NOTHING, false);
}

function buildLayers() {
  for (const [name, title] of LAYERS) {
    const label = document.createElement('label');
    const box = document.createElement('input');
    box.type = 'checkbox';
    box.checked = store.state.layers[name];
    box.dataset.layer = name;
    box.addEventListener('change', () => {
      store.set({ layers: { ...store.state.layers, [name]: box.checked } });
    });
    label.append(box, ` ${title}`);
    get('layers-panel').append(label);
  }
}

function buildControls() {
  get('view-plan').addEventListener('click', () => chooseView('plan'));
  get('view-space').addEventListener('click', () => chooseView('space'));
  get('zoom-in').addEventListener('click', () => activeView().zoomBy(1.3));
  get('zoom-out').addEventListener('click', () => activeView().zoomBy(1 / 1.3));
  get('zoom-fit').addEventListener('click', () => activeView().fit());
  for (const button of get('space-views').children) {
    button.addEventListener('click', () => space.side(button.dataset.side));
  }
  get('measure-button').addEventListener('click', () => {
    setMeasuring(store.state.mode !== 'measure');
  });
  get('layers-button').addEventListener('click', () => toggleLayers());
  for (const name of ['colour', 'source']) {
    get(name).addEventListener('change', () => store.set({ [name]: get(name).value }));
  }
  get('machine').addEventListener('change', () => loader.chooseMachine(get('machine').value));
  get('compare').addEventListener('change', () => loader.compare(get('compare').value));
  get('help-button').addEventListener('click', showHelp);
  for (const id of ['plan', 'space']) get(id).addEventListener('keydown', paneKey);
}

function paneKey(event) {
  const steps = { ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40] };
  const step = steps[event.key];
  if (event.key === 'Enter' && store.state.mode === 'measure') takeCross();
  if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  if (store.state.mode === 'measure') moveCross(step, event.shiftKey ? 1 : 10);
  else activeView().panBy(...step, event.shiftKey);
}

// Moves the cross with which the keyboard measures, by CSS pixels.
function moveCross(step, by) {
  const v = plan.viewport;
  const at = plan.cross ?? [v.width / 2, v.height / 2];
  plan.cross = [0, 1].map((k) => Math.max(0, Math.min(k ? v.height : v.width,
    at[k] - Math.sign(step[k]) * by)));
  hovered(v.wx(plan.cross[0]), v.wy(plan.cross[1]), 1 / v.scale);
}

// Takes the point under the cross.
function takeCross() {
  const v = plan.viewport;
  if (!plan.cross) moveCross([0, 0], 0);
  tapped(v.wx(plan.cross[0]), v.wy(plan.cross[1]), 1 / v.scale);
}

function options(s) {
  const machines = s.drawing?.header.machines ?? [];
  get('machine').replaceChildren(new Option(machines.length ? 'choose a machine' : 'none', ''),
    ...machines.map((machine) => new Option(machine.title || machine.name, machine.name)));
  get('machine').value = s.machine ?? '';
  get('compare').replaceChildren(new Option('nothing', ''),
    new Option('text before the last change', 'before'),
    ...machines.filter((machine) => machine.name !== s.machine).map((machine) => (
      new Option(machine.title || machine.name, `machine:${machine.name}`))));
  get('compare').value = s.compare;
  if (get('compare').selectedIndex < 0) {
    get('compare').value = '';
    loader.compare('');
  }
}

function heading(s) {
  const header = s.drawing?.header;
  get('part-name').textContent = header ? header.name.split('/').pop() : 'partc preview';
  get('part-name').title = header?.name ?? '';
  get('part-title').textContent = header?.title ?? '';
  get('feed-unit').textContent = unitName(header?.unit ?? 'mm');
  document.title = header ? `${header.name} – partc preview` : 'partc preview';
  const stale = Boolean(header) && !header.present && header.drawn;
  get('stale').hidden = !stale;
  get('picture').classList.toggle('stale-picture', stale);
  get('empty').hidden = !header || header.drawn;
  get('empty').textContent = 'There is no picture yet: the text has mistakes.';
  status(s, header);
}

function status(s, header) {
  const counts = countText([...(header?.reports ?? []), ...(s.run?.header.reports ?? [])]);
  const lost = s.connection === 'lost';
  get('status').textContent = lost ? 'partc has ended. Start it again, and open the new address.'
    : s.fault || counts || (header ? 'no mistakes' : 'loading');
  get('status').classList.toggle('bad', lost || Boolean(s.fault) || counts.includes('error'));
}

function playback(s) {
  const there = s.runState === 'ready' && s.frames.count > 0;
  get('player').hidden = !there;
  get('now').hidden = !there;
  const texts = {
    none: s.drawing?.header.drawn ? 'Choose a machine to play the tape.' : '',
    loading: 'The tape is being made.',
    failed: `There is no tape: ${s.runFault}`,
    ready: there ? '' : `There is nothing to play. ${s.run?.header.why ?? ''}`,
  };
  get('no-run').textContent = s.runState === 'loading' && s.run ? '' : texts[s.runState];
}

// A tape without its program has no text: its page begins with the tape.
function textTab(s) {
  const tab = get('tab-text');
  tab.hidden = Boolean(s.drawing) && filesOf(s.drawing).length === 0;
  if (tab.hidden && tab.getAttribute('aria-selected') === 'true') showTab('tab-tape');
}

function subscribe() {
  store.later(['drawing'], (s) => { get('picture-text').textContent = describe(s); });
  store.on(['drawing', 'machine'], options);
  store.on(['drawing'], textTab);
  store.on(['drawing', 'connection', 'fault', 'run'], heading);
  store.on(['runState', 'run', 'drawing'], playback);
  store.later(['run'], (s) => {
    const same = Boolean(s.run) && clock.end > 0;
    clock.load(s.run ? lastTick(s.run) : 0, s.run?.header.clock ?? 1, same);
  });
  store.later(['run', 'pulses', 'scheme'], () => timeline.touch());
  store.on(['drawing', 'frames', 'colour', 'source', 'scheme'], () => {
    plan.rebuild();
    space.rebuild();
    scaleBar();
  });
  store.on(['source'], (s) => { get('source').value = s.source; });
  store.on(['drawing', 'frames', 'colour', 'source', 'scheme', 'other'], (s) => {
    if (s.drawing) drawLegend(get('legend'), s);
  });
  store.later(['layers', 'other'], () => { plan.touch(); space.rebuild(); });
  store.later(['pulses', 'view'], () => wake());
  store.later(['follow'], (s) => { if (s.follow) catchUp(); });
  store.later(['selection'], () => { plan.touch('mark'); space.touch(); });
  store.later(['cursor'], (s) => cursorMoved(s));
  store.on(['other'], (s) => {
    const texts = compareTexts(s);
    get('compare-text').hidden = texts.length === 0;
    get('compare-text').replaceChildren(...texts.map(([value, name]) => {
      const out = document.createElement(name ? 'b' : 'span');
      if (name) out.className = name;
      out.textContent = value;
      return out;
    }));
  });
}

function cursorMoved(s) {
  if (!s.cursor || !s.drawing) return;
  const { textFile, textLine } = s.selection;
  if (s.cursor.file === textFile && s.cursor.line === textLine) return;
  select(ofTextLine(s, s.cursor.file, s.cursor.line), true);
}

const table = keyTable({ player, clock, activeView, chooseView, space, store, setMeasuring,
  toggleLayers, goToFrame, escape, help: showHelp });
buildLayers();
buildControls();
attachKeys(table);
fillHelp(get('help-keys'), table, MORE_KEYS);
subscribe();

/** State of the page for tests. */
window.partc = {
  store, state: store.state, clock, plan, space, timings, select, player,
  positionAt(tick) {
    const out = [0, 0, 0];
    const frame = positionAt(store.state.run, store.state.pulses, tick, out);
    return { frame, x: out[0], y: out[1], z: out[2] };
  },
  /** Draws a picture now and returns the time in ms that it took. */
  draw() {
    const start = performance.now();
    drawAll();
    return performance.now() - start;
  },
};
