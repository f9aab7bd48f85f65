// The list of the frames of the tape.

import { createList, span } from './vlist.js';
import { KIND_NAMES, RAPID, partsOfLine } from './paths.js';
import { feedNumber, time } from './format.js';

/** Makes the list of frames. `choose(index, far)` is called for a click; far means go there. */
export function createFrames(element, store, choose) {
  let present = -1;
  const list = createList(element, 'Frames of the tape', (row, i) => fill(store, row, i, present),
    choose);
  list.chosen = (i) => store.state.selection.frame === i;
  store.on(['frames'], (s) => list.setCount(s.frames?.count ?? 0));
  store.later(['selection'], (s) => {
    const { file, line, frame } = s.selection;
    const shown = frame >= 0 || !s.frames || file < 0 ? frame
      : partsOfLine(s.frames, file, line)[0] ?? -1;
    if (shown >= 0) {
      list.active = shown;
      list.reveal(shown);
    }
    list.refresh();
  });
  return {
    list,

    /** Marks the frame that the playback has reached. */
    play(index, follow) {
      if (index === present) return;
      present = index;
      if (element.clientHeight === 0) return;
      if (follow && index >= 0) list.reveal(index);
      list.refresh();
    },

    /** Scrolls to the frame that the playback has reached. */
    catchUp() {
      if (present >= 0) list.reveal(present);
    },
  };
}

function fill(store, row, i, present) {
  const { run, frames, drawing } = store.state;
  const kind = frames.info[5 * i];
  row.classList.add('frame-row');
  const { selection } = store.state;
  if (selection.file >= 0 && frames.info[5 * i + 2] === selection.file
    && frames.info[5 * i + 3] === selection.line) row.classList.add('related');
  if (selection.frame === i) row.classList.add('chosen');
  else if (i === present) row.classList.add('present');
  const line = frames.info[5 * i + 2] >= 0 ? String(frames.info[5 * i + 3]) : '';
  row.append(span(String(i + 1)), span(KIND_NAMES[kind] ?? '?'), span(line),
    span(kind === RAPID && !run.header.pulsed ? 'rapid'
      : feedNumber(frames.feed[2 * i], drawing.header.unit)),
    span(time(run.arrays.frameTick[3 * i] / run.header.clock)));
}
