// Brings what the server has into the store: the drawing, then the run, then the pulses.

import { fetchDrawing, fetchPulses, fetchRun, listen } from './data.js';
import { compareMachines, compareTexts } from './compare.js';
import { framePath, movePath } from './paths.js';
import { filesOf } from './text.js';
import { indexSamples } from './position.js';
import { mapPlace, sameFiles } from './lines.js';

const SOON = 20000; // frames up to which pulses are fetched at once

/** Makes the loader and begins to listen to the server. */
export function createLoader(store) {
  const loader = { store, busy: false, again: false, latest: -1, wanted: null };
  loader.refresh = () => refresh(loader);
  loader.chooseMachine = (name) => {
    loader.chosen = Boolean(name);
    store.set({ machine: name || null });
    return loadRun(loader).then(() => compare(loader));
  };
  loader.pulses = () => loadPulses(loader);
  loader.compare = (what) => {
    store.set({ compare: what });
    return compare(loader);
  };
  setTimeout(() => {
    if (!store.state.drawing) loader.refresh();
  }, 1500);
  listen({
    open: () => {
      store.set({ connection: 'open' });
      loader.refresh();
    },
    lost: () => store.set({ connection: 'lost' }),
    version: (version) => {
      if (version !== store.state.drawing?.header.version) loader.refresh();
    },
    cursor: (cursor) => store.set({ cursor }),
  });
  return loader;
}

async function refresh(loader) {
  if (loader.busy) {
    loader.again = true;
    return;
  }
  loader.busy = true;
  try {
    do {
      loader.again = false;
      await loadDrawing(loader);
    } while (loader.again);
  } catch (fault) {
    loader.store.set({ fault: String(fault.message ?? fault) });
  } finally {
    loader.busy = false;
  }
}

async function loadDrawing(loader) {
  const { store } = loader;
  const drawing = complete(await fetchDrawing());
  const old = store.state.drawing;
  store.set({ fault: '' });
  const same = old && old.header.version === drawing.header.version
    && old.header.present === drawing.header.present
    && sameFiles(filesOf(old), filesOf(drawing));
  if (same) return;
  const samePicture = Boolean(old) && !drawing.header.present && old.header.drawn
    && sameFiles(old.header.files, drawing.header.files);
  const before = old && old.header.drawn && !samePicture ? old : store.state.before;
  const machines = drawing.header.machines.map((machine) => machine.name);
  const kept = loader.chosen && machines.includes(store.state.machine) ? store.state.machine : null;
  store.set({
    drawing,
    before,
    moves: movePath(drawing),
    machine: kept ?? drawing.header.machine,
    selection: keepSelection(store.state.selection, old, drawing),
    source: drawing.header.kind === 'tape' ? 'frame' : store.state.source,
  });
  if (!samePicture || !store.state.run) await loadRun(loader);
  if (!samePicture) await compare(loader);
}

const NUMBERS = { contour: Float64Array, contourPlace: Int32Array, hole: Float64Array,
  rest: Float64Array, move: Float64Array, moveInfo: Int32Array, moveFeed: Float64Array };

// Fills in what a drawing of a tape, or one without a picture, may lack.
function complete(drawing) {
  for (const [name, Numbers] of Object.entries(NUMBERS)) drawing.arrays[name] ??= new Numbers(0);
  const { header } = drawing;
  const lists = ['reports', 'files', 'machines', 'tools', 'contours', 'points'];
  for (const name of lists) header[name] ??= [];
  header.unit ??= 'mm';
  if (header.kind === 'tape') header.drawn = true;
  return drawing;
}

function keepSelection(selection, old, drawing) {
  if (!old || selection.textLine < 0) return selection;
  const [file, line] = mapPlace(filesOf(old), filesOf(drawing), selection.textFile,
    selection.textLine);
  if (line < 0) return { file: -1, line: -1, frame: -1, textFile: -1, textLine: -1 };
  return { ...selection, textFile: file, textLine: line,
    ...pictureLine(drawing, file, line), frame: -1 };
}

/** Place in the text of the picture of a place in the present text, as `{file, line}`. */
export function pictureLine(drawing, file, line) {
  const [pictureFile, pictureLineNumber] = mapPlace(filesOf(drawing), drawing.header.files ?? [],
    file, line);
  return { file: pictureLineNumber < 0 ? -1 : pictureFile, line: pictureLineNumber };
}

async function loadRun(loader) {
  const { store } = loader;
  const { drawing, machine } = store.state;
  if (!machine || !drawing?.header.drawn) {
    store.set({ run: null, frames: null, pulses: null, runState: 'none', runFault: '' });
    return;
  }
  store.set({ runState: 'loading', runFault: '' });
  const asked = `${drawing.header.version} ${machine}`;
  loader.wanted = asked;
  try {
    const run = await fetchRun(drawing.header.version, machine);
    if (loader.wanted !== asked) return;
    store.set({ run, frames: framePath(run), pulses: null, runState: 'ready' });
    if (run.arrays.frame.length / 9 <= SOON) await loadPulses(loader);
  } catch (fault) {
    if (loader.wanted !== asked) return;
    store.set({ run: null, frames: null, pulses: null, runState: 'failed',
      runFault: String(fault.message ?? fault) });
  }
}

async function loadPulses(loader) {
  const { store } = loader;
  const { run, pulses } = store.state;
  if (!run || pulses || loader.loadingPulses === run || run.arrays.frame.length === 0) return;
  loader.loadingPulses = run;
  try {
    const got = await fetchPulses(run.header.version, run.header.machine);
    if (store.state.run !== run) return;
    got.samples = indexSamples(got.arrays.sample);
    store.set({ pulses: got });
  } catch (fault) {
    store.set({ fault: String(fault.message ?? fault) });
  }
}

async function compare(loader) {
  const { store } = loader;
  const { compare: what, drawing, before, frames } = store.state;
  if (what === 'before') {
    store.set({ other: before && drawing ? compareTexts(before, drawing) : { kind: 'none' } });
  } else if (what.startsWith('machine:') && drawing) {
    try {
      const run = await fetchRun(drawing.header.version, what.slice(8));
      if (store.state.compare === what) store.set({ other: compareMachines(frames, run) });
    } catch (fault) {
      store.set({ other: { kind: 'none', fault: String(fault.message ?? fault) } });
    }
  } else store.set({ other: null });
}
