// Which linear map of directions gives a cube of shadow maps the least error? A look-up in a cube map takes a direction, and no more.
// So the six faces of a point light share one 3 x 3 matrix, by which directions are turned and stretched before the look-up.

/** Rows of each face of a cube map: across, along and out of it (OpenGL 4.5, table 8.19). */
export const FACES = [
  [[0, 0, -1], [0, -1, 0], [1, 0, 0]],
  [[0, 0, 1], [0, -1, 0], [-1, 0, 0]],
  [[1, 0, 0], [0, 0, 1], [0, 1, 0]],
  [[1, 0, 0], [0, 0, -1], [0, -1, 0]],
  [[1, 0, 0], [0, -1, 0], [0, 0, 1]],
  [[-1, 0, 0], [0, -1, 0], [0, 0, -1]],
];
const SIDES = [[1, 1], [1, -1], [-1, 1], [-1, -1]];
const FIRST_STEP = 0.5;
const LAST_STEP = 0.03;
// Trials of the first frame, and of each one after it.
const FIRST_TRIALS = 150;
const TRIALS = 2;
// Of the longest and the shortest image of a direction: beyond, the near plane comes so close that depths lose their precision.
const MOST_STRETCH = 16;

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const times = (v, rows) => [0, 1, 2].map((k) => v[0] * rows[0][k] + v[1] * rows[1][k] + v[2] * rows[2][k]);
const length = (v) => Math.sqrt(dot(v, v));

/** A 3 x 3 matrix as rows, scaled so that no direction becomes longer than 1 along an axis. */
function cubeOf(rows) {
  const most = Math.max(...rows.map(length));
  const shape = rows.map((row) => row.map((value) => value / most));
  const volume = dot(shape[0], cross(shape[1], shape[2]));
  const back = [cross(shape[1], shape[2]), cross(shape[2], shape[0]), cross(shape[0], shape[1])].map((column) => column.map((value) => value / volume));
  // The direction that the cube shows at a point of its surface.
  const direction = (point) => times(point, back);
  // The largest component of a direction's image, where it is least.
  const least = 1 / Math.max(...SIDES.map(([s, t]) => length(direction([s, t, 1]))));
  return { shape, direction, least };
}

/** Rows of a face of the cube: what they make of a direction is across, along and out of the face. */
export const faceOf = ({ shape }, face) => FACES[face].map((row) => times(row, shape));

/**
 * A cone that holds a face: axis, and half angle in radians. About the normal of the plane through the face's corners the angle is
 * below a right one, however the cube is sheared. Wider cones are not convex: one with all corners may miss what is between them.
 */
export function coneOf(cube, face) {
  const [across, along, out] = FACES[face];
  const axis = faceOf(cube, face)[2];
  const corners = SIDES.map(([s, t]) => cube.direction([0, 1, 2].map((k) => out[k] + s * across[k] + t * along[k])));
  const angle = Math.max(...corners.map((v) => Math.acos(Math.min(1, dot(v, axis) / (length(v) * length(axis))))));
  return { axis, angle };
}

/** The six maps of a cube, for gnomon's measure(). Their near plane is so near that no receiver is before it. */
export function mapsOf(cube, position, size, far) {
  return FACES.map((_, face) => {
    const rows = faceOf(cube, face);
    const [x, y, w] = rows.map((row) => [...row, -dot(row, position)]);
    const z = w.map((value, k) => (k < 3 ? value : value - 1e-4 * far));
    const clipFromWorld = [0, 1, 2, 3].flatMap((k) => [x[k], y[k], z[k], w[k]]);
    return { clipFromWorld, width: size, height: size, depthBegin: 0, depthEnd: far, lightWorld: [...position, 1] };
  });
}

/** One row scaled, or sheared along another. */
function changed({ shape }, k, step) {
  const [row, other] = [Math.floor(k / 3), k % 3];
  const by = row === other ? (step > 0 ? step : 1 / (1 - step) - 1) : step;
  return cubeOf(shape.map((values, i) => (i === row ? values.map((value, j) => value + by * shape[other][j]) : values)));
}

/** A search that goes on from frame to frame: a few trials in each, by shears and scales that become smaller. */
export class CubeSearch {
  constructor() {
    this.reset();
  }
  /** The cube as engines have it, and a search that begins anew. */
  reset() {
    this.cube = cubeOf([[1, 0, 0], [0, 1, 0], [0, 0, 1]]);
    this.searched = false;
    this.restart(this.cube);
  }
  restart(trial) {
    Object.assign(this, { trial, step: FIRST_STEP, next: 0, without: 0 });
  }

  /** `errorOf(cube)`: what is to be least. `keep`: the cube is left for another of less than this share of its error. */
  follow(errorOf, keep = 1) {
    const own = errorOf(this.cube);
    if (!(own > 0)) return;
    let least = this.trial === this.cube ? own : errorOf(this.trial);
    for (let left = this.searched ? TRIALS : FIRST_TRIALS; left > 0; --left) {
      const k = this.next++ % 18;
      const other = changed(this.trial, k >> 1, k & 1 ? this.step : -this.step);
      const error = other.least * MOST_STRETCH < 1 ? Infinity : errorOf(other);
      if (error < least) {
        this.trial = other;
        least = error;
        this.without = 0;
      } else if (++this.without === 18) {
        this.step /= 2;
        this.without = 0;
        if (this.step < LAST_STEP) this.restart(this.trial);
      }
    }
    this.searched = true;
    if (least < keep * own) this.cube = this.trial;
  }
}
