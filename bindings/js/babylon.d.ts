// gnomon's shadow maps in Babylon.js: what Babylon takes and has.
import type { Camera as BabylonCamera } from '@babylonjs/core/Cameras/camera.js';
import type { DirectionalLight } from '@babylonjs/core/Lights/directionalLight.js';
import type { CascadedShadowGenerator } from '@babylonjs/core/Lights/Shadows/cascadedShadowGenerator.js';
import type { ShadowGenerator } from '@babylonjs/core/Lights/Shadows/shadowGenerator.js';
import type { AbstractMesh } from '@babylonjs/core/Meshes/abstractMesh.js';
import type { Camera, CasterSet, Gnomon, History, PlanOptions, PlanResult, ShadowMap } from './index.js';

/** Boxes of a generator's casters, and of the scene's meshes that receive shadows. Followed in each frame that draws maps. */
export interface ShadowBounds {
  readonly casters: CasterSet;
  readonly receivers: CasterSet;
  /** The casters, in the order of their boxes. */
  readonly meshes: ReadonlyArray<AbstractMesh>;
}

export interface GnomonShadowOptions {
  /**
   * Of the plan. Default: fit warped_stable. `fit: 'stable'` has a grid that never moves and larger texels, with practical splits
   * of lambda 0.7; `fit: 'tight'` the smallest texels, which follow the camera. Cascades, sizes and clip space come from Babylon.
   */
  options?: PlanOptions;
  /** The camera that maps are for; default: the scene's active one. */
  camera?: BabylonCamera;
}

/**
 * Babylon's cascades with gnomon's maps. Each map draws the meshes that cast into it, and a map without any draws none. lambda,
 * stabilizeCascades, depthClamp, autoCalcDepthBounds and freezeShadowCastersBoundingInfo have no effect.
 */
export class GnomonCascadedShadowGenerator extends CascadedShadowGenerator {
  constructor(gnomon: Gnomon, mapSize: number, light: DirectionalLight, options?: GnomonShadowOptions);
  readonly bounds: ShadowBounds;
  readonly history: History;
  readonly options: PlanOptions;
  /** Of the last frame; null before it. */
  readonly plan: PlanResult | null;
}

/** gnomon's map for a ShadowGenerator of a directional light, by its light's customProjectionMatrixBuilder: one generator per light. */
export class GnomonShadow {
  constructor(gnomon: Gnomon, generator: ShadowGenerator, options?: GnomonShadowOptions);
  readonly generator: ShadowGenerator;
  readonly bounds: ShadowBounds;
  readonly history: History;
  readonly options: PlanOptions;
  readonly plan: PlanResult | null;
  /** The generator draws as before then. */
  dispose(): void;
}

/** The camera that Babylon draws with; shadows end at `far`. */
export function cameraOf(gnomon: Gnomon, camera: BabylonCamera, far?: number): Required<Camera>;
/** Texels beside its own that a look-up of the generator's filter reads. */
export function radiusOf(generator: ShadowGenerator): number;
/** A map's bias in Babylon's units, and the factor of a polygon offset. `filter`: of ShadowGenerator.FILTER_... */
export function biasOf(map: ShadowMap, look: { filter: number; radius: number; slopeTexels?: number; backFaces?: boolean }): { bias: number; normalBias: number; slope: number };
