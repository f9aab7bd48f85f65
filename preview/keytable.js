// The table of the keys of the page.

/** Keys that the lists and the picture handle themselves. */
export const MORE_KEYS = [
  ['Picture', ['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown'],
    'move the plan, or turn the 3D view (with Shift: move it), when the picture has the focus'],
  ['Picture', ['Enter'],
    'while measuring: take the point under the cross; arrow keys move it, with Shift slowly'],
  ['Lists', ['ArrowUp', 'ArrowDown'], 'move the active row'],
  ['Lists', ['Space'], 'choose the active row'],
  ['Lists', ['Enter'], 'choose the active row; in the list of frames, go there'],
];

/** Table of keys: group, keys, title and action of each. */
export function keyTable(page) {
  const { player, clock, activeView, chooseView, space, store } = page;
  const side = (name) => () => {
    chooseView('space');
    space.side(name);
  };
  return [
    ['Playback', [' ', 'k'], 'play or pause', () => player.toggle()],
    ['Playback', ['j'], 'play backwards', () => player.backwards()],
    ['Playback', ['.'], 'one frame on', () => player.frameOn()],
    ['Playback', [','], 'one frame back', () => player.frameBack()],
    ['Playback', [']'], 'one pulse on', () => player.pulseOn()],
    ['Playback', ['['], 'one pulse back', () => player.pulseBack()],
    ['Playback', ['>'], 'faster', () => player.faster(1)],
    ['Playback', ['<'], 'slower', () => player.faster(-1)],
    ['Playback', ['Home'], 'go to the start', () => player.seek(0)],
    ['Playback', ['End'], 'go to the end', () => player.seek(clock.end)],
    ['Playback', ['g'], 'go to the chosen frame', () => page.goToFrame()],
    ['Picture', ['+', '='], 'zoom in', () => activeView().zoomBy(1.3)],
    ['Picture', ['-'], 'zoom out', () => activeView().zoomBy(1 / 1.3)],
    ['Picture', ['f', '0'], 'show everything', () => activeView().fit()],
    ['Picture', ['v'], 'change between plan and 3D',
      () => chooseView(store.state.view === 'plan' ? 'space' : 'plan')],
    ['Picture', ['1'], '3D from the top', side('top')],
    ['Picture', ['2'], '3D from the front', side('front')],
    ['Picture', ['3'], '3D from the right', side('right')],
    ['Picture', ['4'], '3D, isometric', side('isometric')],
    ['Picture', ['l'], 'layers', () => page.toggleLayers()],
    ['Picture', ['m'], 'measure', () => page.setMeasuring(store.state.mode !== 'measure')],
    ['Picture', ['Escape'], 'end measuring, close the layers, choose nothing', () => page.escape()],
    ['Page', ['?'], 'this list', () => page.help()],
  ];
}
