// Synthetic parts and runs for the mock server.

export function encode(header, arrays) {
  const sizes = { f64: 8, i32: 4, u8: 1 };
  const table = {};
  let offset = 0;
  for (const [name, [type, data]] of Object.entries(arrays)) {
    table[name] = { type, offset, length: data.length };
    offset += Math.ceil((data.length * sizes[type]) / 8) * 8;
  }
  const text = Buffer.from(JSON.stringify({ ...header, arrays: table }));
  const padded = Math.ceil(text.length / 8) * 8;
  const out = Buffer.alloc(8 + padded + offset, 0);
  out.writeUInt32LE(text.length, 0);
  out.fill(0x20, 8, 8 + padded);
  text.copy(out, 8);
  for (const [name, [type, data]] of Object.entries(arrays)) {
    const typed = { f64: Float64Array, i32: Int32Array, u8: Uint8Array }[type].from(data);
    Buffer.from(typed.buffer).copy(out, 8 + padded + table[name].offset);
  }
  return out;
}

const Q = Math.PI / 2;

const TEXT = `part plate "Plate with a slot and two holes"
units     mm
machine   mark-century
tool      1 mill(diameter 10)
feed      300
tolerance 0.01
clearance 3
from      (-20, -20, 20)

let corner = 12
let thick  = 8

contour rim closed {
  line((0, 0), (0, 80))      fillet corner
  line((0, 80), (120, 80))   chamfer 10
  line((120, 80), (120, 0))  fillet corner
  line((120, 0), (0, 0))     fillet corner
}

contour slot closed {
  line((40, 30), (80, 30))   meet
  arc((80, 40), 10, ccw)     meet
  line((80, 50), (40, 50))   meet
  arc((40, 40), 10, ccw)     meet
}

mill rim outside {
  depth     thick step 4
  plunge    100
  approach  (-10, 10)
  retract   (-10, 10)
}

pocket slot step 4 {
  depth     4
  plunge    60
}

change 2 drill(diameter 6)
feed   120
drill (20, 40), (100, 40) depth thick + 2 {
  clearance 2
}
return
end
`;

const IMPORT = `-- shapes.part: lengths shared by the parts of this series
let series = 7
let gap    = 0.5
`;

const TOOLS = [
  { kind: 'mill', radius: 5, name: 'mill, diameter 10' },
  { kind: 'drill', radius: 3, name: 'drill, diameter 6' },
];

function lineOf(needle) {
  return TEXT.split('\n').findIndex((line) => line.includes(needle)) + 1;
}

function plateContours(x1) {
  const rim = [
    [0, 12, 0, 68, 0, 0, 0],
    [0, 68, 12, 80, 12, 68, -Q],
    [12, 80, x1 - 10, 80, 0, 0, 0],
    [x1 - 10, 80, x1, 70, 0, 0, 0],
    [x1, 70, x1, 12, 0, 0, 0],
    [x1, 12, x1 - 12, 0, x1 - 12, 12, -Q],
    [x1 - 12, 0, 12, 0, 0, 0, 0],
    [12, 0, 0, 12, 12, 12, -Q],
  ];
  const slot = [
    [40, 30, 80, 30, 0, 0, 0],
    [80, 30, 80, 50, 80, 40, 2 * Q],
    [80, 50, 40, 50, 0, 0, 0],
    [40, 50, 40, 30, 40, 40, 2 * Q],
  ];
  return { rim, slot };
}

class Moves {
  constructor(x, y, z) {
    Object.assign(this, { at: [x, y, z], seg: [], info: [], feed: [] });
  }

  add(kind, tool, line, feed, x, y, z, arc) {
    const [x0, y0, z0] = this.at;
    const [cx, cy, phi] = arc ?? [0, 0, 0];
    this.seg.push(x0, y0, x, y, cx, cy, phi, z0, z);
    this.info.push(kind, tool, 0, line, 0);
    this.feed.push(kind === 0 ? 0 : feed);
    this.at = [x, y, z];
  }
}

function plateMoves(x1) {
  const m = new Moves(-20, -20, 20);
  const mill = lineOf('mill rim');
  m.add(0, 0, mill, 0, -15, 30, 20);
  for (const z of [-4, -8]) {
    m.add(1, 0, mill, 100, -15, 30, 3);
    m.add(1, 0, mill, 100, -15, 30, z);
    m.add(2, 0, mill, 300, -5, 40, z, [-15, 40, Q]);
    m.add(2, 0, mill, 300, -5, 68, z);
    m.add(2, 0, mill, 300, 12, 85, z, [12, 68, -Q]);
    m.add(2, 0, mill, 300, x1 - 7.93, 85, z);
    m.add(2, 0, mill, 300, x1 + 5, 72.07, z);
    m.add(2, 0, mill, 300, x1 + 5, 12, z);
    m.add(2, 0, mill, 200, x1 - 12, -5, z, [x1 - 12, 12, -Q]);
    m.add(2, 0, mill, 300, 12, -5, z);
    m.add(2, 0, mill, 200, -5, 12, z, [12, 12, -Q]);
    m.add(2, 0, mill, 300, -5, 40, z);
    m.add(2, 0, mill, 300, -15, 50, z, [-15, 40, Q]);
    m.add(0, 0, mill, 0, -15, 50, 20);
    if (z === -4) m.add(0, 0, mill, 0, -15, 30, 20);
  }
  const pocket = lineOf('pocket slot');
  m.add(0, 0, pocket, 0, 40, 40, 20);
  m.add(0, 0, pocket, 0, 40, 40, 3);
  m.add(2, 0, pocket, 60, 40, 40, -4);
  m.add(2, 0, pocket, 250, 80, 40, -4);
  m.add(2, 0, pocket, 250, 80, 35, -4);
  m.add(2, 0, pocket, 150, 80, 45, -4, [80, 40, 2 * Q]);
  m.add(2, 0, pocket, 250, 40, 45, -4);
  m.add(2, 0, pocket, 150, 40, 35, -4, [40, 40, 2 * Q]);
  m.add(2, 0, pocket, 250, 80, 35, -4);
  m.add(0, 0, pocket, 0, 80, 35, 20);
  const drill = lineOf('drill (20');
  for (const x of [20, 100]) {
    m.add(0, 1, drill, 0, x, 40, 20);
    m.add(0, 1, drill, 0, x, 40, 2);
    m.add(2, 1, drill, 120, x, 40, -10);
    m.add(0, 1, drill, 0, x, 40, 2);
    m.add(0, 1, drill, 0, x, 40, 20);
  }
  m.add(0, 1, lineOf('return'), 0, -20, -20, 20);
  return m;
}

function bigMoves(n) {
  const m = new Moves(0, 0, 20);
  m.add(0, 0, 30, 0, 0, 0, 2);
  m.add(1, 0, 30, 100, 0, 0, -1);
  const passes = 200;
  const per = Math.floor((n - 2) / passes);
  for (let r = 0; r < passes; r++) {
    const z = -1 - 6 * (r / passes);
    for (let k = 1; k <= per; k++) {
      const x = r % 2 === 0 ? (k / per) * 200 : 200 - (k / per) * 200;
      const y = r * 0.7 + 3 * Math.sin(x / 9 + r / 30);
      m.add(2, 0, 30 + (r % 8), 300 + (k % 50), x, y, z);
    }
  }
  return m;
}

function turnedMoves() {
  const m = new Moves(80, 40, 0);
  for (const d of [18, 16, 14, 12]) {
    m.add(0, 0, 8, 0, 72, d, 0);
    m.add(2, 0, 8, 120, 30, d, 0);
    m.add(2, 0, 8, 120, 30, d + 2, 0);
    m.add(0, 0, 8, 0, 72, d + 2, 0);
  }
  m.add(0, 0, 9, 0, 71, 0.8, 0);
  m.add(2, 0, 9, 80, 60, 0.8, 0);
  m.add(2, 0, 9, 80, 60, 11, 0);
  m.add(2, 0, 9, 80, 40, 11, 0);
  m.add(2, 0, 9, 80, 30, 21, 0, [40, 21, -Q]);
  m.add(0, 0, 9, 0, 80, 40, 0);
  return m;
}

const REPORTS = [{
  severity: 'error', code: 'E0301', text: 'these two lines do not meet',
  hint: 'Write ‘fillet corner’ or ‘chamfer 2’ between them.',
  file: 0, line: 15, column: 3, endLine: 15, endColumn: 29,
  excerpt: ['   |', '15 |   line((0, 80), (120, 80))   chamfer 10',
    '   |   ^^^^^^^^^^^^^^^^^^^^^^^^^^ this line',
    '16 |   line((120, 80), (120, 0))  fillet corner',
    '   |   ------------------------- runs away from it'].join('\n'),
  message: ['The two lines are parallel within the tolerance of 0.01 mm.'],
}, {
  severity: 'warning', code: 'W0403', text: 'after this tool change the spindle stands still',
  hint: null, file: 0, line: 42, column: 1, endLine: 42, endColumn: 27,
  excerpt: '   |\n42 | change 2 drill(diameter 6)\n   | ^^^^^^^^^^^^^^^^^^^^^^^^^^\n   |',
}];

function drawingParts(mode) {
  if (mode === 'turned') {
    return {
      moves: turnedMoves(),
      groups: [['shape', [[70, 0, 60, 0, 0, 0, 0], [60, 0, 60, 10, 0, 0, 0],
        [60, 10, 40, 10, 0, 0, 0], [40, 10, 30, 20, 40, 20, -Q], [30, 20, 0, 20, 0, 0, 0],
        [0, 20, 0, 0, 0, 0, 0]].slice(1), false, 'unknown', 4]],
      holes: [], tools: [{ kind: 'turning', radius: 0.8, name: 'turning tool, nose 0.8' }],
    };
  }
  const x1 = mode === 'changed' ? 130 : 120;
  const { rim, slot } = plateContours(x1);
  const big = /^big(\d+)$/.exec(mode);
  return {
    moves: big ? bigMoves(Number(big[1])) : plateMoves(x1),
    groups: [['rim', rim, true, 'inside', lineOf('contour rim')],
      ['slot', slot, true, 'outside', lineOf('contour slot')]],
    holes: [20, 40, 3, -10, 100, 40, 3, -10], tools: TOOLS,
  };
}

const MACHINES = [
  { name: 'mark-century', title: 'Mark Century 100, 8 tracks' },
  { name: 'linuxcnc-mill', title: 'LinuxCNC mill' },
];

export function drawing(version, mode, options = {}) {
  if (mode === 'broken') {
    return encode({ version, kind: 'program', name: 'plate.part', title: '', unit: 'mm',
      turned: false, reports: [...REPORTS, { ...REPORTS[0], file: -1, excerpt: '', hint: null }],
      present: false, drawn: false, files: [],
      presentFiles: [{ name: 'plate.part', text: TEXT }], machines: MACHINES, machine: null,
      tools: [], contours: [], extents: null }, {});
  }
  if (mode === 'tape') {
    return encode({ version, kind: 'tape', name: 'plate.tape', title: '', unit: 'mm', turned: false,
      reports: [], present: true, drawn: false, files: [], presentFiles: [],
      machines: MACHINES.slice(0, 1), machine: 'mark-century', tools: [], contours: [],
      extents: null }, {});
  }
  const good = mode === 'error' ? 'plate' : mode;
  const { moves, groups, holes, tools } = drawingParts(good);
  const contour = [];
  const places = [];
  const contours = groups.map(([name, segs, closed, side, line]) => {
    const from = contour.length / 7;
    segs.forEach((seg, i) => {
      contour.push(...seg);
      places.push(0, line + 1 + Math.floor(i / 2));
    });
    return { name, closed, from, count: segs.length, file: 0, line, side, depth: -8 };
  });
  const text = mode === 'changed' ? TEXT.replaceAll('120', '130') : TEXT;
  const files = [{ name: 'plate.part', text }, { name: 'shapes.part', text: IMPORT }];
  const header = {
    version, editor: true, kind: 'program', name: 'plate.part',
    title: 'Plate with a slot and two holes',
    unit: options.unit ?? 'mm', turned: good === 'turned',
    reports: mode === 'error' ? REPORTS : [], present: mode !== 'error', drawn: true,
    files, presentFiles: files, machines: MACHINES,
    machine: options.machine === undefined ? 'mark-century' : options.machine, tools, contours,
    extents: good === 'turned' ? [[0, 80], [0, 40], [0, 0]] : [[-20, 125], [-20, 85], [-10, 20]],
  };
  const info = moves.info;
  return encode(header, {
    contour: ['f64', contour], contourPlace: ['i32', places], hole: ['f64', holes],
    rest: ['f64', good === 'plate' ? [70, 30, 80, 30, 0, 0, 0, 80, 30, 74, 34, 0, 0, 0,
      74, 34, 70, 30, 0, 0, 0] : []],
    move: ['f64', moves.seg], moveInfo: ['i32', info], moveFeed: ['f64', moves.feed],
  });
}

const CLOCK = 10000;
const PULSE = 0.02;

function segAt(s, o, t) {
  if (s[o + 6] === 0) return [s[o] + t * (s[o + 2] - s[o]), s[o + 1] + t * (s[o + 3] - s[o + 1])];
  const r = Math.hypot(s[o] - s[o + 4], s[o + 1] - s[o + 5]);
  const a = Math.atan2(s[o + 1] - s[o + 5], s[o] - s[o + 4]) + t * s[o + 6];
  return [s[o + 4] + r * Math.cos(a), s[o + 5] + r * Math.sin(a)];
}

function segLen(s, o) {
  const flat = s[o + 6] === 0 ? Math.hypot(s[o + 2] - s[o], s[o + 3] - s[o + 1])
    : Math.abs(s[o + 6]) * Math.hypot(s[o] - s[o + 4], s[o + 1] - s[o + 5]);
  return Math.hypot(flat, s[o + 8] - s[o + 7]);
}

// Frames of a machine: times, and for the first machine pulses, samples and jobs.
export function makeRun(mode, machine) {
  if (mode === 'tape' || mode === 'broken') return makeRun('plate', machine);
  const good = mode === 'error' ? 'plate' : mode;
  const { moves } = drawingParts(good);
  const pulsed = machine === 'mark-century' && !good.startsWith('big');
  const clock = pulsed ? CLOCK : 1;
  const r = {
    frame: [], tick: [], info: [], feed: [], row: [], commands: [], pulseTick: [], pulseSteps: [],
    framePulse: [0], sample: [], job: [], pulsed, clock, lines: ['%', 'G21 G90 G17'],
  };
  let now = 0;
  const at = [moves.seg[0], moves.seg[1], moves.seg[7]];
  const begin = [...at];
  let row = pulsed ? 10 : 2;
  const command = (text) => {
    const i = r.frame.length / 9;
    r.frame.push(at[0], at[1], at[0], at[1], 0, 0, 0, at[2], at[2]);
    r.tick.push(now, now, 0);
    r.info.push(3, 0, -1, 0, 0);
    r.feed.push(0, 0);
    r.row.push(row, row + 1);
    r.framePulse.push(r.pulseTick.length);
    r.commands.push({ frame: i, tick: now, text });
    r.lines.push(text === 'spindle on, clockwise' ? 'S3000 M3' : 'M5');
    row += 1;
  };
  command('spindle on, clockwise');
  for (let i = 0; i < moves.seg.length / 9; i++) {
    const o = 9 * i;
    const kind = moves.info[5 * i];
    const feed = kind === 0 ? 1200 : moves.feed[i];
    const length = Math.max(segLen(moves.seg, o), 1e-6);
    const wait = pulsed && i % 5 === 2 ? 400 : 0;
    now += wait;
    const ticks = pulsed ? Math.max(1, Math.round((length / feed) * 60 * clock))
      : (length / feed) * 60 * clock;
    const seg = moves.seg.slice(o, o + 9);
    if (pulsed) {
      seg[0] = at[0]; seg[1] = at[1]; seg[7] = at[2];
      const steps = [0, 0, 0];
      for (let t = 1; t <= ticks; t += 4) {
        const f = Math.min(1, t / ticks);
        const [x, y] = segAt(moves.seg, o, f);
        const z = moves.seg[o + 7] + f * (moves.seg[o + 8] - moves.seg[o + 7]);
        let bits = 0;
        [x, y, z].forEach((v, k) => {
          const want = Math.round((v - seg[[0, 1, 7][k]]) / PULSE);
          if (want > steps[k]) { bits |= 1 << (2 * k); steps[k]++; }
          if (want < steps[k]) { bits |= 2 << (2 * k); steps[k]--; }
        });
        if (bits) { r.pulseTick.push(now + t); r.pulseSteps.push(bits); }
      }
      steps.forEach((n, k) => { at[k] = seg[[0, 1, 7][k]] + n * PULSE; });
      [seg[2], seg[3], seg[8]] = at;
      const ramp = Math.min(ticks / 4, 1000);
      r.sample.push(0, now, now + ramp, feed / 2, 0, now + ramp + 1, now + ticks, feed);
      for (let k = 0; k < 3; k++) {
        if (steps[k]) r.sample.push(1 + k, now, now + ticks, (steps[k] / ticks) * clock);
      }
      for (let k = 0; k < 6; k++) {
        const t = now + (k * ticks) / 6;
        r.job.push(k % 3, t, t + 20 * (k % 3), t + 20 * (k % 3) + Math.min(60 + 30 * k, ticks / 7));
      }
    }
    r.frame.push(...seg);
    r.tick.push(now, now + ticks, wait);
    r.info.push(...moves.info.slice(5 * i, 5 * i + 5));
    r.feed.push(feed, feed * 0.9);
    r.row.push(row, row + (pulsed ? 12 : 1));
    r.lines.push(`N${10 * i} G${kind === 0 ? 0 : 1} X${seg[2].toFixed(3)} Y${seg[3].toFixed(3)} `
      + `Z${seg[8].toFixed(3)}${kind ? ` F${feed}` : ''}`);
    row += pulsed ? 12 : 1;
    r.framePulse.push(r.pulseTick.length);
    now += ticks;
  }
  command('end of program');
  return { ...r, rows: row + 10, start: begin, now };
}

export function run(version, mode, machine) {
  const r = makeRun(mode, machine);
  const tape = [];
  if (r.pulsed) for (let i = 0; i < r.rows; i++) tape.push((i * 37 + (i >> 2) * 11) & 255);
  const header = {
    version, machine, title: MACHINES.find((m) => m.name === machine)?.title ?? machine,
    reports: [], clock: r.clock, start: r.start, stop: 'at the end of the tape',
    pulsed: r.pulsed,
    why: r.pulsed ? '' : 'The model of this machine has times only.',
    axes: ['x', 'y', 'z', 'a', 'b']
      .map((name, k) => ({ name, pulse: r.pulsed && k < 3 ? PULSE : 0 })),
    tracks: r.pulsed ? 8 : 0, text: r.pulsed ? '' : `${r.lines.join('\n')}\n%\n`,
    jobs: r.pulsed ? ['interpolate', 'read block', 'display'] : [], commands: r.commands,
  };
  return encode(header, {
    frame: ['f64', r.frame], frameTick: ['f64', r.tick], frameInfo: ['i32', r.info],
    frameFeed: ['f64', r.feed], frameRow: ['i32', r.row], tape: ['u8', tape],
  });
}

export function pulses(version, mode, machine) {
  const r = makeRun(mode, machine);
  return encode({ version, machine }, {
    pulseTick: ['f64', r.pulseTick], pulseSteps: ['i32', r.pulseSteps],
    framePulse: ['i32', r.framePulse], sample: ['f64', r.sample], job: ['f64', r.job],
  });
}

export function rows(mode, machine, from, to) {
  const r = makeRun(mode, machine);
  const out = [];
  for (let row = from; row < Math.min(to, r.rows); row++) {
    const k = row - 11;
    const f = k < 0 ? null : Math.floor(k / 12) + 1;
    out.push({
      row, meaning: row < 10 ? 'leader' : ['end of block', 'address X', 'digit 4', 'digit 0',
        'digit 5', 'sign −', 'address Y', 'digit 1', 'digit 2', 'address F', 'digit 3',
        'parity'][(k + 120) % 12], frame: f,
    });
  }
  return out;
}
