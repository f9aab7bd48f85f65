// Where the cutter stands at a tick. All functions are pure; run and pulses are decoded containers.
// Ticks are counted from the start of the tape, header.clock of them in a second.

import { segPoint } from './geometry.js';

/** Index of the first element above a value in an ordered array, between the indices a and b. */
export function above(array, value, a, b, stride = 1) {
  let low = a;
  let high = b;
  while (low < high) {
    const middle = (low + high) >>> 1;
    if (array[middle * stride] <= value) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Count of the frames of a run. */
export function frameCount(run) {
  return run ? run.arrays.frame.length / 9 : 0;
}

/** Tick at which the last frame ends. */
export function lastTick(run) {
  const n = frameCount(run);
  return n === 0 ? 0 : run.arrays.frameTick[3 * n - 2];
}

/** Index of the frame that has begun last at a tick, or −1 before the first one. */
export function frameAt(run, tick) {
  return above(run.arrays.frameTick, tick, 0, frameCount(run), 3) - 1;
}

/** Index of the frame before which the controller waits for the reader at a tick, or −1. */
export function waitingFor(run, tick) {
  const next = frameAt(run, tick) + 1;
  if (next >= frameCount(run)) return -1;
  const begin = run.arrays.frameTick[3 * next];
  return tick < begin && tick >= begin - run.arrays.frameTick[3 * next + 2] ? next : -1;
}

/**
 * Writes the cutter's position in mm at a tick into out, and returns the index of the frame that
 * has begun last, or −1.
 */
export function positionAt(run, pulses, tick, out) {
  const index = frameAt(run, tick);
  if (index < 0) {
    for (let k = 0; k < 3; k++) out[k] = run.header.start[k];
  } else if (run.header.pulsed && pulses) {
    byPulses(run, pulses, index, tick, out);
  } else {
    evenly(run, index, tick, out);
  }
  return index;
}

function byPulses(run, pulses, index, tick, out) {
  const { pulseTick, pulseSteps, framePulse } = pulses.arrays;
  const first = framePulse[index];
  const end = above(pulseTick, tick, first, framePulse[index + 1]);
  let x = 0;
  let y = 0;
  let z = 0;
  for (let i = first; i < end; i++) {
    const steps = pulseSteps[i];
    x += (steps & 1) - ((steps >> 1) & 1);
    y += ((steps >> 2) & 1) - ((steps >> 3) & 1);
    z += ((steps >> 4) & 1) - ((steps >> 5) & 1);
  }
  const { frame } = run.arrays;
  const { axes } = run.header;
  const o = 9 * index;
  out[0] = frame[o] + x * axes[0].pulse;
  out[1] = frame[o + 1] + y * axes[1].pulse;
  out[2] = frame[o + 7] + z * axes[2].pulse;
}

function evenly(run, index, tick, out) {
  const { frame, frameTick } = run.arrays;
  const begin = frameTick[3 * index];
  const end = frameTick[3 * index + 1];
  const part = tick >= end ? 1 : (tick - begin) / (end - begin);
  const o = 9 * index;
  segPoint(frame, o, part, out);
  out[2] = part >= 1 ? frame[o + 8] : frame[o + 7] + part * (frame[o + 8] - frame[o + 7]);
}

/** Tick of the next beginning of a frame, or of the end of the last one. */
export function nextFrame(run, tick) {
  const index = frameAt(run, tick) + 1;
  return index < frameCount(run) ? run.arrays.frameTick[3 * index] : lastTick(run);
}

/** Tick of the last beginning of a frame before a tick, or 0. */
export function previousFrame(run, tick) {
  const { frameTick } = run.arrays;
  let index = frameAt(run, tick);
  while (index >= 0 && frameTick[3 * index] >= tick) index--;
  return index < 0 ? 0 : frameTick[3 * index];
}

/** Tick of the next group of pulses, or of the end of the last frame. */
export function nextPulse(run, pulses, tick) {
  const { pulseTick } = pulses.arrays;
  const index = above(pulseTick, tick, 0, pulseTick.length);
  return index < pulseTick.length ? pulseTick[index] : lastTick(run);
}

/** Tick of the last group of pulses before a tick, or 0. */
export function previousPulse(pulses, tick) {
  const { pulseTick } = pulses.arrays;
  let index = above(pulseTick, tick, 0, pulseTick.length) - 1;
  while (index >= 0 && pulseTick[index] >= tick) index--;
  return index < 0 ? 0 : pulseTick[index];
}

/**
 * Orders samples by kind, then by their first tick, so that a value can be found quickly.
 * @returns {Int32Array[]} for each kind the indices of its samples
 */
export function indexSamples(sample) {
  const counts = [];
  for (let o = 0; o < sample.length; o += 4) counts[sample[o]] = (counts[sample[o]] ?? 0) + 1;
  const lists = Array.from(counts, (count) => new Int32Array(count ?? 0));
  const filled = lists.map(() => 0);
  const ordered = lists.map(() => true);
  for (let i = 0; i < sample.length / 4; i++) {
    const kind = sample[4 * i];
    const at = filled[kind]++;
    lists[kind][at] = i;
    if (at > 0 && sample[4 * lists[kind][at - 1] + 1] > sample[4 * i + 1]) ordered[kind] = false;
  }
  lists.forEach((list, kind) => {
    if (!ordered[kind]) list.sort((p, q) => sample[4 * p + 1] - sample[4 * q + 1]);
  });
  return lists;
}

/** Value of the sample of a kind at a tick (feed in mm/min, frequency in Hz), or null. */
export function sampleAt(sample, index, kind, tick) {
  const list = index[kind];
  if (!list) return null;
  let low = 0;
  let high = list.length;
  while (low < high) {
    const middle = (low + high) >>> 1;
    if (sample[4 * list[middle] + 1] <= tick) low = middle + 1;
    else high = middle;
  }
  if (low === 0) return null;
  const o = 4 * list[low - 1];
  return sample[o + 2] >= tick ? sample[o + 3] : null;
}

/** Row of the tape (or line of the text) at a tick, with its fraction; moves evenly in a frame. */
export function rowAt(run, tick) {
  const index = frameAt(run, tick);
  const { frameRow, frameTick } = run.arrays;
  if (index < 0) return 0;
  const begin = frameTick[3 * index];
  const end = frameTick[3 * index + 1];
  const part = tick >= end ? 1 : (tick - begin) / (end - begin);
  const from = frameRow[2 * index];
  return from + part * Math.max(0, frameRow[2 * index + 1] - 1 - from);
}
