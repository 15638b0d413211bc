// The types of the adapter for Babylon.js as a program uses them; compiled, and not run.
import type { DirectionalLight } from '@babylonjs/core/Lights/directionalLight.js';
import { ShadowGenerator } from '@babylonjs/core/Lights/Shadows/shadowGenerator.js';
import type { Gnomon, ShadowMap } from 'gnomon';
import { GnomonCascadedShadowGenerator, GnomonShadow, biasOf } from 'gnomon/babylon';

export function used(gnomon: Gnomon, sun: DirectionalLight, map: ShadowMap): number {
  const generator = new GnomonCascadedShadowGenerator(gnomon, 1024, sun, { options: { fit: 'tight' } });
  generator.numCascades = 3;
  const single = new GnomonShadow(gnomon, new ShadowGenerator(1024, sun));
  single.dispose();
  // @ts-expect-error a fit that there is none of
  new GnomonShadow(gnomon, generator, { options: { fit: 'loose' } });
  // @ts-expect-error plans are read alone
  single.plan = null;
  return biasOf(map, { filter: generator.filter, radius: 1 }).bias + (generator.plan?.maps.length ?? 0);
}
