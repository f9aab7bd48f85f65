// The controls of the playback, and what is known of the present tick.

import { SPEEDS } from './clock.js';
import { nextFrame, nextPulse, positionAt, previousFrame, previousPulse, waitingFor }
  from './position.js';
import { segLength, segNearest } from './geometry.js';
import { time } from './format.js';

const SHORT = 1e-9;

/** Makes the function that tells of the present tick where the cutter is; it keeps its answer. */
export function createNow(store, clock) {
  const at = { tick: NaN, run: null, pulses: null, frame: -1, part: 0, x: 0, y: 0, z: 0, tool: -1,
    waiting: -1 };
  const out = [0, 0, 0];
  return () => {
    const { run, pulses, frames } = store.state;
    if (!run || !frames) return null;
    if (at.tick === clock.tick && at.run === run && at.pulses === pulses) return at;
    const frame = positionAt(run, pulses, clock.tick, out);
    Object.assign(at, { tick: clock.tick, run, pulses, frame });
    at.waiting = waitingFor(run, clock.tick);
    [at.x, at.y, at.z] = out;
    at.part = partAt(run, pulses, frame, clock.tick, out);
    at.tool = toolAt(frames, frame);
    return at;
  };
}

// Fraction (0 to 1) of a frame that is done at a tick.
function partAt(run, pulses, frame, tick, out) {
  if (frame < 0) return 0;
  const { frameTick, frame: seg } = run.arrays;
  const begin = frameTick[3 * frame];
  const end = frameTick[3 * frame + 1];
  if (tick >= end) return 1;
  const o = 9 * frame;
  if (run.header.pulsed && pulses && segLength(seg, o) > SHORT) {
    return segNearest(seg, o, out[0], out[1]);
  }
  return (tick - begin) / (end - begin);
}

function toolAt(frames, frame) {
  let i = Math.max(0, frame);
  // Frames of commands may have no tool: then the one before is still in the spindle.
  for (let tries = 0; i > 0 && frames.info[5 * i + 1] < 0 && tries < 50; tries++) i--;
  return frames.count > 0 ? frames.info[5 * i + 1] : -1;
}

/** Makes the controls of the playback. `need()` fetches the pulses if they are not there yet. */
export function createPlayer(get, store, clock, need) {
  const actions = {
    toggle: () => {
      need();
      clock.run(clock.direction === 1 ? 0 : 1);
    },
    backwards: () => {
      need();
      clock.run(clock.direction === -1 ? 0 : -1);
    },
    seek: (tick) => {
      need();
      clock.seek(tick);
    },
    step: (find) => {
      if (!store.state.run || clock.end === 0) return;
      need();
      clock.run(0);
      clock.seek(find(store.state.run, store.state.pulses));
    },
    faster: (by) => {
      const at = Math.min(SPEEDS.length - 1, Math.max(0, SPEEDS.indexOf(clock.speed) + by));
      clock.setSpeed(SPEEDS[at]);
      get('speed').value = String(SPEEDS[at]);
    },
  };
  actions.frameOn = () => actions.step((run) => nextFrame(run, clock.tick));
  actions.frameBack = () => actions.step((run) => previousFrame(run, clock.tick));
  actions.pulseOn = () => actions.step((run, pulses) => (hasPulses(run, pulses)
    ? nextPulse(run, pulses, clock.tick) : nextFrame(run, clock.tick)));
  actions.pulseBack = () => actions.step((run, pulses) => (hasPulses(run, pulses)
    ? previousPulse(pulses, clock.tick) : previousFrame(run, clock.tick)));
  wire(get, store, clock, actions);
  return { ...actions, draw: createClockText(get, clock) };
}

function hasPulses(run, pulses) {
  return run.header.pulsed && pulses && pulses.arrays.pulseTick.length > 0;
}

function wire(get, store, clock, actions) {
  get('speed').append(...SPEEDS.map((speed) => new Option(`${speed}×`, speed, false, speed === 1)));
  get('speed').value = '1';
  get('speed').addEventListener('change', () => clock.setSpeed(Number(get('speed').value)));
  get('play').addEventListener('click', actions.toggle);
  get('play-back').addEventListener('click', actions.backwards);
  get('frame-on').addEventListener('click', actions.frameOn);
  get('frame-back').addEventListener('click', actions.frameBack);
  get('pulse-on').addEventListener('click', actions.pulseOn);
  get('pulse-back').addEventListener('click', actions.pulseBack);
  get('follow').addEventListener('change', () => store.set({ follow: get('follow').checked }));
  store.on(['run', 'pulses'], (s) => {
    const pulsed = Boolean(s.run?.header.pulsed);
    get('pulse-on').disabled = !pulsed;
    get('pulse-back').disabled = !pulsed;
    const why = pulsed ? '' : s.run?.header.why ?? '';
    get('pulse-on').title = why;
    get('pulse-back').title = why;
  });
}

function createClockText(get, clock) {
  const shown = { text: '', direction: 0 };
  const output = get('clock');
  const whole = document.createElement('small');
  output.append(document.createTextNode(''), whole);
  return () => {
    const text = time(clock.tick / clock.rate);
    const end = ` of ${time(clock.end / clock.rate)}`;
    if (shown.text !== text + end) {
      output.firstChild.data = text;
      whole.textContent = end;
      shown.text = text + end;
    }
    if (shown.direction === clock.direction) return;
    shown.direction = clock.direction;
    get('play').setAttribute('aria-pressed', clock.direction === 1 ? 'true' : 'false');
    get('play').setAttribute('aria-label', clock.direction === 1 ? 'Pause' : 'Play');
    get('play-back').setAttribute('aria-pressed', clock.direction === -1 ? 'true' : 'false');
  };
}
