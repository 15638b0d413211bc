// What does the adapter hand to PlayCanvas, and does it give it back? Facts about drawn frames, for playcanvas.test.js to judge.
import * as pc from 'playcanvas';
import * as THREE from 'three';
import { captureFlight, frameOf } from '/capture/playcanvas.js';
import { load } from 'gnomon';
import { GnomonCascades, cameraOf, hookOf } from 'gnomon/playcanvas';
import { SCENES } from './exact.js';
import { follow, world } from './playcanvas_page.js';

const SUN = [-0.5, 1, 0.35];
const SHADOWS = { castShadows: true, numCascades: 4, shadowResolution: 1024, shadowBias: 0.2, normalOffsetBias: 0.05 };
const same = (a, b) => a.every((value, i) => value === b[i]);

async function street(options = {}) {
  const [width, height] = options.picture ?? [320, 180];
  const place = world({ width, height, meshes: await SCENES.street.meshes(), ...options });
  const camera = new THREE.PerspectiveCamera();
  place.walk = (i) => {
    SCENES.street.place(camera, i);
    follow(place.eye, camera);
  };
  place.walk(3);
  return place;
}

/** How far PlayCanvas' look-up is from the plan's, in texels and in depths of 0..1, at corners of the street within each map. */
function offBy({ eye }, light, { maps }) {
  const most = { texels: 0, depth: 0, points: 0 };
  maps.forEach(({ clipFromWorld: m, width, height }, i) => {
    const { shadowMatrix, shadowViewport: { x, y, z, w } } = light.getRenderData(eye.camera.camera, i);
    for (let k = 0; k < 40; ++k) {
      const point = new pc.Vec3(k % 2 === 0 ? -8 : 8, k % 3, 8 - 4 * k);
      const clip = [0, 1, 2].map((row) => m[row] * point.x + m[4 + row] * point.y + m[8 + row] * point.z + m[12 + row]);
      if (clip.some((c) => Math.abs(c) > 1)) continue;
      const found = shadowMatrix.transformPoint(point);
      const across = [found.x - (x + z * (0.5 * clip[0] + 0.5)), found.y - (y + w * (0.5 * clip[1] + 0.5))];
      most.texels = Math.max(most.texels, (Math.abs(across[0]) / z) * width, (Math.abs(across[1]) / w) * height);
      most.depth = Math.max(most.depth, Math.abs(found.z - (0.5 * clip[2] + 0.5)));
      ++most.points;
    }
  });
  return most;
}

async function matrices(gnomon) {
  const found = [];
  for (const [cascades, fit] of [[1, 'stable'], [2, 'tight'], [3, 'warped_stable'], [4, 'stable'], [4, 'tight']]) {
    const place = await street();
    const sun = place.light(SUN, { ...SHADOWS, numCascades: cascades });
    const shadows = new GnomonCascades(gnomon, place.app, sun, { options: { fit } });
    place.draw(sun);
    const { maps } = shadows.plan;
    found.push({
      cascades, fit, maps: maps.length, ...offBy(place, sun.light, shadows.plan), ends: maps.map(({ depthEnd }) => depthEnd), distances: [...sun.light._shadowCascadeDistances],
      // What each map draws holds all that gnomon culls for it.
      missing: maps.flatMap((map, i) => {
        const drawn = new Set(sun.light.getRenderData(place.eye.camera.camera, i).visibleCasters);
        const all = place.app.scene.layers.getLayerById(pc.LAYERID_WORLD).shadowCasters;
        return [...gnomon.cull(map, shadows.bounds.casters)].filter((k) => !drawn.has(all[k]));
      }).length,
      slope: sun.light.shadowDepthState.depthBiasSlope, normal: sun.light.normalOffsetBias,
    });
    place.app.destroy();
  }
  return found;
}

async function givenBack(gnomon) {
  const place = await street();
  const [sun, other] = [place.light(SUN, SHADOWS), place.light([0.6, 1, 0.2], SHADOWS)];
  const hook = hookOf(place.app);
  const { cull } = hook;
  const [before, others] = [place.draw(sun), place.draw(other)];
  const shadows = new GnomonCascades(gnomon, place.app, sun);
  const during = place.draw(sun);
  const othersDuring = place.draw(other);
  shadows.dispose();
  const found = { differs: !same(before, during), others: same(others, othersDuring), after: same(before, place.draw(sun)), hook: hook.cull === cull };
  place.app.destroy();
  return found;
}

async function followed(gnomon) {
  const place = await street();
  const sun = place.light(SUN, SHADOWS);
  const options = { fit: 'tight' };
  const shadows = new GnomonCascades(gnomon, place.app, sun, { options });
  const first = place.draw(sun);
  const { casters } = shadows.bounds;
  const house = place.entities[6];
  house.translate(0, 0, 30);
  const moved = place.draw(sun);
  const kept = casters === shadows.bounds.casters;
  place.entities[7].enabled = false;
  place.draw(sun);
  const count = shadows.bounds.casters.count;
  place.entities[7].enabled = true;
  const again = place.draw(sun);
  shadows.dispose();
  new GnomonCascades(gnomon, place.app, sun, { options });
  const found = { moves: !same(first, moved), kept, count, all: place.entities.length, fresh: same(again, place.draw(sun)), back: same(again, moved) };
  place.app.destroy();
  return found;
}

/** A second camera, and a light without a caster. */
async function views(gnomon) {
  const place = await street();
  const sun = place.light(SUN, { ...SHADOWS, cascadeBlend: 0.2 });
  const unshadowed = place.light(SUN, { castShadows: false });
  const shadows = new GnomonCascades(gnomon, place.app, sun);
  const alone = place.draw(sun);
  const blend = sun.light.cascadeBlend;
  const bands = shadows.plan.maps.slice(1).map(({ overlap, depthBegin }) => overlap / depthBegin);
  const second = new pc.Entity();
  // Planned and drawn after the first one, beside its picture.
  const renderTarget = new pc.RenderTarget({ colorBuffer: new pc.Texture(place.app.graphicsDevice, { width: 64, height: 64, mipmaps: false }), depth: true });
  second.addComponent('camera', { farClip: 60, priority: 1, renderTarget });
  second.setPosition(20, 5, 0);
  place.app.root.addChild(second);
  const twice = same(alone, place.draw(sun));
  second.enabled = false;
  for (const { render } of place.entities) render.castShadows = false;
  const none = same(place.draw(sun), place.draw(unshadowed));
  const { status } = shadows.plan;
  place.app.destroy();
  return { twice, none, status, blend, bands };
}

async function refused(gnomon) {
  const place = await street();
  const sun = place.light(SUN, SHADOWS);
  const entity = new pc.Entity();
  entity.addComponent('light', { type: 'omni' });
  const made = (...given) => new GnomonCascades(gnomon, ...given);
  const calls = {
    module: () => new GnomonCascades({}, place.app, sun), app: () => made({}, sun), light: () => made(place.app, entity.light), none: () => made(place.app),
    older: () => hookOf(place.app, '2.22.1'), newer: () => hookOf(place.app, '3.0.0'),
    gone: () => hookOf({ renderer: { _shadowRendererDirectional: { shadowRenderer: {} } } }),
    type: () => made(place.app, place.light(SUN, { ...SHADOWS, shadowType: pc.SHADOW_VSM_16F })),
    twice: () => { made(place.app, sun); made(place.app, sun); },
    fit: () => { const another = place.light(SUN, SHADOWS); made(place.app, another, { options: { fit: 'loose' } }); place.draw(another); },
    overrides: () => { sun.shadowUpdateOverrides = [0, 2, 2, 2]; place.draw(sun); place.draw(sun); },
  };
  return Object.fromEntries(Object.entries(calls).map(([name, call]) => {
    try {
      call();
      return [name, ['none', '']];
    } catch (error) {
      return [name, [error.field ?? error.stack, error.message]];
    }
  }));
}

async function captured() {
  const place = await street({ picture: [960, 540], near: 0.5, fov: 60 });
  const sun = place.light(SUN, { castShadows: true, numCascades: 4, shadowResolution: 2048 });
  const frames = Array.from({ length: 8 }, (_, i) => {
    place.walk(i);
    place.draw(sun);
    return frameOf(place.app, place.eye.camera, sun, pc.shadowTypeInfo);
  });
  const capture = captureFlight(place.app, sun, frames, { name: 'PlayCanvas cascades, walk down a street', engine: `PlayCanvas ${pc.version}` });
  place.app.destroy();
  return capture;
}

async function cameras(gnomon) {
  const place = await street();
  place.app.render();
  const found = cameraOf(gnomon, place.eye.camera.camera, 100);
  const at = place.eye.getPosition(), ahead = place.eye.forward;
  place.app.destroy();
  return { found: JSON.parse(JSON.stringify(found, (_, value) => (ArrayBuffer.isView(value) ? Array.from(value) : value))), at: [at.x, at.y, at.z], ahead: [ahead.x, ahead.y, ahead.z] };
}

const CHECKS = { matrices, givenBack, followed, views, refused, captured, cameras };
export const run = async (name) => CHECKS[name](await load());
