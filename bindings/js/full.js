// All calls of the C interface, besides plans, histories and errors: a second, larger module. full.d.ts is the manual.
import { Gnomon } from './core.js';
import { DepthTracker, FullHistory, holdSun, jitter, jitterTexels } from './frames.js';
import { LightHistory, cameraRound, clusterLights, lightAtlas, lightPlanOptions, planLights } from './lights.js';
import { atlasFromClip, cullPlanes, engineBias, packAtlas, planViews, rectanglePlanes } from './maps.js';
import { HAS_SIMD, open } from './open.js';
import { PagePool, planPages } from './pages.js';
import { Searches, expectedError, shadowEdgePoints } from './pictures.js';

export { GnomonError } from './memory.js';

class FullGnomon extends Gnomon {
  constructor(exports, searches) {
    super(exports);
    this.searches = searches;
  }
  history() {
    return new FullHistory(this);
  }
  planPages(input) {
    return planPages(this, input);
  }
  pagePool(slots) {
    return new PagePool(this, slots);
  }
  planLights(input) {
    return planLights(this, input);
  }
  lightHistory(lights) {
    return new LightHistory(this, lights);
  }
  lightPlanOptions(options, light) {
    return lightPlanOptions(this, options, light);
  }
  lightAtlas(plan, light) {
    return lightAtlas(this, plan, light);
  }
  cameraRound(light, camera) {
    return cameraRound(this, light, camera);
  }
  clusterLights(input) {
    return clusterLights(this, input);
  }
  planViews(input) {
    return planViews(this, input);
  }
  packAtlas(plan, width = 0, height = 0) {
    return packAtlas(this, plan, width, height);
  }
  atlasFromClip(atlas, map, clipSpace = {}) {
    return atlasFromClip(this, atlas, map, clipSpace);
  }
  engineBias(plan, map, options = {}) {
    return engineBias(this, plan, map, options);
  }
  rectanglePlanes(map, rectangle, clipSpace = {}) {
    return rectanglePlanes(this, map, rectangle, clipSpace);
  }
  cullPlanes(planes, casters) {
    return cullPlanes(this, planes, casters);
  }
  jitterTexels(frame) {
    return jitterTexels(this, frame);
  }
  jitter(plan, offset) {
    return jitter(this, plan, offset);
  }
  holdSun(input) {
    return holdSun(this, input);
  }
  depthTracker(framesPerBin = 4, holdFrames = 30) {
    return new DepthTracker(this, framesPerBin, holdFrames);
  }
  expectedError(plan, picture) {
    return expectedError(this, plan, picture);
  }
  shadowEdgePoints(picture, room = 4096) {
    return shadowEdgePoints(this, picture, room);
  }
}

/** Loads the module. */
export async function load({ wasm, simd = HAS_SIMD } = {}) {
  const own = simd ? new URL('./gnomon-full.wasm', import.meta.url) : new URL('./gnomon-full-scalar.wasm', import.meta.url);
  const searches = new Searches();
  return new FullGnomon(await open(wasm ?? own, ['gnomon_make_plan', 'gnomon_plan_pages', 'gnomon_plan_lights', 'gnomon_expected_error'], searches.imports), searches);
}
