// gnomon's shadow maps in three.js: what three.js takes and has. Needs the types of three (@types/three).
import type { Camera as ThreeCamera, DirectionalLight, LightShadow, Material, Object3D, OrthographicCamera, PerspectiveCamera, Scene, Vector3 } from 'three';
import type { Camera, CasterSet, Gnomon, History, Plan, PlanOptions, PlanResult, ShadowMap } from './index.js';

/** Boxes of the meshes that cast and receive shadows, gathered once and followed as meshes move. */
export class ShadowBounds {
  constructor(gnomon: Gnomon, scene: Object3D);
  readonly casters: CasterSet;
  readonly receivers: CasterSet;
  /** True where a caster's front faces are drawn into maps, which then need a bias. */
  readonly frontFaces: boolean;
  /** Gathers them again: after meshes came, went or changed. */
  update(): void;
  /** Takes the places of the meshes; the shadows call it in each frame. */
  follow(): void;
  dispose(): void;
}

export interface GnomonShadowOptions {
  /**
   * Of the plan. Default: fit warped_stable. `fit: 'stable'` has a grid that never moves and larger texels, with
   * practical splits of lambda 0.7; `fit: 'tight'` the smallest texels, which follow the camera.
   * Cascades, sizes and clip space come from three.
   */
  options?: PlanOptions;
  /** Pixels of the picture; default [1920, 1080]. */
  resolution?: [number, number];
  /** To be shared by several lights; else each gathers its own. */
  bounds?: ShadowBounds;
}

/** `sun.shadow = new GnomonSunShadow(gnomon, scene)`, for the SunLight of three's add-ons. */
export class GnomonSunShadow extends LightShadow<OrthographicCamera> {
  constructor(gnomon: Gnomon, scene: Object3D, options?: GnomonShadowOptions);
  readonly isGnomonSunShadow: true;
  readonly bounds: ShadowBounds;
  readonly history: History;
  options: PlanOptions;
  /** Of the last frame; null before it. */
  readonly plan: PlanResult | null;
}

/**
 * `spot.shadow = new GnomonSpotShadow(gnomon, scene)`, for three's SpotLight. A light with a picture (`map`), or with a cone beyond
 * 65.9 degrees, keeps three's own map.
 */
export class GnomonSpotShadow extends LightShadow<PerspectiveCamera> {
  constructor(gnomon: Gnomon, scene: Object3D, options?: GnomonShadowOptions);
  readonly isGnomonSpotShadow: true;
  readonly isSpotLightShadow: true;
  focus: number;
  aspect: number;
  readonly bounds: ShadowBounds;
  readonly history: History;
  options: PlanOptions;
  /** Of the last frame; null before it, and where three's own map holds. */
  readonly plan: PlanResult | null;
}

/** Options of a point light's shadow. */
export interface GnomonPointShadowOptions extends Omit<GnomonShadowOptions, 'options'> {
  /**
   * Default: fit warped_stable, which keeps a cube until another has 0.8 of its error. `tight` and `rotated` take each better
   * cube, and `stable` keeps three's own.
   */
  options?: Pick<PlanOptions, 'fit' | 'biasConstantTexels' | 'biasSlopeTexels'>;
}

/**
 * `bulb.shadow = new GnomonPointShadow(gnomon, scene)`, for three's PointLight. Its six maps share one matrix of directions, which
 * turns and stretches the cube towards the visible points.
 */
export class GnomonPointShadow extends LightShadow<PerspectiveCamera> {
  constructor(gnomon: Gnomon, scene: Scene, options?: GnomonPointShadowOptions);
  readonly isGnomonPointShadow: true;
  readonly isPointLightShadow: true;
  readonly bounds: ShadowBounds;
  options: NonNullable<GnomonPointShadowOptions['options']>;
  /** Faces of the last frame that hold visible shadows; null before it. For measure(), without culling planes. */
  readonly plan: Plan | null;
}

/** The CSM add-on with gnomon's maps. */
export class GnomonCSM {
  constructor(gnomon: Gnomon, data: GnomonShadowOptions & { parent: Object3D; camera: ThreeCamera; cascades?: number; maxFar?: number; shadowMapSize?: number; lightDirection?: Vector3; lightIntensity?: number });
  readonly bounds: ShadowBounds;
  readonly history: History;
  readonly lights: DirectionalLight[];
  lightDirection: Vector3;
  options: PlanOptions;
  readonly plan: PlanResult | null;
  setupMaterial(material: Material): void;
  /** Plans: before each frame, with the camera as it will be drawn. */
  update(): void;
  updateFrustums(): void;
  remove(): void;
  dispose(): void;
}

/** The camera that three draws with; shadows end at `far`. */
export function cameraOf(gnomon: Gnomon, camera: ThreeCamera, resolution: [number, number], far?: number): Required<Camera>;
/** A map's bias in three's units: depths of 0..1, and the factor of a polygon offset. */
export function biasOf(map: ShadowMap, faces: { frontFaces: boolean; radius?: number; slopeTexels?: number }): { bias: number; slope: number };
