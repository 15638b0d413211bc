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

// Its slope is the golden ratio: no whole numbers of texels across and along lie near it.
const TURN = Math.atan((Math.sqrt(5) - 1) / 2);
// Rasterizers take the larger one of a plane's slopes along both axes for its slope. Turned as above, a plane rises by more.
const TURNED_SLOPE_TEXELS = 0.45;

/**
 * Turns the grids of a sun's maps of fit stable about the sun, in place. gnomon lays them along an axis of the world: upright edges then lie
 * along texel columns, and a whole edge falls to one side of its texels. A map's side is the longest chord of its slice, whichever way it lies.
 */
export function turnGrids(gnomon, plan, camera) {
  const { position, forward, up, orthographic } = camera;
  // Of left-handed worlds as well: gnomon counts left and right of a camera so.
  const right = [0, 1, 2].map((i) => forward[(i + 1) % 3] * up[(i + 2) % 3] - forward[(i + 2) % 3] * up[(i + 1) % 3]);
  const grids = plan.maps.filter(({ snapValid, lightWorld }) => snapValid && lightWorld[3] === 0);
  if (grids.length > 0) plan.biasSlopeTexels += TURNED_SLOPE_TEXELS;
  for (const map of grids) {
    const m = map.clipFromWorld;
    const [x, y] = [0, 1].map((row) => [m[row], m[4 + row], m[8 + row]]);
    const axes = [x.map((value, i) => Math.cos(TURN) * value + Math.sin(TURN) * y[i]), y.map((value, i) => Math.cos(TURN) * value - Math.sin(TURN) * x[i])];
    const [low, high] = [[Infinity, Infinity], [-Infinity, -Infinity]];
    for (const depth of [map.depthBegin - map.overlap, map.depthEnd]) {
      const reach = orthographic ? 1 : depth;
      for (const across of [camera.left, camera.right]) {
        for (const along of [camera.bottom, camera.top]) {
          const corner = [0, 1, 2].map((i) => position[i] + depth * forward[i] + reach * (across * right[i] + along * up[i]));
          axes.forEach((axis, k) => {
            const at = axis[0] * corner[0] + axis[1] * corner[1] + axis[2] * corner[2];
            low[k] = Math.min(low[k], at);
            high[k] = Math.max(high[k], at);
          });
        }
      }
    }
    const turned = [...m];
    axes.forEach((axis, k) => {
      const texel = 2 / (k === 0 ? map.width : map.height);
      axis.forEach((value, i) => { turned[4 * i + k] = value; });
      turned[12 + k] = -Math.round((0.5 * (low[k] + high[k])) / texel) * texel;
    });
    Object.assign(map, gnomon.rebased({ ...map, clipFromWorld: turned, snapValid: false }, plan.origin));
  }
}

/** A plan whose grids of fit stable are turned. */
export function planTurned(gnomon, input) {
  const plan = gnomon.plan(input);
  if (input.options.fit === 'stable') turnGrids(gnomon, plan, input.camera);
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
