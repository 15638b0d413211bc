// What do Babylon.js' cascaded shadows look like to `gnomon judge`? A capture of format gnomon-capture/1 (docs/captures.md).
//
//   const text = JSON.stringify(captureBabylon(scene, [generator]));   // CascadedShadowGenerators, after scene.render()
//
// Babylon's matrices act on row vectors, and lie in memory as those of column vectors do.

const matrix = (m) => Array.from(m.m);
const vector = (v) => [v.x, v.y, v.z];

function boxOf(mesh) {
  const { minimumWorld, maximumWorld } = mesh.getBoundingInfo().boundingBox;
  return { min: vector(minimumWorld), max: vector(maximumWorld) };
}

/** Texels that the generator's filter reaches from its own: 5 x 5, 3 x 3, or hardware's 2 x 2. */
function filterTexels(generator) {
  if (!generator.usePercentageCloserFiltering) return 0;
  return [2, 1, 0.5][generator.filteringQuality] ?? 1;
}

function mapsOf(generator, light, camera) {
  const ends = generator._viewSpaceFrustumsZ;
  return Array.from({ length: generator.numCascades }, (_, i) => ({
    clip_from_world: matrix(generator.getCascadeTransformMatrix(i)), light,
    width: generator.mapSize, height: generator.mapSize, depths: [i === 0 ? camera.minZ : ends[i - 1], ends[i]],
    clamps_depth: generator.depthClamp, filter_texels: filterTexels(generator),
    bias: { depth: generator.bias, normal_world: generator.normalBias },
  }));
}

/** Camera, lights and maps of this frame: one entry of a capture's `frames`. */
export function frameOf(scene, generators) {
  const camera = scene.activeCamera, engine = scene.getEngine();
  const lights = [], maps = [];
  for (const generator of generators) {
    lights.push({ type: 'directional', direction: vector(generator.getLight().direction) });
    maps.push(...mapsOf(generator, lights.length - 1, camera));
  }
  return {
    camera: {
      view_from_world: matrix(camera.getViewMatrix()), clip_from_view: matrix(camera.getProjectionMatrix()),
      width: engine.getRenderWidth(), height: engine.getRenderHeight(),
    },
    lights, maps,
  };
}

function fileOf(scene, generators, more) {
  const engine = scene.getEngine();
  const casters = new Set(generators.flatMap((generator) => generator.getShadowMap().renderList));
  const meshes = scene.meshes.filter((mesh) => mesh.isEnabled() && mesh.getTotalVertices() > 0);
  return {
    format: 'gnomon-capture/1', name: 'Babylon.js', engine: `Babylon.js ${engine.constructor.Version ?? ''}`.trim(),
    clip_space: {
      ndc_depth: engine.isNDCHalfZRange ? 'zero_to_one' : 'minus_one_to_one', reversed_z: engine.useReverseDepthBuffer,
      handedness: scene.useRightHandedSystem ? 'right' : 'left',
    },
    receivers: meshes.filter((mesh) => mesh.receiveShadows).map(boxOf), casters: meshes.filter((mesh) => casters.has(mesh)).map(boxOf),
    ...more,
  };
}

/** A whole capture of one frame. */
export const captureBabylon = (scene, generators, more = {}) => ({ ...fileOf(scene, generators, more), ...frameOf(scene, generators) });
/** A capture of several frames: hand in what frameOf() returned for each. */
export const captureFlight = (scene, generators, frames, more = {}) => ({ ...fileOf(scene, generators, more), frames });
