// The sample, two frames of it: what both halves show, and the error of both.
import { start } from './samples/web/main.js';

export async function run() {
  document.body.innerHTML = '<canvas style="display:block;width:640px;height:360px"></canvas><div id="line"></div><p id="three"></p><p id="gnomon"></p><input type="range" min="0" max="1" step="0.001" value="0.5">';
  const canvas = document.querySelector('canvas');
  const { renderer, draw, measure, errors } = await start(canvas);
  renderer.setAnimationLoop(null);
  draw(0);
  const image = draw(100);
  measure(image);
  const gl = renderer.getContext();
  const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
  const pixels = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  // How many different reds each half shows: one that was not drawn has one.
  const colours = (from, to) => {
    const found = new Set();
    for (let y = 0; y < height; ++y) for (let x = from; x < to; ++x) found.add(pixels[4 * (y * width + x)]);
    return found.size;
  };
  return { ...errors, left: colours(0, width / 2), right: colours(width / 2, width) };
}
