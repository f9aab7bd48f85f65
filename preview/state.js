// One store for the whole page. Views subscribe to the members that they show.

/**
 * Makes a store. Subscribers run once per change, after all members of the change are set.
 * @template {object} S
 * @param {S} initial
 */
export function createStore(initial) {
  const state = { ...initial };
  const subscribers = [];
  return {
    state,

    /** Sets members, and calls the subscribers of those that differ from before. */
    set(change) {
      const changed = Object.keys(change).filter((key) => state[key] !== change[key]);
      if (changed.length === 0) return;
      Object.assign(state, change);
      for (const { keys, call } of subscribers) {
        if (changed.some((key) => keys.includes(key))) call(state);
      }
    },

    /** Calls a function now and whenever one of the members changes. */
    on(keys, call) {
      subscribers.push({ keys, call });
      call(state);
    },

    /** Calls a function whenever one of the members changes, but not now. */
    later(keys, call) {
      subscribers.push({ keys, call });
    },
  };
}

/** Names of the layers of the picture, with their titles and whether they are shown at first. */
export const LAYERS = [
  ['contours', 'Contours', true],
  ['material', 'Material side', true],
  ['swept', 'Swept area', true],
  ['cuts', 'Cuts', true],
  ['links', 'Linking moves', true],
  ['rapids', 'Rapid moves', true],
  ['nodes', 'Nodes', false],
  ['holes', 'Holes', true],
  ['rest', 'Rest material', true],
  ['points', 'Points with names', true],
  ['frames', 'Ends of frames', false],
  ['grid', 'Grid and axes', true],
];

/** State of the page before anything is fetched. */
export function initialState() {
  return {
    drawing: null, // the decoded container, or null
    moves: null, // path of the program's moves, see paths.js
    run: null, // the decoded container of the present machine
    frames: null, // path of its frames
    pulses: null, // pulses, samples and jobs of the same run
    runState: 'none', // none, loading, ready, failed
    runFault: '',
    machine: null,
    compare: '', // '', 'before' or 'machine:NAME'
    other: null, // what is compared, see compare.js
    before: null, // drawing before the last change
    selection: { file: -1, line: -1, frame: -1 },
    cursor: null, // place of the editor's cursor
    view: 'plan', // plan or space
    mode: 'look', // look or measure
    colour: 'kind', // kind, depth, tool or feed
    source: 'move', // move or frame: whose path the picture shows
    follow: true, // lists follow the playback
    connection: 'opening', // opening, open, lost
    layers: Object.fromEntries(LAYERS.map(([name, , on]) => [name, on])),
    scheme: 0, // counts changes between light and dark
  };
}
