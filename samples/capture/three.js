// What do three.js' shadow maps look like to `gnomon judge`? A capture of format gnomon-capture/1 (docs/captures.md).
//
//   import { captureThree } from './three.js';
//   const text = JSON.stringify(captureThree(scene, camera, renderer.domElement, { csm }));   // after renderer.render()

const matrix = (m) => Array.from(m.elements);
const vector = (v) => [v.x, v.y, v.z];

/** Boxes of the meshes that receive and that cast, in world space. */
function boxesOf(scene) {
  const receivers = [], casters = [];
  scene.updateMatrixWorld();
  scene.traverseVisible((mesh) => {
    if (!mesh.isMesh || !(mesh.castShadow || mesh.receiveShadow)) return;
    const own = typeof mesh.computeBoundingBox === 'function' ? mesh : mesh.geometry;
    if (own.boundingBox === null) own.computeBoundingBox();
    const box = own.boundingBox.clone().applyMatrix4(mesh.matrixWorld);
    if (box.isEmpty()) return;
    const bounds = { min: vector(box.min), max: vector(box.max) };
    if (mesh.receiveShadow) receivers.push(bounds);
    if (mesh.castShadow) casters.push(bounds);
  });
  return { receivers, casters };
}

/** three draws the back faces of closed meshes into its maps, unless a material's shadowSide says otherwise. */
function drawsFrontFaces(scene) {
  let front = false;
  scene.traverseVisible((mesh) => {
    if (!mesh.isMesh || !mesh.castShadow) return;
    for (const material of [mesh.material].flat()) front ||= (material.shadowSide ?? (material.side === 0 ? 1 : 0)) !== 1;
  });
  return front;
}

/** One map. `shadow.bias` is added to the depth that is compared, so that negative ones lift look-ups off the surface. */
function mapOf(shadow, camera, light, more) {
  return {
    clip_from_world: matrix(camera.projectionMatrix.clone().multiply(camera.matrixWorldInverse)),
    light, width: shadow.mapSize.x, height: shadow.mapSize.y, filter_texels: shadow.radius,
    bias: { depth: -shadow.bias, normal_world: shadow.normalBias }, ...more,
  };
}

const sunLight = (direction) => ({ type: 'directional', direction });

/** The maps of a CSM add-on: one light of the file for all of its cascades. */
function addCsm(csm, camera, lights, maps) {
  const far = Math.min(camera.far, csm.maxFar);
  lights.push(sunLight(vector(csm.lightDirection)));
  csm.lights.forEach((light, i) => {
    light.updateMatrixWorld();
    light.target.updateMatrixWorld();
    light.shadow.updateMatrices(light);
    // Its shader compares depth over (far - near) with the breaks.
    const edge = (at) => (at < 0 ? camera.near : csm.breaks[at] * (far - camera.near));
    maps.push(mapOf(light.shadow, light.shadow.camera, lights.length - 1, { depths: [edge(i - 1), edge(i)] }));
  });
}

/** The two maps of a SunLight, each as large as its viewport in the atlas. */
function addSunLight(light, camera, lights, maps) {
  const { shadow } = light;
  shadow.updateMatrices(light, camera);
  lights.push(sunLight(vector(light.position.clone().negate())));
  for (let i = 0; i < shadow._viewportCount; ++i) {
    const view = shadow._viewports[i], data = shadow._cascadeData[i];
    const begin = i === 0 ? camera.near : shadow._cascadeData[i - 1].z;
    const size = { width: Math.round(view.z * shadow.mapSize.x), height: Math.round(view.w * shadow.mapSize.y) };
    maps.push(mapOf(shadow, shadow.getCamera(i), lights.length - 1, {
      ...size, depths: [i === 0 ? begin : shadow._cascadeData[i - 1].y, data.y], overlap: i === 0 ? 0 : shadow._cascadeData[i - 1].y - begin,
    }));
  }
}

function addSpot(light, lights, maps) {
  const { shadow } = light;
  light.updateMatrixWorld();
  light.target.updateMatrixWorld();
  shadow.updateMatrices(light);
  const position = light.getWorldPosition(light.position.clone());
  const direction = light.target.getWorldPosition(light.position.clone()).sub(position);
  lights.push({ type: 'spot', position: vector(position), direction: vector(direction), outer_deg: (light.angle * 180) / Math.PI, range: shadow.camera.far });
  maps.push(mapOf(shadow, shadow.camera, lights.length - 1, {}));
}

// Where three's renderer turns the camera of a PointLight for each face, and what is up there.
const CUBE = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
const UPS = [[0, -1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1], [0, -1, 0], [0, -1, 0]];

/** The six faces of a PointLight. A look-up reads half of `radius` texels beside its own. */
function addPoint(light, lights, maps) {
  const { shadow } = light;
  light.updateMatrixWorld();
  const range = light.distance || shadow.camera.far;
  const position = light.getWorldPosition(light.position.clone());
  lights.push({ type: 'point', position: vector(position), range });
  CUBE.forEach((out, face) => {
    const camera = shadow.camera.clone();
    camera.far = range;
    camera.position.copy(position);
    camera.up.set(...UPS[face]);
    camera.lookAt(position.x + out[0], position.y + out[1], position.z + out[2]);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    maps.push(mapOf(shadow, camera, lights.length - 1, { height: shadow.mapSize.x, filter_texels: shadow.radius / 2 }));
  });
}

/** A directional light with one map of its own. */
function addDirectional(light, lights, maps) {
  light.updateMatrixWorld();
  light.target.updateMatrixWorld();
  light.shadow.updateMatrices(light);
  const position = light.getWorldPosition(light.position.clone());
  lights.push(sunLight(vector(light.target.getWorldPosition(light.position.clone()).sub(position))));
  maps.push(mapOf(light.shadow, light.shadow.camera, lights.length - 1, {}));
}

/** Camera, lights and maps of this frame: one entry of a capture's `frames`. */
export function frameOf(scene, camera, { width, height }, { csm } = {}) {
  camera.updateMatrixWorld();
  const lights = [], maps = [];
  if (csm !== undefined) addCsm(csm, camera, lights, maps);
  scene.traverseVisible((light) => {
    if (!light.isLight || !light.castShadow || csm?.lights.includes(light)) return;
    if (light.isSunLight) addSunLight(light, camera, lights, maps);
    else if (light.isSpotLight) addSpot(light, lights, maps);
    else if (light.isPointLight) addPoint(light, lights, maps);
    else if (light.isDirectionalLight) addDirectional(light, lights, maps);
  });
  const front = drawsFrontFaces(scene);
  for (const map of maps) if (!front) map.stores = 'back';
  return {
    camera: { view_from_world: matrix(camera.matrixWorldInverse), clip_from_view: matrix(camera.projectionMatrix), width, height },
    lights, maps,
  };
}

const fileOf = (scene, { name = 'three.js', engine = 'three.js' }) =>
  ({ format: 'gnomon-capture/1', name, engine, clip_space: { ndc_depth: 'minus_one_to_one' }, ...boxesOf(scene) });

/** A whole capture of one frame. `canvas`: anything with width and height, pixels. */
export const captureThree = (scene, camera, canvas, options = {}) => ({ ...fileOf(scene, options), ...frameOf(scene, camera, canvas, options) });
/** A capture of several frames: hand in what frameOf() returned for each. */
export const captureFlight = (scene, frames, options = {}) => ({ ...fileOf(scene, options), frames });
