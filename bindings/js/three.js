// gnomon's shadow maps in three.js (0.187 and newer): the shadows of its SunLight and SpotLight, and the lights of its CSM
// add-on. Shaders, lights and materials are three's own; the matrices, splits and biases are gnomon's.
import { BackSide, Box3, FrontSide, Matrix4, OrthographicCamera, PerspectiveCamera, SpotLight, Vector3, WebGPUCoordinateSystem } from 'three';
import { CSM } from 'three/addons/csm/CSM.js';
import { SunLightShadow } from 'three/addons/lights/SunLightShadow.js';
import { FollowedBounds, cameraUpTo, loaded, withDefaults } from './adapter.js';

const direction = /*@__PURE__*/ new Vector3();
const shift = /*@__PURE__*/ new Matrix4();
const inverse = /*@__PURE__*/ new Matrix4();
const place = /*@__PURE__*/ new Vector3();
const moved = /*@__PURE__*/ new Vector3();
// three does not export it.
const SpotLightShadow = /*@__PURE__*/ (() => new SpotLight().shadow.constructor)();
// gnomon divides wider cones among several maps.
const WIDEST = (65.9 / 180) * Math.PI;

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

const clipSpaceOf = ({ coordinateSystem, reversedDepth }) =>
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
function setCamera(camera, map, { coordinateSystem, reversedDepth }) {
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
function setEmpty(frustum) {
  for (const plane of frustum.planes) {
    plane.normal.set(0, 0, 0);
    plane.constant = -Infinity;
  }
}

// What each of the shadows below has, as the manual says.
function begin(shadow, gnomon, scene, { options = {}, resolution = [1920, 1080], bounds }) {
  shadow.gnomon = loaded(gnomon);
  shadow.bounds = bounds ?? new ShadowBounds(gnomon, scene);
  shadow.ownsBounds = bounds === undefined;
  shadow.history = gnomon.history();
  shadow.options = withDefaults(options);
  shadow.resolution = resolution;
  shadow.plan = null;
}
function planFor({ gnomon, bounds, history, options, resolution }, light, camera, far, more) {
  bounds.follow();
  const { casters, receivers } = bounds;
  return gnomon.plan({ camera: cameraOf(gnomon, camera, resolution, far), light, casters, receivers, options: { ...options, ...more }, history });
}
function end({ history, bounds, ownsBounds }) {
  history.dispose();
  if (ownsBounds) bounds.dispose();
}

/**
 * The shadow of a SunLight: `sun.shadow = new GnomonSunShadow(gnomon, scene)`. As three's own it has two maps in one texture,
 * ends at `camera.far`, and takes `mapSize` and `radius`. `bias` and `normalBias` come on top of gnomon's.
 */
export class GnomonSunShadow extends SunLightShadow {
  /** options: of the plan; resolution: pixels of the picture, [1920, 1080]; bounds: a ShadowBounds to share. */
  constructor(gnomon, scene, options = {}) {
    super();
    this.isGnomonSunShadow = true;
    begin(this, gnomon, scene, options);
    this.options = { splitOverlap: 0.1, ...this.options };
  }

  updateMatrices(light, viewCamera) {
    if (viewCamera === undefined) return;
    const count = this._viewportCount;
    // Room between the maps, so that no filter reads the other one.
    const inset = Math.min(0.25, (Math.ceil(this.radius) + 1) / this.mapSize.x);
    for (let i = 0; i < count; ++i) this._viewports[i].set(i + inset, inset, 1 - 2 * inset, 1 - 2 * inset);
    direction.setFromMatrixPosition(light.matrixWorld).negate();
    this.plan = planFor(this, { direction: direction.toArray() }, viewCamera, this.camera.far, {
      cascades: count,
      resolutionMaxSize: Math.max(4, Math.floor(this.mapSize.x * (1 - 2 * inset))),
      filterTexels: Math.ceil(this.radius) + 1,
      clipSpace: clipSpaceOf(this.camera),
    });
    for (let i = 0; i < count; ++i) this.setMap(i, this.plan.maps[i], this.plan.maps[i + 1]);
  }

  setMap(index, map, next) {
    if (map === undefined) {
      this._cascadeData[index].set(0, 0, 0, 0);  // serves no depth
      setEmpty(this._frustums[index]);
      return;
    }
    const band = next === undefined ? 0 : Math.max(next.overlap, 1e-6 * map.depthEnd);
    this._cascadeData[index].set(index === 0 ? -1e10 : map.depthBegin - map.overlap, map.depthEnd, map.depthEnd - band, 0);
    setCamera(this._cameras[index], map, this.camera);
    this._updateMatrix(this._cameras[index], this._matrices[index], this._frustums[index], this._viewports[index]);
    // three has one bias for both maps: each map's own goes into its matrix.
    const { bias, slope } = biasOf(map, { frontFaces: this.bounds.frontFaces, radius: this.radius, slopeTexels: this.plan.biasSlopeTexels });
    this._cameras[index].userData.gnomonSlope = slope;
    this._matrices[index].premultiply(shift.makeTranslation(0, 0, this.camera.reversedDepth ? -bias : bias));
  }

  dispose() {
    super.dispose();
    end(this);
  }
}

/**
 * The shadow of a SpotLight: `spot.shadow = new GnomonSpotShadow(gnomon, scene)`. Its map holds what of the cone is in view. The
 * light ends at its distance, or at `camera.far`. gnomon sets `bias`. A light with a picture (`map`) or with a cone beyond 65.9
 * degrees has three's own map.
 */
export class GnomonSpotShadow extends SpotLightShadow {
  /** options, resolution, bounds: as those of GnomonSunShadow. */
  constructor(gnomon, scene, options = {}) {
    super();
    this.isGnomonSpotShadow = true;
    begin(this, gnomon, scene, options);
    this.fitted = new PerspectiveCamera();
  }

  getCamera() {
    return this.plan?.maps.length > 0 ? this.fitted : this.camera;
  }

  updateMatrices(light, viewCamera) {
    super.updateMatrices(light);
    this.plan = null;
    // The matrix also places the light's picture.
    if (viewCamera === undefined || light.map || !(light.angle < WIDEST)) return;
    direction.setFromMatrixPosition(light.target.matrixWorld).sub(place.setFromMatrixPosition(light.matrixWorld));
    const range = light.distance || this.camera.far;
    const cone = { kind: 'spot', position: place.toArray(), direction: direction.toArray(), outerRadians: light.angle, range };
    this.plan = planFor(this, cone, viewCamera, Infinity, {
      resolutionMaxSize: Math.max(4, Math.min(this.mapSize.x, this.mapSize.y)),
      filterTexels: Math.ceil(this.radius) + 1,
      clipSpace: clipSpaceOf(this.camera),
    });
    const [map, more] = this.plan.maps;
    if (map === undefined) {
      setEmpty(this._frustum);
      return;
    }
    if (more !== undefined) {
      this.plan = null;  // by options that divide the cone
      return;
    }
    setCamera(this.fitted, map, this.camera);
    this._updateMatrix(this.fitted, this.matrix, this._frustum);
    const { bias, slope } = biasOf(map, { frontFaces: this.bounds.frontFaces, radius: this.radius, slopeTexels: this.plan.biasSlopeTexels });
    // Depths of a perspective are no lengths: those at the distance of the map's texels.
    this.bias = bias === 0 ? 0 : -this.depthOf(map);
    this.fitted.userData.gnomonSlope = slope;
  }

  /** What the map's constant bias is at the distance of its middle texel, in depths of 0..1. */
  depthOf(map) {
    inverse.copy(this.matrix).invert();
    const far = moved.set(0.5, 0.5, 1 - 1e-3).applyMatrix4(inverse).sub(place);
    const reach = far.length();
    const axis = far.divideScalar(reach);
    const side = direction.set(0.5 + 1 / map.width, 0.5, 1 - 1e-3).applyMatrix4(inverse).sub(place).addScaledVector(axis, -reach).length();
    const distance = reach * Math.min(1, map.texelWorld[0] / side);
    const depth = (length) => direction.copy(place).addScaledVector(axis, length).applyMatrix4(this.matrix).z;
    return Math.abs(depth(distance + map.biasConstant) - depth(distance));
  }

  dispose() {
    super.dispose();
    end(this);
  }
}

/**
 * The CSM add-on with gnomon's maps: `new GnomonCSM(gnomon, { parent: scene, camera, cascades: 4, ... })`. Takes the data of
 * CSM, and `options` of the plan, `resolution` and `bounds` as GnomonSunShadow. update() plans; updateFrustums() is not needed.
 */
export class GnomonCSM extends CSM {
  constructor(gnomon, { options, resolution, bounds, ...data }) {
    super(data);
    begin(this, gnomon, data.parent, { options, resolution, bounds });
    for (const { shadow } of this.lights) {
      shadow.camera = new OrthographicCamera();
      // The matrices are set by update(). three computes the projection again when it makes the texture.
      shadow.updateMatrices = () => {};
      shadow.camera.updateProjectionMatrix = () => {};
    }
  }

  update() {
    const { camera, lightDirection } = this;
    camera.updateMatrixWorld();
    const far = Math.min(camera.far, this.maxFar);
    const { radius } = this.lights[0].shadow;
    // three updates the places of meshes after this.
    this.bounds.scene.updateMatrixWorld();
    this.plan = planFor(this, { direction: lightDirection.toArray() }, camera, far, {
      cascades: this.cascades,
      resolutionMaxSize: this.shadowMapSize,
      filterTexels: Math.ceil(radius) + 1,
      clipSpace: clipSpaceOf(camera),
    });
    this.lights.forEach((light, i) => this.setLight(light, this.plan.maps[i]));
    // Depths as the add-on's shader counts them. Lights without a map serve none.
    this.breaks.length = 0;
    let end = 0;
    for (let i = 0; i < this.cascades; ++i) this.breaks.push((end = this.plan.maps[i] ? this.plan.maps[i].depthEnd / (far - camera.near) : end));
    this._updateUniforms();
  }

  setLight(light, map) {
    light.target.position.copy(light.position).add(this.lightDirection);
    const { shadow } = light;
    if (map === undefined) {
      setEmpty(shadow._frustum);
      return;
    }
    setCamera(shadow.camera, map, this.camera);
    shadow._updateMatrix(shadow.camera, shadow.matrix, shadow._frustum);
    const { bias, slope } = biasOf(map, { frontFaces: this.bounds.frontFaces, radius: shadow.radius, slopeTexels: this.plan.biasSlopeTexels });
    shadow.bias = bias;
    shadow.camera.userData.gnomonSlope = slope;
  }

  updateFrustums() {
    // The constructor of CSM calls it before there is a plan.
    if (this.gnomon === undefined) super.updateFrustums();
    else this.update();
  }

  dispose() {
    super.dispose();
    end(this);
  }
}
