// One street, drawn with three.js' own shadows left of a line and with gnomon's right of it, both measured.
import * as THREE from 'three';
import { CSM } from 'three/addons/csm/CSM.js';
import { SunLight } from 'three/addons/lights/SunLight.js';
import { load } from 'gnomon';
import { cameraOf, GnomonCSM, GnomonSunShadow, ShadowBounds } from 'gnomon/three';
import { Heat } from './heat.js';
import { street } from './street.js';

const FAR = 220;
// CSM replaces text of three's shaders for good; SunLight needs what was there.
const { lights_fragment_begin, lights_pars_begin } = THREE.ShaderChunk;

/** A scene with a sun: three's own, or with gnomon's maps where `gnomon` is given. `plan()` is what gnomon measures. */
function sceneWith({ gnomon, camera, light, texels, toSun, fit }) {
  const materials = new Map();
  const materialOf = (color) => {
    if (!materials.has(color)) materials.set(color, new THREE.MeshLambertMaterial({ color }));
    return materials.get(color);
  };
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0x9fc4e8);
  scene.add(street(materialOf), new THREE.HemisphereLight(0xbdd7f5, 0x6b6353, 0.8));
  const options = { fit };
  const made = light === 'sun' ? sunIn(scene, gnomon, texels, options) : csmIn(scene, gnomon, camera, Number(light), texels, options, materials);
  made.turn(toSun);
  return { ...made, scene, dispose() { made.dispose(); for (const material of materials.values()) material.dispose(); } };
}

function sunIn(scene, gnomon, texels, options) {
  Object.assign(THREE.ShaderChunk, { lights_fragment_begin, lights_pars_begin });
  const sun = new SunLight(0xffffff, 3);
  sun.castShadow = true;
  if (gnomon !== undefined) sun.shadow = new GnomonSunShadow(gnomon, scene, { options });
  const { shadow } = sun;
  shadow.mapSize.set(texels, texels);
  scene.add(sun);
  return {
    shadow,
    turn: (toSun) => sun.position.copy(toSun),
    prepare() {},
    plan: () => shadow.plan ?? { maps: shadow._cameras.map((view, i) => mapOf(view, texels, Math.max(0, shadow._cascadeData[i].x), shadow._cascadeData[i].y)), selection: 'view_depth' },
    dispose: () => sun.dispose(),
  };
}

function csmIn(scene, gnomon, camera, cascades, texels, options, materials) {
  const data = { parent: scene, camera, cascades, maxFar: FAR, shadowMapSize: texels, lightIntensity: 3 };
  const csm = gnomon === undefined ? new CSM(data) : new GnomonCSM(gnomon, { ...data, options });
  for (const material of materials.values()) csm.setupMaterial(material);
  let aspect = 0;
  return {
    shadow: csm,
    turn: (toSun) => csm.lightDirection.copy(toSun).negate(),
    prepare() {
      if (aspect !== camera.aspect) csm.updateFrustums();
      aspect = camera.aspect;
      csm.update();
    },
    plan: () => csm.plan ?? { maps: csm.lights.map(({ shadow }, i) => mapOf(shadow.camera, texels, FAR * (csm.breaks[i - 1] ?? 0), FAR * csm.breaks[i])), selection: 'view_depth' },
    dispose() {
      csm.remove();
      csm.dispose();
    },
  };
}

/** A map of three's own as gnomon measures it. */
function mapOf(view, texels, depthBegin, depthEnd) {
  const clipFromWorld = new THREE.Matrix4().multiplyMatrices(view.projectionMatrix, view.matrixWorldInverse).toArray();
  return { clipFromWorld, width: texels, height: texels, depthBegin, depthEnd };
}

export async function start() {
  const find = (id) => document.getElementById(id);
  const gnomon = await load();
  const canvas = find('view');
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
  renderer.setPixelRatio(Math.min(2, globalThis.devicePixelRatio));
  renderer.shadowMap.enabled = true;
  const camera = new THREE.PerspectiveCamera(55, 1, 0.2, FAR);
  const heat = new Heat(gnomon, renderer, find('heat'));
  const state = { own: undefined, ours: undefined, bounds: undefined, walked: 0, errors: { own: 0, gnomon: 0 } };
  find('walk').checked = !matchMedia('(prefers-reduced-motion: reduce)').matches;
  document.querySelector('details').open = innerWidth > 900 && innerHeight > 640;

  const settings = () => {
    const [elevation, azimuth] = ['elevation', 'azimuth'].map((id) => THREE.MathUtils.degToRad(find(id).value));
    const toSun = new THREE.Vector3(Math.sin(azimuth) * Math.cos(elevation), Math.sin(elevation), Math.cos(azimuth) * Math.cos(elevation));
    return { light: find('light').value, texels: 2 ** find('texels').value, toSun, fit: find('fit').value };
  };
  function build() {
    state.own?.dispose();
    state.ours?.dispose();
    state.bounds?.dispose();
    state.own = sceneWith({ ...settings(), camera });
    state.ours = sceneWith({ ...settings(), camera, gnomon });
    state.bounds = new ShadowBounds(gnomon, state.ours.scene);
  }

  function resize() {
    const [width, height] = [innerWidth, innerHeight];
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    const size = renderer.getDrawingBufferSize(new THREE.Vector2()).toArray();
    state.ours.shadow.resolution = size;
    state.size = [width, height];
    state.resolution = size;
  }
  function draw() {
    const [width, height] = state.size;
    const { walked } = state;
    camera.position.set(Math.sin(walked / 9), 2.2, 8 - (walked % 120));
    camera.lookAt(0, 1, camera.position.z - 20);
    camera.updateMatrixWorld();
    const split = Math.round(width * find('wipe').value);
    find('line').style.left = `${split}px`;
    renderer.setScissorTest(true);
    for (const [side, from, to] of [[state.own, 0, split], [state.ours, split, width]]) {
      side.prepare();
      renderer.setScissor(from, 0, to - from, height);
      // Also where nothing of it is shown: its figures are.
      renderer.render(side.scene, camera);
    }
  }
  function measure() {
    const seenFrom = cameraOf(gnomon, camera, state.resolution, FAR);
    const input = { camera: seenFrom, receivers: state.bounds.receivers, grid: { columns: 24, rows: 16, depths: 24 } };
    const [left, right] = [state.own.plan(), state.ours.plan()];
    state.errors = { own: gnomon.measure(left, input).p95, gnomon: gnomon.measure(right, input).p95 };
    const { light, texels } = settings();
    const maps = light === 'sun' ? 2 : Number(light);
    const write = (id, name, error) => { find(id).innerHTML = `${name}<b>${error.toFixed(1)}</b>screen pixels per texel`; };
    write('three', `three.js, ${maps} × ${texels}²`, state.errors.own);
    write('gnomon', 'gnomon, as many texels', state.errors.gnomon);
    if (find('showHeat').checked) heat.draw(state.ours.scene, camera, seenFrom, find('wipe').value, left, right);
  }

  function changed({ target }) {
    if (['light', 'texels', 'fit'].includes(target.id)) {
      build();
      resize();
    }
    if (['elevation', 'azimuth'].includes(target.id)) for (const side of [state.own, state.ours]) side.turn(settings().toSun);
    const shown = { wipe: '', texels: `${settings().texels}²`, elevation: `${find('elevation').value}°`, azimuth: `${find('azimuth').value}°` };
    for (const [id, text] of Object.entries(shown)) find(id).nextElementSibling.value = text;
    find('heat').hidden = !find('showHeat').checked;
    find('legend').classList.toggle('shown', find('showHeat').checked);
    state.due = true;
  }
  document.querySelector('form').addEventListener('input', changed);
  document.querySelector('form').addEventListener('submit', (event) => event.preventDefault());
  // The line follows a finger or the mouse; the arrow keys move it too, and space stops the walk.
  const move = ({ buttons, clientX }) => {
    if (buttons === 0) return;
    find('wipe').value = clientX / innerWidth;
    state.due = true;
  };
  canvas.addEventListener('pointerdown', move);
  canvas.addEventListener('pointermove', move);
  addEventListener('keydown', (event) => {
    if (event.target !== document.body) return;
    const by = { ArrowLeft: -0.02, ArrowRight: 0.02 }[event.key];
    if (by !== undefined) find('wipe').value = Number(find('wipe').value) + by;
    else if (event.key === ' ') find('walk').click();
    else if (event.key === 'h') find('showHeat').click();
    else return;
    event.preventDefault();
    state.due = true;
  });
  addEventListener('resize', () => {
    resize();
    state.due = true;
  });

  build();
  resize();
  changed({ target: {} });
  let last, frame = 0;
  renderer.setAnimationLoop((time) => {
    const walking = find('walk').checked;
    if (walking) state.walked += 3 * Math.min(0.1, (time - (last ?? time)) / 1000);
    last = time;
    // A picture that does not change needs no drawing.
    if (!walking && !state.due) return;
    draw();
    if (state.due || frame++ % 20 === 0) measure();
    state.due = false;
  });
  return state;
}
