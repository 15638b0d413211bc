// What do expected errors do besides their bits: searches that throw or call back, pages, refusals? MODULE: as installed.
import assert from 'node:assert/strict';
import test from 'node:test';
import { boxes } from './street.js';

const { load } = await import(new URL('full.js', process.env.MODULE === undefined ? new URL('../x', import.meta.url) : `file://${process.env.MODULE}`));
const gnomon = await load();
const [width, height] = [96, 64];
const camera = gnomon.perspective({ position: [0, 3, 10], forward: [0, -0.1, -1], fovY: 1, aspect: 1.5, near: 0.2, far: 250, width, height });
const light = { direction: [0.4, -1, 0.3] };
const street = { camera, casters: boxes, receivers: boxes };
const plan = gnomon.plan({ ...street, light, options: { resolutionMaxSize: 256 } });
const foreign = { maps: plan.maps.map(({ clipFromWorld, width, height, depthBegin, depthEnd }) => ({ clipFromWorld, width, height, depthBegin, depthEnd })) };

/** Length along the light from a point to a fence that stands along z, -Infinity beyond the fence or between two of its boards. */
const fence = (x, y, z) => {
  const along = (x + 6) / light.direction[0];
  const top = y - light.direction[1] * along, at = z - light.direction[2] * along;
  return along < 0 || top > 4 || at - 4 * Math.floor(at / 4) < 1 ? -Infinity : along * Math.hypot(...light.direction);
};
/** The ground as the camera sees it, and the fence's shadow on it. */
const ground = [], mask = new Float32Array(width * height), viewDepths = new Float32Array(width * height);
for (let i = 0; i < mask.length; ++i) {
  const right = camera.left + ((camera.right - camera.left) * ((i % width) + 0.5)) / width;
  const up = camera.top + ((camera.bottom - camera.top) * (Math.floor(i / width) + 0.5)) / height;
  const [forward, above] = [[0, -0.1, -1], [0, 1, -0.1]].map((axis) => axis.map((part) => part / Math.hypot(0.1, 1)));
  const ray = [0, 1, 2].map((k) => forward[k] + above[k] * up + (k === 0 ? right : 0));
  const depth = ray[1] < 0 ? -camera.position[1] / ray[1] : 0;
  const point = ray.map((part, k) => camera.position[k] + part * depth);
  viewDepths[i] = depth;
  mask[i] = depth > 0 && fence(...point) > 0 ? 0 : 1;
  if (depth > 0 && depth < 100) ground.push(point);
}
const picture = { camera, mask, viewDepths };
const searched = { ...picture, occluderSearch: fence };
const before = gnomon.expectedError(plan, searched);
const fieldsOf = (field) => ({ name: 'GnomonError', field });

test('a picture has errors, with a search and without, and foreign maps have those of their plan', () => {
  const all = viewDepths.filter((depth) => depth > 0).length;
  for (const one of [picture, searched]) {
    const { wrong, counted, share } = gnomon.expectedError(plan, one);
    assert.ok(counted === all && wrong > 0 && share === wrong / counted && share < 0.2);
    const coarse = gnomon.expectedError(gnomon.plan({ ...street, light, options: { resolutionMaxSize: 64 } }), one);
    assert.ok(coarse.wrong > wrong);
  }
  assert.deepStrictEqual(gnomon.expectedError(foreign, picture), gnomon.expectedError(plan, picture));
  const dark = gnomon.expectedError({ maps: [] }, picture);
  assert.equal(dark.wrong, mask.filter((lit, i) => lit === 0 && viewDepths[i] > 0).length);
  assert.deepEqual(gnomon.expectedError(plan, { ...picture, mask: mask.map(() => -1) }), { wrong: 0, counted: 0, share: 0 });
});

test('plain arrays, other types of numbers and nested normals are the same picture', () => {
  const up = mask.reduce((list) => list.push([0, 1, 0]) && list, []);
  const facing = gnomon.expectedError(plan, { ...searched, normals: up.flat() });
  assert.deepStrictEqual(gnomon.expectedError(plan, { ...searched, normals: up }), facing);
  assert.deepStrictEqual(gnomon.expectedError(plan, { ...searched, mask: Uint8Array.from(mask), viewDepths: [...viewDepths], normals: up }), facing);
});

test('pages that serve the ground have fewer errors than coarse maps', () => {
  const pages = gnomon.planPages({ ...street, points: ground, light, options: { capacity: 1024 } });
  for (const one of [picture, searched]) {
    const found = gnomon.expectedError(pages, one);
    assert.equal(found.counted, before.counted);
    assert.ok(found.wrong > 0 && found.wrong < gnomon.expectedError(gnomon.plan({ ...street, light, options: { resolutionMaxSize: 64 } }), one).wrong);
  }
  pages.dispose();
  assert.throws(() => gnomon.expectedError(pages, picture), fieldsOf('disposed'));
});

test('points lie along the edges of the shadow', () => {
  const edges = gnomon.shadowEdgePoints(picture);
  assert.ok(edges.length > 300);
  for (let i = 0; i < edges.length; i += 3) assert.ok(Math.abs(edges[i + 1]) < 1e-4);
  assert.equal(gnomon.shadowEdgePoints(picture, 50).length, 150);
  assert.equal(gnomon.shadowEdgePoints(picture, 0).length, 0);
  assert.deepStrictEqual(gnomon.shadowEdgePoints(picture, 2 ** 32 - 1), edges);
  assert.deepStrictEqual(gnomon.shadowEdgePoints(searched), edges);
});

test('what a search throws arrives unchanged, and the module stays as it was', () => {
  for (const thrown of [new RangeError('no such triangle'), 'a word', undefined, null]) {
    for (const after of [0, 100]) {
      let calls = 0;
      const occluderSearch = (...point) => {
        if (calls++ === after) throw thrown;
        return fence(...point);
      };
      let caught = [];
      try {
        gnomon.expectedError(plan, { ...picture, occluderSearch });
      } catch (error) {
        caught = [error];
      }
      assert.equal(caught.length, 1);
      assert.equal(caught[0], thrown);
      assert.equal(calls, after + 1, 'it is not called again');
    }
  }
  const endless = (x, y, z) => endless(x, y, z) + 1;
  assert.throws(() => gnomon.expectedError(plan, { ...picture, occluderSearch: endless }), RangeError);
  // A stack of 1 MB would have no room any more.
  for (let i = 0; i < 100; ++i) assert.throws(() => gnomon.expectedError(plan, { ...picture, occluderSearch: () => { throw new Error('again'); } }), /again/);
  assert.deepStrictEqual(gnomon.expectedError(plan, searched), before);
});

test('a search has to return a number', () => {
  for (const distance of [undefined, null, '3', 3n, [3], true]) {
    assert.throws(() => gnomon.expectedError(plan, { ...picture, occluderSearch: () => distance }), fieldsOf('shadow_picture.occluder_search'));
  }
  const none = gnomon.expectedError(plan, { ...picture, occluderSearch: () => -Infinity });
  assert.deepStrictEqual(gnomon.expectedError(plan, { ...picture, occluderSearch: () => NaN }), none);
  assert.deepStrictEqual(gnomon.expectedError(plan, searched), before);
});

test('a search may make other calls, whatever memory they take', () => {
  const [input, many] = [{ ...street, light }, new Float64Array(6 * 50000)];
  for (let i = 0; i < many.length; i += 6) many.set([0, 0, -i / 6, 1, 1, 1 - i / 6], i);
  const expected = { plan: gnomon.plan(input), large: gnomon.plan({ ...input, casters: many }), error: gnomon.expectedError(plan, picture) };
  let calls = 0;
  const occluderSearch = (...point) => {
    if (++calls % 500 === 1) {
      const history = gnomon.history();
      assert.deepStrictEqual(gnomon.plan({ ...input, history }), expected.plan);
      history.dispose();
      assert.deepStrictEqual(gnomon.plan({ ...input, casters: many }), expected.large);
      assert.deepStrictEqual(gnomon.expectedError(plan, picture), expected.error);
      gnomon.planPages({ ...input, options: { capacity: 256 } }).dispose();
    }
    return fence(...point);
  };
  const sizes = [1, 2].map(() => {
    calls = 0;
    assert.deepStrictEqual(gnomon.expectedError(plan, { ...picture, occluderSearch }), before);
    assert.ok(calls > 500);
    return gnomon.memory.exports.memory.buffer.byteLength;
  });
  assert.equal(sizes[0], sizes[1], 'memory is given back');
  assert.deepStrictEqual(gnomon.plan(input), expected.plan);
});

test('a search may neither start another one nor dispose of the pages that it is of', async () => {
  const within = (run) => (...point) => {
    run();
    return fence(...point);
  };
  const again = within(() => gnomon.expectedError(plan, searched));
  assert.throws(() => gnomon.expectedError(plan, { ...picture, occluderSearch: again }), fieldsOf('shadow_picture.occluder_search'));
  const pages = gnomon.planPages({ ...street, points: ground, light, options: { capacity: 512 } });
  assert.throws(() => gnomon.expectedError(pages, { ...picture, occluderSearch: within(() => pages.dispose()) }), fieldsOf('page_plan'));
  const other = await load({ simd: false });
  assert.deepStrictEqual(gnomon.expectedError(plan, { ...picture, occluderSearch: within(() => other.textureFromClip()) }), before);
  let inner;
  const both = within(() => (inner ??= other.expectedError(plan, searched)));
  assert.deepStrictEqual(gnomon.expectedError(plan, { ...picture, occluderSearch: both }), before);
  assert.deepStrictEqual(inner, before);
  pages.dispose();
  assert.throws(() => pages.select([0, 0, 0]), fieldsOf('disposed'));
});

test('bad pictures are refused by name, and the module still works', async () => {
  const refuses = (more, field) => assert.throws(() => gnomon.expectedError(plan, { ...searched, ...more }), fieldsOf(`shadow_picture.${field}`));
  const gone = mask.slice();
  structuredClone(gone, { transfer: [gone.buffer] });
  for (const [key, field] of [['mask', 'mask'], ['viewDepths', 'view_depths'], ['occluderDistances', 'occluder_distances'], ['normals', 'normals']]) {
    for (const list of [null, 5, 'abc', {}, gone, new BigInt64Array(mask.length), new DataView(new ArrayBuffer(8)), mask.subarray(1), [], Array(mask.length)])
      refuses({ [key]: list }, field);
  }
  refuses({ mask: undefined }, 'mask');
  refuses({ viewDepths: undefined }, 'view_depths');
  refuses({ normals: mask }, 'normals');
  for (const search of [null, 5, 'fence', {}]) refuses({ occluderSearch: search }, 'occluder_search');
  refuses({ kernelTexels: '1' }, 'kernel_texels');
  refuses({ occluderScene: 1 }, 'occluder_scene');
  refuses({ view_depths: viewDepths }, 'view_depths');
  refuses({ camera: { ...camera, width: 64 } }, 'mask');
  const fails = (run, field) => assert.throws(run, fieldsOf(field));
  fails(() => gnomon.expectedError(plan, { ...picture, camera: undefined }), 'camera');
  fails(() => gnomon.expectedError(plan, { ...picture, camera: { ...camera, width: -width, height: -height } }), 'camera.width, camera.height');
  fails(() => gnomon.expectedError(plan, { ...picture, camera: { ...camera, nearDepth: NaN } }), 'camera.near_depth');
  fails(() => gnomon.expectedError(plan), 'shadow_picture');
  fails(() => gnomon.expectedError(plan, 'picture'), 'shadow_picture');
  fails(() => gnomon.expectedError(undefined, picture), 'plan');
  fails(() => gnomon.expectedError({}, picture), 'plan.maps');
  fails(() => gnomon.expectedError({ maps: [{ ...plan.maps[0], clipFromWorld: new Float64Array(16).fill(NaN) }] }, searched), 'map.clip_from_world');
  fails(() => gnomon.shadowEdgePoints(), 'shadow_picture');
  fails(() => gnomon.shadowEdgePoints({ camera, viewDepths }), 'shadow_picture.mask');
  fails(() => gnomon.shadowEdgePoints({ ...picture, viewDepths: [] }), 'shadow_picture.view_depths');
  for (const room of [-1, 0.5, NaN, '3', 2 ** 40]) fails(() => gnomon.shadowEdgePoints(picture, room), 'room');
  const pages = (await load()).planPages({ ...street, light, options: { capacity: 64 } });
  fails(() => gnomon.expectedError(pages, picture), 'page_plan');
  // More than a module can hold.
  const side = 2 ** 15, large = new Uint8Array(side * side);
  fails(() => gnomon.expectedError(plan, { camera: { ...camera, width: side, height: side }, mask: large, viewDepths: large }), 'memory');
  assert.deepStrictEqual(gnomon.expectedError(plan, searched), before);
});
