// Flights through a scene, drawn with three's own shadows and with gnomon's, every frame counted against exact rays.
import * as THREE from 'three';
import { CSM } from 'three/addons/csm/CSM.js';
import { SunLight } from 'three/addons/lights/SunLight.js';
import { load } from 'gnomon';
import { GnomonCSM, GnomonPointShadow, GnomonSpotShadow, GnomonSunShadow, ShadowBounds } from 'gnomon/three';
import { FAR, SCENES, Truth, counted, sceneOf } from './exact.js';

// Depths and lengths along the normal, of SunLight, CSM and PointLight: their maps are not equally deep.
const BIASES = { point: [[-0.0001, -0.0003, -0.001, -0.003], [0, 0.05, 0.1, 0.2]], sun: [[-0.001, -0.002, -0.004], [0, 0.1, 0.2, 0.4]], csm: [[-0.0001, -0.0002, -0.0004], [0, 0.05, 0.1, 0.2]] };
// With the polygon offset that gnomon's casters are drawn with, three's own need less constant bias.
const SLOPED = { factor: 1.5, sun: -0.0002, csm: -0.00005 };
const FITS = { gnomon: {}, 'gnomon, tight': { fit: 'tight' }, 'gnomon, stable': { fit: 'stable' } };

const isPoint = ({ angle }) => angle === Math.PI;
/** A SpotLight, or a PointLight where its angle is all around. */
function lampOf(lamp) {
  const { position, target, angle, distance } = lamp;
  const light = isPoint(lamp) ? new THREE.PointLight(0xffffff, Math.PI, 0, 0) : new THREE.SpotLight(0xffffff, Math.PI, 0, angle, 0, 0);
  light.position.set(...position);
  light.target?.position.set(...target);
  light.target?.updateMatrixWorld();
  light.shadow.camera.far = distance;
  return light;
}

/** How each technique is made: three's own and with gnomon's maps, three's own with every bias of BIASES, or gnomon's with more texels. */
function techniquesOf(gnomon, camera, { meshes, toSun, lamp, shadowSide, biases }, [width, height], size, sweep) {
  const resolution = [width, height];
  const sun = (set, side = size) => () => {
    const { scene } = sceneOf(meshes, shadowSide);
    const light = new SunLight(0xffffff, Math.PI);
    light.position.copy(toSun);
    light.castShadow = true;
    set(light, scene);
    light.shadow.mapSize.set(side, side);
    scene.add(light);
    return { scene, prepare() {}, dispose: () => light.dispose() };
  };
  const csm = (make, side = size) => () => {
    const { scene, material } = sceneOf(meshes, shadowSide);
    const shadows = make({ parent: scene, camera, cascades: 4, maxFar: FAR, shadowMapSize: side, lightDirection: toSun.clone().negate(), lightIntensity: Math.PI });
    shadows.setupMaterial(material);
    shadows.updateFrustums();
    return { scene, prepare: () => shadows.update(), dispose() { shadows.remove(); shadows.dispose(); } };
  };
  const local = (set) => () => {
    const { scene } = sceneOf(meshes, shadowSide);
    const light = lampOf(lamp);
    light.castShadow = true;
    set(light, scene);
    light.shadow.camera.far = lamp.distance;
    light.shadow.mapSize.set(size, size);
    scene.add(light);
    return { scene, prepare() {}, dispose: () => light.dispose() };
  };
  const ownSun = ([bias, normalBias]) => sun(({ shadow }) => Object.assign(shadow, { bias, normalBias }));
  const ownCsm = ([bias, normalBias]) => csm((data) => {
    const shadows = new CSM(data);
    for (const { shadow } of shadows.lights) Object.assign(shadow, { bias, normalBias });
    return shadows;
  });
  const all = {};
  if (lamp !== undefined) {
    const [own, Shadow] = isPoint(lamp) ? ['PointLight', GnomonPointShadow] : ['SpotLight', GnomonSpotShadow];
    const biased = ([bias, normalBias]) => local(({ shadow }) => Object.assign(shadow, { bias, normalBias }));
    if (sweep) {
      for (const bias of BIASES.point[0]) for (const normal of BIASES.point[1]) all[`${own} ${bias} ${normal}`] = biased([bias, normal]);
      return all;
    }
    all[own] = biased(biases?.[size].point ?? [0, 0]);
    for (const [name, options] of Object.entries(FITS)) all[`${own}, ${name}`] = local((light, scene) => { light.shadow = new Shadow(gnomon, scene, { resolution, options }); });
    return all;
  }
  const gnomonSun = (options, side) => sun((light, scene) => { light.shadow = new GnomonSunShadow(gnomon, scene, { resolution, options }); }, side);
  const gnomonCsm = (options, side) => csm((data) => new GnomonCSM(gnomon, { ...data, resolution, options }), side);
  if (sweep === 'texels') {
    all.SunLight = ownSun(biases?.[size].sun ?? [0, 0]);
    for (const times of [1, 2, 4]) all[`SunLight, gnomon, ${times * size}`] = gnomonSun({ fit: 'tight' }, times * size);
    all.CSM = ownCsm(biases?.[size].csm ?? [0, 0]);
    for (const times of [1, 2, 4]) all[`CSM, gnomon, ${times * size}`] = gnomonCsm({ fit: 'tight' }, times * size);
    return all;
  }
  if (sweep) {
    for (const bias of BIASES.sun[0]) for (const normal of BIASES.sun[1]) all[`SunLight ${bias} ${normal}`] = ownSun([bias, normal]);
    for (const bias of BIASES.csm[0]) for (const normal of BIASES.csm[1]) all[`CSM ${bias} ${normal}`] = ownCsm([bias, normal]);
    return all;
  }
  all.SunLight = ownSun(biases?.[size].sun ?? [0, 0]);
  for (const [name, options] of Object.entries(FITS)) all[`SunLight, ${name}`] = gnomonSun(options);
  const slope = (shadow, bias) => {
    shadow.bias = bias;
    for (let i = 0; i < shadow.getViewportCount(); ++i) shadow.getCamera(i).userData.gnomonSlope = SLOPED.factor;
  };
  if (biases !== undefined) {
    all['SunLight, its own with a slope'] = sun(({ shadow }, scene) => {
      new ShadowBounds(gnomon, scene);  // draws front faces with it
      slope(shadow, SLOPED.sun);
    });
  }
  all.CSM = biases === undefined ? csm((data) => new CSM(data)) : ownCsm(biases[size].csm);
  if (biases !== undefined) {
    all['CSM, its own with a slope'] = csm((data) => {
      new ShadowBounds(gnomon, data.parent);
      const shadows = new CSM(data);
      for (const { shadow } of shadows.lights) slope(shadow, SLOPED.csm);
      return shadows;
    });
  }
  for (const [name, options] of Object.entries(FITS)) all[`CSM, ${name}`] = gnomonCsm(options);
  return all;
}

export async function run({ scene, size, sweep = false, ...flight }) {
  const [width, height] = flight.picture;
  const gnomon = await load();
  const renderer = new THREE.WebGLRenderer({ antialias: false, preserveDrawingBuffer: true });
  renderer.setSize(width, height, false);
  renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
  renderer.shadowMap.enabled = true;
  const gl = renderer.getContext();
  const draw = (from) => {
    const pixels = new Uint8Array(4 * width * height);
    renderer.render(from, camera);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return pixels;
  };
  const meshes = await SCENES[scene].meshes();
  const { lamp } = SCENES[scene];
  const toSun = lamp === undefined ? new THREE.Vector3(...SCENES[scene].toSun).normalize() : undefined;
  const camera = new THREE.PerspectiveCamera(57, width / height, 0.2, FAR);
  const exact = new Truth(renderer, meshes, toSun ?? lamp, [width, height]);
  const unshadowed = sceneOf(meshes).scene;
  const light = lamp === undefined ? new THREE.DirectionalLight(0xffffff, Math.PI) : lampOf(lamp);
  if (toSun !== undefined) light.position.copy(toSun);
  unshadowed.add(light);
  const made = {};
  const techniques = Object.entries(techniquesOf(gnomon, camera, { ...SCENES[scene], meshes, toSun }, [width, height], size, sweep)).map(([name, make]) => [name, () => {
    // CSM replaces text of three's shaders: those of the sun are compiled before it comes.
    made[name] ??= make();
    made[name].prepare();
    return draw(made[name].scene);
  }]);
  const result = await counted({ scene, ...flight }, camera, exact, () => draw(unshadowed), techniques);
  for (const one of Object.values(made)) one.dispose();
  renderer.dispose();
  return result;
}
