// gnomon's shadow maps in PlayCanvas: what the adapter takes and has.
import type { AppBase, Camera as PlayCanvasCamera, LightComponent } from 'playcanvas';
import type { Camera, CasterSet, Gnomon, PlanOptions, PlanResult, ShadowMap } from './index.js';

export interface GnomonCascadesOptions {
  /**
   * Of the plan. Default: fit warped_stable without a warp, texels that keep their place while the view stays in the map.
   * `fit: 'stable'` has a grid that never moves and larger texels, with practical splits of lambda 0.7; `fit: 'tight'` the smallest
   * texels, which follow the camera. Cascades, sizes and clip space come from PlayCanvas. Default of `splitOverlap`: cascadeBlend.
   */
  options?: PlanOptions;
}

/**
 * gnomon's maps for a directional light of PlayCanvas, of 1 to 4 cascades, with SHADOW_PCF1, 3 or 5. It replaces the renderer's cull
 * for this light alone. gnomon sets the depth bias of each map, cascadeBlend, and a normalOffsetBias of 0. cascadeDistribution and
 * shadowBias have no effect, and shadowUpdateOverrides that hold a cascade are refused.
 */
export class GnomonCascades {
  /** Throws a GnomonError where PlayCanvas is another version, or its renderer lacks the hook. */
  constructor(gnomon: Gnomon, app: AppBase, lightComponent: LightComponent, options?: GnomonCascadesOptions);
  /** Boxes of what casts into the light's maps, and of what receives. Followed in each frame that draws maps. */
  readonly bounds: { readonly casters: CasterSet; readonly receivers: CasterSet };
  readonly options: PlanOptions;
  /** Of the camera that was planned last; null before the first frame. */
  readonly plan: PlanResult | null;
  /** The light draws as before then. */
  dispose(): void;
}

/** PlayCanvas' renderer of a sun's maps, whose `cull` GnomonCascades replaces. Throws where there is none. */
export function hookOf(app: AppBase, release?: string): object;
/** The camera that PlayCanvas draws with (`cameraComponent.camera`); shadows end at `far`. */
export function cameraOf(gnomon: Gnomon, camera: PlayCanvasCamera, far?: number): Required<Camera>;
/** Texels beside its own that a look-up of this SHADOW_PCF... reads; undefined for other shadow types. */
export function radiusOf(shadowType: number): number | undefined;
/** A map's bias as the polygon offset that PlayCanvas draws it with. `sixteenBits`: of SHADOW_PCF..._16F. */
export function biasOf(map: ShadowMap, look: { radius: number; slopeTexels?: number; sixteenBits?: boolean }): { depthBias: number; depthBiasSlope: number };
