// Do the examples of the front page and of the package's manual run as they stand? Their names are given as a page would have them.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import test from 'node:test';
import { boxes } from './street.js';

const AsyncFunction = (async () => {}).constructor;
const load = "import { load } from 'gnomon';";
const module = process.env.MODULE ?? new URL('../index.js', import.meta.url).href;

for (const page of ['../../../README.md', '../README.md']) {
  const text = readFileSync(new URL(page, import.meta.url), 'utf8');
  for (const [, code] of text.matchAll(/^```js\n([^]*?)^```$/gm)) {
    test(`${page}: ${code.split('\n').find((line) => line.includes('gnomon.plan'))}`, async () => {
      assert.ok(code.includes(load), 'an example begins with the import');
      const drawn = [], printed = [];
      const given = { module, eye: [0, 3, 10], forward: [0, -0.1, -1], sun: [0.4, -1, 0.3], casters: boxes, receivers: boxes,
        draw: (...map) => drawn.push(map), console: { log: (...words) => printed.push(words) } };
      await new AsyncFunction(...Object.keys(given), code.replace(load, 'const { load } = await import(module);'))(...Object.values(given));
      assert.ok(drawn.length > 1, 'several maps are drawn');
      for (const [clipFromWorld, width, height] of drawn) assert.ok(clipFromWorld.every(Number.isFinite) && width > 0 && height > 0);
      assert.ok(printed[0][0] > 0, 'an error is printed');
    });
  }
}

test('both pages have an example', () => {
  for (const page of ['../../../README.md', '../README.md'])
    assert.match(readFileSync(new URL(page, import.meta.url), 'utf8'), /^```js\n/m);
});
