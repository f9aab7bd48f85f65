// Measures the preview with large programs: the time from the save to the picture, the time of the
// page's own script for each picture while it plays, and its heap. PARTC names the program partc.
// The rasterising is done in software here, so it is left out.

import { spawn } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { chromium } from 'playwright-core';

const partc = process.env.PARTC ?? 'partc';
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'preview-'));

// A contour of n lines on a wavy ring, milled outside by a small cutter.
function ring(n, radius) {
  return `part ring
machine iso6983
tool mill(diameter 1 mm)
feed 300 mm/min
tolerance 0.005 mm
from (${radius + 20}, 0)
let n = ${n}
contour ring closed {
  for k in 0..n - 1 {
    polar(${radius} + 10 * sin(k * 360 * 12 / n), k * 360 / n)
  }
}
mill ring outside {
}
`;
}

async function serve(file) {
  const server = spawn(partc, ['preview', '--no-open', file]);
  const url = await new Promise((resolve) => {
    server.stdout.on('data', (chunk) => resolve(String(chunk).trim()));
  });
  return { url, server };
}

const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=swiftshader', '--use-gl=angle',
    '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist', '--enable-precise-memory-info'] });

async function firstPicture(n, radius) {
  const file = path.join(folder, `ring${n}.part`);
  fs.writeFileSync(file, 'part ring');
  const { url, server } = await serve(file);
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  await page.goto(url);
  await page.waitForFunction(() => window.partc?.state.drawing);
  const begun = Date.now();
  fs.writeFileSync(file, ring(n, radius));
  await page.waitForFunction(() => window.partc.state.moves?.count > 1000, null,
    { timeout: 120000, polling: 20 });
  await page.evaluate(() => new Promise((done) => {
    requestAnimationFrame(() => requestAnimationFrame(done));
  }));
  console.log(`${n} elements: picture ${Date.now() - begun} ms after the save`);
  return { page, server };
}

async function playing(page, view) {
  await page.waitForFunction(() => window.partc.state.frames?.count > 1000, null,
    { timeout: 120000 });
  await page.click(`#view-${view}`);
  await page.waitForTimeout(2000);
  await page.selectOption('#speed', '100');
  await page.evaluate(() => {
    Object.assign(window.partc.timings, { worst: 0, count: 0, sum: 0 });
  });
  await page.click('#play');
  await page.waitForTimeout(8000);
  await page.click('#play');
  const [{ sum, worst, count }, heap, frames] = await page.evaluate(() => [window.partc.timings,
    performance.memory.usedJSHeapSize, window.partc.state.frames.count]);
  console.log(`${frames} frames, ${view}: ${count} pictures, script ${(sum / count).toFixed(1)} ms `
    + `in the mean, ${worst.toFixed(1)} ms at most; heap ${(heap / 1e6).toFixed(0)} MB`);
}

for (const [n, radius, views] of [[100000, 3000, ['plan']], [10000, 300, ['plan', 'space']]]) {
  const { page, server } = await firstPicture(n, radius);
  for (const view of views) await playing(page, view);
  server.kill('SIGINT');
  await page.close();
}
await browser.close();
