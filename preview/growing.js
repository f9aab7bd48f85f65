// A canvas on which the playback paints what it has done, a little more for each picture. For the
// way back it keeps copies of earlier states.

const MOST_COPIES = 8;
const SMALL = 64; // frames that are painted without keeping a copy
const MOST_AT_ONCE = 3000; // frames that are painted for one picture

/** Growing canvas; it counts in frames and in fractions (0 to 1) of a frame. */
export class Growing {
  #done = 0; // frames that are painted
  #part = 0; // fraction of the next frame that is painted too
  #latest = 0; // tick of the last picture
  #rewound = false; // whether it is being painted again after a step back
  #copies = []; // [{done, canvas}], in order
  #spare = [];

  /**
   * Makes a growing canvas. `paint(context, a, b)` paints the frames from a up to b without b, and
   * `paintPart(context, frame, part)` the fraction `part` of one frame.
   */
  constructor(canvas, paint, paintPart) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
    this.paint = paint;
    this.paintPart = paintPart;
  }

  /** Forgets everything, as after a change of the view or of the frames. */
  reset() {
    while (this.#copies.length > 0) this.#spare.push(this.#copies.pop().canvas);
    this.#latest = 0;
    this.#back(0);
  }

  /**
   * Paints up to the fraction `now` of a frame, which is reached at a tick. Returns false if there
   * is so much to paint that the next picture has to go on.
   */
  advance(frame, now, tick) {
    const less = frame < this.#done || (frame === this.#done && this.#part > 0);
    if (tick < this.#latest && less) {
      this.#back(frame);
      this.#rewound = true;
    }
    this.#latest = tick;
    this.#forward(frame);
    if (this.#done < frame) return false;
    this.#rewound = false;
    if (now > this.#part) {
      this.paintPart(this.context, frame, now);
      this.#part = now;
    }
    return true;
  }

  #forward(frame) {
    for (let budget = MOST_AT_ONCE; this.#done < frame && budget > 0;) {
      // Copies at a half, three quarters, … of the way make the next steps back cheap.
      const copied = this.#rewound && frame - this.#done > SMALL
        && this.#copies.length < MOST_COPIES;
      const goal = copied ? (this.#done + frame) >> 1 : frame;
      const to = Math.min(goal, this.#done + budget);
      this.paint(this.context, this.#done, to);
      budget -= to - this.#done;
      this.#done = to;
      this.#part = 0;
      if (copied && to === goal) this.#keep();
    }
  }

  #keep() {
    const copy = this.#spare.pop() ?? document.createElement('canvas');
    copy.width = this.canvas.width;
    copy.height = this.canvas.height;
    copy.getContext('2d').drawImage(this.canvas, 0, 0);
    this.#copies.push({ done: this.#done, canvas: copy });
  }

  #back(frame) {
    const copies = this.#copies;
    while (copies.length > 0 && copies[copies.length - 1].done > frame) {
      this.#spare.push(copies.pop().canvas);
    }
    this.context.setTransform(1, 0, 0, 1, 0, 0);
    this.context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    const copy = copies[copies.length - 1];
    if (copy) this.context.drawImage(copy.canvas, 0, 0);
    this.#done = copy ? copy.done : 0;
    this.#part = 0;
  }
}
