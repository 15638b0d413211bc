// What the adapter hands to Babylon.js, without drawing: matrices, depths, bounds, lists of casters, biases. CONSUMER: where
// @babylonjs/core is installed.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import test from 'node:test';
import { pathToFileURL } from 'node:url';

const within = (path) => import(pathToFileURL(join(process.env.CONSUMER, 'node_modules', path)));
const { NullEngine } = await within('@babylonjs/core/Engines/nullEngine.js');
const { Scene } = await within('@babylonjs/core/scene.js');
const { FreeCamera } = await within('@babylonjs/core/Cameras/freeCamera.js');
const { DirectionalLight } = await within('@babylonjs/core/Lights/directionalLight.js');
const { PointLight } = await within('@babylonjs/core/Lights/pointLight.js');
const { ShadowGenerator } = await within('@babylonjs/core/Lights/Shadows/shadowGenerator.js');
const { CascadedShadowGenerator } = await within('@babylonjs/core/Lights/Shadows/cascadedShadowGenerator.js');
const { InternalTexture, InternalTextureSource } = await within('@babylonjs/core/Materials/Textures/internalTexture.js');
const { Matrix, Vector3 } = await within('@babylonjs/core/Maths/math.vector.js');
const { CreateBox } = await within('@babylonjs/core/Meshes/Builders/boxBuilder.js');
const { load } = await within('gnomon/index.js');
const { GnomonCascadedShadowGenerator, GnomonShadow, biasOf, cameraOf, radiusOf } = await within('gnomon/babylon.js');
const gnomon = await load();

function world({ rightHanded = false, reversedDepth = false } = {}) {
  const engine = new NullEngine({ renderWidth: 960, renderHeight: 540, textureSize: 512 });
  // What it lacks to make the textures of a shadow generator.
  engine._createDepthStencilTexture = () => new InternalTexture(engine, InternalTextureSource.DepthStencil);
  engine._features.supportCSM = engine._features.supportShadowSamplers = true;
  engine.useReverseDepthBuffer = reversedDepth;
  const scene = new Scene(engine);
  scene.useRightHandedSystem = rightHanded;
  const side = rightHanded ? -1 : 1;
  const camera = new FreeCamera('camera', new Vector3(0, 4, -12 * side), scene);
  camera.minZ = 0.2;
  camera.maxZ = 250;
  camera.setTarget(new Vector3(0, 3, 40 * side));
  const light = new DirectionalLight('sun', new Vector3(0.5, -1, -0.35 * side), scene);
  const meshes = [[80, 1, 220, 0, -0.5, 90], [4, 8, 4, 3, 4, 20], [4, 5, 4, -6, 2.5, 60]].map(([width, height, depth, x, y, z], i) => {
    const mesh = CreateBox(`box ${i}`, { width, height, depth }, scene);
    mesh.position.set(x, y, side * z);
    mesh.receiveShadows = true;
    mesh.computeWorldMatrix(true);
    return mesh;
  });
  scene.updateTransformMatrix(true);
  return { scene, camera, light, meshes };
}
function cascaded(from, options) {
  const generator = new GnomonCascadedShadowGenerator(gnomon, 512, from.light, { options });
  for (const mesh of from.meshes) generator.addShadowCaster(mesh);
  return generator;
}
const begin = (generator) => generator.getShadowMap().onBeforeBindObservable.notifyObservers(generator.getShadowMap());

for (const rightHanded of [false, true]) {
  test(`each cascade has the matrix of its map, and serves its depths: ${rightHanded ? 'right' : 'left'}-handed`, () => {
    const from = world({ rightHanded });
    const generator = cascaded(from);
    begin(generator);
    const { maps } = generator.plan;
    assert.ok(maps.length >= 2 && maps.length <= 4);
    const found = cameraOf(gnomon, from.camera);
    assert.ok(Math.abs(found.position[1] - 4) < 1e-4 && found.forward[2] * (rightHanded ? -1 : 1) > 0.9 && Math.abs(found.farDepth - 250) < 0.1);
    maps.forEach((map, i) => {
      assert.deepEqual([...generator.getCascadeTransformMatrix(i).m], [...Float32Array.from(map.clipFromWorld)]);
      assert.equal(generator._viewSpaceFrustumsZ[i], map.depthEnd);
      // Its band is the next map's overlap.
      const band = generator._frustumLengths[i] * generator.cascadeBlendPercentage;
      assert.ok(Math.abs(band - (maps[i + 1]?.overlap ?? 0)) < 1e-5);
      // Babylon's maps look along +z with x to the right in a left-handed world: the determinant is positive, in both.
      assert.ok(generator.getCascadeTransformMatrix(i).determinant() > 0);
      // What the light reaches last is deepest.
      const at = (t) => Vector3.TransformCoordinates(from.light.direction.normalizeToNew().scale(t), generator.getCascadeTransformMatrix(i)).z;
      assert.ok(at(1) > at(0));
    });
    generator.dispose();
    assert.throws(() => generator.history.clear(), { field: 'disposed' });
  });
}

test('reversed depth gives matrices of reversed depth', () => {
  const from = world({ reversedDepth: true });
  const generator = cascaded(from);
  begin(generator);
  assert.equal(generator.plan.clipSpace.reversedZ, true);
  const at = (t) => Vector3.TransformCoordinates(from.light.direction.normalizeToNew().scale(t), generator.getCascadeTransformMatrix(0)).z;
  assert.ok(at(1) < at(0));
  generator.dispose();
});

test('each map draws the meshes that cast into it, and follows those that move, come and go', () => {
  const from = world();
  const generator = cascaded(from);
  const texture = generator.getShadowMap();
  begin(generator);
  generator.plan.maps.forEach((map, i) => {
    assert.deepEqual(texture.getCustomRenderList(i).map((mesh) => mesh.name), [...gnomon.cull(map, generator.bounds.casters)].map((k) => from.meshes[k].name));
  });
  const set = generator.bounds.casters;
  begin(generator);
  assert.equal(generator.bounds.casters, set);
  const drawn = () => generator.plan.maps.flatMap((map, i) => texture.getCustomRenderList(i));
  assert.ok(drawn().includes(from.meshes[1]));
  from.meshes[1].position.z = -500;
  from.meshes[1].computeWorldMatrix(true);
  begin(generator);
  assert.equal(generator.bounds.casters, set);
  assert.ok(!drawn().includes(from.meshes[1]));
  from.meshes[2].setEnabled(false);
  begin(generator);
  assert.equal(generator.bounds.casters.count, 2);
  assert.equal(generator.bounds.receivers.count, 2);
  const late = CreateBox('late', {}, from.scene);
  late.position.set(0, 1, 5);
  late.computeWorldMatrix(true);
  generator.addShadowCaster(late);
  begin(generator);
  assert.deepEqual(generator.bounds.meshes.map(({ name }) => name), ['box 0', 'box 1', 'late']);
  assert.ok(texture.getCustomRenderList(0).includes(late));
  generator.dispose();
});

test('without a caster no cascade serves a depth, and nothing is drawn', () => {
  const from = world();
  const generator = new GnomonCascadedShadowGenerator(gnomon, 512, from.light);
  begin(generator);
  assert.equal(generator.plan.status, 'no_caster');
  for (let i = 0; i < 4; ++i) {
    assert.ok(generator._viewSpaceFrustumsZ[i] < 0);
    assert.deepEqual(generator.getShadowMap().getCustomRenderList(i, from.meshes, 3), []);
    // A look-up has a depth within the map, which is cleared to the largest.
    const { z } = Vector3.TransformCoordinates(new Vector3(3, 4, 5), generator.getCascadeTransformMatrix(i));
    assert.ok(z > -1 && z < 1);
  }
  generator.dispose();
});

test('sizes, cascades and cameras may change, and filters that do not divide by w get no warp', () => {
  const from = world();
  const generator = cascaded(from);
  begin(generator);
  const warped = () => generator.plan.maps.some(({ clipFromWorld: m }) => m[3] !== 0 || m[7] !== 0 || m[11] !== 0);
  assert.ok(warped());
  generator.mapSize = 256;
  generator.numCascades = 3;
  begin(generator);
  assert.ok(generator.plan.maps.length <= 3 && generator.plan.maps[0].width <= 256);
  assert.ok(generator.getShadowMap().getCustomRenderList(0).length > 0);
  generator.filter = ShadowGenerator.FILTER_NONE;
  begin(generator);
  assert.ok(!warped());
  // Babylon forgets the casters then.
  generator.camera = from.camera;
  for (const mesh of from.meshes) generator.addShadowCaster(mesh);
  begin(generator);
  assert.equal(generator.plan.status, 'ok');
  generator.shadowMaxZ = 30;
  generator.history.clear();  // what it keeps may end later
  begin(generator);
  assert.ok(generator.plan.maps.at(-1).depthEnd <= 30 + 1e-9);
  generator.dispose();
});

test('while a map is drawn the generator has its bias', () => {
  const from = world();
  const generator = cascaded(from);
  const texture = generator.getShadowMap();
  const engine = from.scene.getEngine();
  begin(generator);
  const { maps } = generator.plan;
  maps.forEach((map, i) => {
    texture.onBeforeRenderObservable.notifyObservers(i);
    assert.ok(generator.bias > 0 && Math.abs(generator.bias - (2 * map.biasConstant) / map.depthRangeWorld) < 1e-12);
    generator.onBeforeShadowMapRenderMeshObservable.notifyObservers(from.meshes[0]);
    assert.equal(engine._depthCullingState.zOffset, 3);
    generator.onAfterShadowMapRenderMeshObservable.notifyObservers(from.meshes[0]);
    assert.equal(engine._depthCullingState.zOffset, 0);
  });
  generator.forceBackFacesOnly = true;
  texture.onBeforeRenderObservable.notifyObservers(0);
  assert.equal(generator.bias, 0);
  generator.dispose();
});

test('biases are depths of clip space, and slopes are offsets of depth textures alone', () => {
  const map = { biasConstant: 0.02, depthRangeWorld: 40, texelWorld: [0.1, 0.2] };
  const pcf = biasOf(map, { filter: ShadowGenerator.FILTER_PCF, radius: 2.5 });
  assert.ok(Math.abs(pcf.bias - 0.001) < 1e-12 && pcf.slope === 3 && pcf.normalBias === 0);
  // A grid of fit stable: 0.9 of the kernel's 2.5 texels of 0.2 more, as its texels are all that large.
  const stable = biasOf({ ...map, snapValid: true }, { filter: ShadowGenerator.FILTER_PCF, radius: 2.5 });
  assert.ok(Math.abs(stable.bias - 2 * (0.0005 + 0.45 / 40)) < 1e-12 && stable.slope === 3);
  const none = biasOf(map, { filter: ShadowGenerator.FILTER_NONE, radius: 0.5 });
  assert.ok(Math.abs(none.bias - 0.0005) < 1e-12 && none.slope === 0 && Math.abs(none.normalBias - 0.2) < 1e-12);
  assert.deepEqual(biasOf(map, { filter: ShadowGenerator.FILTER_PCF, radius: 2.5, backFaces: true }), { bias: 0, normalBias: 0, slope: 0 });
  const radius = (filter, filteringQuality) => radiusOf({ filter, filteringQuality, blurKernel: 1, blurScale: 2 });
  assert.deepEqual([ShadowGenerator.QUALITY_HIGH, ShadowGenerator.QUALITY_MEDIUM, ShadowGenerator.QUALITY_LOW].map((q) => radius(ShadowGenerator.FILTER_PCF, q)), [2.5, 1.5, 1]);
});

test('a single generator takes the map by the hook of its light, and gives it back', () => {
  const from = world();
  const generator = Object.assign(new ShadowGenerator(512, from.light), { usePercentageCloserFiltering: true });
  for (const mesh of from.meshes) generator.addShadowCaster(mesh);
  const own = generator.getTransformMatrix().clone();
  const shadow = new GnomonShadow(gnomon, generator);
  begin(generator);
  from.scene.incrementRenderId();
  const [map] = shadow.plan.maps;
  const matrix = generator.getTransformMatrix();
  const clip = Matrix.FromArray(map.clipFromWorld);
  for (const mesh of from.meshes) {
    const place = Vector3.TransformCoordinates(mesh.position, matrix);
    assert.ok(Vector3.Distance(place, Vector3.TransformCoordinates(mesh.position, clip)) < 1e-3);
    // Babylon lights what is beyond 0..1 before the division by w.
    const depth = 0.5 * Vector3.TransformNormal(mesh.position, matrix).z + 0.5 * matrix.m[14] + 0.5;
    assert.ok(depth > 0 && depth < 1);
  }
  generator.mapSize = 256;
  begin(generator);
  from.scene.incrementRenderId();
  generator.getTransformMatrix();
  assert.ok(shadow.plan.maps[0].width <= 256);
  shadow.dispose();
  assert.equal(from.light.customProjectionMatrixBuilder, undefined);
  from.scene.incrementRenderId();
  assert.ok(generator.getTransformMatrix().m.every((value, i) => Math.abs(value - own.m[i]) < 1e-6));
  assert.equal(generator.getShadowMap().getCustomRenderList, null);
});

test('what is no light, generator or module is refused by name', () => {
  const from = world();
  const point = new PointLight('lamp', new Vector3(0, 4, 0), from.scene);
  assert.throws(() => new GnomonCascadedShadowGenerator(gnomon, 512, point), { name: 'GnomonError', field: 'light' });
  assert.throws(() => new GnomonCascadedShadowGenerator(gnomon, 512, undefined), { field: 'light' });
  assert.throws(() => new GnomonCascadedShadowGenerator({}, 512, from.light), { field: 'gnomon' });
  assert.throws(() => new GnomonShadow(gnomon, {}), { field: 'generator' });
  assert.throws(() => new GnomonShadow(gnomon, new CascadedShadowGenerator(512, from.light)), { field: 'generator' });
  assert.throws(() => new GnomonShadow(gnomon, new ShadowGenerator(512, point)), { field: 'light' });
  const generator = cascaded(from, { fit: 'loose' });
  assert.throws(() => begin(generator), { field: 'plan_options.fit' });
  generator.dispose();
});
