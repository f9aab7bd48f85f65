// The legend of the colours, the scale bar, and the texts beside the picture.

import { colours, painter } from './theme.js';
import { gridStep } from './planbase.js';
import { length, time, unitName } from './format.js';
import { shownPath } from './plan.js';

/** Shows the legend of the present colours. */
export function drawLegend(element, state) {
  const path = shownPath(state);
  element.hidden = !path || path.count === 0;
  if (element.hidden) return;
  const { title, scale, legend } = painter(path, state.colour, state.drawing.header);
  const rows = legend.map(([colour, dashed, text]) => row(colour, dashed ? '5 3' : '', text));
  if (scale) rows.unshift(scaleRow(scale));
  if (title) {
    const head = document.createElement('div');
    head.className = 'head';
    head.textContent = title;
    rows.unshift(head);
  }
  const c = colours();
  if (state.other?.kind === 'before') {
    rows.push(row(c.gone, '7 4', '\u2212 gone'), row(c.new, '', '+ new'));
  }
  if (state.other?.kind === 'machine') rows.push(row(c.other, '1 3', state.other.title));
  element.replaceChildren(...rows);
}

// A scale between the texts of its ends.
function scaleRow({ colours: stops, from, to }) {
  const out = document.createElement('div');
  const band = document.createElement('span');
  out.className = 'range';
  band.className = 'band';
  band.style.background = `linear-gradient(to right, ${stops.join(', ')})`;
  out.append(from, band, to);
  return out;
}

function row(colour, dashes, text) {
  const out = document.createElement('div');
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  const path = document.createElementNS('http://www.w3.org/2000/svg', 'path');
  path.setAttribute('d', 'M0 5H26');
  path.setAttribute('stroke', colour);
  path.setAttribute('stroke-width', '3');
  if (dashes) path.setAttribute('stroke-dasharray', dashes);
  svg.setAttribute('aria-hidden', 'true');
  svg.append(path);
  out.append(svg, text);
  return out;
}

/** Shows the scale bar of a viewport. */
export function drawScale(bar, text, viewport, unit) {
  const step = gridStep(viewport.scale, unit, 80);
  bar.style.width = `${Math.round(step * viewport.scale)}px`;
  const digits = length(step, unit).replace(/\.?0+$/, '');
  text.textContent = `${digits} ${unitName(unit)}`;
}

/** Text of a comparison, as a list of texts with the names of their classes. */
export function compareTexts(state) {
  const { other, before, frames, run, drawing } = state;
  if (!other) return [];
  if (other.kind === 'none') {
    const why = before ? other.fault ?? '' : 'There was no change yet.';
    return [[why, '']];
  }
  if (other.kind === 'before') {
    const { gone, fresh, contourGone, contourFresh } = other.counts;
    return [['Since the text before: ', ''],
      [`\u2212${gone}`, 'gone'], [' and ', ''], [`+${fresh}`, 'new'], [' moves, ', ''],
      [`\u2212${contourGone}`, 'gone'], [' and ', ''], [`+${contourFresh}`, 'new'],
      [' parts of contours', '']];
  }
  const { unit } = drawing.header;
  const apart = other.apart
    ? `${length(other.apart.distance, unit)} ${unitName(unit)} at `
      + `(${length(other.apart.x, unit)}, ${length(other.apart.y, unit)})`
    : 'not found, there are too many frames';
  if (other.fault) return [[`${other.title}: ${other.fault}`, '']];
  const own = run ? `${frames.count} frames in ${time(endOf(run))}; ` : '';
  return [[`${own}${other.title}: ${other.frames} frames in ${time(other.seconds)}. `
    + `Largest distance of the cuts in plan: ${apart}`, '']];
}

function endOf(run) {
  const { frameTick } = run.arrays;
  return frameTick.length > 0 ? frameTick[frameTick.length - 2] / run.header.clock : 0;
}
