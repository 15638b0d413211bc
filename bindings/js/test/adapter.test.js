// What the adapter hands to three.js, without drawing: matrices, depths, bounds and biases. CONSUMER: where three is installed.
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import test from 'node:test';
import { pathToFileURL } from 'node:url';

const consumer = process.env.CONSUMER;
const within = (path) => import(pathToFileURL(join(consumer, 'node_modules', path)));
const THREE = await import(pathToFileURL(createRequire(join(consumer, 'x.js')).resolve('three').replace('three.cjs', 'three.module.js')));
const { SunLight } = await within('three/examples/jsm/lights/SunLight.js');
const { load } = await within('gnomon/index.js');
const { GnomonCSM, GnomonSunShadow, ShadowBounds, biasOf } = await within('gnomon/three.js');
const gnomon = await load();

function scene({ casts = true, material = new THREE.MeshLambertMaterial() } = {}) {
  const all = new THREE.Scene();
  for (const [width, height, depth, x, y, z] of [[80, 1, 220, 0, -0.5, -90], [4, 8, 4, 3, 4, -20], [4, 5, 4, -6, 2.5, -60]]) {
    const mesh = new THREE.Mesh(new THREE.BoxGeometry(width, height, depth), material);
    mesh.position.set(x, y, z);
    mesh.castShadow = casts;
    mesh.receiveShadow = true;
    all.add(mesh);
  }
  return all;
}
function camera() {
  const found = new THREE.PerspectiveCamera(57, 16 / 9, 0.2, 250);
  found.position.set(0, 4, 12);
  found.updateMatrixWorld();
  return found;
}
function sunOf(from, options) {
  const sun = new SunLight();
  sun.position.set(-0.5, 1, 0.35);
  sun.updateMatrixWorld();
  sun.shadow = new GnomonSunShadow(gnomon, from, options);
  return sun;
}

test('each cascade draws with the matrix of its map, and serves its depths', () => {
  const sun = sunOf(scene());
  const { shadow } = sun;
  shadow.updateMatrices(sun, camera());
  assert.equal(shadow.plan.maps.length, 2);
  shadow.plan.maps.forEach((map, i) => {
    assert.deepEqual([...shadow.getCamera(i).projectionMatrix.elements], [...map.clipFromWorld]);
    assert.equal(shadow._cascadeData[i].y, map.depthEnd);
    // A look-up takes the middle of the map to the middle of its half of the texture, and its depth to 0..1.
    const middle = new THREE.Vector3(0, 0, 0).applyMatrix4(shadow.getCamera(i).projectionMatrixInverse).applyMatrix4(shadow.getMatrix(i));
    assert.ok(Math.abs(middle.x - (0.25 + 0.5 * i)) < 1e-6 && Math.abs(middle.y - 0.5) < 1e-6 && Math.abs(middle.z - 0.5) < 1e-6);
  });
  // The second cascade begins with the band in which the first one fades.
  assert.ok(shadow._cascadeData[1].x < shadow._cascadeData[0].y && shadow._cascadeData[0].z < shadow._cascadeData[0].y);
  sun.dispose();
  assert.throws(() => shadow.updateMatrices(sun, camera()), { field: 'disposed' });
});

test('without a caster no cascade serves a depth, and nothing is drawn', () => {
  const sun = sunOf(scene({ casts: false }));
  sun.shadow.updateMatrices(sun, camera());
  assert.equal(sun.shadow.plan.status, 'no_caster');
  for (const i of [0, 1]) {
    assert.ok(!(sun.shadow._cascadeData[i].x < sun.shadow._cascadeData[i].y));
    assert.equal(sun.shadow.getFrustum(i).intersectsSphere(new THREE.Sphere(new THREE.Vector3(), 1e6)), false);
  }
  sun.dispose();
});

test('reversed depth gives matrices of reversed depth', () => {
  const sun = sunOf(scene());
  sun.shadow.camera._reversedDepth = true;
  sun.shadow.updateMatrices(sun, camera());
  const [map] = sun.shadow.plan.maps;
  assert.equal(sun.shadow.plan.clipSpace.reversedZ, true);
  const near = new THREE.Vector3(0, 0, 1).applyMatrix4(new THREE.Matrix4().fromArray(map.clipFromWorld).invert());
  const far = new THREE.Vector3(0, 0, 0).applyMatrix4(new THREE.Matrix4().fromArray(map.clipFromWorld).invert());
  assert.ok(far.sub(near).dot(new THREE.Vector3().fromArray(sun.shadow.plan.lightDirection)) > 0);
  sun.dispose();
});

test('the lights of CSM take the maps, and its shader their depths', () => {
  const from = scene();
  const view = camera();
  const csm = new GnomonCSM(gnomon, { parent: from, camera: view, cascades: 4, maxFar: 250, shadowMapSize: 512, lightDirection: new THREE.Vector3(0.5, -1, -0.35) });
  csm.update();
  const { maps } = csm.plan;
  assert.ok(maps.length >= 2 && maps.length <= 4);
  maps.forEach((map, i) => {
    assert.deepEqual([...csm.lights[i].shadow.camera.projectionMatrix.elements], [...map.clipFromWorld]);
    assert.ok(Math.abs(csm.breaks[i] - map.depthEnd / (250 - 0.2)) < 1e-12);
  });
  assert.equal(csm.breaks.length, 4);
  csm.remove();
  csm.dispose();
});

test('bounds follow the meshes when they are updated', () => {
  const from = scene();
  const bounds = new ShadowBounds(gnomon, from);
  assert.equal(bounds.casters.count, 3);
  assert.equal(bounds.frontFaces, false);
  from.children[2].castShadow = false;
  from.children[1].material = new THREE.MeshLambertMaterial({ side: THREE.DoubleSide });
  const many = new THREE.InstancedMesh(new THREE.BoxGeometry(), new THREE.MeshLambertMaterial(), 2);
  many.setMatrixAt(0, new THREE.Matrix4().makeTranslation(-20, 0, 0));
  many.setMatrixAt(1, new THREE.Matrix4().makeTranslation(20, 0, 0));
  many.castShadow = true;
  from.add(many);
  bounds.update();
  assert.equal(bounds.casters.count, 3);
  assert.equal(bounds.receivers.count, 3);
  assert.equal(bounds.frontFaces, true);
  assert.ok(many.boundingBox.max.x === 20.5);
  bounds.dispose();
});

test('front faces have a bias, and the back faces that three draws have none', () => {
  const map = { biasConstant: 0.02, depthRangeWorld: 40 };
  assert.deepEqual(biasOf(map, { frontFaces: false }), { bias: 0, slope: 0 });
  const { bias, slope } = biasOf(map, { frontFaces: true, radius: 2 });
  assert.ok(Math.abs(bias + 0.0005) < 1e-12 && slope === 2.5);
});

test('casters with front faces are drawn with an offset by slope into the maps of gnomon alone', () => {
  const from = scene({ material: new THREE.MeshLambertMaterial({ side: THREE.DoubleSide }) });
  const [mesh] = from.children;
  let calls = 0;
  mesh.onBeforeShadow = () => ++calls;
  const sun = sunOf(from);
  sun.shadow.bounds.update();
  sun.shadow.updateMatrices(sun, camera());
  const material = new THREE.MeshDepthMaterial();
  const drawnInto = (shadowCamera) => {
    mesh.onBeforeShadow(undefined, mesh, undefined, shadowCamera, mesh.geometry, material, null);
    const drawn = [material.polygonOffset, material.polygonOffsetFactor];
    mesh.onAfterShadow(undefined, mesh, undefined, shadowCamera, mesh.geometry, material, null);
    return drawn;
  };
  assert.deepEqual(drawnInto(sun.shadow.getCamera(0)), [true, 1.5]);
  assert.deepEqual([material.polygonOffset, material.polygonOffsetFactor], [false, 0]);
  assert.deepEqual(drawnInto(new THREE.OrthographicCamera()), [false, 0]);
  assert.equal(calls, 2);
  sun.dispose();
});

test('the matrix of a CSM map holds when three makes its texture', () => {
  const csm = new GnomonCSM(gnomon, { parent: scene(), camera: camera(), cascades: 2, maxFar: 250, shadowMapSize: 512, lightDirection: new THREE.Vector3(0.5, -1, -0.35) });
  csm.update();
  const [{ shadow }] = csm.lights;
  const before = [...shadow.camera.projectionMatrix.elements];
  shadow.camera.updateProjectionMatrix();
  assert.deepEqual([...shadow.camera.projectionMatrix.elements], before);
  csm.dispose();
});
