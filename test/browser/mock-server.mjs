// A mock of the server of `partc preview`. POST control {"mode": M, "options": {…}} changes the
// text.

import http from 'node:http';
import fs from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import * as data from './mock-data.mjs';

const here = path.dirname(fileURLToPath(import.meta.url));
const folder = path.join(here, '../../preview');
const TYPES = { '.html': 'text/html; charset=utf-8', '.css': 'text/css', '.js': 'text/javascript',
  '.svg': 'image/svg+xml' };
const CSP = "default-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

export function start(port = 0, token = 'secrettoken') {
  const state = { version: 1, mode: 'plate', options: {}, shown: [], streams: new Set() };
  const cache = new Map();
  const once = (key, make) => {
    if (!cache.has(key)) cache.set(key, make());
    return cache.get(key);
  };
  const tell = (event) => {
    for (const stream of state.streams) stream.write(`data: ${JSON.stringify(event)}\n\n`);
  };
  state.tell = tell;
  state.change = (mode, options = state.options) => {
    Object.assign(state, { mode, options, version: state.version + 1 });
    tell({ version: state.version });
  };
  const answer = (name, query, response) => {
    const binary = (body) => response.writeHead(200, { 'Content-Type': 'application/octet-stream',
      'Cache-Control': 'no-store' }).end(body);
    const machine = query.get('machine');
    const { version, mode, options } = state;
    const key = `${mode} ${machine} ${JSON.stringify(options)}`;
    if (name === 'drawing') return binary(data.drawing(version, mode, options));
    if (name === 'run') return binary(once(`run ${key}`, () => data.run(version, mode, machine)));
    if (name === 'pulses') {
      return binary(once(`pulses ${key}`, () => data.pulses(version, mode, machine)));
    }
    if (name === 'rows') {
      response.writeHead(200, { 'Content-Type': 'application/json' });
      return response.end(JSON.stringify(data.rows(mode, machine, Number(query.get('from')),
        Number(query.get('to')))));
    }
    if (name === 'events') {
      response.writeHead(200, { 'Content-Type': 'text/event-stream', 'Cache-Control': 'no-store' });
      response.write(`data: ${JSON.stringify({ version })}\n\n`);
      state.streams.add(response);
      response.on('close', () => state.streams.delete(response));
      return undefined;
    }
    const file = path.join(folder, name === '' ? 'index.html' : name);
    if (!file.startsWith(folder) || !fs.existsSync(file)) return response.writeHead(404).end();
    response.writeHead(200, { 'Content-Type': TYPES[path.extname(file)] ?? 'text/plain',
      'Content-Security-Policy': CSP, 'Cache-Control': 'no-store' });
    return response.end(fs.readFileSync(file));
  };
  const server = http.createServer((request, response) => {
    const url = new URL(request.url, 'http://x');
    const prefix = `/${token}/`;
    if (!url.pathname.startsWith(prefix)) return response.writeHead(404).end();
    const name = url.pathname.slice(prefix.length);
    if (request.method !== 'POST') return answer(name, url.searchParams, response);
    let body = '';
    request.on('data', (part) => { body += part; });
    request.on('end', () => {
      const value = JSON.parse(body);
      if (name === 'show') state.shown.push(value);
      if (name === 'control') state.change(value.mode, value.options);
      if (name === 'cursor') tell({ cursor: value });
      response.writeHead(204).end();
    });
    return undefined;
  });
  return new Promise((resolve) => {
    server.listen(port, '127.0.0.1', () => resolve({ server, state,
      url: `http://127.0.0.1:${server.address().port}/${token}/`,
      stop: () => new Promise((done) => {
        for (const stream of state.streams) stream.end();
        server.close(done);
        server.closeAllConnections();
      }) }));
  });
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const { url } = await start(Number(process.argv[2] ?? 8123));
  console.log(url);
}
