// Choosing a line, a frame or a place of the picture; all views show what is chosen.

import { boxes, nearest } from './geometry.js';
import { COMMANDS, partsOfLine } from './paths.js';
import { kindShown } from './planpath.js';
import { filesOf } from './text.js';
import { mapPlace } from './lines.js';
import { pictureLine } from './loader.js';
import { shownPath } from './plan.js';

/** Selection of nothing. */
export const NOTHING = { file: -1, line: -1, frame: -1, textFile: -1, textLine: -1 };

/** Selection of a line (from 1) of the present text. */
export function ofTextLine(state, file, line) {
  return { ...pictureLine(state.drawing, file, line), frame: -1, textFile: file, textLine: line };
}

/** Selection of a line (from 1) of the text of the picture, with a frame or −1. */
export function ofPictureLine(state, file, line, frame) {
  const [textFile, textLine] = mapPlace(state.drawing.header.files ?? [], filesOf(state.drawing),
    file, line);
  return { file, line, frame, textFile: textLine < 0 ? -1 : textFile, textLine };
}

/** Selection of a frame and of the line that it comes from. */
export function ofFrame(state, frame) {
  const { info } = state.frames;
  const file = info[5 * frame + 2];
  if (file < 0) return { ...NOTHING, frame };
  return ofPictureLine(state, file, info[5 * frame + 3], frame);
}

/** Selection of what is nearest to a place in mm, within a reach in mm, or null. */
export function atPlace(state, x, y, reach) {
  const { drawing, layers } = state;
  if (!drawing) return null;
  const shown = shownPath(state);
  const { contour, contourPlace } = drawing.arrays;
  drawing.contourBox ??= boxes(contour, 7);
  const visible = (path) => (i) => path.info[5 * i] !== COMMANDS
    && kindShown(layers, path.info[5 * i]);
  const move = shown ? nearest(shown.seg, 9, shown.box, x, y, reach, visible(shown)) : null;
  const edge = layers.contours
    ? nearest(contour, 7, drawing.contourBox, x, y, reach) : null;
  if (edge && (!move || edge.distance < move.distance)) {
    return ofPictureLine(state, contourPlace[2 * edge.index], contourPlace[2 * edge.index + 1], -1);
  }
  return move ? ofPart(state, shown, move.index, x, y) : null;
}

/** Selection of a part of a path that was found at a place in mm, with the frame nearest to it. */
export function ofPart(state, path, index, x, y) {
  if (path === state.frames) return ofFrame(state, index);
  const file = path.info[5 * index + 2];
  const line = path.info[5 * index + 3];
  return ofPictureLine(state, file, line, frameNear(state.frames, file, line, x, y));
}

// Frame of a line that is nearest to a place in mm, or −1.
function frameNear(frames, file, line, x, y) {
  if (!frames) return -1;
  const parts = new Set(partsOfLine(frames, file, line));
  if (parts.size === 0) return -1;
  const found = nearest(frames.seg, 9, frames.box, x, y, Infinity,
    (i) => parts.has(i) && frames.info[5 * i] !== COMMANDS);
  return found ? found.index : -1;
}
