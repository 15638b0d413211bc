// gnomon's shadow maps for the lights of three.js that have a position: SpotLight and PointLight.
import { Frustum, Matrix4, PerspectiveCamera, PointLight, SpotLight, Vector3 } from 'three';
import { CubeSearch, FACES, coneOf, faceOf, mapsOf } from './cube.js';
import { GnomonError } from './memory.js';
import { begin, biasOf, cameraOf, clipSpaceOf, end, planFor, setCamera, setEmpty } from './three_maps.js';

const direction = /*@__PURE__*/ new Vector3();
const inverse = /*@__PURE__*/ new Matrix4();
const clip = /*@__PURE__*/ new Matrix4();
const place = /*@__PURE__*/ new Vector3();
const corner = /*@__PURE__*/ new Vector3();
// three does not export them.
const SpotLightShadow = /*@__PURE__*/ (() => new SpotLight().shadow.constructor)();
const PointLightShadow = /*@__PURE__*/ (() => new PointLight().shadow.constructor)();
// gnomon divides wider cones among several maps.
const WIDEST = (65.9 / 180) * Math.PI;

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
    this.history = gnomon.history();
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
    const far = corner.set(0.5, 0.5, 1 - 1e-3).applyMatrix4(inverse).sub(place);
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

// Of each scene, the camera that it is drawn with. three hands none to the shadow of a point light.
const views = /*@__PURE__*/ new WeakMap();
function viewOf(scene) {
  if (scene?.isScene !== true) throw new GnomonError('scene', 'gnomon: scene: expected a Scene of three');
  if (!views.has(scene)) {
    const view = { camera: undefined, draws: 0 };
    const { onBeforeRender } = scene;
    scene.onBeforeRender = function (renderer, drawn, camera, target) {
      Object.assign(view, { camera, draws: view.draws + 1 });
      onBeforeRender.call(this, renderer, drawn, camera, target);
    };
    views.set(scene, view);
  }
  return views.get(scene);
}
// By fit: of the error that a cube has, the share at which another takes its place. Then all of its texels move.
const KEPT = { stable: 0, warped_stable: 0.8, rotated: 1, tight: 1 };
// Rays to visible points that the error is measured at.
const GRID = { columns: 16, rows: 9 };

/**
 * The shadow of a PointLight: `bulb.shadow = new GnomonPointShadow(gnomon, scene)`. three looks up by the direction alone, through
 * one matrix: gnomon turns and stretches the cube by it, towards what is in view. Faces without visible shadows draw nothing.
 * `camera.near` becomes that of the stretched cube.
 */
export class GnomonPointShadow extends PointLightShadow {
  /** resolution, bounds: as those of GnomonSunShadow; options: fit, biasConstantTexels and biasSlopeTexels of the plan. */
  constructor(gnomon, scene, options = {}) {
    super();
    this.isGnomonPointShadow = true;
    begin(this, gnomon, scene, options);
    this.search = new CubeSearch();
    this.view = viewOf(scene);
    this.drawn = this.view.draws;
    this.biasTexels = { constant: 0.15, slope: 0.5 };  // until there is a plan
    this._cameras = FACES.map(() => new PerspectiveCamera());
    this._frustums = FACES.map(() => new Frustum());
    this._direction = new Matrix4();
  }

  getCamera(face = 0) {
    return this._cameras[face];
  }

  /** three calls it for each face, after it set `camera.position`, `camera.far` and a matrix of its own. */
  getFrustum(face = 0) {
    const { view, drawn } = this;
    if (face === 0) {
      // Without a new draw somebody replaced the scene's handler, and what is in view is not known.
      this.fit(view.draws === drawn ? undefined : view.camera);
      this.drawn = view.draws;
    }
    this.matrix.copy(this._direction);
    return this._frustums[face];
  }

  updateMatrices(light, viewCamera) {
    this.camera.position.setFromMatrixPosition(light.matrixWorld);
    this.camera.far = light.distance || this.camera.far;
    this.fit(viewCamera);
    this.matrix.copy(this._direction);
  }

  /** Fits the cube to what `viewCamera` sees of the light at `camera.position`; without one, all faces are drawn. */
  fit(viewCamera) {
    const { camera, search } = this;
    const position = camera.position.toArray();
    const maps = (cube) => mapsOf(cube, position, this.mapSize.x, camera.far);
    let seen = FACES.map(() => true), status = 'ok';
    if (viewCamera !== undefined) {
      const { gnomon, bounds, options, resolution } = this;
      const keep = KEPT[options.fit];
      if (keep === undefined) throw new GnomonError('plan_options.fit');
      bounds.follow();
      const { casters, receivers } = bounds;
      const depth = -place.copy(camera.position).applyMatrix4(viewCamera.matrixWorldInverse).z;
      // Nothing is lit beyond.
      const view = { camera: cameraOf(gnomon, viewCamera, resolution, depth + camera.far), receivers };
      if (keep === 0) search.reset();
      else search.follow((cube) => gnomon.measure({ maps: maps(cube), selection: 'first_holding' }, { ...view, grid: GRID }).mean, keep);
      const plans = FACES.map((_, face) => {
        const { axis, angle } = coneOf(search.cube, face);
        const light = { kind: 'spot', position, direction: axis, outerRadians: angle, range: camera.far };
        return gnomon.plan({ ...view, casters, light, options: { ...options, fit: 'tight', warp: 'none' } });
      });
      seen = plans.map((plan) => plan.status === 'ok');
      if (!seen.includes(true)) [{ status }] = plans;
      this.biasTexels = { constant: plans[0].biasConstantTexels, slope: plans[0].biasSlopeTexels };
    }
    this.plan = { status, maps: maps(search.cube).filter((_, face) => seen[face]), selection: 'first_holding' };
    this.setFaces(seen);
  }

  setFaces(seen) {
    const { camera, radius, search: { cube }, biasTexels: { constant, slope }, bounds: { frontFaces } } = this;
    // As somebody else set it: of the world.
    if (camera.near !== this._cubeNear) this._near = camera.near;
    camera.near = this._cubeNear = this._near * cube.least;
    camera.updateProjectionMatrix();
    // three compares with a sphere around the light, whose depth on a face changes by about a texel from texel to texel. This moves
    // depths away from the light by as many texels at any distance; a look-up reads half of `radius` texels beside its own.
    if (frontFaces) camera.projectionMatrix.elements[14] /= 1 + (2 * (constant + slope + radius / 2)) / this.mapSize.x;
    const { x, y, z } = camera.position;
    FACES.forEach((_, face) => {
      const [across, along, out] = faceOf(cube, face);
      clip.set(...across, 0, ...along, 0, -out[0], -out[1], -out[2], 0, 0, 0, 0, 1).multiply(inverse.makeTranslation(-x, -y, -z)).premultiply(camera.projectionMatrix);
      setCamera(this._cameras[face], { clipFromWorld: clip.elements }, camera);
      this._cameras[face].userData.gnomonSlope = frontFaces ? slope + radius : 0;
      if (seen[face]) this._frustums[face].setFromProjectionMatrix(clip, camera.coordinateSystem, camera.reversedDepth);
      else setEmpty(this._frustums[face]);
    });
    const [a, b, c] = cube.shape;
    this._direction.set(...a, 0, ...b, 0, ...c, 0, 0, 0, 0, 1).multiply(inverse.makeTranslation(-x, -y, -z));
  }

  dispose() {
    super.dispose();
    end(this);
  }
}
