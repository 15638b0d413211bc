// Are gnomon's maps better in three.js than its own? Drawn in a browser, counted against exact rays. CONSUMER: a folder in which
// gnomon, three and puppeteer-core are installed.
import assert from 'node:assert/strict';
import test from 'node:test';
import { inBrowser } from './browser.js';

test('three.js misclassifies fewer pixels with the maps of gnomon', { timeout: 900000 }, async () => {
  const { result, errors } = await inBrowser('three_page.js', process.env.CONSUMER);
  const percent = (share) => `${(100 * share).toFixed(3)} %`;
  for (const [name, { wrong, falseShadow, falseLight }] of Object.entries(result))
    console.log(`${name}: ${percent(wrong)} misclassified, ${percent(falseShadow)} false shadow, ${percent(falseLight)} false light`);
  assert.deepEqual(errors, []);
  assert.ok(Object.values(result).every(({ counted }) => counted > 50000));
  const wrong = (name) => result[name].wrong;
  // About a tenth above what they are.
  assert.ok(wrong('sun, gnomon stable') < 0.87 * wrong('sun'));
  assert.ok(wrong('sun, gnomon warped_stable') < 0.52 * wrong('sun'));
  assert.ok(wrong('sun, gnomon tight') < 0.49 * wrong('sun'));
  assert.ok(wrong('sun, front faces, gnomon tight') < 0.42 * wrong('sun, front faces'));
  assert.ok(wrong('csm, gnomon stable') < 0.97 * wrong('csm'));
  assert.ok(wrong('csm, gnomon warped_stable') < 0.69 * wrong('csm'));
  assert.ok(wrong('csm, gnomon tight') < 0.6 * wrong('csm'));
});

test('the sample draws both halves, and measures both', { timeout: 300000 }, async () => {
  const { result, errors } = await inBrowser('sample_page.js', process.env.CONSUMER);
  assert.deepEqual(errors, []);
  assert.ok(result.own > 0 && result.gnomon > 0 && result.gnomon < result.own, JSON.stringify(result));
  assert.ok(result.left > 20 && result.right > 20, JSON.stringify(result));
});
