// Shadow maps, chosen by measurement: plans, histories and errors. index.d.ts is the manual.
import { Gnomon } from './core.js';
import { HAS_SIMD, open } from './open.js';

export { GnomonError } from './memory.js';

/** Loads the module. */
export async function load({ wasm, simd = HAS_SIMD } = {}) {
  // Both as literals: bundlers find the files by them.
  const own = simd ? new URL('./gnomon.wasm', import.meta.url) : new URL('./gnomon-scalar.wasm', import.meta.url);
  return new Gnomon(await open(wasm ?? own));
}
