// How many pixels of a picture will a plan get wrong, and where are its shadow's edges? full.d.ts is the manual.
import { objectOf, pointsOf } from './core.js';
import { GnomonError, constants, numbersOf, structs, wholeIn } from './memory.js';
import { PagePlan } from './pages.js';

const SEARCH = 'shadow_picture.occluder_search';

/** What the module imports: the search of the call that runs. */
export class Searches {
  imports = { gnomon: { occluder_distance: (x, y, z) => this.distance(x, y, z) } };

  distance(x, y, z) {
    const { search, failure } = this;
    if (failure !== undefined) return -Infinity;
    try {
      const distance = search(x, y, z);
      if (typeof distance !== 'number') throw new GnomonError(SEARCH, `gnomon: ${SEARCH}: it returned no number`);
      return distance;
    } catch (error) {
      // Frames of the module in between would keep their part of its stack: run() throws it.
      this.failure = { error };
      return -Infinity;
    }
  }

  /** Runs `work`, which calls the module about a plan, with this search. */
  run(search, plan, work) {
    if (this.search !== undefined) throw new GnomonError(SEARCH, `gnomon: ${SEARCH}: a search may not start another one`);
    Object.assign(this, { search, plan });
    try {
      work();
      if (this.failure !== undefined) throw this.failure.error;
    } finally {
      this.search = this.plan = this.failure = undefined;
    }
  }
}

/** Runs `work` with a picture, without its search, in the memory of the module. */
function withPicture(gnomon, picture, bytes, work) {
  const { camera, mask, viewDepths, occluderDistances, occluderSearch, normals, ...numbers } = objectOf(picture, 'shadow_picture');
  if (occluderSearch !== undefined && typeof occluderSearch !== 'function') throw new GnomonError(SEARCH, `gnomon: ${SEARCH}: expected a function`);
  const lists = [];
  const add = (name, each, values) => {
    lists.push([name, each, values]);
    bytes += 4 * values.length + 16;
  };
  add('mask', 1, numbersOf(mask, 'shadow_picture.mask'));
  add('view_depths', 1, numbersOf(viewDepths, 'shadow_picture.view_depths'));
  if (occluderDistances !== undefined) add('occluder_distances', 1, numbersOf(occluderDistances, 'shadow_picture.occluder_distances'));
  if (normals !== undefined) add('normals', 3, pointsOf(normals, 'shadow_picture.normals'));
  return gnomon.call(bytes, (memory, check) => {
    const eye = memory.struct('camera');
    memory.write('camera', eye, camera);
    const at = memory.struct('shadow_picture');
    memory.write('shadow_picture', at, numbers);
    memory.pointer('shadow_picture', at, 'camera', eye);
    const pixels = memory.value('camera', eye, 'width') * memory.value('camera', eye, 'height');
    memory.integer('shadow_picture', at, 'pixel_count', pixels);
    for (const [name, each, values] of lists) {
      const field = `shadow_picture.${name}`;
      if (values.length !== each * pixels) throw new GnomonError(field, `gnomon: ${field}: expected ${each * pixels} numbers, as the camera has ${pixels} pixels`);
      memory.pointer('shadow_picture', at, name, memory.numbers(values, 'f32'));
    }
    return work(memory, check, at);
  });
}

export function expectedError(gnomon, plan, picture) {
  return withPicture(gnomon, picture, constants.MAX_MAPS * structs.map.bytes, (memory, check, at) => {
    const { exports } = memory;
    const [call, planAt] = plan instanceof PagePlan
      ? [exports.gnomon_expected_page_error, gnomon.placeOf(plan, PagePlan, 'page_plan')]
      : [exports.gnomon_expected_error, gnomon.writePlan(memory, plan)];
    const pixels = memory.allocate(structs.wrong_pixels.bytes);
    const expect = () => check((field) => call(planAt, at, pixels, field));
    if (picture.occluderSearch === undefined) {
      expect();
    } else {
      memory.pointer('shadow_picture', at, 'occluder_search', exports.gnomon_imported_search());
      gnomon.searches.run(picture.occluderSearch, plan, expect);
    }
    return memory.read('wrong_pixels', pixels);
  });
}

export function shadowEdgePoints(gnomon, picture, room) {
  // No picture has more edges than pixels.
  const most = Math.min(wholeIn(room, 0, 2 ** 32 - 1, 'room'), objectOf(picture, 'shadow_picture').mask?.length ?? 0);
  return withPicture(gnomon, picture, 24 * most, (memory, check, at) => {
    const points = memory.allocate(24 * most);
    const written = memory.allocate(8);
    check((field) => memory.exports.gnomon_shadow_edge_points(at, points, BigInt(most), written, field));
    return memory.copy(points, 'f64', 3 * Number(memory.view.getBigInt64(written, true)));
  });
}
