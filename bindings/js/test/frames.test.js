// What do frames, atlases, shared maps and planes do besides their bits? MODULE: as installed.
import assert from 'node:assert/strict';
import test from 'node:test';
import { boxes } from './street.js';

const { load } = await import(new URL('full.js', process.env.MODULE === undefined ? new URL('../x', import.meta.url) : `file://${process.env.MODULE}`));
const gnomon = await load();
const camera = gnomon.perspective({ position: [0, 3, 10], forward: [0, -0.1, -1], fovY: 1, aspect: 1.5, near: 0.2, far: 250, width: 960, height: 640 });
const light = { direction: [0.4, -1, 0.3] };
const street = { camera, casters: boxes, receivers: boxes };
const plan = gnomon.plan({ ...street, light, options: { fit: 'stable' } });
const refuses = (run, field) => assert.throws(run, { name: 'GnomonError', field });
const gone = new Float64Array(6);
structuredClone(gone, { transfer: [gone.buffer] });

test('a frame is tried twice with the copy of a history', () => {
  const history = gnomon.history();
  const [near, far] = [camera.position, [0, 3, 2]].map((position) => ({ ...street, camera: { ...camera, position }, light, options: { fit: 'warped_stable' } }));
  gnomon.plan({ ...near, history });
  const copy = history.copy();
  const next = gnomon.plan({ ...far, history });
  assert.notDeepStrictEqual(next, gnomon.plan({ ...far, history: gnomon.history() }));
  assert.deepStrictEqual(gnomon.plan({ ...far, history: copy }), next);
  history.dispose();
  assert.deepStrictEqual(gnomon.plan({ ...far, history: copy.copy() }), gnomon.plan({ ...far, history: copy }));
  refuses(() => history.copy(), 'disposed');
});

test('two eyes share the maps of one plan', () => {
  const cameras = [-1, 1].map((x) => ({ ...camera, position: [x, 3, 10] }));
  const input = { cameras, casters: boxes, receivers: gnomon.casterSet(boxes), light, options: { cascades: 3 } };
  const shared = gnomon.planViews(input);
  assert.equal(shared.status, 'ok');
  assert.deepEqual([...shared.origin], [0, 3, 10]);
  for (const eye of cameras) {
    const { p95, outside } = gnomon.measure(shared, { ...street, camera: eye });
    assert.ok(p95 > 0 && p95 < 2 && outside === 0);
  }
  assert.deepStrictEqual(gnomon.planViews({ ...input, receivers: boxes }), shared);
  assert.equal(shared.maps.length, 3);
  refuses(() => gnomon.planViews(), 'input');
  for (const wrong of [undefined, camera, [], Array(9).fill(camera)]) refuses(() => gnomon.planViews({ ...input, cameras: wrong }), 'cameras');
  refuses(() => gnomon.planViews({ ...input, cameras: [camera, null] }), 'camera');
  refuses(() => gnomon.planViews({ ...input, cameras: [camera, { ...camera, farDepth: NaN }] }), 'camera.far_depth');
  refuses(() => gnomon.planViews({ ...input, light: undefined }), 'light');
  refuses(() => gnomon.planViews({ ...input, history: gnomon.history() }), 'history');
});

test('maps are placed in one texture, each drawn into its part', () => {
  const atlas = gnomon.packAtlas(plan);
  assert.equal(atlas.places.length, plan.maps.length);
  assert.deepStrictEqual(gnomon.packAtlas(plan, atlas.width, atlas.height), atlas);
  atlas.places.forEach(({ x, y, width, height }, i) => {
    assert.deepEqual([width, height], [plan.maps[i].width, plan.maps[i].height]);
    const m = gnomon.atlasFromClip(atlas, i);
    const corners = [m[12] - m[0], m[13] - m[5], m[12] + m[0], m[13] + m[5]];
    assert.deepEqual(corners, [x / atlas.width, y / atlas.height, (x + width) / atlas.width, (y + height) / atlas.height]);
  });
  assert.deepEqual(gnomon.packAtlas(plan, 8, 8).places, []);
  assert.notDeepStrictEqual(gnomon.atlasFromClip(atlas, 0, { firstRowAtYMax: true }), gnomon.atlasFromClip(atlas, 0));
  refuses(() => gnomon.packAtlas(plan, -1, 64), 'width');
  refuses(() => gnomon.packAtlas(plan, 64), 'height');
  refuses(() => gnomon.packAtlas(plan, 64, 0.5), 'height');
  refuses(() => gnomon.packAtlas(null), 'plan');
  refuses(() => gnomon.packAtlas({}), 'plan.maps');
  for (const map of [-1, 99, 0.5, '0']) refuses(() => gnomon.atlasFromClip(atlas, map), 'map');
  refuses(() => gnomon.atlasFromClip(undefined, 0), 'atlas');
  refuses(() => gnomon.atlasFromClip({}, 0), 'map');
  for (const places of [5, 'abc', null, Array(9).fill(atlas.places[0])]) refuses(() => gnomon.atlasFromClip({ ...atlas, places }, 0), 'atlas.place');
  refuses(() => gnomon.atlasFromClip({ ...atlas, places: [null] }, 0), 'texel_rect');
  refuses(() => gnomon.atlasFromClip({ ...atlas, places: [{ x: -5, y: 0, width: 4, height: 4 }] }, 0), 'atlas.place');
  refuses(() => gnomon.atlasFromClip(atlas, 0, 5), 'clip_space');
});

test('the pool of many lights is the atlas of each', () => {
  const lights = [{ light }, { light: { kind: 'point', position: [3, 4, -20], range: 30 } }];
  const pool = gnomon.planLights({ ...street, lights, options: { poolWidth: 2048, poolHeight: 2048 } });
  pool.lights.forEach(({ places }, i) => {
    const atlas = gnomon.lightAtlas(pool, i);
    assert.ok(places.length > 0);
    assert.deepEqual([atlas.width, atlas.height, atlas.places], [2048, 2048, places]);
    assert.equal(gnomon.atlasFromClip(atlas, 0)[0], places[0].width / 2048 / 2);
  });
  for (const one of [2, -1, 0.5]) refuses(() => gnomon.lightAtlas(pool, one), 'light');
  refuses(() => gnomon.lightAtlas(null, 0), 'light_plan');
  refuses(() => gnomon.lightAtlas({ ...pool, lights: 3 }, 0), 'lights');
  refuses(() => gnomon.lightAtlas({ ...pool, lights: [5] }, 0), 'light_maps');
  refuses(() => gnomon.lightAtlas({ ...pool, poolWidth: 0 }, 0), 'light_plan.pool_width');
  refuses(() => gnomon.lightAtlas({ ...pool, lights: [{ ...pool.lights[0], places: Array(9).fill({}) }] }, 0), 'light_maps.place');
  refuses(() => gnomon.lightPlanOptions({}, { ...pool.lights[0], places: 5 }), 'light_maps.place');
});

test('an engine has the bias of a map in its units', () => {
  const bias = gnomon.engineBias(plan, 0, { kernelRadiusTexels: 1.5 });
  assert.ok(bias.slopeFactor > 0 && bias.units > 0 && bias.normalWorld === 0);
  const offset = gnomon.engineBias(plan, 0, { way: 'normalOffset' });
  assert.ok(offset.normalWorld > 0 && offset.slopeFactor === 0);
  assert.ok(gnomon.engineBias(plan, 0, { depthBits: 16 }).units < gnomon.engineBias(plan, 0, { depthBits: 24 }).units);
  for (const map of [-1, 4, 0.5]) refuses(() => gnomon.engineBias(plan, map), 'map');
  for (const way of ['by hand', 1, null]) refuses(() => gnomon.engineBias(plan, 0, { way }), 'way');
  for (const kernelRadiusTexels of [-1, NaN, '1', 1n]) refuses(() => gnomon.engineBias(plan, 0, { kernelRadiusTexels }), 'kernel_radius_texels');
  for (const depthBits of [33, 0.5, '24']) refuses(() => gnomon.engineBias(plan, 0, { depthBits }), 'depth_bits');
  refuses(() => gnomon.engineBias(plan, 0, null), 'options');
  refuses(() => gnomon.engineBias({ maps: [5] }, 0), 'map');
});

test('planes round a part of a map cull what casts into it', () => {
  const set = gnomon.casterSet(boxes);
  const map = plan.maps[2];
  const { width, height } = map;
  const all = gnomon.cullPlanes(gnomon.rectanglePlanes(map, { x: 0, y: 0, width, height }), set);
  const halves = [0, width / 2].map((x) => gnomon.cullPlanes(gnomon.rectanglePlanes(map, { x, y: 0, width: width / 2, height }), set));
  assert.ok(halves.every((half) => half.length > 0 && half.length < all.length));
  assert.deepEqual(new Set(halves.flatMap((half) => [...half])), new Set(all));
  assert.equal(gnomon.cullPlanes([], set).length, set.count);
  assert.deepEqual(gnomon.cullPlanes([[0, 0, 1, 5.5]], set).sort((a, b) => a - b), Uint32Array.of(0, 1, 2));
  const planes = gnomon.rectanglePlanes(map, { x: 0, y: 0, width: 8, height: 8 });
  assert.notDeepStrictEqual(gnomon.rectanglePlanes(map, { x: 0, y: 0, width: 8, height: 8 }, { firstRowAtYMax: true }), planes);
  for (const part of [{}, { x: 0, y: 0, width: width + 1, height: 1 }]) refuses(() => gnomon.rectanglePlanes(map, part), 'rectangle');
  refuses(() => gnomon.rectanglePlanes(map), 'rectangle');
  refuses(() => gnomon.rectanglePlanes(map, { x: 0.5 }), 'texel_rect.x');
  refuses(() => gnomon.rectanglePlanes(null, { x: 0, y: 0, width: 1, height: 1 }), 'map');
  for (const wrong of [[1, 2], 5, [NaN, 0, 0, 0], gone]) refuses(() => gnomon.cullPlanes(wrong, set), 'planes');
  refuses(() => gnomon.cullPlanes(new Float64Array(4 * 33), set), 'plane_count');
  refuses(() => gnomon.cullPlanes(planes, boxes), 'casters');
  set.dispose();
  refuses(() => gnomon.cullPlanes(planes, set), 'disposed');
});

test('jitter moves the maps of a plan that stays as it is', () => {
  const kept = structuredClone(plan);
  const offsets = Array.from({ length: 64 }, (_, frame) => gnomon.jitterTexels(frame));
  assert.equal(new Set(offsets.map(String)).size, 64);
  assert.deepStrictEqual(gnomon.jitterTexels(2 ** 32 - 64), offsets[0]);
  const moved = gnomon.jitter(plan, [0.25, -0.5]);
  assert.notDeepStrictEqual(moved.maps, kept.maps);
  assert.deepStrictEqual(moved.omitted, kept.omitted);
  assert.deepStrictEqual(plan, kept);
  for (const frame of [-1, 0.5, 2 ** 32, '1', undefined]) refuses(() => gnomon.jitterTexels(frame), 'frame');
  for (const offset of [undefined, [1], [0, NaN], [0, '1'], gone]) refuses(() => gnomon.jitter(plan, offset), 'offset');
  refuses(() => gnomon.jitter({ maps: Array(9).fill(plan.maps[0]) }, [0, 0]), 'plan.map_count');
});

test('a sun is held until a shadow edge would show', () => {
  const input = { camera, points: Array.from({ length: 60 }, (_, i) => [0, 0, -i]), sun: [0.4, -1, 0.3], casters: [-40, -1, -200, 40, 8, 20] };
  const first = gnomon.holdSun(input);
  assert.deepEqual([...first.direction], input.sun);
  const near = { ...input, held: first.direction, sun: [0.4 + 1e-6, -1, 0.3] };
  assert.deepStrictEqual(gnomon.holdSun(near).direction, first.direction);
  assert.deepEqual([...gnomon.holdSun({ ...near, mostPixels: 0 }).direction], near.sun);
  assert.deepEqual([...gnomon.holdSun({ ...near, points: undefined }).direction], near.sun);
  const fails = (more, field) => refuses(() => gnomon.holdSun({ ...input, ...more }), field);
  refuses(() => gnomon.holdSun(), 'input');
  fails({ camera: undefined }, 'camera');
  for (const held of [[0, 0], [0, 0, NaN], null, gone]) fails({ held }, 'held');
  for (const sun of [undefined, [0, 0, 0], 'sun']) fails({ sun }, 'sun');
  for (const casters of [undefined, boxes, [NaN, 0, 0, 1, 1, 1], gone]) fails({ casters }, 'casters');
  for (const mostPixels of [-1, '1', NaN]) fails({ mostPixels }, 'most_pixels');
  for (const leastLightSine of [-1, 1.5, null]) fails({ leastLightSine }, 'least_light_sine');
  fails({ points: [1, 2] }, 'view.points');
  fails({ receivers: boxes }, 'receivers');
});

test('followed depths shorten the maps, and reach in again slowly', () => {
  const tracker = gnomon.depthTracker();
  const [far, near] = [Float32Array.of(2, 30, 80), [2, 30]];
  const first = tracker.update(far);
  const followed = tracker.update(near);
  assert.ok(followed.max > 70 && followed.max <= first.max);
  const nothing = tracker.update([]);
  assert.deepStrictEqual(nothing, followed);
  const reach = (depths) => Math.max(...gnomon.plan({ ...street, light, depths }).maps.map(({ depthEnd }) => depthEnd));
  assert.ok(reach(near) < reach(followed) && reach(followed) < reach(undefined));
  assert.deepStrictEqual(gnomon.plan({ ...street, light, depths: structuredClone(followed) }), gnomon.plan({ ...street, light, depths: followed }));
  tracker.clear();
  assert.deepStrictEqual(tracker.update(far), first);
  const again = gnomon.depthTracker().update(first);
  assert.ok(again.min <= first.min && again.max >= first.max && again.max < 200);
  for (const frames of [0, 65536, 0.5, '4', null]) {
    refuses(() => gnomon.depthTracker(frames), 'frames_per_bin');
    refuses(() => gnomon.depthTracker(4, frames), 'hold_frames');
  }
  for (const frame of [undefined, null, 5, 'abc', gone]) refuses(() => tracker.update(frame), 'frame');
  refuses(() => tracker.update({ ...first, count: [1, 2] }), 'visible_depths.count');
  refuses(() => tracker.update({ ...first, min: '1' }), 'visible_depths.min');
  refuses(() => gnomon.plan({ ...street, light, depths: { ...first, far: 3 } }), 'visible_depths.far');
  tracker.dispose();
  refuses(() => tracker.update(far), 'disposed');
  refuses(() => tracker.clear(), 'disposed');
});
