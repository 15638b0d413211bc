// How do several cameras share maps, and how are maps placed in one texture, biased, and culled in parts? full.d.ts is the manual.
import { CasterSet, exactly, flatten, objectOf } from './core.js';
import { GnomonError, constants, numberOf, structs, wholeOf } from './memory.js';

const PLAN = constants.MAX_MAPS * structs.map.bytes;
const WAYS = ['rasterizer', 'normalOffset'];

export function planViews(gnomon, input) {
  const { cameras, ...rest } = objectOf(input, 'input');
  const most = constants.MAX_VIEWS;
  if (!Array.isArray(cameras) || cameras.length < 1 || cameras.length > most) throw new GnomonError('cameras', `gnomon: cameras: expected 1..${most}`);
  const { ready, bytes } = gnomon.prepare(rest, ['light', 'casters', 'receivers', 'options']);
  ready.camera = cameras[0];
  return gnomon.planBy(ready, bytes + cameras.length * structs.camera.bytes, (memory, at, options, plan, field) => {
    const places = cameras.map((camera) => {
      const place = memory.struct('camera');
      memory.write('camera', place, camera);
      return place;
    });
    return memory.exports.gnomon_plan_views(memory.numbers(places, 'u32'), places.length, at.light, at.scene, options, plan, field);
  });
}

export function readAtlas(memory, at) {
  const { place, count, ...atlas } = memory.read('atlas', at);
  return { ...atlas, places: place.slice(0, count) };
}

export function packAtlas(gnomon, plan, width, height) {
  wholeOf(width, 'width');
  wholeOf(height, 'height');
  return gnomon.call(PLAN, (memory, check) => {
    const planAt = gnomon.writePlan(memory, plan);
    const at = memory.allocate(structs.atlas.bytes);
    check((field) => memory.exports.gnomon_pack_atlas(planAt, width, height, at, field));
    return readAtlas(memory, at);
  });
}

export function atlasFromClip(gnomon, atlas, map, clipSpace) {
  const { places, ...rest } = objectOf(atlas, 'atlas');
  wholeOf(map, 'map');
  return gnomon.call(structs.atlas.bytes, (memory, check) => {
    const at = gnomon.writeFixed(memory, 'atlas', { ...rest, place: places, count: places?.length ?? 0 });
    const space = gnomon.writeFixed(memory, 'clip_space', clipSpace);
    const matrix = memory.allocate(128);
    check((field) => memory.exports.gnomon_atlas_from_clip(at, space, map, matrix, field));
    return memory.copy(matrix, 'f64', 16);
  });
}

export function engineBias(gnomon, plan, map, options) {
  const { way = WAYS[0], kernelRadiusTexels = 0, depthBits = 0 } = objectOf(options, 'options');
  if (!WAYS.includes(way)) throw new GnomonError('way', `gnomon: way: expected ${WAYS.join(' or ')}`);
  wholeOf(map, 'map');
  wholeOf(depthBits, 'depth_bits');
  numberOf(kernelRadiusTexels, 'kernel_radius_texels');
  return gnomon.call(PLAN, (memory, check) => {
    const planAt = gnomon.writePlan(memory, plan);
    const at = memory.allocate(structs.engine_bias.bytes);
    check((field) => memory.exports.gnomon_translate_bias(planAt, map, WAYS.indexOf(way), kernelRadiusTexels, depthBits, at, field));
    return memory.read('engine_bias', at);
  });
}

export function rectanglePlanes(gnomon, map, rectangle, clipSpace) {
  return gnomon.call(structs.map.bytes, (memory, check) => {
    const mapAt = memory.struct('map');
    memory.write('map', mapAt, map);
    const part = gnomon.writeFixed(memory, 'texel_rect', objectOf(rectangle, 'rectangle'));
    const space = gnomon.writeFixed(memory, 'clip_space', clipSpace);
    const planes = memory.allocate(160);
    check((field) => memory.exports.gnomon_rectangle_planes(mapAt, part, space, planes, field));
    return memory.copy(planes, 'f64', 20);
  });
}

export function cullPlanes(gnomon, planes, casters) {
  const flat = flatten(planes, 4, 'planes');
  const set = gnomon.placeOf(casters, CasterSet, 'casters');
  return gnomon.call(flat.length * 8 + casters.count * 4, (memory, check) => {
    const at = memory.numbers(flat);
    const indices = memory.allocate(casters.count * 4);
    const found = memory.allocate(8);
    check((field) => memory.exports.gnomon_cull_planes(at, flat.length / 4, set, indices, BigInt(casters.count), found, field));
    return memory.copy(indices, 'u32', Number(memory.view.getBigInt64(found, true)));
  });
}
