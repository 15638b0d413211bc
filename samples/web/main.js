// One street, drawn with three.js' own sun shadow left of a line and with gnomon's right of it, both measured.
import * as THREE from 'three';
import { SunLight } from 'three/addons/lights/SunLight.js';
import { load } from 'gnomon';
import { cameraOf, GnomonSunShadow, ShadowBounds } from 'gnomon/three';

const SIZE = 1024;

/** Houses on both sides of a street, and trees between them. */
function street() {
  const group = new THREE.Group();
  const add = (geometry, color, x, y, z) => {
    const mesh = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ color }));
    mesh.position.set(x, y, z);
    mesh.castShadow = mesh.receiveShadow = true;
    group.add(mesh);
  };
  add(new THREE.BoxGeometry(120, 1, 260), 0x8a8d88, 0, -0.5, -100);
  for (let i = 0; i < 26; ++i) {
    const side = i % 2 === 0 ? -1 : 1;
    const height = 4 + ((i * 7) % 9);
    add(new THREE.BoxGeometry(9, height, 8), 0xc8b49a, side * 14, height / 2, -9 * i);
    add(new THREE.CylinderGeometry(0.15, 0.2, 3, 8), 0x5b4632, side * 7, 1.5, -9 * i - 4);
    add(new THREE.IcosahedronGeometry(1.5, 1), 0x4f7a3a, side * 7, 4, -9 * i - 4);
    for (let k = 0; k < 5; ++k) add(new THREE.BoxGeometry(0.1, 1.1, 0.1), 0x333333, side * 5, 0.55, -9 * i - k);
  }
  return group;
}

function sceneWith(shadowOf) {
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0x9fc4e8);
  scene.add(street(), new THREE.HemisphereLight(0xbdd7f5, 0x6b6353, 0.8));
  const sun = new SunLight(0xfff2e3, 3);
  sun.position.set(-0.5, 1, 0.35);
  sun.castShadow = true;
  if (shadowOf !== undefined) sun.shadow = shadowOf(scene);
  sun.shadow.mapSize.set(SIZE, SIZE);
  scene.add(sun);
  return { scene, sun };
}

/** The maps of three's own shadow as gnomon measures them. */
function mapsOf({ _cameras, _cascadeData }) {
  return _cameras.map((camera, i) => ({
    clipFromWorld: new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).toArray(),
    width: SIZE,
    height: SIZE,
    depthBegin: Math.max(0, _cascadeData[i].x),
    depthEnd: _cascadeData[i].y,
  }));
}

export async function start(canvas) {
  const gnomon = await load();
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
  renderer.shadowMap.enabled = true;
  const camera = new THREE.PerspectiveCamera(55, 1, 0.2, 220);
  const own = sceneWith();
  const ours = sceneWith((scene) => new GnomonSunShadow(gnomon, scene, { options: { fit: 'warped_stable' } }));
  const bounds = new ShadowBounds(gnomon, ours.scene);
  const slider = document.querySelector('input');
  const errors = { own: 0, gnomon: 0 };

  function draw(time) {
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.position.set(2 * Math.sin(time / 9000), 3, 8 - ((time / 1000) % 120));
    camera.lookAt(0, 1, camera.position.z - 30);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    const split = Math.round(width * slider.value);
    document.querySelector('#line').style.left = `${split}px`;
    renderer.setScissorTest(true);
    renderer.setScissor(0, 0, split, height);
    renderer.render(own.scene, camera);
    renderer.setScissor(split, 0, width - split, height);
    renderer.render(ours.scene, camera);
    return { width, height, split };
  }
  function measure({ width, height }) {
    const input = { camera: cameraOf(gnomon, camera, [width, height]), receivers: bounds.receivers, grid: { columns: 24, rows: 16, depths: 24 } };
    errors.own = gnomon.measure({ maps: mapsOf(own.sun.shadow), selection: 'view_depth' }, input).p95;
    errors.gnomon = gnomon.measure(ours.sun.shadow.plan, input).p95;
    document.querySelector('#three').textContent = `three.js: a texel covers ${errors.own.toFixed(1)} pixels (95 % of the surfaces: less)`;
    document.querySelector('#gnomon').textContent = `gnomon: ${errors.gnomon.toFixed(1)} pixels`;
  }

  let frame = 0;
  renderer.setAnimationLoop((time) => {
    const image = draw(time);
    if (frame++ % 20 === 0) measure(image);
  });
  return { renderer, draw, measure, errors };
}
