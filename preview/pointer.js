// Gestures on a picture: drag, pinch, wheel, tap and hover. All places are in CSS pixels from the
// upper left corner of the element.

/**
 * Attaches gestures to an element. `on` has drag(dx, dy, second), zoom(x, y, factor), tap(x, y),
 * hover(x, y) and leave(). `second` is true for the right or middle button and for two fingers.
 */
export function attachGestures(element, on) {
  const state = { element, on, fingers: new Map(), travelled: 0, second: false };
  element.addEventListener('contextmenu', (event) => event.preventDefault());
  element.addEventListener('pointerdown', (event) => down(state, event));
  element.addEventListener('pointermove', (event) => move(state, event));
  element.addEventListener('pointerup', (event) => end(state, event));
  element.addEventListener('pointercancel', (event) => end(state, event));
  element.addEventListener('pointerleave', () => {
    if (state.fingers.size === 0) on.leave();
  });
  element.addEventListener('wheel', (event) => {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 20 : 1;
    const amount = Math.max(-120, Math.min(120, event.deltaY * lines));
    on.zoom(...place(state, event), Math.exp(-amount * (event.ctrlKey ? 0.01 : 0.0025)));
  }, { passive: false });
}

function place({ element }, event) {
  const box = element.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}

function down(state, event) {
  if (state.fingers.size === 0) state.travelled = 0;
  state.second = event.button > 0 || event.shiftKey;
  state.fingers.set(event.pointerId, place(state, event));
  state.element.setPointerCapture(event.pointerId);
}

function move(state, event) {
  const { fingers, on } = state;
  const now = place(state, event);
  const before = fingers.get(event.pointerId);
  if (!before) {
    on.hover(...now);
    return;
  }
  const dx = now[0] - before[0];
  const dy = now[1] - before[1];
  state.travelled += Math.abs(dx) + Math.abs(dy);
  if (fingers.size === 1) {
    if (state.travelled > 4) on.drag(dx, dy, state.second);
    if (event.pointerType === 'mouse') on.hover(...now);
  } else if (fingers.size === 2) {
    pinch(fingers, event.pointerId, now, on);
  }
  fingers.set(event.pointerId, now);
}

function end(state, event) {
  const known = state.fingers.delete(event.pointerId);
  if (!known || event.type !== 'pointerup' || state.fingers.size > 0) return;
  if (state.travelled <= 4 && !state.second) state.on.tap(...place(state, event));
}

function pinch(fingers, moved, now, on) {
  const before = fingers.get(moved);
  let other = null;
  for (const [id, at] of fingers) if (id !== moved) other = at;
  const wide = Math.hypot(before[0] - other[0], before[1] - other[1]);
  const wider = Math.hypot(now[0] - other[0], now[1] - other[1]);
  on.drag((now[0] - before[0]) / 2, (now[1] - before[1]) / 2, true);
  if (wide > 1 && wider > 1) {
    on.zoom((now[0] + other[0]) / 2, (now[1] + other[1]) / 2, wider / wide);
  }
}
