// Does the package work in a worker of a browser, and how long does a plan take there? CONSUMER: as for flights.test.js.
import assert from 'node:assert/strict';
import test from 'node:test';
import { inBrowser } from './browser.js';

test('a worker plans the same maps with the module of the page', { timeout: 120000 }, async () => {
  const { result, errors } = await inBrowser('worker_page.js', process.env.CONSUMER);
  assert.deepEqual(errors, []);
  assert.equal(result.here.length, 4);
  assert.deepEqual(result.there, result.here);
  for (const [name, median] of result.times) console.log(`plan of four cascades, ${name}: median ${median.toFixed(3)} ms`);
});
