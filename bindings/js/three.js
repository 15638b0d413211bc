// gnomon's shadow maps in three.js (0.187 and newer): the shadows of its SunLight, SpotLight and PointLight, and the lights of its CSM
// add-on. Shaders, lights and materials are three's own; the matrices, splits and biases are gnomon's.
import { Matrix4, OrthographicCamera, Vector3 } from 'three';
import { CSM } from 'three/addons/csm/CSM.js';
import { SunLightShadow } from 'three/addons/lights/SunLightShadow.js';
import { begin, biasOf, clipSpaceOf, end, planFor, setCamera, setEmpty } from './three_maps.js';

export { GnomonPointShadow, GnomonSpotShadow } from './three_local.js';
export { ShadowBounds, biasOf, cameraOf } from './three_maps.js';

const direction = /*@__PURE__*/ new Vector3();
const shift = /*@__PURE__*/ new Matrix4();

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
    this.history = gnomon.history();
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
 * The CSM add-on with gnomon's maps: `new GnomonCSM(gnomon, { parent: scene, camera, cascades: 4, ... })`. Takes the data of
 * CSM, and `options` of the plan, `resolution` and `bounds` as GnomonSunShadow. update() plans; updateFrustums() is not needed.
 */
export class GnomonCSM extends CSM {
  constructor(gnomon, { options, resolution, bounds, ...data }) {
    super(data);
    begin(this, gnomon, data.parent, { options, resolution, bounds });
    this.history = gnomon.history();
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
