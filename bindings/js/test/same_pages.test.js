// Do pages and lights have the bits of the native library, with SIMD and without? CASES and MORE name the files of c_dump_cases, and
// MODULE the package as it is installed.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import test from 'node:test';
import { structs } from '../layout.js';
import { readCases } from './cases.js';

const { load } = await import(new URL('full.js', process.env.MODULE === undefined ? new URL('../x', import.meta.url) : `file://${process.env.MODULE}`));
const cases = readCases(process.env.CASES);
const more = readFileSync(process.env.MORE);

/** Bytes of a struct as the object that the module reads from them. */
function objectOf({ memory }, struct, bytes) {
  return memory.scratch(structs[struct].bytes + 64, () => {
    const at = memory.allocate(structs[struct].bytes);
    new Uint8Array(memory.exports.memory.buffer, at, bytes.length).set(bytes);
    return memory.read(struct, at);
  });
}

for (const simd of [true, false]) {
  test(`pages and lights have the bits of the native library, ${simd ? 'with' : 'without'} SIMD`, async () => {
    const gnomon = await load({ simd });
    const policies = gnomon.names('pagePolicies').map(({ name }) => name);
    const found = { pages: 0, levels: 0, lights: 0 };
    let at = 0;
    const take = (bytes) => more.subarray(at, (at += bytes));
    const expected = (struct) => objectOf(gnomon, struct, take(structs[struct].bytes));
    for (const [index, one] of cases.entries()) {
      const camera = objectOf(gnomon, 'camera', one.camera);
      const light = objectOf(gnomon, 'light', one.light);
      const view = { camera, casters: one.casters, receivers: one.receivers };
      const options = { policy: policies[index % policies.length], capacity: 64 << (index % 4) };
      const status = take(4).readInt32LE();
      const run = () => gnomon.planPages({ ...view, light, options });
      if (status === 3) {
        assert.throws(run, { name: 'GnomonError' }, `case ${index}`);
      } else {
        const plan = run();
        assert.equal(plan.status, ['ok', 'nothing_visible', 'no_caster'][status], `case ${index}`);
        if (status === 0) {
          assert.equal(plan.pageCount, take(4).readInt32LE(), `case ${index}`);
          assert.equal(plan.levelCount, take(4).readInt32LE());
          assert.equal(plan.targetM, take(8).readDoubleLE());
          for (const page of plan.pages) {
            assert.deepStrictEqual(page, expected('page'));
            ++found.pages;
          }
          for (let i = 0; i < plan.levelCount; ++i) {
            assert.deepStrictEqual(plan.level(i), expected('map'), `case ${index}, level ${i}`);
            ++found.levels;
          }
          const { texelsPerPixel, ...stats } = plan.measure(view);
          assert.deepStrictEqual(stats, expected('stats'));
          assert.equal(texelsPerPixel, take(8).readDoubleLE());
        }
        plan.dispose();
      }
      const range = camera.nearDepth * 400;
      const local = { position: camera.position.map((p, k) => p + (k === 1 ? 0.05 : -0.02) * range), direction: camera.forward, range };
      const lights = [{ light, weight: 1 }, { light: { ...local, kind: 'point' }, weight: 2 }, { light: { ...local, kind: 'spot', outerRadians: 0.5 }, weight: 3 }];
      const divide = () => gnomon.planLights({ ...view, lights });
      const divided = take(4).readInt32LE();
      if (divided === 3) {
        assert.throws(divide, { name: 'GnomonError' }, `case ${index}`);
        continue;
      }
      const { lights: all, status: outcome } = divide();
      assert.equal(outcome, ['ok', 'nothing_visible', 'no_caster'][divided], `case ${index}`);
      assert.equal(all.length, 3);
      for (const maps of all) {
        const { outcome, place, mapCount, ...rest } = expected('light_maps');
        assert.deepStrictEqual(maps, { outcome: ['mapped', 'belowLeastSize', 'withoutReceiver', 'withoutCaster'][outcome], places: place.slice(0, mapCount), ...rest }, `case ${index}`);
        ++found.lights;
      }
    }
    assert.equal(at, more.length);
    assert.ok(found.pages > 1000 && found.levels > 300 && found.lights > 300, JSON.stringify(found));
  });
}
