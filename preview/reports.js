// Reports of the text and of the machine: severity, code, text, excerpt and hint.

import { filesOf } from './text.js';

/** Shows reports in an element; `go(report)` is called for a click on one with a place. */
export function createReports(element, store, go) {
  store.on(['drawing', 'run'], (s) => {
    const own = s.drawing?.header.reports ?? [];
    const machine = (s.run?.header.reports ?? []).filter((report) => !own.some((other) => (
      other.code === report.code && other.line === report.line && other.text === report.text)));
    const all = [...own, ...machine];
    element.hidden = all.length === 0;
    element.replaceChildren(...all.map((report) => makeCard(report, filesOf(s.drawing), go)));
  });
}

/** Counts of errors and warnings as a text, such as `1 error, 2 warnings`. */
export function countText(reports) {
  const of = (severity) => reports.filter((report) => report.severity === severity).length;
  const counted = (n, word) => (n === 0 ? '' : `${n} ${word}${n === 1 ? '' : 's'}`);
  return ['error', 'warning'].map((word) => counted(of(word), word)).filter(Boolean).join(', ');
}

function makeCard(report, files, go) {
  const placed = report.file >= 0;
  const out = part('article', `report ${report.severity}`, '');
  const head = part(placed ? 'button' : 'span', 'head', '');
  head.append(part('span', 'severity', `${report.severity} ${report.code}: `), report.text);
  out.append(head);
  if (placed) {
    head.type = 'button';
    head.title = 'Go to this line';
    out.classList.add('placed');
    out.addEventListener('click', () => go(report));
    const name = files[report.file]?.name ?? '';
    out.append(part('span', 'place', `${name}, line ${report.line}, column ${report.column}`));
  }
  if (report.excerpt) {
    const excerpt = part('div', 'excerpt', report.excerpt);
    excerpt.tabIndex = 0;
    excerpt.setAttribute('role', 'group');
    excerpt.setAttribute('aria-label', 'Excerpt of the text');
    out.append(excerpt);
  }
  for (const sentence of report.message ?? []) out.append(part('span', 'message', sentence));
  if (report.hint) {
    const hint = part('span', 'hint', '');
    hint.append(part('strong', '', 'Hint: '), report.hint);
    out.append(hint);
  }
  return out;
}

function part(tag, name, text) {
  const out = document.createElement(tag);
  if (name) out.className = name;
  out.textContent = text;
  return out;
}
