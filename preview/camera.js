// The camera of the three-dimensional view: parallel projection, z upwards.

/** Directions of the standard views: angle around z, and height above the plane, in radians. */
export const SIDES = {
  top: [0, Math.PI / 2],
  front: [0, 0],
  right: [Math.PI / 2, 0],
  isometric: [Math.PI / 4, Math.atan(Math.SQRT1_2)],
};

/** Camera: its target in mm, its angles in radians, its scale in CSS pixels per mm. */
export class Camera {
  target = [0, 0, 0];
  yaw = SIDES.isometric[0];
  height = SIDES.isometric[1];
  scale = 4;
  width = 1; // CSS pixels
  heightPixels = 1;
  depth = 1000; // mm that are visible before and behind the target

  /** Directions to the right, upwards and towards the viewer, as unit vectors. */
  directions() {
    const [s, c] = [Math.sin(this.yaw), Math.cos(this.yaw)];
    const [up, flat] = [Math.sin(this.height), Math.cos(this.height)];
    return { right: [c, s, 0], up: [-s * up, c * up, flat], back: [s * flat, -c * flat, up] };
  }

  /** Matrix (column by column) from mm to the clip space of WebGL. */
  matrix() {
    const { right, up, back } = this.directions();
    const rows = [
      right.map((v) => (v * this.scale * 2) / this.width),
      up.map((v) => (v * this.scale * 2) / this.heightPixels),
      back.map((v) => -v / this.depth),
    ];
    const out = new Float32Array(16);
    const t = this.target;
    rows.forEach((row, r) => {
      for (let k = 0; k < 3; k++) out[4 * k + r] = row[k];
      out[12 + r] = -(row[0] * t[0] + row[1] * t[1] + row[2] * t[2]);
    });
    out[15] = 1;
    return out;
  }

  /** Writes the place in CSS pixels of a point in mm into out. */
  project(matrix, x, y, z, out) {
    const px = matrix[0] * x + matrix[4] * y + matrix[8] * z + matrix[12];
    const py = matrix[1] * x + matrix[5] * y + matrix[9] * z + matrix[13];
    out[0] = ((px + 1) / 2) * this.width;
    out[1] = ((1 - py) / 2) * this.heightPixels;
    return out;
  }

  /** Turns the view by CSS pixels. */
  orbit(dx, dy) {
    this.yaw -= dx * 0.008;
    this.height = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, this.height + dy * 0.008));
  }

  /** Moves the picture by CSS pixels. */
  pan(dx, dy) {
    const { right, up } = this.directions();
    for (let k = 0; k < 3; k++) this.target[k] += (-dx * right[k] + dy * up[k]) / this.scale;
  }

  /** Zooms by a factor around a place in CSS pixels. */
  zoom(sx, sy, factor) {
    const dx = sx - this.width / 2;
    const dy = sy - this.heightPixels / 2;
    this.pan(-dx, -dy);
    this.scale = Math.min(1e5, Math.max(1e-3, this.scale * factor));
    this.pan(dx, dy);
  }

  /** Shows a box [[x, x], [y, y], [z, z]] in mm as large as possible. */
  fit(box) {
    const { right, up } = this.directions();
    this.target = box.map(([low, high]) => (low + high) / 2);
    const size = box.map(([low, high]) => high - low);
    const across = (d) => size.reduce((sum, length, k) => sum + Math.abs(d[k]) * length, 0);
    this.scale = 0.8 * Math.min(this.width / Math.max(across(right), 1e-3),
      this.heightPixels / Math.max(across(up), 1e-3));
    this.depth = 10 * Math.hypot(...size) + 100;
  }
}
