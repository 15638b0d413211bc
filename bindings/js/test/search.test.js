// Does the search of docs/web.md count what maps get wrong? The street, by rays of three-mesh-bvh. CONSUMER: where that is installed.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import test from 'node:test';
import { pathToFileURL } from 'node:url';
import { boxes } from './street.js';

const consumer = process.env.CONSUMER;
const within = (path) => import(pathToFileURL(join(consumer, 'node_modules', path)));
const { BoxGeometry, DoubleSide, Ray, Vector3 } = await import(pathToFileURL(createRequire(join(consumer, 'x.js')).resolve('three').replace('three.cjs', 'three.module.js')));
const { mergeGeometries } = await within('three/examples/jsm/utils/BufferGeometryUtils.js');
const { MeshBVH } = await within('three-mesh-bvh/src/index.js');
const { load } = await within('gnomon/full.js');
const gnomon = await load();

const bvh = new MeshBVH(mergeGeometries(Array.from({ length: boxes.length / 6 }, (_, i) => {
  const [x0, y0, z0, x1, y1, z1] = boxes.slice(6 * i, 6 * i + 6);
  return new BoxGeometry(x1 - x0, y1 - y0, z1 - z0).translate((x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2);
})));
const [width, height] = [160, 100];
const camera = gnomon.perspective({ position: [0, 3, 10], forward: [0, 0, -1], fovY: 1, aspect: 1.6, near: 0.2, far: 250, width, height });
const toSun = new Vector3(-0.4, 1, 0.3).normalize();
const eye = new Vector3(...camera.position);
const mask = new Float32Array(width * height).fill(-1), viewDepths = new Float32Array(width * height);
for (let i = 0; i < mask.length; ++i) {
  const [u, v] = [((i % width) + 0.5) / width, (Math.floor(i / width) + 0.5) / height];
  const sight = new Vector3(camera.left + (camera.right - camera.left) * u, camera.top + (camera.bottom - camera.top) * v, -1);
  const hit = bvh.raycastFirst(new Ray(eye, sight.clone().normalize()), DoubleSide);
  if (hit === null) continue;
  viewDepths[i] = -(hit.point.z - eye.z);
  const lit = hit.face.normal.dot(toSun) > 0 && bvh.raycastFirst(new Ray(hit.point.addScaledVector(hit.face.normal, 1e-3), toSun), DoubleSide) === null;
  mask[i] = lit ? 1 : 0;
}

test('a search by a tree of triangles finds the errors of maps, fewer in finer ones', () => {
  const page = readFileSync(new URL('../../../docs/web.md', import.meta.url), 'utf8');
  const [code] = page.match(/^const fromSun = [^]*?(?=^```$)/m);
  const given = { Ray, DoubleSide, bvh, toSun, reach: 1000, gnomon, camera, mask, viewDepths };
  const expected = new Function('plan', ...Object.keys(given), `${code}; return { share, occluderSearch };`);
  const found = [256, 1024].map((resolutionMaxSize) => {
    const plan = gnomon.plan({ camera, light: { direction: toSun.clone().negate().toArray() }, casters: boxes, receivers: boxes, options: { resolutionMaxSize } });
    const { share, occluderSearch } = expected(plan, ...Object.values(given));
    const alone = gnomon.expectedError(plan, { camera, mask, viewDepths }).share;
    console.log(`${resolutionMaxSize}: ${(100 * share).toFixed(2)} % of the pixels by the search, ${(100 * alone).toFixed(2)} % by the picture alone`);
    assert.ok(share > 0.3 * alone && share < 3 * alone);
    assert.ok(Math.abs(occluderSearch(0, 0, 5)) < 1e-3 && occluderSearch(0, -50, 5) > 49 && occluderSearch(900, 0, 5) === -Infinity);
    return share;
  });
  assert.ok(found[0] < 0.05 && found[1] < 0.5 * found[0]);
});
