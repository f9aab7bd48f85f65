// Texts of quantities in the unit of the program.

const INCH = 25.4;

/** Text of a length in mm, in the unit `mm` or `inch`, without the unit's name. */
export function length(mm, unit) {
  if (!Number.isFinite(mm)) return '–';
  const text = unit === 'inch' ? (mm / INCH).toFixed(4) : mm.toFixed(3);
  return Number(text) === 0 ? text.replace('-', '') : text.replace('-', '\u2212');
}

/** Name of a unit after a number. */
export function unitName(unit) {
  return unit === 'inch' ? 'in' : 'mm';
}

/** Text of a feed in mm/min, in the unit of the program, without the unit's name. */
export function feedNumber(value, unit) {
  if (!value) return '–';
  return unit === 'inch' ? (value / INCH).toFixed(2) : short(value);
}

/** Text of a feed in mm/min, in the unit of the program, with the unit's name. */
export function feed(value, unit) {
  return value ? `${feedNumber(value, unit)} ${unitName(unit)}/min` : '–';
}

/** Text of a number with at most two decimals. */
export function short(value) {
  return String(Math.round(value * 100) / 100).replace('-', '\u2212');
}

/** Text of a time in seconds, as hours (if any), minutes, seconds and thousandths. */
export function time(seconds) {
  const thousandths = Math.round(seconds * 1000);
  const minutes = Math.floor(thousandths / 60000);
  const rest = ((thousandths - 60000 * minutes) / 1000).toFixed(3).padStart(6, '0');
  if (minutes < 60) return `${minutes}:${rest}`;
  return `${Math.floor(minutes / 60)}:${String(minutes % 60).padStart(2, '0')}:${rest}`;
}

/** Text of a frequency in Hz, with its sign. */
export function hertz(value) {
  return value === null ? '–' : `${short(value)} Hz`;
}

/** Number of mm in the unit of the program. */
export function unitSize(unit) {
  return unit === 'inch' ? INCH : 1;
}
