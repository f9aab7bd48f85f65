// The clock of the playback: a tick that runs with a speed and a direction.

/** Speeds of the playback, as multiples of the machine's own time. */
export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100];

/** Clock: its present and its last tick, and the count of ticks in a second. */
export class Clock {
  tick = 0;
  end = 0;
  rate = 1;
  speed = 1;
  direction = 0; // −1 backwards, 0 stopped, 1 forwards
  started = false; // whether the playback is used; if not, all of the path is shown

  /** Makes a clock that calls `wake` when it begins to run and `changed` after each change. */
  constructor(wake, changed) {
    this.wake = wake;
    this.changed = changed;
  }

  /** Sets the last tick and the count of ticks in a second, and keeps the time if it can. */
  load(end, rate, keep) {
    const seconds = this.tick / this.rate;
    this.end = end;
    this.rate = rate;
    this.tick = keep ? Math.min(end, Math.round(seconds * rate)) : 0;
    this.started = keep && this.started && end > 0;
    this.direction = 0;
    this.changed();
  }

  /** Goes to a tick; at the start the playback counts as unused. */
  seek(tick) {
    this.tick = Math.min(this.end, Math.max(0, tick));
    this.started = this.tick > 0;
    this.changed();
  }

  /** Runs forwards (1) or backwards (−1), or stops (0). */
  run(direction) {
    if (this.end === 0) return;
    if (direction > 0 && this.tick >= this.end) this.tick = 0;
    if (direction < 0 && this.tick <= 0) this.tick = this.end;
    this.direction = direction;
    this.started = this.tick > 0 || direction !== 0;
    this.changed();
    if (direction !== 0) this.wake();
  }

  /** Sets the speed, as a multiple of the machine's own time. */
  setSpeed(speed) {
    this.speed = speed;
    this.changed();
  }

  /** Lets a time in seconds go by; tells whether the clock still runs. */
  advance(seconds) {
    if (this.direction === 0) return false;
    const tick = this.tick + seconds * this.rate * this.speed * this.direction;
    this.tick = Math.min(this.end, Math.max(0, tick));
    const over = this.direction > 0 ? this.tick >= this.end : this.tick <= 0;
    if (over) this.direction = 0;
    if (over && this.tick === 0) this.started = false;
    this.changed();
    return !over;
  }
}
