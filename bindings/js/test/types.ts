// The types as a program uses them; compiled, and not run.
import { PointLight, Scene, SpotLight } from 'three';
import { GnomonPointShadow, GnomonSpotShadow, GnomonSunShadow } from 'gnomon/three';
import { load as loadFull } from 'gnomon/full';
import { load, GnomonError, type PlanResult, type ShadowMap } from 'gnomon';

export async function used(): Promise<number> {
  const gnomon = await load();
  const camera = gnomon.perspective({ fovY: 1, aspect: 16 / 9 });
  const boxes = new Float64Array(12);
  const history = gnomon.history();
  const plan: PlanResult = gnomon.plan({ camera, light: { direction: [0.4, -1, 0.3] }, casters: boxes, receivers: boxes, options: { cascades: 3, warp: null, fit: 'stable' }, history });
  const foreign: ShadowMap = { clipFromWorld: new Float32Array(16), width: 1, height: 1, depthBegin: 0, depthEnd: 1 };
  const shadow = new GnomonSunShadow(gnomon, new Scene(), { options: { fit: 'warped_stable' } });
  shadow.mapSize.set(1024, 1024);
  shadow.bounds.update();
  new SpotLight().shadow = new GnomonSpotShadow(gnomon, new Scene(), { bounds: shadow.bounds });
  const bulb = new GnomonPointShadow(gnomon, new Scene(), { options: { fit: 'tight' } });
  new PointLight().shadow = bulb;
  // @ts-expect-error a cube has six faces
  bulb.options = { cascades: 2 };
  if (bulb.plan !== null) gnomon.measure(bulb.plan, { camera, receivers: bulb.bounds.receivers });
  try {
    const error = gnomon.measure({ maps: [foreign], selection: 'view_depth' }, { camera, receivers: boxes });
    return error.p95 + plan.maps[0].mMax + gnomon.cull(plan.maps[0], boxes).length;
  } catch (error) {
    if (error instanceof GnomonError) console.log(error.field);
    throw error;
  }
  // @ts-expect-error a fit that there is none of
  gnomon.plan({ camera, light: {}, options: { fit: 'loose' } });
}

export async function usedInFull(): Promise<number> {
  const gnomon = await loadFull();
  const camera = gnomon.perspective({ fovY: 1 });
  const boxes = gnomon.casterSet(new Float64Array(12));
  const pages = gnomon.planPages({ camera, light: {}, casters: boxes, receivers: boxes, options: { capacity: 512, plan: { fit: 'stable' } } });
  const lights = gnomon.planLights({ camera, casters: boxes, receivers: boxes, lights: [{ light: { kind: 'spot' }, weight: 2 }] });
  gnomon.plan({ camera, light: {}, options: gnomon.lightPlanOptions({}, lights.lights[0]) });
  // @ts-expect-error pages are read alone
  pages.pageCount = 3;
  const shared = gnomon.planViews({ cameras: [camera, camera], light: {}, casters: boxes, options: { cascades: 2 } });
  const atlas = gnomon.packAtlas(shared);
  const moved: PlanResult = gnomon.jitter(shared, gnomon.jitterTexels(7));
  const { direction } = gnomon.holdSun({ camera, points: [0, 0, -5], sun: [0, -1, 0], casters: [0, 0, 0, 1, 1, 1] });
  const depths = gnomon.depthTracker(4, 30).update(new Float32Array(9));
  const history = gnomon.history();
  gnomon.plan({ camera, light: { direction }, depths, history: history.copy() });
  gnomon.cullPlanes(gnomon.rectanglePlanes(moved.maps[0], atlas.places[0]), boxes);
  const bias: number = gnomon.engineBias(moved, 0, { way: 'normalOffset' }).normalWorld + gnomon.lightAtlas(lights, 0).efficiency;
  const picture = { camera, mask: new Float32Array(9), viewDepths: [1, 2, 3], occluderSearch: (x: number, y: number, z: number) => x + y + z };
  const edges = gnomon.shadowEdgePoints(picture, 100).length + gnomon.expectedError(pages, picture).share + gnomon.expectedError(shared, picture).wrong;
  if (bias + edges > gnomon.atlasFromClip(atlas, 0, { zeroToOne: true })[0]) return 0;
  // @ts-expect-error a search returns a number
  gnomon.expectedError(moved, { ...picture, occluderSearch: () => 'far' });
  return gnomon.pagePool(600).keep(pages).drawn + gnomon.clusterLights({ camera, lights: [{}] }).lights.length;
}
