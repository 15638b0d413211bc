// Are gnomon's maps better in an engine than its own while the camera moves? Flights, counted against exact rays.
//   node test/flights.js [ENGINE] [FRAMES] [PICTURES]   FRAMES: 120; PICTURES: a folder for one picture of each flight and technique
//   node test/flights.js [ENGINE] --biases               the engine's own with several biases, a few frames of the scenes that need one
//   node test/flights.js --texels                        the city: its own at 512², and gnomon's at 512², 1024² and 2048²
//   node test/flights.js playcanvas --rolls              its own with the light turned about its direction
// ENGINE: three, babylon or playcanvas.
// CONSUMER: a folder in which gnomon, the engines, three-mesh-bvh and puppeteer-core are installed, as all.sh leaves it.
// SCENES: a folder of glTF scenes; without it the city is not flown.
import { existsSync, mkdirSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { inBrowser } from './browser.js';

const here = dirname(fileURLToPath(import.meta.url));
const consumer = process.env.CONSUMER ?? join(here, '../../../build/js/consumer');
const folder = process.env.SCENES ?? join(here, '../../../../shared/scenes');
const SIZES = { 1024: [960, 540], 512: [640, 360] };
const SCENES_OF = { three: ['street', 'low sun', 'lamp', 'bulb', 'bulb, both sides', 'city'], babylon: ['street', 'low sun', 'city'], playcanvas: ['street', 'low sun'] };
// Those that need a bias.
const BIASED = { three: ['both sides', 'bulb, both sides', 'city'], babylon: ['street', 'low sun', 'both sides', 'city'], playcanvas: ['street', 'low sun'] };
const PAGES = { three: 'flights_page.js', babylon: 'babylon_page.js', playcanvas: 'playcanvas_page.js' };

/** Rows of one flight: misclassified pixels, flips and acne of every technique. `others`: see run() of the pages. */
export async function fly(scene, size, frames, { engine = 'three', ...others } = {}) {
  if (scene === 'city' && !existsSync(join(folder, 'low_poly_city'))) return { rows: [], pictures: {} };
  const { result, errors } = await inBrowser(PAGES[engine], consumer, { scene, size, picture: SIZES[size], frames, ...others }, folder);
  if (errors.length > 0) throw new Error(errors.join('\n'));
  return result;
}

const percent = (share) => `${(100 * share).toFixed(3)} %`;

async function table(engine, frames, out, { scenes = SCENES_OF[engine], sizes = Object.keys(SIZES).map(Number), ...how } = {}) {
  console.log('| scene | maps | technique | misclassified | to its own | flips | to its own | acne |\n|--|--|--|--:|--:|--:|--:|--:|');
  for (const size of sizes) {
    for (const scene of scenes) {
      const { rows, pictures } = await fly(scene, size, frames, { engine, ...how, ...(out === undefined ? {} : { pictureOf: frames >> 1 }) });
      let own;
      for (const row of rows) {
        if (!row.technique.includes(',')) own = row;
        console.log(`| ${scene} | ${size}² | ${row.technique} | ${percent(row.wrong)} | ${(row.wrong / own.wrong).toFixed(2)} | ${percent(row.flips)} | ${(row.flips / own.flips).toFixed(2)} | ${percent(row.acne)} |`);
      }
      if (out === undefined) continue;
      mkdirSync(out, { recursive: true });
      for (const [name, url] of Object.entries(pictures)) writeFileSync(join(out, `${scene}_${size}_${name}.png`.replace(/[ ,]+/g, '_')), Buffer.from(url.split(',')[1], 'base64'));
    }
  }
}

async function sweeps(engine, sweep) {
  const three = engine === 'three';
  for (const size of Object.keys(SIZES).map(Number)) {
    for (const scene of BIASED[engine]) {
      const { rows } = await fly(scene, size, three ? 2 : 6, { engine, step: three ? 45 : 17, sweep });
      for (const { technique, wrong, acne } of rows) console.log(`${scene}, ${size}², ${technique}: ${percent(wrong)} misclassified, ${percent(acne)} acne`);
    }
  }
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const given = process.argv.slice(2);
  const engine = given[0] in PAGES ? given.shift() : 'three';
  const sweep = given[0]?.match(/^--(biases|rolls|texels)$/)?.[1];
  if (sweep === 'texels') await table('three', 6, undefined, { scenes: ['city'], sizes: [512], sweep });
  else await (sweep !== undefined ? sweeps(engine, sweep) : table(engine, Number(given[0] ?? 120), given[1]));
}
