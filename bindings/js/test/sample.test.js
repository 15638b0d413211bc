// Does the sample work: both halves, figures, sliders, keyboard, and a phone? CONSUMER: as for three.test.js. PICTURES: a folder for
// what was seen.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import test from 'node:test';
import { onPage } from './browser.js';

const consumer = process.env.CONSUMER;
const see = async (page, name) => { if (process.env.PICTURES) await page.screenshot({ path: join(process.env.PICTURES, `${name}.png`) }); };

/** Waits for both figures, and returns them. */
async function figures(page) {
  await page.waitForFunction(() => document.querySelector('#three b') && document.querySelector('#gnomon b'), { timeout: 120000 });
  return page.evaluate(() => ['three', 'gnomon'].map((id) => Number(document.querySelector(`#${id} b`).textContent)));
}
/** How many colours each half of the canvas has: one that was not drawn has one. */
const colours = (page) => page.evaluate(() => {
  const canvas = document.createElement('canvas');
  const view = document.querySelector('#view');
  [canvas.width, canvas.height] = [view.width, view.height];
  const context = canvas.getContext('2d');
  context.drawImage(view, 0, 0);
  const half = Math.floor(canvas.width / 2);
  return [0, half].map((x) => new Set(new Uint32Array(context.getImageData(x, 0, half, canvas.height).data.buffer)).size);
});
/** Sets a control as a user does, and waits until its picture is drawn. */
async function set(page, id, value) {
  await page.evaluate((which, to) => {
    const control = document.getElementById(which);
    if (control.type === 'checkbox') control.checked = to;
    else control.value = to;
    control.dispatchEvent(new Event('input', { bubbles: true }));
  }, id, value);
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

test('the sample draws both halves, measures both, and follows its sliders and keys', { timeout: 300000 }, async () => {
  const { errors } = await onPage('/sample/index.html', consumer, async (page) => {
    const first = await figures(page);
    assert.ok(first[0] > first[1] && first[1] > 0, String(first));
    assert.ok((await colours(page)).every((count) => count > 50));
    await set(page, 'walk', false);
    await see(page, 'wipe');
    await set(page, 'showHeat', true);
    await see(page, 'heat');
    // Fewer texels are larger ones, on both sides.
    const before = await figures(page);
    await set(page, 'texels', 8);
    const coarse = await figures(page);
    assert.ok(coarse[0] > 2 * before[0] && coarse[1] > 2 * before[1], `${before} ${coarse}`);
    await set(page, 'light', '4');
    await set(page, 'elevation', 20);
    const csm = await figures(page);
    assert.ok(csm[0] > csm[1] && csm[0] < coarse[0], `${coarse} ${csm}`);
    await see(page, 'csm');
    for (const fit of ['tight', 'stable']) await set(page, 'fit', fit);
    await set(page, 'light', 'sun');
    assert.ok((await colours(page)).every((count) => count > 50));
    // Keys: the arrows move the line, h hides the heat, space walks on.
    await page.evaluate(() => document.activeElement.blur());
    const line = () => page.evaluate(() => [document.querySelector('#wipe').value, document.querySelector('#heat').hidden, document.querySelector('#walk').checked].map(Number));
    const [wipe, hidden, walks] = await line();
    for (const key of ['ArrowRight', 'ArrowRight', 'h', ' ']) await page.keyboard.press(key);
    assert.deepEqual(await line(), [wipe + 0.04, 1 - hidden, 1 - walks]);
    // The settings open by a key, tab goes from control to control, and the arrows change the one that has the focus.
    await page.focus('summary');
    for (const key of ['Enter', 'Tab', 'Tab', 'Tab', 'ArrowRight']) await page.keyboard.press(key);
    assert.equal(await page.evaluate(() => document.querySelector('#texels').value), '9');
  }, { viewport: { width: 960, height: 540 } });
  assert.deepEqual(errors, []);
});

test('the sample fits a phone, and its line follows a finger', { timeout: 300000 }, async () => {
  const { errors } = await onPage('/sample/index.html', consumer, async (page) => {
    await figures(page);
    const fits = () => page.evaluate(() => document.documentElement.scrollWidth <= innerWidth && [...document.querySelectorAll('.figures, details')].every((one) => one.getBoundingClientRect().right <= innerWidth + 1));
    assert.ok(await fits());
    assert.equal(await page.evaluate(() => document.querySelector('details').open), false);
    await page.touchscreen.touchStart(200, 300);
    await page.touchscreen.touchMove(90, 310);
    await page.touchscreen.touchEnd();
    assert.ok(Math.abs((await page.evaluate(() => Number(document.querySelector('#wipe').value))) - 90 / 360) < 0.02);
    await see(page, 'phone');
    await page.tap('summary');
    assert.equal(await page.evaluate(() => document.querySelector('details').open), true);
    assert.ok(await fits());
    await see(page, 'phone_settings');
  }, { viewport: { width: 360, height: 640, isMobile: true, hasTouch: true } });
  assert.deepEqual(errors, []);
});
