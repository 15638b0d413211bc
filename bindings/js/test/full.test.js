// What pages, pools and many lights do besides their bits: histories, pools, clusters, refusals. MODULE: as installed.
import assert from 'node:assert/strict';
import test from 'node:test';
import { boxes } from './street.js';

const from = (file) => import(new URL(file, process.env.MODULE === undefined ? new URL('../x', import.meta.url) : `file://${process.env.MODULE}`));
const { GnomonError, load } = await from('full.js');
const { load: loadSmall } = await from('index.js');
const gnomon = await load();
const camera = gnomon.perspective({ position: [0, 3, 10], forward: [0, -0.1, -1], fovY: 1, aspect: 1.5, near: 0.2, far: 250, width: 960, height: 640 });
const sun = { direction: [0.4, -1, 0.3] };
const street = { camera, casters: boxes, receivers: boxes };
const lamp = { kind: 'point', position: [3, 4, -20], range: 30 };
const spot = { kind: 'spot', position: [0, 8, -10], direction: [0, -1, -0.2], outerRadians: 0.6, range: 40 };

test('the larger module makes the plans of the small one', async () => {
  const small = await loadSmall();
  assert.deepStrictEqual(gnomon.plan({ ...street, light: sun }), small.plan({ ...street, light: sun }));
  assert.deepEqual(small.names('pagePolicies'), []);
  assert.ok(gnomon.names('pagePolicies').some(({ name }) => name === 'resolution'));
});

test('points find their pages, and a pool keeps them', () => {
  const plan = gnomon.planPages({ ...street, light: sun, options: { capacity: 512 } });
  assert.equal(plan.status, 'ok');
  assert.equal(plan.pages.length, plan.pageCount);
  const [index, none] = plan.select([[0, 0, -20], [0, 0, 500]]);
  assert.ok(index >= 0 && none === -1);
  const page = plan.pages[index];
  const map = plan.map(index);
  assert.equal(map.width, plan.pageTexels + 2 * plan.borderTexels);
  assert.ok(plan.level(page.level).width >= (page.column + 1) * plan.pageTexels);
  assert.ok(gnomon.cull(map, boxes).length > 0);
  assert.ok(plan.measure(street).p95 <= 1.5 * plan.targetM && plan.table.length >= plan.pageCount);
  const pool = gnomon.pagePool(600);
  const first = pool.keep(plan);
  assert.equal(first.drawn, plan.pageCount);
  assert.equal(new Set(first.slots).size, plan.pageCount);
  const second = pool.keep(plan);
  assert.equal(second.drawn, 0);
  assert.deepEqual(second.slots, first.slots);
  const moved = pool.keep(plan, [-12, 0, -33, -8, 8, -30]);
  assert.ok(moved.drawn > 0 && moved.drawn < plan.pageCount);
  assert.equal(moved.drawn, moved.draw.reduce((sum, one) => sum + one, 0));
  pool.clear();
  assert.equal(pool.keep(plan).drawn, plan.pageCount);
  pool.dispose();
  plan.dispose();
});

test('the last frame and its picture guide the next one', () => {
  const points = Array.from({ length: 3000 }, (_, i) => [-4 + (i % 9), 0, -8 - 0.05 * i]);
  const input = { ...street, points, light: sun, options: { policy: 'queried' } };
  const last = gnomon.planPages(input);
  const next = gnomon.planPages({ ...input, history: { last, feedback: new Uint8Array(points.length).fill(2) } });
  assert.equal(next.status, 'ok');
  assert.notDeepEqual(next.pages, last.pages);
  last.dispose();
  assert.throws(() => gnomon.planPages({ ...input, history: { last } }), { field: 'disposed' });
});

test('lights share a pool without overlap, and their plans fit into their places', () => {
  const history = gnomon.lightHistory(8);
  const lights = [{ light: sun }, { light: spot }, { light: lamp, weight: 2 }];
  const options = { poolWidth: 2048, poolHeight: 2048 };
  const plan = gnomon.planLights({ ...street, lights, options, history });
  assert.equal(plan.status, 'ok');
  const places = plan.lights.flatMap((light) => light.places);
  assert.ok(places.length >= 3);
  places.forEach((a, i) => places.slice(i + 1).forEach((b) => {
    assert.ok(a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + a.height <= b.y || b.y + b.height <= a.y);
  }));
  plan.lights.forEach((maps, i) => {
    if (!maps.due) return;
    const made = gnomon.plan({ ...street, camera: gnomon.cameraRound(lights[i].light, camera), light: lights[i].light, options: gnomon.lightPlanOptions(options, maps) });
    assert.ok(made.maps.every(({ width }) => width <= maps.texels));
  });
  assert.ok(gnomon.planLights({ ...street, lights, options, history }).dueTexels <= plan.dueTexels);
  history.swap(0, 1);
  history.forget(2);
  history.dispose();
});

test('clusters list each light where it reaches', () => {
  const { begin, lights, columns, rows, slices } = gnomon.clusterLights({ camera, lights: [sun, lamp] });
  assert.equal(begin.length, columns * rows * slices + 1);
  assert.equal(begin.at(-1), lights.length);
  const withLamp = Array.from({ length: begin.length - 1 }, (_, i) => lights.subarray(begin[i], begin[i + 1])).map((list) => {
    assert.equal(list[0], 0);
    return list.length === 2;
  });
  assert.ok(withLamp.some((one) => one) && withLamp.some((one) => !one));
});

test('bad input is refused by name, and the module still works', async () => {
  const before = gnomon.planPages({ ...street, light: sun }).pages;
  const refuses = (run, field) => assert.throws(run, { name: 'GnomonError', field });
  const pages = (more, options) => () => gnomon.planPages({ ...street, light: sun, ...more, options });
  refuses(pages({}, { capacity: 0 }), 'page_options.capacity');
  refuses(pages({}, { capacity: 1.5 }), 'page_options.capacity');
  refuses(pages({}, { pageTexels: 100 }), 'page_options.page_texels');
  refuses(pages({}, { policy: 'teapot' }), 'page_options.policy');
  refuses(pages({}, { plan: { cascades: 0 } }), 'plan_options.cascades');
  refuses(pages({}, { pages: 4 }), 'page_options.pages');
  refuses(pages({ light: undefined }), 'light');
  refuses(pages({ casters: [1, 2] }), 'scene.casters');
  refuses(pages({ history: { last: {} } }), 'page_history.last');
  refuses(pages({ history: { feedback: 'abc' } }), 'page_history.feedback');
  const plan = gnomon.planPages({ ...street, light: sun, options: { capacity: 256 } });
  refuses(() => plan.level(99), 'level');
  refuses(() => plan.map(-1), 'page');
  refuses(() => plan.select([1, 2]), 'points');
  refuses(() => gnomon.pagePool(0), 'slots');
  const pool = gnomon.pagePool(4);
  refuses(() => pool.keep(plan), 'slot_count');
  refuses(() => pool.keep({}), 'page_plan');
  pool.dispose();
  refuses(() => pool.keep(plan), 'disposed');
  plan.dispose();
  refuses(() => plan.level(0), 'disposed');
  refuses(() => gnomon.planLights({ ...street, lights: 3 }), 'lights');
  refuses(() => gnomon.planLights({ ...street, lights: [{ light: null }] }), 'light');
  refuses(() => gnomon.planLights({ ...street, lights: [{ light: sun, weight: -1 }] }), 'light_request.weight');
  refuses(() => gnomon.planLights({ ...street, lights: [{ light: sun }], options: { leastSize: 3 } }), 'light_options.least_size');
  refuses(() => gnomon.planLights({ ...street, lights: [{ light: sun }], history: gnomon.history() }), 'light_history');
  refuses(() => gnomon.lightHistory(-1), 'memory');
  refuses(() => gnomon.clusterLights({ camera, lights: [sun], tilePixels: 0 }), 'light_clusters.tile_pixels');
  refuses(() => gnomon.clusterLights({ camera, lights: sun }), 'lights');
  await assert.rejects(load({ wasm: new URL('gnomon.wasm', new URL('../x', import.meta.url)) }), { field: 'wasm', message: /gnomon_plan_pages/ });
  assert.deepEqual(gnomon.planPages({ ...street, light: sun }).pages, before);
  assert.ok(GnomonError.prototype instanceof Error);
});
