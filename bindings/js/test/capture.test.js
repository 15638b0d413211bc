// Does the capture writer for three.js write what `gnomon judge` reads? The shipped captures are made again by it, and compared.
// CONSUMER: where three is installed. GNOMON: see captures.js.
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import test from 'node:test';
import { pathToFileURL } from 'node:url';
import { captureFlight, captureThree, frameOf } from '../../../samples/capture/three.js';
import { alike, judged, shipped } from './captures.js';
import { boxes } from './street.js';

const consumer = process.env.CONSUMER;
const within = (path) => import(pathToFileURL(join(consumer, 'node_modules', path)));
const THREE = await import(pathToFileURL(createRequire(join(consumer, 'x.js')).resolve('three').replace('three.cjs', 'three.module.js')));
const { CSM } = await within('three/examples/jsm/csm/CSM.js');
const { SunLight } = await within('three/examples/jsm/lights/SunLight.js');
const canvas = { width: 960, height: 540 };

function street() {
  const scene = new THREE.Scene();
  for (let i = 0; i < boxes.length / 6; ++i) {
    const [x0, y0, z0, x1, y1, z1] = boxes.slice(6 * i, 6 * i + 6);
    const mesh = new THREE.Mesh(new THREE.BoxGeometry(x1 - x0, y1 - y0, z1 - z0), new THREE.MeshLambertMaterial());
    mesh.position.set((x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2);
    mesh.castShadow = mesh.receiveShadow = true;
    scene.add(mesh);
  }
  return scene;
}
function walk(camera, i) {
  camera.position.set(1.5 * Math.sin(i / 25), 4, 10 - 0.25 * i);
  camera.lookAt(camera.position.x + 14 * Math.sin(i / 18), 2.5, camera.position.z - 40);
  camera.updateMatrixWorld();
}
const eye = () => new THREE.PerspectiveCamera(60, 16 / 9, 0.5, 250);

test('a flight of the CSM add-on is the shipped one', () => {
  const scene = street(), camera = eye();
  walk(camera, 0);
  const csm = new CSM({ camera, parent: scene, cascades: 4, shadowMapSize: 1024, maxFar: 250, lightDirection: new THREE.Vector3(0.5, -1, -0.35).normalize() });
  csm.updateFrustums();
  const frames = Array.from({ length: 8 }, (_, i) => { walk(camera, i); csm.update(); return frameOf(scene, camera, canvas, { csm }); });
  const capture = JSON.parse(JSON.stringify(captureFlight(scene, frames, { name: 'three.js CSM, walk down a street', engine: 'three.js 0.187' })));
  alike(capture, shipped('three_csm'));
  assert.deepEqual(judged(capture) ?? [], []);
});

test('a SunLight has its two maps, without their borders', () => {
  const scene = street(), camera = eye();
  const sun = new SunLight(0xffffff, 3);
  sun.position.set(-0.5, 1, 0.35);
  sun.castShadow = true;
  sun.shadow.mapSize.set(1024, 1024);
  sun.shadow.camera.far = 250;
  scene.add(sun);
  scene.updateMatrixWorld();
  const frames = Array.from({ length: 8 }, (_, i) => { walk(camera, i); return frameOf(scene, camera, canvas); });
  const capture = JSON.parse(JSON.stringify(captureFlight(scene, frames, { name: 'three.js SunLight, walk down a street', engine: 'three.js 0.187' })));
  alike(capture, shipped('three_sunlight'));
  assert.equal(capture.frames[0].maps[0].width, 1020);
  assert.deepEqual(judged(capture) ?? [], []);
});

test('a spot has one map, and front faces are told from back faces', () => {
  const scene = street(), camera = eye();
  walk(camera, 0);
  const spot = new THREE.SpotLight(0xffffff, 100, 40, 0.7);
  spot.position.set(2, 9, -20);
  spot.target.position.set(-2, 0, -30);
  spot.castShadow = true;
  spot.shadow.mapSize.set(1024, 1024);
  scene.add(spot, spot.target);
  scene.updateMatrixWorld();
  const capture = JSON.parse(JSON.stringify(captureThree(scene, camera, canvas, { name: 'three.js SpotLight, street', engine: 'three.js 0.187' })));
  alike(capture, shipped('three_spot'));
  scene.traverse((mesh) => { if (mesh.isMesh) mesh.material.shadowSide = THREE.DoubleSide; });
  assert.equal(frameOf(scene, camera, canvas).maps[0].stores, undefined);
});

test('a point light has the six faces of its cube', () => {
  const scene = street(), camera = eye();
  walk(camera, 0);
  const lamp = new THREE.PointLight(0xffffff, 100, 60);
  lamp.position.set(0, 6, -20);
  lamp.castShadow = true;
  lamp.shadow.mapSize.set(1024, 1024);
  scene.add(lamp);
  scene.updateMatrixWorld();
  const capture = JSON.parse(JSON.stringify(captureThree(scene, camera, canvas, { name: 'three.js PointLight, street', engine: 'three.js 0.187' })));
  alike(capture, shipped('three_point'));
  // Nothing above the lamp is in view, and three draws that face.
  assert.deepEqual(judged(capture) ?? ['map_unseen'], ['map_unseen']);
});
