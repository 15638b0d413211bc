// Flights through a scene, drawn with PlayCanvas' own shadows and with gnomon's, every frame counted against exact rays; and what
// the adapter hands to PlayCanvas while it draws.
import * as pc from 'playcanvas';
import * as THREE from 'three';
import { load } from 'gnomon';
import { GnomonCascades } from 'gnomon/playcanvas';
import { FAR, SCENES, Truth, counted } from './exact.js';

/** An app whose picture is its light times the cosine, read by draw(). Lights are switched: one at a time is on. */
export function world({ width, height, meshes, far = FAR, near = 0.2, fov = 57 }) {
  const canvas = document.createElement('canvas');
  const app = new pc.Application(canvas, { graphicsDeviceOptions: { antialias: false, preserveDrawingBuffer: true } });
  app.graphicsDevice.maxPixelRatio = 1;
  app.setCanvasFillMode(pc.FILLMODE_NONE);
  app.setCanvasResolution(pc.RESOLUTION_FIXED, width, height);
  app.scene.ambientLight = new pc.Color(0, 0, 0);
  const eye = new pc.Entity('eye');
  eye.addComponent('camera', { clearColor: new pc.Color(0, 0, 0), fov, nearClip: near, farClip: far, gammaCorrection: pc.GAMMA_NONE, toneMapping: pc.TONEMAP_LINEAR });
  app.root.addChild(eye);
  const material = new pc.StandardMaterial();
  Object.assign(material, { useMetalness: false, specular: new pc.Color(0, 0, 0), gloss: 0 });
  material.update();
  const entities = meshes.map(({ geometry, matrix }) => {
    const flat = geometry.index ? geometry.toNonIndexed() : geometry;
    const mesh = new pc.Mesh(app.graphicsDevice);
    mesh.setPositions(flat.getAttribute('position').array);
    mesh.setNormals(flat.getAttribute('normal').array);
    mesh.update();
    const entity = new pc.Entity();
    entity.addComponent('render', { meshInstances: [new pc.MeshInstance(mesh, material)], castShadows: true, receiveShadows: true });
    const { x, y, z } = new THREE.Vector3().setFromMatrixPosition(matrix);
    entity.setPosition(x, y, z);
    app.root.addChild(entity);
    return entity;
  });
  const lights = [];
  const light = (toSun, options) => {
    const entity = new pc.Entity();
    // A light of PlayCanvas shines down its -y.
    entity.setRotation(new pc.Quat().setFromDirections(pc.Vec3.UP, new pc.Vec3(...toSun).normalize()));
    entity.addComponent('light', { type: 'directional', shadowDistance: far, ...options });
    app.root.addChild(entity);
    lights.push(entity.light);
    return entity.light;
  };
  const draw = (sun) => {
    for (const one of lights) one.enabled = one === sun;
    app.render();
    const { gl } = app.graphicsDevice;
    const pixels = new Uint8Array(4 * width * height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return pixels;
  };
  return { app, eye, entities, light, draw };
}

/** The pose of a camera of three, which looks down its -z as those of PlayCanvas do. */
export function follow(eye, camera) {
  camera.updateMatrixWorld();
  const { x, y, z } = camera.position;
  eye.setPosition(x, y, z);
  eye.setRotation(new pc.Quat(...camera.quaternion.toArray()));
}

const FITS = { gnomon: {}, 'gnomon, tight': { fit: 'tight' }, 'gnomon, stable': { fit: 'stable' } };
// shadowBias and normalOffsetBias of a LightComponent.
const BIASES = [[0.02, 0.05, 0.1, 0.2, 0.4], [0, 0.02, 0.05, 0.1]];

// Degrees that a light is turned about its direction: its grid lies otherwise over the same shadows.
const ROLLS = [0, 15, 30, 45, 60, 75];

/** Lights by technique. `size`: of each cascade, which PlayCanvas has a quarter of its texture for. */
function techniquesOf(gnomon, { app, light }, toSun, size, cascades, biases, sweep) {
  const sun = ([shadowBias, normalOffsetBias]) =>
    light(toSun, { castShadows: true, numCascades: cascades, shadowResolution: (cascades > 1 ? 2 : 1) * size, shadowType: pc.SHADOW_PCF3_32F, shadowBias, normalOffsetBias });
  if (sweep === 'rolls') return ROLLS.map((degrees) => {
    const turned = sun(biases);
    turned.entity.rotateLocal(0, degrees, 0);
    return [`PlayCanvas ${degrees}`, turned];
  });
  if (sweep) return BIASES[0].flatMap((bias) => BIASES[1].map((normal) => [`PlayCanvas ${bias} ${normal}`, sun([bias, normal])]));
  const all = [['PlayCanvas', sun(biases)]];
  for (const [name, options] of Object.entries(FITS)) {
    const own = sun(biases);
    new GnomonCascades(gnomon, app, own, { options });
    all.push([`PlayCanvas, ${name}`, own]);
  }
  return all;
}

export async function run({ scene, size, sweep = false, cascades = 4, biases = SCENES[scene].playcanvas[size], ...flight }) {
  const [width, height] = flight.picture;
  const gnomon = await load();
  const renderer = new THREE.WebGLRenderer({ antialias: false });
  const meshes = await SCENES[scene].meshes();
  const toSun = new THREE.Vector3(...SCENES[scene].toSun).normalize();
  const camera = new THREE.PerspectiveCamera(57, width / height, 0.2, FAR);
  const exact = new Truth(renderer, meshes, toSun, [width, height]);
  const place = world({ width, height, meshes });
  const unshadowed = place.light(toSun.toArray(), { castShadows: false });
  const draw = (sun) => {
    follow(place.eye, camera);
    return place.draw(sun);
  };
  const techniques = techniquesOf(gnomon, place, toSun.toArray(), size, cascades, biases, sweep).map(([name, sun]) => [name, () => draw(sun)]);
  const result = await counted({ scene, ...flight }, camera, exact, () => draw(unshadowed), techniques);
  place.app.destroy();
  renderer.dispose();
  return result;
}
