// The window of the plan view.

/** Viewport: its middle in mm, its scale in CSS pixels per mm, and its size in CSS pixels. */
export class Viewport {
  x = 0;
  y = 0;
  scale = 4;
  width = 1;
  height = 1;
  ratio = 1; // device pixels per CSS pixel

  /** Screen x in CSS pixels of an x in mm. */
  sx(x) {
    return this.width / 2 + (x - this.x) * this.scale;
  }

  /** Screen y in CSS pixels of a y in mm. */
  sy(y) {
    return this.height / 2 - (y - this.y) * this.scale;
  }

  /** Coordinate x in mm of a screen x in CSS pixels. */
  wx(sx) {
    return this.x + (sx - this.width / 2) / this.scale;
  }

  /** Coordinate y in mm of a screen y in CSS pixels. */
  wy(sy) {
    return this.y - (sy - this.height / 2) / this.scale;
  }

  /** Moves the picture by CSS pixels. */
  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
  }

  /** Zooms by a factor around a place in CSS pixels. */
  zoom(sx, sy, factor) {
    const x = this.wx(sx);
    const y = this.wy(sy);
    this.scale = Math.min(1e5, Math.max(1e-3, this.scale * factor));
    this.x = x - (sx - this.width / 2) / this.scale;
    this.y = y + (sy - this.height / 2) / this.scale;
  }

  /** Shows a box x0 y0 x1 y1 in mm as large as possible, below a head in CSS pixels. */
  fit(box, head = 0) {
    const margin = Math.min(36, 0.08 * Math.min(this.width, this.height));
    const wide = Math.max(box[2] - box[0], 1e-3);
    const high = Math.max(box[3] - box[1], 1e-3);
    this.scale = Math.min((this.width - 2 * margin) / wide,
      (this.height - head - 2 * margin) / high);
    this.x = (box[0] + box[2]) / 2;
    this.y = (box[1] + box[3]) / 2 + head / 2 / this.scale;
  }

  /** Box x0 y0 x1 y1 in mm of what is visible. */
  window() {
    return [this.wx(0), this.wy(this.height), this.wx(this.width), this.wy(0)];
  }

  /** Sets the transformation of a context so that it draws in mm. */
  toMm(context) {
    const s = this.scale * this.ratio;
    context.setTransform(s, 0, 0, -s, (this.width / 2 - this.x * this.scale) * this.ratio,
      (this.height / 2 + this.y * this.scale) * this.ratio);
  }

  /** Sets the transformation of a context so that it draws in CSS pixels. */
  toPixels(context) {
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
  }

  /** Copy of the place and the scale. */
  copy() {
    return { x: this.x, y: this.y, scale: this.scale };
  }
}
