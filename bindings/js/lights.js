// How do many lights go through the C interface? full.d.ts is the manual.
import { Handle, objectOf, pointCount } from './core.js';
import { readAtlas } from './maps.js';
import { GnomonError, structs, wholeOf } from './memory.js';

const OUTCOMES = ['mapped', 'belowLeastSize', 'withoutReceiver', 'withoutCaster'];

export class LightHistory extends Handle {
  constructor(gnomon, lights) {
    super(gnomon, 'gnomon_light_history_destroy', gnomon.memory.exports.gnomon_light_history_create(BigInt(wholeOf(lights, 'lights'))));
  }
  swap(a, b) {
    this.gnomon.memory.exports.gnomon_light_history_swap(this.place(), BigInt(wholeOf(a, 'a')), BigInt(wholeOf(b, 'b')));
  }
  forget(light) {
    this.gnomon.memory.exports.gnomon_light_history_forget(this.place(), BigInt(wholeOf(light, 'light')));
  }
}

/** Writes lights beside each other, and returns where they are. */
function writeLights(memory, lights) {
  const first = memory.allocate(lights.length * structs.light.bytes);
  lights.forEach((light, i) => memory.write('light', memory.struct('light', first + i * structs.light.bytes), light));
  return first;
}
function listOf(lights) {
  if (!Array.isArray(lights)) throw new GnomonError('lights', 'gnomon: lights: expected an array');
  return lights;
}

function writeOptions(gnomon, memory, { plan, ...options }) {
  const at = memory.struct('light_options');
  memory.write('light_options', at, options);
  if (plan !== undefined) {
    const of = memory.struct('plan_options');
    gnomon.writeOptions(memory, of, plan);
    memory.pointer('light_options', at, 'plan', of);
  }
  return at;
}

function readLight(memory, at) {
  const { outcome, place, mapCount, ...light } = memory.read('light_maps', at);
  return { outcome: OUTCOMES[outcome], places: place.slice(0, mapCount), ...light };
}

function writeLightMaps(gnomon, memory, maps) {
  const { outcome, places, ...light } = objectOf(maps, 'light_maps');
  const at = gnomon.writeFixed(memory, 'light_maps', { ...light, outcome: Math.max(0, OUTCOMES.indexOf(outcome)), place: places, mapCount: places?.length ?? 0 });
  memory.integer('light_maps', at, 'size', structs.light_maps.bytes);
  return at;
}

export function planLights(gnomon, { lights, options = {}, history, ...view }) {
  const requests = listOf(lights);
  const count = requests.length;
  const { ready, bytes } = gnomon.prepare(view);
  const points = pointCount(ready);
  const room = Number(gnomon.memory.exports.gnomon_light_memory(BigInt(count), BigInt(points)));
  if (room === 0) throw new GnomonError('lights');
  const each = structs.light.bytes + structs.light_request.bytes + structs.light_maps.bytes;
  return gnomon.call(bytes + room + count * each + structs.light_options.bytes + structs.plan_options.bytes, (memory, check) => {
    const at = gnomon.writeInput(memory, ready);
    const first = writeLights(memory, requests.map((request) => request?.light));
    const asked = memory.allocate(count * structs.light_request.bytes);
    requests.forEach(({ light, ...request }, i) => {
      const one = memory.struct('light_request', asked + i * structs.light_request.bytes);
      memory.write('light_request', one, request);
      memory.pointer('light_request', one, 'light', first + i * structs.light.bytes);
    });
    const how = writeOptions(gnomon, memory, options);
    const plan = memory.struct('light_plan');
    const maps = memory.allocate(count * structs.light_maps.bytes);
    memory.pointer('light_plan', plan, 'lights', maps);
    memory.integer('light_plan', plan, 'light_size', structs.light_maps.bytes);
    memory.integer('light_plan', plan, 'light_room', count);
    const past = history === undefined ? 0 : gnomon.placeOf(history, LightHistory, 'light_history');
    const work = memory.allocate(room);
    try {
      check((field) => memory.exports.gnomon_plan_lights(at.view, asked, structs.light_request.bytes, BigInt(count), at.scene, how, past, work, BigInt(room), plan, field));
    } catch (error) {
      const which = memory.value('light_plan', plan, 'invalid_light');
      throw which < 0 ? error : new GnomonError(error.field, `gnomon: lights[${which}]: not usable: ${error.field}`);
    }
    const { lightSize, lightRoom, lightCount, invalidLight, ...found } = memory.read('light_plan', plan);
    return { ...found, lights: Array.from({ length: lightCount }, (_, i) => readLight(memory, maps + i * structs.light_maps.bytes)) };
  });
}

export function lightPlanOptions(gnomon, options, light) {
  const rules = gnomon.names('pruneRules').map(({ name }) => name);
  return gnomon.call(structs.light_options.bytes + 2 * structs.plan_options.bytes + structs.light_maps.bytes, (memory, check) => {
    const how = writeOptions(gnomon, memory, options);
    const maps = writeLightMaps(gnomon, memory, light);
    const to = memory.struct('plan_options');
    check((field) => memory.exports.gnomon_light_plan_options(how, maps, to, field));
    const { prune, ...plan } = memory.read('plan_options', to);
    return { ...plan, prune: rules.filter((_, i) => (prune >>> i) & 1) };
  });
}

export function lightAtlas(gnomon, plan, light) {
  const { lights, poolWidth, poolHeight } = objectOf(plan, 'light_plan');
  const maps = listOf(lights)[wholeOf(light, 'light')];
  if (maps === undefined) throw new GnomonError('light');
  return gnomon.call(structs.light_maps.bytes, (memory, check) => {
    const at = memory.struct('light_plan');
    memory.write('light_plan', at, { poolWidth, poolHeight });
    memory.pointer('light_plan', at, 'lights', writeLightMaps(gnomon, memory, maps));
    memory.integer('light_plan', at, 'light_size', structs.light_maps.bytes);
    for (const count of ['light_room', 'light_count']) memory.integer('light_plan', at, count, 1);
    const atlas = memory.allocate(structs.atlas.bytes);
    check((field) => memory.exports.gnomon_light_atlas(at, 0n, atlas, field));
    return readAtlas(memory, atlas);
  });
}

export function cameraRound(gnomon, light, camera) {
  return gnomon.call(0, (memory, check) => {
    const from = memory.struct('light');
    memory.write('light', from, light);
    const eye = memory.struct('camera');
    memory.write('camera', eye, camera);
    const to = memory.struct('camera');
    check((field) => memory.exports.gnomon_camera_round(from, eye, to, field));
    return memory.read('camera', to);
  });
}

export function clusterLights(gnomon, { camera, lights, tilePixels = 64, depthSlices = 48, room = 65536 }) {
  const count = listOf(lights).length;
  wholeOf(tilePixels, 'light_clusters.tile_pixels');
  wholeOf(depthSlices, 'light_clusters.depth_slices');
  const entries = Math.max(wholeOf(room, 'light_clusters.light_room'), count, 1);
  const { exports } = gnomon.memory;
  const bytes = Number(exports.gnomon_cluster_memory(BigInt(count), BigInt(entries)));
  if (bytes === 0) throw new GnomonError('light_clusters.light_room');
  const clusters = gnomon.call(0, (memory) => {
    const at = memory.struct('camera');
    memory.write('camera', at, camera);
    return Number(exports.gnomon_cluster_count(at, tilePixels, depthSlices));
  });
  const begins = Math.max(clusters + 1, 2);
  return gnomon.call(bytes + count * structs.light.bytes + 4 * (begins + entries), (memory, check) => {
    const eye = memory.struct('camera');
    memory.write('camera', eye, camera);
    const first = writeLights(memory, lights);
    const at = memory.struct('light_clusters');
    memory.write('light_clusters', at, { tilePixels, depthSlices, beginRoom: begins, lightRoom: entries });
    const begin = memory.allocate(4 * begins);
    const list = memory.allocate(4 * entries);
    memory.pointer('light_clusters', at, 'begin', begin);
    memory.pointer('light_clusters', at, 'lights', list);
    const work = memory.allocate(bytes);
    check((field) => exports.gnomon_cluster_lights(eye, first, structs.light.bytes, BigInt(count), work, BigInt(bytes), at, field));
    const { beginRoom, lightRoom, lightCount, status, ...found } = memory.read('light_clusters', at);
    return { ...found, begin: memory.copy(begin, 'u32', found.columns * found.rows * found.slices + 1), lights: memory.copy(list, 'u32', lightCount) };
  });
}
