// Do plans and errors have the bits of the native library, with SIMD and without? CASES names the file of c_dump_cases, and
// MODULE the package as it is installed.
import assert from 'node:assert/strict';
import test from 'node:test';
import { structs } from '../layout.js';
import { readCases } from './cases.js';

const { load } = await import(process.env.MODULE ?? '../index.js');
const cases = readCases(process.env.CASES);

/** Bytes of a struct as the object that the module reads from them. */
function objectOf(gnomon, struct, bytes) {
  const { memory } = gnomon;
  return memory.scratch(structs[struct].bytes + 64, () => {
    const at = memory.allocate(structs[struct].bytes);
    new Uint8Array(memory.exports.memory.buffer, at, bytes.length).set(bytes);
    return memory.read(struct, at);
  });
}
/** Options have one field that a plan takes by names. */
function optionsOf(gnomon, bytes) {
  const { prune, ...options } = objectOf(gnomon, 'plan_options', bytes);
  return { ...options, prune: gnomon.names('pruneRules').map((rule) => rule.name).filter((_, i) => (prune >>> i) & 1) };
}

for (const simd of [true, false]) {
  test(`plans and errors have the bits of the native library, ${simd ? 'with' : 'without'} SIMD`, async () => {
    const gnomon = await load({ simd });
    const found = { ok: 0, invalid: 0, maps: 0 };
    for (const [index, one] of cases.entries()) {
      const input = { camera: objectOf(gnomon, 'camera', one.camera), casters: one.casters, receivers: one.receivers };
      const run = () => gnomon.plan({ ...input, light: objectOf(gnomon, 'light', one.light), options: optionsOf(gnomon, one.options) });
      if (one.status === 3) {
        assert.throws(run, { name: 'GnomonError' }, `case ${index}`);
        ++found.invalid;
        continue;
      }
      const plan = run();
      assert.equal(plan.status, ['ok', 'nothing_visible', 'no_caster'][one.status], `case ${index}`);
      assert.equal(plan.maps.length, one.mapCount);
      for (const [i, bytes] of one.maps.entries()) {
        // Object.is tells -0 from 0, and deepStrictEqual uses it.
        assert.deepStrictEqual(plan.maps[i], objectOf(gnomon, 'map', bytes), `case ${index}, map ${i}`);
        ++found.maps;
      }
      if (one.status !== 0) continue;
      ++found.ok;
      const stats = gnomon.measure(plan, { ...input, grid: { columns: 9, rows: 9, depths: 7 } });
      assert.deepStrictEqual(stats, objectOf(gnomon, 'stats', one.stats), `case ${index}`);
    }
    assert.ok(found.ok > 100 && found.maps > 200 && found.invalid + found.ok <= cases.length, JSON.stringify(found));
  });
}
