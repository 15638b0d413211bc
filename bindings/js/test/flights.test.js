// Are gnomon's maps better in three.js than its own while the camera moves? The first frames of each flight, drawn in a browser and
// counted against exact rays. CONSUMER: a folder in which gnomon, three, three-mesh-bvh and puppeteer-core are installed.
import assert from 'node:assert/strict';
import test from 'node:test';
import { fly } from './flights.js';

const FRAMES = 8;
// Misclassified pixels and flips, to those of three's own.
// In the city the bias that three's own need takes most shadows of the windows away, and what is not there does not flip.
const MOST = { SunLight: { wrong: 0.35, flips: 0.5 }, CSM: { wrong: 0.6, flips: 0.6 }, SpotLight: { wrong: 0.6, flips: 0.5 }, PointLight: { wrong: 0.6, flips: 0.55 } };

for (const scene of ['street', 'low sun', 'both sides', 'lamp', 'bulb', 'bulb, both sides', 'city']) {
  test(`three.js misclassifies fewer pixels with the maps of gnomon: ${scene}`, { timeout: 600000 }, async () => {
    const { rows } = await fly(scene, 512, FRAMES);
    if (scene !== 'city') assert.ok(rows.length >= 4);
    const row = (name) => rows.find(({ technique }) => technique === name);
    for (const [own, most] of Object.entries(MOST)) {
      if (row(own) === undefined) continue;
      const [theirs, ours] = [row(own), row(`${own}, gnomon`)];
      console.log(`${scene}, ${own}: ${(ours.wrong / theirs.wrong).toFixed(2)} misclassified, ${(ours.flips / theirs.flips).toFixed(2)} flips`);
      assert.ok(theirs.counted > FRAMES * (scene === 'lamp' ? 10000 : 50000));
      const fewer = ours.wrong <= most.wrong * theirs.wrong && (scene === 'city' || ours.flips <= most.flips * theirs.flips);
      assert.ok(fewer, JSON.stringify([theirs, ours]));
      for (const { acne } of [ours, row(`${own}, gnomon, tight`)]) assert.ok(acne <= Math.max(1e-3, (own === 'SpotLight' ? 1.2 : 1) * theirs.acne), `acne ${acne}, ${theirs.acne}`);
      // All of a lamp's cone has texels where its grid is stable, and that is more than three gives to it. A stable bulb has three's own
      // cube, whose bias by hand has a normal offset.
      for (const fit of ['lamp', 'bulb, both sides'].includes(scene) ? ['tight'] : ['tight', 'stable']) assert.ok(row(`${own}, gnomon, ${fit}`).wrong < 1.05 * theirs.wrong, fit);
    }
  });
}
