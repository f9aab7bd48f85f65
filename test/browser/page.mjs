// Helpers of the tests of the page: a browser, the mock server, and a page of it.

import assert from 'node:assert/strict';
import { after, before } from 'node:test';
import { chromium } from 'playwright-core';
import { start } from './mock-server.mjs';

const ARGS = ['--no-sandbox', '--use-angle=swiftshader', '--use-gl=angle',
  '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist', '--enable-precise-memory-info'];
/** Mock server of the tests that run. */
export let mock;
let browser;

before(async () => {
  mock = await start();
  browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ARGS });
});
after(async () => {
  await browser.close();
  await mock.stop();
});

/** Takes a screenshot if the environment variable SHOTS names a folder for it. */
export const shot = async (page, name) => {
  const folder = process.env.SHOTS;
  if (folder) await page.screenshot({ path: `${folder}/${name}.png` });
};

/** Opens the page with a text of the mock server. */
export async function open(options = {}, mode = 'plate', control = {}) {
  mock.state.change('plate', control);
  mock.state.change(mode, control);
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
  const page = await context.newPage();
  page.faults = [];
  page.on('console', (m) => {
    const harmless = /willReadFrequently|GPU stall/.test(m.text());
    if (m.type() !== 'info' && !harmless) page.faults.push(m.text());
  });
  page.on('pageerror', (e) => page.faults.push(e.stack));
  page.on('request', (r) => { if (!r.url().startsWith(mock.url)) page.faults.push(r.url()); });
  await page.goto(mock.url);
  await page.waitForFunction(() => window.partc?.state.drawing
    && window.partc.state.runState !== 'loading');
  await page.waitForFunction(() => !partc.state.machine || partc.state.frames);
  await page.evaluate(() => new Promise((done) => {
    requestAnimationFrame(() => requestAnimationFrame(done));
  }));
  page.screen = (x, y) => page.evaluate(([a, b]) => {
    const r = document.getElementById('plan').getBoundingClientRect();
    const v = partc.plan.viewport;
    return [r.left + v.sx(a), r.top + v.sy(b)];
  }, [x, y]);
  page.clickAt = async (x, y) => page.mouse.click(...await page.screen(x, y));
  page.end = async (allowed = /^$/) => {
    const faults = page.faults.filter((fault) => !allowed.test(fault));
    await context.close();
    assert.deepEqual(faults, []);
  };
  return page;
}

/** Count of the pixels of a canvas that are not transparent. */
export const inked = (page, id) => page.evaluate(async (name) => {
  for (let k = 0; k < 3; k++) await new Promise((done) => requestAnimationFrame(done));
  const canvas = document.getElementById(name);
  const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  let n = 0;
  for (let i = 3; i < data.length; i += 4) if (data[i] > 0) n += 1;
  return n;
}, id);

/** Starts a mock server at the port of the one that has ended, with a later version of the text. */
export async function restart() {
  const { state, url } = mock;
  mock = await start(Number(new URL(url).port));
  mock.state.version = state.version + 5;
}

function container(bytes) {
  const size = bytes.readUInt32LE(0);
  const header = JSON.parse(bytes.subarray(8, 8 + size).toString());
  const base = 8 + Math.ceil(size / 8) * 8;
  const read = { f64: ['readDoubleLE', 8], i32: ['readInt32LE', 4], u8: ['readUInt8', 1] };
  const arrays = {};
  for (const [name, { type, offset, length }] of Object.entries(header.arrays)) {
    const [method, step] = read[type];
    arrays[name] = Array.from({ length }, (_, i) => bytes[method](base + offset + i * step));
  }
  return { header, arrays };
}

/** Container of the mock server for a machine, decoded without the page's own module. */
export async function fetched(name, machine) {
  const { url, state } = mock;
  const response = await fetch(`${url}${name}?version=${state.version}&machine=${machine}`);
  return container(Buffer.from(await response.arrayBuffer()));
}
