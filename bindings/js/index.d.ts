// Shadow maps, chosen by measurement: what the module takes and returns.
//
// Matrices are 16 numbers, column by column, as in WebGL and three.js; they act on column vectors. Lengths are in world units,
// angles in radians, the world is right-handed. Boxes are six numbers: least x, y, z, then largest x, y, z. Calls are
// synchronous. Bad input throws a GnomonError with the name of the field; nothing is half done then.

/** Three numbers. */
export type Vector3 = ArrayLike<number>;
/** 16 numbers, column by column. */
export type Matrix4 = ArrayLike<number>;
/** Boxes: six numbers each in one array (a Float64Array is the fastest), or one array each. */
export type BoxList = ArrayLike<number> | ReadonlyArray<ArrayLike<number>>;
/** Points: three numbers each in one array, or one array each. */
export type PointList = ArrayLike<number> | ReadonlyArray<ArrayLike<number>>;

/** Clip space of matrices; all false: WebGL. */
export interface ClipSpace {
  /** Depth after the division by w is 0..1, as in WebGPU; else -1..1. */
  zeroToOne?: boolean;
  /** Depth grows towards the light, or the eye. */
  reversedZ?: boolean;
  /** y grows downwards in clip space. */
  yDown?: boolean;
  /** The caller's world is left-handed. */
  leftHanded?: boolean;
  /** The first row in memory is at ndc y = 1, as in WebGPU. */
  firstRowAtYMax?: boolean;
}

/** A viewing camera; `perspective`, `orthographic` and `cameraFrom` make one. */
export interface Camera {
  /** Parallel projection; default false. */
  orthographic?: boolean;
  /** Eye, world space. */
  position?: Vector3;
  /** View direction, any length above 0. */
  forward?: Vector3;
  /** Any vector not along forward. */
  up?: Vector3;
  /** Edges of the image: offsets per unit of depth, or world units for an orthographic camera. */
  left?: number;
  right?: number;
  bottom?: number;
  top?: number;
  /** View depth where the image begins, above 0 for perspective. */
  nearDepth?: number;
  /** View depth where it ends; Infinity sees without end. */
  farDepth?: number;
  /** Pixels. */
  width?: number;
  height?: number;
}

/** A light that casts shadows. Fields that its kind does not need are not read. */
export interface Light {
  /** Default directional. */
  kind?: 'directional' | 'spot' | 'point';
  /** World space; spot and point. */
  position?: Vector3;
  /** The way the light travels; directional and spot. */
  direction?: Vector3;
  /** Half angle of a spot's cone, in (0, pi). */
  outerRadians?: number;
  /** Nothing is lit beyond, world units. */
  range?: number;
}

/** Options of a plan; every default suits most scenes. Names and ranges: `gnomon_plan_options` of the C header. */
export interface PlanOptions {
  /** Maps along the view, 1..8; default 4. Directional lights only. */
  cascades?: number;
  /** Texels along each side of each map, 4..16384; default 1024. */
  resolutionMaxSize?: number;
  /** Sizes per octave that maps of fit stable may have, 1..1024. */
  resolutionStableSizeSteps?: number;
  /** Error m, screen pixels per texel, that suffices; 0, the default: none. */
  resolutionMaxError?: number;
  /** Most texels of all maps together; 0, the default: no budget. */
  resolutionTexelBudget?: number;
  /** Error that prune rule metric_resolution shrinks maps to. */
  resolutionPruneError?: number;
  /** tight, the default, for the best texels; stable keeps texels at their place under camera motion. */
  fit?: 'tight' | 'rotated' | 'stable' | 'warped_stable';
  splitScheme?: 'uniform' | 'logarithmic' | 'practical' | 'pseudo_near' | 'optimal' | 'auto' | 'given';
  /** practical: from uniform (0) to logarithmic (1). */
  splitLambda?: number;
  /** View depth from which error counts, world units. */
  splitPseudoNear?: number;
  splitRange?: 'automatic' | 'receivers' | 'camera';
  splitSelection?: 'view_depth' | 'finest';
  /** scheme given: seven ascending view depths. The first `cascades - 1` count, and must be finite. */
  splitGiven?: ArrayLike<number>;
  /** Blend band before a cascade, share of the depths before it, 0..1. */
  splitOverlap?: number;
  splitPartition?: 'view_depth' | 'frustum_faces' | 'separating_plane' | 'tetrahedron' | 'receiver_clusters';
  splitFaceSlices?: number;
  /** Name of a warp (`names('warps')`); null, the default: the plan measures and chooses. */
  warp?: string | null;
  /** linear, the default; others need more of a renderer. */
  warpShape?: string;
  warpObjective?: 'storage' | 'max' | 'p95' | 'picture';
  /** Box whose error counts warpFocusWeight times. */
  warpFocus?: ArrayLike<number>;
  warpFocusWeight?: number;
  /** Three planes that get a map each: point, normal and thickness, seven numbers each. */
  warpPlanes?: ArrayLike<number> | ReadonlyArray<ArrayLike<number>>;
  cadenceFrames?: number;
  cadenceLargestStep?: number;
  cadenceLargestTurn?: number;
  /** Names of the rules that are on (`names('pruneRules')`); default: the exact ones, `light_depths` and `equal_cascades`. */
  prune?: ReadonlyArray<string>;
  /** Kernel radius of the filter, texels; default 1. */
  filterTexels?: number;
  /** The same in world units. */
  filterWorld?: number;
  biasConstantTexels?: number;
  biasSlopeTexels?: number;
  biasNormalOffsetTexels?: number;
  biasMaxSlope?: number;
  lightNearShare?: number;
  /** Of all matrices of the plan; default WebGL. */
  clipSpace?: ClipSpace;
}

/** Visible view depths of a frame: pixels in each bin of the logarithm of depth. A `DepthTracker` of gnomon/full returns them. */
export interface VisibleDepths {
  /** Eight bins per doubling, from 2^-20 world units on: 352 of them. */
  count: ArrayLike<number>;
  /** Nearest and farthest visible depth, world units; min > max: nothing is visible. */
  min: number;
  max: number;
}

/** What a camera sees, and where. */
export interface ViewInput {
  camera: Camera;
  /** What casts shadows. A CasterSet is written once and serves many plans. */
  casters?: BoxList | CasterSet;
  /** What shadows fall on. The casters' list again is fine. */
  receivers?: BoxList | CasterSet;
  /** Points of surfaces that the camera sees. */
  points?: PointList;
  /** Unit normals at the points, towards the eye. Warps do not serve points turned from the light. */
  normals?: PointList;
  /** View depths of pixels that show a surface, such as those of last frame's depth buffer. */
  depths?: ArrayLike<number> | VisibleDepths;
}
export interface PlanInput extends ViewInput {
  light: Light;
  options?: PlanOptions;
  /** Keeps maps steady from frame to frame. One per camera and light. */
  history?: History;
}

/** One shadow map. For maps of another planner, the five fields that have no question mark suffice. */
export interface ShadowMap {
  clipFromWorld: Matrix4;
  width: number;
  height: number;
  /** View depths that the map serves, world units. */
  depthBegin: number;
  depthEnd: number;
  /** For points relative to the plan's origin. */
  clipFromCameraRelative?: ArrayLike<number>;
  cascade?: number;
  /** Width of the blend band before depthBegin, world units. */
  overlap?: number;
  /** The light's position with w = 1, or unit direction towards it with w = 0. */
  lightWorld?: ArrayLike<number>;
  shape?: string;
  warp?: string | null;
  shapeParameters?: ArrayLike<number>;
  kappa?: number;
  /** Extent of a texel across the light at the body's centre, world units. */
  texelWorld?: ArrayLike<number>;
  texelWorldMax?: ArrayLike<number>;
  /** From near to far plane along the light, world units. */
  depthRangeWorld?: number;
  /** Bias at the body's centre: along the light; per unit of tan(normal, light); along the normal, per unit of sin. */
  biasConstant?: number;
  biasSlope?: number;
  biasNormalOffset?: number;
  filterMarginTexels?: number;
  cullPlaneCount?: number;
  /** Four numbers each: what casts into the map lies where dot(xyz, p) + w >= 0 for all that are used. */
  cullPlanes?: ArrayLike<number>;
  selectPlaneCount?: number;
  snapValid?: boolean;
  selectPlanes?: ArrayLike<number>;
  snapX?: number;
  snapY?: number;
  snapDepthNear?: number;
  snapDepthFar?: number;
  snapTexel?: ArrayLike<number>;
  mSMax?: number;
  mTMax?: number;
  /** Bound of the error in any direction, screen pixels per texel. */
  mMax?: number;
  storage?: number;
}

/** Something that this scene did not need, or an option that did not hold. */
export interface Omission {
  kind: string;
  /** The cascade or face that it is about; -1: the whole plan. */
  map: number;
  /** As the kind states: GNOMON_CASCADE_WITHOUT_RECEIVER and others in the C header. */
  a: number;
  b: number;
  savesTexels: number;
  /** kind optionIgnored: the name of the option. */
  option?: string;
}

export interface Plan {
  /** ok: there are maps. nothing_visible and no_caster: everything in view is lit. */
  status?: 'ok' | 'nothing_visible' | 'no_caster';
  maps: ShadowMap[];
  omitted?: Omission[];
  selection?: 'view_depth' | 'first_holding' | 'finest';
  sizesVary?: boolean;
  /** What clipFromCameraRelative is relative to, world space. */
  origin?: Vector3;
  lightDirection?: Vector3;
  clipSpace?: ClipSpace;
  biasConstantTexels?: number;
  biasSlopeTexels?: number;
  biasNormalOffsetTexels?: number;
  biasMaxSlope?: number;
}
/** As `plan` returns it: every field is there. */
export type PlanResult = Required<Omit<Plan, 'maps'>> & { maps: Required<ShadowMap>[] };

/** The aliasing error m over many points, screen pixels per texel. Above 1, texels show. */
export interface Stats {
  p50: number;
  p95: number;
  max: number;
  mean: number;
  /** Share of the points above 1. */
  shareUndersampled: number;
  /** Texels per screen pixel for an error of 1 everywhere. */
  storage: number;
  samples: number;
  /** Points of visible receivers that no map holds. */
  outside: number;
}

/** The aliasing error at one point. */
export interface PointError {
  status: 'ok' | 'outside' | 'facesAway' | 'undetermined';
  mMax: number;
  mMin: number;
  mS: number;
  mT: number;
  mArea: number;
  anisotropy: number;
  perspectiveMax: number;
  perspectiveS: number;
  perspectiveT: number;
  projection: number;
}

export interface TexelRect { x: number; y: number; width: number; height: number }
export interface Reuse {
  /** none: draw the whole map; identical: every texel holds; scrolled: `kept` holds once moved, draw the strips. */
  kind: 'none' | 'identical' | 'scrolled';
  shiftX: number;
  shiftY: number;
  kept: TexelRect;
  strips: TexelRect[];
}

/** What a call refuses. */
export class GnomonError extends Error {
  /** Its name in the C header, such as "camera.far_depth". */
  readonly field: string;
  constructor(field: string, message?: string);
}

/** State that plans carry from frame to frame. Freed with the object, or at once by dispose(). */
export interface History {
  /** Forgets all frames: call it at a cut. */
  clear(): void;
  /** Unavoidable jumps of the last plan. */
  readonly events: ReadonlyArray<{ kind: 'mapAppeared' | 'mapRefitted' | 'densityJump'; map: number; densityRatio: number }>;
  dispose(): void;
}

/** Boxes sorted into a tree, for scenes with hundreds and more. Freed with the object, or at once by dispose(). */
export interface CasterSet {
  readonly count: number;
  /** New bounds for all boxes, in their first order. */
  refit(boxes: BoxList): void;
  /** New bounds for one of them. */
  update(index: number, box: ArrayLike<number>): void;
  dispose(): void;
}

export interface Gnomon {
  /** "major.minor.patch". */
  readonly version: string;
  /** Names and one line about each. */
  names(list: 'warps' | 'shapes' | 'fits' | 'splits' | 'partitions' | 'selections' | 'objectives' | 'pruneRules'):
    Array<{ name: string; summary: string }>;

  /** Symmetric perspective. fovY: full vertical angle, radians. Defaults: near 0.1, far 100, 1920 x 1080. */
  perspective(image: { position?: Vector3; forward?: Vector3; up?: Vector3; fovY: number; aspect?: number; near?: number; far?: number; width?: number; height?: number }): Required<Camera>;
  /** Parallel projection of heightWorld world units from bottom to top. */
  orthographic(image: { position?: Vector3; forward?: Vector3; up?: Vector3; heightWorld: number; aspect?: number; near?: number; far?: number; width?: number; height?: number }): Required<Camera>;
  /** The camera of an engine's own matrices. clipSpace: of clipFromView. Throws with the reason where there is none. */
  cameraFrom(matrices: { viewFromWorld: Matrix4; clipFromView: Matrix4; clipSpace?: ClipSpace; width: number; height: number }): Required<Camera>;

  history(): History;
  casterSet(boxes: BoxList): CasterSet;

  /** Chooses the shadow maps of one light for one view. */
  plan(input: PlanInput): PlanResult;
  /** Error over what the view sees: at its points, else over a grid in the receivers. Also of foreign maps. */
  measure(plan: Plan, input: ViewInput & { grid?: { map?: number; columns?: number; rows?: number; depths?: number } }): Stats;
  /** Error at each point. Without normals, the perspective part alone. */
  measurePoints(map: ShadowMap, input: { camera: Camera; points: PointList; normals?: PointList }): PointError[];
  /** Index of the map that serves each point, or -1: lit. */
  select(plan: Plan, points: PointList, viewDepths: ArrayLike<number>): Int32Array;
  /** Indices of the casters that a map needs. */
  cull(map: ShadowMap, casters: BoxList | CasterSet): Uint32Array;
  /** The map with clipFromCameraRelative for an eye at origin. */
  rebased(map: ShadowMap, origin: Vector3): Required<ShadowMap>;
  /** Which texels of the last frame's map of fit stable hold. Casters must not have moved. */
  compare(previous: ShadowMap, current: ShadowMap, clipSpace?: ClipSpace): Reuse;
  /** The uniform block of shaders/library/shadow_block.glsl, std140. */
  shaderBlock(plan: Plan, layers?: { layerWidth?: number; layerHeight?: number; blurTexels?: number }): Float32Array;
  /** From a map's clip space to texture coordinates and depth in 0..1. */
  textureFromClip(clipSpace?: ClipSpace): Float64Array;
}

/** Loads the module: with SIMD where there is, else the scalar one. `wasm`: another place, bytes, or a compiled module. */
export function load(options?: { wasm?: string | URL | BufferSource | WebAssembly.Module; simd?: boolean }): Promise<Gnomon>;
