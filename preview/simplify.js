// Tracing of many short lines with fewer points, as far as nobody can see the difference.

const TURN = 2 * Math.PI;

/**
 * Pen for a path or a context. It leaves out points that lie within a tolerance in mm of the lines
 * that it draws instead (an eighth more where the lines turn back).
 */
export class Pen {
  #ax = 0; // last point that is drawn
  #ay = 0;
  #x = 0; // last point that is known
  #y = 0;
  #waiting = false; // whether the known point is still to be drawn
  #far = 0; // largest distance of a left-out point from the drawn one
  #base = NaN; // direction from which the two limits count
  #low = 0; // limits of the directions that pass all points left out
  #high = 0;

  /** Makes a pen with a tolerance in mm; with the tolerance 0 it draws everything. */
  constructor(target, tolerance) {
    this.target = target;
    this.tolerance = tolerance;
  }

  /** Begins at a point in mm. */
  move(x, y) {
    this.flush();
    this.target.moveTo(x, y);
    this.#restart(x, y);
  }

  /** Draws a line to a point in mm. */
  line(x, y) {
    if (this.#waiting && !this.#fits(x, y)) this.flush();
    const d = Math.hypot(x - this.#ax, y - this.#ay);
    if (d > this.tolerance) this.#narrow(x, y, d);
    this.#x = x;
    this.#y = y;
    this.#far = Math.max(this.#far, d);
    this.#waiting = true;
  }

  /** Draws an arc that ends at a point; lengths in mm, angles in radians. */
  arc(cx, cy, radius, begin, phi, x, y) {
    if (Math.abs(phi) < 1 && radius * (1 - Math.cos(phi / 2)) < this.tolerance / 2) {
      this.line(x, y);
      return;
    }
    this.flush();
    this.target.arc(cx, cy, radius, begin, begin + phi, phi < 0);
    this.#restart(x, y);
  }

  /** Draws what is still to be drawn. */
  flush() {
    if (this.#waiting) this.target.lineTo(this.#x, this.#y);
    this.#restart(this.#x, this.#y);
  }

  #restart(x, y) {
    this.#ax = x;
    this.#ay = y;
    this.#x = x;
    this.#y = y;
    this.#waiting = false;
    this.#far = 0;
    this.#base = NaN;
  }

  // Whether the line to a point passes all points left out, and does not turn back.
  #fits(x, y) {
    const d = Math.hypot(x - this.#ax, y - this.#ay);
    if (this.tolerance === 0 || d < this.#far - this.tolerance / 2) return false;
    if (Number.isNaN(this.#base) || d <= this.tolerance) return true;
    const angle = this.#turned(x, y);
    return angle >= this.#low && angle <= this.#high;
  }

  #turned(x, y) {
    const angle = Math.atan2(y - this.#ay, x - this.#ax) - this.#base;
    return angle - TURN * Math.round(angle / TURN);
  }

  #narrow(x, y, d) {
    const half = Math.asin(this.tolerance / d);
    if (Number.isNaN(this.#base)) {
      this.#base = Math.atan2(y - this.#ay, x - this.#ax);
      this.#low = -half;
      this.#high = half;
      return;
    }
    const angle = this.#turned(x, y);
    this.#low = Math.max(this.#low, angle - half);
    this.#high = Math.min(this.#high, angle + half);
  }
}
