// What the module does besides plans: names, refusals, histories, sets, foreign maps, memory. MODULE: as installed.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import test from 'node:test';
import { EVENT_KINDS, IGNORED, OMISSION_KINDS, POINT_STATUS, REUSE_KINDS } from '../core.js';
import { constants, structs } from '../layout.js';
import { boxes } from './street.js';

const { GnomonError, load } = await import(process.env.MODULE ?? '../index.js');
const gnomon = await load();
const camera = gnomon.perspective({ position: [0, 3, 10], forward: [0, -0.1, -1], fovY: 1, aspect: 1.5, near: 0.2, far: 250, width: 960, height: 640 });
const light = { direction: [0.4, -1, 0.3] };
const street = { camera, casters: boxes, receivers: boxes };
const plan = gnomon.plan({ ...street, light });

test('the small modules need nothing from outside, the larger ones a search', async () => {
  const search = { module: 'gnomon', name: 'occluder_distance', kind: 'function' };
  for (const [name, imports] of [['gnomon.wasm', []], ['gnomon-scalar.wasm', []], ['gnomon-full.wasm', [search]], ['gnomon-full-scalar.wasm', [search]]]) {
    const module = new WebAssembly.Module(readFileSync(new URL(`../${name}`, import.meta.url)));
    assert.deepEqual(WebAssembly.Module.imports(module), imports);
  }
  await assert.rejects(load({ wasm: new URL('../gnomon-full.wasm', import.meta.url) }), { field: 'wasm', message: /imports 'gnomon.occluder_distance'/ });
});

test('every option of the types is one of C, and the other way round', () => {
  const types = readFileSync(new URL('../index.d.ts', import.meta.url), 'utf8');
  const camel = (name) => name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());
  const members = (name) => {
    const body = types.match(new RegExp(`interface ${name} (?:extends \\w+ )?\\{([^]*?)\\n\\}`))[1].replace(/\/\*\*[^]*?\*\//g, '');
    return new Set([...body.matchAll(/(\w+)\??:/g)].map((match) => match[1]));
  };
  for (const [struct, name] of [['plan_options', 'PlanOptions'], ['map', 'ShadowMap'], ['camera', 'Camera'], ['light', 'Light'],
    ['stats', 'Stats'], ['point_error', 'PointError'], ['clip_space', 'ClipSpace']]) {
    const fields = Object.keys(structs[struct].fields).filter((field) => field !== 'size' && field !== 'reserved').map(camel);
    assert.deepEqual([...members(name)].sort(), fields.sort(), name);
  }
});

test('every number of C has a name', () => {
  const header = readFileSync(new URL('../../../include/gnomon/c/gnomon.h', import.meta.url), 'utf8');
  const numbersOf = (first) => [...header.match(new RegExp(`enum \\{\\s*(GNOMON_${first} = 0[^}]*)`))[1]
    .matchAll(/^\s*GNOMON_(\w+) =/gm)].map((match) => match[1]);
  for (const [first, names] of [['CASCADE_WITHOUT_RECEIVER', OMISSION_KINDS], ['IGNORED_PARTITION', IGNORED], ['MAP_APPEARED', EVENT_KINDS],
    ['REUSE_NONE', REUSE_KINDS], ['POINT_OK', POINT_STATUS]]) {
    const all = numbersOf(first);
    assert.deepEqual(all.map((name) => constants[name]), all.map((_, i) => i), first);
    assert.equal(names.length, all.length, first);
  }
  const camel = (name) => name.toLowerCase().replace(/_(.)/g, (_, letter) => letter.toUpperCase());
  assert.deepEqual(OMISSION_KINDS, numbersOf('CASCADE_WITHOUT_RECEIVER').map(camel));
});

test('names are listed with a line about each', () => {
  const warps = gnomon.names('warps');
  assert.ok(warps.some(({ name }) => name === 'optimal'));
  assert.ok(warps.every(({ name, summary }) => name.length > 0 && summary.length > 0));
  assert.match(gnomon.version, /^\d+\.\d+\.\d+$/);
  assert.throws(() => gnomon.names('teapots'), GnomonError);
});

test('bad input is refused by name, and the module still works', () => {
  const refuses = (input, field) => assert.throws(() => gnomon.plan({ ...street, light, ...input }), { name: 'GnomonError', field });
  refuses({ camera: { ...camera, farDepth: NaN } }, 'camera.far_depth');
  refuses({ camera: { ...camera, fov: 60 } }, 'camera.fov');
  refuses({ camera: { ...camera, width: 1.5 } }, 'camera.width');
  refuses({ camera: { ...camera, width: 2 ** 40 } }, 'camera.width');
  refuses({ options: { cascades: 0 } }, 'plan_options.cascades');
  refuses({ options: { mapSize: 512 } }, 'plan_options.mapSize');
  refuses({ options: { warp: 'teapot' } }, 'plan_options.warp');
  refuses({ options: { fit: 'loose' } }, 'plan_options.fit');
  refuses({ options: { prune: ['nothing'] } }, 'plan_options.prune');
  refuses({ options: { splitGiven: new Float64Array(8) } }, 'plan_options.split_given');
  refuses({ options: { resolutionTexelBudget: 0.5 } }, 'plan_options.resolution_texel_budget');
  refuses({ light: { kind: 'sun' } }, 'light.kind');
  refuses({ light: undefined }, 'light');
  refuses({ casters: [1, 2, 3] }, 'scene.casters');
  refuses({ receivers: null, casters: new Float64Array([NaN, 0, 0, 1, 1, 1]) }, 'scene.casters');
  refuses({ points: [1, 2] }, 'view.points');
  refuses({ caster: boxes }, 'caster');
  // Other types, shapes and lengths.
  refuses({ camera: 5 }, 'camera');
  refuses({ camera: null }, 'camera');
  refuses({ light: 'sun' }, 'light');
  refuses({ options: 'stable' }, 'plan_options');
  refuses({ camera: { ...camera, position: [0, 1] } }, 'camera.position');
  refuses({ camera: { ...camera, position: '012' } }, 'camera.position');
  refuses({ camera: { ...camera, position: [0, null, 1] } }, 'camera.position');
  refuses({ camera: { ...camera, farDepth: '9' } }, 'camera.far_depth');
  refuses({ light: { direction: [0, -1, 0, 0] } }, 'light.direction');
  refuses({ casters: 'abcdef' }, 'scene.casters');
  refuses({ casters: 7 }, 'scene.casters');
  refuses({ casters: { length: 6 } }, 'scene.casters');
  refuses({ casters: [[0, 0, 0], [1, 1, 1]] }, 'scene.casters');
  refuses({ casters: new BigInt64Array(6) }, 'scene.casters');
  refuses({ casters: new DataView(new ArrayBuffer(48)) }, 'scene.casters');
  refuses({ points: [[1, 2], [3, 4], [5, 6]] }, 'view.points');
  refuses({ points: [1, 2, 3], normals: [1, 2] }, 'view.normals');
  refuses({ points: [1, 2, 3], normals: [0, 1, 0, 0, 1, 0] }, 'view.normals');
  refuses({ depths: 4 }, 'view.depths');
  refuses({ history: {} }, 'history');
  refuses({ options: { prune: 'all' } }, 'plan_options.prune');
  refuses({ options: { prune: [3] } }, 'plan_options.prune');
  refuses({ options: { warpFocus: [0, 0, 0] } }, 'plan_options.warp_focus');
  assert.throws(() => gnomon.plan(), { field: 'input' });
  assert.throws(() => gnomon.perspective(), { field: 'camera' });
  assert.throws(() => gnomon.perspective({ fovY: '1' }), { field: 'fov_y' });
  assert.throws(() => gnomon.perspective({ fovY: 1, width: 1.5 }), { field: 'width' });
  assert.throws(() => gnomon.cameraFrom({ viewFromWorld: [1], clipFromView: [1], width: 1, height: 1 }), { field: 'view_from_world' });
  assert.throws(() => gnomon.measure(undefined, street), { field: 'plan' });
  assert.throws(() => gnomon.measure({}, street), { field: 'plan.maps' });
  assert.throws(() => gnomon.measure({ maps: [{ clipFromWorld: [1, 2] }] }, street), { field: 'map.clip_from_world' });
  assert.throws(() => gnomon.cull(undefined, boxes), { field: 'map' });
  assert.throws(() => gnomon.cull(plan.maps[0], {}), { field: 'casters' });
  assert.throws(() => gnomon.select(plan, [0, 0, 0], []), { field: 'view_depths' });
  assert.throws(() => gnomon.rebased(plan.maps[0], [1, 2]), { field: 'origin' });
  assert.throws(() => gnomon.shaderBlock(plan, { layerWidth: 1.5 }), { field: 'layer_width' });
  assert.throws(() => gnomon.perspective({ fovY: 60, aspect: 1 }), { field: 'fov_y' });
  assert.deepStrictEqual(gnomon.plan({ ...street, light }), plan);
});

test('a plan, its casters and its error are those of a set as well', () => {
  const set = gnomon.casterSet(boxes);
  assert.equal(set.count, boxes.length / 6);
  assert.deepStrictEqual(gnomon.plan({ camera, light, casters: set, receivers: set }), plan);
  assert.deepEqual([...gnomon.cull(plan.maps[0], set)].sort((a, b) => a - b), [...gnomon.cull(plan.maps[0], boxes)]);
  set.update(1, [-12, 0, -3, -8, 30, 0]);
  assert.notDeepStrictEqual(gnomon.plan({ camera, light, casters: set, receivers: set }).maps, plan.maps);
  set.refit(boxes);
  assert.deepStrictEqual(gnomon.plan({ camera, light, casters: set, receivers: set }), plan);
  assert.throws(() => set.update(1000, [0, 0, 0, 1, 1, 1]), { field: 'index' });
  set.dispose();
  set.dispose();
  assert.throws(() => gnomon.plan({ camera, light, casters: set, receivers: set }), { field: 'disposed' });
});

test('a list whose buffer went to another thread is refused, and so is a handle of another module', async () => {
  const list = boxes.slice();
  structuredClone(list, { transfer: [list.buffer] });
  for (const key of ['casters', 'receivers']) assert.throws(() => gnomon.plan({ ...street, light, [key]: list }), { field: `scene.${key}` });
  assert.throws(() => gnomon.casterSet(list), { field: 'boxes' });
  assert.throws(() => gnomon.plan({ ...street, light, depths: list }), { field: 'view.depths' });
  const other = await load();
  assert.throws(() => gnomon.plan({ ...street, light, casters: other.casterSet(boxes) }), { field: 'scene.casters' });
  assert.throws(() => gnomon.plan({ ...street, light, history: other.history() }), { field: 'history' });
  assert.throws(() => gnomon.casterSet(boxes).update(0.5, [0, 0, 0, 1, 1, 1]), { field: 'index' });
});

test('a module of another version, of another program or of none is refused', async () => {
  const bytes = readFileSync(new URL('../gnomon.wasm', import.meta.url));
  await assert.rejects(load({ wasm: new Uint8Array([1, 2, 3]) }), { name: 'GnomonError', field: 'wasm' });
  await assert.rejects(load({ wasm: 7 }), { field: 'wasm' });
  await assert.rejects(load({ wasm: new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0]) }), { field: 'wasm', message: /has no/ });
  const older = Uint8Array.from(bytes);
  const at = bytes.indexOf(`${gnomon.version}\0`);
  assert.ok(at > 0);
  older[at] += 1;
  await assert.rejects(load({ wasm: older }), { field: 'wasm', message: /version 1\.1\.0, expected 0\.1\.0/ });
  assert.equal(gnomon.version, JSON.parse(readFileSync(new URL('../package.json', import.meta.url))).version);
  assert.equal((await load({ wasm: await WebAssembly.compile(bytes) })).version, gnomon.version);
});

test('foreign maps are measured as those that they are copies of', () => {
  const { maps, ...rest } = plan;
  const foreign = { maps: maps.map(({ clipFromWorld, width, height, depthBegin, depthEnd }) => ({ clipFromWorld, width, height, depthBegin, depthEnd })), selection: 'view_depth' };
  const [own, other] = [plan, foreign].map((one) => gnomon.measure(one, street));
  assert.ok(own.p95 > 0 && Math.abs(own.p95 - other.p95) < 1e-9 * own.p95);
  assert.equal(own.samples, other.samples);
  assert.ok(rest.origin.length === 3);
});

test('points find the map that holds their depth, and have an error there', () => {
  const points = [[0, 0, 0], [0, 0, -50], [0, 0, -150], [0, 0, 500]];
  const depths = points.map(([, y, z]) => ((y - 3) * -0.1 + (z - 10) * -1) / Math.hypot(0.1, 1));
  const indices = gnomon.select(plan, points, depths);
  assert.equal(indices[3], -1);
  for (const i of [0, 1, 2]) {
    assert.ok(plan.maps[indices[i]].depthBegin <= depths[i] && depths[i] <= plan.maps[indices[i]].depthEnd);
    const [error] = gnomon.measurePoints(plan.maps[indices[i]], { camera, points: [points[i]], normals: [[0, 1, 0]] });
    assert.equal(error.status, 'ok');
    assert.ok(error.mMax > 0 && Number.isFinite(error.mMax));
  }
});

test('a history keeps maps, reports jumps, and is freed once', () => {
  const history = gnomon.history();
  const options = { fit: 'stable' };
  const first = gnomon.plan({ ...street, light, options, history });
  const next = gnomon.plan({ ...street, camera: { ...camera, position: [1, 3, 10] }, light, options, history });
  const reuse = gnomon.compare(first.maps[0], next.maps[0]);
  assert.equal(reuse.kind, 'scrolled');
  assert.ok(reuse.kept.width > 0 && reuse.strips.length >= 1);
  assert.equal(gnomon.compare(first.maps[0], first.maps[0]).kind, 'identical');
  gnomon.plan({ ...street, light, history });
  assert.ok(history.events.every(({ kind }) => ['mapAppeared', 'mapRefitted', 'densityJump'].includes(kind)));
  history.clear();
  history.dispose();
  assert.throws(() => history.clear(), { field: 'disposed' });
});

test('matrices give the camera that they are of, or the reason', () => {
  const near = 0.2;
  const far = 250;
  const y = 1 / Math.tan(0.5);
  const clip = [y / 1.5, 0, 0, 0, 0, y, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, (2 * far * near) / (near - far), 0];
  const view = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -3, -10, 1];
  const found = gnomon.cameraFrom({ viewFromWorld: view, clipFromView: clip, width: 960, height: 640 });
  assert.ok([0, 3, 10].every((v, i) => found.position[i] === v));
  assert.ok(Math.abs(found.top - Math.tan(0.5)) < 1e-12 && Math.abs(found.farDepth - far) < 1e-6);
  clip[0] = -clip[0];
  assert.throws(() => gnomon.cameraFrom({ viewFromWorld: view, clipFromView: clip, width: 960, height: 640 }), /reflection|mirror|y_down|handedness/);
});

test('memory grows with the input, and what was read before stays', () => {
  const many = new Float64Array(6 * 200000);
  for (let i = 0; i < 200000; ++i) many.set([i % 100, 0, -(i % 333), (i % 100) + 0.5, 1, 0.5 - (i % 333)], 6 * i);
  const before = structuredClone(plan);
  const large = gnomon.plan({ camera, light, casters: many, receivers: boxes });
  assert.equal(large.status, 'ok');
  assert.ok(gnomon.cull(large.maps[0], many).length > 0);
  assert.deepStrictEqual(plan, before);
});

test('the shader block holds the matrices, and texture coordinates are 0..1', () => {
  const block = gnomon.shaderBlock(plan);
  assert.equal(block.length, 460);
  assert.equal(block[10], plan.maps.length);
  const texture = gnomon.textureFromClip({ zeroToOne: true });
  assert.deepEqual([...texture], [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1, 0, 0.5, 0.5, 0, 1]);
  const moved = gnomon.rebased(plan.maps[0], [1, 2, 3]);
  assert.deepStrictEqual(moved.clipFromWorld, plan.maps[0].clipFromWorld);
  assert.notDeepStrictEqual(moved.clipFromCameraRelative, plan.maps[0].clipFromCameraRelative);
});
