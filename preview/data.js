// What is fetched from the server. All addresses are relative to that of the page.

import { decode } from './container.js';

async function container(address) {
  const response = await fetch(address, { cache: 'no-store' });
  if (!response.ok) throw new Error(`partc answers ${response.status} for ${address}.`);
  return decode(await response.arrayBuffer());
}

function query(version, machine) {
  return `version=${encodeURIComponent(version)}&machine=${encodeURIComponent(machine)}`;
}

/** Fetches the part and the toolpath. */
export function fetchDrawing() {
  return container('drawing');
}

/** Fetches the frames of a machine and their times. */
export function fetchRun(version, machine) {
  return container(`run?${query(version, machine)}`);
}

/** Fetches the pulses, samples and jobs of a machine. */
export function fetchPulses(version, machine) {
  return container(`pulses?${query(version, machine)}`);
}

/** Fetches the meanings of the rows of the tape from `from` up to `to`, at most 500 of them. */
export async function fetchRows(version, machine, from, to) {
  const address = `rows?${query(version, machine)}&from=${from}&to=${to}`;
  const response = await fetch(address, { cache: 'no-store' });
  return response.ok ? response.json() : [];
}

/** Shows a place in the editor: file from 0, line and column from 1. */
export async function showInEditor(file, line, column) {
  try {
    await fetch('show', { method: 'POST',
      headers: { 'Content-Type': 'application/json' },
      body: JSON.stringify({ file, line, column }) });
  } catch { /* Without the server there is no editor either. */ }
}

/**
 * Listens to the server: version(n), cursor(place), open() after each connection and lost() when
 * the server does not answer. Connects again by itself.
 */
export function listen(on) {
  let failures = 0;
  const connect = () => {
    const source = new EventSource('events');
    source.onopen = () => {
      failures = 0;
      on.open();
    };
    source.onmessage = (message) => {
      const event = JSON.parse(message.data);
      if (event.version !== undefined) on.version(event.version);
      if (event.cursor) on.cursor(event.cursor);
    };
    source.onerror = () => {
      source.close();
      failures += 1;
      // One failure may be a pause of the connection; the second one says that nobody answers.
      if (failures > 1) on.lost();
      setTimeout(connect, failures > 1 ? 2000 : 300);
    };
  };
  connect();
}
