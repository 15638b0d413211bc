// What do PlayCanvas' directional shadows look like to `gnomon judge`? A capture of format gnomon-capture/1 (docs/captures.md).
//
//   const text = JSON.stringify(capturePlayCanvas(app, camera, sun, shadowTypeInfo));   // components, after app.render()
//
// One directional light of 1 to 4 cascades. shadowTypeInfo is what PlayCanvas exports by that name.
const vector = (v) => [v.x, v.y, v.z];
const product = (a, b) => Array.from(a.clone().mul(b).data);
// Its kernels of 5 x 5 and 3 x 3 texels, or hardware's 2 x 2.
const FILTER_TEXELS = { PCF5: 2, PCF3: 1, PCF1: 0.5 };
// Of a look-up of a sun, off its depth of 0..1.
const OWN_BIAS = 1e-4;

/** A camera's view: PlayCanvas keeps a node's scale out of it. */
function viewOf({ node }) {
  const world = node.getWorldTransform().clone();
  return world.setTRS(node.getPosition(), node.getRotation(), node.getPosition().clone().set(1, 1, 1)).invert();
}

function boxOf({ aabb: { center, halfExtents: half } }) {
  const at = (side) => [center.x + side * half.x, center.y + side * half.y, center.z + side * half.z];
  return { min: at(-1), max: at(1) };
}

/** Reach of its kernel, and the bits of its depths. */
function filterOf(light, types) {
  const { kind, name } = types.get(light.shadowType);
  return { filter_texels: FILTER_TEXELS[kind] ?? 0, depth_bits: name.endsWith('16F') ? 16 : 0 };
}

function mapsOf(light, camera, types) {
  const size = light.shadowResolution, ends = light._shadowCascadeDistances;
  const { depthBias, depthBiasSlope } = light.shadowDepthState;
  const filter = filterOf(light, types);
  // The step of a polygon offset, in single precision at depths of 0.5..1.
  const step = 2 ** -(filter.depth_bits || 24);
  return Array.from({ length: light.numCascades }, (_, i) => {
    const { shadowCamera, shadowViewport: { x, y, z, w } } = light.getRenderData(camera, i);
    const atlas = [x, y, z, w].map((share) => share * size);
    return {
      clip_from_world: product(shadowCamera.projectionMatrix, viewOf(shadowCamera)), light: 0,
      width: atlas[2], height: atlas[3], atlas, depths: [i === 0 ? camera.nearClip : ends[i - 1], ends[i]], ...filter,
      bias: { depth: OWN_BIAS + depthBias * step, slope_factor: depthBiasSlope, normal_world: light.normalOffsetBias },
    };
  });
}

/** Camera, light and maps of this frame: one entry of a capture's `frames`. */
export function frameOf(app, { camera }, { light, entity }, types) {
  const { width, height } = camera.renderTarget ?? app.graphicsDevice;
  return {
    camera: { view_from_world: Array.from(viewOf(camera).data), clip_from_view: Array.from(camera.projectionMatrix.data), width, height },
    lights: [{ type: 'directional', direction: vector(entity.up).map((x) => -x) }],
    maps: mapsOf(light, camera, types),
  };
}

function fileOf(app, { light }, more) {
  const layers = [...new Set(app.scene.layers.layerList)].filter((layer) => layer.hasLight(light));
  const shown = (list) => layers.flatMap((layer) => layer[list]).filter((one) => one.visible);
  return {
    format: 'gnomon-capture/1', name: 'PlayCanvas', engine: 'PlayCanvas', clip_space: { ndc_depth: 'minus_one_to_one' },
    atlas: [light.shadowResolution, light.shadowResolution],
    receivers: shown('meshInstances').filter((one) => one.receiveShadow).map(boxOf), casters: shown('shadowCasters').map(boxOf),
    ...more,
  };
}

/** A whole capture of one frame. */
export const capturePlayCanvas = (app, camera, sun, types, more = {}) => ({ ...fileOf(app, sun, more), ...frameOf(app, camera, sun, types) });
/** A capture of several frames: hand in what frameOf() returned for each. */
export const captureFlight = (app, sun, frames, more = {}) => ({ ...fileOf(app, sun, more), frames });
