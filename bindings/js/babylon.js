// gnomon's shadow maps in Babylon.js (9.35 and newer): the maps of its cascaded and of its single shadow generator. Shaders,
// filters, lights and materials are Babylon's own; the matrices, splits, biases and lists of casters are gnomon's.
import { CascadedShadowGenerator } from '@babylonjs/core/Lights/Shadows/cascadedShadowGenerator.js';
import { ShadowGenerator } from '@babylonjs/core/Lights/Shadows/shadowGenerator.js';
import { Matrix } from '@babylonjs/core/Maths/math.vector.js';
import { FollowedBounds, cameraUpTo, loaded, planForRasterizer, withDefaults } from './adapter.js';
import { GnomonError } from './memory.js';

const DIRECTIONAL = 1;
// A look-up there reads what is cleared to: lit.
const NOWHERE = /*@__PURE__*/ Matrix.FromValues(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1);
// Far below 1 / w of all maps, and a power of two: no bit of a quotient changes.
const SMALL = 2 ** -16;
const inverse = /*@__PURE__*/ new Matrix();
const clip = /*@__PURE__*/ new Matrix();

/** Boxes of the meshes that cast into a generator's maps, and of those that receive. update() follows them: each frame. */
class ShadowBounds extends FollowedBounds {
  constructor(gnomon, generator) {
    super(gnomon);
    this.generator = generator;
    this.meshes = [];
    this.update();
  }

  update() {
    const scene = this.generator.light.getScene();
    this.meshes.length = 0;
    this.gather((casters, receivers) => {
      for (const mesh of this.generator.getShadowMap()?.renderList ?? scene.meshes) {
        if (addBox(casters, mesh)) this.meshes.push(mesh);
      }
      for (const mesh of scene.meshes) {
        if (mesh.receiveShadows) addBox(receivers, mesh);
      }
    });
  }
}

/** False where Babylon draws nothing of the mesh. */
function addBox(boxes, mesh) {
  if (!mesh.subMeshes || !mesh.isVisible || !mesh.isEnabled()) return false;
  const { minimumWorld, maximumWorld } = mesh.getBoundingInfo().boundingBox;
  boxes.add(minimumWorld.x, minimumWorld.y, minimumWorld.z, maximumWorld.x, maximumWorld.y, maximumWorld.z);
  return true;
}

const clipSpaceOf = (engine, leftHanded) =>
  ({ zeroToOne: engine.isNDCHalfZRange, reversedZ: engine.useReverseDepthBuffer, leftHanded });

/** The camera that Babylon draws with, as gnomon counts it. `far`: shadows end there at the latest. */
export function cameraOf(gnomon, camera, far = Infinity) {
  const engine = camera.getEngine();
  const matrices = {
    // Babylon's vectors are rows: the memory of its matrices is that of columns.
    viewFromWorld: camera.getViewMatrix().m,
    clipFromView: camera.getProjectionMatrix().m,
    clipSpace: clipSpaceOf(engine, !camera.getScene().useRightHandedSystem),
    width: Math.max(1, Math.round(engine.getRenderWidth() * camera.viewport.width)),
    height: Math.max(1, Math.round(engine.getRenderHeight() * camera.viewport.height)),
  };
  return cameraUpTo(gnomon, matrices, far);
}

/** Texels beside its own that a look-up of the generator's filter reads. */
export function radiusOf({ filter, filteringQuality, blurKernel, blurScale }) {
  if (filter === ShadowGenerator.FILTER_NONE) return 0.5;
  if (filter !== ShadowGenerator.FILTER_PCF) return filter === ShadowGenerator.FILTER_PCSS ? 4 : Math.max(2, 0.5 * blurKernel * blurScale);
  return filteringQuality === ShadowGenerator.QUALITY_HIGH ? 2.5 : filteringQuality === ShadowGenerator.QUALITY_MEDIUM ? 1.5 : 1;
}

// Of a filter's radius. Beside a wall that the light grazes, its kernel reads the roof, which a slope offset hardly moves. Grids of fit stable
// have texels so large that walls were dark along their upper edges. Warped maps have no one length for it.
const BESIDE_WALLS = 0.9;

/**
 * A map's bias in Babylon's units. `bias` is in depths of clip space, `normalBias` moves casters inward along their normal, world
 * units per sine. `slope` is the factor of a polygon offset; it follows the map's texels where they are not equally large, but
 * shifts depth textures alone, so that other filters than PCF have normalBias in its place.
 */
export function biasOf(map, { filter, radius, slopeTexels = 0.5, backFaces = false }) {
  if (backFaces) return { bias: 0, normalBias: 0, slope: 0 };
  const depth = map.biasConstant / map.depthRangeWorld;
  const slope = slopeTexels + radius, texel = Math.max(...map.texelWorld);
  if (filter !== ShadowGenerator.FILTER_PCF) return { bias: depth, normalBias: slope * texel, slope: 0 };
  const beside = map.snapValid ? (BESIDE_WALLS * radius * texel) / map.depthRangeWorld : 0;
  return { bias: 2 * (depth + beside), normalBias: 0, slope };
}

/** Of both generators: planning, lists of casters for each map, biases. */
class Planner {
  constructor(gnomon, generator, { options = {} }) {
    this.gnomon = loaded(gnomon);
    this.generator = generator;
    this.options = withDefaults(options);
    this.history = gnomon.history();
    this.bounds = new ShadowBounds(gnomon, generator);
    this.plan = null;
    this.drawn = [];
    this.slope = 0;
    this.observers = [];
  }

  /** To be called for each texture that the generator makes, which may have cleared its observables then. */
  watchTexture(texture) {
    texture.getCustomRenderList = (layer) => this.drawn[layer] ?? [];
    texture.onBeforeRenderObservable.add((layer) => this.setBias(layer));
    this.unwatch();
    const { generator } = this;
    const engine = generator.light.getScene().getEngine();
    this.observers = [
      [generator.onBeforeShadowMapRenderMeshObservable, () => { if (this.slope > 0) engine.setZOffset(this.slope); }],
      [generator.onAfterShadowMapRenderMeshObservable, () => { if (this.slope > 0) engine.setZOffset(0); }],
    ].map(([observable, call]) => [observable, observable.add(call)]);
  }
  unwatch() {
    for (const [observable, observer] of this.observers) observable.remove(observer);
  }

  planFor(camera, cascades, { far, overlap }) {
    const { gnomon, generator, bounds, history } = this;
    bounds.update();
    generator.light.computeTransformedInformation();  // where it has a parent
    // Other filters than PCF read depths that are not divided by w.
    const warps = generator.filter === ShadowGenerator.FILTER_PCF;
    const { width, height } = generator.getShadowMap().getSize();
    this.plan = planForRasterizer(gnomon, {
      camera: cameraOf(gnomon, camera, far),
      light: { direction: generator.light.getShadowDirection(0).asArray() },
      casters: bounds.casters,
      receivers: bounds.receivers,
      options: {
        splitOverlap: overlap,
        ...this.options,
        ...(warps ? {} : { warp: 'none' }),
        cascades,
        resolutionMaxSize: Math.min(width, height),
        filterTexels: Math.ceil(radiusOf(generator)),
        // Babylon draws maps as a left-handed world's, and turns the winding round in a right-handed one.
        clipSpace: clipSpaceOf(generator.light.getScene().getEngine(), true),
      },
      history,
    });
    this.drawn = this.plan.maps.map((map) => Array.from(gnomon.cull(map, bounds.casters), (i) => bounds.meshes[i]));
    return this.plan.maps;
  }

  setBias(layer) {
    const { generator, plan } = this;
    const map = plan?.maps[layer];
    if (map === undefined) return;
    const { bias, normalBias, slope } = biasOf(map, {
      filter: generator.filter,
      radius: radiusOf(generator),
      slopeTexels: plan.biasSlopeTexels,
      backFaces: generator.forceBackFacesOnly,
    });
    Object.assign(generator, { bias, normalBias });
    this.slope = slope;
  }

  dispose() {
    this.unwatch();
    this.history.dispose();
    this.bounds.dispose();
  }
}

function directional(light) {
  if (light?.getTypeID?.() !== DIRECTIONAL) throw new GnomonError('light', 'gnomon: light: expected a DirectionalLight');
  return light;
}

/**
 * Babylon's CascadedShadowGenerator with gnomon's maps: `new GnomonCascadedShadowGenerator(gnomon, 1024, light)`. numCascades,
 * mapSize, filter, shadowMaxZ and cascadeBlendPercentage are Babylon's. gnomon sets bias and normalBias for each map.
 */
export class GnomonCascadedShadowGenerator extends CascadedShadowGenerator {
  /** options: of the plan; camera: as Babylon's own constructor takes it. */
  constructor(gnomon, mapSize, light, { options = {}, camera } = {}) {
    loaded(gnomon);
    super(mapSize, directional(light), false, camera);
    // A map holds all that casts into it, and depths that are clamped are not divided by w.
    this.depthClamp = false;
    this.planner = new Planner(gnomon, this, { options });
    this.planner.watchTexture(this.getShadowMap());
  }
  get gnomon() {
    return this.planner.gnomon;
  }
  get bounds() {
    return this.planner.bounds;
  }
  get history() {
    return this.planner.history;
  }
  get options() {
    return this.planner.options;
  }
  get plan() {
    return this.planner?.plan ?? null;
  }

  // Babylon's constructor calls it before there is a planner.
  _initializeShadowMap() {
    super._initializeShadowMap();
    this.planner?.watchTexture(this.getShadowMap());
  }

  _computeShadowCastersBoundingInfo() {}

  _computeMatrices() {
    const camera = this._getCamera();
    if (!camera) return;
    this._cachedDirection.copyFrom(this._light.getShadowDirection(0)).normalize();
    const blend = this.cascadeBlendPercentage;
    const maps = this.planner.planFor(camera, this.numCascades, { far: this._shadowMaxZ, overlap: blend });
    for (let i = 0; i < this.numCascades; ++i) this.setCascade(i, maps[i], blend === 0 ? 0 : (maps[i + 1]?.overlap ?? 0) / blend);
  }

  setCascade(i, map, length) {
    const matrix = this._transformMatrices[i];
    if (map === undefined) matrix.copyFrom(NOWHERE);
    else Matrix.FromArrayToRef(map.clipFromWorld, 0, matrix);
    this._viewMatrices[i].copyFrom(Matrix.IdentityReadOnly);
    this._projectionMatrices[i].copyFrom(matrix);
    matrix.copyToArray(this._transformMatricesAsArray, 16 * i);
    // The first cascade that ends behind a pixel serves it. Those without a map end before all of them.
    this._viewSpaceFrustumsZ[i] = map === undefined ? -Number.MAX_VALUE : map.depthEnd;
    // The share of it that blends is the next map's band.
    this._frustumLengths[i] = Math.max(length, 1e-6);
    this._cascadeMinExtents[i].setAll(0);
    this._cascadeMaxExtents[i].setAll(1);
    if (map !== undefined) this._cascadeMaxExtents[i].copyFromFloats(map.texelWorld[0] * map.width, map.texelWorld[1] * map.height, map.depthRangeWorld);
  }

  /** Babylon's setters dispose with `clearObservables` false, and go on with another light or camera. */
  dispose(clearObservables = true) {
    super.dispose(clearObservables);
    if (clearObservables) this.planner.dispose();
  }
}

/**
 * gnomon's map for a ShadowGenerator of a directional light: `new GnomonShadow(gnomon, generator)`. mapSize and filter are the
 * generator's. gnomon sets its bias and normalBias, and the light's customProjectionMatrixBuilder.
 */
export class GnomonShadow extends Planner {
  constructor(gnomon, generator, { options = {}, camera } = {}) {
    if (!(generator instanceof ShadowGenerator) || generator instanceof CascadedShadowGenerator)
      throw new GnomonError('generator', 'gnomon: generator: expected a ShadowGenerator');
    const light = directional(generator.light);
    super(gnomon, generator, { options });
    this.light = light;
    this.camera = camera;
    this.before = light.customProjectionMatrixBuilder;
    this.builder = (viewMatrix, meshes, result) => this.build(viewMatrix, result);
    light.customProjectionMatrixBuilder = this.builder;
    this.watch();
  }

  watch() {
    this.texture = this.generator.getShadowMap();
    this.watchTexture(this.texture);
    this.texture.onBeforeBindObservable.add(() => this.run());
  }

  run() {
    const camera = this.camera ?? this.light.getScene().activeCamera;
    if (camera) this.planFor(camera, 1, { far: this.light.shadowMaxZ, overlap: 0 });
  }

  build(viewMatrix, result) {
    // A generator makes another texture when its size changes.
    if (this.texture !== this.generator.getShadowMap()) {
      this.watch();
      this.run();
    }
    const map = this.plan?.maps[0];
    clip.copyFrom(NOWHERE);
    if (map !== undefined) {
      Matrix.FromArrayToRef(map.clipFromWorld, 0, clip);
      // Babylon lights what has a depth beyond 1 before it is divided by w: a common factor keeps all of a map below.
      clip.scaleToRef(SMALL, clip);
    }
    // Babylon multiplies with the light's view, which gnomon's matrix has already.
    viewMatrix.invertToRef(inverse);
    inverse.multiplyToRef(clip, result);
  }

  dispose() {
    if (this.light.customProjectionMatrixBuilder === this.builder) this.light.customProjectionMatrixBuilder = this.before;
    if (this.texture === this.generator.getShadowMap()) this.texture.getCustomRenderList = null;
    super.dispose();
  }
}
