// Tests of the preview as its users have it: the program partc, files on the disk, and Chromium.
// The environment variable PARTC names the program; SHOTS names a folder for screenshots.

import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import test, { after, before } from 'node:test';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';

const partc = process.env.PARTC ?? 'partc';
const root = path.join(path.dirname(fileURLToPath(import.meta.url)), '../..');
const example = (name) => path.join(root, 'examples', name);
const axe = fs.readFileSync(new URL('./node_modules/axe-core/axe.min.js', import.meta.url), 'utf8');
let browser;

before(async () => {
  browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-angle=swiftshader', '--use-gl=angle',
      '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist', '--enable-precise-memory-info'] });
});
after(() => browser.close());

/** Starts the preview of a file in a folder of its own. */
async function serve(file, ...options) {
  const server = spawn(partc, ['preview', '--no-open', ...options, file]);
  const url = await new Promise((resolve, reject) => {
    let text = '';
    server.stdout.on('data', (chunk) => {
      text += chunk;
      if (text.includes('\n')) resolve(text.trim());
    });
    server.stderr.on('data', (chunk) => reject(new Error(String(chunk))));
    server.on('exit', (status) => reject(new Error(`status ${status}`)));
  });
  return { url, stop: () => server.kill('SIGINT'), server };
}

function copied(name) {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'preview-'));
  const file = path.join(folder, path.basename(name));
  fs.copyFileSync(example(name), file);
  return file;
}

/** Opens a page, and collects what must not happen: console errors, requests to other hosts. */
async function open(url, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
  const page = await context.newPage();
  page.faults = [];
  page.on('console', (m) => {
    if (m.type() === 'error') page.faults.push(m.text());
  });
  page.on('pageerror', (e) => page.faults.push(e.stack));
  page.on('request', (r) => {
    if (!r.url().startsWith(url)) page.faults.push(r.url());
  });
  await page.goto(url);
  await page.waitForFunction(() => window.partc?.state.drawing?.header.drawn);
  page.screen = (x, y) => page.evaluate(([a, b]) => {
    const r = document.getElementById('plan').getBoundingClientRect();
    const v = window.partc.plan.viewport;
    return [r.left + v.sx(a), r.top + v.sy(b)];
  }, [x, y]);
  page.end = async () => {
    await context.close();
    assert.deepEqual(page.faults, []);
  };
  return page;
}

const framesShown = (page, machine) => page.waitForFunction((name) => window.partc.state.frames
  && window.partc.state.run.header.machine === name, machine);

const shot = async (page, name) => {
  const folder = process.env.SHOTS;
  if (folder) await page.screenshot({ path: path.join(folder, `${name}.png`) });
};

async function seriousFaults(page) {
  // The policy of the page forbids a script in the document, not one of the debugger.
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => window.axe.run());
  return violations.filter((v) => ['serious', 'critical'].includes(v.impact))
    .map((v) => [v.id, v.nodes.map((n) => n.html.slice(0, 90))]);
}

test('the flange is edited, shown, played, clicked and measured', async (t) => {
  const file = copied('flange.part');
  const text = fs.readFileSync(file, 'utf8');
  const { url, stop } = await serve(file);
  const page = await open(url);
  await framesShown(page, 'lkp-01f');
  await shot(page, 'flange');

  await t.test('a valid text changes the picture', async () => {
    const old = await page.evaluate(() => Array.from(window.partc.state.drawing.arrays.contour));
    const begun = Date.now();
    fs.writeFileSync(file, text.replace('polar(41, a)', 'polar(43, a)'));
    await page.waitForFunction((o) => window.partc.state.drawing.arrays.contour
      .some((n, i) => n !== o[i]), old);
    t.diagnostic(`picture after ${Date.now() - begun} ms`);
  });

  await t.test('a mistake is reported, and the picture stays', async () => {
    const begun = Date.now();
    fs.writeFileSync(file, text.replace('tool      mill', 'tool      mil'));
    await page.waitForSelector('.report.error');
    t.diagnostic(`report after ${Date.now() - begun} ms`);
    assert.match(await page.textContent('.report.error'), /mill/);
    assert.match(await page.textContent('.report.error .excerpt'), /tool +mil\(/);
    assert.ok(await page.isVisible('#stale'));
    assert.ok(await page.evaluate(() => window.partc.state.drawing.arrays.contour.length > 0));
    await page.waitForTimeout(200);
    await shot(page, 'flange-mistake');
  });

  await t.test('the page recovers', async () => {
    const begun = Date.now();
    fs.writeFileSync(file, text);
    await page.waitForSelector('.report', { state: 'detached' });
    await page.waitForFunction(() => window.partc.state.drawing.header.present);
    t.diagnostic(`recovered after ${Date.now() - begun} ms`);
    assert.ok(!await page.isVisible('#stale'));
  });

  await t.test('the tape plays to its end', async () => {
    await framesShown(page, 'lkp-01f');
    await page.selectOption('#speed', '100');
    await page.click('#play');
    await page.waitForFunction(() => window.partc.clock.tick === window.partc.clock.end, null,
      { timeout: 30000 });
    assert.match(await page.textContent('#readout'), /stopped/);
    await shot(page, 'flange-end');
  });

  await t.test('frames lead to lines, lines to frames, and the picture to both', async () => {
    await page.click('#tab-frames');
    await page.click('#frame-list [role=option] >> nth=2');
    const line = await page.evaluate(() => {
      const { selection, run } = window.partc.state;
      return [selection.frame, selection.line, run.arrays.frameInfo[5 * selection.frame + 3]];
    });
    assert.ok(line[0] >= 0);
    assert.equal(line[1], line[2]);
    await page.click('#tab-text');
    await page.click('#text-list [role=option]:has-text("cw lug(a)")');
    assert.equal(await page.evaluate(() => window.partc.state.selection.line), 19);
    // The lug at 90°: its arc begins 9 mm above the centre of the lug.
    await page.mouse.click(...await page.screen(59.3, 59.1 + 41 + 9));
    assert.equal(await page.evaluate(() => window.partc.state.selection.line), 19);
  });

  await t.test('41 mm are measured from the centre to the centre of a lug', async () => {
    await page.click('#measure-button');
    await page.mouse.click(...await page.screen(59.3 + 0.3, 59.1 - 0.2));
    await page.mouse.click(...await page.screen(59.3 + 0.2, 100.1 + 0.3));
    assert.match(await page.textContent('#measure-text'), /Distance 41(\.0*)? mm/);
    await shot(page, 'flange-measured');
    await page.click('#measure-button');
  });

  await t.test('the machine is exchanged', async () => {
    await page.selectOption('#machine', 'n55');
    await framesShown(page, 'n55');
    await page.click('#tab-tape');
    await page.keyboard.press('End');
    await shot(page, 'flange-n55');
    await page.selectOption('#machine', 'fanuc');
    await page.waitForFunction(() => /E0512/.test(document.body.textContent));
  });
  await page.end();
  stop();
});

test('the cutter of the page is where that of `partc run` is', async () => {
  const { url, stop } = await serve(copied('flange.part'));
  const page = await open(url);
  for (const machine of ['lkp-01f', 'lki-un', 'n55', 'kontur-2p']) {
    await page.selectOption('#machine', machine);
    await framesShown(page, machine);
    await page.waitForFunction(() => window.partc.state.pulses);
    const pulses = execFileSync(partc, ['run', example('flange.part'), '-t', machine, '--pulses'],
      { encoding: 'utf8', maxBuffer: 1e9 }).trim().split('\n').map((l) => l.split(' '));
    const size = await page.evaluate(() => window.partc.state.run.header.axes.map((a) => a.pulse));
    const end = Number(pulses.at(-1)[2]);
    const at = { x: 0, y: 0 };
    const ticks = Array.from({ length: 400 }, (_, i) => Math.round(end * i / 399));
    const shown = await page.evaluate((all) => all.map((tick) => {
      const p = window.partc.positionAt(tick);
      return [p.x, p.y];
    }), ticks);
    let next = 0;
    ticks.forEach((tick, i) => {
      for (; next < pulses.length && Number(pulses[next][2]) <= tick; next++) {
        const [axis, sign] = pulses[next];
        at[axis] += (sign === '+' ? 1 : -1) * size[axis === 'x' ? 0 : 1];
      }
      assert.ok(Math.abs(shown[i][0] - at.x) < 1e-6 && Math.abs(shown[i][1] - at.y) < 1e-6,
        `${machine}, tick ${tick}: ${shown[i]}, ${at.x}, ${at.y}`);
    });
  }
  await page.end();
  stop();
});

test('tapes and G-code are shown without their programs', async () => {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'preview-'));
  const jobs = [['flange.part', 'n55', 'tape'], ['cnc/cover.part', 'linuxcnc-mill', 'ngc']];
  for (const [name, machine, ending] of jobs) {
    const tape = path.join(folder, `part.${ending}`);
    execFileSync(partc, ['compile', example(name), '-t', machine, '-o', tape]);
    const { url, stop } = await serve(tape, '-t', machine);
    const page = await open(url);
    await framesShown(page, machine);
    assert.ok(await page.evaluate(() => window.partc.state.frames.count) > 10);
    await page.click('#tab-tape');
    await page.focus('#plan');
    await page.keyboard.press('End');
    await shot(page, `alone-${machine}`);
    await page.end();
    stop();
  }
});

test('turned parts, pockets, drilled holes and inches are shown', async () => {
  for (const name of ['shaft.part', 'tray.part', 'holes.part', 'cnc/bore-inches.part']) {
    const { url, stop } = await serve(copied(name));
    const page = await open(url);
    const short = path.basename(name, '.part');
    await page.waitForTimeout(300);
    await shot(page, short);
    await page.click('#view-space');
    await page.waitForTimeout(500);
    await shot(page, `${short}-space`);
    await page.end();
    stop();
  }
});

test('pictures for the documents', async () => {
  const jobs = [['flange.part', 'n55', 'plan', 0.42, 'preview', 'light'],
    ['holes.part', 'iso6983', 'space', 0.62, 'preview-space', 'dark']];
  for (const [name, machine, view, part, picture, colorScheme] of jobs) {
    const { url, stop } = await serve(copied(name), '-t', machine);
    const page = await open(url, { colorScheme, viewport: { width: 1360, height: 820 } });
    await framesShown(page, machine);
    await page.click(`#view-${view}`);
    await page.click('#tab-tape');
    await page.evaluate((p) => window.partc.player.seek(window.partc.clock.end * p), part);
    await page.waitForTimeout(1500);
    await shot(page, picture);
    await page.end();
    stop();
  }
});

test('the page has no serious fault of accessibility, in light and dark', async () => {
  const file = copied('flange.part');
  const { url, stop } = await serve(file);
  for (const colorScheme of ['light', 'dark']) {
    const page = await open(url, { colorScheme });
    await framesShown(page, 'lkp-01f');
    assert.deepEqual(await seriousFaults(page), []);
    await page.click('#tab-tape');
    await page.click('#view-space');
    assert.deepEqual(await seriousFaults(page), []);
    await shot(page, `space-${colorScheme}`);
    await page.end();
  }
  stop();
});

test('the page fits a telephone', async () => {
  const { url, stop } = await serve(copied('flange.part'));
  const page = await open(url, { viewport: { width: 360, height: 740 }, hasTouch: true });
  await framesShown(page, 'lkp-01f');
  const [width, room] = await page.evaluate(() => [document.documentElement.scrollWidth,
    document.documentElement.clientWidth]);
  assert.ok(width <= room);
  await shot(page, 'telephone');
  await page.end();
  stop();
});

test('the page says that partc has ended', async () => {
  const { url, stop } = await serve(copied('flange.part'));
  const page = await open(url);
  stop();
  await page.waitForFunction(() => /ended/.test(document.getElementById('status').textContent));
  page.faults = page.faults.filter((fault) => !/ERR_CONNECTION|ERR_INCOMPLETE/.test(fault));
  await page.end();
});
