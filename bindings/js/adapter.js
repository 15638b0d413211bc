// What do the adapters of engines share? Defaults of their plans, cameras, and boxes that are gathered again and again.
import { GnomonError } from './memory.js';

// Far smaller texels than a grid that never moves, and at their place as long as the view stays in a map.
const DEFAULTS = { fit: 'warped_stable' };
export const withDefaults = (options) => ({ ...DEFAULTS, ...options });

/** Refuses what load() did not return, before a frame does. */
export function loaded(gnomon) {
  if (typeof gnomon?.casterSet !== 'function') throw new GnomonError('gnomon', 'gnomon: gnomon: expected what load() returns');
  return gnomon;
}

/** The camera of an engine's matrices. `far`: shadows end there at the latest. */
export function cameraUpTo(gnomon, matrices, far) {
  const found = gnomon.cameraFrom(matrices);
  found.farDepth = Math.max(Math.min(found.farDepth, far), found.nearDepth * (1 + 1e-6) + 1e-9);
  return found;
}

// Rasterizers take the larger one of a plane's slopes along both axes for its slope. Grids of fit stable are turned about the sun, and a plane
// rises along both of their axes.
const TURNED_SLOPE_TEXELS = 0.45;

/** A plan, with the slope that a rasterizer takes for too little. */
export function planForRasterizer(gnomon, input, turnedSlopeTexels = TURNED_SLOPE_TEXELS) {
  const plan = gnomon.plan(input);
  if (plan.maps.some(({ snapValid, lightWorld }) => snapValid && lightWorld[3] === 0)) plan.biasSlopeTexels += turnedSlopeTexels;
  return plan;
}

/** A set of boxes that is made again when their number changes, and refitted when one of them moved. */
export class FollowedBoxes {
  constructor(gnomon) {
    this.gnomon = gnomon;
    this.boxes = new Float64Array(6 * 64);
    this.count = 0;
    this.set = gnomon.casterSet([]);
    this.begin();
  }
  begin() {
    this.next = 0;
    this.moved = false;
  }
  add(x0, y0, z0, x1, y1, z1) {
    const at = 6 * this.next++;
    if (at === this.boxes.length) {
      const larger = new Float64Array(2 * at);
      larger.set(this.boxes);
      this.boxes = larger;
    }
    const { boxes } = this;
    this.moved ||= boxes[at] !== x0 || boxes[at + 1] !== y0 || boxes[at + 2] !== z0 || boxes[at + 3] !== x1 || boxes[at + 4] !== y1 || boxes[at + 5] !== z1;
    boxes[at] = x0;
    boxes[at + 1] = y0;
    boxes[at + 2] = z0;
    boxes[at + 3] = x1;
    boxes[at + 4] = y1;
    boxes[at + 5] = z1;
  }
  end() {
    const boxes = this.boxes.subarray(0, 6 * this.next);
    if (this.next !== this.count) {
      const set = this.gnomon.casterSet(boxes);
      this.set.dispose();
      this.set = set;
      this.count = this.next;
    } else if (this.moved) {
      this.set.refit(boxes);
    }
  }
  dispose() {
    this.set.dispose();
  }
}

/** Boxes of what casts and of what receives. */
export class FollowedBounds {
  constructor(gnomon) {
    this.all = { casters: new FollowedBoxes(loaded(gnomon)), receivers: new FollowedBoxes(gnomon) };
  }
  get casters() {
    return this.all.casters.set;
  }
  get receivers() {
    return this.all.receivers.set;
  }
  /** `add` is given both, to add all boxes to. */
  gather(add) {
    const { casters, receivers } = this.all;
    casters.begin();
    receivers.begin();
    add(casters, receivers);
    casters.end();
    receivers.end();
  }
  dispose() {
    this.all.casters.dispose();
    this.all.receivers.dispose();
  }
}
