// What do the shadows of three.js share? Boxes of a scene, cameras, biases, and the plan of a light.
import { BackSide, Box3, FrontSide, Matrix4, WebGPUCoordinateSystem } from 'three';
import { FollowedBounds, cameraUpTo, loaded, planForRasterizer, withDefaults } from './adapter.js';

/**
 * Boxes of the meshes below an object that cast and receive shadows. follow() takes their places, each frame; update() gathers them
 * again, after meshes came, went or changed.
 */
export class ShadowBounds extends FollowedBounds {
  constructor(gnomon, scene) {
    super(gnomon);
    this.scene = scene;
    this.update();
  }

  update() {
    this.meshes = [];
    this.frontFaces = false;
    this.scene.updateMatrixWorld();
    this.scene.traverseVisible((mesh) => {
      if (!mesh.isMesh || !(mesh.castShadow || mesh.receiveShadow)) return;
      // Instances and skins have bounds of their own; others take those of their geometry.
      const own = typeof mesh.computeBoundingBox === 'function' ? mesh : mesh.geometry;
      if (own.boundingBox === null) own.computeBoundingBox();
      if (own.boundingBox.isEmpty()) return;
      this.meshes.push({ mesh, own, bounds: new Box3(), matrix: new Matrix4().makeScale(NaN, NaN, NaN) });
      if (!mesh.castShadow) return;
      // What three draws into its maps: the back faces of one-sided materials, unless they say otherwise.
      for (const { side, shadowSide } of [mesh.material].flat()) {
        const drawn = shadowSide ?? (side === FrontSide ? BackSide : side === BackSide ? FrontSide : side);
        if (drawn === BackSide) continue;
        this.frontFaces = true;
        drawWithSlope(mesh);
      }
    });
    this.follow();
  }

  follow() {
    this.gather((casters, receivers) => {
      for (const { mesh, own, bounds, matrix } of this.meshes) {
        const { min, max } = bounds;
        // Most meshes stand still, and a comparison costs less than eight corners. NaN equals nothing, at first.
        if (!matrix.equals(mesh.matrixWorld)) bounds.copy(own.boundingBox).applyMatrix4(matrix.copy(mesh.matrixWorld));
        if (mesh.castShadow) casters.add(min.x, min.y, min.z, max.x, max.y, max.z);
        if (mesh.receiveShadow) receivers.add(min.x, min.y, min.z, max.x, max.y, max.z);
      }
    });
  }
}

/** The camera that three draws with, as gnomon counts it. `far`: shadows end there at the latest. */
export function cameraOf(gnomon, camera, [width, height], far = Infinity) {
  const matrices = {
    viewFromWorld: camera.matrixWorldInverse.elements,
    clipFromView: camera.projectionMatrix.elements,
    clipSpace: clipSpaceOf(camera),
    width,
    height,
  };
  return cameraUpTo(gnomon, matrices, far);
}

export const clipSpaceOf = ({ coordinateSystem, reversedDepth }) =>
  ({ zeroToOne: coordinateSystem === WebGPUCoordinateSystem || reversedDepth === true, reversedZ: reversedDepth === true });

/**
 * A map's bias in three's units. `bias` is in depths of 0..1, three adds it to the look-up's. `slope` is the factor of a
 * polygon offset, with which casters are drawn. three draws the back faces of one-sided materials into its maps, and these need
 * no bias. Where front faces are drawn (`frontFaces`), a look-up reads `radius` texels beside its own.
 */
export function biasOf(map, { frontFaces, radius = 1, slopeTexels = 0.5 }) {
  if (!frontFaces) return { bias: 0, slope: 0 };
  return { bias: -map.biasConstant / map.depthRangeWorld, slope: slopeTexels + radius };
}

/**
 * Draws a mesh into gnomon's maps with the offset by slope of their cameras. three's look-up has none: its offset along the
 * normal is one length for a whole map, far too much for the small texels near the eye.
 */
function drawWithSlope(mesh) {
  if (mesh.onBeforeShadow.drawsWithSlope) return;
  const { onBeforeShadow, onAfterShadow } = mesh;
  let before;
  mesh.onBeforeShadow = function (renderer, object, camera, shadowCamera, geometry, material, group) {
    onBeforeShadow.call(this, renderer, object, camera, shadowCamera, geometry, material, group);
    const { polygonOffset, polygonOffsetFactor } = material;
    before = { polygonOffset, polygonOffsetFactor };
    const slope = shadowCamera.userData.gnomonSlope ?? 0;
    if (slope > 0) Object.assign(material, { polygonOffset: true, polygonOffsetFactor: polygonOffsetFactor + slope });
  };
  mesh.onBeforeShadow.drawsWithSlope = true;
  mesh.onAfterShadow = function (renderer, object, camera, shadowCamera, geometry, material, group) {
    // three draws other lights with the same material.
    Object.assign(material, before);
    onAfterShadow.call(this, renderer, object, camera, shadowCamera, geometry, material, group);
  };
}

/** Sets a camera of three to a map's matrix: the view is the world itself. */
export function setCamera(camera, map, { coordinateSystem, reversedDepth }) {
  camera.coordinateSystem = coordinateSystem;
  camera._reversedDepth = reversedDepth;
  camera.matrixAutoUpdate = false;
  camera.matrixWorldAutoUpdate = false;
  camera.matrixWorld.identity();
  camera.matrixWorldInverse.identity();
  camera.projectionMatrix.fromArray(map.clipFromWorld);
  camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
}

/** Makes a frustum that nothing is in. */
export function setEmpty(frustum) {
  for (const plane of frustum.planes) {
    plane.normal.set(0, 0, 0);
    plane.constant = -Infinity;
  }
}

/** What each shadow has, as the manual says. */
export function begin(shadow, gnomon, scene, { options = {}, resolution = [1920, 1080], bounds }) {
  shadow.gnomon = loaded(gnomon);
  shadow.bounds = bounds ?? new ShadowBounds(gnomon, scene);
  shadow.ownsBounds = bounds === undefined;
  shadow.options = withDefaults(options);
  shadow.resolution = resolution;
  shadow.plan = null;
}
export function planFor({ gnomon, bounds, history, options, resolution }, light, camera, far, more) {
  bounds.follow();
  const { casters, receivers } = bounds;
  const view = { camera: cameraOf(gnomon, camera, resolution, far), casters, receivers };
  return planForRasterizer(gnomon, { ...view, light, options: { ...options, ...more }, history });
}
export function end({ history, bounds, ownsBounds }) {
  history?.dispose();
  if (ownsBounds) bounds.dispose();
}
