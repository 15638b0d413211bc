// Flights through a scene, drawn with Babylon's own shadows and with gnomon's, every frame counted against exact rays.
import * as THREE from 'three';
import { FreeCamera } from '@babylonjs/core/Cameras/freeCamera.js';
import { Engine } from '@babylonjs/core/Engines/engine.js';
import { DirectionalLight } from '@babylonjs/core/Lights/directionalLight.js';
import { CascadedShadowGenerator } from '@babylonjs/core/Lights/Shadows/cascadedShadowGenerator.js';
import { ShadowGenerator } from '@babylonjs/core/Lights/Shadows/shadowGenerator.js';
import { StandardMaterial } from '@babylonjs/core/Materials/standardMaterial.js';
import { Color3, Color4 } from '@babylonjs/core/Maths/math.color.js';
import { Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import '@babylonjs/core/Meshes/instancedMesh.js';
import { Mesh } from '@babylonjs/core/Meshes/mesh.js';
import { VertexData } from '@babylonjs/core/Meshes/mesh.vertexData.js';
import { Scene } from '@babylonjs/core/scene.js';
import { load } from 'gnomon';
import { GnomonCascadedShadowGenerator, GnomonShadow } from 'gnomon/babylon';
import { FAR, SCENES, Truth, counted } from './exact.js';

/** Triangles with flat normals. A left-handed world is the mirror image of the one that the rays go through. */
function vertexData({ geometry, matrix }, side) {
  const flat = (geometry.index ? geometry.toNonIndexed() : geometry.clone()).applyMatrix4(matrix);
  flat.computeVertexNormals();
  const mirrored = (name) => Array.from(flat.getAttribute(name).array, (value, i) => (i % 3 === 2 ? side * value : value));
  const data = new VertexData();
  data.positions = mirrored('position');
  data.normals = mirrored('normal');
  data.indices = Array.from({ length: data.positions.length / 3 }, (_, i) => (side < 0 || i % 3 === 0 ? i : i % 3 === 1 ? i + 1 : i - 1));
  return data;
}

/** The street's boxes as instances of one mesh. */
function instancesOf(scene, meshes, side) {
  const cube = new Mesh('cube', scene);
  vertexData({ geometry: new THREE.BoxGeometry(), matrix: new THREE.Matrix4() }, side).applyToMesh(cube);
  const all = [cube, ...meshes.slice(1).map((_, i) => cube.createInstance(`cube ${i}`))];
  all.forEach((one, i) => {
    const { geometry: { parameters }, matrix } = meshes[i];
    const { x, y, z } = new THREE.Vector3().setFromMatrixPosition(matrix);
    one.scaling.set(parameters.width, parameters.height, parameters.depth);
    one.position.set(x, y, side * z);
  });
  return all;
}

/** A scene of its own for each technique, with its camera, its light and what `shadows` makes for it. */
function sceneOf(engine, geometry, { toSun, shadowSide, instanced }, rightHanded, shadows) {
  const side = rightHanded ? 1 : -1;
  const scene = new Scene(engine);
  scene.useRightHandedSystem = rightHanded;
  scene.clearColor = new Color4(0, 0, 0, 1);
  const camera = new FreeCamera('camera', Vector3.Zero(), scene);
  Object.assign(camera, { fov: (57 / 180) * Math.PI, minZ: 0.2, maxZ: FAR });
  const light = new DirectionalLight('sun', new Vector3(-toSun.x, -toSun.y, -side * toSun.z), scene);
  const material = new StandardMaterial('white', scene);
  material.specularColor = Color3.Black();
  material.backFaceCulling = shadowSide === undefined;
  // As three's flat shading: normals face the eye.
  material.twoSidedLighting = shadowSide !== undefined;
  const meshes = instanced ? instancesOf(scene, instanced, side) : geometry.map((data, i) => {
    const mesh = new Mesh(`mesh ${i}`, scene);
    data.applyToMesh(mesh);
    return mesh;
  });
  // Instances have those of their mesh.
  for (const mesh of instanced ? meshes.slice(0, 1) : meshes) Object.assign(mesh, { material, receiveShadows: true });
  const generator = shadows?.(light, scene);
  for (const mesh of meshes) generator?.addShadowCaster(mesh);
  return { scene, camera, generator };
}

const FITS = { gnomon: {}, 'gnomon, tight': { fit: 'tight' }, 'gnomon, stable': { fit: 'stable' } };
// Depths of clip space, and lengths along the normal.
const BIASES = [[0.002, 0.005, 0.01, 0.02], [0, 0.02, 0.05, 0.1, 0.2]];

function techniquesOf(gnomon, size, biases, sweep) {
  const cascaded = ([bias, normalBias]) => (light) => Object.assign(new CascadedShadowGenerator(size, light), { bias, normalBias });
  const single = ([bias, normalBias]) => (light) => {
    light.autoCalcShadowZBounds = true;
    return Object.assign(new ShadowGenerator(size, light), { usePercentageCloserFiltering: true, bias, normalBias });
  };
  const all = {};
  if (sweep) {
    const pairs = BIASES[0].flatMap((bias) => BIASES[1].map((normal) => [bias, normal]));
    for (const pair of pairs) all[`CascadedShadowGenerator ${pair.join(' ')}`] = cascaded(pair);
    for (const pair of pairs) all[`ShadowGenerator ${pair.join(' ')}`] = single(pair);
    return all;
  }
  all.CascadedShadowGenerator = cascaded(biases.cascaded);
  all['CascadedShadowGenerator, its own stabilized'] = (light) => Object.assign(all.CascadedShadowGenerator(light), { stabilizeCascades: true });
  for (const [name, options] of Object.entries(FITS)) all[`CascadedShadowGenerator, ${name}`] = (light) => new GnomonCascadedShadowGenerator(gnomon, size, light, { options });
  all.ShadowGenerator = single(biases.single);
  all['ShadowGenerator, gnomon'] = (light) => {
    const generator = single([0, 0])(light);
    new GnomonShadow(gnomon, generator);
    return generator;
  };
  return all;
}

export async function run({ scene, size, sweep = false, rightHanded = false, instanced = false, reversedDepth = false, biases = SCENES[scene].babylon[size], ...flight }) {
  const [width, height] = flight.picture;
  const gnomon = await load();
  const renderer = new THREE.WebGLRenderer({ antialias: false });
  const meshes = await SCENES[scene].meshes();
  const toSun = new THREE.Vector3(...SCENES[scene].toSun).normalize();
  const camera = new THREE.PerspectiveCamera(57, width / height, 0.2, FAR);
  const exact = new Truth(renderer, meshes, toSun, [width, height]);
  const canvas = document.createElement('canvas');
  const engine = new Engine(canvas, false, { preserveDrawingBuffer: true }, false);
  engine.setSize(width, height);
  engine.useReverseDepthBuffer = reversedDepth;
  engine.getCaps().parallelShaderCompile = null;  // wait for each shader
  const side = rightHanded ? 1 : -1;
  const geometry = meshes.map((mesh) => vertexData(mesh, side));
  const made = (shadows) => sceneOf(engine, geometry, { ...SCENES[scene], toSun, instanced: instanced && meshes }, rightHanded, shadows);
  const draw = async ({ scene: from, camera: eye }) => {
    eye.position.set(camera.position.x, camera.position.y, side * camera.position.z);
    const ahead = camera.getWorldDirection(new THREE.Vector3()).add(camera.position);
    eye.setTarget(new Vector3(ahead.x, ahead.y, side * ahead.z));
    await from.whenReadyAsync(true);
    from.render();
    const pixels = new Uint8Array(4 * width * height);
    engine._gl.readPixels(0, 0, width, height, engine._gl.RGBA, engine._gl.UNSIGNED_BYTE, pixels);
    return pixels;
  };
  const unshadowed = made();
  const techniques = Object.entries(techniquesOf(gnomon, size, biases, sweep)).map(([name, shadows]) => {
    const one = made(shadows);
    return [name, () => draw(one)];
  });
  const result = await counted({ scene, ...flight }, camera, exact, () => draw(unshadowed), techniques);
  engine.dispose();
  renderer.dispose();
  return result;
}
