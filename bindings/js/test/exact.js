// What does the sun reach in the scenes that are flown through, and how far is a picture from that? Exact rays, in the browser.
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { mergeGeometries } from 'three/addons/utils/BufferGeometryUtils.js';
import { MeshBVH } from 'three-mesh-bvh';
import { boxes } from './street.js';

export const FAR = 250;
// Where the sun grazes a surface, rounding of colours decides.
const LEAST_COSINE = 0.1;
// A pixel too dark by more than a tenth, with no shadow this many pixels around, is acne.
const EDGE_PIXELS = 3;
const ACNE = 0.9;

function streetMeshes() {
  return Array.from({ length: boxes.length / 6 }, (_, i) => {
    const [x0, y0, z0, x1, y1, z1] = boxes.slice(6 * i, 6 * i + 6);
    const geometry = new THREE.BoxGeometry(x1 - x0, y1 - y0, z1 - z0);
    return { geometry, matrix: new THREE.Matrix4().makeTranslation((x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2) };
  });
}
async function cityMeshes() {
  const { scene } = await new GLTFLoader().loadAsync('/scenes/low_poly_city/scene.gltf');
  scene.scale.multiplyScalar(CITY_SCALE);
  scene.updateMatrixWorld();
  const meshes = [];
  scene.traverse((mesh) => { if (mesh.isMesh) meshes.push({ geometry: mesh.geometry, matrix: mesh.matrixWorld.clone() }); });
  return meshes;
}
const CITY_SCALE = 0.1;

/** Down the middle of the street, looking from side to side. */
function walk(camera, i) {
  camera.position.set(1.5 * Math.sin(i / 25), 4, 10 - 0.25 * i);
  camera.lookAt(camera.position.x + 14 * Math.sin(i / 18), 2.5, camera.position.z - 40);
}
/** Round the corner of the block, from its lit side to its shadow. */
function turn(camera, i) {
  const angle = -0.7 + i / 90;
  camera.position.set(85 * Math.sin(angle), 16, 115 * Math.cos(angle));
  camera.lookAt(20 * Math.sin(angle + 1), 14, 20 * Math.cos(angle + 1));
}
// Babylon and PlayCanvas draw front faces: their own shadows take biases of `flights.js ENGINE --biases`, by the rule below.
const BABYLON = { 512: { cascaded: [0.01, 0], single: [0.02, 0.2] }, 1024: { cascaded: [0.005, 0], single: [0.02, 0.1] } };
const BULB = { position: [0.6, 6.2, -35.7], target: [0.6, 0, -35.7], angle: Math.PI, distance: 100 };
export const SCENES = {
  street: { meshes: streetMeshes, toSun: [-0.5, 1, 0.35], place: walk, babylon: BABYLON, playcanvas: { 512: [0.2, 0.05], 1024: [0.2, 0] } },
  'low sun': { meshes: streetMeshes, toSun: [-0.8, 0.28, -0.45], place: walk, babylon: BABYLON, playcanvas: { 512: [0.2, 0], 1024: [0.2, 0] } },
  // A spot above the street, in place of a sun.
  lamp: { meshes: streetMeshes, place: walk, lamp: { position: [0, 18, -20], target: [2, 0, -50], angle: 0.9, distance: 200 } },
  // A bulb between the houses, which lights all around it.
  bulb: { meshes: streetMeshes, place: walk, lamp: BULB },
  'bulb, both sides': { meshes: streetMeshes, place: walk, lamp: BULB, shadowSide: THREE.DoubleSide, biases: { 512: { point: [-0.0001, 0.1] }, 1024: { point: [-0.0001, 0.05] } } },
  // Front faces in maps need a bias: three's own shadows take the one with the fewest misclassified pixels of those in BIASES
  // that leave acne on less than 2 % of the pixels (`flights.js --biases`).
  'both sides': {
    meshes: streetMeshes, toSun: [-0.5, 1, 0.35], place: walk, shadowSide: THREE.DoubleSide, babylon: BABYLON,
    biases: { 512: { sun: [-0.002, 0.1], csm: [-0.0004, 0] }, 1024: { sun: [-0.002, 0], csm: [-0.0002, 0] } },
  },
  // Its meshes are not closed: both sides cast.
  city: {
    meshes: cityMeshes, toSun: [-0.6, 0.9, 0.35], place: turn, shadowSide: THREE.DoubleSide, babylon: { ...BABYLON, 512: { ...BABYLON[512], cascaded: [0.005, 0.2] } },
    biases: { 512: { sun: [-0.004, 0], csm: [-0.0004, 0.1] }, 1024: { sun: [-0.002, 0], csm: [-0.0002, 0.05] } },
  },
};

export function sceneOf(meshes, shadowSide = null) {
  const scene = new THREE.Scene();
  const material = new THREE.MeshLambertMaterial({ flatShading: true, shadowSide });
  for (const { geometry, matrix } of meshes) {
    const mesh = new THREE.Mesh(geometry, material);
    mesh.matrixAutoUpdate = false;
    mesh.matrix.copy(matrix);
    mesh.castShadow = mesh.receiveShadow = true;
    scene.add(mesh);
  }
  return { scene, material };
}

/** Whether the sun reaches what each pixel shows, by rays from there: 1 lit, 0 in shadow, -1 where nothing is counted. */
export class Truth {
  /** `light`: the direction to a sun, or a lamp of SCENES. */
  constructor(renderer, meshes, light, [width, height]) {
    this.renderer = renderer;
    this.light = light;
    const soup = meshes.map(({ geometry, matrix }) => {
      const flat = new THREE.BufferGeometry();
      flat.setAttribute('position', (geometry.index ? geometry.toNonIndexed() : geometry).getAttribute('position').clone());
      return flat.applyMatrix4(matrix);
    });
    this.bvh = new MeshBVH(mergeGeometries(soup));
    this.target = new THREE.WebGLRenderTarget(width, height, { count: 2, type: THREE.FloatType, minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter });
    this.scene = sceneOf(meshes).scene;
    this.scene.overrideMaterial = new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: 'out vec3 place; void main() { vec4 p = modelMatrix * vec4(position, 1.0); place = p.xyz; gl_Position = projectionMatrix * viewMatrix * p; }',
      fragmentShader: `in vec3 place; layout(location = 0) out vec4 a; layout(location = 1) out vec4 b;
        void main() { a = vec4(place, 1.0); b = vec4(normalize(cross(dFdx(place), dFdy(place))), 1.0); }`,
    });
    this.places = new Float32Array(4 * width * height);
    this.normals = new Float32Array(4 * width * height);
  }

  of(camera) {
    const { renderer, target, places, normals, light } = this;
    const position = light.isVector3 ? undefined : new THREE.Vector3(...light.position);
    const axis = position && new THREE.Vector3(...light.target).sub(position).normalize();
    const { width, height } = target;
    renderer.setRenderTarget(target);
    renderer.setClearColor(0, 0);
    renderer.render(this.scene, camera);
    renderer.setRenderTarget(null);
    renderer.readRenderTargetPixels(target, 0, 0, width, height, places, undefined, 0);
    renderer.readRenderTargetPixels(target, 0, 0, width, height, normals, undefined, 1);
    const truth = new Int8Array(width * height).fill(-1);
    const ray = new THREE.Ray(new THREE.Vector3(), position ? new THREE.Vector3() : light);
    const normal = new THREE.Vector3();
    for (let i = 0; i < truth.length; ++i) {
      if (places[4 * i + 3] === 0) continue;
      normal.fromArray(normals, 4 * i);
      ray.origin.fromArray(places, 4 * i);
      let far = Infinity;
      if (position) {
        far = ray.direction.copy(position).sub(ray.origin).length();
        ray.direction.divideScalar(far);
        // Its rim is smooth in the picture.
        if (ray.direction.dot(axis) > -Math.cos(light.angle - 0.02) || far > light.distance) continue;
      }
      if (!(normal.dot(ray.direction) >= LEAST_COSINE)) continue;
      ray.origin.addScaledVector(normal, 1e-3);
      const hit = this.bvh.raycastFirst(ray, THREE.DoubleSide);
      truth[i] = hit === null || hit.distance >= far ? 1 : 0;
    }
    return truth;
  }
}

/** Pixels with a shadow at most `EDGE_PIXELS` away. */
function nearShadow(truth, width, height) {
  const spread = (from, step, count, stride, lines) => {
    const to = new Uint8Array(from.length);
    for (let l = 0; l < lines; ++l) {
      for (let k = 0; k < count; ++k) {
        const at = l * stride + k * step;
        if (!from[at]) continue;
        for (let d = Math.max(0, k - EDGE_PIXELS); d <= Math.min(count - 1, k + EDGE_PIXELS); ++d) to[l * stride + d * step] = 1;
      }
    }
    return to;
  };
  const dark = Uint8Array.from(truth, (t) => (t === 0 ? 1 : 0));
  return spread(spread(dark, 1, width, width, height), width, height, 1, width);
}

class Count {
  constructor() {
    Object.assign(this, { counted: 0, falseShadow: 0, falseLight: 0, acne: 0, steady: 0, flips: 0 });
  }
  add(pixels, full, truth, near, lastTruth) {
    const lit = new Uint8Array(truth.length);
    for (let i = 0; i < truth.length; ++i) {
      // Nor where a picture without shadows is dark.
      if (truth[i] < 0 || full[4 * i] === 0) continue;
      lit[i] = 2 * pixels[4 * i] >= full[4 * i] ? 1 : 0;
      ++this.counted;
      if (lit[i] < truth[i]) ++this.falseShadow;
      if (!near[i] && pixels[4 * i] < ACNE * full[4 * i]) ++this.acne;
      if (lit[i] > truth[i]) ++this.falseLight;
      if (lastTruth?.[i] === truth[i]) {
        ++this.steady;
        if (this.last[i] !== lit[i]) ++this.flips;
      }
    }
    this.last = lit;
  }
  get shares() {
    const { counted, falseShadow, falseLight, acne, steady, flips } = this;
    return { counted, wrong: (falseShadow + falseLight) / counted, falseShadow: falseShadow / counted, falseLight: falseLight / counted, acne: acne / counted, flips: flips / Math.max(1, steady) };
  }
}

/** A picture of what is wrong: false shadow red, false light blue. */
function picture(pixels, full, truth, width, height) {
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [width, height];
  const context = canvas.getContext('2d');
  const image = context.createImageData(width, height);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const [from, to] = [y * width + x, 4 * ((height - 1 - y) * width + x)];
      const lit = 2 * pixels[4 * from] >= full[4 * from] ? 1 : 0;
      const wrong = truth[from] >= 0 && full[4 * from] > 0 && lit !== truth[from];
      const value = pixels[4 * from];
      image.data.set(wrong ? (lit ? [60, 120, 255, 255] : [255, 60, 40, 255]) : [value, value, value, 255], to);
    }
  }
  context.putImageData(image, 0, 0);
  return canvas.toDataURL('image/png');
}

/**
 * A flight, of which each technique draws every frame, counted against exact rays. `draw` without shadows and those of `techniques`, behind
 * their names, return pixels of the camera's picture, the lowest row first.
 */
export async function counted({ scene, picture: [width, height], frames, step = 1, pictureOf }, camera, exact, draw, techniques) {
  const counts = techniques.map(() => new Count()), pictures = {};
  let last;
  for (let i = 0; i < frames; ++i) {
    SCENES[scene].place(camera, step * i);
    camera.updateMatrixWorld();
    const truth = exact.of(camera);
    const near = nearShadow(truth, width, height);
    const full = await draw();
    for (const [k, [name, drawWith]] of techniques.entries()) {
      const pixels = await drawWith();
      counts[k].add(pixels, full, truth, near, last);
      if (i === pictureOf) pictures[name] = picture(pixels, full, truth, width, height);
    }
    last = truth;
  }
  return { rows: techniques.map(([technique], k) => ({ technique, ...counts[k].shares })), pictures };
}
