// The types of the adapter for PlayCanvas as a program uses them; compiled, and not run.
import type { Gnomon, ShadowMap } from 'gnomon';
import { GnomonCascades, biasOf, radiusOf } from 'gnomon/playcanvas';
import { type Application, type Entity, SHADOW_PCF3_32F } from 'playcanvas';

export function used(gnomon: Gnomon, app: Application, sun: Entity, map: ShadowMap): number {
  const shadows = new GnomonCascades(gnomon, app, sun.light!, { options: { fit: 'tight' } });
  const maps = shadows.plan?.maps.length ?? 0;
  // @ts-expect-error a fit that there is none of
  new GnomonCascades(gnomon, app, sun.light!, { options: { fit: 'loose' } });
  // @ts-expect-error plans are read alone
  shadows.plan = null;
  shadows.dispose();
  return biasOf(map, { radius: radiusOf(SHADOW_PCF3_32F) ?? 1 }).depthBias + maps;
}
