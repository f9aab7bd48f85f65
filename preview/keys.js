// The keys of the page, and the dialog that lists them.

/**
 * Attaches keys. Each entry of the table is `[group, keys, title, action]`, with keys as in
 * `KeyboardEvent.key`.
 */
export function attachKeys(table) {
  const actions = new Map();
  for (const [, keys, , action] of table) for (const key of keys) actions.set(key, action);
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    if (document.querySelector('dialog[open]')) return;
    const { target } = event;
    if (target.closest('select, textarea, input:not([type=checkbox]):not([type=range])')) return;
    const range = target.closest('input[type=range]');
    if (range && /^(Arrow|Home|End|Page)/.test(event.key)) return;
    if (event.key === ' ' && target.closest('button, summary, input[type=checkbox]')) return;
    if ((event.key === 'Home' || event.key === 'End') && target.closest('[role=tablist]')) return;
    const action = actions.get(event.key);
    if (!action) return;
    event.preventDefault();
    action(event);
  });
}

const SHOWN = { ' ': 'Space', ArrowLeft: '←', ArrowRight: '→', ArrowUp: '↑', ArrowDown: '↓' };

/** Fills the dialog with the table of keys and some that belong to lists and pictures. */
export function fillHelp(element, table, more) {
  const groups = new Map();
  for (const [group, keys, title] of [...table, ...more]) {
    if (!groups.has(group)) groups.set(group, []);
    groups.get(group).push([keys, title]);
  }
  element.replaceChildren();
  for (const [group, entries] of groups) {
    const head = document.createElement('h3');
    head.textContent = group;
    const list = document.createElement('dl');
    for (const [keys, title] of entries) {
      const dt = document.createElement('dt');
      const dd = document.createElement('dd');
      keys.forEach((key, k) => {
        const kbd = document.createElement('kbd');
        kbd.textContent = SHOWN[key] ?? key;
        if (k > 0) dt.append(' ');
        dt.append(kbd);
      });
      dd.textContent = title;
      list.append(dt, dd);
    }
    element.append(head, list);
  }
}

/**
 * Makes the buttons of a tab list choose panels, with arrow keys as usual. Returns the function
 * that chooses a tab by its id. Hidden tabs cannot be chosen.
 */
export function attachTabs(list, chosen) {
  const tabs = [...list.querySelectorAll('[role=tab]')];
  const choose = (tab, focus) => {
    for (const other of tabs) {
      const on = other === tab;
      other.setAttribute('aria-selected', on ? 'true' : 'false');
      other.tabIndex = on ? 0 : -1;
      document.getElementById(other.getAttribute('aria-controls')).hidden = !on;
    }
    if (focus) tab.focus();
    chosen(tab.id);
  };
  for (const tab of tabs) tab.addEventListener('click', () => choose(tab, false));
  list.addEventListener('keydown', (event) => {
    const shown = tabs.filter((tab) => !tab.hidden);
    const at = shown.indexOf(document.activeElement);
    const steps = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: shown.length - 1 };
    if (at < 0 || !(event.key in steps)) return;
    event.preventDefault();
    choose(shown[(steps[event.key] + shown.length) % shown.length], true);
  });
  return (id) => {
    const tab = tabs.find((candidate) => candidate.id === id && !candidate.hidden);
    if (tab) choose(tab, false);
  };
}
