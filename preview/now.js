// The panel that shows what happens at the present tick.

import { COMMANDS, KIND_NAMES, RAPID } from './paths.js';
import { toolName } from './theme.js';
import { above, sampleAt } from './position.js';
import { feed, hertz, length, time, unitName } from './format.js';

const FIELDS = [
  ['frame', 'Frame'], ['line', 'Line'], ['kind', 'Move', 'wide'],
  ['feed', 'Feed', 'wide'],
  ['position', 'Position', 'wide'], ['axes', 'Axes', 'wide'],
  ['commands', 'Command', 'wide'], ['waiting', 'State', 'wide'],
];

/** Makes the panel in a definition list. */
export function createReadout(list, store, clock) {
  const values = {};
  for (const [key, title, wide] of FIELDS) {
    const dt = document.createElement('dt');
    const dd = document.createElement('dd');
    dt.textContent = title;
    if (wide) dd.className = wide;
    list.append(dt, dd);
    values[key] = { dd, dt, text: '' };
  }
  const put = (key, text) => {
    const value = values[key];
    if (value.text === text) return;
    value.text = text;
    value.dd.textContent = text;
    value.dd.title = text;
  };
  return {
    /** Shows the present tick; `at` is what main.js knows of it. */
    draw(at) {
      const { run, frames, pulses, drawing } = store.state;
      if (!run || !at) return;
      const { unit } = drawing.header;
      const i = at.frame;
      const shown = i >= 0;
      put('frame', `${i + 1} of ${frames.count}`);
      const tool = drawing.header.tools[at.tool];
      put('kind', shown ? kindText(frames, i, tool, unit) : '–');
      put('line', shown ? placeText(drawing, frames, i) : '–');
      const asked = !shown ? '–' : askedText(run, frames, i, unit);
      put('feed', `${feed(gotFeed(run, pulses, at, clock.tick), unit)}, asked ${asked}`);
      put('position', ['x', 'y', 'z'].map((axis) => `${axis} ${length(at[axis], unit)}`).join('  ')
        + ` ${unitName(unit)}`);
      put('axes', axesText(run, pulses, clock.tick));
      put('commands', commandText(run, i, clock.tick));
      put('waiting', stateText(run, at, clock));
    },
  };
}

// A control runs a rapid move as fast as it can, so the feed in the description means nothing.
function askedText(run, frames, i, unit) {
  const isRapid = frames.info[5 * i] === RAPID && !run.header.pulsed;
  return isRapid ? 'rapid' : feed(run.arrays.frameFeed[2 * i], unit);
}

function kindText(frames, i, tool, unit) {
  const braking = frames.info[5 * i + 4] === 1 ? ', braking' : '';
  const name = tool ? `; ${toolName(tool, unit)}` : '';
  return (KIND_NAMES[frames.info[5 * i]] ?? '?') + braking + name;
}

function placeText(drawing, frames, i) {
  const file = frames.info[5 * i + 2];
  if (file < 0) return '–';
  const name = file > 0 ? `${drawing.header.files[file]?.name ?? ''}: ` : '';
  return name + frames.info[5 * i + 3];
}

// The sample at this tick if there is one, else the mean of the frame while it lasts.
function gotFeed(run, pulses, at, tick) {
  if (pulses?.samples?.[0]) {
    return sampleAt(pulses.arrays.sample, pulses.samples, 0, tick) ?? 0;
  }
  return at.frame >= 0 && at.part < 1 ? run.arrays.frameFeed[2 * at.frame + 1] : 0;
}

function axesText(run, pulses, tick) {
  // Without pulses nothing is known of the frequencies.
  if (!run.header.pulsed || !pulses?.samples) return '–';
  const texts = run.header.axes.map((axis, k) => {
    if (!axis.pulse) return '';
    const value = sampleAt(pulses.arrays.sample, pulses.samples, 1 + k, tick);
    return `${axis.name} ${hertz(value ?? 0)}`;
  });
  return texts.filter(Boolean).join('  ') || '–';
}

/**
 * Text of the commands that have gone out in a frame (an index, or −1) up to a tick. Commands
 * directly before the frame that took no time are among them, and are marked.
 */
export function commandText(run, frame, tick) {
  if (frame < 0) return '–';
  const { frameTick, frameInfo } = run.arrays;
  let first = frame;
  const begin = frameTick[3 * frame];
  const isInstant = (i) => frameInfo[5 * i] === COMMANDS && frameTick[3 * i] === begin
    && frameTick[3 * i + 1] === begin;
  while (first > 0 && isInstant(first - 1)) first--;
  const before = textsOf(run, first, frame, tick);
  const own = textsOf(run, frame, frame + 1, tick);
  const parts = [before && `${before} before this frame`, own].filter(Boolean);
  return parts.join('; ') || '–';
}

// Commands of the frames from a up to b without b that have gone out up to a tick.
function textsOf(run, a, b, tick) {
  const { commands } = run.header;
  let low = 0;
  let high = commands.length;
  while (low < high) {
    const middle = (low + high) >>> 1;
    if (commands[middle].frame < a) low = middle + 1;
    else high = middle;
  }
  const texts = [];
  for (let i = low; i < commands.length && commands[i].frame < b; i++) {
    if (commands[i].tick <= tick) texts.push(commands[i].text);
  }
  return texts.join(', ');
}

function stateText(run, at, clock) {
  if (clock.tick >= clock.end) return `stopped: ${run.header.stop}`;
  if (at.waiting >= 0) {
    const ticks = run.arrays.frameTick[3 * at.waiting + 2];
    return `waiting for the reader, ${time(ticks / clock.rate)} before frame ${at.waiting + 1}`;
  }
  if (at.frame < 0) return 'before the first frame';
  return at.part >= 1 ? 'between two frames' : 'in a frame';
}

/** Index of the first frame that uses a row of the tape, or −1 (rows in order of frames). */
export function frameOfRow(run, row) {
  const { frameRow } = run.arrays;
  const index = above(frameRow, row, 0, frameRow.length / 2, 2) - 1;
  return index >= 0 && row < frameRow[2 * index + 1] ? index : -1;
}
