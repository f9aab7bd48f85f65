// Lines of a text before and after a change.

/**
 * Line (from 1) of a new text that was a given line of an old one, or −1 if it lies in the part
 * that changed. The part that changed lies between the lines that both texts begin and end with.
 */
export function mapLine(oldText, newText, line) {
  if (oldText === newText) return line;
  if (known.oldText !== oldText || known.newText !== newText) known = compared(oldText, newText);
  const { head, tail, before, after } = known;
  if (line <= head) return line;
  if (line > before - tail) return line + after - before;
  // A line that was changed in its place is still the same line.
  return before === after ? line : -1;
}

let known = {}; // the last two texts, and how many lines they begin and end with alike

function compared(oldText, newText) {
  const before = oldText.split('\n');
  const after = newText.split('\n');
  const least = Math.min(before.length, after.length);
  let head = 0;
  while (head < least && before[head] === after[head]) head++;
  let tail = 0;
  const same = () => before[before.length - 1 - tail] === after[after.length - 1 - tail];
  while (tail < least - head && same()) tail++;
  return { oldText, newText, head, tail, before: before.length, after: after.length };
}

/** Place [file, line] in other files of a place in files, with −1 for what is not there. */
export function mapPlace(from, to, file, line) {
  if (!from[file]) return [-1, -1];
  const other = to.findIndex((candidate) => candidate.name === from[file].name);
  if (other < 0) return [-1, -1];
  return [other, mapLine(from[file].text, to[other].text, line)];
}

/** Whether two lists of files have the same names and texts. */
export function sameFiles(a, b) {
  return a.length === b.length
    && a.every((file, i) => file.name === b[i].name && file.text === b[i].text);
}
