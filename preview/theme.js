// Colours: those of the style sheet, and the colours of kinds, tools, depths and feeds.

import { CUT, KIND_NAMES, LINK, RAPID, depthRange, feedRange } from './paths.js';
import { feed as feedText, length, unitName } from './format.js';

// Count of the colours of a scale: so many that one cannot be told from the next.
const STEPS = 48;

const NAMES = ['paper', 'face', 'edge', 'ink', 'soft', 'grid', 'grid-strong', 'part', 'contour',
  'cut', 'link', 'rapid', 'other', 'swept', 'rest', 'mark', 'gone', 'new', 'cutter', 'accent',
  'paper-tape', 'hole', 'error'];

// Both scales get lighter or darker all along, so that they can be read without seeing hues.
const SCALES = {
  light: ['#d9a400', '#9c8a3c', '#6d737a', '#3d5588', '#00285f'],
  dark: ['#4a6fb5', '#7087a3', '#a09f86', '#cdbb5f', '#ffe24d'],
};
const TOOLS = {
  light: ['#0063a6', '#c04a00', '#00794f', '#a3397b', '#7a6400', '#2f2f7f'],
  dark: ['#5db4ec', '#ff9d5c', '#3cc79a', '#e48cc0', '#e0cc4c', '#b8b8ff'],
};

let palette = null;

/** Palette of the present scheme: the style sheet's colours by their names. */
export function colours() {
  if (palette) return palette;
  const style = getComputedStyle(document.documentElement);
  palette = {};
  for (const name of NAMES) palette[name] = style.getPropertyValue(`--${name}`).trim();
  palette.dark = document.documentElement.dataset.theme === 'dark';
  palette.scale = scale(SCALES[palette.dark ? 'dark' : 'light']);
  palette.tools = TOOLS[palette.dark ? 'dark' : 'light'];
  return palette;
}

function scale(stops) {
  const rgb = stops.map(parse);
  return Array.from({ length: STEPS }, (_, i) => {
    const at = (i / (STEPS - 1)) * (stops.length - 1);
    const k = Math.min(stops.length - 2, Math.floor(at));
    const part = at - k;
    const mixed = rgb[k].map((v, c) => Math.round(v + part * (rgb[k + 1][c] - v)));
    return `rgb(${mixed.join(' ')})`;
  });
}

/** Components red, green and blue (0 to 255) of a colour `#rrggbb` or `rgb(r g b)`. */
export function parse(colour) {
  if (colour.startsWith('#')) {
    return [1, 3, 5].map((i) => Number.parseInt(colour.slice(i, i + 2), 16));
  }
  return colour.match(/\d+/g).slice(0, 3).map(Number);
}

/** Follows the system's scheme or a chosen one, and calls a function after each change. */
export function followScheme(select, changed) {
  const media = matchMedia('(prefers-color-scheme: dark)');
  const apply = () => {
    const dark = select.value === '' ? media.matches : select.value === 'dark';
    document.documentElement.dataset.theme = dark ? 'dark' : 'light';
    palette = null;
    changed();
  };
  try {
    select.value = localStorage.getItem('partc-theme') ?? '';
  } catch { /* Without storage the choice lasts as long as the page. */ }
  select.addEventListener('change', () => {
    try {
      localStorage.setItem('partc-theme', select.value);
    } catch { /* As above. */ }
    apply();
  });
  media.addEventListener('change', apply);
  apply();
}

/**
 * Chooser of the colours of a path's parts. `bin` gives the number of a part's colour, `colour` the
 * colour of a number, `dashed` whether it is dashed, and `legend` lists [colour, dashed, text].
 * `scale` is null, or has the `colours` of a scale and the texts of its ends, `from` and `to`.
 */
export function painter(path, by, header) {
  const c = colours();
  const kinds = [c.rapid, c.link, c.cut];
  const kindOf = (i) => path.info[5 * i];
  const base = {
    bin: (i) => kindOf(i),
    colour: (bin) => kinds[bin] ?? c.soft,
    dashed: (bin) => bin === RAPID,
    title: '',
    scale: null,
    legend: [CUT, LINK, RAPID].filter((k) => k === CUT || occurring(path).has(k))
      .map((k) => [kinds[k], k === RAPID, KIND_NAMES[k]]),
  };
  if (by === 'tool') return byTool(path, base, header, c);
  if (by === 'depth') {
    const value = (i) => Math.min(path.seg[9 * i + 7], path.seg[9 * i + 8]);
    const text = (v) => `${length(v, header.unit)} ${unitName(header.unit)}`;
    return byScale(path, base, depthRange(path), value, kindOf, c, 'Depth of cuts', text, true);
  }
  if (by === 'feed') {
    const value = (i) => path.feed[i * path.feedStride] || NaN; // a feed of 0 is not known
    const text = (v) => feedText(v, header.unit);
    return byScale(path, base, feedRange(path), value, kindOf, c, 'Feed of cuts', text, false);
  }
  return base;
}

/** Name of a tool with its size in the program's unit. */
export function toolName(tool, unit) {
  const size = tool.kind === 'turning' ? `nose ${length(tool.radius, unit)}`
    : `\u2300 ${length(2 * tool.radius, unit)}`;
  const number = tool.number ? `T${tool.number} ` : '';
  return `${number}${tool.kind} ${size} ${unitName(unit)}`;
}

// Kinds of the parts of a path, found once.
function occurring(path) {
  if (!path.kinds) {
    path.kinds = new Set();
    for (let i = 0; i < path.count; i++) path.kinds.add(path.info[5 * i]);
  }
  return path.kinds;
}

function byTool(path, base, header, c) {
  const count = c.tools.length;
  return {
    ...base,
    bin: (i) => (path.info[5 * i] === CUT ? 3 + Math.max(0, path.info[5 * i + 1]) % count
      : path.info[5 * i]),
    colour: (bin) => (bin >= 3 ? c.tools[bin - 3] : base.colour(bin)),
    title: 'Tools',
    legend: [...header.tools.map((tool, k) => [c.tools[k % count], false,
      toolName(tool, header.unit)]), ...base.legend.slice(1)],
  };
}

// The values of the cuts in order if there are at most six, else null.
function distinct(path, value, kindOf) {
  const found = new Set();
  for (let i = 0; i < path.count; i++) {
    if (kindOf(i) !== CUT || Number.isNaN(value(i))) continue;
    found.add(Math.round(value(i) * 1e4) / 1e4);
    if (found.size > 6) return null;
  }
  return [...found].sort((a, b) => a - b);
}

// Colours of the cuts by a value, which is NaN for those that have none: a row of the legend for
// each of a few values, or a scale between the least and the greatest of many.
function byScale(path, base, span, value, kindOf, c, title, text, fromTop) {
  if (!span) return base;
  const [low, high] = span;
  const few = distinct(path, value, kindOf);
  const step = (part) => Math.round((fromTop ? 1 - part : part) * (STEPS - 1));
  const stepOf = few ? stepOfFew(few, step) : (v) => step((v - low) / (high - low));
  const rows = (few ?? []).map((v) => [c.scale[stepOf(v)], false, text(v)]);
  if (fromTop) rows.reverse();
  const ends = fromTop ? [high, low] : [low, high];
  const isKnown = (i) => kindOf(i) === CUT && !Number.isNaN(value(i));
  const lacks = lacking(path, isKnown) ? [[base.colour(CUT), false, 'not known']] : [];
  return {
    ...base,
    bin: (i) => (isKnown(i) ? 3 + stepOf(value(i)) : kindOf(i)),
    colour: (bin) => (bin >= 3 ? c.scale[bin - 3] : base.colour(bin)),
    title,
    scale: few ? null : { colours: c.scale, from: text(ends[0]), to: text(ends[1]) },
    legend: [...rows, ...lacks, ...base.legend.slice(1)],
  };
}

// A few values have colours that are equally far apart.
function stepOfFew(few, step) {
  const places = new Map(few.map((v, k) => [v, step(few.length > 1 ? k / (few.length - 1) : 0)]));
  return (v) => places.get(Math.round(v * 1e4) / 1e4) ?? 0;
}

// Whether some cuts have no value.
function lacking(path, isKnown) {
  for (let i = 0; i < path.count; i++) {
    if (path.info[5 * i] === CUT && !isKnown(i)) return true;
  }
  return false;
}
