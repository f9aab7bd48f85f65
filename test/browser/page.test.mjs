// Tests of the page in headless Chromium against the mock server.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import test from 'node:test';
import { fetched, inked, mock, open, restart, shot } from './page.mjs';

const AXE = fs.readFileSync(new URL('./node_modules/axe-core/axe.min.js', import.meta.url), 'utf8');

test('the picture appears', async () => {
  const page = await open();
  assert.ok(await inked(page, 'plan-base') > 5000);
  assert.ok(await inked(page, 'plan-path') > 1000);
  assert.ok(await inked(page, 'plan-swept') > 10000);
  assert.match(await page.title(), /plate\.part/);
  assert.equal(await page.textContent('#status'), 'no mistakes');
  await page.end();
});

test('an error shows reports and keeps the picture; then the page recovers', async () => {
  const page = await open();
  await page.evaluate(() => partc.plan.zoomBy(3));
  const view = () => page.evaluate(() => JSON.stringify(partc.plan.viewport.copy()));
  const old = await view();
  const run = await page.evaluateHandle(() => partc.state.run);
  mock.state.change('error');
  await page.waitForSelector('.report.error');
  assert.ok(await page.isVisible('#stale'));
  assert.match(await page.textContent('.report.error .excerpt'), /line\(\(0, 80\), \(120, 80\)\)/);
  assert.match(await page.textContent('.report.error .hint'), /fillet/);
  assert.match(await page.textContent('#status'), /1 error, 1 warning/);
  assert.equal(await view(), old);
  assert.ok(await page.evaluate((r) => partc.state.run === r, run));
  await page.click('.report.error');
  assert.ok(await page.isVisible('.vrow.chosen.has-error'));
  assert.ok(await inked(page, 'plan-base') > 1000);
  mock.state.change('plate');
  await page.waitForFunction(() => partc.state.drawing.header.present);
  await page.waitForSelector('.report', { state: 'detached' });
  assert.ok(!await page.isVisible('#stale'));
  assert.equal(await view(), old);
  await page.end();
});

test('a page that is opened with an error shows the last good picture', async () => {
  const page = await open({}, 'error');
  assert.ok(await page.isVisible('#stale'));
  assert.ok(await inked(page, 'plan-path') > 1000);
  await page.end();
});

test('a text that never had a picture shows its reports only', async () => {
  const page = await open({}, 'broken');
  await page.waitForSelector('.report.error');
  assert.ok(await page.isVisible('#empty'));
  assert.ok(!await page.isVisible('#stale'));
  mock.state.change('plate');
  await page.waitForFunction(() => partc.state.frames);
  assert.ok(await inked(page, 'plan-path') > 1000);
  await page.end();
});

test('a tape without its program is shown and played', async () => {
  const page = await open({}, 'tape');
  await page.waitForFunction(() => partc.state.frames);
  assert.ok(await inked(page, 'plan-path') > 1000);
  await page.click('#frame-on');
  await page.click('#view-space');
  await page.waitForFunction(() => /address X/
    .test(document.getElementById('tape-rows').textContent));
  await page.end();
});

test('a tape without its program opens with its rows, and has no list of lines', async () => {
  const page = await open({}, 'tape');
  const tabs = () => page.evaluate(() => [...document.querySelectorAll('[role=tab]')]
    .filter((tab) => tab.checkVisibility()).map((tab) => tab.textContent));
  assert.deepEqual(await tabs(), ['Frames', 'Tape']);
  assert.equal(await page.textContent('[role=tab][aria-selected=true]'), 'Tape');
  assert.ok(await page.isVisible('#tape-holes') && !await page.isVisible('#panel-text'));
  await shot(page, 'tape-alone');
  await page.focus('#tab-tape');
  for (const name of ['Frames', 'Tape', 'Frames']) {
    await page.keyboard.press('ArrowRight');
    assert.equal(await page.textContent('[role=tab][aria-selected=true]'), name);
  }
  mock.state.change('plate');
  await page.waitForSelector('#tab-text');
  assert.deepEqual(await tabs(), ['Program', 'Frames', 'Tape']);
  assert.equal(await page.textContent('[role=tab][aria-selected=true]'), 'Frames');
  await page.end();
});

test('playback runs to the end, backwards, and by steps', async () => {
  const page = await open();
  await page.selectOption('#speed', '100');
  await page.click('#play');
  await page.waitForFunction(() => partc.clock.tick === partc.clock.end, null, { timeout: 20000 });
  assert.equal(await page.evaluate(() => partc.clock.direction), 0);
  assert.match(await page.textContent('#readout'), /stopped: at the end of the tape/);
  await page.click('#play-back');
  await page.waitForFunction(() => partc.clock.tick === 0, null, { timeout: 20000 });
  await page.click('#frame-on');
  await page.click('#frame-on');
  const [tick, begin] = await page.evaluate(() => [partc.clock.tick,
    partc.state.run.arrays.frameTick[9]]);
  assert.equal(tick, begin);
  await page.click('#pulse-on');
  assert.ok(await page.evaluate(() => partc.state.pulses.arrays.pulseTick
    .includes(partc.clock.tick)));
  await page.click('#pulse-back');
  await page.focus('#plan');
  await page.keyboard.press('End');
  assert.ok(await page.evaluate(() => partc.clock.tick === partc.clock.end));
  await page.keyboard.press('Home');
  await page.keyboard.press(' ');
  assert.equal(await page.evaluate(() => partc.clock.direction), 1);
  await page.keyboard.press(' ');
  await page.end();
});

test('a command disappears when a later frame is played', async () => {
  const page = await open();
  const told = (frame) => page.evaluate((i) => {
    const { frameTick } = partc.state.run.arrays;
    partc.player.seek((frameTick[3 * i] + frameTick[3 * i + 1]) / 2);
    partc.draw();
    const names = [...document.querySelectorAll('#readout dt')];
    return names.find((name) => name.textContent === 'Command').nextElementSibling.textContent;
  }, frame);
  assert.equal(await told(1), 'spindle on, clockwise before this frame');
  await shot(page, 'command');
  assert.equal(await told(2), '–');
  assert.equal(await told(9), '–');
  const last = await page.evaluate(() => partc.state.frames.count - 1);
  assert.equal(await told(last), 'end of program');
  assert.equal(await told(last - 1), '–');
  await page.end();
});

test('lists that are told to follow catch up at once', async () => {
  const page = await open({ viewport: { width: 1280, height: 640 } });
  await page.selectOption('#machine', 'linuxcnc-mill');
  await page.waitForFunction(() => partc.state.run?.header.machine === 'linuxcnc-mill');
  // Goes just behind the begin of the longest frame among those from a given one on.
  const go = (from, running) => page.evaluate(([first, isRunning]) => {
    const { frameTick } = partc.state.run.arrays;
    const lasts = (i) => frameTick[3 * i + 1] - frameTick[3 * i];
    const rest = Array.from({ length: 15 }, (_, k) => first + k);
    const longest = rest.reduce((a, b) => (lasts(b) > lasts(a) ? b : a));
    partc.clock.run(0);
    partc.clock.setSpeed(0.1);
    partc.player.seek(frameTick[3 * longest] + 0.01);
    if (isRunning) partc.clock.run(1);
    partc.draw();
  }, [from, running]);
  const isShown = (list) => page.evaluate((selector) => {
    const row = document.querySelector(`${selector} .vrow.present`)?.getBoundingClientRect();
    const box = document.querySelector(selector).getBoundingClientRect();
    return Boolean(row) && row.top >= box.top && row.bottom <= box.bottom;
  }, list);
  for (const running of [false, true]) {
    for (const [tab, list] of [['#tab-frames', '#frame-list'], ['#tab-text', '#text-list'],
      ['#tab-tape', '#tape-text']]) {
      await page.click(tab);
      await page.uncheck('#follow');
      await page.$eval(list, (element) => { element.scrollTop = 0; });
      await go(28, running);
      assert.ok(!await isShown(list), list);
      await page.check('#follow');
      assert.ok(await isShown(list), list);
    }
  }
  await go(1, true);
  await page.click('#tab-frames');
  assert.ok(await isShown('#frame-list'));
  await page.end();
});

test('the swept area and the trace are the same however a tick is reached', async () => {
  for (const mode of ['plate', 'big20000']) {
    const page = await open({}, mode);
    await page.selectOption('#machine', 'linuxcnc-mill');
    await page.waitForFunction(() => partc.state.run?.header.machine === 'linuxcnc-mill');
    const at = async (part) => {
      await page.evaluate((x) => partc.player.seek(partc.clock.end * x), part);
      for (let k = 0; k < 12; k++) await page.evaluate(() => partc.draw());
    };
    for (const part of [0.2, 0.8, 0.7, 0.69, 0.68, 0.3, 0.31, 0.62, 0.6, 0.601]) await at(part);
    const wandered = [await inked(page, 'plan-swept'), await inked(page, 'plan-trace')];
    await page.evaluate(() => partc.plan.touch());
    await at(0.601);
    const fresh = [await inked(page, 'plan-swept'), await inked(page, 'plan-trace')];
    for (const k of [0, 1]) {
      assert.ok(fresh[k] > 500 && Math.abs(fresh[k] - wandered[k]) < 0.01 * fresh[k],
        `${mode}: ${wandered} against ${fresh}`);
    }
    await page.end();
  }
});

test('the position with pulses agrees with an independent count', async () => {
  const page = await open();
  const run = await fetched('run', 'mark-century');
  const pulses = await fetched('pulses', 'mark-century');
  const end = run.arrays.frameTick.at(-2);
  for (const part of [0, 0.001, 0.1, 0.2501, 0.33, 0.5, 0.66, 0.75, 0.999, 1]) {
    const tick = Math.floor(end * part);
    let frame = -1;
    for (let i = 0; i < run.arrays.frame.length / 9; i++) {
      if (run.arrays.frameTick[3 * i] <= tick) frame = i;
    }
    const at = [0, 1, 7].map((k) => run.arrays.frame[9 * frame + k]);
    for (let i = pulses.arrays.framePulse[frame]; i < pulses.arrays.framePulse[frame + 1]; i++) {
      if (pulses.arrays.pulseTick[i] > tick) continue;
      for (let k = 0; k < 3; k++) {
        const bits = Math.floor(pulses.arrays.pulseSteps[i] / 4 ** k) % 4;
        at[k] += run.header.axes[k].pulse * [0, 1, -1, 0][bits];
      }
    }
    const got = await page.evaluate((t) => partc.positionAt(t), tick);
    assert.equal(got.frame, frame);
    for (const [k, axis] of ['x', 'y', 'z'].entries()) {
      assert.ok(Math.abs(got[axis] - at[k]) < 1e-9, `${axis} at ${tick}: ${got[axis]}, ${at[k]}`);
    }
  }
  await page.end();
});

test('another machine is played, without pulses evenly', async () => {
  const page = await open();
  await page.selectOption('#machine', 'linuxcnc-mill');
  await page.waitForFunction(() => partc.state.run?.header.machine === 'linuxcnc-mill');
  const run = await fetched('run', 'linuxcnc-mill');
  const i = run.arrays.frame.findIndex((v, k) => k % 9 === 6 && v > 0);
  const frame = Math.floor(i / 9);
  const [t0, t1] = run.arrays.frameTick.slice(3 * frame, 3 * frame + 2);
  const s = run.arrays.frame.slice(9 * frame, 9 * frame + 9);
  const got = await page.evaluate((t) => partc.positionAt(t), t0 + 0.3 * (t1 - t0));
  const a = Math.atan2(s[1] - s[5], s[0] - s[4]) + 0.3 * s[6];
  const r = Math.hypot(s[0] - s[4], s[1] - s[5]);
  assert.ok(Math.hypot(got.x - s[4] - r * Math.cos(a), got.y - s[5] - r * Math.sin(a)) < 1e-9);
  assert.ok(await page.isDisabled('#pulse-on'));
  await page.click('#tab-tape');
  await page.evaluate((t) => partc.player.seek(t), t0 + 0.3 * (t1 - t0));
  await page.waitForSelector('#tape-text .vrow.present');
  await page.waitForFunction(() => /G1 X/.test(
    document.querySelector('#tape-text .vrow.present')?.textContent));
  await page.end();
});

test('a drawing without a machine asks for one', async () => {
  const page = await open({}, 'plate', { machine: null });
  assert.match(await page.textContent('#no-run'), /Choose a machine to play the tape/);
  await page.selectOption('#machine', 'mark-century');
  await page.waitForSelector('#player', { state: 'visible' });
  await page.end();
});

test('frames, lines and the picture choose each other', async () => {
  const page = await open();
  await page.click('#tab-frames');
  await page.click('#frame-list .vrow[data-index="9"]');
  const selection = () => page.evaluate(() => ({ ...partc.state.selection }));
  assert.deepEqual([(await selection()).frame, (await selection()).line], [9, 27]);
  await page.click('#tab-text');
  assert.equal(await page.textContent('#text-list .vrow.chosen .num'), '27');
  assert.ok(await inked(page, 'plan-mark') > 50);
  await page.$eval('#text-list', (list) => { list.scrollTop = 600; });
  await page.click('#text-list .vrow[data-index="42"]');
  assert.deepEqual([(await selection()).line, (await selection()).frame], [43, -1]);
  await page.click('#text-list .vrow[data-index="33"]');
  await page.waitForTimeout(50);
  assert.ok(await inked(page, 'plan-mark') > 50);
  mock.state.shown.length = 0;
  await page.clickAt(125, 40);
  const chosen = await selection();
  assert.equal(chosen.line, 27);
  assert.ok(chosen.frame > 0);
  await page.waitForTimeout(100);
  assert.deepEqual(mock.state.shown, [{ file: 0, line: 27, column: 1 }]);
  await page.clickAt(60, 30);
  assert.equal((await selection()).line, 21);
  mock.state.tell({ cursor: { file: 0, line: 34 } });
  await page.waitForFunction(() => partc.state.selection.line === 34);
  await page.end();
});

test('measuring snaps, and speaks in the unit of the program', async () => {
  const page = await open({}, 'plate', { unit: 'inch' });
  await page.click('#measure-button');
  const at = await page.screen(0, 12);
  await page.mouse.click(at[0] + 4, at[1] - 3);
  const to = await page.screen(12, 68);
  await page.mouse.click(to[0] - 2, to[1] + 3);
  const text = await page.textContent('#measure-text');
  const inches = (mm) => (mm / 25.4).toFixed(4);
  assert.ok(text.includes(`Distance ${inches(Math.hypot(12, 56))} in`), text);
  assert.ok(text.includes(`Δx ${inches(12)} in, Δy ${inches(56)} in`), text);
  assert.match(text, /centre of an arc, radius/);
  assert.equal(await page.getAttribute('#measure-text', 'aria-live'), 'polite');
  await page.keyboard.press('Escape');
  await page.keyboard.press('Escape');
  assert.ok(!await page.isVisible('#measure-text'));
  await page.end();
});

test('the keyboard measures too', async () => {
  const page = await open();
  await page.keyboard.press('m');
  await page.focus('#plan');
  const go = async (x, y) => {
    await page.evaluate(([a, b]) => {
      const v = partc.plan.viewport;
      partc.plan.cross = [Math.round(v.sx(a)) + 3, Math.round(v.sy(b)) + 2];
    }, [x, y]);
    await page.keyboard.press('Shift+ArrowLeft');
    await page.keyboard.press('Enter');
  };
  await go(20, 40);
  await go(100, 40);
  assert.match(await page.textContent('#measure-text'), /^Distance 80\.000 mm/);
  await page.end();
});

const legendOf = (page) => page.evaluate(() => ({
  texts: [...document.querySelectorAll('#legend > div')].map((row) => row.textContent),
  bands: document.querySelectorAll('#legend .band').length,
}));

test('the legend of many values is a scale with its ends, of few values a list', async () => {
  const page = await open({}, 'big20000');
  const ends = await page.evaluate(() => {
    const cuts = [...partc.state.moves.feed.keys()]
      .filter((i) => partc.state.moves.info[5 * i] === 2);
    const { seg, feed } = partc.state.moves;
    const of = (value) => [Math.min, Math.max].map((end) => cuts.map(value)
      .reduce((a, b) => end(a, b)));
    return { depth: of((i) => Math.min(seg[9 * i + 7], seg[9 * i + 8])), feed: of((i) => feed[i]) };
  });
  await page.selectOption('#colour', 'depth');
  const [low, high] = ends.depth.map((v) => `${v.toFixed(3).replace('-', '\u2212')} mm`);
  assert.deepEqual(await legendOf(page),
    { texts: ['Depth of cuts', high + low, 'linking move', 'rapid move'], bands: 1 });
  await shot(page, 'legend-depth');
  await page.selectOption('#colour', 'feed');
  const [slow, fast] = ends.feed.map((v) => `${v} mm/min`);
  assert.deepEqual(await legendOf(page),
    { texts: ['Feed of cuts', slow + fast, 'linking move', 'rapid move'], bands: 1 });
  await page.end();
  const plate = await open();
  await plate.selectOption('#colour', 'feed');
  assert.deepEqual(await legendOf(plate), { texts: ['Feed of cuts', ...[60, 120, 150, 200, 250, 300]
    .map((v) => `${v} mm/min`), 'linking move', 'rapid move'], bands: 0 });
  await plate.end();
});

test('colours between the ends of a scale are mixed, and an unknown feed has none', async () => {
  const page = await open();
  const { shades, none, legend, mixed } = await page.evaluate(async () => {
    const { painter, colours } = await import('./theme.js');
    const feeds = [0, ...Array.from({ length: 41 }, (_, k) => 100 + 10 * k)];
    const path = { count: feeds.length, feed: feeds, feedStride: 1, seg: [],
      info: feeds.flatMap(() => [2, 0, 0, 1, 0]) };
    const paint = painter(path, 'feed', { unit: 'mm' });
    const colourAt = (i) => paint.colour(paint.bin(i));
    const all = feeds.slice(1).map((_, k) => colourAt(k + 1));
    return { shades: new Set(all).size, none: [colourAt(0), colours().cut],
      legend: paint.legend.map((row) => row[2]), mixed: [all[0], all[10], all[40]] };
  });
  assert.equal(shades, 41);
  assert.equal(none[0], none[1]);
  assert.deepEqual(legend, ['not known']);
  // The second of the five colours of the scale lies at a quarter of it.
  const rgb = mixed.map((text) => text.match(/\d+/g).map(Number));
  for (const [k, want] of [[217, 164, 0], [156, 138, 60], [0, 40, 95]].entries()) {
    for (const c of [0, 1, 2]) assert.ok(Math.abs(rgb[k][c] - want[c]) <= 4, `${rgb[k]}: ${want}`);
  }
  await page.end();
});

/** Boxes of what is visible of elements: left, top, right and bottom in CSS pixels. */
const boxesOf = (page, ...selectors) => page.evaluate((names) => names.map((name) => {
  const box = document.querySelector(name).getBoundingClientRect();
  return [box.left, box.top, box.right, box.bottom].map(Math.round);
}), selectors);

const meet = (a, b) => a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];

test('the panel of the layers and the legend do not overlap', async () => {
  const page = await open();
  const sizes = [[360, 740], [480, 640], [640, 400], [820, 600], [821, 640], [1000, 640],
    [1280, 800], [1600, 900]];
  for (const view of ['plan', 'space']) {
    await page.click(`#view-${view}`);
    await page.click('#layers-button');
    for (const [width, height] of sizes) {
      await page.setViewportSize({ width, height });
      for (const colour of ['kind', 'feed', 'tool']) {
        await page.selectOption('#colour', colour);
        const [panel, legend, picture] = await boxesOf(page, '#layers-panel', '#legend',
          '#picture');
        const where = `${view} ${width}x${height} ${colour}: ${panel} ${legend} ${picture}`;
        assert.ok(!meet(panel, legend), where);
        assert.ok(legend[2] <= picture[2] && legend[3] <= picture[3], where);
        assert.ok(panel[3] <= picture[3] && panel[2] - panel[0] > 100, where);
        if (view === 'plan' && colour === 'feed') await shot(page, `layers-${width}`);
      }
    }
    await page.click('#layers-button');
  }
  await page.end();
});

test('in a low window nothing covers what happens now', async () => {
  const sizes = [[1280, 640], [821, 640], [1600, 561], [844, 390], [1280, 400], [740, 360],
    [360, 640]];
  for (const mode of ['plate', 'error']) {
    const page = await open({}, mode);
    await page.evaluate(() => partc.player.seek(partc.clock.end / 3));
    for (const [width, height] of sizes) {
      await page.setViewportSize({ width, height });
      for (const name of ['text', 'frames', 'tape']) {
        await page.click(`#tab-${name}`);
        await page.evaluate(() => partc.draw());
        const list = name === 'tape' ? '#tape-canvas' : `#${name.replace('frames', 'frame')}-list`;
        const [panel, inner, now, picture, transport, side] = await boxesOf(page,
          `#panel-${name}`, list, '#now', '#picture', '.transport', '.side');
        const where = `${mode} ${width}x${height} ${name}: ${[panel, inner, now].join(' / ')}`;
        assert.ok(inner[3] <= panel[3] && panel[3] <= now[1], where);
        assert.ok(panel[3] - panel[1] >= 110 && now[3] - now[1] >= 50, where);
        assert.ok(picture[3] <= transport[1] && !meet(transport, side), where);
        assert.ok(picture[3] - picture[1] >= 160, where);
        if (name === 'tape') await shot(page, `low-${mode}-${width}x${height}`);
      }
    }
    await page.end();
  }
});

test('texts and machines are compared', async () => {
  const page = await open();
  mock.state.change('changed');
  await page.waitForFunction(() => partc.state.before
    && partc.state.drawing.header.files[0].text.includes('130'));
  await page.selectOption('#compare', 'before');
  await page.waitForFunction(() => partc.state.other?.kind === 'before');
  const counts = await page.evaluate(() => partc.state.other.counts);
  assert.ok(counts.gone > 4 && counts.fresh > 4 && counts.contourGone > 2);
  assert.match(await page.textContent('#legend'), /\u2212 gone\+ new/);
  await page.selectOption('#compare', 'machine:linuxcnc-mill');
  await page.waitForFunction(() => partc.state.other?.kind === 'machine');
  assert.ok(await page.evaluate(() => partc.state.other.apart.distance) < 0.03);
  await page.end();
});

test('the three-dimensional view draws, turns and chooses', async () => {
  const page = await open();
  await page.keyboard.press('4');
  await page.waitForTimeout(200);
  const first = await page.locator('#space').screenshot();
  await page.focus('#space');
  for (let i = 0; i < 4; i++) await page.keyboard.press('ArrowRight');
  await page.waitForTimeout(200);
  assert.ok(!first.equals(await page.locator('#space').screenshot()));
  await page.click('[data-side=top]');
  const at = await page.evaluate(() => {
    const box = document.getElementById('space').getBoundingClientRect();
    const c = partc.space.camera;
    const p = c.project(c.matrix(), 125, 40, -8, [0, 0]);
    return [box.left + p[0], box.top + p[1]];
  });
  await page.waitForTimeout(100);
  await page.mouse.click(...at);
  assert.equal(await page.evaluate(() => partc.state.selection.line), 27);
  await page.end();
});

async function violations(page) {
  await page.evaluate(AXE);
  const result = await page.evaluate(() => axe.run(document, { resultTypes: ['violations'] }));
  return result.violations.filter((v) => ['serious', 'critical'].includes(v.impact))
    .map((v) => `${v.id}: ${v.nodes.map((n) => n.html).join(' | ').slice(0, 400)}`);
}

for (const colorScheme of ['light', 'dark']) {
  test(`axe finds nothing serious (${colorScheme})`, async () => {
    const page = await open({ colorScheme, bypassCSP: true });
    assert.deepEqual(await violations(page), []);
    await page.click('#tab-frames');
    await page.click('#frame-list .vrow[data-index="3"]');
    await page.click('#layers-button');
    assert.deepEqual(await violations(page), []);
    await page.click('#tab-tape');
    await page.evaluate(() => partc.player.seek(partc.clock.end / 2));
    await page.waitForTimeout(200);
    await page.selectOption('#compare', 'machine:linuxcnc-mill');
    await page.click('#view-space');
    await page.waitForTimeout(200);
    assert.deepEqual(await violations(page), []);
    mock.state.change('error');
    await page.waitForSelector('.report.error');
    await page.click('#tab-text');
    assert.deepEqual(await violations(page), []);
    await page.keyboard.press('Escape');
    await page.keyboard.press('?');
    assert.deepEqual(await violations(page), []);
    await page.end();
  });
}

test('a phone sees everything without scrolling sideways, and pans and pinches', async () => {
  const viewport = { width: 360, height: 740 };
  const page = await open({ viewport, hasTouch: true, isMobile: true });
  const wide = () => page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(await wide() <= 360, `${await wide()}`);
  await page.click('#view-space');
  assert.ok(await wide() <= 360);
  await page.click('#view-plan');
  mock.state.change('error');
  await page.waitForSelector('.report.error');
  assert.ok(await wide() <= 360);
  const cdp = await page.context().newCDPSession(page);
  const box = await page.locator('#plan').boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const touch = (type, ...points) => cdp.send('Input.dispatchTouchEvent', { type,
    touchPoints: points.map(([px, py], id) => ({ x: px, y: py, id })) });
  const scale = await page.evaluate(() => partc.plan.viewport.scale);
  await touch('touchStart', [x - 20, y], [x + 20, y]);
  for (let k = 1; k <= 5; k++) await touch('touchMove', [x - 20 - 8 * k, y], [x + 20 + 8 * k, y]);
  await touch('touchEnd');
  const after1 = await page.evaluate(() => partc.plan.viewport.scale);
  assert.ok(Math.abs(after1 / scale - 3) < 0.1, `${after1 / scale}`);
  await page.end();
});

test('the list of keys opens at its top, and scrolls by the keyboard', async () => {
  for (const viewport of [{ width: 1280, height: 640 }, { width: 360, height: 640 }]) {
    const page = await open({ viewport });
    const top = () => page.$eval('#help', (dialog) => dialog.scrollTop);
    for (const how of [() => page.keyboard.press('?'), () => page.click('#help-button')]) {
      await how();
      assert.ok(await page.$eval('#help', (dialog) => dialog.scrollHeight > dialog.clientHeight));
      assert.equal(await top(), 0);
      assert.ok(await page.isVisible('#help-title'));
      await shot(page, `keys-${viewport.width}`);
      await page.keyboard.press('End');
      await page.waitForFunction(() => document.getElementById('help').scrollTop > 0);
      await page.keyboard.press('Tab');
      assert.equal(await page.evaluate(() => document.activeElement.id), 'help-close');
      await page.keyboard.press('Enter');
      assert.ok(!await page.isVisible('#help'));
    }
    await page.end();
  }
});

test('every control is reached by the keyboard and has a name', async () => {
  const page = await open();
  const seen = new Set();
  for (let i = 0; i < 60; i++) {
    await page.keyboard.press('Tab');
    seen.add(await page.evaluate(() => document.activeElement.id
      || document.activeElement.dataset?.side || document.activeElement.tagName));
  }
  for (const id of ['machine', 'compare', 'theme', 'help-button', 'view-plan', 'zoom-fit',
    'measure-button', 'layers-button', 'colour', 'source', 'plan', 'time', 'play', 'play-back',
    'frame-on', 'pulse-on', 'speed', 'follow', 'tab-text', 'text-list']) {
    assert.ok(seen.has(id), id);
  }
  await page.end();
});

test('the page says when partc has ended, and goes on when it is back', async () => {
  const page = await open();
  await mock.stop();
  await page.waitForFunction(() => /partc has ended/.test(document.getElementById('status')
    .textContent));
  await restart();
  await page.waitForFunction((v) => partc.state.connection === 'open'
    && partc.state.drawing.header.version === v, mock.state.version, { timeout: 10000 });
  await page.end(/ERR_/);
});
