// A strip chart of the dispatcher's jobs around the present tick.

import { above } from './position.js';
import { colours } from './theme.js';
import { short } from './format.js';

const HIGH = 16; // CSS pixels of a job's row

/** Makes the strip chart of jobs in a figure. */
export function createJobs(figure, canvas, caption, store, clock) {
  const view = { order: null, longest: 0, span: 1, of: null };
  view.draw = () => {
    const { run, pulses } = store.state;
    const names = run?.header.jobs ?? [];
    const job = pulses?.arrays.job;
    figure.hidden = names.length === 0 || !job || job.length === 0;
    if (figure.hidden) return;
    if (view.of !== pulses) prepare(view, job, clock.rate, pulses, canvas, names);
    caption.textContent = `(${short((view.span / clock.rate) * 1000)} ms; now in the middle)`;
    drawJobs(canvas, view, job, names, clock);
  };
  return view;
}

// Orders the jobs by their beginnings, and chooses how many ticks the chart shows.
function prepare(view, job, rate, pulses, canvas, names) {
  const count = job.length / 4;
  const begins = new Float64Array(count);
  let sum = 0;
  let ordered = true;
  view.longest = 0;
  for (let i = 0; i < count; i++) {
    begins[i] = job[4 * i + 2];
    const whole = job[4 * i + 3] - job[4 * i + 1];
    view.longest = Math.max(view.longest, whole);
    sum += whole;
    if (i > 0 && begins[i] < begins[i - 1]) ordered = false;
  }
  view.order = Uint32Array.from({ length: count }, (_, i) => i);
  if (!ordered) view.order.sort((p, q) => begins[p] - begins[q]);
  view.begins = ordered ? begins : Float64Array.from(view.order, (i) => begins[i]);
  const want = Math.min(2 * rate, Math.max(0.002 * rate, (40 * sum) / Math.max(1, count)));
  const power = 10 ** Math.floor(Math.log10(want));
  view.span = [1, 2, 5, 10].find((k) => k * power >= want) * power;
  view.of = pulses;
  canvas.style.height = `${names.length * HIGH + 2}px`;
}

function drawJobs(canvas, view, job, names, clock) {
  const ratio = window.devicePixelRatio || 1;
  const width = canvas.clientWidth;
  const height = names.length * HIGH + 2;
  if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
  if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
  const context = canvas.getContext('2d');
  const c = colours();
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  const from = clock.tick - view.span / 2;
  const left = 96;
  const scale = (width - left) / view.span;
  context.font = '12px system-ui, sans-serif';
  names.forEach((name, k) => {
    context.fillStyle = c.face;
    context.fillRect(left, k * HIGH + 1, width - left, HIGH - 3);
    context.fillStyle = c.soft;
    context.fillText(name, 0, k * HIGH + 12, left - 6);
  });
  const { order, begins } = view;
  let i = above(begins, from - view.longest, 0, begins.length);
  for (let drawn = 0; i < begins.length && begins[i] < from + view.span && drawn < 4000; i++) {
    const o = 4 * order[i];
    const y = job[o] * HIGH + 1;
    const x = (tick) => Math.max(left, left + (tick - from) * scale);
    const [request, begin, end] = [x(job[o + 1]), x(job[o + 2]), x(job[o + 3])];
    context.fillStyle = c.soft;
    context.fillRect(request, y + (HIGH - 3) / 2 - 0.5, Math.max(0, begin - request), 1);
    context.fillStyle = c.cut;
    if (end > left) context.fillRect(begin, y + 1, Math.max(1, end - begin), HIGH - 5);
    drawn += 1;
  }
  context.fillStyle = c.mark;
  context.fillRect(left + (width - left) / 2, 0, 1.5, height);
}
