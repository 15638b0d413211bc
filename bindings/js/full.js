// Pages and many lights besides plans, histories and errors: a second, larger module. full.d.ts is the manual.
import { Gnomon } from './core.js';
import { LightHistory, cameraRound, clusterLights, lightPlanOptions, planLights } from './lights.js';
import { HAS_SIMD, open } from './open.js';
import { PagePool, planPages } from './pages.js';

export { GnomonError } from './memory.js';

class FullGnomon extends Gnomon {
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
  cameraRound(light, camera) {
    return cameraRound(this, light, camera);
  }
  clusterLights(input) {
    return clusterLights(this, input);
  }
}

/** Loads the module. */
export async function load({ wasm, simd = HAS_SIMD } = {}) {
  const own = simd ? new URL('./gnomon-full.wasm', import.meta.url) : new URL('./gnomon-full-scalar.wasm', import.meta.url);
  return new FullGnomon(await open(wasm ?? own, ['gnomon_make_plan', 'gnomon_plan_pages', 'gnomon_plan_lights']));
}
