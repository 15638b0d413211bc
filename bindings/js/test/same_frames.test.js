// Do frames, atlases, clusters and pictures have the bits of the native library, with SIMD and without? FRAMES names the file of
// c_dump_frames, and MODULE the package as it is installed.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import test from 'node:test';
import { structs } from '../layout.js';

const { load } = await import(new URL('full.js', process.env.MODULE === undefined ? new URL('../x', import.meta.url) : `file://${process.env.MODULE}`));
const bytes = readFileSync(process.env.FRAMES);

/** The file of tests/c/dump_frames.cpp, in its order. */
class Frames {
  at = 0;
  constructor({ memory }) {
    this.memory = memory;
  }
  take(count) {
    this.at += count;
    assert.ok(this.at <= bytes.length);
    return bytes.buffer.slice(bytes.byteOffset + this.at - count, bytes.byteOffset + this.at);
  }
  /** A struct as the object that the module reads from it. */
  struct(name) {
    const { memory } = this;
    const taken = new Uint8Array(this.take(structs[name].bytes));
    return memory.scratch(taken.length + 16, () => {
      const at = memory.allocate(taken.length);
      new Uint8Array(memory.exports.memory.buffer, at, taken.length).set(taken);
      return memory.read(name, at);
    });
  }
  list(Kind, count) {
    return new Kind(this.take(count * Kind.BYTES_PER_ELEMENT));
  }
  count() {
    return this.list(Uint32Array, 1)[0];
  }
  /** `each` of a list that begins with its length. */
  all(each) {
    return Array.from({ length: this.count() }, each);
  }
}

/** The roof of slats of tests/c/dump_frames.cpp under a light that goes this way. */
const slatsOf = (way) => (x, y, z) => {
  const up = (6 - y) / -way[1];
  const at = x - way[0] * up + 0.4 * (z - way[2] * up);
  return at - 8 * Math.floor(at / 8) < 3 ? -Infinity : up;
};

for (const simd of [true, false]) {
  test(`all that changes from frame to frame has the bits of the native library, ${simd ? 'with' : 'without'} SIMD`, async () => {
    const gnomon = await load({ simd });
    const file = new Frames(gnomon);
    const [camera, sun, { prune, ...options }] = ['camera', 'light', 'plan_options'].map((name) => file.struct(name));
    options.prune = gnomon.names('pruneRules').map(({ name }) => name).filter((_, i) => (prune >>> i) & 1);
    const boxes = file.list(Float64Array, 6 * file.count());
    const plan = gnomon.plan({ camera, light: sun, casters: boxes, receivers: boxes, options });
    const maps = file.all(() => file.struct('map'));
    assert.ok(maps.length > 1);
    assert.deepStrictEqual(plan.maps, maps);

    for (let frames = file.count(); frames > 0; --frames) {
      const frame = Number(file.list(BigInt64Array, 1)[0]);
      const offset = file.list(Float64Array, 2);
      assert.deepStrictEqual(gnomon.jitterTexels(frame), offset);
      assert.deepStrictEqual(gnomon.jitter(plan, offset), { ...plan, maps: maps.map(() => file.struct('map')) });
    }
    assert.deepStrictEqual(plan.maps, maps, 'the plan itself has not moved');

    const points = file.list(Float64Array, 3 * file.count());
    let held, turns = 0;
    const suns = file.all(() => {
      const direction = file.list(Float64Array, 3);
      const found = gnomon.holdSun({ camera, points, held, sun: direction, casters: [-40, -1, -200, 40, 8, 20] });
      assert.deepStrictEqual(found, file.struct('held_sun'));
      held = found.direction;
      turns += held.every((part, i) => part === direction[i]) ? 1 : 0;
    });
    assert.ok(turns > 1 && turns < suns.length);

    const tracker = gnomon.depthTracker(...file.list(Int32Array, 2));
    let followed;
    file.all(() => {
      followed = tracker.update(file.list(Float32Array, file.count()));
      assert.deepStrictEqual(followed, file.struct('visible_depths'));
    });
    assert.ok(followed.min < followed.max);
    tracker.dispose();

    const placed = file.all(() => {
      const [width, height] = file.list(Int32Array, 2);
      const atlas = gnomon.packAtlas(plan, width, height);
      const { place, count, ...expected } = file.struct('atlas');
      assert.deepStrictEqual(atlas, { ...expected, places: place.slice(0, count) });
      for (let i = 0; i < count; ++i) assert.deepStrictEqual(gnomon.atlasFromClip(atlas, i, plan.clipSpace), file.list(Float64Array, 16));
      return count;
    });
    assert.deepEqual(placed, [maps.length, maps.length, 0]);

    const biases = file.all(() => {
      const [map, way] = file.list(Int32Array, 2);
      const bias = gnomon.engineBias(plan, map, { way: ['rasterizer', 'normalOffset'][way], kernelRadiusTexels: 1.5, depthBits: 24 });
      assert.deepStrictEqual(bias, file.struct('engine_bias'));
    });
    assert.equal(biases.length, 2 * maps.length);

    const lights = file.all(() => file.struct('light'));
    file.all(() => {
      const { begin, lights: list, ...found } = gnomon.clusterLights({ camera, lights, room: Number(file.list(BigInt64Array, 1)[0]) });
      assert.deepEqual([found.tilePixels, found.columns, found.rows, found.slices], [...file.list(Int32Array, 4)]);
      assert.deepStrictEqual(Float64Array.of(found.depthScale, found.depthOffset), file.list(Float64Array, 2));
      assert.deepStrictEqual(begin, file.list(Uint32Array, file.count()));
      assert.deepStrictEqual(list, file.list(Uint32Array, file.count()));
    });

    const pixels = file.count();
    assert.equal(pixels, camera.width * camera.height);
    const [mask, viewDepths, occluderDistances] = [1, 2, 3].map(() => file.list(Float32Array, pixels));
    const picture = { camera, mask, viewDepths };
    const averaged = { ...picture, kernelTexels: 1.5 };
    for (const one of [picture, averaged, { ...averaged, occluderDistances }]) assert.deepStrictEqual(gnomon.expectedError(plan, one), file.struct('wrong_pixels'));
    const occluderSearch = slatsOf(file.list(Float64Array, 3));
    const normals = file.list(Float32Array, 3 * pixels);
    const searched = gnomon.expectedError(plan, { ...averaged, occluderDistances, occluderSearch });
    assert.deepStrictEqual(searched, file.struct('wrong_pixels'));
    const facing = gnomon.expectedError(plan, { ...picture, occluderSearch, normals });
    assert.deepStrictEqual(facing, file.struct('wrong_pixels'));
    assert.ok(searched.wrong > 0 && facing.wrong > 0 && searched.wrong !== facing.wrong);
    const edges = file.list(Float64Array, 3 * file.count());
    assert.deepStrictEqual(gnomon.shadowEdgePoints(picture, edges.length / 3), edges);
    assert.equal(file.at, bytes.length);
  });
}
