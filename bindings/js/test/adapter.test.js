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
const { GnomonCSM, GnomonPointShadow, GnomonSpotShadow, GnomonSunShadow, ShadowBounds, biasOf, cameraOf } = await within('gnomon/three.js');
const { CubeSearch, FACES, coneOf } = await within('gnomon/cube.js');
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

function lampOf(from, options) {
  const lamp = new THREE.SpotLight(0xffffff, 1, 150, 0.7);
  lamp.position.set(0, 15, 0);
  lamp.target.position.set(0, 0, -30);
  lamp.shadow = new GnomonSpotShadow(gnomon, from, options);
  lamp.updateMatrixWorld();
  lamp.target.updateMatrixWorld();
  return lamp;
}

test('a spot draws with the matrix of its map, which is finer than that of its whole cone where the view sees a part', () => {
  const from = scene();
  const lamp = lampOf(from);
  const { shadow } = lamp;
  const view = camera();
  view.position.set(0, 4, -25);
  view.updateMatrixWorld();
  shadow.updateMatrices(lamp, view);
  const [map] = shadow.plan.maps;
  assert.equal(shadow.plan.maps.length, 1);
  assert.deepEqual([...shadow.getCamera(0).projectionMatrix.elements], [...map.clipFromWorld]);
  const middle = new THREE.Vector3(0, 0, 0).applyMatrix4(shadow.getCamera(0).projectionMatrixInverse).applyMatrix4(shadow.matrix);
  assert.ok(Math.abs(middle.x - 0.5) < 1e-6 && Math.abs(middle.y - 0.5) < 1e-6 && Math.abs(middle.z - 0.5) < 1e-6);
  const own = new THREE.SpotLight(0xffffff, 1, 150, 0.7);
  own.position.copy(lamp.position);
  own.target = lamp.target;
  own.updateMatrixWorld();
  own.shadow.updateMatrices(own);
  const clip = new THREE.Matrix4().multiplyMatrices(own.shadow.camera.projectionMatrix, own.shadow.camera.matrixWorldInverse);
  const foreign = { maps: [{ clipFromWorld: clip.elements, width: 512, height: 512, depthBegin: 0, depthEnd: 1e4, lightWorld: [...lamp.position, 1] }], selection: 'first_holding' };
  const input = { camera: cameraOf(gnomon, view, [1920, 1080]), receivers: shadow.bounds.receivers };
  const [ours, theirs] = [shadow.plan, foreign].map((plan) => gnomon.measure(plan, input));
  assert.ok(ours.outside === 0 && ours.p95 < 0.8 * theirs.p95, JSON.stringify([ours, theirs]));
  lamp.dispose();
  assert.throws(() => shadow.updateMatrices(lamp, camera()), { field: 'disposed' });
});

test('a spot with a picture, and one that is wider than a map, keep the map of three', () => {
  const lamp = lampOf(scene());
  const own = new THREE.SpotLight(0xffffff, 1, 150, 0.7);
  own.position.copy(lamp.position);
  own.target = lamp.target;
  own.updateMatrixWorld();
  own.shadow.updateMatrices(own);
  lamp.map = new THREE.Texture();
  lamp.shadow.updateMatrices(lamp, camera());
  assert.equal(lamp.shadow.plan, null);
  assert.deepEqual(lamp.shadow.matrix.elements, own.shadow.matrix.elements);
  assert.equal(lamp.shadow.getCamera(0), lamp.shadow.camera);
  lamp.map = null;
  lamp.angle = Math.PI / 2;
  lamp.shadow.updateMatrices(lamp, camera());
  assert.equal(lamp.shadow.plan, null);
  lamp.angle = 0.7;
  lamp.shadow.updateMatrices(lamp, camera());
  assert.equal(lamp.shadow.plan.status, 'ok');
  lamp.dispose();
});

test('a spot without a caster draws nothing, and front faces have a bias at the distance of its texels', () => {
  const dark = lampOf(scene({ casts: false }));
  dark.shadow.updateMatrices(dark, camera());
  assert.equal(dark.shadow.plan.status, 'no_caster');
  assert.equal(dark.shadow.getFrustum(0).intersectsSphere(new THREE.Sphere(new THREE.Vector3(), 1e6)), false);
  dark.dispose();
  const lamp = lampOf(scene({ material: new THREE.MeshLambertMaterial({ side: THREE.DoubleSide }) }));
  lamp.shadow.updateMatrices(lamp, camera());
  const { shadow } = lamp;
  const [map] = shadow.plan.maps;
  const depth = (y) => new THREE.Vector3(0, y, -20).applyMatrix4(shadow.matrix).z;
  // A step along the light that is a few times the bias, near the ground, changes the depth by about as many biases.
  const away = new THREE.Vector3(0, 0, -20).sub(lamp.position).normalize();
  const step = depth(0) - new THREE.Vector3(0, 0, -20).addScaledVector(away, -map.biasConstant).applyMatrix4(shadow.matrix).z;
  assert.ok(shadow.bias < 0 && -shadow.bias / step > 0.1 && -shadow.bias / step < 3, `${shadow.bias} ${step}`);
  assert.equal(shadow.getCamera(0).userData.gnomonSlope, 1.5);
  lamp.dispose();
});

test('boxes follow meshes that move, without being asked', () => {
  const from = scene();
  const sun = sunOf(from);
  sun.shadow.updateMatrices(sun, camera());
  const set = sun.shadow.bounds.casters;
  const [map] = sun.shadow.plan.maps;
  assert.ok(gnomon.cull(map, set).includes(1));
  from.children[1].position.z = 500;
  from.updateMatrixWorld();
  sun.shadow.updateMatrices(sun, camera());
  assert.equal(sun.shadow.bounds.casters, set);
  assert.ok(!gnomon.cull(sun.shadow.plan.maps[0], set).includes(1));
  sun.dispose();
});

test('what load() did not return is refused by name', () => {
  for (const make of [() => new ShadowBounds({}, scene()), () => new GnomonSunShadow(undefined, scene()), () => new GnomonSpotShadow(null, scene()), () => new GnomonPointShadow({}, scene())])
    assert.throws(make, { name: 'GnomonError', field: 'gnomon' });
  assert.throws(() => new GnomonPointShadow(gnomon, new THREE.Group()), { field: 'scene' });
});

function bulbOf(from, options) {
  const bulb = new THREE.PointLight(0xffffff, 1, 100);
  bulb.position.set(0, 6, -35);
  bulb.updateMatrixWorld();
  bulb.shadow = new GnomonPointShadow(gnomon, from, options);
  bulb.shadow.mapSize.set(512, 512);
  return bulb;
}
/** Of each of 60 points around the light: the face that a cube's look-up reads, and where three's shader looks and compares there. */
function lookUps({ matrix, camera }) {
  const found = [];
  for (let k = 0; k < 60; ++k) {
    const point = new THREE.Vector3(((k * 11) % 37) - 18.5, ((k * 7) % 23) - 5, ((k * 5) % 31) - 50.5);
    const d = point.clone().applyMatrix4(matrix).toArray();
    const out = [0, 1, 2].reduce((a, b) => (Math.abs(d[b]) > Math.abs(d[a]) ? b : a));
    const along = Math.abs(d[out]);
    const { near, far } = camera;
    // getPointShadow of three's shader, without a bias.
    const depth = (far * (along - near)) / (along * (far - near));
    const sign = Math.sign(d[out]);
    const [s, t] = [[-sign * d[2], -d[1]], [d[0], sign * d[2]], [sign * d[0], -d[1]]][out];
    found.push({ point, face: 2 * out + (sign > 0 ? 0 : 1), across: [s / along, t / along], depth });
  }
  return found;
}

test("three's look-up of a point light finds what its faces draw", () => {
  for (const fit of ['warped_stable', 'tight', 'stable']) {
    const bulb = bulbOf(scene(), { options: { fit } });
    const { shadow } = bulb;
    shadow.updateMatrices(bulb, camera());
    const found = lookUps(shadow);
    if (fit === 'stable') assert.equal(new Set(found.map(({ face }) => face)).size, 6);
    for (const { point, face, across, depth } of found) {
      const drawn = point.clone().applyMatrix4(shadow.getCamera(face).projectionMatrix);
      const off = [drawn.x - across[0], drawn.y - across[1], 0.5 * drawn.z + 0.5 - depth];
      assert.ok(Math.max(...off.map(Math.abs)) < 1e-5, `${fit} ${face} ${off}`);
    }
    bulb.dispose();
    assert.throws(() => shadow.updateMatrices(bulb, camera()), { field: 'disposed' });
  }
});

test('the cube of a point light is finer in view than the one of three, which a stable fit keeps', () => {
  const from = scene();
  const view = camera();
  const own = bulbOf(from, { options: { fit: 'stable' } });
  own.shadow.updateMatrices(own, view);
  const p = own.position;
  assert.ok(own.shadow.matrix.equals(new THREE.Matrix4().makeTranslation(-p.x, -p.y, -p.z)));
  const bulb = bulbOf(from);
  const before = process.cpuUsage();
  bulb.shadow.updateMatrices(bulb, view);
  const first = process.cpuUsage(before).user / 1e3;
  const input = { camera: cameraOf(gnomon, view, [1920, 1080], 140), receivers: own.shadow.bounds.receivers };
  const { receivers } = input;
  const six = gnomon.plan({ ...input, casters: receivers, light: { kind: 'point', position: p.toArray(), range: 100 }, options: { fit: 'tight', resolutionMaxSize: 512, filterTexels: 1 } });
  const [ours, theirs, fitted] = [bulb.shadow.plan, own.shadow.plan, six].map((plan) => gnomon.measure(plan, input));
  console.log(`mean m of a point light: ${theirs.mean.toFixed(2)} three's cube, ${fitted.mean.toFixed(2)} six maps of plan(), ${ours.mean.toFixed(2)} one matrix for six faces`);
  assert.ok(ours.samples > 1000 && ours.mean < 0.6 * theirs.mean && ours.mean < fitted.mean, JSON.stringify([ours, theirs, fitted]));
  // Its texels stay at their place for many frames; those of the tightest cube do not.
  const tight = bulbOf(from, { options: { fit: 'tight' } });
  const shapes = [new Set(), new Set()];
  const start = process.cpuUsage();
  for (let i = 0; i < 50; ++i) {
    view.position.z -= 0.25;
    view.updateMatrixWorld();
    [bulb, tight].forEach((one, k) => {
      one.shadow.updateMatrices(one, view);
      shapes[k].add(one.shadow.matrix.elements.join());
    });
  }
  console.log(`planning one: ${first.toFixed(0)} ms first, ${(process.cpuUsage(start).user / 100e3).toFixed(1)} ms then; ${shapes.map(({ size }) => size)} cubes in 50 frames`);
  assert.ok(shapes[0].size <= 5 && shapes[1].size >= 2 * shapes[0].size);
  for (const one of [own, bulb, tight]) one.dispose();
});

test('the fit of a point light may change from frame to frame', () => {
  const bulb = bulbOf(scene(), { options: { fit: 'stable' } });
  const { shadow } = bulb;
  const shapeBy = (fit) => {
    shadow.options.fit = fit;
    shadow.updateMatrices(bulb, camera());
    return shadow.matrix.clone().setPosition(0, 0, 0);
  };
  const own = new THREE.Matrix4();
  assert.ok(shapeBy('stable').equals(own));
  const stretched = shapeBy('tight');
  assert.ok(!stretched.equals(own));
  assert.ok(shapeBy('stable').equals(own));
  assert.ok(shapeBy('tight').equals(stretched), 'the first search is made again');
  assert.throws(() => shapeBy('loose'), { field: 'plan_options.fit' });
  bulb.dispose();
});

test('the cone of a face holds all of it, however the cube is sheared', () => {
  let most = 0;
  for (let k = 1; k <= 20; ++k) {
    const wanted = Array.from({ length: 9 }, (_, i) => Math.sin(7.3 * k + 2.1 * i * k));
    const search = new CubeSearch();
    search.follow(({ shape }) => shape.flat().reduce((sum, value, i) => sum + (value - wanted[i]) ** 2, 0));
    FACES.forEach(([across, along, out], face) => {
      const { axis, angle } = coneOf(search.cube, face);
      most = Math.max(most, angle);
      for (let at = 0; at < 81; ++at) {
        const [s, t] = [(at % 9) / 4 - 1, Math.floor(at / 9) / 4 - 1];
        const v = search.cube.direction([0, 1, 2].map((i) => out[i] + s * across[i] + t * along[i]));
        const off = new THREE.Vector3(...v).angleTo(new THREE.Vector3(...axis));
        assert.ok(off < angle + 1e-6, `cube ${k}, face ${face}: ${off} of ${angle}`);
      }
    });
  }
  // Sheared far enough that a cone about the middle of the corners would not hold its face.
  assert.ok(most > 1.4 && most < 0.5 * Math.PI, `${most}`);
});

test('faces of a point light draw nothing where nobody sees a shadow', () => {
  const from = scene();
  const bulb = bulbOf(from, { options: { fit: 'stable' } });
  const { shadow } = bulb;
  shadow.updateMatrices(bulb, camera());
  const seen = () => shadow._frustums.map((frustum) => frustum.intersectsSphere(new THREE.Sphere(bulb.position, 50)));
  // Nothing is above it.
  assert.deepEqual(seen(), [true, true, false, true, true, true]);
  assert.equal(shadow.plan.maps.length, 5);
  const away = camera();
  away.position.z = -100;
  away.updateMatrixWorld();
  shadow.updateMatrices(bulb, away);
  assert.equal(seen()[4], false);
  from.onBeforeRender(undefined, from, away, null);
  shadow.getFrustum(0);
  assert.equal(seen()[4], false);
  // Where the scene's handler was replaced, every face is drawn.
  shadow.getFrustum(0);
  assert.deepEqual(seen(), Array(6).fill(true));
  for (const mesh of from.children) mesh.position.z += 1000;
  from.updateMatrixWorld();
  shadow.updateMatrices(bulb, away);
  assert.equal(shadow.plan.status, 'nothing_visible');
  bulb.dispose();
  const dark = bulbOf(scene({ casts: false }));
  dark.shadow.updateMatrices(dark, camera());
  assert.deepEqual([dark.shadow.plan.status, dark.shadow.plan.maps.length], ['no_caster', 0]);
  dark.dispose();
});

test('a point light is planned for the camera that its scene is drawn with, and the near plane stays where it was set', () => {
  const from = scene();
  let calls = 0;
  from.onBeforeRender = () => ++calls;
  const bulb = bulbOf(from);
  const { shadow } = bulb;
  shadow.camera.near = 0.2;
  shadow.camera.position.copy(bulb.position);
  shadow.camera.far = 100;
  const away = camera();
  away.position.z = -100;
  away.updateMatrixWorld();
  from.onBeforeRender(undefined, from, away, null);
  shadow.getFrustum(0);
  assert.equal(calls, 1);
  assert.ok(shadow.plan.maps.length < 6);
  for (let i = 0; i < 2; ++i) {
    from.onBeforeRender(undefined, from, away, null);
    shadow.getFrustum(0);
    // What is cut away near the light reaches to 0.2.
    const most = Math.max(...shadow._cameras.flatMap(({ projectionMatrixInverse }) => [[-1, -1], [-1, 1], [1, -1], [1, 1]].map(([x, y]) => new THREE.Vector3(x, y, -1).applyMatrix4(projectionMatrixInverse).distanceTo(bulb.position))));
    assert.ok(Math.abs(most - 0.2) < 1e-5 && shadow.camera.near < 0.2, `${most}`);
  }
  bulb.dispose();
});

test('a stable grid is turned about the sun, holds what is in view, and stays at its place', () => {
  const view = camera();
  const data = { parent: scene(), camera: view, cascades: 4, maxFar: 250, shadowMapSize: 512, lightDirection: new THREE.Vector3(0.8, -0.28, 0.45), options: { fit: 'stable' } };
  const csm = new GnomonCSM(gnomon, data);
  csm.update();
  const before = csm.plan.maps.map(({ clipFromWorld }) => [...clipFromWorld]);
  const sizes = new Set();  // of the first slice
  for (let frame = 0; frame < 20; ++frame) {
    const { samples, outside } = gnomon.measure(csm.plan, { camera: cameraOf(gnomon, view, [1920, 1080], 250), receivers: csm.bounds.receivers });
    assert.ok(samples > 1000 && outside === 0, `${frame} ${outside} of ${samples}`);
    sizes.add(csm.plan.maps[0].clipFromWorld[0]);
    csm.plan.maps.forEach((map, k) => {
      const clip = new THREE.Matrix4().fromArray(map.clipFromWorld);
      // A step up in the world is no step along one axis of the texels.
      const up = new THREE.Vector3(0, 1, 0).transformDirection(clip);
      assert.ok(Math.abs(up.x) > 0.1 * Math.abs(up.y) && Math.abs(up.y) > 0.1 * Math.abs(up.x));
      // Whole texels, or another size of its slice.
      const moved = [12, 13].map((i) => ((map.clipFromWorld[i] - before[k][i]) * map.width) / 2);
      if (map.clipFromWorld[0] === before[k][0]) for (const texels of moved) assert.ok(Math.abs(texels - Math.round(texels)) < 1e-6, `${moved}`);
      else assert.ok(frame > 0);
    });
    view.position.add(new THREE.Vector3(0.31, 0.05, -1.3));
    view.rotateY(0.05);
    view.updateMatrixWorld();
    csm.update();
  }
  // The farthest receiver comes half an octave nearer at most once on the way.
  assert.ok(sizes.size <= 2);
  csm.remove();
  csm.dispose();
});

test('stable grids hold what an oblique camera sees, in left-handed worlds as well', () => {
  const boxes = new Float64Array([-300, -1, -300, 300, 0, 300, -5, 0, -30, 5, 20, -25, -5, 0, 25, 5, 20, 30]);
  for (const leftHanded of [false, true]) {
    for (const orthographic of [false, true]) {
      const across = orthographic ? 60 : 1;
      const eye = { ...gnomon.perspective({ position: [3, 20, 2], forward: [0.6, -0.5, -0.6], fovY: 1, far: 200, width: 640, height: 360 }), orthographic, left: -0.1 * across, right: 1.4 * across, bottom: -0.5 * across, top: 0.4 * across };
      const plan = gnomon.plan({ camera: eye, light: { direction: [0.8, -0.5, 0.4] }, casters: boxes, receivers: boxes, options: { fit: 'stable', resolutionMaxSize: 512, clipSpace: { leftHanded } } });
      assert.ok(plan.maps.length > 1 && plan.maps.every(({ snapValid }) => snapValid));
      const { samples, outside } = gnomon.measure(plan, { camera: eye, receivers: boxes });
      assert.ok(samples > 1000 && outside === 0, `${leftHanded} ${orthographic} ${outside} of ${samples}`);
    }
  }
});
