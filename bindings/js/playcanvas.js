// gnomon's shadow maps in PlayCanvas (2.23 and newer): the cascades of a directional light. Shaders, filters, materials and the
// drawing of casters are PlayCanvas' own; the shadow cameras, splits and biases are gnomon's.
import { LIGHTTYPE_DIRECTIONAL, Mat4, Quat, Vec3, shadowTypeInfo, version } from 'playcanvas';
import { FollowedBounds, cameraUpTo, loaded, planForRasterizer, withDefaults } from './adapter.js';
import { GnomonError } from './memory.js';

const basis = /*@__PURE__*/ new Mat4();
const view = /*@__PURE__*/ new Mat4();
const rotation = /*@__PURE__*/ new Quat();
// What PlayCanvas' look-up of a sun takes off its depth, 0..1.
const OWN_BIAS = 1e-4;
// What its rasterizer takes for too little of a turned grid's slope: with its kernels 0.45 leaves more acne than its own maps have.
const TURNED_SLOPE_TEXELS = 0.9;
// A blend of 0 has another shader than one above.
const LEAST_BLEND = 1e-6;

/** Boxes of the mesh instances that cast into a light's maps, and of those that receive. update() follows them: each frame. */
class ShadowBounds extends FollowedBounds {
  update(light, layers) {
    const lit = new Set(layers.filter((layer) => layer.hasLight(light)));
    this.gather((casters, receivers) => {
      for (const { shadowCasters, meshInstances } of lit) {
        for (const one of shadowCasters) if (one.castShadow && one.visible) addBox(casters, one.aabb);
        for (const one of meshInstances) if (one.receiveShadow && one.visible) addBox(receivers, one.aabb);
      }
    });
  }
}
function addBox(boxes, { center: { x, y, z }, halfExtents: half }) {
  boxes.add(x - half.x, y - half.y, z - half.z, x + half.x, y + half.y, z + half.z);
}

/** PlayCanvas' renderer of a sun's maps, whose `cull` is no public name. `release`: the version of the engine. */
export function hookOf(app, release = version) {
  const [major, minor] = release.split('.').map(Number);
  if (!(major === 2 && minor >= 23)) throw new GnomonError('playcanvas', `gnomon: playcanvas: expected 2.23 or newer of 2, found ${release}`);
  const hook = app?.renderer?._shadowRendererDirectional;
  if (typeof hook?.cull !== 'function' || typeof hook.shadowRenderer?.cullShadowCasters !== 'function')
    throw new GnomonError('app', `gnomon: app: PlayCanvas ${release} has no renderer._shadowRendererDirectional.cull`);
  return hook;
}

/** The camera that PlayCanvas draws with (`cameraComponent.camera`), as gnomon counts it. `far`: shadows end there at the latest. */
export function cameraOf(gnomon, camera, far = Infinity) {
  const { node, rect, projectionMatrix, renderTarget, device } = camera;
  const { width, height } = renderTarget ?? device;
  return cameraUpTo(gnomon, {
    viewFromWorld: view.setTRS(node.getPosition(), node.getRotation(), Vec3.ONE).invert().data,
    clipFromView: projectionMatrix.data,
    width: Math.max(1, Math.round(width * rect.z)),
    height: Math.max(1, Math.round(height * rect.w)),
  }, far);
}

/** Texels beside its own that a look-up of this SHADOW_PCF... reads; undefined for other shadow types. */
export const radiusOf = (shadowType) => ({ PCF1: 1, PCF3: 1.5, PCF5: 2.5 })[shadowTypeInfo.get(shadowType)?.kind];

/** A map's bias as the polygon offset that PlayCanvas draws it with, beside what its look-up has. */
export function biasOf(map, { radius, slopeTexels = 0.5, sixteenBits = false }) {
  const depth = Math.max(0, map.biasConstant / map.depthRangeWorld - OWN_BIAS);
  // Units of a depth of 1; in single precision, of depths in 0.5..1. Nearer ones have smaller units.
  return { depthBias: depth * 2 ** (sixteenBits ? 16 : 24), depthBiasSlope: slopeTexels + radius };
}

/** Poses a shadow camera: an orthographic one in the middle of the near plane of a matrix without a warp. */
function pose(camera, m) {
  const [right, up, ahead] = [0, 1, 2].map((row) => {
    const [x, y, z] = [m[row], m[4 + row], m[8 + row]];
    const scale = Math.hypot(x, y, z);
    return { scale, x: x / scale, y: y / scale, z: z / scale };
  });
  const [r, u, a] = [-m[12] / right.scale, -m[13] / up.scale, (-1 - m[14]) / ahead.scale];
  const place = (c) => r * right[c] + u * up[c] + a * ahead[c];
  camera.node.setPosition(place('x'), place('y'), place('z'));
  // A camera of PlayCanvas looks down its -z.
  basis.data.set([right.x, right.y, right.z, 0, up.x, up.y, up.z, 0, -ahead.x, -ahead.y, -ahead.z]);
  camera.node.setRotation(rotation.setFromMat4(basis));
  Object.assign(camera, { nearClip: 0, farClip: 2 / ahead.scale, orthoHeight: 1 / up.scale, aspectRatio: up.scale / right.scale });
  camera.updateFrustum();
}

// Of each renderer's hook, the lights that gnomon plans.
const taken = /*@__PURE__*/ new WeakMap();

/** Wraps `cull` for the lights that are taken; all others have PlayCanvas' own. */
function take(hook, light, shadows) {
  if (!taken.has(hook)) {
    const own = hook.cull;
    const lights = new Map();
    hook.cull = function (one, comp, camera, casters, mask) {
      const planned = lights.get(one);
      if (planned === undefined || radiusOf(one.shadowType) === undefined) return own.call(this, one, comp, camera, casters, mask);
      return planned.cull(comp, camera, casters ?? null, mask ?? this.getCascadeMask(one));
    };
    taken.set(hook, { lights, own, wrapped: hook.cull });
  }
  const { lights } = taken.get(hook);
  if (lights.has(light)) throw new GnomonError('light', 'gnomon: light: has the maps of another GnomonCascades');
  lights.set(light, shadows);
}
function giveBack(hook, light) {
  const { lights, own, wrapped } = taken.get(hook);
  lights.delete(light);
  // Who wrapped it later goes on to call this wrapper, which then has no light.
  if (lights.size > 0 || hook.cull !== wrapped) return;
  hook.cull = own;
  taken.delete(hook);
}

/**
 * gnomon's maps for a directional light of PlayCanvas: `new GnomonCascades(gnomon, app, entity.light)`. numCascades, shadowResolution,
 * shadowDistance and the type of PCF are the light's. gnomon sets the bias of each map, and has no normal offset.
 */
export class GnomonCascades {
  constructor(gnomon, app, lightComponent, { options = {} } = {}) {
    const light = lightComponent?.light;
    this.gnomon = loaded(gnomon);
    this.hook = hookOf(app);
    if (light?.type !== LIGHTTYPE_DIRECTIONAL) throw new GnomonError('light', 'gnomon: light: expected a LightComponent of type directional');
    if (radiusOf(light.shadowType) === undefined) throw new GnomonError('shadowType', 'gnomon: shadowType: expected one of SHADOW_PCF');
    this.light = light;
    this.options = { splitOverlap: light.cascadeBlend, ...withDefaults(options) };
    this.bounds = new ShadowBounds(gnomon);
    this.views = new WeakMap();
    this.plan = null;
    const { depthBias, depthBiasSlope } = light.shadowDepthState;
    this.before = { normalOffsetBias: light.normalOffsetBias, cascadeBlend: light.cascadeBlend, state: { depthBias, depthBiasSlope } };
    take(this.hook, light, this);
    Object.assign(light, { normalOffsetBias: 0, cascadeBlend: this.options.splitOverlap });
  }

  /** In place of PlayCanvas' own: poses the shadow cameras for a camera, and lists what casts into each. */
  cull(comp, camera, casters, cascadeMask) {
    const { light, hook } = this;
    const count = light.numCascades;
    if (cascadeMask !== (1 << count) - 1) throw new GnomonError('shadowUpdateOverrides', 'gnomon: shadowUpdateOverrides: all cascades of a plan are drawn together');
    if (!this.views.has(camera)) this.views.set(camera, { history: this.gnomon.history(), ends: new Float32Array(4) });
    const seen = this.views.get(camera);
    const plan = this.planFor(comp, camera, count, seen.history);
    const { maps } = plan;
    // A depth beyond the last is lit; without maps, any is.
    seen.ends.fill(maps.at(-1)?.depthEnd ?? 0);
    maps.forEach(({ depthEnd }, i) => { seen.ends[i] = depthEnd; });
    // PlayCanvas blends over one share of all depths where cascades end.
    seen.blend = Math.max(LEAST_BLEND, Math.min(...maps.slice(1).map(({ overlap }, i) => overlap / maps[i].depthEnd), 1));
    for (let i = 0; i < count; ++i) {
      const data = light.getRenderData(camera, i);
      for (const rect of [data.shadowViewport, data.shadowScissor]) rect.copy(light.cascades[i]);
      data.visibleCasters.length = 0;
      const map = maps[i];
      if (map !== undefined) {
        pose(data.shadowCamera, map.clipFromWorld);
        hook.shadowRenderer.cullShadowCasters(comp, light, data.visibleCasters, data.shadowCamera, casters);
        data.visibleCasters = data.visibleCasters.filter(({ shadowCascadeMask }) => shadowCascadeMask & (1 << i));
      }
      // Called while PlayCanvas begins to draw the map. A light has one state for the maps of all cameras.
      data.shadowCamera.calculateProjection = () => this.begin(seen, plan, map);
    }
    this.begin(seen, plan, maps[0]);
  }

  planFor(comp, camera, cascades, history) {
    const { gnomon, light, bounds } = this;
    bounds.update(light, comp.layerList);
    const { x, y, z } = light._node.getWorldTransform().getY();  // a light shines down its -y
    this.plan = planForRasterizer(gnomon, {
      camera: cameraOf(gnomon, camera, light.shadowDistance),
      light: { direction: [-x, -y, -z] },
      casters: bounds.casters,
      receivers: bounds.receivers,
      options: {
        ...this.options,
        warp: 'none',  // a sun's look-up does not divide by w
        cascades,
        resolutionMaxSize: Math.floor(light.shadowResolution * light.cascades[0].z),
        filterTexels: Math.ceil(radiusOf(light.shadowType)),
      },
      history,
    }, TURNED_SLOPE_TEXELS);
    return this.plan;
  }

  begin({ ends, blend }, { biasSlopeTexels }, map) {
    const { light } = this;
    light._shadowCascadeDistances.set(ends);
    if (light.cascadeBlend > 0) light.cascadeBlend = blend;
    const sixteenBits = shadowTypeInfo.get(light.shadowType).name.endsWith('16F');
    if (map !== undefined) Object.assign(light.shadowDepthState, biasOf(map, { radius: radiusOf(light.shadowType), slopeTexels: biasSlopeTexels, sixteenBits }));
  }

  /** The light draws as before then. */
  dispose() {
    if (taken.get(this.hook)?.lights.get(this.light) !== this) return;
    giveBack(this.hook, this.light);
    const { state, ...own } = this.before;
    Object.assign(this.light, own);
    Object.assign(this.light.shadowDepthState, state);
    this.light.releaseRenderData();  // PlayCanvas poses cameras of its own, with an aspect of 1
    this.bounds.dispose();
  }
}
