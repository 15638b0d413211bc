// Does PlayCanvas draw gnomon's maps, better than its own, and give its own back? Drawn in a browser. CONSUMER: a folder in which
// gnomon, playcanvas, three, three-mesh-bvh and puppeteer-core are installed. GNOMON: the program, for the verdict on the capture.
import assert from 'node:assert/strict';
import test from 'node:test';
import { alike, judged, shipped } from './captures.js';
import { inBrowser } from './browser.js';
import { fly } from './flights.js';

const TIMEOUT = { timeout: 600000 };
async function check(name) {
  const { result, errors } = await inBrowser('playcanvas_checks_page.js', process.env.CONSUMER, name);
  assert.deepEqual(errors, []);
  return result;
}

test('each cascade has the matrix of its map, and serves its depths', TIMEOUT, async () => {
  for (const one of await check('matrices')) {
    const text = JSON.stringify(one);
    assert.ok(one.maps >= 1 && one.maps <= one.cascades && one.points > 10 * one.maps, text);
    // Single precision, over maps of hundreds of texels and a few hundred world units.
    assert.ok(one.texels < 0.01 && one.depth < 1e-6, text);
    one.distances.forEach((distance, i) => assert.equal(distance, Math.fround(one.ends[Math.min(i, one.maps - 1)]), text));
    assert.deepEqual([one.missing, one.slope, one.normal], [0, one.fit === 'stable' ? 2.9 : 2, 0], text);
  }
});

test('another light keeps its picture, and dispose() gives back the own one bit by bit', TIMEOUT, async () => {
  assert.deepEqual(await check('givenBack'), { differs: true, others: true, after: true, hook: true });
});

test('bounds follow objects that move, come and go', TIMEOUT, async () => {
  const found = await check('followed');
  assert.deepEqual(found, { moves: true, kept: true, count: found.all - 1, all: 41, fresh: true, back: true });
});

test('cameras have plans of their own, bands are blended, and without a caster all is lit', TIMEOUT, async () => {
  const found = await check('views');
  assert.deepEqual([found.twice, found.none, found.status], [true, true, 'no_caster']);
  assert.ok(found.bands.length > 0 && found.bands.every((band) => band >= found.blend - 1e-6 && found.blend > 0), JSON.stringify(found));
});

test('the camera is the one that PlayCanvas draws with', TIMEOUT, async () => {
  const { found, at, ahead } = await check('cameras');
  for (let i = 0; i < 3; ++i) assert.ok(Math.abs(found.position[i] - at[i]) < 1e-4 && Math.abs(found.forward[i] - ahead[i]) < 1e-5);
  assert.ok(Math.abs(found.farDepth - 100) < 1e-6 && Math.abs(found.nearDepth - 0.2) < 1e-4 && found.width === 320 && found.height === 180);
});

test('what is no light, engine or module is refused by name', TIMEOUT, async () => {
  const found = await check('refused');
  const fields = Object.fromEntries(Object.entries(found).map(([name, [field]]) => [name, field]));
  assert.deepEqual(fields, {
    module: 'gnomon', app: 'app', light: 'light', none: 'light', older: 'playcanvas', newer: 'playcanvas', gone: 'app', type: 'shadowType',
    twice: 'light', fit: 'plan_options.fit', overrides: 'shadowUpdateOverrides',
  });
  assert.match(found.older[1], /2\.22\.1/);
  assert.match(found.gone[1], /_shadowRendererDirectional/);
});

test('a flight of its cascades is the shipped capture', TIMEOUT, async () => {
  const capture = await check('captured');
  alike(capture, shipped('playcanvas_cascades'));
  // Its default bias is too small for a kernel of 3 x 3 texels.
  assert.deepEqual(judged(capture) ?? ['bias_small'], ['bias_small']);
});

for (const scene of ['street', 'low sun']) {
  test(`PlayCanvas misclassifies fewer pixels with the maps of gnomon: ${scene}`, TIMEOUT, async () => {
    const { rows } = await fly(scene, 512, 8, { engine: 'playcanvas' });
    const [theirs, ...ours] = rows;
    assert.deepEqual(ours.map(({ technique }) => technique), ['PlayCanvas, gnomon', 'PlayCanvas, gnomon, tight', 'PlayCanvas, gnomon, stable']);
    for (const row of ours) {
      console.log(`${scene}, ${row.technique}: ${(row.wrong / theirs.wrong).toFixed(2)} misclassified, ${(row.flips / theirs.flips).toFixed(2)} flips, acne ${row.acne.toFixed(5)} to ${theirs.acne.toFixed(5)}`);
      assert.ok(row.counted > 8 * 50000);
      assert.ok(row.wrong <= (row.technique.endsWith('stable') ? 0.8 : 0.7) * theirs.wrong && row.acne <= theirs.acne, JSON.stringify([theirs, row]));
    }
  });
}
