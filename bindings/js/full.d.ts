// All calls of the C interface, besides what index.d.ts has: the types of gnomon/full, which loads a larger module.
import { GnomonError } from './index.js';
import type { BoxList, Camera, CasterSet, ClipSpace, Gnomon, History, Light, Omission, Plan, PlanInput, PlanOptions, PlanResult, PointList,
  ShadowMap, Stats, TexelRect, Vector3, ViewInput, VisibleDepths } from './index.js';

export { GnomonError };
export type { TexelRect };

/** Options of planPages. Names and ranges: `gnomon_page_options` of the C header. */
export interface PageOptions {
  /** How fine the page of a point is (`names('pagePolicies')`); default resolution. */
  policy?: string;
  /** The base of the levels; default: no warp. With fit stable, pages keep their place under camera motion. */
  plan?: PlanOptions;
  /** Texels along each side that a page serves: 64, 128, the default, or 256. */
  pageTexels?: number;
  /** Pages of the pool, 1..2^20; default 4096. Too few: all levels coarsen evenly. */
  capacity?: number;
  /** Error that no visible point exceeds, screen pixels per texel; default 1. */
  targetM?: number;
  /** Share of the visible points that must meet it, in (0, 1]; default 1. */
  share?: number;
  levelsPerOctave?: number;
  trials?: number;
  virtualTexels?: number;
  /** The coarsest level is resident everywhere; default false. */
  fallback?: boolean;
  reachTexels?: number;
  leastLightSine?: number;
}

export interface Page {
  level: number;
  column: number;
  row: number;
  /** Place in the pool, below the capacity. */
  slot: number;
  /** Visible points that it was opened for. */
  points: number;
}

/** Resident pages. Its memory is freed with the object, or at once by dispose(). */
export interface PagePlan {
  readonly status: 'ok' | 'nothing_visible' | 'no_caster';
  readonly pageCount: number;
  readonly levelCount: number;
  readonly policy: string;
  readonly pageTexels: number;
  /** Texels round them in the page's slot, which hold the filter's kernel. */
  readonly borderTexels: number;
  readonly capacity: number;
  readonly origin: Float64Array;
  readonly lightDirection: Float64Array;
  /** Error that levels were chosen for; larger than requested where the pool is small. */
  readonly targetM: number;
  readonly points: number;
  readonly pointsOutside: number;
  readonly pointsCoarser: number;
  readonly pointsCapped: number;
  readonly omitted: Omission[];
  /** Coarsest level first. */
  readonly pages: ReadonlyArray<Page>;
  /** Hash table over the pages, as shaders/library reads it. */
  readonly table: Uint32Array;
  /** A level; width and height are those of the whole virtual map. */
  level(index: number): Required<ShadowMap>;
  /** A page as a map of its own, to draw it and to cull its casters. */
  map(page: number): Required<ShadowMap>;
  /** Index of the page that serves each point, or -1. */
  select(points: PointList): Int32Array;
  /** Error in the pages that serve what the view sees. texelsPerPixel: of pages without borders. */
  measure(input: ViewInput & { grid?: { map?: number; columns?: number; rows?: number; depths?: number } }): Stats & { texelsPerPixel: number };
  dispose(): void;
}

/** Slots that keep pages from frame to frame. */
export interface PagePool {
  readonly slots: number;
  /** Forgets all pages. */
  clear(): void;
  /**
   * Which pages the pool still holds, and a slot for each of the others: one entry a page. `moved`: boxes of casters that changed
   * since the last call, where they were and where they are. draw: 1 where a page is to be drawn; compose: only its moving
   * casters are.
   */
  keep(plan: PagePlan, moved?: BoxList): { slots: Uint32Array; draw: Uint8Array; compose: Uint8Array; drawn: number };
  dispose(): void;
}

/** Options of planLights. Names and ranges: `gnomon_light_options` of the C header. */
export interface LightOptions {
  pageBudget?: number;
  /** Of the plans of all lights. */
  plan?: PlanOptions;
  /** Texels of the pool; default 4096. */
  poolWidth?: number;
  poolHeight?: number;
  texelBudget?: number;
  pageTexels?: number;
  /** Side of the smallest and the largest maps, powers of two; default 64 and 1024. */
  leastSize?: number;
  mostSize?: number;
  /** Most frames from one drawing of a light to the next, 1..64; default 8. */
  mostFrames?: number;
  millisecondBudget?: number;
  costPerMap?: number;
  costPerMegatexel?: number;
  costPerKilodraw?: number;
  costPerMegatriangle?: number;
  enoughM?: number;
  fullShare?: number;
  keepGain?: number;
}
export interface LightRequest {
  light: Light;
  /** Its casters moved, or its maps are lost; default false. */
  changed?: boolean;
  /** Counts its error so many times; default 1. */
  weight?: number;
  draws?: number;
  triangles?: number;
}
export interface LightMaps {
  outcome: 'mapped' | 'belowLeastSize' | 'withoutReceiver' | 'withoutCaster';
  /** Along each side of each map; 0: none. */
  texels: number;
  /** In the pool, by index of the map in the light's plan. */
  places: TexelRect[];
  /** Part of the picture that the light may light, in 0..1. */
  share: number;
  /** Mean error over that part. */
  m: number;
  /** From one drawing to the next. */
  frames: number;
  /** Plan and draw its maps in this frame. */
  due: boolean;
}
export interface LightPlan {
  status: 'ok' | 'nothing_visible' | 'no_caster';
  /** In the order of the requests. */
  lights: LightMaps[];
  poolWidth: number;
  poolHeight: number;
  texels: number;
  dueTexels: number;
  pages: number;
  milliseconds: number;
  dueMilliseconds: number;
  error: number;
  mapped: number;
  due: number;
  repacked: boolean;
}
export interface LightHistory {
  /** Exchanges what is remembered of two lights. */
  swap(a: number, b: number): void;
  forget(light: number): void;
  dispose(): void;
}
/** Lights that reach into each cluster: cluster i has lights[begin[i]] .. lights[begin[i + 1] - 1], i = (slice * rows + row) * columns + column. */
export interface LightClusters {
  tilePixels: number;
  depthSlices: number;
  columns: number;
  rows: number;
  slices: number;
  orthographic: boolean;
  /** Slice of a surface: floor(depthScale * log2(view depth) + depthOffset). */
  depthScale: number;
  depthOffset: number;
  begin: Uint32Array;
  lights: Uint32Array;
}

/** Where maps lie in one texture; no two share a texel. */
export interface Atlas {
  /** Texels; 0: there is no map, or the maps do not fit. */
  width: number;
  height: number;
  /** By index of the map in the plan: all of the plan's, or none. */
  places: TexelRect[];
  /** Texels of the maps over those of the texture, in 0..1. */
  efficiency: number;
}

/** A bias in an engine's units. All of it is towards the light. */
export interface EngineBias {
  /** Of the map's depth, 0..1. */
  depth: number;
  /** Times the larger growth of depth over a texel, along the map's x or y. */
  slopeFactor: number;
  /** Along the normal, world units. */
  normalWorld: number;
  /** `depth` in units of rasterizer states: steps of the map's format. */
  units: number;
}

/** The decision of holdSun. */
export interface HeldSun {
  /** To plan with: the held one, or the sun's own, bit for bit. */
  direction: Float64Array;
  /** Largest error of the points that were read, screen pixels. */
  errorPixels: number;
  /** Error of the point that turned it, above the bound; 0: none did. */
  turnedPixels: number;
  /** Points that the light grazes more than leastLightSine: not evaluated. */
  pointsCapped: number;
}

/** Visible depths that are followed from frame to frame. Freed with the object, or at once by dispose(). */
export interface DepthTracker {
  /** Takes the depths of the next frame, and returns those to plan with. A frame that shows nothing changes nothing. */
  update(frame: ArrayLike<number> | VisibleDepths): VisibleDepths & { count: Uint32Array };
  /** Forgets all frames: call it at a cut. */
  clear(): void;
  dispose(): void;
}

/** A history that a frame can be tried with twice. */
export interface FullHistory extends History {
  copy(): FullHistory;
}

/** A shadow as a camera sees it: of other maps, of the last frame, or of rays. Lists go along rows from top to bottom. */
export interface ShadowPicture {
  /** Its width and height are those of the picture. */
  camera: Camera;
  /** A number for each pixel: 1 lit .. 0 in shadow. Negative, above 1 and NaN: not counted. */
  mask: ArrayLike<number>;
  /** View depths of the surfaces, as many, world units. 0, less, Infinity and NaN: no surface. */
  viewDepths: ArrayLike<number>;
  /** Half side of the box of texels whose comparisons the filter averages; default 0: one texel. */
  kernelTexels?: number;
  /** For each dark pixel the distance along the light to the occluder nearest the light, world units. Negative and NaN: not known. */
  occluderDistances?: ArrayLike<number>;
  /**
   * Searches what casts shadows: the distance along the light from a point, world space, to the occluder nearest the light.
   * Negative where that lies beyond the point, -Infinity where there is none. With it errors are those of the maps' own
   * comparisons. It may call gnomon, but start no other search. Its exceptions leave expectedError unchanged.
   */
  occluderSearch?: (x: number, y: number, z: number) => number;
  /** Beside occluderSearch: unit normals towards the viewer, three numbers for each pixel. Zero and default: from viewDepths. */
  normals?: PointList;
}
export interface WrongPixels {
  /** Lit and dark pixels that are taken for each other; no whole number. */
  wrong: number;
  /** Pixels that have a surface, and are lit or dark. */
  counted: number;
  /** wrong over counted, in 0..1; 0 where none counts. */
  share: number;
}

export interface FullGnomon extends Omit<Gnomon, 'names' | 'history'> {
  names(list: Parameters<Gnomon['names']>[0] | 'pagePolicies'): Array<{ name: string; summary: string }>;
  /**
   * Chooses the pages of a virtual map that the view's points need. history: the last frame's plan, and bits of what the picture
   * showed at each point (`GNOMON_SHADOW_EDGE` and others of the C header).
   */
  planPages(input: ViewInput & { light: Light; options?: PageOptions; history?: { last?: PagePlan; feedback?: ArrayLike<number> } }): PagePlan;
  pagePool(slots: number): PagePool;
  /** Divides the texels of one pool among lights, and chooses which of them are due. */
  planLights(input: ViewInput & { lights: LightRequest[]; options?: LightOptions; history?: LightHistory }): LightPlan;
  /** State of planLights from frame to frame, for up to so many lights. */
  lightHistory(lights: number): LightHistory;
  /** Options for the plan of one light that is due: maps of its size. */
  lightPlanOptions(options: LightOptions, light: LightMaps): PlanOptions;
  /** The pool as the atlas of one light's maps. */
  lightAtlas(plan: LightPlan, light: number): Atlas;
  /** A camera that sees all that a local light can light, for maps that serve several frames. */
  cameraRound(light: Light, camera: Camera): Required<Camera>;
  /** Lists of the lights that can light a surface in each cluster of the view. room: entries of all lists; fewer make clusters larger. */
  clusterLights(input: { camera: Camera; lights: Light[]; tilePixels?: number; depthSlices?: number; room?: number }): LightClusters;

  history(): FullHistory;
  /** Chooses the maps that 1..8 cameras share: two eyes, a split screen, faces of a probe. Its origin is the mean of the eyes. */
  planViews(input: Omit<PlanInput, 'camera' | 'points' | 'normals' | 'depths' | 'history'> & { cameras: ReadonlyArray<Camera> }): PlanResult;
  /** Places the maps of a plan into a texture. Both 0, the default: into the smallest one whose sides are powers of two. */
  packAtlas(plan: Plan, width?: number, height?: number): Atlas;
  /** From the clip space of a map to its part of the atlas and depth in 0..1. Draw the map with its place as the viewport. */
  atlasFromClip(atlas: Atlas, map: number, clipSpace?: ClipSpace): Float64Array;
  /**
   * The bias of a map in an engine's own units. rasterizer, the default: WebGPU's states and polygonOffset. normalOffset: a move
   * along the normal, as three.js and Babylon.js have it. depthBits: of a normalized integer, 1..32; 0, the default: 32-bit floats.
   */
  engineBias(plan: Plan, map: number, options?: { way?: 'rasterizer' | 'normalOffset'; kernelRadiusTexels?: number; depthBits?: number }): EngineBias;
  /** Five planes, four numbers each, round all that can throw a shadow into a rectangle of a map: for cullPlanes. */
  rectanglePlanes(map: ShadowMap, rectangle: TexelRect, clipSpace?: ClipSpace): Float64Array;
  /** Indices of the casters within up to 32 planes, four numbers each. */
  cullPlanes(planes: ArrayLike<number> | ReadonlyArray<ArrayLike<number>>, casters: CasterSet): Uint32Array;

  /** Offset of the texel grid in a frame, 0..2^32 - 1: x and y in (-0.5, 0.5) texels. Any 64 frames in a row hold all 64 offsets. */
  jitterTexels(frame: number): Float64Array;
  /** The plan with the texel grid of every map moved by so many texels. Add 0.5 to filterTexels before planning. */
  jitter<P extends Plan>(plan: P, offset: ArrayLike<number>): P & { maps: Required<ShadowMap>[] };
  /**
   * Keeps the direction of a sun that turns until a shadow edge could lie more than mostPixels from its true place; default 0.25.
   * held: direction of the last frame; default: none. casters: one box round all casters. Without points the sun is not held.
   */
  holdSun(input: { camera: Camera; points?: PointList; normals?: PointList; held?: Vector3; sun: Vector3; casters: ArrayLike<number>;
    mostPixels?: number; leastLightSine?: number }): HeldSun;
  /**
   * Frames that the nearest and the farthest depth take to move inwards by one bin; default 4. Frames for which a depth between them
   * that shows nothing any more still counts; default 30. One per camera.
   */
  depthTracker(framesPerBin?: number, holdFrames?: number): DepthTracker;

  /** Counts the pixels that comparisons in the maps will misclassify, without drawing them. Also of foreign maps. */
  expectedError(plan: Plan | PagePlan, picture: ShadowPicture): WrongPixels;
  /** Points of the surfaces along the shadow's edges, three numbers each: at most room, 4096 by default, evenly over the picture. */
  shadowEdgePoints(picture: ShadowPicture, room?: number): Float64Array;
}

/** Loads the larger module. As load() of gnomon. */
export function load(options?: { wasm?: string | URL | BufferSource | WebAssembly.Module; simd?: boolean }): Promise<FullGnomon>;
