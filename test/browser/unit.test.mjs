// Tests of the pure modules.

import assert from 'node:assert/strict';
import test from 'node:test';
import { decode } from '../../preview/container.js';
import * as geometry from '../../preview/geometry.js';
import * as position from '../../preview/position.js';
import { commandText } from '../../preview/now.js';
import { mapLine } from '../../preview/lines.js';
import { difference, largestDistance } from '../../preview/compare.js';
import * as format from '../../preview/format.js';
import { framePath, sweeps } from '../../preview/paths.js';
import * as data from './mock-data.mjs';

const near = (a, b, by = 1e-9) => assert.ok(Math.abs(a - b) <= by, `${a} is not near ${b}`);
const buffer = (b) => b.buffer.slice(b.byteOffset, b.byteOffset + b.byteLength);
const arc = Float64Array.of(10, 0, 0, 10, 0, 0, Math.PI / 2);
const back = Float64Array.of(0, 10, 10, 0, 0, 0, -Math.PI / 2);
const full = Float64Array.of(10, 0, 10, 0, 0, 0, 2 * Math.PI);
const line = Float64Array.of(0, 0, 30, 40, 9, 9, 0);

test('container: round trip, padding and cut-off input', () => {
  const bytes = buffer(data.encode({ a: 'ä' }, { x: ['f64', [1.5, -2]], y: ['i32', [1, 2, -3]],
    z: ['u8', [255]] }));
  const { header, arrays } = decode(bytes);
  assert.equal(header.a, 'ä');
  assert.deepEqual([...arrays.x], [1.5, -2]);
  assert.deepEqual([...arrays.y], [1, 2, -3]);
  assert.deepEqual([...arrays.z], [255]);
  assert.throws(() => decode(bytes.slice(0, bytes.byteLength - 16)));
  assert.throws(() => decode(new ArrayBuffer(4)));
});

test('geometry: lengths, points and distances', () => {
  near(geometry.segLength(line, 0), 50);
  near(geometry.segLength(arc, 0), 5 * Math.PI);
  const p = geometry.segPoint(arc, 0, 0.5, [0, 0]);
  near(p[0], 10 * Math.SQRT1_2);
  near(p[1], 10 * Math.SQRT1_2);
  near(geometry.segDistance(arc, 0, 20, 20), Math.hypot(20, 20) - 10);
  near(geometry.segDistance(back, 0, 20, 20), Math.hypot(20, 20) - 10);
  near(geometry.segDistance(arc, 0, -10, -10), Math.hypot(20, 10));
  near(geometry.segDistance(full, 0, -12, 0), 2);
  near(geometry.segDistance(line, 0, -3, -4), 5);
});

test('geometry: distance agrees with many points of random segments', () => {
  let seed = 1;
  const random = () => { seed = (seed * 16807) % 2147483647; return seed / 2147483647; };
  for (let n = 0; n < 200; n++) {
    const [cx, cy, r] = [random() * 20, random() * 20, 1 + random() * 9];
    const a0 = random() * 7;
    const phi = (random() - 0.5) * 12;
    const seg = Float64Array.of(cx + r * Math.cos(a0), cy + r * Math.sin(a0),
      cx + r * Math.cos(a0 + phi), cy + r * Math.sin(a0 + phi), cx, cy, phi);
    const [x, y] = [random() * 40 - 10, random() * 40 - 10];
    let best = Infinity;
    const p = [0, 0];
    const box = geometry.segBox(seg, 0, [0, 0, 0, 0], 0);
    for (let k = 0; k <= 4000; k++) {
      geometry.segPoint(seg, 0, k / 4000, p);
      best = Math.min(best, Math.hypot(p[0] - x, p[1] - y));
      assert.ok(p[0] >= box[0] - 1e-9 && p[0] <= box[2] + 1e-9);
      assert.ok(p[1] >= box[1] - 1e-9 && p[1] <= box[3] + 1e-9);
    }
    near(geometry.segDistance(seg, 0, x, y), best, 1e-2);
  }
});

test('geometry: area, nearest segment and snap points', () => {
  const square = Float64Array.of(0, 0, 10, 0, 0, 0, 0, 10, 0, 10, 10, 0, 0, 0,
    10, 10, 0, 10, 0, 0, 0, 0, 10, 0, 0, 0, 0, 0);
  near(geometry.doubleArea(square, 0, 4), 200);
  near(geometry.doubleArea(full, 0, 1), 200 * Math.PI);
  const box = geometry.boxes(square, 7);
  assert.equal(geometry.nearest(square, 7, box, 9.5, 5, 1).index, 1);
  assert.equal(geometry.nearest(square, 7, box, 5, 5, 1), null);
  const lists = [{ a: square, stride: 7, box }, { a: arc, stride: 7, box: geometry.boxes(arc, 7) }];
  assert.equal(geometry.snapPoint(lists, [], [], 10.2, 9.9, 1).kind, 'node');
  assert.deepEqual(geometry.snapPoint(lists, [3, 3, 2, -1], [], 3.2, 3.1, 1),
    { x: 3, y: 3, kind: 'hole', radius: 2 });
  assert.equal(geometry.snapPoint(lists, [], [], 5.1, 0.1, 1).kind, 'middle');
  const far = [{ a: arc, stride: 7, box: geometry.boxes(arc, 7) }];
  assert.equal(geometry.snapPoint(far, [], [], 0.2, 0.1, 1).kind, 'centre');
});

test('position: without pulses, even motion and waiting', () => {
  const run = { header: { start: [1, 2, 3], pulsed: false, axes: [] }, arrays: {
    frame: Float64Array.of(...line, 5, 15, 30, 40, 30, 40, 0, 0, 0, 15, 15,
      10, 0, 0, 10, 0, 0, Math.PI / 2, 0, 4),
    frameTick: Float64Array.of(10, 20, 2, 20, 20, 0, 30, 40, 5),
    frameRow: Int32Array.of(0, 10, 10, 11, 11, 21),
  } };
  const at = (tick) => {
    const out = [0, 0, 0];
    return [position.positionAt(run, null, tick, out), ...out];
  };
  assert.deepEqual(at(5), [-1, 1, 2, 3]);
  assert.deepEqual(at(15), [0, 15, 20, 10]);
  assert.deepEqual(at(20), [1, 30, 40, 15]);
  assert.deepEqual(at(27), [1, 30, 40, 15]);
  assert.deepEqual(at(40), [2, 0, 10, 4]);
  near(at(35)[1], 10 * Math.SQRT1_2);
  assert.equal(position.waitingFor(run, 9), 0);
  assert.equal(position.waitingFor(run, 24), -1);
  assert.equal(position.waitingFor(run, 25), 2);
  assert.equal(position.nextFrame(run, 10), 20);
  assert.equal(position.nextFrame(run, 35), 40);
  assert.equal(position.previousFrame(run, 30), 20);
  assert.equal(position.previousFrame(run, 35), 30);
  assert.equal(position.previousFrame(run, 10), 0);
  assert.equal(position.lastTick(run), 40);
  near(position.rowAt(run, 15), 4.5);
});

test('position: with pulses, every tick against a recount', () => {
  const run = decode(buffer(data.run(1, 'plate', 'mark-century')));
  const pulses = decode(buffer(data.pulses(1, 'plate', 'mark-century')));
  const { pulseTick, pulseSteps } = pulses.arrays;
  const at = [...run.header.start];
  const out = [0, 0, 0];
  let k = 0;
  const end = position.lastTick(run);
  for (let tick = 0; tick <= end; tick += 997) {
    while (k < pulseTick.length && pulseTick[k] <= tick) {
      for (let axis = 0; axis < 3; axis++) {
        if (pulseSteps[k] & (1 << (2 * axis))) at[axis] += 0.02;
        if (pulseSteps[k] & (2 << (2 * axis))) at[axis] -= 0.02;
      }
      k += 1;
    }
    position.positionAt(run, pulses, tick, out);
    for (let axis = 0; axis < 3; axis++) near(out[axis], at[axis], 1e-6);
  }
  assert.equal(position.nextPulse(run, pulses, -1), pulseTick[0]);
  assert.equal(position.previousPulse(pulses, pulseTick[5]), pulseTick[4]);
});

test('position: samples', () => {
  const sample = Float64Array.of(0, 20, 29, 7, 1, 0, 50, -3, 0, 0, 19, 5);
  const index = position.indexSamples(sample);
  assert.equal(position.sampleAt(sample, index, 0, 19), 5);
  assert.equal(position.sampleAt(sample, index, 0, 20), 7);
  assert.equal(position.sampleAt(sample, index, 0, 30), null);
  assert.equal(position.sampleAt(sample, index, 1, 44), -3);
  assert.equal(position.sampleAt(sample, index, 4, 44), null);
});

test('now: a command is told in its frame, and not after it', () => {
  const command = (frame, tick, text) => ({ frame, tick, text });
  const run = { header: { commands: [command(0, 0, 'S 800'), command(1, 0, 'M 3'),
    command(3, 45, 'M 8'), command(4, 60, 'M 9')] }, arrays: {
    frameTick: Float64Array.of(0, 0, 0, 0, 0, 0, 0, 30, 0, 40, 60, 0, 60, 70, 0, 80, 90, 0),
    frameInfo: Int32Array.of(3, 0, 0, 1, 0, 3, 0, 0, 1, 0, 2, 0, 0, 1, 0, 2, 0, 0, 1, 0,
      3, 0, 0, 1, 0, 0, 0, 0, 1, 0),
  } };
  assert.equal(commandText(run, -1, 0), '–');
  assert.equal(commandText(run, 1, 0), 'S 800 before this frame; M 3');
  assert.equal(commandText(run, 2, 20), 'S 800, M 3 before this frame');
  assert.equal(commandText(run, 3, 44), '–');
  assert.equal(commandText(run, 3, 45), 'M 8');
  assert.equal(commandText(run, 4, 65), 'M 9');
  assert.equal(commandText(run, 5, 85), '–');
});

test('lines: after insertions and changes', () => {
  assert.equal(mapLine('a\nb\nc', 'a\nx\nb\nc', 1), 1);
  assert.equal(mapLine('a\nb\nc', 'a\nx\nb\nc', 3), 4);
  assert.equal(mapLine('a\nb\nc', 'a\nB\nc', 2), 2);
  assert.equal(mapLine('a\nb\nc', 'a\nc', 2), -1);
});

test('compare: differences and the largest distance', () => {
  const a = Float64Array.of(1, 2, 3, 4, 5, 6);
  const b = Float64Array.of(4, 5, 6, 7, 8, 9);
  const { gone, fresh } = difference(a, b, 3);
  assert.deepEqual([[...gone], [...fresh]], [[0], [1]]);
  const path = (y) => {
    const seg = Float64Array.of(0, y, 100, y, 0, 0, 0, 0, 0);
    return { seg, count: 1, info: Int32Array.of(2, 0, 0, 1, 0), box: geometry.boxes(seg, 9) };
  };
  near(largestDistance(path(0), path(0.5)).distance, 0.5);
});

test('format: units, signs and times', () => {
  assert.equal(format.length(25.4, 'inch'), '1.0000');
  assert.equal(format.length(-0.00001, 'mm'), '0.000');
  assert.equal(format.length(-1.5, 'mm'), '\u22121.500');
  assert.equal(format.time(59.9999), '1:00.000');
  assert.equal(format.time(61.5), '1:01.500');
});

test('simplify: no left-out point is farther away than the tolerance', async () => {
  const { Pen } = await import('../../preview/simplify.js');
  const points = [];
  for (let k = 0; k < 3000; k++) {
    const t = k / 60;
    points.push([t + 0.4 * Math.sin(9 * t), 3 * Math.sin(t) + 0.02 * Math.cos(40 * t)]);
  }
  points.push(...points.slice(-400, -1).reverse());
  const drawn = [];
  const target = { moveTo: (x, y) => drawn.push([x, y]), lineTo: (x, y) => drawn.push([x, y]) };
  for (const tolerance of [0, 0.01, 0.1]) {
    drawn.length = 0;
    const pen = new Pen(target, tolerance);
    pen.move(...points[0]);
    for (const p of points.slice(1)) pen.line(...p);
    pen.flush();
    if (tolerance === 0) assert.equal(drawn.length, points.length);
    else assert.ok(drawn.length < points.length / 3, `${drawn.length}`);
    for (const [x, y] of points) {
      let best = Infinity;
      for (let k = 1; k < drawn.length; k++) {
        const seg = Float64Array.of(...drawn[k - 1], ...drawn[k], 0, 0, 0);
        best = Math.min(best, geometry.segDistance(seg, 0, x, y));
      }
      assert.ok(best <= tolerance * 1.125 + 1e-9, `${best}`);
    }
  }
});

test('paths: leads and ramps sweep the part, moves above it do not', () => {
  const part = (z0, z1) => [0, 0, 10, 0, 0, 0, 0, z0, z1];
  const parts = [[2, part(-5, -5)], [2, part(-8, -8)], [1, part(-5, -5)], [1, part(2, -8)],
    [1, part(2, 2)], [0, part(-8, -8)], [3, part(-8, -8)]];
  const path = framePath({ arrays: {
    frame: Float64Array.from(parts.flatMap(([, seg]) => seg)),
    frameInfo: Int32Array.from(parts.flatMap(([kind]) => [kind, 0, 0, 1, 0])),
    frameFeed: new Float64Array(2 * parts.length),
  } });
  assert.deepEqual(parts.map((_, i) => sweeps(path, i)),
    [true, true, true, true, false, false, false]);
});
