// The text of the program with its line numbers, and the texts that it imports.

import { createList, span } from './vlist.js';

/** Makes the view of the text. `choose(file, line)` is called for a click on a line. */
export function createText(elements, store, choose) {
  const view = { file: 0, lines: [], playing: { file: -1, line: -1 }, severities: new Map() };
  const list = createList(elements.list, 'Text of the program',
    (row, i) => fill(view, store, row, i), (i) => choose(view.file, i + 1));
  list.chosen = (i) => {
    const s = store.state.selection;
    return s.textFile === view.file && s.textLine === i + 1;
  };
  Object.assign(view, {
    /** Shows a file by its number. */
    open: (file) => openFile(view, elements, list, filesOf(store.state.drawing)[file], file),
    /** Scrolls to a line (from 1) of a file. */
    show(file, line) {
      if (file < 0) return;
      if (file !== view.file) view.open(file);
      list.active = Math.max(0, line - 1);
      list.refresh();
      list.reveal(line - 1);
    },
    /** Marks the line of the frame that the playback has reached. */
    play(file, line, follow) {
      if (view.playing.file === file && view.playing.line === line) return;
      view.playing = { file, line };
      if (follow && file >= 0 && file !== view.file) view.open(file);
      if (follow && file >= 0 && file === view.file) list.reveal(line - 1);
      list.refresh();
    },
    /** Scrolls to the line of the frame that the playback has reached. */
    catchUp() {
      const { file, line } = view.playing;
      if (file < 0) return;
      if (file !== view.file) view.open(file);
      list.reveal(line - 1);
    },
  });
  elements.select.addEventListener('change', () => view.open(Number(elements.select.value)));
  store.on(['drawing'], () => load(view, elements, store));
  store.later(['selection', 'cursor'], () => list.refresh());
  return view;
}

function openFile(view, elements, list, file, index) {
  view.file = index;
  elements.select.value = String(index);
  view.lines = file ? file.text.split('\n') : [];
  if (view.lines.length > 1 && view.lines[view.lines.length - 1] === '') view.lines.pop();
  list.setCount(view.lines.length);
}

/** Files of the present text, to which reports and clicks refer. */
export function filesOf(drawing) {
  if (!drawing) return [];
  const { present, presentFiles, files } = drawing.header;
  return present || !presentFiles ? files ?? [] : presentFiles;
}

function load(view, elements, store) {
  const files = filesOf(store.state.drawing);
  elements.label.hidden = files.length < 2;
  elements.select.replaceChildren(...files.map((file, i) => new Option(file.name, i)));
  view.severities.clear();
  for (const report of store.state.drawing?.header.reports ?? []) {
    for (let line = report.line; line <= Math.max(report.line, report.endLine || 0); line++) {
      const key = `${report.file}:${line}`;
      if (view.severities.get(key) !== 'error') view.severities.set(key, report.severity);
    }
  }
  view.open(files[view.file] ? view.file : 0);
}

function fill(view, store, row, i) {
  const line = i + 1;
  row.append(span(String(line), 'num'), span(view.lines[i] || ' '));
  const severity = view.severities.get(`${view.file}:${line}`);
  if (severity) {
    row.classList.add(`has-${severity}`);
    row.title = severity;
  }
  const { selection, cursor } = store.state;
  const chosen = selection.textFile === view.file && selection.textLine === line;
  if (chosen) row.classList.add('chosen');
  else if (view.playing.file === view.file && view.playing.line === line) {
    row.classList.add('present');
  }
  if (cursor && cursor.file === view.file && cursor.line === line) row.classList.add('cursor');
}
