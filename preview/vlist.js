// A list of which only the visible rows exist. It is a listbox for the keyboard and for screen
// readers: arrow keys move the active row, Enter and space choose it.

const ROW = 20; // height of a row in CSS pixels
const MOST = 800000; // rows of a list; more would be higher than browsers allow

/**
 * Makes a list in an element. `fill(row, index)` fills a new row element. `choose(index, far)` is
 * called for a click or a key; `far` is true for a double click or Enter.
 */
export function createList(element, label, fill, choose) {
  element.classList.add('vlist');
  Object.assign(element, { tabIndex: 0 });
  element.setAttribute('role', 'listbox');
  element.setAttribute('aria-label', label);
  const spacer = document.createElement('div');
  spacer.className = 'spacer';
  spacer.setAttribute('role', 'presentation');
  const view = document.createElement('div');
  view.className = 'window';
  view.setAttribute('role', 'presentation');
  spacer.append(view);
  element.append(spacer);
  const list = { element, view, spacer, fill, count: 0, active: 0, from: -1, to: -1,
    chosen: () => false };

  /** Sets the count of rows and draws them. */
  list.setCount = (count) => {
    list.count = Math.min(count, MOST);
    list.active = Math.min(list.active, Math.max(0, list.count - 1));
    spacer.style.height = `${list.count * ROW}px`;
    list.refresh();
  };
  /** Draws the visible rows again. */
  list.refresh = () => {
    list.from = -1;
    render(list);
  };
  /** Scrolls so that a row is visible. */
  list.reveal = (index) => reveal(list, index);
  element.addEventListener('scroll', () => render(list), { passive: true });
  element.addEventListener('click', (event) => {
    const index = rowOf(event);
    if (index >= 0) activate(list, index, choose, event.detail > 1);
  });
  element.addEventListener('keydown', (event) => keyDown(list, event, choose));
  new ResizeObserver(() => list.refresh()).observe(element);
  return list;
}

function rowOf(event) {
  const row = event.target.closest('.vrow');
  return row ? Number(row.dataset.index) : -1;
}

function activate(list, index, choose, far) {
  list.active = index;
  choose(index, far);
  list.refresh();
}

function keyDown(list, event, choose) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const page = Math.max(1, Math.floor(list.element.clientHeight / ROW) - 1);
  const steps = { ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page,
    Home: -list.count, End: list.count };
  if (event.key in steps) {
    list.active = Math.max(0, Math.min(list.count - 1, list.active + steps[event.key]));
    list.reveal(list.active);
    list.refresh();
  } else if (event.key === 'Enter' || event.key === ' ') {
    if (list.count > 0) activate(list, list.active, choose, event.key === 'Enter');
  } else return;
  event.preventDefault();
  event.stopPropagation();
}

function reveal(list, index) {
  const { element } = list;
  const top = index * ROW;
  if (element.clientHeight === 0) return;
  if (top < element.scrollTop + ROW || top + 2 * ROW > element.scrollTop + element.clientHeight) {
    element.scrollTop = Math.max(0, top - element.clientHeight / 2 + ROW);
  }
  render(list);
}

function render(list) {
  const { element, view } = list;
  const from = Math.max(0, Math.floor(element.scrollTop / ROW) - 8);
  const shown = Math.ceil(element.clientHeight / ROW) + 16;
  const to = Math.min(list.count, from + shown);
  if (from === list.from && to === list.to) return;
  list.from = from;
  list.to = to;
  const rows = document.createDocumentFragment();
  for (let i = from; i < to; i++) {
    const row = document.createElement('div');
    row.className = 'vrow';
    row.id = `${element.id}-${i}`;
    row.dataset.index = i;
    row.setAttribute('role', 'option');
    row.setAttribute('aria-setsize', list.count);
    row.setAttribute('aria-posinset', i + 1);
    row.setAttribute('aria-selected', list.chosen(i) ? 'true' : 'false');
    if (i === list.active) row.classList.add('current');
    list.fill(row, i);
    rows.append(row);
  }
  view.replaceChildren(rows);
  view.style.transform = `translateY(${from * ROW}px)`;
  if (list.active >= from && list.active < to) {
    element.setAttribute('aria-activedescendant', `${element.id}-${list.active}`);
  } else element.removeAttribute('aria-activedescendant');
}

/** Makes a span with a text, and a class if one is given. */
export function span(text, name = '') {
  const out = document.createElement('span');
  if (name) out.className = name;
  out.textContent = text;
  return out;
}
