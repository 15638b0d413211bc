// Draws a street with three's own shadows and with gnomon's, and counts misclassified pixels against exact rays.
import * as THREE from 'three';
import { CSM } from 'three/addons/csm/CSM.js';
import { SunLight } from 'three/addons/lights/SunLight.js';
import { load } from 'gnomon';
import { GnomonCSM, GnomonSunShadow } from 'gnomon/three';
import { boxes } from './street.js';

const [width, height] = [640, 360];
const size = 512;
const toSun = new THREE.Vector3(-0.5, 1, 0.35).normalize();

const list = Array.from({ length: boxes.length / 6 }, (_, i) => boxes.slice(6 * i, 6 * i + 6));

/** The first box along a ray: distance, box and axis of the face; Infinity where there is none. */
function firstHit(origin, ray, skip) {
  let best = Infinity, face = -1, sign = 0;
  for (let b = 0; b < list.length; ++b) {
    let enter = -Infinity, leave = Infinity, axis = -1;
    const box = list[b];
    for (let a = 0; a < 3; ++a) {
      const [one, two] = [(box[a] - origin[a]) / ray[a], (box[a + 3] - origin[a]) / ray[a]];
      const [from, to] = one < two ? [one, two] : [two, one];
      if (from > enter) [enter, axis] = [from, a];
      if (to < leave) leave = to;
    }
    if (enter <= leave && enter > skip && enter < best) [best, face, sign] = [enter, axis, -Math.sign(ray[axis])];
  }
  return { distance: best, axis: face, sign };
}

/** Per pixel: cosine to the sun where it is lit, 0 in shadow, -1 where nothing can be said. */
function truth(camera) {
  const expected = new Float32Array(width * height).fill(-1);
  const eye = camera.position.toArray();
  const [sun, far] = [toSun.toArray(), new THREE.Vector3()];
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      far.set((2 * (x + 0.5)) / width - 1, (2 * (y + 0.5)) / height - 1, 0.5).unproject(camera).sub(camera.position).normalize();
      const ray = far.toArray();
      const hit = firstHit(eye, ray, 1e-6);
      if (hit.distance === Infinity) continue;
      const cosine = hit.sign * sun[hit.axis];
      // Where the sun grazes a surface, rounding of colours decides.
      if (cosine < 0.1) continue;
      const place = eye.map((v, i) => v + hit.distance * ray[i]);
      place[hit.axis] += 1e-6 * hit.sign;
      const blocked = firstHit(place, sun, 0).distance < Infinity;
      expected[y * width + x] = blocked ? 0 : cosine;
    }
  }
  return expected;
}

function streetScene(side) {
  const scene = new THREE.Scene();
  const material = new THREE.MeshLambertMaterial({ color: 0xffffff, shadowSide: side });
  for (const [x0, y0, z0, x1, y1, z1] of list) {
    const mesh = new THREE.Mesh(new THREE.BoxGeometry(x1 - x0, y1 - y0, z1 - z0), material);
    mesh.position.set((x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2);
    mesh.castShadow = mesh.receiveShadow = true;
    scene.add(mesh);
  }
  return { scene, material };
}

function compare(pixels, expected) {
  let counted = 0, falseShadow = 0, falseLight = 0;
  for (let i = 0; i < expected.length; ++i) {
    if (expected[i] < 0) continue;
    ++counted;
    const value = pixels[4 * i] / 255;
    if (expected[i] > 0 && value < 0.5 * expected[i]) ++falseShadow;
    if (expected[i] === 0 && value > 0.05) ++falseLight;
  }
  return { counted, falseShadow: falseShadow / counted, falseLight: falseLight / counted, wrong: (falseShadow + falseLight) / counted };
}

export async function run() {
  const gnomon = await load();
  const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
  renderer.setSize(width, height, false);
  renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
  renderer.shadowMap.enabled = true;
  document.body.append(renderer.domElement);
  const camera = new THREE.PerspectiveCamera(57, width / height, 0.2, 250);
  camera.position.set(0, 4, 12);
  camera.lookAt(0, 2, -30);
  camera.updateMatrixWorld();
  const expected = truth(camera);
  const gl = renderer.getContext();
  const results = {};

  const draw = (name, scene, each = () => {}) => {
    // Twice: the first frame compiles.
    for (let i = 0; i < 2; ++i) {
      each();
      renderer.render(scene, camera);
    }
    const pixels = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    results[name] = compare(pixels, expected);
  };
  const sun = (name, side, shadowOf, set = () => {}) => {
    const { scene } = streetScene(side);
    const light = new SunLight(0xffffff, Math.PI);
    light.position.copy(toSun);
    light.castShadow = true;
    if (shadowOf !== undefined) light.shadow = shadowOf(scene);
    light.shadow.mapSize.set(size, size);
    set(light.shadow);
    scene.add(light);
    draw(name, scene);
    const { plan } = light.shadow;
    if (plan) results[name].m = gnomon.measure(plan, { camera: gnomon.perspective({ position: camera.position.toArray(), forward: camera.getWorldDirection(new THREE.Vector3()).toArray(), fovY: (57 * Math.PI) / 180, aspect: width / height, near: 0.2, far: 250, width, height }), receivers: boxes }).p95;
    light.dispose();
  };
  const options = { resolution: [width, height] };
  sun('sun', undefined);
  sun('sun, gnomon stable', undefined, (scene) => new GnomonSunShadow(gnomon, scene, options));
  sun('sun, gnomon warped_stable', undefined, (scene) => new GnomonSunShadow(gnomon, scene, { ...options, options: { fit: 'warped_stable' } }));
  sun('sun, gnomon tight', undefined, (scene) => new GnomonSunShadow(gnomon, scene, { ...options, options: { fit: 'tight' } }));
  sun('sun, front faces', THREE.FrontSide, undefined, (shadow) => { shadow.bias = -0.0005; shadow.normalBias = 0.1; });
  sun('sun, front faces, gnomon tight', THREE.FrontSide, (scene) => new GnomonSunShadow(gnomon, scene, { ...options, options: { fit: 'tight' } }));

  const csm = (name, make) => {
    const { scene, material } = streetScene();
    const shadows = make({ parent: scene, camera, cascades: 4, maxFar: 250, shadowMapSize: size, lightDirection: toSun.clone().negate(), lightIntensity: Math.PI });
    shadows.setupMaterial(material);
    shadows.updateFrustums();
    draw(name, scene, () => shadows.update());
    shadows.remove();
    shadows.dispose();
  };
  csm('csm', (data) => new CSM(data));
  csm('csm, gnomon stable', (data) => new GnomonCSM(gnomon, { ...data, ...options }));
  csm('csm, gnomon warped_stable', (data) => new GnomonCSM(gnomon, { ...data, ...options, options: { fit: 'warped_stable' } }));
  csm('csm, gnomon tight', (data) => new GnomonCSM(gnomon, { ...data, ...options, options: { fit: 'tight' } }));
  return results;
}
