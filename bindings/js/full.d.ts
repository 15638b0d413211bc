// Pages and many lights besides all that index.d.ts has: the types of gnomon/full, which loads a larger module.
import { GnomonError } from './index.js';
import type { BoxList, Camera, Gnomon, Light, Omission, PlanOptions, PointList, ShadowMap, Stats, ViewInput } from './index.js';

export { GnomonError };

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
export interface TexelRect { x: number; y: number; width: number; height: number }
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

export interface FullGnomon extends Omit<Gnomon, 'names'> {
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
  /** A camera that sees all that a local light can light, for maps that serve several frames. */
  cameraRound(light: Light, camera: Camera): Required<Camera>;
  /** Lists of the lights that can light a surface in each cluster of the view. room: entries of all lists; fewer make clusters larger. */
  clusterLights(input: { camera: Camera; lights: Light[]; tilePixels?: number; depthSlices?: number; room?: number }): LightClusters;
}

/** Loads the module with pages and lights. As load() of gnomon. */
export function load(options?: { wasm?: string | URL | BufferSource | WebAssembly.Module; simd?: boolean }): Promise<FullGnomon>;
